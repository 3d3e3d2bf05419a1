//! Whole machines: words that go forth and back, and their clocks. `tilewright-machines` compares the times with those
//! of its transaction-level model.

use std::collections::VecDeque;

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::array::PixelArray;
use super::super::compositor::Mode;
use super::super::instruction::{Instruction, Sync};
use super::super::pixel::{Function, Mask, Source};
use super::*;

type Program = Vec<Instruction<u64>>;
type Jobs = [VecDeque<Job<u64>>; 2];

fn machine(nodes: u32, [width, height]: [u32; 2], words: u32, setup: u32) -> PixelFlow {
    PixelFlow { nodes, node: Node { array: PixelArray { width, height }, words, setup } }
}

/// A machine whose nodes have started their programs, and the jobs that are still to come.
struct Host {
    sim: Simulation<PixelFlowIn, PixelFlowOut>,
    jobs: Vec<Jobs>,
}

impl Host {
    fn new(machine: &PixelFlow, programs: &[Program], jobs: Vec<Jobs>) -> Host {
        let mut sim = Simulation::of(machine).unwrap();
        sim.reset();
        sim.set(sim.i.side_by_side, 1);
        sim.set(sim.i.textures_done, 0);
        let i = sim.i.clone();
        for number in 0..programs.len() {
            sim.set(i.textures[number].writes, 0);
            sim.set(i.frames[number].valid, 0);
            [&i.forth, &i.back].into_iter().for_each(|jobs| sim.set(jobs[number].valid, 0));
        }
        for address in 0..programs.iter().map(Vec::len).max().unwrap_or(0) {
            for (store, program) in i.stores.iter().zip(programs) {
                sim.set(store.writes, address < program.len());
                sim.set(store.address, address as u64);
                let Some(instruction) = program.get(address) else { continue };
                sim.set_record(store.instruction, *instruction);
            }
            sim.step_clock(ARRAY, 1);
        }
        for (number, program) in programs.iter().enumerate() {
            sim.set(i.stores[number].writes, 0);
            sim.set(i.frames[number].valid, 1);
            sim.set(i.frames[number].base, 0);
            sim.set(i.frames[number].length, program.len() as u64);
        }
        sim.step_clock(ARRAY, 1);
        (0..programs.len()).for_each(|number| sim.set(i.frames[number].valid, 0));
        Host { sim, jobs }
    }

    /// A clock of the network.
    fn step(&mut self) {
        let sim = &mut self.sim;
        for (number, jobs) in self.jobs.iter_mut().enumerate() {
            for (direction, jobs) in jobs.iter_mut().enumerate() {
                let port = if direction == 0 { sim.i.forth[number] } else { sim.i.back[number] };
                sim.set(port.valid, !jobs.is_empty());
                let Some(job) = jobs.front() else { continue };
                sim.set_record(port.payload, *job);
                if sim.get_u64(port.ready) == 1 {
                    jobs.pop_front();
                }
            }
        }
        sim.step();
    }

    /// Runs until all nodes have finished everything.
    fn run(&mut self) {
        let all = (1 << self.jobs.len()) - 1;
        loop {
            let out = self.sim.read_u64();
            let is_done = [out.idle, out.without_job[0], out.without_job[1]] == [all; 3];
            if is_done && self.jobs.iter().flatten().all(VecDeque::is_empty) {
                break;
            }
            assert!(self.sim.time() < 1_000_000_000, "the machine hangs");
            self.step();
        }
        // The last instructions end in the pixels.
        (0..40).for_each(|_| self.step());
    }
}

fn in_step(sync: Sync, bank: u64) -> Instruction<u64> {
    Instruction { sync: sync.code(), c: bank, ..Instruction::NOTHING }
}

const fn bank(number: u64) -> u64 {
    256 + 32 * number
}

/// Copies a word at every pixel.
fn copy(from: u64, to: u64, bytes: u64) -> Instruction<u64> {
    let (function, mask) = (Function::Word.code(), Mask::Everybody.code());
    Instruction { function, mask, stores: 1, length: bytes, read: from, write: to, ..Instruction::NOTHING }
}

/// A program that writes a word into a bank: at each pixel, the value of an expression.
fn drawn(number: u64, bytes: u64, [a, b, c]: [u64; 3]) -> Program {
    let (source, mask) = (Source::Expression.code(), Mask::Everybody.code());
    let word =
        Instruction { source, mask, stores: 1, length: bytes, write: bank(number), a, b, c, ..Instruction::NOTHING };
    vec![in_step(Sync::AwaitBank, number), word, in_step(Sync::GiveBank, number)]
}

fn at([a, b, c]: [u64; 3], [x, y]: [u32; 2], bytes: u64) -> u64 {
    let value = a.wrapping_mul(x.into()).wrapping_add(b.wrapping_mul(y.into())).wrapping_add(c);
    value & (u64::MAX >> (64 - 8 * bytes))
}

