//! The text of constraints in each dialect.

use super::chip::{Chip, ChipClock, Made, Ratio};
use super::pins::Row;
use super::{Dialect, Pins};

/// The whole text.
pub fn print(chip: &Chip, dialect: Dialect, pins: &Pins) -> String {
    let clocks = chip.clocks.iter().map(|it| clock(it, dialect)).collect();
    let rows = pins.rows().iter().map(|row| pin(row, dialect)).collect();
    let title = vec![format!("# The constraints of `{}`.", chip.name)];
    let sections = [title, clocks, crossings(chip, dialect), rows].into_iter().filter(|lines| !lines.is_empty());
    sections.map(|lines| lines.join("\n") + "\n").collect::<Vec<_>>().join("\n")
}

/// The period of a clock.
fn clock(ChipClock { net, period, made }: &ChipClock, dialect: Dialect) -> String {
    let picoseconds = period.picoseconds();
    match dialect {
        Dialect::Lpf => {
            let what = if made.is_some() { "NET" } else { "PORT" };
            format!("FREQUENCY {what} \"{net}\" {} MHZ;", megahertz(picoseconds))
        }
        Dialect::Pcf => format!("set_frequency {net} {}", megahertz(picoseconds)),
        Dialect::Sdc | Dialect::Xdc => match made {
            Some(Made { pin, source: Some((source, ratio)) }) => {
                let ratio = match ratio {
                    Ratio::Times(number) => format!("-multiply_by {number}"),
                    Ratio::Part(number) => format!("-divide_by {number}"),
                };
                format!(
                    "create_generated_clock -name {net} -source [get_pins {{{source}}}] {ratio} [get_pins {{{pin}}}]"
                )
            }
            Some(Made { pin, source: None }) => created(net, picoseconds, &format!("[get_pins {{{pin}}}]")),
            None => created(net, picoseconds, &format!("[get_ports {{{net}}}]")),
        },
    }
}

fn created(net: &str, picoseconds: u64, at: &str) -> String {
    format!("create_clock -name {net} -period {} {at}", nanoseconds(picoseconds))
}

/// The limits of paths from each clock to each other one.
fn crossings(chip: &Chip, dialect: Dialect) -> Vec<String> {
    let pairs = chip.clocks.iter().flat_map(|from| chip.clocks.iter().map(move |to| (from, to)));
    let pairs: Vec<_> = pairs.filter(|(from, to)| from.net != to.net).collect();
    if pairs.is_empty() {
        return Vec::new();
    }
    let mut lines = vec![
        "# Clocks cross by synchronizers, by memories with a port on each clock, and by signals that are stable."
            .to_owned(),
    ];
    match dialect {
        Dialect::Lpf | Dialect::Pcf => {
            lines.push("# nextpnr reports the delay of such a path, and has no command for a limit.".to_owned())
        }
        Dialect::Sdc | Dialect::Xdc => {
            lines.push("# Such a path takes one period of the faster clock at most.".to_owned());
            lines.extend(pairs.into_iter().flat_map(|(from, to)| crossing(from, to, dialect)));
        }
    }
    lines
}

/// The limit of paths from a clock to another one.
fn crossing(from: &ChipClock, to: &ChipClock, dialect: Dialect) -> Vec<String> {
    let limit = nanoseconds(from.period.min(to.period).picoseconds());
    let path = format!("-from [get_clocks {{{}}}] -to [get_clocks {{{}}}]", from.net, to.net);
    match dialect {
        // The delays of the clocks themselves do not count, nor does what is too early.
        Dialect::Xdc => vec![format!("set_max_delay -datapath_only {path} {limit}")],
        _ => vec![format!("set_max_delay {path} {limit}"), format!("set_false_path -hold {path}")],
    }
}

/// The pin of a port with its settings.
fn pin(Row { port, pin, io_type, pull_up, settings, .. }: &Row, dialect: Dialect) -> String {
    let pull = pull_up.map(|up| if up { "UP" } else { "DOWN" });
    let others = settings.iter().map(|(name, value)| (name.clone(), value.clone()));
    match dialect {
        Dialect::Lpf => {
            let io_type = io_type.iter().map(|word| ("IO_TYPE".to_owned(), word.clone()));
            let pull = pull.iter().map(|word| ("PULLMODE".to_owned(), (*word).to_owned()));
            let settings = io_type.chain(pull).chain(others).map(|(name, value)| format!(" {name}={value}"));
            let settings: String = settings.collect();
            let located = format!("LOCATE COMP \"{port}\" SITE \"{pin}\";");
            if settings.is_empty() { located } else { format!("{located}\nIOBUF PORT \"{port}\"{settings};") }
        }
        Dialect::Xdc => {
            let io_type = io_type.iter().map(|word| ("IOSTANDARD".to_owned(), word.clone()));
            let pull = pull.iter().map(|word| ("PULLTYPE".to_owned(), format!("PULL{word}")));
            let located = [("PACKAGE_PIN".to_owned(), pin.clone())].into_iter();
            let all = located.chain(io_type).chain(pull).chain(others).map(|(name, value)| format!("{name} {value}"));
            format!("set_property -dict {{{}}} [get_ports {{{port}}}]", all.collect::<Vec<_>>().join(" "))
        }
        Dialect::Pcf if *pull_up == Some(true) => format!("set_io -pullup yes {port} {pin}"),
        Dialect::Pcf => format!("set_io {port} {pin}"),
        Dialect::Sdc => unreachable!("SDC has no pins"),
    }
}

/// A period in nanoseconds, exactly.
fn nanoseconds(picoseconds: u64) -> String {
    decimal(u128::from(picoseconds), 3)
}

/// A frequency in MHz, to the hertz above: a constraint is not looser than the description.
fn megahertz(picoseconds: u64) -> String {
    decimal(1_000_000_000_000u128.div_ceil(u128::from(picoseconds)), 6)
}

/// A number of thousandths, or of other decimal parts, without zeros at its end.
fn decimal(parts: u128, places: usize) -> String {
    let digits = format!("{parts:0width$}", width = places + 1);
    let (whole, part) = digits.split_at(digits.len() - places);
    let part = part.trim_end_matches('0');
    if part.is_empty() { whole.to_owned() } else { format!("{whole}.{part}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_and_frequencies_are_exact() {
        assert_eq!([40_000, 39_722, 2, 83_334].map(nanoseconds), ["40", "39.722", "0.002", "83.334"]);
        assert_eq!([40_000, 8_000, 39_722, 83_334].map(megahertz), ["25", "125", "25.174967", "11.999905"]);
    }
}
