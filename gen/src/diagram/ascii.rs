//! A diagram in characters.

use super::layout::{Layout, Measure, Rect, layout, lines};
use super::model::{ArrowKind, BoxKind, Diagram, DiagramBox};
use std::collections::BTreeMap;

/// Sizes in characters. The padding of a box is its outline and a blank.
const CHARACTERS: Measure = Measure {
    name: 1.0,
    note: 1.0,
    label: 1.0,
    name_line: 1.0,
    note_line: 1.0,
    label_line: 2.0,
    pad: [2.0, 1.0],
    point: 0.0,
    box_gap: 1.0,
    line_gap: 1.0,
    side: 1.0,
    track: 2.0,
    channel: 3.0,
    frame: 0.0,
    frame_title: 0.0,
    is_whole: true,
};

pub(super) fn ascii(diagram: &Diagram) -> String {
    let diagram = flat(diagram);
    let layout = layout(&diagram, &CHARACTERS);
    let mut page = Page::default();
    page.draw_lines(&diagram, &layout);
    for (it, rect) in diagram.boxes.iter().zip(&layout.boxes) {
        page.draw_box(it, rect);
    }
    for (arrow, route) in diagram.arrows.iter().zip(&layout.routes) {
        if let Some(rect) = route.label {
            page.write(rect.x, rect.y, &arrow.label());
        }
    }
    format!("{}\n\n{}{}", diagram.title, page.text(), key(&diagram))
}

/// The diagram without frames and colours. Paths stand before names instead, and clocks in the notes.
fn flat(diagram: &Diagram) -> Diagram {
    let mut flat = diagram.clone();
    for it in &mut flat.boxes {
        let mut frame = it.frame.take();
        while let Some(index) = frame {
            it.names[0] = format!("{}.{}", diagram.frames[index].name, it.names[0]);
            frame = diagram.frames[index].frame;
        }
        let clocks: Vec<&str> = it.clocks.iter().map(|clock| diagram.clocks[*clock].as_str()).collect();
        if !clocks.is_empty() {
            let blank = if it.note.is_empty() { "" } else { " " };
            it.note += &format!("{blank}@{}", clocks.join(","));
        }
    }
    flat.frames.clear();
    flat
}

/// The characters of horizontal and vertical pieces.
fn strokes(kind: ArrowKind) -> [char; 2] {
    match kind {
        ArrowKind::Stream => ['=', '#'],
        ArrowKind::Data => ['-', '|'],
        ArrowKind::Control => ['.', ':'],
    }
}

fn key(diagram: &Diagram) -> String {
    let words = [(ArrowKind::Stream, "stream"), (ArrowKind::Control, "control")];
    let has = |kind: ArrowKind| diagram.arrows.iter().any(|arrow| arrow.kind == kind);
    let mut key: Vec<String> = words
        .iter()
        .filter(|(kind, _)| has(*kind))
        .map(|(kind, word)| format!("{} {word}", String::from_iter([strokes(*kind)[0]; 3])))
        .collect();
    key.extend(super::left_out(diagram));
    if key.is_empty() { String::new() } else { format!("\n{}\n", key.join("   ")) }
}

/// The line and column of a character.
type Cell = (i64, i64);

#[derive(Default)]
struct Page(BTreeMap<Cell, char>);

/// Whether lines pass a cell horizontally and vertically.
#[derive(Clone, Copy, Default)]
struct Passing {
    flat: bool,
    steep: bool,
}

impl Page {
    fn put(&mut self, x: i64, y: i64, what: char) {
        self.0.insert((y, x), what);
    }

    fn write(&mut self, x: f64, y: f64, words: &str) {
        words.chars().enumerate().for_each(|(i, c)| self.put(x as i64 + i as i64, y as i64, c));
    }