/// The programs and jobs of a machine whose first node collects the frame. Each rasterizer draws one word for each
/// region. The last nodes are shaders, which send back what they receive.
fn works(words: &[Vec<[u64; 3]>], shaders: usize, bytes: u64) -> (Vec<Program>, Vec<Jobs>) {
    let (rasterizers, regions) = (words.len(), words[0].len());
    let nodes = 1 + rasterizers + shaders;
    let mut programs = vec![Vec::new(); nodes];
    programs[0].extend([0, 1].map(|bank| in_step(Sync::GiveBank, bank)));
    (1 + rasterizers..nodes).for_each(|shader| programs[shader].push(in_step(Sync::GiveBank, 0)));
    let mut jobs = vec![Jobs::default(); nodes];
    for region in 0..regions {
        let (shader, own) = (1 + rasterizers + region % shaders, region as u64 % 2);
        let keeps = |bank, to| [in_step(Sync::AwaitBank, bank), copy(self::bank(bank), to, bytes)];
        for (program, words) in programs[1..].iter_mut().zip(words) {
            program.extend(drawn(own, bytes, words[region]));
        }
        programs[shader].extend(keeps(0, 0));
        programs[shader].extend([in_step(Sync::GiveBank, 0), in_step(Sync::AwaitBank, 1)]);
        programs[shader].extend([copy(0, bank(1), bytes), in_step(Sync::GiveBank, 1)]);
        programs[0].extend(keeps(own, 8 * region as u64));
        programs[0].push(in_step(Sync::GiveBank, own));
        for (node, [forth, back]) in jobs.iter_mut().enumerate() {
            let job = |mode: Mode, bank, bytes| Job { mode: mode.code(), bank, bytes };
            forth.push_back(match node {
                0 => job(Mode::Forward, 0, 0),
                1 => job(Mode::Load, own, bytes),
                _ if node <= rasterizers => job(Mode::Composite, own, bytes),
                _ if node == shader => job(Mode::Unload, 0, bytes),
                _ => job(Mode::Forward, 0, bytes),
            });
            back.push_back(match node {
                0 => job(Mode::Unload, own, bytes),
                _ if node < shader => job(Mode::Forward, 0, bytes),
                _ if node == shader => job(Mode::Load, 1, bytes),
                _ => job(Mode::Forward, 0, 0),
            });
        }
    }
    (programs, jobs)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    /// Words go forth to the shaders, round robin, and back to the first node.
    #[test]
    fn the_first_node_has_the_least_word_of_each_region(
        levels in prop::array::uniform2(1..3u32),
        (bytes, setup, shaders) in (1..5u64, 0..4u32, 1..3usize),
        words in (1..3usize, 1..6usize).prop_flat_map(|(rasterizers, regions)| {
            let coefficient = || prop_oneof![0..4u64, 0..1u64 << 40];
            let word = prop::array::uniform3(coefficient());
            prop::collection::vec(prop::collection::vec(word, regions), rasterizers)
        }),
    ) {
        let [width, height] = levels.map(|level| 1 << level);
        let (programs, jobs) = works(&words, shaders, bytes);
        let machine = machine(programs.len() as u32, [width, height], 64, setup);
        let mut host = Host::new(&machine, &programs, jobs);
        host.run();
        for region in 0..words[0].len() {
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let byte = |address: u64| {
                    let path = format!("u_node[0].u_array.u_pixel[{}][{}].memory", y / 2, y % 2 * width + x);
                    let address = 8 * region as u64 + address;
                    host.sim.peek_memory(&path, address as u32).unwrap().to_u64().unwrap() << (8 * (address % 8))
                };
                let found: u64 = (0..bytes).map(byte).sum();
                let least = words.iter().map(|words| at(words[region], [x, y], bytes)).min().unwrap();
                prop_assert_eq!(found, least, "region {}, pixel {} of line {}", region, x, y);
            }
        }
    }
}

/// Times count from the clock in which the last node becomes ready. The first byte leaves one clock later, and takes a
/// clock per node. Then the next job follows.
#[test]
fn a_byte_of_each_chip_passes_a_node_in_a_clock() {
    const SETUP: u64 = 3;
    let (programs, mut jobs) = works(&[vec![[1, 0, 0]], vec![[0, 1, 0]]], 1, 1);
    let machine = machine(4, [2, 2], 16, SETUP as u32);
    // The bank of a second word is never given, so the word never starts.
    jobs[1][0].push_back(Job { mode: Mode::Load.code(), bank: 1, bytes: 1 });
    let mut host = Host::new(&machine, &programs, jobs);
    let (mut go, mut off, mut without) = (Vec::new(), Vec::new(), Vec::new());
    for clock in 0..200 {
        let out = host.sim.read_u64();
        if out.go[0] == 1 {
            go.push(clock);
        }
        if out.off[0].valid == 1 {
            off.push(clock);
        }
        without.push(out.without_job[0]);
        host.step();
    }
    let [go] = go[..] else { panic!("all are ready in one clock: {go:?}") };
    // There are four nodes, and the word is one byte of four pixels. It does not pass the first node, which is before
    // the loading one.
    assert_eq!(off, [4, 5, 6, 7].map(|clock| go + clock));
    let is_done = |node: u32, clock: u64| without[clock as usize] >> node & 1 == 1;
    assert!(!is_done(0, go) && is_done(0, go + 1), "a job of no bytes");
    // The loading node sends the last byte 4 clocks after `go`, and has its next job at once.
    assert!((go..200).all(|clock| !is_done(1, clock)));
    assert!(!is_done(2, go + 5) && is_done(2, go + 6) && !is_done(3, go + 6) && is_done(3, go + 7));
}

#[test]
fn there_is_no_machine_of_one_node() {
    let complaint = |nodes| machine(nodes, [2, 2], 1, 0).checked().unwrap_err().to_string();
    assert_eq!(complaint(1), "`nodes` of `PixelFlow` is 1: it has to be from 2 to 64");
    assert_eq!(complaint(65), "`nodes` of `PixelFlow` is 65: it has to be from 2 to 64");
}
