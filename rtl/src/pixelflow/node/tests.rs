//! Chains of nodes that compose regions in both directions.

use proptest::prelude::*;
use std::collections::VecDeque;
use tilewright_sim::Simulation;

use super::super::compositor::Mode;
use super::super::instruction::{Instruction, Sync};
use super::super::pixel::{Function, Mask, Source};
use super::super::testing::{processor_time, triangle};
use super::*;

fn node(width: u32, height: u32, words: u32, setup: u32) -> Node {
    Node { array: PixelArray { width, height }, words, setup }
}

/// A chain of nodes, with the jobs that are still to come.
struct Line {
    node: Node,
    sims: Vec<Simulation<NodeIn, NodeOut>>,
    jobs: Vec<[VecDeque<Job<u64>>; 2]>,
    /// For each direction, the clocks of the network in which bytes arrive at the last node.
    arrived: [Vec<u64>; 2],
    clock: u64,
}

impl Line {
    fn new(node: &Node, programs: &[Vec<Instruction<u64>>], jobs: Vec<[VecDeque<Job<u64>>; 2]>) -> Line {
        let sims = programs.iter().map(|program| started(node, program)).collect();
        Line { node: node.clone(), sims, jobs, arrived: [Vec::new(), Vec::new()], clock: 0 }
    }

    /// A clock of the network.
    fn step(&mut self) {
        for direction in 0..2 {
            let nodes: Vec<usize> =
                if direction == 0 { (0..self.sims.len()).collect() } else { (0..self.sims.len()).rev().collect() };
            let go = self.sims.iter_mut().all(|sim| sim.get_u64(sim.o.network[direction].ready) == 1);
            let mut before = ([0, 0], vec![0; self.node.port().chips as usize]);
            for &number in &nodes {
                let sim = &mut self.sims[number];
                let (i, o) = (sim.i.network[direction], sim.o.network[direction]);
                let flags = [sim.get_u64(o.downstream.valid), sim.get_u64(o.downstream.first)];
                let ([valid, first], bytes) = std::mem::replace(&mut before, (flags, sim.lanes(o.downstream.bytes)));
                sim.set(i.upstream.valid, valid);
                sim.set(i.upstream.first, first);
                sim.set_lanes(i.upstream.bytes, bytes);
                sim.set(i.go, go);
                let jobs = &mut self.jobs[number][direction];
                sim.set(i.jobs.valid, !jobs.is_empty());
                if let Some(job) = jobs.front() {
                    sim.set(i.jobs.mode, job.mode);
                    sim.set(i.jobs.bank, job.bank);
                    sim.set(i.jobs.bytes, job.bytes);
                    if sim.get_u64(i.jobs.ready) == 1 {
                        jobs.pop_front();
                    }
                }
                if Some(&number) == nodes.last() && valid == 1 {
                    self.arrived[direction].push(self.clock);
                }
            }
        }
        self.sims.iter_mut().for_each(Simulation::step);
        self.clock += 1;
    }

    /// Runs until all nodes have finished; fails after `limit` clocks.
    fn run(&mut self, limit: u64) {
        while !self.is_idle() {
            assert!(self.clock < limit, "the nodes are not done after {limit} clocks");
            self.step();
        }
        // The last instructions end in the pixels.
        (0..4 * self.node.array.latency()).for_each(|_| self.step());
    }

    fn is_idle(&mut self) -> bool {
        self.jobs.iter().flatten().all(VecDeque::is_empty)
            && self.sims.iter_mut().all(|sim| {
                let [first, second] = [0, 1].map(|direction| sim.get_u64(sim.o.network[direction].idle) == 1);
                first && second && sim.get_u64(sim.o.idle) == 1
            })
    }

    /// A word of `bytes` bytes in a pixel's memory.
    fn word(&self, node: usize, [x, y]: [u32; 2], address: u32, bytes: u32) -> u64 {
        let byte = |at: u32| {
            let path = format!("u_array.u_pixel[{}][{}].memory", y / 2, y % 2 * self.node.array.width + x);
            self.sims[node].peek_memory(&path, address + at).unwrap().to_u64().unwrap()
        };
        (0..bytes).map(|at| byte(at) << (8 * at)).sum()
    }
}

