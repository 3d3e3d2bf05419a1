//! The compiled engine: machine code made for one program.
//!
//! State stands in one block of memory, memories in blocks of their own. For each set of clocks that rises together,
//! and the resets that are high then, there is a function that goes through such an edge any number of times; for what
//! a testbench looks at there are functions that compute it. All are made when they are first needed.

mod branch;
mod function;
mod graph;
mod jit;
mod kernel;
mod lanes;
mod layout;
mod lower;
mod memory;
mod plan;
mod scalar;
mod sequence;
mod simplify;
mod store;
mod strip;

use std::sync::Arc;

use cranelift_codegen::ir::{InstBuilder, Value, types};
use cranelift_frontend::FunctionBuilder;
use tilewright_hdl::{Bits, limbs_for};

use crate::engine::{Done, Engine, Failed};
use crate::lockstep::Difference;
use crate::program::{Kind, Program, Triggers, ValueId};
use crate::reference;
use function::{Addresses, Emitter, MemoryAt};
use graph::{Graph, Sink};
pub use jit::Unsupported;
use jit::{Code, Jit};
use layout::{Layout, Place, Strips, Words};
use plan::Plan;
use sequence::Step;
use store::Store;

/// The state of a running circuit and the code that runs it.
pub(crate) struct Compiled {
    program: Arc<Program>,
    jit: Jit,
    /// State and what functions store.
    state: Store,
    layout: Layout,
    /// Per value of the program: where it is, if it is state.
    places: Vec<Option<Place>>,
    memories: Vec<(MemoryAt, Store)>,
    /// Per clock: its reset is high.
    resets: Vec<bool>,
    edges: Vec<Edge>,
    /// The inputs that a function may be made for, and how many functions still may.
    inputs: Vec<ValueId>,
    special: u32,
    /// Counts changes of inputs.
    inputs_version: u64,
    /// What looks whether assertions hold, if there are any.
    checks: Vec<(Vec<usize>, Vec<bool>, Option<Code>)>,
    views: Vec<View>,
    /// Per value of the program: what computes it, by index in `views`, and where it leaves it.
    shown: Vec<Option<(usize, Place)>>,
    /// Counts what can change values.
    version: u64,
    /// Every value as limbs, brought up to date when it is read.
    mirror: Vec<u64>,
}

/// The widest input that a function is made for.
const HELD: u32 = 8;
/// How often at most.
const SPECIAL: u32 = 16;

/// A function for an edge.
struct Edge {
    /// The clocks that rise.
    rising: Vec<usize>,
    /// The resets that are high.
    resets: Vec<bool>,
    code: Code,
    /// Since when inputs are as they are, and for how many edges.
    inputs_version: u64,
    quiet: u64,
    /// A function for these inputs.
    special: Option<Code>,
}

/// A function that leaves values where they can be read.
#[derive(Clone, Copy)]
struct View {
    code: Code,
    /// The version that it was last run for.
    seen: u64,
}

/// A graph, and where its values are.
struct Prepared {
    graph: Graph,
    plan: Plan,
    /// The steps of each function that it takes.
    pieces: Vec<Vec<Step>>,
    addresses: Addresses,
}

impl Prepared {
    fn emitter<'a, 'b, 'c>(
        &'a self,
        memories: &'a [MemoryAt],
        strips: &'a Strips,
        builder: &'c mut FunctionBuilder<'b>,
        state: Value,
    ) -> Emitter<'a, 'b, 'c> {
        Emitter::new(&self.graph, &self.plan, &self.addresses, memories, strips, builder, state)
    }
}

impl Compiled {
    /// The circuit as the reference engine has it at the start.
    ///
    /// # Errors
    ///
    /// The machine is not one that code can be generated for.
    pub fn new(program: Arc<Program>, seed: u64) -> Result<Compiled, Unsupported> {
        let jit = Jit::new()?;
        let mut start = reference::Engine::new(program.clone(), seed);
        let mut layout = Layout::new(Strips::of(&program));
        let mut places = vec![None; program.values.len()];
        for (id, value) in program.values.iter().enumerate().filter(|(_, value)| value.offset < program.state_end) {
            places[id] = Some(layout.place(value.lanes, value.width));
        }
        let mut state = Store::new(layout.size);
        let mut mirror = vec![0; program.storage];
        for (id, place) in places.iter().enumerate() {
            if let Some(place) = place {
                state.put(*place, start.read(ValueId(id as u32)));
            }
        }
        for (id, _) in &program.constants {
            mirror[program.value(*id).range()].copy_from_slice(start.read(*id));
        }
        let memories = program.memories.iter().enumerate();
        let memories =
            memories.map(|(index, memory)| memory_at(&program, index, memory, &layout.strips, &start)).collect();
        let resets = vec![false; program.clocks.len()];
        let (edges, checks, views) = (Vec::new(), Vec::new(), Vec::new());
        let inputs = program.inputs.iter().map(|port| port.value);
        let inputs = inputs.filter(|&id| program.value(id).lanes == 1 && program.value(id).width <= HELD).collect();
        let shown = vec![None; program.values.len()];
        Ok(Compiled {
            program,
            jit,
            state,
            layout,
            places,
            memories,
            resets,
            edges,
            checks,
            views,
            shown,
            version: 1,
            inputs,
            special: SPECIAL,
            inputs_version: 0,
            mirror,
        })
    }

