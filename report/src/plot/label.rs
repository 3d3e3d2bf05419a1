//! Names of series at the ends of their curves, so that no eye has to go to the legend and back.

use super::Shown;
use super::svg::TENTHS;
use crate::chart::Chart;

/// A name beside a point.
pub struct Label<'a> {
    pub text: &'a str,
    pub number: usize,
    pub point: (f64, f64),
}

impl Label<'_> {
    /// The room that it takes, in tenths.
    pub fn width(&self) -> i32 {
        (self.text.chars().count() as i32 * 7 + 14) * TENTHS
    }
}

/// The longest name that fits beside a curve, in characters.
const LONGEST: usize = 9;

/// The labels of a chart of several names, if all are short: each at the last point of its first series.
pub fn labels<'a>(chart: &'a Chart, shown: &[Shown]) -> Vec<Label<'a>> {
    let names = chart.names();
    if names.len() < 2 || names.iter().any(|name| name.chars().count() > LONGEST) {
        return vec![];
    }
    let label = |(number, text): (usize, &&'a str)| {
        let points = &shown.iter().find(|it| it.number == number && !it.points.is_empty())?.points;
        Some(Label { text, number, point: *points.last()? })
    };
    names.iter().enumerate().filter_map(label).collect()
}

/// Heights of labels, in tenths, moved as little as is needed for each to be readable.
pub fn apart(heights: &[i32]) -> Vec<i32> {
    const LINE: i32 = 14 * TENTHS;
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by_key(|index| heights[*index]);
    let mut moved = heights.to_vec();
    // Labels that touch are a group, which stands where its members are nearest to their places.
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let top = |group: &[usize]| {
        let wanted = group.iter().enumerate().map(|(place, index)| heights[*index] - place as i32 * LINE).sum::<i32>();
        wanted / group.len() as i32
    };
    for index in order {
        groups.push(vec![index]);
        while let [.., above, below] = groups.as_slice()
            && top(below) < top(above) + above.len() as i32 * LINE
        {
            let below = groups.pop().unwrap_or_default();
            groups.last_mut().into_iter().for_each(|above| above.extend(&below));
        }
    }
    for group in &groups {
        group.iter().enumerate().for_each(|(place, index)| moved[*index] = top(group) + place as i32 * LINE);
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_stand_apart_and_near_their_curves() {
        assert_eq!(apart(&[0, 500, 300]), [0, 500, 300], "what is apart stays");
        assert_eq!(apart(&[300, 300]), [230, 370]);
        assert_eq!(apart(&[300, 290, 1000]), [365, 225, 1000]);
        assert_eq!(apart(&[0, 100, 200]), [-40, 100, 240], "groups grow");
    }
}