/// A node that has started its program.
fn started(node: &Node, program: &[Instruction<u64>]) -> Simulation<NodeIn, NodeOut> {
    let mut sim = Simulation::of(node).unwrap();
    sim.reset();
    let i = sim.i.clone();
    sim.set(i.side_by_side, 1);
    sim.set(i.store.writes, 1);
    for (address, instruction) in program.iter().enumerate() {
        sim.set(i.store.address, address as u64);
        sim.set_record(i.store.instruction, *instruction);
        sim.step_clock(ARRAY, 1);
    }
    sim.set(i.store.writes, 0);
    sim.set(i.frames.valid, 1);
    sim.set(i.frames.base, 0);
    sim.set(i.frames.length, program.len() as u64);
    sim.step_clock(ARRAY, 1);
    sim.set(i.frames.valid, 0);
    sim
}

fn in_step(sync: Sync, bank: u64) -> Instruction<u64> {
    Instruction { sync: sync.code(), c: bank, ..Instruction::NOTHING }
}

const fn bank(number: u64) -> u64 {
    256 + 32 * number
}

/// A program that writes a word into a bank for the network: at each pixel, the value of an expression.
fn drawn(number: u64, bytes: u64, [a, b, c]: [u64; 3]) -> Vec<Instruction<u64>> {
    let (source, mask) = (Source::Expression.code(), Mask::Everybody.code());
    let word =
        Instruction { source, mask, stores: 1, length: bytes, write: bank(number), a, b, c, ..Instruction::NOTHING };
    vec![in_step(Sync::AwaitBank, number), word, in_step(Sync::GiveBank, number)]
}

/// A program that takes a word, and copies it into its memory.
fn taken(number: u64, bytes: u64, address: u64) -> Vec<Instruction<u64>> {
    let (function, mask) = (Function::Word.code(), Mask::Everybody.code());
    let copy = Instruction {
        function,
        mask,
        stores: 1,
        length: bytes,
        read: bank(number),
        write: address,
        ..Instruction::NOTHING
    };
    vec![in_step(Sync::GiveBank, number), in_step(Sync::AwaitBank, number), copy]
}

/// The value of an expression at a pixel, in `bytes` bytes.
fn at([a, b, c]: [u64; 3], [x, y]: [u32; 2], bytes: u32) -> u64 {
    let value = a.wrapping_mul(x.into()).wrapping_add(b.wrapping_mul(y.into())).wrapping_add(c);
    value & (u64::MAX >> (64 - 8 * bytes))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    /// Regions come one after another in alternating banks, so that one is composed while the next is drawn. The last
    /// node keeps them all.
    #[test]
    fn the_last_node_has_the_least_word_of_each_region(
        direction in 0..2usize,
        levels in prop::array::uniform2(1..3u32),
        bytes in 1..5u32,
        setup in 0..3u32,
        (nodes, regions, words) in (2..4usize, 1..5usize).prop_flat_map(|(nodes, regions)| {
            let coefficient = || prop_oneof![0..4u64, 0..1u64 << 40];
            let word = prop::array::uniform3(coefficient());
            (Just(nodes), Just(regions), prop::collection::vec(prop::collection::vec(word, regions), nodes - 1))
        }),
    ) {
        let [width, height] = levels.map(|level| 1 << level);
        let node = node(width, height, 64, setup);
        let place = |number: usize| if direction == 0 { number } else { nodes - 1 - number };
        let mut programs = vec![Vec::new(); nodes];
        let mut jobs = vec![[VecDeque::new(), VecDeque::new()]; nodes];
        for region in 0..regions {
            let bank = region as u64 % 2;
            for number in 0..nodes {
                let (program, mode) = match words.get(number) {
                    Some(words) => {
                        let mode = if number == 0 { Mode::Load } else { Mode::Composite };
                        (drawn(bank, bytes.into(), words[region]), mode)
                    }
                    None => (taken(bank, bytes.into(), 8 * region as u64), Mode::Unload),
                };
                programs[place(number)].extend(program);
                jobs[place(number)][direction].push_back(Job { mode: mode.code(), bank, bytes: bytes.into() });
            }
        }
        let mut line = Line::new(&node, &programs, jobs);
        line.run(20_000);
        for (region, (x, y)) in
            (0..regions).flat_map(|region| (0..height).flat_map(move |y| (0..width).map(move |x| (region, (x, y)))))
        {
            let least = words.iter().map(|words| at(words[region], [x, y], bytes)).min().unwrap();
            let found = line.word(place(nodes - 1), [x, y], 8 * region as u32, bytes);
            prop_assert_eq!(found, least, "region {}, pixel {} of line {}", region, x, y);
        }
        // A byte of all pixels takes a clock for each pixel of a chip, without a pause.
        let clocks = &line.arrived[direction];
        let region = (bytes * node.port().pixels) as usize;
        prop_assert_eq!(clocks.len(), regions * region);
        for clocks in clocks.chunks(region) {
            prop_assert_eq!(clocks[region - 1] - clocks[0], region as u64 - 1);
        }
    }
}

