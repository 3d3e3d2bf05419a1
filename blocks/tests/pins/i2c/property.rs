//! Random transfers to an EEPROM, against a model of what they do.

use super::i2c_pins::devices::{Bus, Eeprom, Stretching};
use super::rules::Rules;
use super::*;
use I2cCommand as Do;
use proptest::prelude::*;
use tilewright_sim::{Pauses, monitor};

const ADDRESS: u64 = 0x50;
const SIZE: usize = 16;

/// What a program of commands does.
#[derive(Debug, Clone)]
enum Access {
    Write {
        address: u64,
        pointer: u64,
        data: Vec<u64>,
    },
    /// The pointer is written first, and a repeated START follows.
    ReadAt {
        address: u64,
        pointer: u64,
        count: usize,
    },
    /// From where the last access has ended.
    Read {
        count: usize,
    },
}

fn access() -> impl Strategy<Value = Access> {
    let address = prop_oneof![4 => Just(ADDRESS), 1 => 0u64..0x80];
    let address_again = address.clone();
    prop_oneof![
        (address, 0u64..256, prop::collection::vec(0u64..256, 0..4))
            .prop_map(|(address, pointer, data)| Access::Write { address, pointer, data }),
        (address_again, 0u64..256, 1usize..4).prop_map(|(address, pointer, count)| Access::ReadAt {
            address,
            pointer,
            count
        }),
        (1usize..4).prop_map(|count| Access::Read { count }),
    ]
}

/// The commands of an access, without STOP.
fn commands(access: &Access) -> Vec<Do<u64>> {
    let reads = |address: u64, count: usize| {
        let mut commands = vec![Do::START, Do::write(address << 1 | 1)];
        commands.extend(vec![Do::READ; count - 1]);
        commands.push(Do::LAST_READ);
        commands
    };
    match access {
        Access::Write { address, pointer, data } => {
            let bytes = [address << 1, *pointer].into_iter().chain(data.iter().copied());
            [Do::START].into_iter().chain(bytes.map(Do::write)).collect()
        }
        Access::ReadAt { address, pointer, count } => {
            let seek = [Do::START, Do::write(address << 1), Do::write(*pointer)];
            [&seek[..], &reads(*address, *count)].concat()
        }
        Access::Read { count } => reads(ADDRESS, *count),
    }
}

/// A result, and the byte where a read has one.
type Answer = (u64, Option<u64>);

/// What an EEPROM answers, without bits and lines.
struct Model {
    memory: Vec<u64>,
    pointer: usize,
    is_protected: bool,
}

impl Model {
    /// To the commands of an access.
    fn answers(&mut self, access: &Access) -> Vec<Answer> {
        let result = |acknowledged: bool| (if acknowledged { DONE } else { NACK }, None);
        let mut answers = vec![(DONE, None)];
        match access {
            Access::Write { address, pointer, data } => {
                let is_ours = *address == ADDRESS;
                answers.extend([result(is_ours); 2]);
                if is_ours {
                    self.pointer = *pointer as usize % SIZE;
                }
                for byte in data {
                    answers.push(result(is_ours && !self.is_protected));
                    if is_ours && !self.is_protected {
                        self.memory[self.pointer] = *byte;
                        self.pointer = (self.pointer + 1) % SIZE;
                    }
                }
            }
            Access::ReadAt { address, pointer, count } => {
                answers.extend(self.answers(&Access::Write { address: *address, pointer: *pointer, data: vec![] }));
                answers.remove(0);
                answers.push((DONE, None));
                answers.push(result(*address == ADDRESS));
                answers.extend(self.read(*address == ADDRESS, *count));
            }
            Access::Read { count } => {
                answers.push((DONE, None));
                answers.extend(self.read(true, *count));
            }
        }
        answers
    }

    /// Of a memory that is not addressed, a released line is read.
    fn read(&mut self, is_ours: bool, count: usize) -> Vec<Answer> {
        let byte = |_| {
            let byte = if is_ours { self.memory[self.pointer] } else { 0xff };
            self.pointer = (self.pointer + usize::from(is_ours)) % SIZE;
            (DONE, Some(byte))
        };
        (0..count).map(byte).collect()
    }
}

