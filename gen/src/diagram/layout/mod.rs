//! Where everything is drawn: boxes in columns, and lines of horizontal and vertical pieces.
//!
//! `dagre` chooses the column and height of each box, and the height at which a line passes the columns between its ends. The rest is decided
//! here: the width of columns, the points where lines leave and enter boxes, and the vertical pieces of lines. [`stack()`] is another layout, for
//! narrow pages.

mod channel;
mod columns;
mod dots;
mod forward;
mod layers;
mod sequence;
mod slots;
mod stack;

pub(super) use stack::stack;

use super::model::{Diagram, DiagramBox};

/// Sizes, in pixels or in characters.
#[derive(Debug, Clone)]
pub(super) struct Measure {
    /// The width of a character of names, notes and labels.
    pub name: f64,
    pub note: f64,
    pub label: f64,
    /// The height of a line of names, of a note, and of a label together with the room below its line.
    pub name_line: f64,
    pub note_line: f64,
    pub label_line: f64,
    /// Around the text of a box: left and right, and above and below.
    pub pad: [f64; 2],
    /// The width of a port's point.
    pub point: f64,
    /// Between boxes of a column, and between lines of a column.
    pub box_gap: f64,
    pub line_gap: f64,
    /// Between lines at the side of a box.
    pub side: f64,
    /// Between vertical pieces of lines, and between a box and the nearest piece.
    pub track: f64,
    pub channel: f64,
    /// Around the contents of a frame, and above them for its name.
    pub frame: f64,
    pub frame_title: f64,
    /// All coordinates are whole numbers.
    pub is_whole: bool,
}

/// A rectangle: its left and upper edge, its width and height.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Rect {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

/// A line from box to box.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Route {
    /// Its corners, from source to target.
    pub points: Vec<[f64; 2]>,
    /// Its exit; lines of one exit leave a box at one point.
    pub exit: usize,
    /// The room for its label, above the line.
    pub label: Option<Rect>,
}

/// The place of everything.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Layout {
    pub width: f64,
    pub height: f64,
    pub boxes: Vec<Rect>,
    pub frames: Vec<Rect>,
    pub routes: Vec<Route>,
    /// Where a line splits, with one of its arrows.
    pub dots: Vec<([f64; 2], usize)>,
}

impl Rect {
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }

    pub fn middle(&self) -> [f64; 2] {
        [self.x + self.width / 2.0, self.y + self.height / 2.0]
    }
}

/// The lines of names in a box, the first with the count.
pub(super) fn lines(it: &DiagramBox) -> Vec<String> {
    let mut names = it.names.clone();
    if !it.count.is_empty() {
        names[0] += &format!(" ×{}", it.count);
    }
    names
}

/// Lays a diagram out.
pub(super) fn layout(diagram: &Diagram, measure: &Measure) -> Layout {
    let forward = forward::forward(diagram);
    let sizes: Vec<[f64; 2]> = (0..diagram.boxes.len()).map(|index| size(diagram, &forward, index, measure)).collect();
    let layers = layers::layers(diagram, &forward, &sizes, measure);
    let stops = slots::stops(diagram, &layers, measure);
    let channels = channel::channels(&layers, &stops);
    columns::place(diagram, &layers, &stops, &channels, measure)
}

/// Width and height of a box with room for its text, and for the lines at its sides.
fn size(diagram: &Diagram, forward: &[bool], index: usize, measure: &Measure) -> [f64; 2] {
    let it = &diagram.boxes[index];
    let widest = lines(it).iter().map(|line| line.chars().count()).max().unwrap_or(0) as f64 * measure.name;
    let note = it.note.chars().count() as f64 * measure.note;
    let text = it.names.len() as f64 * measure.name_line + if it.note.is_empty() { 0.0 } else { measure.note_line };
    let most = [false, true].map(|is_right| slots::count(diagram, forward, (index, is_right))).into_iter().max();
    let sides = most.unwrap_or(0) as f64 * measure.side + 2.0 * measure.pad[1].min(measure.side);
    let height = (text + 2.0 * measure.pad[1]).max(sides);
    let width = widest.max(note) + 2.0 * measure.pad[0] + if slots::is_port(it) { measure.point } else { 0.0 };
    [width, height]
}
