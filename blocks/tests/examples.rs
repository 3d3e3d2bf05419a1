//! The examples, which other tests look at.

use crate::pins::i2c::i2c_pins;
use crate::pins::spi_flash::flash_pins;
use std::fs;
use tilewright_gen::{testbench, tools, verilog};

#[path = "../examples/dvi.rs"]
pub mod dvi;

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

#[test]
fn others_agree_on_the_pins_of_i2c() {
    i2c_pins::main().unwrap();
    let (design, recording) = i2c_pins::run().unwrap();
    let (files, bench) = (verilog(&design), testbench(&design, &recording));
    tools::lint(&files).unwrap();
    let _ = tools::replay_in_icarus(&files, &bench).unwrap();
    let _ = tools::replay_in_verilator(&files, &bench).unwrap();
}

/// Verilator has seen a pad already.
#[test]
fn icarus_agrees_on_the_pins_of_a_flash_memory() {
    flash_pins::main().unwrap();
    let (design, recording) = flash_pins::run().unwrap();
    let files = verilog(&design);
    tools::lint(&files).unwrap();
    let _ = tools::replay_in_icarus(&files, &testbench(&design, &recording)).unwrap();
}
