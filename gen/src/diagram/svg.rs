//! A diagram as SVG.

use super::layout::{Layout, Measure, Rect, layout, lines, stack};
use super::model::{Arrow, ArrowKind, BoxKind, Diagram, DiagramBox};
use std::fmt::Write;

/// Sizes in pixels, for fonts of 12 and 10 pixels. Characters of common fonts are at most 0.61 of that wide.
pub(super) const PIXELS: Measure = Measure {
    name: 7.3,
    note: 6.2,
    label: 6.1,
    name_line: 15.0,
    note_line: 13.0,
    label_line: 26.0,
    pad: [9.0, 6.0],
    point: 9.0,
    box_gap: 18.0,
    line_gap: 11.0,
    side: 9.0,
    track: 8.0,
    channel: 16.0,
    frame: 12.0,
    frame_title: 30.0,
    is_whole: false,
};

/// The margin, and the height of the title and of the key.
const MARGIN: f64 = 16.0;
const TITLE: f64 = 24.0;
const KEY: f64 = 20.0;

/// The offset of the boxes stacked behind an array.
const STACK: f64 = 4.0;

const STYLE: &str = include_str!("style.css");

/// The number of clock colours.
const COLOURS: usize = 6;

pub(super) fn svg(diagram: &Diagram) -> String {
    drawn(diagram, &layout(diagram, &PIXELS), false)
}

pub(super) fn narrow_svg(diagram: &Diagram) -> String {
    drawn(diagram, &stack(diagram, &PIXELS), true)
}

fn drawn(diagram: &Diagram, layout: &Layout, is_narrow: bool) -> String {
    let mut picture = Picture { text: String::new(), is_narrow };
    // Writing to a string does not fail.
    let _ = picture.draw(diagram, layout);
    picture.text
}

struct Picture {
    text: String,
    /// All lines are on the right of the boxes, and the key has several lines.
    is_narrow: bool,
}

impl Picture {
    fn draw(&mut self, diagram: &Diagram, layout: &Layout) -> std::fmt::Result {
        let key = key(diagram);
        let widest = |text: &str, one: f64| text.chars().count() as f64 * one;
        let keys = key.iter().map(|(_, words)| 28.0 + widest(words, PIXELS.note));
        let keys: f64 = if self.is_narrow { keys.fold(0.0, f64::max) } else { keys.sum() };
        let inner = (layout.width + 2.0 * STACK).max(widest(&diagram.title, PIXELS.name)).max(keys);
        let key = key_lines(key, inner);
        let key_room = key.len() as f64 * KEY;
        let width = (inner + 2.0 * MARGIN).ceil();
        let height = (layout.height + 2.0 * MARGIN + TITLE + key_room + STACK).ceil();
        let title = escaped(&diagram.title);
        writeln!(
            self.text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"diagram\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\">"
        )?;
        writeln!(self.text, "<title>{title}</title>\n<style>\n{STYLE}</style>")?;
        writeln!(self.text, "<rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>")?;
        writeln!(self.text, "<text class=\"title\" x=\"{MARGIN}\" y=\"{}\">{title}</text>", number(MARGIN + 10.0))?;
        let (x, y) = (MARGIN + (inner - layout.width) / 2.0, MARGIN + TITLE + STACK);
        writeln!(self.text, "<g transform=\"translate({} {})\">", number(x), number(y))?;
        for (frame, rect) in diagram.frames.iter().zip(&layout.frames) {
            let count = if frame.count.is_empty() { String::new() } else { format!(" ×{}", frame.count) };
            self.rect("frame", rect, 3.0)?;
            self.words("name", rect.x + PIXELS.pad[0], rect.y + 15.0, &format!("{}{count}", frame.name))?;
        }
        for (arrow, route) in diagram.arrows.iter().zip(&layout.routes) {
            self.line(diagram, arrow, &route.points)?;
        }
        for ([x, y], arrow) in &layout.dots {
            let is_stream = diagram.arrows[*arrow].kind == ArrowKind::Stream;
            let (class, radius) = if is_stream { ("head stream", 4.0) } else { ("head", 2.4) };
            let [x, y] = [*x, *y].map(number);
            writeln!(self.text, "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>")?;
        }
        for (it, rect) in diagram.boxes.iter().zip(&layout.boxes) {
            self.draw_box(it, rect)?;
        }
        for (arrow, route) in diagram.arrows.iter().zip(&layout.routes) {
            if let Some(rect) = route.label {
                self.words("label middle", rect.middle()[0], rect.bottom() - 5.5, &arrow.label())?;
            }
        }
        writeln!(self.text, "</g>")?;
        for (line, key) in key.iter().rev().enumerate() {
            self.draw_key(key, height - MARGIN + 2.0 - line as f64 * KEY)?;
        }
        writeln!(self.text, "</svg>")
    }