    /// Gives places to what a graph computes.
    fn prepare(&mut self, mut graph: Graph) -> Prepared {
        lower::lower(&mut graph, &self.layout.strips, &self.program.passes);
        let mut plan = Plan::new(&graph, self.program.passes.postpone);
        if self.program.passes.branch {
            branch::branch(&mut graph, &mut plan, &self.layout.strips);
        }
        let pieces = sequence::sequence(&mut graph, &mut plan, self.program.passes.longest);
        let addresses = Addresses::new(&graph, &plan, &self.places, &mut self.layout);
        self.state.grow(self.layout.size);
        for &table in &addresses.tables {
            self.fill(&graph, table, addresses.places[table.index()].expect("a table has a place"));
        }
        Prepared { graph, plan, pieces, addresses }
    }

    /// Makes a function that does what these graphs say, one after the other, so many times; it ends where something
    /// does not hold, and says how many times are left.
    fn compile(&mut self, parts: &[Prepared]) -> Code {
        let memories: Vec<MemoryAt> = self.memories.iter().map(|(at, _)| *at).collect();
        let strips = &self.layout.strips;
        let jit = &mut self.jit;
        let pieces = parts.iter().map(|part| match part.pieces.as_slice() {
            [_] => Vec::new(),
            pieces => {
                let last = pieces.len() - 1;
                let piece = |(index, steps): (usize, &Vec<Step>)| {
                    jit.function(|builder, state, _| {
                        let mut emitter = part.emitter(&memories, strips, builder, state);
                        emitter.steps(steps);
                        let held = if index == last { emitter.end() } else { None };
                        let held = match held {
                            Some(held) => builder.ins().uextend(types::I64, held),
                            None => builder.ins().iconst(types::I64, 1),
                        };
                        builder.ins().return_(&[held]);
                    })
                };
                pieces.iter().enumerate().map(piece).collect()
            }
        });
        let pieces: Vec<Vec<Code>> = pieces.collect();
        self.jit.function(|builder, state, count| {
            let body = builder.create_block();
            let done = builder.create_block();
            builder.append_block_param(body, types::I64);
            builder.append_block_param(done, types::I64);
            builder.ins().jump(body, &[count.into()]);
            builder.switch_to_block(body);
            let left = builder.block_params(body)[0];
            for (part, pieces) in parts.iter().zip(&pieces) {
                let held = match pieces.as_slice() {
                    [] => {
                        let mut emitter = part.emitter(&memories, strips, builder, state);
                        emitter.steps(&part.pieces[0]);
                        emitter.end()
                    }
                    pieces => {
                        let results = pieces.iter().map(|code| code.emit_call(builder, state, left));
                        let last = results.last().expect("there are pieces");
                        part.graph.sinks.iter().any(|sink| matches!(sink, Sink::Hold(_))).then_some(last)
                    }
                };
                if let Some(held) = held {
                    let next = builder.create_block();
                    builder.ins().brif(held, next, &[], done, &[left.into()]);
                    builder.switch_to_block(next);
                }
            }
            let left = builder.ins().iadd_imm_s(left, -1);
            builder.ins().brif(left, body, &[left.into()], done, &[left.into()]);
            builder.switch_to_block(done);
            let left = builder.block_params(done)[0];
            builder.ins().return_(&[left]);
        })
    }

    /// Writes an array of constants into the memory.
    fn fill(&mut self, graph: &Graph, table: ValueId, place: Place) {
        let Kind::PerLane(parts) = &graph.cell(table).kind else { unreachable!("a table is made of parts") };
        let limbs: Vec<u64> = (0..place.lanes as usize)
            .flat_map(|lane| match &graph.cell(parts[lane % parts.len()]).kind {
                Kind::Const(bits) => bits.limbs().to_vec(),
                _ => unreachable!("a table is made of constants"),
            })
            .collect();
        self.state.put(place, &limbs);
    }

