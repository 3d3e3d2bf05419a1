//! The examples, which other tests look at.

use crate::pins::i2c::i2c_pins;
use crate::pins::spi_flash::flash_pins;
use tilewright_gen::{testbench, tools, verilog};

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
