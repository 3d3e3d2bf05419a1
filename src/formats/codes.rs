//! Surfer's mapping files: the names of codes.
//!
//! A file has the format's name, the number of bits, and a line for each number: that of Surfer's page on mapping
//! translators.

use super::{FIRST_LINE, named};
use std::fmt::Write;
use tilewright_hdl::ir::Names;
use tilewright_sim::Simulation;

/// The file of each kind of code, by name.
pub(super) fn files(sim: &Simulation) -> Vec<(String, String)> {
    let signals = sim.program().hierarchy.scopes.iter().flat_map(|scope| &scope.signals);
    let mut kinds = Vec::new();
    for (names, width) in signals.filter_map(|signal| Some((signal.kind.names()?, signal.width))) {
        let kind = (names.of, (names, width));
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    named(kinds, |name, (names, width)| text(name, *names, *width))
}

fn text(name: &str, names: Names, width: u32) -> String {
    let mut text = format!("{FIRST_LINE}Name = {name}\nBits = {width}\n");
    for (code, value) in names.codes.iter().zip(names.values) {
        let _ = writeln!(text, "{value} {code}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_hdl::{Codes, codes};

    codes! { enum Phase { Idle = 0, Run = 2, Finished = 5 } }

    #[test]
    fn a_file_has_a_name_a_width_and_a_line_for_each_code() {
        let expected = "# Tilewright\nName = Phase\nBits = 3\n0 Idle\n2 Run\n5 Finished\n";
        assert_eq!(text("Phase", Phase::NAMES, 3), expected);
    }
}
