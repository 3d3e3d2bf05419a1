//! The examples, which other tests look at.

#[path = "../examples/dvi.rs"]
pub mod dvi;

use std::fs;

#[test]
fn the_picture_is_written_with_its_constraints() {
    let folder = tempfile::tempdir().unwrap();
    dvi::write(folder.path()).unwrap();
    let lpf = fs::read_to_string(folder.path().join("dvi.lpf")).unwrap();
    for line in [
        "FREQUENCY PORT \"pixel_clk\" 25 MHZ;",
        "FREQUENCY NET \"serial_clk\" 125 MHZ;",
        "LOCATE COMP \"tmds[3]\" SITE \"A17\";\nIOBUF PORT \"tmds[3]\" IO_TYPE=LVCMOS33D DRIVE=4;",
    ] {
        assert!(lpf.contains(line), "{lpf}");
    }
    assert!(fs::read_to_string(folder.path().join("dvi.v")).unwrap().contains("\nmodule dvi (\n"));
}
