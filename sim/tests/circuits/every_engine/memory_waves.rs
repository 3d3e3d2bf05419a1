//! Words of memories in waveform files.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use vcd::{Command, IdCode, Parser, ScopeItem};

use crate::circuits::engine::{engine, of};
use tilewright_hdl::*;
use tilewright_sim::{Simulation, Trace, Vcd};

block! {
    /// Keeps wide words, and beside them a bit for each in two lanes.
    struct Store;
    in StoreIn { write: bit(), to: bits(3), data: bits(70) }
    out StoreOut { word: bits(70), bits: bit().of(2) }
}

impl Store {
    fn build(&self, m: Module, i: StoreIn) -> StoreOut {
        def!(wide = m.memory(8, 70, ReadUnderWrite::Old).fill(3));
        def!(flags = m.memory(8, bit().of(row(2)), ReadUnderWrite::Old).fill(0));
        wide.write(i.write, i.to, i.data);
        flags.write(i.write, i.to, stack([i.data.bit(0), i.data.bit(1)]));
        StoreOut { word: wide.read(i.to), bits: flags.read(i.to) }
    }
}

block! {
    /// Two stores, of which one gets the inverse.
    struct Stores;
    in StoresIn { write: bit(), to: bits(3), data: bits(70), fails: bit() }
    out StoresOut { word: bits(70) }
}

impl Stores {
    fn build(&self, m: Module, i: StoresIn) -> StoresOut {
        m.assert(!i.fails, "it fails when it is told to");
        let stores =
            m.array("u_store", 2, &Store, |_| StoreIn { write: i.write, to: i.to, data: stack([i.data, !i.data]) });
        StoresOut { word: stores.word.lane(0) }
    }
}

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{:?}_{name}", engine()))
}

/// Does something new at each of some clocks.
fn run(sim: &mut Simulation<StoresIn, StoresOut>, clock: u64) {
    sim.set(sim.i.write, clock % 3 != 2);
    sim.set(sim.i.to, 5 * clock % 8);
    sim.set(sim.i.data, u128::from(clock) << 60 | u128::from(clock % 7));
    sim.step();
}

/// The variables of a file by path, as in the Verilog, each with the times of its changes and its values.
fn read(name: &str) -> BTreeMap<String, Vec<(u64, u128)>> {
    fn collect(item: &ScopeItem, path: &str, all: &mut BTreeMap<IdCode, String>) {
        match item {
            ScopeItem::Scope(scope) => {
                let inner = if path.is_empty() { String::new() } else { format!("{path}{}.", scope.identifier) };
                let inner = if path.is_empty() { ".".to_owned() } else { inner };
                scope.items.iter().for_each(|item| collect(item, &inner, all));
            }
            ScopeItem::Var(variable) => {
                let path = path.replace(".lane.", ".").trim_start_matches('.').to_owned();
                all.insert(variable.code, format!("{path}{}", variable.reference));
            }
            _ => {}
        }
    }
    let text = fs::read(path(name)).unwrap();
    let mut parser = Parser::new(&text[..]);
    let (mut names, mut all, mut now) = (BTreeMap::new(), BTreeMap::<String, Vec<_>>::new(), 0);
    parser.parse_header().unwrap().items.iter().for_each(|item| collect(item, "", &mut names));
    let number = |bits: &mut dyn Iterator<Item = vcd::Value>| {
        bits.fold(0, |number, bit| 2 * number + u128::from(bit == vcd::Value::V1))
    };
    for command in parser {
        let (code, value) = match command.unwrap() {
            Command::Timestamp(time) => {
                now = time;
                continue;
            }
            Command::ChangeScalar(code, value) => (code, number(&mut std::iter::once(value))),
            Command::ChangeVector(code, value) => (code, number(&mut value.iter())),
            _ => continue,
        };
        all.entry(names[&code].clone()).or_default().push((now, value));
    }
    all
}

/// What the words are at each clock of a run without a file.
fn expected(clocks: std::ops::Range<u64>, names: &[(String, u32)]) -> BTreeMap<String, Vec<(u64, u128)>> {
    let mut sim = of(&Stores);
    let mut all = BTreeMap::<String, Vec<(u64, u128)>>::new();
    for clock in 0..clocks.end {
        for (name, address) in names.iter().filter(|_| clock >= clocks.start) {
            let value = sim.peek_memory(name, *address).unwrap().to_u128().unwrap();
            let changes = all.entry(format!("{name}[{address}]")).or_default();
            if changes.last().is_none_or(|last| last.1 != value) {
                changes.push((10_000 * clock, value));
            }
        }
        run(&mut sim, clock);
    }
    all
}

/// The memories of one store with addresses.
fn words(store: u32, addresses: std::ops::Range<u32>) -> Vec<(String, u32)> {
    let names = ["wide", "flags[0]", "flags[1]"].map(|name| format!("u_store[{store}].{name}"));
    names.into_iter().flat_map(|name| addresses.clone().map(move |address| (name.clone(), address))).collect()
}

fn traced(trace: Trace, clocks: u64) {
    let mut sim = of(&Stores);
    sim.trace(trace).unwrap();
    (0..clocks).for_each(|clock| run(&mut sim, clock));
    sim.finish().unwrap();
}

