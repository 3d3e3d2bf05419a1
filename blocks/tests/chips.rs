//! Tops with their pads, PLLs and pins: each fits its FPGA, and is in time there.

use crate::pins::i2c::i2c_pins::I2cPins;
use crate::pins::spi_flash::flash_pins::FlashPins;
use tilewright_blocks::{I2cMaster, SdramController, SdramOnPads, SpiFlashReader};
use tilewright_gen::tools::{Device, Frequency, Placed, place};
use tilewright_gen::{Dialect, Pins, constraints, verilog};
use tilewright_hdl::ir::Design;
use tilewright_hdl::{Period, elaborate};

/// A top, and the FPGA for which its pins are.
struct Chip {
    name: &'static str,
    design: fn() -> Design,
    /// As [`Pins::read`] takes them; without any, nextpnr chooses.
    pins: &'static str,
    device: Device,
    /// The clocks, with their frequencies in MHz.
    clocks: &'static [(&'static str, f64)],
}

const CHIPS: &[Chip] = &[
    // I2C at 400 kHz.
    Chip {
        name: "i2c_pins",
        design: || elaborate(&I2cPins { master: I2cMaster { low: 150, high: 95, filter: 3 } }).unwrap(),
        pins: "",
        device: Device::LFE5U_25F,
        clocks: &[("clk", 100.0)],
    },
    Chip {
        name: "flash_pins",
        design: || elaborate(&FlashPins { reader: SpiFlashReader { half_period: 1, fast: true, length: 24 } }).unwrap(),
        pins: "",
        device: Device::LFE5U_25F,
        clocks: &[("clk", 100.0)],
    },
    Chip {
        name: "sdram_on_pads",
        design: || elaborate(&SdramOnPads { controller: SdramController::of_32_megabytes(Period::ns(10)) }).unwrap(),
        pins: "",
        device: Device::LFE5U_25F,
        clocks: &[("clk", 100.0)],
    },
];

/// The chips by their names.
pub fn designs() -> impl Iterator<Item = (String, Design)> {
    CHIPS.iter().map(|chip| (chip.name.to_owned(), (chip.design)()))
}

/// The chip on its FPGA; `None` if the tools are not installed.
fn placed(chip: &Chip) -> Option<Placed> {
    let design = (chip.design)();
    assert_eq!(design.top().name, chip.name);
    let pins = Pins::read(chip.pins).unwrap();
    let file = constraints(&design, Dialect::Lpf, &pins).unwrap();
    place(&verilog(&design), &file, chip.device).unwrap()
}

/// `cargo test -p tilewright-blocks --test all chips -- --nocapture` prints the figures.
#[test]
fn every_chip_is_in_time() {
    for chip in CHIPS {
        let Some(Placed { clocks, crossings, cells }) = placed(chip) else { return };
        let wanted: Vec<_> = clocks.iter().map(|(net, clock)| (net.as_str(), clock.wanted)).collect();
        assert_eq!(wanted, chip.clocks, "{}", chip.name);
        for (net, Frequency { reached, wanted }) in &clocks {
            println!("{}: {net} reaches {reached} MHz of {wanted} MHz", chip.name);
            assert!(reached >= wanted, "{}: {net}", chip.name);
        }
        // nextpnr has no limit for them; here it is that of an SDC.
        for ((from, to), delay) in crossings {
            let limit = 1000.0 / clocks[&from].wanted.max(clocks[&to].wanted);
            println!("{}: {from} to {to} takes {delay} ns of {limit} ns", chip.name);
            assert!(delay <= limit, "{}: {from} to {to}", chip.name);
        }
        let cells: Vec<String> = cells.iter().map(|(cell, count)| format!("{count} {cell}")).collect();
        println!("{}: {}", chip.name, cells.join(", "));
    }
}
