//! Six designs on a ULX3S, each behind a serial line: registers of AXI4-Lite, a reader of a flash memory, a master of
//! I2C, a transform of vectors, sines, and a cache. The example places each on an ECP5, and prints its figures.
//! `cargo run -p tilewright-boards --example designs`

#[path = "../../../hdl/examples/cache.rs"]
#[allow(dead_code, reason = "a program of its own, too")]
mod cache;
pub(crate) mod served;
mod services;
pub(crate) mod top;
#[path = "../../../hdl/examples/transform.rs"]
#[allow(dead_code, reason = "a program of its own, too")]
mod transform;
#[path = "../../../hdl/examples/uart.rs"]
#[allow(dead_code, reason = "a program of its own, too")]
pub(crate) mod uart;

use served::Served;
use tilewright_gen::tools::{Device, Placed, Problems, place};
use tilewright_gen::{Dialect, Pins, constraints, verilog};
use tilewright_hdl::elaborate;
use top::OnUlx3s;

/// The designs on an LFE5U-25F, on pins that nextpnr chooses; `None` if the tools are not installed.
pub fn placed(designs: &[Served]) -> Result<Option<Placed>, Problems> {
    let design = elaborate(&OnUlx3s::at_115200_baud(designs)).expect("it is sound");
    let timing = constraints(&design, Dialect::Lpf, &Pins::none()).expect("without pins, none is wrong");
    place(&verilog(&design), &timing, Device::LFE5U_25F)
}

/// The figures in a line.
pub fn figures(placed: &Placed) -> String {
    let clocks = placed.clocks.iter().map(|(net, it)| format!("{net} {} MHz of {} MHz", it.reached, it.wanted));
    let cells = placed.cells.iter().map(|(cell, count)| format!("{count} {cell}"));
    clocks.chain(cells).collect::<Vec<_>>().join(", ")
}

#[allow(dead_code, reason = "a test has this file, too")]
fn main() -> Result<(), Problems> {
    for design in Served::all() {
        if let Some(placed) = placed(&[design])? {
            println!("{}: {}", design.name(), figures(&placed));
        }
    }
    Ok(())
}
