//! A layout for narrow pages: boxes below one another, and lines in tracks on their right.

use super::super::model::{Arrow, BoxKind, Diagram};
use super::dots::dots;
use super::slots::{Exit, exit};
use super::{Layout, Measure, Rect, Route, forward::forward, sequence::sequence, size};
use std::collections::BTreeMap;

/// Lays a diagram out.
pub(in super::super) fn stack(diagram: &Diagram, measure: &Measure) -> Layout {
    let forward = forward(diagram);
    let sequence = sequence(diagram, &forward);
    let place = |index: usize| sequence.iter().position(|it| *it == index).unwrap_or(0);
    let places: Vec<usize> = (0..diagram.boxes.len()).map(place).collect();
    let points = Points::of(diagram, &places);
    let (boxes, frames) = piled(diagram, &sequence, &points, measure);
    let heights = points.heights(&boxes);
    let right = boxes.iter().map(Rect::right).fold(0.0, f64::max);
    let labels: Vec<Option<Rect>> = diagram
        .arrows
        .iter()
        .enumerate()
        .map(|(index, arrow)| {
            let (label, height) = (arrow.label(), measure.label_line / 2.0);
            let y = heights[&Point::Entry(index)] - height + NEARER;
            let width = label.chars().count() as f64 * measure.label;
            (!label.is_empty()).then_some(Rect { x: right + HEAD, y, width, height })
        })
        .collect();
    let first = labels.iter().flatten().map(Rect::right).fold(right, f64::max) + measure.channel / 2.0;
    let tracks = tracks(diagram, &points, &heights);
    let side = |of: usize, y: f64| {
        let (rect, has_point) = (&boxes[of], diagram.boxes[of].kind == BoxKind::Input);
        let off = (y - rect.middle()[1]).abs() / (rect.height / 2.0);
        rect.right() - if has_point { off * measure.point } else { 0.0 }
    };
    let route = |(index, arrow): (usize, &Arrow)| {
        let exit = points.exits[index];
        let (from, to) = (heights[&Point::Exit(exit)], heights[&Point::Entry(index)]);
        let x = first + tracks[&exit] as f64 * measure.track;
        let points = vec![[side(arrow.from, from), from], [x, from], [x, to], [side(arrow.to, to), to]];
        Route { points, exit, label: labels[index] }
    };
    let routes: Vec<Route> = diagram.arrows.iter().enumerate().map(route).collect();
    let dots = dots(&routes);
    let mut layout = Layout { width: 0.0, height: 0.0, boxes, frames, routes, dots };
    layout.normalize();
    layout
}

/// The room for an arrow's head beside a box, before the label.
const HEAD: f64 = 12.0;
/// Between two boxes.
const GAP: f64 = 14.0;
/// Between lines at the side of a box, with a label between two.
const SIDE: f64 = 15.0;
/// The label of a line is that much nearer to it than where boxes are in columns.
const NEARER: f64 = 2.0;
/// The least gap between lines of one track.
const NEAR: f64 = 4.0;

/// A point at the right side of a box: an exit, or the end of an arrow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Point {
    Exit(usize),
    Entry(usize),
}

/// The points of all boxes.
struct Points {
    /// The exit of each arrow; arrows of one kind and of the same ports leave a box at one point.
    exits: Vec<usize>,
    /// The points of each box, from top to bottom.
    at: Vec<Vec<Point>>,
}

impl Points {
    /// The points of boxes at those places in the pile.
    fn of(diagram: &Diagram, places: &[usize]) -> Points {
        let mut known: BTreeMap<(usize, Exit), usize> = BTreeMap::new();
        let mut exits = Vec::new();
        // The farthest place to which the line of a point goes, relative to its own.
        let mut ways: Vec<BTreeMap<Point, i64>> = vec![BTreeMap::new(); places.len()];
        for (index, arrow) in diagram.arrows.iter().enumerate() {
            let next = known.len();
            let exit = *known.entry((arrow.from, exit(diagram, arrow))).or_insert(next);
            exits.push(exit);
            let way = places[arrow.to] as i64 - places[arrow.from] as i64;
            let farthest = ways[arrow.from].entry(Point::Exit(exit)).or_insert(way);
            *farthest = if way.abs() > farthest.abs() { way } else { *farthest };
            ways[arrow.to].insert(Point::Entry(index), -way);
        }
        let sorted = |ways: BTreeMap<Point, i64>| {
            let mut points: Vec<(Point, i64)> = ways.into_iter().collect();
            // Lines upwards first, the shortest on top; then lines downwards, the longest on top. So few of them cross.
            points.sort_by_key(|(point, way)| (*way > 0, -way, *point));
            points.into_iter().map(|(point, _)| point).collect()
        };
        Points { exits, at: ways.into_iter().map(sorted).collect() }
    }

