//! Memories that are written in parts.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_hdl::{Clock, Period};
use tilewright_sim::Simulation;

/// `word`, in which the parts of `width` bits that the mask selects are replaced by those of `data`.
fn written(word: u64, mask: u64, data: u64, width: u32) -> u64 {
    (0..64 / width).filter(|part| mask >> part & 1 == 1).fold(word, |word, part| {
        let part = (u64::MAX >> (64 - width)) << (part * width);
        word & !part | data & part
    })
}

fn clocks() -> [Clock; 2] {
    [Clock::new("write", Period::ns(10)), Clock::new("read", Period::ns(14))]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_memory_is_read_as_it_was_before_the_write(
        (depth, bytes) in (2u32..9, 1u32..5),
        steps in prop::collection::vec((any::<u64>(), any::<u64>(), any::<u64>()), 1..80),
        seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&Ram::new(depth, bytes)).unwrap().seeded(seed);
        sim.reset();
        let mut words = vec![None; depth as usize];
        for (address, write, data) in steps {
            let (address, all) = (address % u64::from(depth), (1 << bytes) - 1);
            let data = data & (u64::MAX >> (64 - 8 * bytes));
            // Only a word that was written completely is known.
            let write = if words[address as usize].is_none() { all } else { write & all };
            sim.drive(RamIn { address, write, data });
            sim.step();
            let before = words[address as usize];
            if let Some(before) = before {
                prop_assert_eq!(sim.get_u64(sim.o.word), before);
            }
            words[address as usize] = Some(written(before.unwrap_or(0), write, data, 8));
        }
    }

    #[test]
    fn what_one_clock_has_written_another_one_reads(
        (depth, bytes) in (2u32..9, 1u32..5),
        writes in prop::collection::vec((any::<u64>(), any::<u64>(), any::<u64>()), 0..40),
        seed in any::<u64>(),
    ) {
        let [write_clock, read_clock] = clocks();
        let ram = DualClockRam::new(depth, bytes, write_clock, read_clock);
        let mut sim = Simulation::of(&ram).unwrap().seeded(seed);
        sim.reset();
        let (all, most) = ((1 << bytes) - 1, u64::MAX >> (64 - 8 * bytes));
        let whole = (0..u64::from(depth)).map(|to| (to, all, to));
        let mut words = vec![0; depth as usize];
        for (to, write, data) in whole.chain(writes.into_iter().map(|(to, write, data)| (to % u64::from(depth), write & all, data & most))) {
            sim.drive(DualClockRamIn { to, write, data, from: 0 });
            sim.step_clock(write_clock, 1);
            words[to as usize] = written(words[to as usize], write, data, 8);
        }
        for (from, word) in (0..).zip(words) {
            sim.drive(DualClockRamIn { to: 0, write: 0, data: most, from });
            sim.step_clock(read_clock, 1);
            prop_assert_eq!(sim.get_u64(sim.o.word), word);
        }
    }

    #[test]
    fn lanes_are_written_under_a_mask(
        (count, lanes, width) in (2u32..9, 1u32..5, 1u32..9),
        steps in prop::collection::vec([any::<u64>(), any::<u64>(), any::<u64>(), any::<u64>(), any::<u64>()], 1..60),
        seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&VectorRegisters::new(count, lanes, width)).unwrap().seeded(seed);
        sim.reset();
        let (all, most) = ((1 << lanes) - 1, u64::MAX >> (64 - lanes * width));
        let mut registers = Vec::new();
        for to in 0..u64::from(count) {
            sim.drive(VectorRegistersIn { left: 0, right: 0, to, mask: all, value: to & most });
            sim.step();
            registers.push(to & most);
        }
        for [left, right, to, mask, value] in steps {
            let [left, right, to] = [left, right, to].map(|number| number % u64::from(count));
            let (mask, value) = (mask & all, value & most);
            sim.drive(VectorRegistersIn { left, right, to, mask, value });
            let [left_value, right_value] = [left, right].map(|number| registers[number as usize]);
            prop_assert_eq!(sim.read_u64(), VectorRegistersOut { left_value, right_value });
            sim.step();
            registers[to as usize] = written(registers[to as usize], mask, value, width);
        }
    }
}

#[test]
#[should_panic(expected = "an address is in range")]
fn an_address_that_there_is_not() {
    let mut sim = Simulation::of(&Ram::new(5, 1)).unwrap();
    sim.set(sim.i.address, 5);
    sim.step();
}

#[test]
#[should_panic(expected = "an address is in range")]
fn a_place_to_write_that_there_is_not() {
    let [writes, reads] = clocks();
    let mut sim = Simulation::of(&DualClockRam::new(5, 1, writes, reads)).unwrap();
    sim.set(sim.i.to, 5);
    sim.step_clock(writes, 1);
}

#[test]
#[should_panic(expected = "an address is in range")]
fn a_place_to_read_that_there_is_not() {
    let [writes, reads] = clocks();
    let mut sim = Simulation::of(&DualClockRam::new(5, 1, writes, reads)).unwrap();
    sim.set(sim.i.from, 5);
    sim.step_clock(reads, 1);
}

#[test]
#[should_panic(expected = "the number of a register is in range")]
fn a_register_that_there_is_not() {
    let mut sim = Simulation::of(&VectorRegisters::new(3, 1, 1)).unwrap();
    sim.set(sim.i.right, 3);
    sim.step();
}

#[test]
#[should_panic(expected = "a memory of 1 words of 4 bytes: it has 2 words of 1 byte or more")]
fn a_memory_of_one_word() {
    Ram::new(1, 4);
}

#[test]
#[should_panic(expected = "a memory of 4 words of 0 bytes: it has 2 words of 1 byte or more")]
fn a_memory_of_nothing() {
    let [writes, reads] = clocks();
    DualClockRam::new(4, 0, writes, reads);
}

#[test]
#[should_panic(expected = "a dual-clock memory on clock `read` alone: use `Ram`")]
fn a_dual_clock_memory_of_one_clock() {
    let [_, reads] = clocks();
    DualClockRam::new(4, 1, reads, reads);
}

#[test]
#[should_panic(expected = "8 registers of 0 lanes of 4 bits: there are 2 or more, of 1 lane of 1 bit or more")]
fn registers_of_nothing() {
    VectorRegisters::new(8, 0, 4);
}