    fn draw_lines(&mut self, diagram: &Diagram, layout: &Layout) {
        // For each cell, the lines that pass it by their exits.
        let mut cells: BTreeMap<Cell, BTreeMap<usize, (Passing, ArrowKind)>> = BTreeMap::new();
        let mut heads = Vec::new();
        for (arrow, route) in diagram.arrows.iter().zip(&layout.routes) {
            let points = cells_of(&route.points);
            for pair in points.windows(2) {
                let [from, to] = [pair[0], pair[1]];
                let is_flat = from.0 == to.0;
                for cell in between(from, to) {
                    let of = cells.entry(cell).or_default().entry(route.exit);
                    let (passing, _) = of.or_insert((Passing::default(), arrow.kind));
                    passing.flat |= is_flat;
                    passing.steep |= !is_flat;
                }
            }
            if let [.., before, last] = points[..] {
                heads.push((last, if before.1 <= last.1 { '>' } else { '<' }));
            }
        }
        for ((y, x), lines) in cells {
            let steep = lines.values().find(|(passing, _)| !passing.flat);
            let (passing, kind) = *steep.or(lines.values().next()).expect("a cell is passed");
            let [flat, upright] = strokes(kind);
            let what = match (passing.flat, passing.steep) {
                (true, true) => '+',
                (true, false) => flat,
                _ => upright,
            };
            self.put(x, y, what);
        }
        heads.into_iter().for_each(|((y, x), head)| self.put(x, y, head));
    }

    fn draw_box(&mut self, it: &DiagramBox, rect: &Rect) {
        let (top, bottom) = (rect.y as i64, rect.bottom() as i64 - 1);
        let (left, right) = (rect.x as i64, rect.right() as i64 - 1);
        let [corners, edge] = match it.kind {
            BoxKind::Input | BoxKind::Output => ["..''", "-"],
            BoxKind::Memory => ["++++", "="],
            BoxKind::Register => ["++>+", "-"],
            BoxKind::Instance => ["++++", "-"],
            BoxKind::Net => ["()()", "-"],
        };
        for y in top..=bottom {
            for x in left..=right {
                let what = match (y == top || y == bottom, x == left || x == right) {
                    (true, true) => corners.as_bytes()[2 * usize::from(y == bottom) + usize::from(x == right)] as char,
                    (true, false) => edge.as_bytes()[0] as char,
                    (false, true) => '|',
                    _ => ' ',
                };
                self.put(x, y, what);
            }
        }
        let mut text = lines(it);
        text.extend(Some(it.note.clone()).filter(|note| !note.is_empty()));
        let first = top + (bottom - top + 1 - text.len() as i64) / 2;
        for (i, line) in text.iter().enumerate() {
            let x = left + (right - left + 1 - line.chars().count() as i64) / 2;
            self.write(x as f64, (first + i as i64) as f64, line);
        }
    }

    fn text(&self) -> String {
        let (mut text, mut at) = (String::new(), (0, 0));
        for ((y, x), what) in &self.0 {
            while at.0 < *y {
                text.truncate(text.trim_end_matches(' ').len());
                text.push('\n');
                at = (at.0 + 1, 0);
            }
            text.extend(std::iter::repeat_n(' ', (x - at.1) as usize));
            text.push(*what);
            at.1 = x + 1;
        }
        // ASCII has no multiplication sign.
        text.trim_end_matches(' ').replace('×', "x") + "\n"
    }
}

/// The cells of the corners; those of the ends lie beside the boxes.
fn cells_of(points: &[[f64; 2]]) -> Vec<Cell> {
    let mut cells: Vec<Cell> = points.iter().map(|[x, y]| (*y as i64, *x as i64)).collect();
    let last = cells.len() - 1;
    // The right edge of a box is the first cell outside, its left edge the first inside.
    if points[1][0] < points[0][0] {
        cells[0].1 -= 1;
    }
    if points[last - 1][0] < points[last][0] {
        cells[last].1 -= 1;
    }
    cells
}

/// All cells between two on one line or column.
fn between(from: Cell, to: Cell) -> impl Iterator<Item = Cell> {
    let (rows, columns) = (from.0.min(to.0)..=from.0.max(to.0), from.1.min(to.1)..=from.1.max(to.1));
    rows.flat_map(move |y| columns.clone().map(move |x| (y, x)))
}
