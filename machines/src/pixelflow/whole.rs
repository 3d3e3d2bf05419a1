//! A whole machine in one simulation, with which the model's times are compared.
//!
//! The block [`PixelFlow`] has all nodes, with their instruction memories, and the network. The shaders' texture units, and the frame buffer at the texture port of
//! its node, are simulated separately.

use std::collections::VecDeque;
use std::ops::Range;

use tilewright_rtl::pixelflow::ARRAY;
use tilewright_rtl::pixelflow::compositor::Mode;
use tilewright_rtl::pixelflow::instruction::{Instruction, Sync};
use tilewright_rtl::pixelflow::machine::{PixelFlow, PixelFlowIn, PixelFlowOut};
use tilewright_rtl::pixelflow::network_sequencer::Job;
use tilewright_rtl::pixelflow::node::Node;
use tilewright_sim::{EngineKind, Simulation};

use super::costs::Ticks;
use super::hardware::{FrameStore, TextureLookUp};
use super::model::Built;
use super::works::Works;

/// The times of events, in ticks from the frame's beginning.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Events {
    /// For each node and bank, the times at which it was given.
    pub given: Vec<[Vec<Ticks>; 2]>,
    /// For each node, the words that passed it forth, and back.
    pub passed: Vec<[Vec<Range<Ticks>>; 2]>,
    /// For each node, the time at which its wait for its first bank ended.
    pub began: Vec<Vec<Ticks>>,
    /// The times at which the frame buffer's memory was written.
    pub stored: Vec<Range<Ticks>>,
}

/// A machine in simulation.
pub(super) struct Whole<'a> {
    works: &'a Works,
    built: Built<'a>,
    sim: Simulation<PixelFlowIn, PixelFlowOut>,
    tick: Ticks,
    jobs: Vec<[VecDeque<Job<u64>>; 2]>,
    /// The texture unit of each shader.
    textures: Vec<TextureLookUp>,
    store: FrameStore,
    pub seen: Events,
    /// Bytes of each chip of the word that passes a node.
    passing: Vec<[u64; 2]>,
}

