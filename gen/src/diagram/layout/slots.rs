//! Where lines leave and enter boxes.

use super::super::model::{Arrow, ArrowKind, BoxKind, Diagram, DiagramBox};
use super::Measure;
use super::layers::Layers;
use std::collections::{BTreeMap, BTreeSet};

/// The path of an arrow through the columns.
pub(super) struct Stops {
    /// The columns from its source to its target, and its height in each.
    pub at: Vec<(usize, f64)>,
    /// Its exit; arrows of one exit leave a box at one point.
    pub exit: usize,
}

/// What leaves a box at one point: arrows of one kind, and from an instance of the same ports.
pub(super) type Exit<'a> = (ArrowKind, &'a [String]);

pub(super) fn is_port(it: &DiagramBox) -> bool {
    matches!(it.kind, BoxKind::Input | BoxKind::Output)
}

/// The number of points at a side of a box where arrows leave or enter.
pub(super) fn count(diagram: &Diagram, forward: &[bool], (index, is_right): Side) -> usize {
    let all = || diagram.arrows.iter().zip(forward);
    let leaving = all().filter(|(arrow, forward)| arrow.from == index && **forward == is_right);
    let exits: BTreeSet<Exit> = leaving.map(|(arrow, _)| exit(diagram, arrow)).collect();
    exits.len() + all().filter(|(arrow, forward)| arrow.to == index && **forward != is_right).count()
}

pub(super) fn exit<'a>(diagram: &Diagram, arrow: &'a Arrow) -> Exit<'a> {
    let is_instance = diagram.boxes[arrow.from].kind == BoxKind::Instance;
    (arrow.kind, if is_instance { &arrow.signals[..] } else { &[] })
}

/// A side of a box: the box's index, and whether it is the right side.
pub(super) type Side = (usize, bool);

/// The paths of all arrows.
pub(super) fn stops(diagram: &Diagram, layers: &Layers, measure: &Measure) -> Vec<Stops> {
    let mut exits: BTreeMap<(Side, Exit), usize> = BTreeMap::new();
    let mut found: Vec<Stops> = Vec::new();
    // For each side and point, the heights that would make its lines straight.
    let mut wishes: BTreeMap<Side, BTreeMap<Place, Vec<f64>>> = BTreeMap::new();
    for (index, arrow) in diagram.arrows.iter().enumerate() {
        let middle = |of: usize| (layers.boxes[of].0, layers.boxes[of].1.middle()[1]);
        let mut at = vec![middle(arrow.from)];
        at.extend(&layers.passes[index]);
        at.push(middle(arrow.to));
        let last = at.len() - 1;
        let (leaves, enters) = ((arrow.from, at[1].0 > at[0].0), (arrow.to, at[last - 1].0 > at[last].0));
        let next = exits.len();
        let exit = *exits.entry((leaves, exit(diagram, arrow))).or_insert(next);
        wishes.entry(leaves).or_default().entry(Place::Exit(exit)).or_default().push(at[1].1);
        wishes.entry(enters).or_default().entry(Place::Entry(index)).or_default().push(at[last - 1].1);
        found.push(Stops { at, exit });
    }
    let mut heights = BTreeMap::new();
    for ((of, _), places) in &wishes {
        let rect = layers.boxes[*of].1;
        let mut wished: Vec<(f64, Place)> = places.iter().map(|(place, ys)| (median(ys), *place)).collect();
        wished.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ys = spread(&wished.iter().map(|it| it.0).collect::<Vec<_>>(), rect.y, rect.bottom(), measure);
        heights.extend(wished.iter().map(|it| it.1).zip(ys));
    }
    for (index, stops) in found.iter_mut().enumerate() {
        let last = stops.at.len() - 1;
        stops.at[0].1 = heights[&Place::Exit(stops.exit)];
        stops.at[last].1 = heights[&Place::Entry(index)];
    }
    found
}

/// What has a point at a side of a box.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Exit(usize),
    Entry(usize),
}

fn median(ys: &[f64]) -> f64 {
    let mut ys = ys.to_vec();
    ys.sort_by(f64::total_cmp);
    ys[ys.len() / 2]
}

/// Heights near the wishes, which are sorted, with gaps between them.
fn spread(wished: &[f64], top: f64, bottom: f64, measure: &Measure) -> Vec<f64> {
    // In characters, a box's outline takes its first and last line.
    let (first, last) = if measure.is_whole { (top + 1.0, bottom - 2.0) } else { (top, bottom) };
    let room = last - first;
    let count = wished.len() as f64;
    let apart = if measure.is_whole { 1.0 } else { measure.line_gap.min(room / (count + 1.0)) };
    let edge = if measure.is_whole { 0.0 } else { (apart / 2.0).min(room / 4.0) };
    let mut ys: Vec<f64> = wished.iter().map(|y| y.clamp(first + edge, (last - edge).max(first + edge))).collect();
    for i in 1..ys.len() {
        ys[i] = ys[i].max(ys[i - 1] + apart);
    }
    let mut limit = last - edge;
    for y in ys.iter_mut().rev() {
        *y = y.min(limit);
        limit = *y - apart;
    }
    if measure.is_whole { ys.into_iter().map(f64::round).collect() } else { ys }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points keep off the corners, wherever they would like to be, and keep their order and distance.
    #[test]
    fn points_stay_between_the_corners() {
        let measure = Measure { line_gap: 8.0, ..crate::diagram::svg::PIXELS };
        assert_eq!(spread(&[0.0, 200.0], 10.0, 110.0, &measure), [14.0, 106.0]);
        assert_eq!(spread(&[50.0, 51.0], 10.0, 110.0, &measure), [50.0, 58.0]);
        assert_eq!(spread(&[300.0, 300.0], 10.0, 110.0, &measure), [98.0, 106.0]);
        // In too little room they share it.
        assert_eq!(spread(&[0.0, 0.0, 0.0], 0.0, 8.0, &measure), [1.0, 3.0, 5.0]);
    }
}