    /// The function for so many edges of these clocks; with inputs folded in if they have long been as they are.
    fn edge_code(&mut self, rising: &[usize], count: u64) -> Code {
        let made = self.edges.iter().position(|edge| edge.rising == rising && edge.resets == self.resets);
        let index = made.unwrap_or_else(|| {
            let code = self.make_edge(rising, &[]);
            let (rising, resets) = (rising.to_vec(), self.resets.clone());
            self.edges.push(Edge { rising, resets, code, inputs_version: 0, quiet: 0, special: None });
            self.edges.len() - 1
        });
        let edge = &mut self.edges[index];
        if edge.inputs_version != self.inputs_version {
            edge.inputs_version = self.inputs_version;
            edge.quiet = 0;
            edge.special = None;
        }
        if let Some(code) = edge.special {
            return code;
        }
        edge.quiet += count;
        let code = edge.code;
        if edge.quiet < self.program.passes.held_after || self.special == 0 || self.inputs.is_empty() {
            return code;
        }
        self.special -= 1;
        let held = self.inputs.iter().map(|&id| {
            let mut limbs = [0];
            self.state.get(self.places[id.index()].expect("an input is state"), &mut limbs);
            (id, Bits::from_limbs(self.program.value(id).width, &limbs))
        });
        let held: Vec<(ValueId, Bits)> = held.collect();
        let code = self.make_edge(rising, &held);
        self.edges[index].special = Some(code);
        code
    }

    /// Makes the function for an edge, with inputs that are known.
    fn make_edge(&mut self, rising: &[usize], held: &[(ValueId, Bits)]) -> Code {
        let check = Graph::check(&self.program, rising, &self.resets);
        let edge = Graph::edge(&self.program, rising, &self.resets);
        let graphs = check.into_iter().chain([edge]).map(|mut graph| {
            for (id, bits) in held {
                graph.cells[id.index()].kind = Kind::Const(bits.clone());
            }
            if !held.is_empty() {
                simplify::simplify(&mut graph);
            }
            graph
        });
        let graphs: Vec<Graph> = graphs.collect();
        let parts: Vec<Prepared> = graphs.into_iter().map(|graph| self.prepare(graph)).collect();
        self.compile(&parts)
    }

    /// Whether all assertions hold at an edge of these clocks.
    fn holds(&mut self, rising: &[usize]) -> bool {
        let made = self.checks.iter().find(|(clocks, resets, _)| clocks == rising && *resets == self.resets);
        let code = match made {
            Some((_, _, code)) => *code,
            None => {
                let check = Graph::check(&self.program, rising, &self.resets);
                let check = check.map(|graph| self.prepare(graph));
                let code = check.map(|check| self.compile(std::slice::from_ref(&check)));
                self.checks.push((rising.to_vec(), self.resets.clone(), code));
                code
            }
        };
        code.is_none_or(|code| self.call(code, 1) == 0)
    }

    /// Brings a value that is computed up to date; gives where it is. All output ports share a function.
    fn view(&mut self, id: ValueId) -> Place {
        let (view, place) = match self.shown[id.index()] {
            Some(shown) => shown,
            None => {
                let outputs: Vec<ValueId> = self.program.outputs.iter().map(|port| port.value).collect();
                self.watch(if outputs.contains(&id) { &outputs } else { std::slice::from_ref(&id) });
                self.shown[id.index()].expect("it is shown now")
            }
        };
        let View { code, seen } = self.views[view];
        if seen != self.version {
            self.views[view].seen = self.version;
            self.call(code, 1);
        }
        place
    }

    /// Runs a function so many times; gives how many are left because something did not hold.
    fn call(&mut self, code: Code, count: u64) -> u64 {
        let state = self.state.address();
        // SAFETY: the code was made by this engine's `jit` for the layout of `state` and for these memories, which
        // are borrowed exclusively here and have not moved.
        #[allow(unsafe_code, reason = "calls generated code")]
        unsafe {
            code.call(state, count)
        }
    }
}

