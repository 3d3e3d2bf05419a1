//! Names of series at the ends of their curves, so that readers do not need the legend.

use super::svg::TENTHS;
use super::{Format, Shown};
use crate::chart::Chart;

/// A name beside a curve, in one line or in two.
pub struct Label<'a> {
    pub lines: Vec<&'a str>,
    pub number: usize,
    /// The begin and the end of the curve.
    pub first: (f64, f64),
    pub last: (f64, f64),
}

/// The height of a line, in tenths.
pub const LINE: i32 = 14 * TENTHS;

impl Label<'_> {
    /// Its width beside its curve, in tenths, for characters of that width.
    pub fn width(&self, character: i32) -> i32 {
        let longest = self.lines.iter().map(|line| line.chars().count()).max().unwrap_or(0);
        (longest as i32 * character + 22) * TENTHS
    }

    /// Its height, in tenths.
    pub fn height(&self) -> i32 {
        self.lines.len() as i32 * LINE
    }
}

/// Whether a chart of that format has its names at the ends of its curves, and so needs no legend.
pub fn are_beside(chart: &Chart, format: Format) -> bool {
    let names = chart.names();
    names.len() > 1 && names.iter().all(|name| lines(name, format.longest).is_some())
}

/// The labels of a chart of several names, if all of them fit; each is beside its first series.
pub fn labels<'a>(chart: &'a Chart, shown: &[Shown], format: Format) -> Vec<Label<'a>> {
    if !are_beside(chart, format) {
        return vec![];
    }
    let label = |(number, text): (usize, &&'a str)| {
        let points = &shown.iter().find(|it| it.number == number && !it.points.is_empty())?.points;
        Some(Label { lines: lines(text, format.longest)?, number, first: *points.first()?, last: *points.last()? })
    };
    chart.names().iter().enumerate().filter_map(label).collect()
}

/// A name in one line, or in two lines of similar lengths; `None` if it is too long.
fn lines(name: &str, longest: usize) -> Option<Vec<&str>> {
    let length = |text: &str| text.chars().count();
    if length(name) <= longest {
        return Some(vec![name]);
    }
    let halves = name.match_indices(' ').map(|(at, _)| [&name[..at], &name[at + 1..]]);
    let best = halves.min_by_key(|halves| halves.map(length).into_iter().max())?;
    best.iter().all(|half| length(half) <= longest).then(|| best.to_vec())
}

/// Heights of lines of labels, in tenths, moved no more than needed to keep each readable.
pub fn apart(heights: &[i32]) -> Vec<i32> {
    apart_by(heights, &vec![LINE; heights.len()])
}

/// The same for labels of the heights `sizes`; results are those of their middles.
pub fn apart_by(heights: &[i32], sizes: &[i32]) -> Vec<i32> {
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by_key(|index| heights[*index]);
    let mut moved = heights.to_vec();
    // Labels that touch form a group. It is placed where its members are nearest to their places.
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let room = |group: &[usize]| group.iter().map(|index| sizes[*index]).sum::<i32>();
    // The distance of each label's middle from the top of its group.
    let middles = |group: &[usize]| {
        let mut above = 0;
        let middle = |index: &usize| {
            above += sizes[*index];
            above - sizes[*index] / 2
        };
        group.iter().map(middle).collect::<Vec<i32>>()
    };
    let top = |group: &[usize]| {
        let wanted = group.iter().zip(middles(group)).map(|(index, below)| heights[*index] - below).sum::<i32>();
        wanted / group.len() as i32
    };
    for index in order {
        groups.push(vec![index]);
        while let [.., above, below] = groups.as_slice()
            && top(below) < top(above) + room(above)
        {
            let below = groups.pop().unwrap_or_default();
            groups.last_mut().into_iter().for_each(|above| above.extend(&below));
        }
    }
    for group in &groups {
        group.iter().zip(middles(group)).for_each(|(index, below)| moved[*index] = top(group) + below);
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
        assert_eq!(apart_by(&[300, 300], &[280, 140]), [195, 405], "one of two lines");
    }

    #[test]
    fn long_names_are_broken_in_the_middle_or_left_to_the_legend() {
        assert_eq!(lines("k = 4", 9), Some(vec!["k = 4"]));
        assert_eq!(lines("eight samples, our circuit’s time", 20), Some(vec!["eight samples,", "our circuit’s time"]));
        assert_eq!(lines("non-texturing", 9), None);
        assert_eq!(lines("one and two and three and four", 9), None);
    }
}
