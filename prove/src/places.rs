//! Which line of the printed Verilog has which statement.
//!
//! The part for formal tools and the part for simulators have the same statements in the same sequence, and the second
//! one prints the message: the number.

use std::collections::BTreeMap;
use tilewright_gen::VerilogFile;

/// The numbers of the statements, by file and line.
pub type Places = BTreeMap<(String, u32), usize>;

/// The part of a file that a line is in.
enum Part {
    Other,
    Formal,
    /// With the depth of conditions in it.
    Simulated(u32),
}

/// Finds all statements of the files.
pub fn places(files: &[VerilogFile]) -> Places {
    files
        .iter()
        .flat_map(|file| places_of(&file.text).map(|(line, number)| ((file.name.clone(), line), number)))
        .collect()
}

/// The line of each statement of a file, with its number.
fn places_of(text: &str) -> impl Iterator<Item = (u32, usize)> {
    let (mut lines, mut numbers, mut part) = (Vec::new(), Vec::new(), Part::Other);
    for (line, text) in (1..).zip(text.lines().map(str::trim)) {
        part = match part {
            Part::Other if text == "`ifdef FORMAL" => Part::Formal,
            Part::Formal if text == "`else" => Part::Simulated(0),
            Part::Simulated(0) if text == "`endif" => Part::Other,
            Part::Simulated(depth) if text == "`endif" => Part::Simulated(depth - 1),
            Part::Simulated(depth) if text.starts_with("`if") => Part::Simulated(depth + 1),
            part => part,
        };
        match part {
            Part::Formal if is_statement(text) => lines.push(line),
            Part::Simulated(_) => numbers.extend(number(text)),
            _ => {}
        }
    }
    assert_eq!(lines.len(), numbers.len(), "both parts have all statements:\n{text}");
    lines.into_iter().zip(numbers)
}

fn is_statement(line: &str) -> bool {
    let after = match line.strip_prefix("if (") {
        Some(rest) => rest.split_once(") ").map_or("", |(_, after)| after),
        None => line,
    };
    ["assert (", "assume (", "cover ("].iter().any(|word| after.starts_with(word))
}

/// The number in a message that a simulator prints.
fn number(line: &str) -> Option<usize> {
    if !line.starts_with("$display(\"FAIL: ") && !line.starts_with("$display(\"COVER: ") {
        return None;
    }
    line.rsplit_once('#')?.1.split_once('"')?.0.parse().ok()
}
