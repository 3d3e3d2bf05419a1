//! A receiver of DVI, for tests: it follows DVI 1.0, and knows nothing of the sender.

use std::fmt;

/// The bits that the lines sent: blue, green, red and the clock.
pub type Lines = [Vec<bool>; 4];

/// What a receiver sees in one period of the clock of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seen {
    /// A pixel: red, green, blue.
    Pixel([u8; 3]),
    /// No pixel, with the levels of the sync lines.
    Blank {
        /// The level of the sync line of rows.
        hsync: bool,
        /// The level of the sync line of frames.
        vsync: bool,
    },
}

/// Why a receiver would show nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotDvi(String);

impl fmt::Display for NotDvi {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

impl std::error::Error for NotDvi {}

/// The symbols of control 0 to 3, as section 3.2.2 prints them: the bit that is sent first stands first.
const CONTROL: [u16; 4] = [0b00_1010_1011, 0b11_0101_0100, 0b00_1010_1010, 0b11_0101_0101];

/// The symbol of the clock, as sent.
const CLOCK: u16 = 0b11_1110_0000;

/// The symbol that begins at a bit; the bit that is sent first is its highest one.
fn symbol(line: &[bool], at: usize) -> u16 {
    line[at..at + 10].iter().fold(0, |symbol, bit| symbol << 1 | u16::from(*bit))
}

fn control(symbol: u16) -> Option<usize> {
    CONTROL.iter().position(|known| *known == symbol)
}

/// Where symbols begin in a line: at eight symbols of control in a row. No pixels look like that.
fn alignment(line: &[bool]) -> Option<usize> {
    let begins = |at: &usize| (0..8).all(|place| control(symbol(line, at + 10 * place)).is_some());
    (0..line.len().saturating_sub(80)).find(begins).map(|at| at % 10)
}

/// The byte of a symbol: figure 3-6.
fn byte(symbol: u16) -> u8 {
    let sent = |place: u16| symbol >> (9 - place) & 1;
    let word = |place: u16| sent(place) ^ sent(9);
    let bit = |place: u16| if place == 0 { word(0) } else { word(place) ^ word(place - 1) ^ 1 ^ sent(8) };
    (0..8).map(|place| (bit(place) as u8) << place).sum()
}

/// What the lines show, from their first whole symbol on.
///
/// # Errors
///
/// The lines do not send what DVI 1.0 says.
pub fn received(lines: &Lines) -> Result<Vec<Seen>, NotDvi> {
    let wrong = |sentence: String| Err(NotDvi(sentence));
    // The lines are low until the first symbol.
    let Some(begin) = lines[3].iter().position(|bit| *bit) else { return wrong("the clock is silent".to_owned()) };
    let lines = lines.each_ref().map(|line| &line[begin..]);
    let starts = [0, 1, 2].map(|line| alignment(lines[line]));
    let (Some(start), true) = (starts[0], starts[0] == starts[1] && starts[1] == starts[2]) else {
        return wrong(format!("symbols do not begin together: {starts:?}"));
    };
    let mut seen = Vec::with_capacity(lines[0].len() / 10);
    for at in (start..lines[0].len().saturating_sub(9)).step_by(10) {
        let [blue, green, red, clock] = lines.map(|line| symbol(line, at));
        if clock != CLOCK {
            return wrong(format!("the clock sends {clock:010b} at bit {at}"));
        }
        seen.push(match [blue, green, red].map(control) {
            [None, None, None] => Seen::Pixel([red, green, blue].map(byte)),
            [Some(code), Some(0), Some(0)] => Seen::Blank { hsync: code & 1 == 1, vsync: code & 2 == 2 },
            mixed => return wrong(format!("pixels in some lines and control in others at bit {at}: {mixed:?}")),
        });
    }
    Ok(seen)
}

/// A frame: its rows, each with the colours of its pixels.
pub type Frame = Vec<Vec<[u8; 3]>>;

/// Where frames begin in what is seen: behind the pulse and the back porch. Its level is low.
pub fn beginnings(seen: &[Seen]) -> Vec<usize> {
    let pulses = |seen: &Seen| matches!(seen, Seen::Blank { vsync: false, .. });
    (1..seen.len()).filter(|at| pulses(&seen[at - 1]) && !pulses(&seen[*at])).collect()
}

/// The frames that were seen from their beginning to the beginning of the next one.
pub fn frames(seen: &[Seen]) -> Vec<Frame> {
    let frame = |bounds: &[usize]| {
        let rows = seen[bounds[0]..bounds[1]].split(|it| matches!(it, Seen::Blank { .. }));
        let colour = |it: &Seen| if let Seen::Pixel(colour) = it { *colour } else { unreachable!("blanks split rows") };
        rows.filter(|row| !row.is_empty()).map(|row| row.iter().map(colour).collect()).collect()
    };
    beginnings(seen).windows(2).map(frame).collect()
}
