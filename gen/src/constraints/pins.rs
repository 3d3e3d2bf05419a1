//! The table of pins: which port is at which pin of the chip.

use super::Dialect;
use std::collections::BTreeMap;
use std::fmt;

/// The pins of a chip: a table in a text, a row for each bit of a port.
///
/// A row has the port, the pin, and settings. `led[0]` is a bit of a port of several bits. `#` begins a comment. The
/// settings are, in any sequence:
///
/// - the io type, such as `LVCMOS33`,
/// - `pull-up` or `pull-down`,
/// - others in the words of the dialect, such as `DRIVE=4`.
///
/// ```
/// use tilewright_gen::Pins;
///
/// let pins = Pins::read("
///     clk   G2  LVCMOS33           # 25 MHz
///     led   B2  LVCMOS33  DRIVE=4
///     sda   B19 LVCMOS33  pull-up
/// ");
/// assert!(pins.is_ok());
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Pins {
    rows: Vec<Row>,
}

/// A bit of a port at its pin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    line: usize,
    /// The port, or a bit of it.
    pub port: String,
    pub pin: String,
    pub io_type: Option<String>,
    /// True for a pull-up, false for a pull-down.
    pub pull_up: Option<bool>,
    /// The other settings.
    pub settings: Vec<(String, String)>,
}

/// What is wrong with one row, or with a port that has none.
///
/// ```
/// let wrong = tilewright_gen::Pins::read("clk G2\nled G2").unwrap_err();
/// assert_eq!(wrong.0[0].line, Some(2));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PinProblem {
    /// The line of the row, from 1 on.
    pub line: Option<usize>,
    /// A sentence with a remedy.
    pub message: String,
}

/// All that is wrong with a table of pins.
///
/// ```
/// let wrong = tilewright_gen::Pins::read("clk").unwrap_err();
/// assert_eq!(wrong.to_string(), "line 1: `clk` has no pin: write the pin behind the port, as in `clk G2`");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PinProblems(pub Vec<PinProblem>);

impl fmt::Display for PinProblem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.message),
            None => write!(f, "{}", self.message),
        }
    }
}

impl fmt::Display for PinProblems {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let lines: Vec<String> = self.0.iter().map(PinProblem::to_string).collect();
        write!(f, "{}", lines.join("\n"))
    }
}

impl std::error::Error for PinProblems {}

impl Pins {
    /// No pins: a placer chooses them, or another file names them.
    ///
    /// ```
    /// assert_eq!(Ok(tilewright_gen::Pins::none()), tilewright_gen::Pins::read(""));
    /// ```
    pub fn none() -> Pins {
        Pins::default()
    }

    /// The table of a text.
    ///
    /// ```
    /// use tilewright_gen::Pins;
    ///
    /// let wrong = Pins::read("tx 8\ntx 9").unwrap_err();
    /// assert_eq!(wrong.to_string(), "line 2: port `tx` is given twice, first in line 1: give it one pin");
    /// ```
    ///
    /// # Errors
    ///
    /// Every row that is malformed, or that repeats a port or a pin.
    pub fn read(text: &str) -> Result<Pins, PinProblems> {
        let (mut rows, mut problems): (Vec<Row>, Vec<PinProblem>) = (Vec::new(), Vec::new());
        for (index, line) in text.lines().enumerate() {
            let words: Vec<&str> = line.split('#').next().unwrap_or_default().split_whitespace().collect();
            let line = index + 1;
            let row = match row(line, &words) {
                Ok(Some(row)) => row,
                Ok(None) => continue,
                Err(message) => {
                    problems.push(PinProblem { line: Some(line), message });
                    continue;
                }
            };
            problems.extend(rows.iter().find_map(|before| row.clashes(before)));
            rows.push(row);
        }
        if problems.is_empty() { Ok(Pins { rows }) } else { Err(PinProblems(problems)) }
    }

    /// The rows.
    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Whether the rows fit these ports, given with their widths, and the dialect.
    pub(super) fn check(&self, ports: &[(String, u32)], dialect: Dialect) -> Result<(), PinProblems> {
        if self.rows.is_empty() {
            return Ok(());
        }
        let widths: BTreeMap<&str, u32> = ports.iter().map(|(name, width)| (name.as_str(), *width)).collect();
        let mut problems: Vec<PinProblem> = Vec::new();
        for row in &self.rows {
            let messages = row.misplaced(&widths).into_iter().chain(row.unsaid(dialect));
            problems.extend(messages.map(|message| PinProblem { line: Some(row.line), message }));
        }
        // A misspelt row is the likely reason for a port without a pin.
        if problems.is_empty() {
            let bits = ports.iter().flat_map(|(name, width)| bits(name, *width));
            let without = bits.filter(|bit| self.rows.iter().all(|row| row.port != *bit));
            let message = |bit: String| format!("port `{bit}` has no pin: add the row `{bit} PIN`");
            problems.extend(without.map(|bit| PinProblem { line: None, message: message(bit) }));
        }
        if problems.is_empty() { Ok(()) } else { Err(PinProblems(problems)) }
    }
}