impl<'a> Whole<'a> {
    /// A machine with its programs, at its beginning.
    pub fn new(built: Built<'a>, works: &'a Works) -> Whole<'a> {
        let programs = programs(&built, works);
        let nodes = programs.len();
        let longest = programs.iter().map(Vec::len).max().unwrap_or(0) as u32;
        let node = Node { array: built.array.clone(), words: longest, setup: built.set_up as u32 };
        let machine = PixelFlow { nodes: nodes as u32, node };
        let sim = begun(&machine, &programs, built.side_by_side);
        let texture = |_| {
            let textures = works.textures.iter().map(AsRef::as_ref);
            TextureLookUp::new(built.array, textures, EngineKind::Compiled).unwrap()
        };
        let shaders = if works.textures.is_empty() { 0 } else { built.shaders };
        Whole {
            works,
            built,
            sim,
            tick: 0,
            jobs: jobs(&built, works),
            textures: (0..shaders).map(texture).collect(),
            store: FrameStore::new(works, EngineKind::Compiled).unwrap(),
            seen: Events {
                given: vec![Default::default(); nodes],
                passed: vec![Default::default(); nodes],
                began: vec![Vec::new(); nodes],
                stored: Vec::new(),
            },
            passing: vec![[0; 2]; nodes],
        }
    }

    /// Runs until the frame is in the frame buffer.
    pub fn run(&mut self) {
        while self.seen.stored.len() < self.works.regions() || self.store.unit.is_busy {
            assert!(self.tick < 2_000_000, "it hangs: {:?}", self.seen);
            self.step();
        }
        // The bank of the frame buffer's node is given again.
        (0..80).for_each(|_| self.step());
    }

    fn step(&mut self) {
        self.show_jobs();
        self.look_at_network();
        if self.tick % 2 == 1 {
            self.clock_of_arrays();
        }
        self.sim.step();
        self.tick += 1;
        if self.tick == 2 {
            // Every node has got the address of its program.
            (0..self.jobs.len()).for_each(|node| self.sim.set(self.sim.i.frames[node].valid, false));
        }
    }

    fn show_jobs(&mut self) {
        let sim = &mut self.sim;
        for (node, jobs) in self.jobs.iter_mut().enumerate() {
            for (direction, jobs) in jobs.iter_mut().enumerate() {
                let port = if direction == 0 { sim.i.forth[node] } else { sim.i.back[node] };
                sim.set(port.valid, !jobs.is_empty());
                let Some(job) = jobs.front() else { continue };
                sim.set_record(port.payload, *job);
                if sim.get_u64(port.ready) == 1 {
                    jobs.pop_front();
                }
            }
        }
    }

    fn look_at_network(&mut self) {
        let pixels = u64::from(self.built.array.pixels());
        let bytes = [self.works.bytes(), self.works.stored()];
        for (node, passing) in self.passing.iter_mut().enumerate() {
            for (direction, count) in passing.iter_mut().enumerate() {
                if self.sim.peek(&format!("u_node[{node}].advances{direction}")).unwrap().to_u64() != Some(1) {
                    continue;
                }
                let passed = &mut self.seen.passed[node][direction];
                if *count == 0 {
                    passed.push(self.tick..0);
                }
                *count = (*count + 1) % (bytes[direction] * pixels);
                passed.last_mut().unwrap().end = self.tick + 1;
            }
        }
    }

    /// The clock that ends with this tick.
    fn clock_of_arrays(&mut self) {
        for node in 0..self.jobs.len() {
            let mut of = |name: &str| self.sim.peek(&format!("u_node[{node}].{name}")).unwrap().to_u64().unwrap();
            let given = of("given");
            let is_taken = of("u_dma.instructions_valid") & of("u_dma.instructions_ready") == 1;
            let awaits = of("u_dma.instructions_sync") == Sync::AwaitBank as u64;
            if is_taken && awaits && of("u_dma.instructions_c") == 0 {
                self.seen.began[node].push(self.tick - 1);
            }
            for bank in (0..2).filter(|bank| given >> bank & 1 == 1) {
                self.seen.given[node][bank].push(self.tick + 1);
            }
        }
        let mut all_done = u64::from(self.store());
        let shaders = 1 + self.works.shares();
        for (node, unit) in (shaders..).zip(&mut self.textures) {
            let starts = starts(&mut self.sim, node);
            let (registers, seen) = (self.sim.i.textures[node], self.sim.o.texture_seen[node]);
            all_done |= u64::from(unit.clock(&mut self.sim, registers, seen, starts).unwrap()) << node;
        }
        self.sim.set(self.sim.i.textures_done, all_done);
    }

    /// Simulates a clock of the frame buffer, which is at node 0. Returns whether it has finished.
    fn store(&mut self) -> bool {
        let starts = starts(&mut self.sim, 0);
        let (registers, seen) = (self.sim.i.textures[0], self.sim.o.texture_seen[0]);
        let is_done = self.store.clock(&mut self.sim, registers, seen, starts).unwrap();
        if is_done {
            self.seen.stored.last_mut().unwrap().end = self.tick + 1;
        }
        if starts {
            self.seen.stored.push(self.tick + 1..0);
        }
        is_done
    }

    /// The displayed picture at the end, line by line.
    pub fn shown(&mut self) -> Vec<[u8; 3]> {
        self.store.scan().unwrap()
    }
}

/// Whether a node's program calls the unit at its texture port.
fn starts(sim: &mut Simulation<PixelFlowIn, PixelFlowOut>, node: usize) -> bool {
    sim.get_u64(sim.o.textures_start) >> node & 1 == 1
}

