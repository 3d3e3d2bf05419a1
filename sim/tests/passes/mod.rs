//! What each pass makes of a small circuit, in lines to read: a pass that does nothing any more fails here.

mod fields;
mod front;
mod functions;
mod late;
mod pack;
mod quiet;
mod units;
mod versions;

use tilewright_hdl::{Block, elaborate};
use tilewright_sim::{Pass, Passes, explain};

/// What a pass leaves of a block, without the places in the source.
fn after<B: Block>(block: &B, pass: Pass) -> String {
    after_with(block, pass, &Passes::default())
}

/// As [`after`], with other passes than the usual.
fn after_with<B: Block>(block: &B, pass: Pass, passes: &Passes) -> String {
    let design = elaborate(block).unwrap();
    let explained = explain(&design, passes).into_iter().find(|it| it.pass == pass).expect("every pass is explained");
    let lines = explained.text.lines().map(|line| line.split("   sim/tests/").next().unwrap_or(line).trim_end());
    lines.map(|line| format!("{line}\n")).collect()
}

/// Compares text line by line; `expected` is indented as the test is.
#[track_caller]
fn is(got: &str, expected: &str) {
    let lines: Vec<&str> = expected.trim_end().lines().skip(1).collect();
    let indent = lines.iter().map(|line| line.len() - line.trim_start().len()).min().unwrap_or(0);
    let expected: String = lines.iter().map(|line| format!("{}\n", &line[indent..])).collect();
    assert!(got == expected, "got\n{got}\nexpected\n{expected}");
}