    fn draw_box(&mut self, it: &DiagramBox, rect: &Rect) -> std::fmt::Result {
        writeln!(self.text, "<g><title>{}</title>", escaped(&it.members.join("\n")))?;
        let class = class(it);
        if !it.count.is_empty() {
            for step in [2.0, 1.0] {
                let [dx, dy] = [step * STACK, step * STACK];
                let behind = Rect { x: rect.x + dx, y: rect.y - dy, width: rect.width - 2.0 * dx, ..*rect };
                self.outline(it, &format!("behind {class}"), &behind)?;
            }
        }
        self.outline(it, &class, rect)?;
        match it.kind {
            BoxKind::Memory => {
                let (x, y) = (number(rect.x + 5.0), number(rect.y + 5.0));
                let (right, bottom) = (number(rect.right()), number(rect.bottom()));
                writeln!(
                    self.text,
                    "<path class=\"box memory inner\" d=\"M{x} {} V{bottom} M{} {y} H{right}\"/>",
                    number(rect.y),
                    number(rect.x)
                )?;
            }
            BoxKind::Register => {
                let clock = it.clocks.first().map_or(String::new(), |clock| format!(" clock{}", clock % COLOURS));
                let (x, y) = (number(rect.x), rect.bottom());
                writeln!(self.text, "<path class=\"box inner{clock}\" d=\"M{x} {} l6 -4 l-6 -4\"/>", number(y - 2.0))?;
            }
            _ => {}
        }
        if it.kind != BoxKind::Register {
            for (i, clock) in it.clocks.iter().enumerate() {
                let (x, y) = (rect.right() - 9.0 - 9.0 * i as f64, rect.bottom() - 3.0);
                writeln!(
                    self.text,
                    "<path class=\"tick clock{}\" d=\"M{} {} h6\"/>",
                    clock % COLOURS,
                    number(x),
                    number(y)
                )?;
            }
        }
        self.draw_text(it, rect)?;
        writeln!(self.text, "</g>")
    }

    /// The shape of a box. Ports point in the direction of their data.
    fn outline(&mut self, it: &DiagramBox, class: &str, rect: &Rect) -> std::fmt::Result {
        match it.kind {
            BoxKind::Output if self.is_narrow => {
                let [x, y, right, bottom] = [rect.x, rect.y, rect.right(), rect.bottom()].map(number);
                let (shoulder, middle) = (number(rect.x + PIXELS.point), number(rect.middle()[1]));
                writeln!(
                    self.text,
                    "<path class=\"{class}\" d=\"M{right} {y} H{shoulder} L{x} {middle} L{shoulder} {bottom} H{right} Z\"/>"
                )
            }
            BoxKind::Input | BoxKind::Output => {
                let [x, y, right, bottom] = [rect.x, rect.y, rect.right(), rect.bottom()].map(number);
                let (shoulder, middle) = (number(rect.right() - PIXELS.point), number(rect.middle()[1]));
                writeln!(
                    self.text,
                    "<path class=\"{class}\" d=\"M{x} {y} H{shoulder} L{right} {middle} L{shoulder} {bottom} H{x} Z\"/>"
                )
            }
            BoxKind::Net => self.rect(class, rect, rect.height / 2.0),
            BoxKind::Instance => self.rect(class, rect, 3.0),
            BoxKind::Memory | BoxKind::Register => self.rect(class, rect, 0.0),
        }
    }

    fn draw_text(&mut self, it: &DiagramBox, rect: &Rect) -> std::fmt::Result {
        let names = lines(it);
        let note = if it.note.is_empty() { 0.0 } else { PIXELS.note_line };
        let point = match it.kind {
            BoxKind::Output if self.is_narrow => -PIXELS.point / 2.0,
            BoxKind::Input | BoxKind::Output => PIXELS.point / 2.0,
            _ => 0.0,
        };
        let (x, height) = (rect.middle()[0] - point, names.len() as f64 * PIXELS.name_line + note);
        let top = rect.middle()[1] - height / 2.0;
        for (i, name) in names.iter().enumerate() {
            self.words("name middle", x, top + 11.5 + i as f64 * PIXELS.name_line, name)?;
        }
        if it.note.is_empty() {
            return Ok(());
        }
        self.words("note middle", x, top + height - 3.0, &it.note)
    }

