//! What is written by hand is proved equal to the designs, at a small size and for all runs that begin with a reset.

use std::path::Path;
use tilewright_benches::RESET_CYCLES;
use tilewright_benches::designs::{Pim, Qt, Simd};
use tilewright_gen::tools::skipped_without;
use tilewright_hdl::{Block, elaborate};
use tilewright_prove::{Equivalence, Verdict};

/// What is found of a file of which a part may be changed.
#[track_caller]
fn verdict<B: Block>(
    block: &B,
    file: &str,
    parameters: &[(&str, i64)],
    mutant: Option<(&str, &str)>,
) -> Option<Verdict> {
    if skipped_without(&["yosys", "yosys-abc"]).is_some() {
        return None;
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("verilog").join(file);
    let folder = tempfile::tempdir().unwrap();
    let mut text = std::fs::read_to_string(path).unwrap();
    if let Some((from, to)) = mutant {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let copy = folder.path().join(file);
    std::fs::write(&copy, text).unwrap();
    let asked = Equivalence::to([copy]).begin("rst", 1).begin_clocks(RESET_CYCLES as u32).seconds(600);
    let asked = parameters.iter().fold(asked, |asked, (name, value)| asked.parameter(*name, *value));
    Some(asked.prove(&elaborate(block).unwrap()).unwrap())
}

/// Proves that a file does what the block does, and that it does not with this mistake.
#[track_caller]
fn check<B: Block>(block: &B, file: &str, parameters: &[(&str, i64)], mutant: (&str, &str)) {
    let Some(equal) = verdict(block, file, parameters, None) else { return };
    assert!(matches!(equal, Verdict::Equal), "{file}: {equal:?}");
    let other = verdict(block, file, parameters, Some(mutant));
    assert!(matches!(other, Some(Verdict::Differs(_))), "{file}: {other:?}");
}

#[test]
#[ignore = "ten seconds of processor time; docs/proofs.md has the command"]
fn a_processor_under_one_instruction() {
    let mutant = ("13: accumulator <= accumulator + plane", "13: accumulator <= accumulator - plane");
    check(&Simd { edge: 1 }, "simd.v", &[("EDGE", 1)], mutant);
}

#[test]
#[ignore = "ten seconds of processor time; docs/proofs.md has the command"]
fn a_quadtree_unit() {
    let mutant = ("todo[1] || !todo[2]", "todo[1] || todo[2]");
    check(&Qt { level: 2, ..Qt::new(1, true) }, "qt.v", &[("UNITS", 1), ("LEVEL", 2)], mutant);
}

#[test]
#[ignore = "ten seconds of processor time; docs/proofs.md has the command"]
fn a_chain_of_mergers() {
    let mutant = ("takes = entry == 0 && next_page != PAGES", "takes = entry == 0");
    check(&Pim { stages: 2, columns: 5, rows: 2 }, "pim.v", &[("STAGES", 2), ("COLUMNS", 5), ("ROWS", 2)], mutant);
}
