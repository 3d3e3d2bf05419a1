//! The files of tops.

use tilewright_boards::{TOPS, Top};
use tilewright_gen::tools::lint_quickly;

/// The constraints come last.
fn files(top: &Top) -> Vec<tilewright_gen::VerilogFile> {
    top.files(&(top.design)().unwrap()).unwrap()
}

#[test]
fn the_verilog_of_every_top_is_clean() {
    for top in TOPS {
        let mut files = files(top);
        let constraints = files.pop().unwrap();
        assert!(constraints.name.ends_with(top.dialect.extension()), "{} on {}", top.name, top.board);
        let _ = lint_quickly(&[&files]).unwrap();
    }
}

#[test]
fn clocks_and_pins_are_constrained() {
    let top = Top::find("test-picture", "ulx3s").unwrap();
    let constraints = files(top).pop().unwrap();
    for line in [
        "FREQUENCY PORT \"pixel_clk\" 25 MHZ;",
        "FREQUENCY NET \"serial_clk\" 125 MHZ;",
        "LOCATE COMP \"tmds[3]\" SITE \"A17\";\nIOBUF PORT \"tmds[3]\" IO_TYPE=LVCMOS33D DRIVE=4;",
    ] {
        assert!(constraints.text.contains(line), "{}", constraints.text);
    }
}
