//! Recordings that do not start as every run does, repeated by Icarus and Verilator.
#![allow(missing_docs)]

use tilewright_gen::{testbench, tools, verilog};
use tilewright_hdl::*;
use tilewright_sim::{EngineKind, Simulation};

bundle! {
    struct TableIn<T> { at: T, write: T }
}

block! {
    /// Two rows of memories, of unknown and of known contents.
    struct Table;
    in = TableIn { at: bits(3), write: bit() };
    out TableOut { unknown: _, known: _, filled: _ }
}

impl Table {
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

block! {
    /// Registers without a reset, and memories whose lanes share addresses, share none, or are beyond a depth.
    struct Garbage;
    in GarbageIn { at: bits(3) }
    out GarbageOut {
        late: bits(70),
        lanes: bits(3).of(grid(2, 3)),
        started: bits(4),
        single: bit().of(row(1)),
        from_shared: bits(5).of(grid(2, 2)),
        from_own: bits(5).of(row(4)),
        from_gated: bits(6).of(row(2)),
        above: bits(9),
        words: bits(15),
    }
}

impl Garbage {
    fn build(&self, m: Module, i: GarbageIn) -> GarbageOut {
        def!(late = m.reg(70));
        late.next(late ^ i.at.zext(70));
        def!(lanes = m.reg(bits(3).of(grid(2, 3))));
        lanes.next(lanes + i.at);
        def!(started = m.reg(4).reset(3));
        started.next(i.at.zext(4));
        def!(single = m.reg(bit().of(row(1))));
        single.next(!single);
        def!(shared = m.memory(8, bits(5).of(grid(2, 2)), ReadUnderWrite::Old));
        def!(own = m.memory(8, bits(5).of(row(4)), ReadUnderWrite::Old));
        def!(gated = m.memory(5, bits(6).of(row(2)), ReadUnderWrite::Old));
        shared.write(i.at.eq(7), i.at, 1);
        gated.write(i.at.eq(4), i.at, 2);
        let addresses = constants(bits(3).of(row(4)), |lane| lane) + i.at;
        own.write(addresses.eq(1), addresses, 3);
        def!(nothing_reads = m.reg(bit()));
        nothing_reads.next(!nothing_reads);
        def!(inner = m.array(3, &Inner, |_| ()));
        GarbageOut {
            late: *late,
            lanes: *lanes,
            started: *started,
            single: *single,
            from_shared: shared.read(i.at),
            from_own: own.read(addresses),
            from_gated: gated.read_when(i.at.ne(6), i.at),
            above: inner.value.pack(),
            words: inner.word.pack(),
        }
    }
}

block! {
    /// A register that keeps what it starts with, and a memory that is read at once.
    struct Inner;
    out InnerOut { value: bits(3), word: bits(5) }
}

impl Inner {
    fn build(&self, m: Module, _: ()) -> InnerOut {
        def!(value = m.reg(3));
        value.next(value);
        def!(words = m.memory(8, 5, ReadUnderWrite::Any));
        def!(written = m.reg(3).reset(0));
        written.next(written + 1);
        words.write(written.eq(5), written, 1);
        InnerOut { value: *value, word: words.read_async(written) }
    }
}

#[test]
fn what_a_seed_fills_is_part_of_what_a_testbench_starts_from() {
    let design = elaborate(&Garbage).unwrap();
    for seed in [1, 7] {
        let mut sim = Simulation::of(&Garbage).unwrap().seeded(seed);
        let recorder = sim.recording();
        sim.poke_memory("shared[1][0]", 3, 9).unwrap();
        for at in (0..8).chain([6, 6, 4, 5]) {
            sim.set(sim.i.at, at);
            sim.step();
        }
        let recording = recorder.take();
        assert!(recording.steps[0].outputs.iter().filter(|value| !value.is_zero()).count() > 4, "{recording:?}");
        assert_eq!(recording.steps[0].outputs[2], Bits::new(4, 3));
        for kind in [EngineKind::Interpreter, EngineKind::Compiled] {
            let again = Simulation::of(&Garbage).unwrap().on(kind).starting_as(&recording);
            again.unwrap().replay(&recording).unwrap();
        }
        let (files, bench) = (verilog(&design), testbench(&design, &recording));
        let _ = tools::replay_in_icarus(&files, &bench).unwrap();
        let _ = tools::replay_in_verilator(&files, &bench).unwrap();
    }
}

block! {
    /// Without a clock.
    struct Sorted;
    in SortedIn { a: bits(8), b: bits(8) }
    out SortedOut { low: bits(8), high: bits(8) }
}

impl Sorted {
    fn build(&self, _: Module, i: SortedIn) -> SortedOut {
        let swaps = i.a.gt(i.b);
        SortedOut { low: mux(swaps, i.b, i.a), high: mux(swaps, i.a, i.b) }
    }
}

#[test]
fn what_has_no_clock_is_recorded_and_repeated() {
    let design = elaborate(&Sorted).unwrap();
    let mut sim = Simulation::of(&Sorted).unwrap();
    let recorder = sim.recording();
    let outputs = sim.stream([(3, 5), (5, 3), (255, 0)].map(|(a, b)| SortedIn { a, b }));
    assert_eq!(outputs.iter().map(|out| (out.low, out.high)).collect::<Vec<_>>(), [(3, 5), (3, 5), (0, 255)]);
    let (files, mut recording) = (verilog(&design), recorder.take());
    let _ = tools::replay_in_icarus(&files, &testbench(&design, &recording)).unwrap();
    let _ = tools::replay_in_verilator(&files, &testbench(&design, &recording)).unwrap();
    recording.steps[2].outputs[0] = Bits::new(8, 1);
    if let Err(problem) = tools::replay_in_icarus(&files, &testbench(&design, &recording)) {
        assert!(problem.to_string().contains("cycle 2: low is 00, expected 01"), "{problem}");
    } else {
        let _ = tools::skipped("iverilog");
    }
}