/// Writes the programs and starts the nodes: that is tick 0.
fn begun(
    machine: &PixelFlow,
    programs: &[Vec<Instruction<u64>>],
    side_by_side: bool,
) -> Simulation<PixelFlowIn, PixelFlowOut> {
    let mut sim = Simulation::of(machine).unwrap();
    sim.reset();
    sim.set(sim.i.side_by_side, side_by_side);
    sim.set(sim.i.textures_done, 0);
    let i = sim.i.clone();
    for node in 0..programs.len() {
        sim.set(i.textures[node].writes, false);
        sim.set(i.frames[node].valid, false);
        [i.forth[node], i.back[node]].into_iter().for_each(|jobs| sim.set(jobs.valid, false));
    }
    for address in 0..machine.node.words as usize {
        for (store, program) in i.stores.iter().zip(programs) {
            sim.set(store.writes, address < program.len());
            sim.set(store.address, address as u64);
            let Some(instruction) = program.get(address) else { continue };
            sim.set_record(store.instruction, *instruction);
        }
        sim.step_clock(ARRAY, 1);
    }
    for (node, program) in programs.iter().enumerate() {
        sim.set(i.stores[node].writes, false);
        sim.set(i.frames[node].valid, !program.is_empty());
        sim.set(i.frames[node].base, 0);
        sim.set(i.frames[node].length, program.len() as u64);
    }
    sim
}

/// The program of each node: that of the frame buffer, rasterizers, shaders.
fn programs(built: &Built, works: &Works) -> Vec<Vec<Instruction<u64>>> {
    let turns = 0..works.turns();
    let stores = turns.clone().filter(|turn| works.comes_to_holder(*turn)).flat_map(|turn| works.storing(turn));
    let mut programs = vec![Works::first_of_holder().into_iter().chain(stores).collect::<Vec<_>>()];
    for share in 0..works.shares() {
        programs.push(turns.clone().flat_map(|turn| works.program(share, turn).to_vec()).collect());
    }
    for number in 0..built.shaders {
        let own = turns.clone().filter(|turn| works.shader_of(*turn, built.shaders) == Some(number));
        let shading = own.flat_map(|turn| works.shading(turn).to_vec());
        programs.push(Works::first_of_shader().into_iter().chain(shading).collect());
    }
    programs
}

/// The jobs of each node for the words of both directions.
fn jobs(built: &Built, works: &Works) -> Vec<[VecDeque<Job<u64>>; 2]> {
    let rasterizers = works.shares();
    let nodes = 1 + rasterizers + built.shaders;
    let mut jobs = vec![[VecDeque::new(), VecDeque::new()]; nodes];
    let job = |mode: Mode, bank: usize, bytes| Job { mode: mode as u64, bank: bank as u64, bytes };
    let not_here = job(Mode::Forward, 0, 0);
    for turn in 0..works.turns() {
        let (own, bytes, held) = (turn % 2, works.bytes(), works.holders_bank(turn));
        let shader = works.shader_of(turn, built.shaders).map(|number| 1 + rasterizers + number);
        for (node, [forth, back]) in jobs.iter_mut().enumerate() {
            let is_rasterizer = (1..=rasterizers).contains(&node);
            let Some(shader) = shader else {
                back.push_back(match node {
                    0 => job(Mode::Unload, held, bytes),
                    _ if node == rasterizers => job(Mode::Load, own, bytes),
                    _ => job(Mode::Composite, own, bytes),
                });
                continue;
            };
            forth.push_back(match node {
                0 => not_here,
                1 => job(Mode::Load, own, bytes),
                _ if is_rasterizer => job(Mode::Composite, own, bytes),
                _ if node == shader => job(Mode::Unload, 0, bytes),
                _ => job(Mode::Forward, 0, bytes),
            });
            if works.comes_to_holder(turn) {
                back.push_back(match node {
                    0 => job(Mode::Unload, held, Works::COLOUR),
                    _ if node < shader => job(Mode::Forward, 0, Works::COLOUR),
                    _ if node == shader => job(Mode::Load, 1, Works::COLOUR),
                    _ => not_here,
                });
            }
        }
    }
    jobs
}

mod tests;