/// While one word goes from the first node to the last, another one goes back, from the other bank.
#[test]
fn words_go_both_ways_at_once() {
    let node = node(4, 4, 16, 0);
    let (forth, back) = ([3, 50, 0x1234], [7, 1, 0x0f0f]);
    let job = |mode: Mode, bank| VecDeque::from([Job { mode: mode.code(), bank, bytes: 2 }]);
    let both = |drawn_in: u64, word, taken_in: u64| {
        let give = in_step(Sync::GiveBank, taken_in);
        let copy = taken(taken_in, 2, 0)[1..].to_vec();
        [drawn(drawn_in, 2, word), vec![give], copy].concat()
    };
    let jobs = vec![
        [job(Mode::Load, 0), job(Mode::Unload, 1)],
        [job(Mode::Forward, 0), job(Mode::Forward, 0)],
        [job(Mode::Unload, 0), job(Mode::Load, 1)],
    ];
    let mut line = Line::new(&node, &[both(0, forth, 1), vec![Instruction::NOTHING], both(1, back, 0)], jobs);
    line.run(2000);
    for pixel in (0..4).flat_map(|y| (0..4).map(move |x| [x, y])) {
        assert_eq!(line.word(2, pixel, 0, 2), at(forth, pixel, 2));
        assert_eq!(line.word(0, pixel, 0, 2), at(back, pixel, 2));
    }
    let [first, second] = &line.arrived;
    let last = |clocks: &Vec<u64>| *clocks.last().unwrap();
    assert!(first[0] < last(second) && second[0] < last(first), "they were under way at the same time");
}

#[test]
fn there_is_no_node_of_any_other_size() {
    let complaint = |words, setup| node(4, 4, words, setup).checked().unwrap_err().to_string();
    assert_eq!(complaint(0, 0), "`words` of `Node` is 0: it has to be from 1 to 1048576");
    assert_eq!(complaint(8, 65_537), "`setup` of `Node` is 65537: it has to be at most 65536");
    let complaint = PixelArray { width: 12, height: 4 }.checked().unwrap_err().to_string();
    assert_eq!(complaint, "`width` of `PixelArray` is 12: it has to be a power of two, from 2 to 256");
}

/// Prints the nanoseconds per clock of a whole node that draws one word while it sends another:
/// `cargo test --release -p tilewright-rtl --lib -- --ignored --nocapture nanoseconds_of_the_machine_s_node`
#[test]
#[ignore = "it measures"]
fn nanoseconds_of_the_machine_s_node() {
    const LONG: usize = 4000;
    let node = node(128, 64, 8192, 0);
    let draws: Vec<Instruction<u64>> = triangle([[1, 2, 3]; 3], 4, [[70_000, 50_000, 1 << 30]; 4]);
    let program: Vec<Instruction<u64>> = draws.iter().copied().cycle().take(LONG).collect();
    let give = [in_step(Sync::GiveBank, 0)];
    for (what, mode) in [
        ("nothing passes", None),
        ("it loads", Some(Mode::Load)),
        ("it unloads", Some(Mode::Unload)),
        ("it composes", Some(Mode::Composite)),
    ] {
        let mut sim = started(&node, &[&give[..], &program].concat());
        let i = sim.i.network[0];
        if let Some(mode) = mode {
            sim.set(i.jobs.valid, 1);
            sim.set(i.jobs.mode, mode.code());
            sim.set(i.jobs.bytes, 32);
            sim.set(i.go, 1);
            sim.run(40);
            sim.set(i.upstream.valid, mode != Mode::Load);
            sim.set(i.jobs.valid, 0);
        }
        sim.run(500);
        let nanoseconds = [0; 6].map(|_| {
            let begin = processor_time();
            sim.run(1000);
            (processor_time() - begin) / 500
        });
        println!("{what}: {nanoseconds:?} ns per clock of the array, with two of the network");
        assert_eq!(sim.get_u64(sim.o.idle), 0);
    }
}
