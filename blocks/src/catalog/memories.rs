//! The entries of memories.

use crate::{DualClockRam, DualClockRamIn, Ram, RamIn, VectorRegisters, VectorRegistersIn};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{Clock, DEFAULT_PERIOD, Period, Scenario, Script, elaborate};

const DEPTH: Parameter = Parameter { name: "depth", default: 5, min: 4, max: 1 << 16, meaning: "words of the memory" };
const BYTES: Parameter = Parameter { name: "bytes", default: 2, min: 1, max: 8, meaning: "bytes of a word" };

pub(super) const RAM: Entry = Entry {
    name: "ram",
    summary: "a memory whose words are written byte by byte",
    parameters: &[DEPTH, BYTES],
    design: |values| Ok(elaborate(&ram(values))?),
    scenario: |values| Ok(words_and_a_byte(&ram(values), all(values.get("bytes")))),
};

pub(super) const DUAL_CLOCK_RAM: Entry = Entry {
    name: "dual-clock-ram",
    summary: "a memory that one clock writes byte by byte and another one reads",
    parameters: &[DEPTH, BYTES],
    design: |values| Ok(elaborate(&dual_clock_ram(values))?),
    scenario: |values| Ok(written_and_read(&dual_clock_ram(values), all(values.get("bytes")))),
};

pub(super) const VECTOR_REGISTERS: Entry = Entry {
    name: "vector-registers",
    summary: "registers of several lanes, written under a mask",
    parameters: &[
        Parameter { name: "count", default: 6, min: 4, max: 256, meaning: "number of registers" },
        Parameter { name: "lanes", default: 3, min: 1, max: 4, meaning: "lanes of a register" },
        Parameter { name: "width", default: 4, min: 1, max: 16, meaning: "bits of a lane" },
    ],
    design: |values| Ok(elaborate(&vector_registers(values))?),
    scenario: |values| Ok(a_lane_under_a_mask(&vector_registers(values), all(values.get("lanes")))),
};

/// A mask of all bytes, or of all lanes.
fn all(count: u64) -> u64 {
    (1 << count) - 1
}

fn ram(values: &Values) -> Ram {
    Ram::new(values.get_u32("depth"), values.get_u32("bytes"))
}

fn words_and_a_byte(ram: &Ram, all: u64) -> Scenario {
    let mut script = Script::new(ram, DEFAULT_PERIOD);
    for address in 0..3 {
        script.clock(&RamIn { address, write: all, data: 0x11 * (address + 1) });
    }
    script.clock(&RamIn { address: 1, write: 1, data: 0xaa });
    for address in 0..3 {
        script.clock(&RamIn { address, write: 0, data: 0 });
    }
    script.wait(1);
    script.finish("three words are written, a byte of the second is written again, and all are read")
}

fn dual_clock_ram(values: &Values) -> DualClockRam {
    let clock = |name, period| Clock::new(name, Period::ns(period));
    DualClockRam::new(values.get_u32("depth"), values.get_u32("bytes"), clock("write", 10), clock("read", 14))
}

fn written_and_read(ram: &DualClockRam, all: u64) -> Scenario {
    let mut script = Script::new(ram, Period::ns(10));
    for to in 0..3 {
        script.clock(&DualClockRamIn { to, write: all, data: 0x11 * (to + 1), from: 3 });
    }
    script.clock(&DualClockRamIn { to: 1, write: 1, data: 0xaa, from: 3 });
    for from in 0..3 {
        script.hold(&DualClockRamIn { to: 0, write: 0, data: 0, from }, 2);
    }
    script.finish("three words are written on a clock of 10 ns, a byte of one is written again, and all are read on a clock of 14 ns")
}

fn vector_registers(values: &Values) -> VectorRegisters {
    VectorRegisters::new(values.get_u32("count"), values.get_u32("lanes"), values.get_u32("width"))
}

fn a_lane_under_a_mask(registers: &VectorRegisters, all: u64) -> Scenario {
    let mut script = Script::new(registers, DEFAULT_PERIOD);
    let read = VectorRegistersIn { left: 1, right: 2, to: 0, mask: 0, value: 0 };
    script.clock(&VectorRegistersIn { to: 1, mask: all, value: all, ..read });
    script.clock(&VectorRegistersIn { to: 2, mask: all, value: 0, ..read });
    script.clock(&VectorRegistersIn { to: 2, mask: 1, value: all, ..read });
    script.hold(&read, 2);
    script.finish("one register is written and another cleared; then lane 0 of the second is written alone")
}
