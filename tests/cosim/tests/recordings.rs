//! Recordings that do not start as every run does, repeated by Icarus and Verilator.
#![allow(missing_docs)]

use tilewright_gen::{testbench, tools, verilog};
use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    struct TableIn<T> { at: T, write: T }
    struct TableOut<T> { unknown: T, known: T, filled: T }
}

/// Two rows of memories, of unknown and of known contents.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Table;

impl Block for Table {
    type In = TableIn;
    type Out = TableOut;

    fn inputs(&self) -> TableIn<Width> {
        TableIn { at: bits(3), write: bit() }
    }

    fn build(&self, m: Module, i: TableIn) -> TableOut {
        let unknown = m.memory("unknowns", 8, 8, ReadUnderWrite::Old);
        let known = m.memory("knowns", 8, 8, ReadUnderWrite::Old).words((0..5).map(|word| Bits::new(8, 16 + word)));
        let filled = m.memory("fills", 8, 8, ReadUnderWrite::Old).fill(Bits::new(8, 7));
        [unknown, known, filled].iter().for_each(|memory| memory.write(i.write, i.at, 0));
        TableOut { unknown: unknown.read(i.at), known: known.read(i.at), filled: filled.read_async(i.at) }
    }
}

bundle! {
    struct RowOut<T> { all: T }
}

/// Tables in an array.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Row;

impl Block for Row {
    type In = TableIn;
    type Out = RowOut;

    fn inputs(&self) -> TableIn<Width> {
        Table.inputs()
    }

    fn build(&self, m: Module, i: TableIn) -> RowOut {
        let tables = m.array("u_table", 3, &Table, |_| i);
        let all = [tables.unknown, tables.known, tables.filled].into_iter().flat_map(Signal::to_vec);
        RowOut { all: concat(&all.collect::<Vec<_>>()) }
    }
}

#[test]
fn poked_memories_are_part_of_what_a_testbench_starts_from() {
    let design = elaborate(&Row).unwrap();
    let mut sim = Simulation::of(&Row).unwrap();
    sim.poke_memory("u_table[1].unknowns", 2, 0x99).unwrap();
    let recorder = sim.recording();
    sim.poke_memory("u_table[2].knowns", 6, 0x66).unwrap();
    sim.poke_memory("u_table[0].knowns", 0, 0).unwrap();
    sim.poke_memory("u_table[0].fills", 3, 0x33).unwrap();
    let mut words = Vec::new();
    for at in 0..8 {
        sim.set(sim.i.at, at);
        sim.step();
        words.push(sim.get(sim.o.all));
    }
    // The words of lane 0 of a memory are above those of lane 2, and so is the first memory above the last.
    let word =
        |at: usize, memory: u32, lane: u32| words[at].slice(8 * (8 - 3 * memory - lane)..8 * (9 - 3 * memory - lane));
    let poked = [word(2, 0, 1), word(6, 1, 2), word(0, 1, 0), word(3, 2, 0)];
    assert_eq!(poked, [0x99, 0x66, 0, 0x33].map(|word| Bits::new(8, word)));
    assert_eq!([word(0, 1, 1), word(3, 2, 1)], [16, 7].map(|word| Bits::new(8, word)));
    let (files, bench) = (verilog(&design), testbench(&design, &recorder.take()));
    let _ = tools::replay_in_icarus(&files, &bench).unwrap();
    let _ = tools::replay_in_verilator(&files, &bench).unwrap();
}
