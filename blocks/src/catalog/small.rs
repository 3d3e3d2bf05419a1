//! The entries of blocks without streams.

use crate::{
    Counter, CounterIn, Lfsr, LfsrIn, PowerOnReset, PowerOnResetIn, Quadrature, QuadratureIn, ResetSynchronizer,
    ShiftRegister, ShiftRegisterIn, Ticks, TicksIn, UpDownCounter, UpDownCounterIn,
};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{Clock, DEFAULT_PERIOD, Reset, Scenario, Script, elaborate};

pub(super) const COUNTER: Entry = Entry {
    name: "counter",
    summary: "counts to a limit and starts again",
    parameters: &[Parameter {
        name: "limit",
        default: 5,
        min: 1,
        max: 1 << 32,
        meaning: "number of values, from 0 on",
    }],
    design: |values| Ok(elaborate(&counter(values))?),
    scenario: |values| Ok(count_and_restart(&counter(values))),
};

pub(super) const UP_DOWN_COUNTER: Entry = Entry {
    name: "up-down-counter",
    summary: "counts up and down, and wraps at both ends",
    parameters: &[Parameter {
        name: "limit",
        default: 5,
        min: 2,
        max: 1 << 32,
        meaning: "number of values, from 0 on",
    }],
    design: |values| Ok(elaborate(&up_down_counter(values))?),
    scenario: |values| Ok(around_both_ends(&up_down_counter(values))),
};

pub(super) const SHIFT_REGISTER: Entry = Entry {
    name: "shift-register",
    summary: "shifts a word out, or in",
    parameters: &[Parameter { name: "width", default: 4, min: 2, max: 1024, meaning: "bits of the register" }],
    design: |values| Ok(elaborate(&shift_register(values))?),
    scenario: |values| Ok(a_word_out_and_one_in(&shift_register(values), values.get("width"))),
};

pub(super) const LFSR: Entry = Entry {
    name: "lfsr",
    summary: "generates a pseudo-random sequence of all numbers but 0",
    parameters: &[Parameter { name: "width", default: 4, min: 2, max: 32, meaning: "bits of a number" }],
    design: |values| Ok(elaborate(&lfsr(values))?),
    scenario: |values| Ok(some_numbers(&lfsr(values))),
};

pub(super) const QUADRATURE: Entry = Entry {
    name: "quadrature",
    summary: "counts the steps of a knob or a motor",
    parameters: &[Parameter { name: "width", default: 4, min: 2, max: 32, meaning: "bits of the position" }],
    design: |values| Ok(elaborate(&quadrature(values))?),
    scenario: |values| Ok(there_and_back(&quadrature(values))),
};

pub(super) const POWER_ON_RESET: Entry = Entry {
    name: "power-on-reset",
    summary: "asserts the reset of everything else for some clocks",
    parameters: &[Parameter { name: "clocks", default: 3, min: 1, max: 1 << 32, meaning: "clocks that a reset lasts" }],
    design: |values| Ok(elaborate(&power_on_reset(values))?),
    scenario: |values| Ok(two_resets(&power_on_reset(values))),
};

pub(super) const RESET_SYNCHRONIZER: Entry = Entry {
    name: "reset-synchronizer",
    summary: "releases an asynchronous reset at an edge of its clock",
    parameters: &[Parameter { name: "low", default: 1, min: 0, max: 1, meaning: "1 if the reset is active low" }],
    design: |values| Ok(elaborate(&reset_synchronizer(values))?),
    scenario: |values| Ok(a_release(&reset_synchronizer(values))),
};

pub(super) const TICKS: Entry = Entry {
    name: "ticks",
    summary: "is high for one clock of each period",
    parameters: &[Parameter { name: "every", default: 3, min: 2, max: 1 << 32, meaning: "clocks of a period" }],
    design: |values| Ok(elaborate(&ticks(values))?),
    scenario: |values| Ok(ticks_and_a_restart(&ticks(values))),
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
    script.finish("the counter counts, waits, is restarted, and counts on")
}

fn up_down_counter(values: &Values) -> UpDownCounter {
    UpDownCounter::new(values.get("limit"))
}

fn around_both_ends(counter: &UpDownCounter) -> Scenario {
    let mut script = Script::new(counter, DEFAULT_PERIOD);
    script.hold(&UpDownCounterIn { restart: 0, up: 0, down: 1 }, 2);
    script.hold(&UpDownCounterIn { restart: 0, up: 1, down: 0 }, 4);
    script.hold(&UpDownCounterIn { restart: 0, up: 1, down: 1 }, 2);
    script.clock(&UpDownCounterIn { restart: 1, up: 1, down: 0 });
    script.hold(&UpDownCounterIn { restart: 0, up: 0, down: 0 }, 2);
    script.finish("two steps down, below 0; four up, above the last number; up and down at once; and back to 0")
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
    script.finish("sixteen numbers, with a pause; with 4 bits the last equals the first")
}

fn quadrature(values: &Values) -> Quadrature {
    Quadrature::new(values.get_u32("width"))
}

fn there_and_back(quadrature: &Quadrature) -> Scenario {
    let mut script = Script::new(quadrature, DEFAULT_PERIOD);
    for (a, b) in [(0, 0), (1, 0), (1, 1), (0, 1), (0, 1), (1, 1), (1, 0), (0, 0), (0, 1), (1, 1)] {
        script.clock(&QuadratureIn { a, b });
    }
    script.wait(2);
    script.finish("three steps up, and five down to below 0")
}

fn power_on_reset(values: &Values) -> PowerOnReset {
    PowerOnReset::new(values.get("clocks"))
}

fn two_resets(reset: &PowerOnReset) -> Scenario {
    let mut script = Script::new(reset, DEFAULT_PERIOD);
    script.hold(&PowerOnResetIn { again: 0 }, 5);
    script.clock(&PowerOnResetIn { again: 1 });
    script.hold(&PowerOnResetIn { again: 0 }, 5);
    script.finish("the reset after power-on, and one on request")
}

fn reset_synchronizer(values: &Values) -> ResetSynchronizer {
    let reset = if values.get("low") == 1 { Reset::AsynchronousLow } else { Reset::Asynchronous };
    ResetSynchronizer::new(Clock::new("board", DEFAULT_PERIOD).reset(reset))
}

fn a_release(synchronizer: &ResetSynchronizer) -> Scenario {
    let mut script = Script::new(synchronizer, DEFAULT_PERIOD);
    script.wait(5);
    script.finish("the reset of the clock has been released")
}

fn ticks(values: &Values) -> Ticks {
    Ticks::new(values.get("every"))
}

fn ticks_and_a_restart(ticks: &Ticks) -> Scenario {
    let mut script = Script::new(ticks, DEFAULT_PERIOD);
    script.hold(&TicksIn { restart: 0 }, 5);
    script.clock(&TicksIn { restart: 1 });
    script.hold(&TicksIn { restart: 0 }, 6);
    script.finish("ticks, a restart, and the ticks after it")
}
