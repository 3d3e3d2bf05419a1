//! A waveform file compared with the circuit. At each instant it shows the value of every signal, whatever changed or
//! did not. A flight recorder writes what a file from the start would have contained.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::circuits::engine::{engine, of};
use proptest::prelude::*;
use tilewright_hdl::{Bits, Clock, Module, Period, ReadUnderWrite, bit, bits, block, codes, hold, mux, stack, when};
use tilewright_sim::{Error, Simulation, Vcd};
use vcd::{Command, IdCode, Parser, ScopeItem};

const FAST: Clock = Clock::new("fast", Period::ps(2_000));
const SLOW: Clock = Clock::new("slow", Period::ps(7_000));

codes! {
    enum Door { Shut, Ajar, Open }
}

block! {
    /// A door, and a wide sum that grows while it is open.
    struct Cell;
    in CellIn { push: bit().on(FAST), seed: bits(70).on(FAST) }
    out CellOut { total: _, open: _ }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let m = m.on(FAST);
        let door = m.fsm("door", Door::Shut);
        door.next(|now| match now {
            Door::Shut => when(i.push, Door::Ajar),
            Door::Ajar => when(i.push, Door::Open),
            Door::Open => hold(),
        });
        let open = door.is(Door::Open);
        let total = m.reg("total", 70).reset(0);
        total.enable(open).next(total + i.seed);
        CellOut { total: *total, open }
    }
}

block! {
    /// Five of them on a fast clock; on a slow clock, a shelf that is read asynchronously, and a count that stops.
    struct House;
    in HouseIn { push: bits(5).on(FAST), seed: bits(70).on(FAST), shelf: bits(2).on(SLOW), fail: bit().on(FAST) }
    out HouseOut { widest: _, open: _, word: _, slow_count: _ }
}

impl House {
    fn build(&self, m: Module, i: HouseIn) -> HouseOut {
        m.on(FAST).assert(!i.fail, "all is well");
        let cells = m.array("u_cell", 5, &Cell, |_| CellIn {
            push: stack((0..5).map(|lane| i.push.bit(lane)).collect::<Vec<_>>()),
            seed: i.seed,
        });
        let slow = m.on(SLOW);
        let count = slow.reg("count", 3).reset(0);
        count.next(mux(count.eq(7), 7, count + 1));
        let words = slow.memory("words", 4, 9, ReadUnderWrite::Old);
        HouseOut {
            widest: cells.total.xor_all(),
            open: cells.open.or_all(),
            word: words.read_async(i.shelf),
            slow_count: *count,
        }
    }
}

/// An action before an instant.
#[derive(Debug, Clone)]
enum Action {
    Nothing,
    Push(u64),
    /// The low and the high limb.
    Seed(u64, u64),
    Look(u64),
    Poke(u32, u64),
}

fn action() -> impl Strategy<Value = Action> {
    prop_oneof![
        6 => Just(Action::Nothing),
        2 => (0..32_u64).prop_map(Action::Push),
        2 => (0..3_u64, 0..3_u64).prop_map(|(low, high)| Action::Seed(u64::MAX / 2 * low, high)),
        1 => (0..4_u64).prop_map(Action::Look),
        1 => (0..4_u32, 0..512_u64).prop_map(|(address, word)| Action::Poke(address, word)),
    ]
}

fn apply(sim: &mut Simulation<HouseIn, HouseOut>, action: &Action) {
    match action {
        Action::Nothing => {}
        Action::Push(doors) => sim.set(sim.i.push, *doors),
        Action::Seed(low, high) => sim.set(sim.i.seed, Bits::from_limbs(70, &[*low, *high])),
        Action::Look(address) => sim.set(sim.i.shelf, *address),
        Action::Poke(address, word) => sim.poke_memory("words", *address, *word).unwrap(),
    }
}

/// The signals that are compared, besides the states of `u_cell[..].door`.
fn signals() -> Vec<String> {
    let top = ["push", "seed", "shelf", "fail", "widest", "open", "word", "slow_count", "count"];
    let inside = ["push", "seed", "total", "open", "door"];
    let cells = (0..5).flat_map(|lane| inside.map(|name| format!("u_cell[{lane}].{name}")));
    top.into_iter().map(str::to_string).chain(cells).collect()
}

/// The values of the signals, by name, from a time on.
type Look = (u64, Vec<(String, Bits)>);

fn look(sim: &mut Simulation<HouseIn, HouseOut>) -> Look {
    let values = signals().into_iter().map(|name| (name.clone(), sim.peek(&name).unwrap())).collect();
    (sim.time(), values)
}

