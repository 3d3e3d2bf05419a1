//! Tops on their FPGAs.

use tilewright_boards::{TOPS, Top};
use tilewright_gen::Dialect;
use tilewright_gen::tools::{Device, Placed, lint_quickly, place};

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
fn the_test_picture_is_in_time() {
    let top = Top::find("test-picture", "ulx3s").unwrap();
    let mut files = files(top);
    let constraints = files.pop().unwrap();
    for line in [
        "FREQUENCY PORT \"pixel_clk\" 25 MHZ;",
        "FREQUENCY NET \"serial_clk\" 125 MHZ;",
        "LOCATE COMP \"tmds[3]\" SITE \"A17\";\nIOBUF PORT \"tmds[3]\" IO_TYPE=LVCMOS33D DRIVE=4;",
    ] {
        assert!(top.dialect == Dialect::Lpf && constraints.text.contains(line), "{}", constraints.text);
    }
    // The smaller device of the family has the same pins, and is loaded sooner.
    let Some(Placed { clocks, crossings, .. }) = place(&files, &constraints, Device::LFE5U_25F).unwrap() else {
        return;
    };
    let wanted: Vec<_> = clocks.iter().map(|(net, clock)| (net.as_str(), clock.wanted)).collect();
    assert_eq!(wanted, [("pixel_clk", 25.0), ("serial_clk", 125.0)]);
    assert!(clocks.values().all(|clock| clock.reached >= clock.wanted), "{clocks:?}");
    // nextpnr has no limit for them; here it is that of an SDC.
    assert!(crossings.values().all(|delay| *delay <= 8.0), "{crossings:?}");
}
