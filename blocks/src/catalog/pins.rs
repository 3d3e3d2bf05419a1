//! The entries of blocks at the pins of a chip.

use crate::{Debouncer, DebouncerIn};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{DEFAULT_PERIOD, Scenario, Script, elaborate};

pub(super) const DEBOUNCER: Entry = Entry {
    name: "debouncer",
    summary: "follows a switch without its bounces",
    parameters: &[
        Parameter { name: "clocks", default: 3, min: 1, max: 1 << 32, meaning: "how long a new level lasts" },
        Parameter { name: "idle", default: 0, min: 0, max: 1, meaning: "the level at rest" },
    ],
    design: |values| Ok(elaborate(&debouncer(values))?),
    scenario: |values| Ok(bounces(&debouncer(values))),
};

fn debouncer(values: &Values) -> Debouncer {
    Debouncer { clocks: values.get("clocks"), idle: values.get("idle") == 1 }
}

fn bounces(debouncer: &Debouncer) -> Scenario {
    let mut script = Script::new(debouncer, DEFAULT_PERIOD);
    let idle = u64::from(debouncer.idle);
    script.hold(&DebouncerIn { line: idle }, 2);
    for (line, clocks) in [(1, 1), (0, 1), (1, 2), (0, 1), (1, 8), (0, 2), (1, 1), (0, 8)] {
        script.hold(&DebouncerIn { line: line ^ idle }, clocks);
    }
    script.finish("a switch is pressed and released, and bounces each time; the level changes once")
}
