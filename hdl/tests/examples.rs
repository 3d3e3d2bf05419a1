//! The examples hold what they assert.

#[path = "../examples/counter.rs"]
mod counter;
#[path = "../examples/crossing.rs"]
mod crossing;
#[path = "../examples/fifo.rs"]
mod fifo;
#[path = "../examples/program.rs"]
mod program;
#[path = "../examples/rv32i.rs"]
mod rv32i;
#[path = "../examples/systolic.rs"]
mod systolic;
#[path = "../examples/uart.rs"]
mod uart;
#[path = "../examples/windows.rs"]
mod windows;

use tilewright_gen::{testbench, tools, verilog};

#[test]
fn the_counter_runs() {
    counter::main().unwrap();
}

#[test]
fn the_crossing_runs() {
    crossing::main().unwrap();
}

#[test]
fn the_queue_runs() {
    fifo::main().unwrap();
}

#[test]
fn the_matrices_are_multiplied() {
    systolic::main().unwrap();
}

#[test]
fn the_program_runs() {
    program::main().unwrap();
}

#[test]
fn the_processor_runs() {
    rv32i::main().unwrap();
}

#[test]
fn the_bytes_go_over_the_line() {
    uart::main().unwrap();
}

#[test]
fn the_verilog_of_the_line_does_the_same() {
    let (design, recording) = uart::run().unwrap();
    let files = verilog(&design);
    tools::lint(&files).unwrap();
    let _ = tools::replay_in_icarus(&files, &testbench(&design, &recording)).unwrap();
}

#[test]
fn the_windows_are_divided() {
    windows::main().unwrap();
}
