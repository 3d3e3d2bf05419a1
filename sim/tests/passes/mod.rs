//! The effect of each pass on a small circuit, as text: a pass that loses its effect fails here.

mod fields;
mod folders;
mod front;
mod functions;
mod late;
mod loops;
mod pack;
mod quiet;
mod strips;
mod units;
mod versions;

use tilewright_hdl::{Block, elaborate};
use tilewright_sim::{Pass, Passes};

use crate::text_after;

/// The result of a pass for a block, without the source places.
fn after<B: Block>(block: &B, pass: Pass) -> String {
    after_with(block, pass, &Passes::default())
}

/// Like [`after`], with other than the default passes.
fn after_with<B: Block>(block: &B, pass: Pass, passes: &Passes) -> String {
    let design = elaborate(block).unwrap();
    let text = text_after(&design, pass, passes);
    let lines = text.lines().map(|line| line.split("   sim/tests/").next().unwrap_or(line).trim_end());
    lines.map(|line| format!("{line}\n")).collect()
}

/// Compares text line by line; `expected` is indented like the test.
#[track_caller]
fn is(got: &str, expected: &str) {
    let lines: Vec<&str> = expected.trim_end().lines().skip(1).collect();
    let indent = lines.iter().map(|line| line.len() - line.trim_start().len()).min().unwrap_or(0);
    let expected: String = lines.iter().map(|line| format!("{}\n", &line[indent..])).collect();
    assert!(got == expected, "got\n{got}\nexpected\n{expected}");
}
