//! GTKWave's save file: which signals it shows when it opens a waveform, in which format.

use crate::shell::{Exit, Failure};
use std::fmt::Write;
use std::fs::File;
use std::io::{self, BufReader};
use std::ops::Range;
use std::path::Path;
use vcd::{Header, Parser, Scope, ScopeItem, Var, VarType};

/// GTKWave's codes of number formats.
const BINARY: &str = "@28";
const HEXADECIMAL: &str = "@22";

/// The pixels in which the wave is to fit.
const PIXELS: u64 = 1000;

/// The save file of a waveform file that covers these picoseconds: it shows all of its time, and the signals of the top module, or
/// with `all` every signal.
///
/// # Errors
/// The waveform cannot be read back.
pub fn of(waveform: &Path, times: Range<u64>, all: bool) -> Result<String, Failure> {
    let unreadable = |error: io::Error| {
        let path = waveform.display();
        Failure::new(Exit::NoOutput, format!("{path}: cannot be read back ({error}): name a plain file"))
    };
    let mut parser = Parser::new(BufReader::new(File::open(waveform).map_err(unreadable)?));
    let header = parser.parse_header().map_err(unreadable)?;
    let name = waveform.file_name().unwrap_or_default().to_string_lossy();
    Ok(print(&header, &name, times, all))
}

fn print(header: &Header, name: &str, times: Range<u64>, all: bool) -> String {
    let start = times.start;
    // So many powers of two of picoseconds are a pixel; the marker at -1 is none.
    let zoom = (times.end.saturating_sub(start) / PIXELS + 1).next_power_of_two().ilog2();
    let mut text =
        format!("[*] Tilewright\n[dumpfile] \"{name}\"\n[timestart] {start}\n[size] 1400 700\n*-{zoom}.0 -1\n");
    for item in &header.items {
        if let ScopeItem::Scope(top) = item {
            let _ = writeln!(text, "[treeopen] {}.", top.identifier);
            show(&mut text, top, &top.identifier, all);
        }
    }
    text
}

fn show(text: &mut String, scope: &Scope, path: &str, all: bool) {
    let variables = || scope.items.iter().filter_map(|it| if let ScopeItem::Var(it) = it { Some(it) } else { None });
    let has_names = |of: &Var| {
        let twin = format!("{}_state", of.reference);
        variables().any(|it| it.var_type == VarType::String && it.reference == twin)
    };
    for variable in variables().filter(|it| !has_names(it)) {
        let format = if variable.size == 1 { BINARY } else { HEXADECIMAL };
        let index = variable.index.map_or_else(String::new, |index| index.to_string());
        let _ = writeln!(text, "{format}\n{path}.{}{index}", variable.reference);
    }
    for item in scope.items.iter().filter(|_| all) {
        if let ScopeItem::Scope(inner) = item {
            show(text, inner, &format!("{path}.{}", inner.identifier), all);
        }
    }
}
