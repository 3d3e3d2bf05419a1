//! Dots where a line splits.

use super::Route;
use std::collections::BTreeMap;

/// The dots of all lines, each with one of its arrows.
pub(super) fn dots(routes: &[Route]) -> Vec<([f64; 2], usize)> {
    let mut together: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (arrow, route) in routes.iter().enumerate() {
        together.entry(route.exit).or_default().push(arrow);
    }
    let dots = together.values().flat_map(|arrows| {
        let starts: Vec<&[[f64; 2]]> = arrows.iter().map(|arrow| &routes[*arrow].points[..]).collect();
        parts(&starts).into_iter().map(|dot| (dot, arrows[0]))
    });
    dots.collect()
}

/// Where the lines of one exit split: they share their first vertical piece, or go straight on there.
fn parts(lines: &[&[[f64; 2]]]) -> Vec<[f64; 2]> {
    let is_bent = |line: &&&[[f64; 2]]| line.len() > 2;
    let nearest = |a: f64, b: f64| if (a - lines[0][0][0]).abs() < (b - lines[0][0][0]).abs() { a } else { b };
    let Some(x) = lines.iter().filter(is_bent).map(|line| line[1][0]).reduce(nearest) else { return Vec::new() };
    let start = lines[0][0][1];
    let turns: Vec<f64> = lines.iter().filter(is_bent).filter(|line| line[1][0] == x).map(|line| line[2][1]).collect();
    let (highest, lowest) = (turns.iter().copied().fold(start, f64::min), turns.iter().copied().fold(start, f64::max));
    let mut ys: Vec<f64> = turns.iter().copied().filter(|y| *y != highest && *y != lowest).collect();
    let goes_on = turns.len() < lines.len();
    if goes_on || (highest < start && start < lowest) {
        ys.push(start);
    }
    ys.sort_by(f64::total_cmp);
    ys.dedup();
    ys.into_iter().map(|y| [x, y]).collect()
}

#[cfg(test)]
mod tests {
    use super::parts;

    /// A line that starts at height 5 and bends at 10, or goes straight on.
    fn line(to: f64) -> Vec<[f64; 2]> {
        if to == 5.0 { vec![[0.0, 5.0], [20.0, 5.0]] } else { vec![[0.0, 5.0], [10.0, 5.0], [10.0, to], [20.0, to]] }
    }

    #[test]
    fn dots_are_where_lines_part() {
        let of = |heights: &[f64]| {
            let lines: Vec<_> = heights.iter().map(|y| line(*y)).collect();
            parts(&lines.iter().map(|line| &line[..]).collect::<Vec<_>>()).iter().map(|dot| dot[1]).collect::<Vec<_>>()
        };
        assert_eq!(of(&[5.0]), []);
        assert_eq!(of(&[9.0]), []);
        assert_eq!(of(&[5.0, 9.0]), [5.0]);
        assert_eq!(of(&[1.0, 9.0]), [5.0]);
        assert_eq!(of(&[7.0, 9.0]), [7.0]);
        assert_eq!(of(&[1.0, 3.0, 5.0, 9.0]), [3.0, 5.0]);
    }
}
