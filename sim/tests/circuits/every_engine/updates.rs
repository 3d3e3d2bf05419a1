//! The priority of a register's updates, compared with a plain model.

use crate::circuits::engine::of;
use proptest::prelude::*;
use tilewright_hdl::{Module, bit, bits, block};

block! {
    /// A register that keeps its value, one with `otherwise`, and one with an enable.
    struct Registers;
    in In { first: bit(), second: bit(), third: bit(), enable: bit(), value: bits(8) }
    out Out { holds: _, ends: _, enabled: _ }
}

impl Registers {
    fn build(&self, m: Module, i: In) -> Out {
        let [holds, ends, enabled] = ["holds", "ends", "enabled"].map(|name| m.reg(name, 8).reset(3));
        holds.when(i.first, 0).when(i.second, i.value).when(i.third, holds + 1);
        ends.when(i.first, i.value).when(i.second, ends - 1).otherwise(9);
        enabled.enable(i.enable).when(i.first, i.value).when(i.third, enabled + 1);
        Out { holds: *holds, ends: *ends, enabled: *enabled }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 30, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_first_condition_that_holds_wins(steps in prop::collection::vec((0..16u64, 0..256u64), 1..60)) {
        let mut sim = of(&Registers);
        let (mut holds, mut ends, mut enabled) = (3u64, 3u64, 3u64);
        for (bits, value) in steps {
            let [first, second, third, enable] = [0, 1, 2, 3].map(|bit| bits >> bit & 1);
            sim.drive(In { first, second, third, enable, value });
            sim.step();
            holds = match (first, second, third) {
                (1, ..) => 0,
                (_, 1, _) => value,
                (_, _, 1) => (holds + 1) % 256,
                _ => holds,
            };
            ends = match (first, second) {
                (1, _) => value,
                (_, 1) => (ends + 255) % 256,
                _ => 9,
            };
            enabled = match (enable, first, third) {
                (1, 1, _) => value,
                (1, _, 1) => (enabled + 1) % 256,
                _ => enabled,
            };
            prop_assert_eq!(sim.read_u64(), Out { holds, ends, enabled });
        }
    }
}