/// A memory with its words as they are at the start.
fn memory_at(
    program: &Program,
    index: usize,
    memory: &crate::program::Memory,
    strips: &Strips,
    start: &reference::Engine,
) -> (MemoryAt, Store) {
    let addresses: Vec<ValueId> = addresses(program, index, memory);
    let width = addresses.iter().map(|&id| program.value(id).width).max().unwrap_or(1);
    let together = memory.lanes > 1 && memory.width <= 64 && addresses.iter().all(|&id| is_common(program, id));
    let words = Words::of(memory, width, together, strips);
    let mut store = Store::new(words.size);
    let limbs = limbs_for(memory.width);
    for lane in 0..memory.lanes {
        for address in 0..memory.depth {
            let word = start.word(index as u32, lane, address);
            if word[..limbs].iter().any(|&limb| limb != 0) {
                store.put_word(words.at(lane, address), words.word, memory.width, &word);
            }
        }
    }
    let is_full = memory.depth as usize >= 1 << width;
    let at = MemoryAt { address: store.address() as usize, words, depth: memory.depth, width: memory.width, is_full };
    (at, store)
}

/// The addresses at which a memory is read and written.
fn addresses(program: &Program, index: usize, memory: &crate::program::Memory) -> Vec<ValueId> {
    let synchronous = memory.reads.iter().map(|read| read.address);
    let written = memory.writes.iter().map(|write| write.address);
    let asynchronous = program.operations.iter().filter_map(|operation| match operation.kind {
        Kind::Read { memory, address } if memory as usize == index => Some(address),
        _ => None,
    });
    synchronous.chain(written).chain(asynchronous).collect()
}

/// Whether a value is the same in all lanes, and can be taken from one.
fn is_common(program: &Program, id: ValueId) -> bool {
    program.operations.iter().any(|operation| {
        let is_broadcast = matches!(operation.kind, Kind::Broadcast(of, _) if program.value(of).lanes == 1);
        operation.result == id && is_broadcast
    })
}

impl Engine for Compiled {
    fn read(&mut self, id: ValueId) -> &[u64] {
        let range = self.program.value(id).range();
        let place = match self.places[id.index()] {
            None if self.program.value(id).segment.is_some() => Some(self.view(id)),
            place => place,
        };
        if let Some(place) = place {
            self.state.get(place, &mut self.mirror[range.clone()]);
        }
        &self.mirror[range]
    }

    fn write(&mut self, id: ValueId, limbs: &[u64], _: Triggers) {
        let place = self.places[id.index()].expect("an input is state");
        self.state.put(place, limbs);
        self.version += 1;
        self.inputs_version += u64::from(self.program.value(id).width <= HELD);
    }

    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        let (at, store) = &self.memories[memory as usize];
        let mut limbs = vec![0; limbs_for(at.width)];
        store.get_word(at.words.at(lane, address), at.words.word, at.width, &mut limbs);
        limbs
    }

    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        let (at, store) = &mut self.memories[memory as usize];
        store.put_word(at.words.at(lane, address), at.words.word, at.width, limbs);
        self.version += 1;
    }

    fn set_reset(&mut self, clock: usize, high: bool) {
        self.resets[clock] = high;
    }

    fn check(&mut self, rising: &[usize]) -> Vec<Failed> {
        if self.holds(rising) {
            return Vec::new();
        }
        let program = self.program.clone();
        let mut failed = Vec::new();
        for &clock in rising {
            if self.resets[clock] {
                continue;
            }
            for &assert in &program.clocks[clock].asserts {
                let condition = self.read(program.asserts[assert as usize].condition);
                let lanes = (0u32..).zip(condition).filter(|(_, holds)| **holds == 0);
                failed.extend(lanes.map(|(lane, _)| Failed { assert, lane }));
            }
        }
        failed
    }

    fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>> {
        let mut left = 0;
        if count > 0 {
            let code = self.edge_code(rising, count);
            left = self.call(code, count);
            self.version += 1;
        }
        let changed = rising.iter().fold(Triggers::NONE, |all, &clock| all.with(Triggers::state(clock)));
        Ok(Done { edges: count - left, changed })
    }

    fn watch(&mut self, values: &[ValueId]) {
        let computed = |id: &&ValueId| self.program.value(**id).segment.is_some();
        let mut shown: Vec<ValueId> = values.iter().filter(computed).copied().collect();
        shown.sort();
        shown.dedup();
        if shown.is_empty() {
            return;
        }
        let mut graph = Graph::new(&self.program);
        graph.sinks = shown.iter().map(|&value| Sink::Show(value)).collect();
        let prepared = self.prepare(graph);
        let code = self.compile(std::slice::from_ref(&prepared));
        for id in shown {
            let place = prepared.addresses.places[id.index()].expect("what is shown has a place");
            self.shown[id.index()] = Some((self.views.len(), place));
        }
        self.views.push(View { code, seen: 0 });
    }
}