/// The row of these words; none for no words.
fn row(line: usize, words: &[&str]) -> Result<Option<Row>, String> {
    let (port, pin, more) = match words {
        [] => return Ok(None),
        [port] => return Err(format!("`{port}` has no pin: write the pin behind the port, as in `{port} G2`")),
        [port, pin, more @ ..] => (port, pin, more),
    };
    // They would end a word of a dialect.
    if let Some(word) = words.iter().find(|word| word.contains(['"', ';', '{', '}', '\\', '$'])) {
        return Err(format!("`{word}` is no port, pin or setting: use letters, digits, `_`, `[`, `]`, `-` and `.`"));
    }
    let (port, pin) = ((*port).to_owned(), (*pin).to_owned());
    let mut row = Row { line, port, pin, io_type: None, pull_up: None, settings: Vec::new() };
    for word in more {
        let twice = match (word.split_once('='), *word) {
            (Some((name, value)), _) if name.is_empty() || value.is_empty() => {
                return Err(format!("`{word}` is no setting: write it as NAME=VALUE, such as `DRIVE=4`"));
            }
            (Some((name, value)), _) => {
                row.settings.push((name.to_owned(), value.to_owned()));
                row.settings.iter().filter(|(known, _)| known == name).count() > 1
            }
            (None, "pull-up" | "pull-down") => row.pull_up.replace(*word == "pull-up").is_some(),
            (None, _) => row.io_type.replace((*word).to_owned()).is_some(),
        };
        if twice {
            return Err(format!(
                "`{word}` is the second setting of its kind: give one io type, pull and NAME=VALUE each"
            ));
        }
    }
    Ok(Some(row))
}

impl Row {
    /// What it repeats of a row before it.
    fn clashes(&self, before: &Row) -> Option<PinProblem> {
        let (port, pin, line) = (&self.port, &self.pin, before.line);
        let message = match () {
            () if *port == before.port => {
                format!("port `{port}` is given twice, first in line {line}: give it one pin")
            }
            () if *pin == before.pin => {
                format!("pin `{pin}` is that of `{}` in line {line}: give each port a pin of its own", before.port)
            }
            () => return None,
        };
        Some(PinProblem { line: Some(self.line), message })
    }

    /// How its port is none of the chip.
    fn misplaced(&self, widths: &BTreeMap<&str, u32>) -> Option<String> {
        let (name, bit) = match self.port.strip_suffix(']').and_then(|port| port.rsplit_once('[')) {
            Some((name, bit)) => (name, Some(bit)),
            None => (self.port.as_str(), None),
        };
        let Some(&width) = widths.get(name) else {
            let nearest = widths.keys().max_by(|a, b| likeness(a, name).total_cmp(&likeness(b, name)));
            let nearest = nearest.filter(|known| likeness(known, name) > 0.75);
            let remedy = match nearest {
                Some(known) => format!("did you mean `{known}`?"),
                None => format!("its ports are `{}`", widths.keys().copied().collect::<Vec<_>>().join("`, `")),
            };
            return Some(format!("the chip has no port `{name}`: {remedy}"));
        };
        match bit {
            None if width == 1 => None,
            None => {
                Some(format!("`{name}` has {width} bits: write a row for each, `{name}[0]` to `{name}[{}]`", width - 1))
            }
            Some(_) if width == 1 => Some(format!("`{name}` has one bit: write `{name}`")),
            Some(bit) if bits(name, width).any(|known| known == format!("{name}[{bit}]")) => None,
            Some(bit) => {
                Some(format!("`{name}` has no bit `{bit}`: its bits are `{name}[0]` to `{name}[{}]`", width - 1))
            }
        }
    }

    /// What the dialect cannot say of it.
    fn unsaid(&self, dialect: Dialect) -> Option<String> {
        let setting = self.settings.first().map(|(name, value)| format!("{name}={value}"));
        let word = self.io_type.clone().or(setting).or((self.pull_up == Some(false)).then(|| "pull-down".to_owned()));
        match (dialect, word) {
            (Dialect::Sdc, _) => Some("SDC has no pins: leave them out, or write XDC, LPF or PCF".to_owned()),
            (Dialect::Pcf, Some(word)) => Some(format!("PCF knows `pull-up` alone: leave out `{word}`")),
            _ => None,
        }
    }
}

fn likeness(a: &str, b: &str) -> f64 {
    strsim::jaro_winkler(a, b)
}

/// A port's bits as rows name them.
fn bits(name: &str, width: u32) -> impl Iterator<Item = String> {
    (0..width).map(move |bit| if width == 1 { name.to_owned() } else { format!("{name}[{bit}]") })
}