    /// The height of each point.
    fn heights(&self, boxes: &[Rect]) -> BTreeMap<Point, f64> {
        let of_box = |(points, rect): (&Vec<Point>, &Rect)| {
            let top = rect.middle()[1] - (points.len() as f64 - 1.0) * SIDE / 2.0;
            let height = move |(number, point): (usize, &Point)| (*point, top + number as f64 * SIDE);
            points.iter().enumerate().map(height).collect::<Vec<_>>()
        };
        self.at.iter().zip(boxes).flat_map(of_box).collect()
    }
}

/// The rectangles of boxes and frames. All boxes end at one line on the right, and begin right of the frames that they are in.
fn piled(diagram: &Diagram, sequence: &[usize], points: &Points, measure: &Measure) -> (Vec<Rect>, Vec<Rect>) {
    let none = vec![true; diagram.arrows.len()];
    let sizes: Vec<[f64; 2]> = (0..diagram.boxes.len()).map(|index| size(diagram, &none, index, measure)).collect();
    let around = |index: usize| frames_around(diagram, diagram.boxes[index].frame);
    let left = |index: usize| around(index).len() as f64 * measure.frame;
    let title = |index: usize| {
        let frame = &diagram.frames[index];
        let letters = (frame.name.chars().count() + 2 + frame.count.chars().count()) as f64;
        left_of(diagram, index, measure) + letters * measure.name + 2.0 * measure.pad[0]
    };
    let needed = (0..diagram.boxes.len()).map(|index| left(index) + sizes[index][0]);
    let right = needed.chain((0..diagram.frames.len()).map(title)).fold(0.0, f64::max);
    let (mut boxes, mut frames) = (vec![Rect::default(); sizes.len()], vec![Rect::default(); diagram.frames.len()]);
    let (mut y, mut open): (f64, Vec<usize>) = (0.0, Vec::new());
    for &index in sequence {
        let inside = around(index);
        while open.last().is_some_and(|last| !inside.contains(last)) {
            y += close(&mut frames, &mut open, y, measure);
        }
        for &frame in inside.iter().filter(|frame| !open.contains(frame)).collect::<Vec<_>>() {
            let x = left_of(diagram, frame, measure);
            frames[frame] = Rect { x, y, width: right - x + measure.frame / 2.0, height: 0.0 };
            y += measure.frame_title;
            open.push(frame);
        }
        let text = lines_high(diagram, index, measure) + 2.0 * measure.pad[1];
        let height = text.max(points.at[index].len() as f64 * SIDE + measure.pad[1]);
        boxes[index] = Rect { x: left(index), y, width: right - left(index), height };
        y += height + GAP;
    }
    while !open.is_empty() {
        y += close(&mut frames, &mut open, y, measure);
    }
    (boxes, frames)
}

/// Ends the innermost frame, and says how far the next box moves down.
fn close(frames: &mut [Rect], open: &mut Vec<usize>, y: f64, measure: &Measure) -> f64 {
    let Some(frame) = open.pop() else { return 0.0 };
    frames[frame].height = y - GAP + measure.frame - frames[frame].y;
    measure.frame
}

fn lines_high(diagram: &Diagram, index: usize, measure: &Measure) -> f64 {
    let it = &diagram.boxes[index];
    it.names.len() as f64 * measure.name_line + if it.note.is_empty() { 0.0 } else { measure.note_line }
}

/// The frames around something, outermost first.
fn frames_around(diagram: &Diagram, frame: Option<usize>) -> Vec<usize> {
    let mut all: Vec<usize> = std::iter::successors(frame, |it| diagram.frames[*it].frame).collect();
    all.reverse();
    all
}

/// The left edge of a frame.
fn left_of(diagram: &Diagram, frame: usize, measure: &Measure) -> f64 {
    frames_around(diagram, diagram.frames[frame].frame).len() as f64 * measure.frame
}

/// The track of each exit's line. Short lines are near the boxes.
fn tracks(diagram: &Diagram, points: &Points, heights: &BTreeMap<Point, f64>) -> BTreeMap<usize, usize> {
    let mut spans: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for (index, exit) in points.exits.iter().enumerate().take(diagram.arrows.len()) {
        let from = heights[&Point::Exit(*exit)];
        let [top, bottom] = spans.entry(*exit).or_insert([from; 2]);
        let to = heights[&Point::Entry(index)];
        (*top, *bottom) = (top.min(to), bottom.max(to));
    }
    let mut shortest: Vec<(usize, [f64; 2])> = spans.into_iter().collect();
    shortest.sort_by(|(_, a), (_, b)| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    let mut taken: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut tracks = BTreeMap::new();
    for (exit, span) in shortest {
        let meets = |other: &[f64; 2]| span[0] < other[1] + NEAR && other[0] < span[1] + NEAR;
        let track = taken.iter().position(|track| !track.iter().any(meets)).unwrap_or(taken.len());
        taken.resize_with(taken.len().max(track + 1), Vec::new);
        taken[track].push(span);
        tracks.insert(exit, track);
    }
    tracks
}