/// The clocks from each command to its answer: the first is a START on a free bus.
fn clocks(master: &I2cMaster, program: &[Do<u64>]) -> u64 {
    let (bit, low, high) = (clocks_of_a_bit(master), u64::from(master.low), u64::from(master.high));
    let mut is_ours = false;
    let clocks = program.iter().map(|command| match command.action {
        0 if !std::mem::replace(&mut is_ours, true) => high + 2,
        0 => bit + high + 1,
        3 => bit + low + 1,
        _ => 9 * bit + 1,
    });
    clocks.sum()
}

fn masters() -> impl Strategy<Value = I2cMaster> {
    (1u32..4, 4u32..12, 2u32..9).prop_map(|(filter, low, high)| I2cMaster { low: filter + low, high, filter })
}

/// The program of all accesses, and the answers to it. Joined accesses have one STOP, after the last.
fn program(model: &mut Model, accesses: &[Access], is_joined: bool) -> (Vec<Do<u64>>, Vec<Answer>) {
    let (mut program, mut answers) = (Vec::new(), Vec::new());
    for (place, access) in accesses.iter().enumerate() {
        program.extend(commands(access));
        answers.extend(model.answers(access));
        if !is_joined || place + 1 == accesses.len() {
            program.push(Do::STOP);
            answers.push((DONE, None));
        }
    }
    (program, answers)
}

fn rules(master: &I2cMaster) -> Rules {
    let (low, high) = (u64::from(master.low), u64::from(master.high));
    Rules { low, high, setup: low - low / 2 - 1 }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn an_eeprom_is_written_and_read(
        master in masters(), accesses in prop::collection::vec(access(), 1..4), is_joined: bool, is_protected: bool,
        pauses in (0u64..99, 0u64..99), stretching in (0u64..60, 1u32..60), seed in any::<u64>(),
    ) {
        let mut sim = started(&master, seed);
        let memory: Vec<u64> = (0..SIZE as u64).map(|place| place * 37 % 256).collect();
        let mut eeprom = Eeprom::new(ADDRESS, memory.clone());
        eeprom.is_protected = is_protected;
        let mut model = Model { memory, pointer: 0, is_protected };
        let (program, expected) = program(&mut model, &accesses, is_joined);
        let stops_expected = program.iter().filter(|command| command.action == 3).count();
        let (i, o, lines) = (sim.i, sim.o, lines(&sim));
        let t = &sim.testbench();
        let bus = &Bus::new(t, lines);
        let mut stops = 0;
        let ((), answers, ..) = t.run((
            t.send_all(i.commands, program, Pauses::percent(pauses.0, seed)),
            t.receive_all(o.answers, expected.len(), Pauses::percent(pauses.1, !seed)),
            monitor(t.holds(o.answers)),
            bus.scl(),
            bus.sda(),
            monitor(eeprom.runs(bus, Stretching::new(stretching.0, stretching.1, seed))),
            monitor(rules(&master).watches(bus, &mut stops)),
        ));
        for (answer, (result, byte)) in answers.iter().zip(expected) {
            prop_assert_eq!((answer.result, byte.map(|_| answer.byte)), (result, byte));
        }
        prop_assert_eq!(&eeprom.memory, &model.memory);
        prop_assert_eq!(stops as usize, stops_expected);
    }

    /// Nobody stretches the clock or waits.
    #[test]
    fn each_command_takes_its_clocks(
        master in masters(), accesses in prop::collection::vec(access(), 1..4), seed in any::<u64>(),
    ) {
        let mut sim = started(&master, seed);
        let mut eeprom = Eeprom::new(ADDRESS, vec![0x5a; SIZE]);
        let mut model = Model { memory: vec![0x5a; SIZE], pointer: 0, is_protected: false };
        let (program, answers) = program(&mut model, &accesses, true);
        let (i, o, lines) = (sim.i, sim.o, lines(&sim));
        let clocks = clocks(&master, &program);
        let t = &sim.testbench();
        let start = t.time();
        let bus = &Bus::new(t, lines);
        t.run((
            t.send_all(i.commands, program, Pauses::NONE),
            t.receive_all(o.answers, answers.len(), Pauses::NONE),
            bus.scl(),
            bus.sda(),
            monitor(eeprom.runs(bus, Stretching::NONE)),
        ));
        // The edge that takes the last answer is the end.
        prop_assert_eq!((t.time() - start) / 10_000, clocks + 1);
    }
}