/// The identifiers by path, as a simulation names it.
fn identifiers(items: &[ScopeItem], path: &str, all: &mut HashMap<String, IdCode>) {
    for item in items {
        match item {
            ScopeItem::Var(variable) => drop(all.insert(format!("{path}{}", variable.reference), variable.code)),
            ScopeItem::Scope(scope) if scope.identifier == "lane" => identifiers(&scope.items, path, all),
            ScopeItem::Scope(scope) => identifiers(&scope.items, &format!("{path}{}.", scope.identifier), all),
            _ => {}
        }
    }
}

/// Panics unless the file shows these values at each of these times. Its first time must be `from`.
fn expect_shown(file: &Path, from: u64, seen: &[Look]) {
    let bytes = fs::read(file).unwrap();
    let mut parser = Parser::new(&bytes[..]);
    let header = parser.parse_header().unwrap();
    let mut ids = HashMap::new();
    identifiers(&header.items, "", &mut ids);
    let commands: Vec<Command> = parser.map(|command| command.unwrap()).collect();
    assert_eq!(commands[0], Command::Timestamp(from));
    let mut values: HashMap<IdCode, String> = HashMap::new();
    let mut at = 0;
    for (time, signals) in seen.iter().filter(|look| look.0 >= from) {
        while let Some(command) = commands.get(at) {
            match command {
                Command::Timestamp(next) if next > time => break,
                Command::ChangeScalar(id, value) => drop(values.insert(*id, value.to_string())),
                Command::ChangeVector(id, digits) => drop(values.insert(*id, digits.to_string())),
                Command::ChangeString(id, state) => drop(values.insert(*id, state.clone())),
                _ => {}
            }
            at += 1;
        }
        for (name, value) in signals {
            let shown = |name: &str| values[&ids[&format!("house.{name}")]].as_str();
            let digits = format!("{value:b}");
            let digits = digits.trim_start_matches('0');
            assert_eq!(shown(name), if digits.is_empty() { "0" } else { digits }, "{name} at {time} ps");
            if name.ends_with("door") {
                let state = ["Shut", "Ajar", "Open"][value.to_u64().unwrap() as usize];
                assert_eq!(shown(&format!("{name}_state")), state, "{name} at {time} ps");
            }
        }
    }
}

/// Panics unless the file of a run from the start has all edges of a clock.
fn expect_clock(file: &Path, name: &str, period: u64) {
    let bytes = fs::read(file).unwrap();
    let mut parser = Parser::new(&bytes[..]);
    let clock = parser.parse_header().unwrap().find_var(&["house", name]).unwrap().code;
    let (mut time, mut shown) = (0, Vec::new());
    for command in parser {
        match command.unwrap() {
            Command::Timestamp(next) => time = next,
            Command::ChangeScalar(id, level) if id == clock => shown.push((time, level == vcd::Value::V1)),
            _ => {}
        }
    }
    let edges = (2..=2 * time / period).map(|half| (half * period / 2, half % 2 == 0));
    let expected: Vec<(u64, bool)> = std::iter::once((0, false)).chain(edges).collect();
    assert_eq!(shown, expected, "{name}");
}

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{:?}_{name}", engine()))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Many instants change nothing, or only one clock's values, so that skipping is tested too.
    #[test]
    fn a_file_shows_what_every_signal_is(actions in prop::collection::vec((action(), 1..4_usize), 8..60)) {
        let [whole, long, short] = ["whole_values.vcd", "long_flight.vcd", "short_flight.vcd"].map(path);
        let mut sim = of(&House);
        sim.trace(Vcd::to(&whole)).unwrap();
        sim.trace(Vcd::to(&long).last(1000)).unwrap();
        sim.trace(Vcd::to(&short).last(5)).unwrap();
        let mut seen = Vec::new();
        for (action, steps) in &actions {
            apply(&mut sim, action);
            for _ in 0..*steps {
                seen.push(look(&mut sim));
                sim.step();
            }
        }
        sim.set(sim.i.fail, true);
        loop {
            seen.push(look(&mut sim));
            match sim.try_step() {
                Ok(()) => continue,
                Err(Error::Violated(_)) => break,
                Err(other) => panic!("{other}"),
            }
        }
        expect_shown(&whole, 0, &seen);
        expect_clock(&whole, "fast_clk", 2_000);
        expect_clock(&whole, "slow_clk", 7_000);
        expect_shown(&short, seen[seen.len() - 5].0, &seen);
        prop_assert!(fs::read(&whole).unwrap() == fs::read(&long).unwrap(), "the flight recorder wrote something else");
    }
}
