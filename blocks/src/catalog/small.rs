//! The entries of blocks without streams.

use crate::{Counter, CounterIn, Lfsr, LfsrIn, ShiftRegister, ShiftRegisterIn};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{DEFAULT_PERIOD, Scenario, Script, elaborate};

pub(super) const COUNTER: Entry = Entry {
    name: "counter",
    summary: "counts to a limit and starts again",
    parameters: &[Parameter { name: "limit", default: 5, min: 1, max: 1 << 32, meaning: "how many numbers there are" }],
    design: |values| Ok(elaborate(&counter(values))?),
    scenario: |values| Ok(count_and_restart(&counter(values))),
};

pub(super) const SHIFT_REGISTER: Entry = Entry {
    name: "shift-register",
    summary: "shifts a word out, or in",
    parameters: &[Parameter { name: "width", default: 4, min: 2, max: 1024, meaning: "bits of it" }],
    design: |values| Ok(elaborate(&shift_register(values))?),
    scenario: |values| Ok(a_word_out_and_one_in(&shift_register(values), values.get("width"))),
};

pub(super) const LFSR: Entry = Entry {
    name: "lfsr",
    summary: "goes through all numbers but 0 in an order that looks like chance",
    parameters: &[Parameter { name: "width", default: 4, min: 2, max: 32, meaning: "bits of a number" }],
    design: |values| Ok(elaborate(&lfsr(values))?),
    scenario: |values| Ok(some_numbers(&lfsr(values))),
};

fn counter(values: &Values) -> Counter {
    Counter::new(values.get("limit"))
}

fn count_and_restart(counter: &Counter) -> Scenario {
    let mut script = Script::new(counter, DEFAULT_PERIOD);
    script.hold(&CounterIn { restart: 0, enable: 1 }, 7);
    script.hold(&CounterIn { restart: 0, enable: 0 }, 2);
    script.clock(&CounterIn { restart: 1, enable: 1 });
    script.hold(&CounterIn { restart: 0, enable: 1 }, 3);
    script.finish("it counts, waits, is restarted, and counts on")
}

fn shift_register(values: &Values) -> ShiftRegister {
    ShiftRegister::new(values.get_u32("width"))
}

fn a_word_out_and_one_in(register: &ShiftRegister, width: u64) -> Scenario {
    let mut script = Script::new(register, DEFAULT_PERIOD);
    let idle = ShiftRegisterIn { load: 0, word: 0, shift: 0, bit_in: 0 };
    script.clock(&ShiftRegisterIn { load: 1, word: 2, ..idle });
    script.hold(&ShiftRegisterIn { shift: 1, ..idle }, width);
    for bit_in in [1, 0, 1] {
        script.clock(&ShiftRegisterIn { shift: 1, bit_in, ..idle });
    }
    script.hold(&idle, 2);
    script.finish("a word is loaded and shifted out, the most significant bit first; then three bits are shifted in")
}

fn lfsr(values: &Values) -> Lfsr {
    Lfsr::new(values.get_u32("width"))
}

fn some_numbers(lfsr: &Lfsr) -> Scenario {
    let mut script = Script::new(lfsr, DEFAULT_PERIOD);
    script.hold(&LfsrIn { enable: 1 }, 8);
    script.hold(&LfsrIn { enable: 0 }, 2);
    script.hold(&LfsrIn { enable: 1 }, 8);
    script.finish("sixteen numbers, with a pause among them; of 4 bits the last is the first again")
}
