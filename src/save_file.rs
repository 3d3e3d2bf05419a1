//! GTKWave's save file: the signals that it shows when it opens a waveform, and their formats.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::ops::Range;
use std::path::Path;
use vcd::{Header, Parser, Scope, ScopeItem, Var, VarType};

/// GTKWave's codes of number formats.
const BINARY: &str = "@28";
const HEXADECIMAL: &str = "@22";

/// The first line of every file that Tilewright writes; GTKWave writes another.
pub const FIRST_LINE: &str = "[*] Tilewright\n";

/// GTKWave's zoom is the power of two of the time that this many pixels show.
const STRETCH: f64 = 200.0;
/// The width of the wave that a window of 1400 pixels has beside long names, in pixels.
const WIDTH: f64 = 900.0;

/// The save file for a waveform with that header and these picoseconds. It shows the whole time, and the signals of the top module, or with
/// `all` every signal.
///
/// # Panics
/// The header is not one that the simulation writes.
pub fn of(waveform: &Path, header: &[u8], times: Range<u64>, all: bool) -> String {
    let header = Parser::new(header).parse_header().expect("the simulation writes sound headers");
    let name = waveform.file_name().unwrap_or_default().to_string_lossy();
    print(&header, &name, times, all)
}

fn print(header: &Header, name: &str, times: Range<u64>, all: bool) -> String {
    let start = times.start;
    let zoom = zoom(times.end.saturating_sub(start));
    // -1 means that there is no marker.
    let mut text = format!("{FIRST_LINE}[dumpfile] \"{name}\"\n[timestart] {start}\n[size] 1400 700\n*-{zoom:.2} -1\n");
    for item in &header.items {
        if let ScopeItem::Scope(top) = item {
            let _ = writeln!(text, "[treeopen] {}.", top.identifier);
        }
    }
    for (path, variable) in shown(header, all) {
        let format = if variable.size == 1 { BINARY } else { HEXADECIMAL };
        let index = variable.index.map_or_else(String::new, |index| index.to_string());
        let _ = writeln!(text, "{format}\n{path}.{}{index}", variable.reference);
    }
    text
}

/// The variables that a viewer shows at first, each with the path of its scope: those of the top module, or all. Of a code there is
/// its name alone, and not the number.
pub fn shown(header: &Header, all: bool) -> Vec<(String, &Var)> {
    let mut variables = Vec::new();
    for item in &header.items {
        if let ScopeItem::Scope(top) = item {
            add(&mut variables, top, &top.identifier, all);
        }
    }
    variables
}

/// The zoom at which the whole duration, in picoseconds, fits into [`WIDTH`]: [`STRETCH`] pixels show 2^zoom picoseconds.
fn zoom(duration: u64) -> f64 {
    (duration.max(1) as f64 * STRETCH / WIDTH).log2().max(0.0)
}

fn add<'a>(shown: &mut Vec<(String, &'a Var)>, scope: &'a Scope, path: &str, all: bool) {
    let variables = || scope.items.iter().filter_map(|it| if let ScopeItem::Var(it) = it { Some(it) } else { None });
    let names =
        variables().filter(|it| it.var_type == VarType::String).filter_map(|it| it.reference.strip_suffix("_state"));
    let named: BTreeSet<&str> = names.collect();
    let chosen = variables().filter(|it| !named.contains(it.reference.as_str()));
    shown.extend(chosen.map(|it| (path.to_owned(), it)));
    for item in scope.items.iter().filter(|_| all) {
        if let ScopeItem::Scope(inner) = item {
            add(shown, inner, &format!("{path}.{}", inner.identifier), all);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// GTKWave 3.3 shows a time of 2^z in 200 pixels, so at zoom 12 a picosecond is 0.0488 pixels.
    #[test]
    fn the_whole_duration_fits_into_the_window() {
        for duration in [1, 300, 3_520_000, 66_700_000_000] {
            let shown = zoom(duration).exp2() / STRETCH * WIDTH;
            assert!(shown >= duration as f64 * 0.999, "{duration} ps: {shown} are shown");
            assert!(shown <= (duration as f64 * 1.001).max(WIDTH / STRETCH), "{duration} ps: {shown} are shown");
        }
    }
}