    fn line(&mut self, diagram: &Diagram, arrow: &Arrow, points: &[[f64; 2]]) -> std::fmt::Result {
        let kind = match arrow.kind {
            ArrowKind::Stream => " stream",
            ArrowKind::Data => "",
            ArrowKind::Control => " control",
        };
        let (Some(last), Some(before)) = (points.last(), points.iter().rev().nth(1)) else { return Ok(()) };
        let size = if arrow.kind == ArrowKind::Stream { 9.0 } else { 7.0 };
        let back = if before[0] <= last[0] { -size } else { size };
        let mut path = format!("M{} {}", number(points[0][0]), number(points[0][1]));
        for pair in points.windows(2) {
            let x = if pair[1] == *last { pair[1][0] + back * 0.7 } else { pair[1][0] };
            match pair[0][0] == pair[1][0] {
                true => write!(path, " V{}", number(pair[1][1]))?,
                false => write!(path, " H{}", number(x))?,
            }
        }
        let name = |index: usize| diagram.boxes[index].names.join(", ");
        let signals = if arrow.signals.is_empty() { String::new() } else { format!(": {}", arrow.signals.join(", ")) };
        let title = escaped(&format!("{} → {}{signals}", name(arrow.from), name(arrow.to)));
        writeln!(self.text, "<g><title>{title}</title><path class=\"line{kind}\" d=\"{path}\"/>")?;
        let (x, y) = (number(last[0]), number(last[1]));
        writeln!(
            self.text,
            "<path class=\"head{kind}\" d=\"M{x} {y} l{} {} v{} Z\"/></g>",
            number(back),
            number(-size * 0.45),
            number(size * 0.9)
        )
    }

    /// A line of the key of colours and line styles.
    fn draw_key(&mut self, key: &[Key], y: f64) -> std::fmt::Result {
        let mut x = MARGIN;
        for (class, words) in key {
            if !class.is_empty() {
                writeln!(self.text, "<path class=\"{class}\" d=\"M{} {} h16\"/>", number(x), number(y - 3.5))?;
                x += 20.0;
            }
            self.words("key", x, y, words)?;
            x += 8.0 + words.chars().count() as f64 * PIXELS.note;
        }
        Ok(())
    }

    fn rect(&mut self, class: &str, rect: &Rect, round: f64) -> std::fmt::Result {
        let [x, y, width, height] = [rect.x, rect.y, rect.width, rect.height].map(number);
        let round = if round > 0.0 { format!(" rx=\"{}\"", number(round)) } else { String::new() };
        writeln!(
            self.text,
            "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{round}/>"
        )
    }

    fn words(&mut self, class: &str, x: f64, y: f64, words: &str) -> std::fmt::Result {
        writeln!(self.text, "<text class=\"{class}\" x=\"{}\" y=\"{}\">{}</text>", number(x), number(y), escaped(words))
    }
}

fn class(it: &DiagramBox) -> String {
    let kind = match it.kind {
        BoxKind::Input | BoxKind::Output => "box port",
        BoxKind::Instance => "box instance",
        BoxKind::Memory => "box memory",
        BoxKind::Register => "box register",
        BoxKind::Net => "box net",
    };
    let kind = format!("{kind}{}", if it.is_focus { " focus" } else { "" });
    match it.clocks[..] {
        [clock] if it.kind != BoxKind::Instance => format!("{kind} clock{}", clock % COLOURS),
        _ => kind,
    }
}

/// An entry of the key: the class of its sample, and its words.
type Key = (String, String);

/// The key in lines of at most that width.
fn key_lines(key: Vec<Key>, width: f64) -> Vec<Vec<Key>> {
    let (mut lines, mut used): (Vec<Vec<Key>>, f64) = (Vec::new(), 0.0);
    for entry in key {
        let wide = 28.0 + entry.1.chars().count() as f64 * PIXELS.note;
        match lines.last_mut().filter(|_| used + wide <= width) {
            Some(line) => line.push(entry),
            None => {
                lines.push(vec![entry]);
                used = 0.0;
            }
        }
        used += wide;
    }
    lines
}

/// The entries of the key.
fn key(diagram: &Diagram) -> Vec<Key> {
    let clocks = diagram.clocks.iter().enumerate();
    let mut key: Vec<Key> =
        clocks.map(|(i, name)| (format!("tick clock{}", i % COLOURS), format!("clock {name}"))).collect();
    let has = |kind: ArrowKind| diagram.arrows.iter().any(|arrow| arrow.kind == kind);
    let kinds = [(ArrowKind::Stream, "line stream", "stream"), (ArrowKind::Control, "line control", "control")];
    key.extend(kinds.into_iter().filter(|it| has(it.0)).map(|(_, class, word)| (class.to_owned(), word.to_owned())));
    key.extend(super::left_out(diagram).map(|words| (String::new(), words)));
    key
}

/// A number with at most one decimal.
fn number(number: f64) -> String {
    let rounded = (number * 10.0).round() / 10.0;
    // Not `-0`.
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