#[test]
fn words_are_in_a_file_with_the_names_and_values_that_peek_has() {
    let trace = Vcd::to(path("words.vcd")).only("to").words("u_store[1].*", 2..6).words("u_store[0].wide", 5..99);
    traced(trace, 20);
    let mut names = words(1, 2..6);
    names.extend((5..8).map(|address| ("u_store[0].wide".to_owned(), address)));
    let mut shown = read("words.vcd");
    shown.retain(|name, _| name.starts_with("u_store"));
    assert_eq!(shown, expected(0..21, &names));
    assert!(shown["u_store[1].wide[2]"].len() > 2 && shown["u_store[1].flags[1][3]"].len() > 1);
}

#[test]
fn a_part_of_the_time_and_a_flight_recorder_have_words_too() {
    traced(Vcd::to(path("part.vcd")).only("to").words("stores.u_store[0].lane.*", 0..8).times(70_000..120_000), 20);
    let mut shown = read("part.vcd");
    shown.retain(|name, _| name.starts_with("u_store"));
    assert_eq!(shown, expected(7..12, &words(0, 0..8)));

    let mut sim = of(&Stores);
    sim.trace(Vcd::to(path("flight.vcd")).only("to").words("u_store[1].**", 0..8).last(5)).unwrap();
    (0..12).for_each(|clock| run(&mut sim, clock));
    sim.set(sim.i.fails, 1);
    assert!(sim.try_step().is_err());
    let mut shown = read("flight.vcd");
    shown.retain(|name, _| name.starts_with("u_store"));
    assert_eq!(shown, expected(8..13, &words(1, 0..8)));
}

#[test]
fn a_word_that_is_poked_is_shown_although_no_port_writes_it() {
    let mut sim = of(&Stores);
    sim.trace(Vcd::to(path("poked.vcd")).only("to").words("u_store[0].wide", 0..8)).unwrap();
    for clock in 0..12 {
        if clock == 5 {
            sim.poke_memory("u_store[0].wide", 6, 1_u128 << 40).unwrap();
        }
        run(&mut sim, clock);
    }
    sim.finish().unwrap();
    let changes = &read("poked.vcd")["u_store[0].wide[6]"];
    assert!(changes.contains(&(50_000, 1 << 40)), "{changes:?}");
}

#[test]
fn a_file_without_words_is_as_it_was() {
    traced(Vcd::to(path("without.vcd")), 8);
    traced(Vcd::to(path("with.vcd")).words("**.wide", 0..1), 8);
    let (without, with) = (read("without.vcd"), read("with.vcd"));
    assert!(without.iter().all(|(name, changes)| with[name] == *changes));
    assert_eq!(with.len(), without.len() + 2);
}

block! {
    /// Writes both words at each edge, and first the one of the address.
    struct Both;
    in BothIn { at: bit(), data: bits(8) }
    out BothOut { word: bits(8) }
}

impl Both {
    fn build(&self, m: Module, i: BothIn) -> BothOut {
        def!(kept = m.memory(2, 8, ReadUnderWrite::Old).fill(0).true_dual_port());
        kept.write(lit(1, 1), i.at, i.data);
        kept.write(lit(1, 1), !i.at, !i.data);
        BothOut { word: kept.read(i.at) }
    }
}

#[test]
fn words_of_one_edge_are_in_the_order_of_their_addresses() {
    let mut sim = of(&Both);
    sim.trace(Vcd::to(path("both.vcd")).only("at").words("kept", 0..2)).unwrap();
    for data in 1..5_u64 {
        sim.set(sim.i.at, data % 2);
        sim.set(sim.i.data, data);
        sim.step();
    }
    sim.finish().unwrap();
    let text = fs::read_to_string(path("both.vcd")).unwrap();
    let ids: Vec<&str> =
        text.lines().filter_map(|line| line.strip_prefix('b')?.split_once(' ')).map(|it| it.1).collect();
    let [first, second] = [ids[0], ids[1]];
    assert!(first != second && ids.len() == 10, "{text}");
    assert!(ids.chunks(2).all(|pair| pair == [first, second]), "{text}");
}

#[test]
fn what_matches_no_memory_or_too_many_words_is_refused() {
    let sim = of(&Stores);
    let refused = |trace: Trace| sim.trace_header(&trace).unwrap_err().to_string();
    let message = refused(Vcd::to(path("none.vcd")).words("u_store[0].wdie", 0..8));
    assert_eq!(message, "there is no memory that matches `u_store[0].wdie`: did you mean `u_store[0].wide`?");
    let message = refused(Vcd::to(path("none.vcd")).words("nothing", 0..8));
    assert_eq!(message, "there is no memory that matches `nothing`: there are `u_store[*].flags`, `u_store[*].wide`");
    let mut all = Vcd::to(path("none.vcd"));
    for _ in 0..86 {
        all = all.words("**", 0..u32::MAX);
    }
    let message = refused(all);
    assert_eq!(
        message,
        "the waveform would have 4128 words of memories, and the limit is 4096: name fewer memories or addresses"
    );
    assert!(!path("none.vcd").exists());
}
