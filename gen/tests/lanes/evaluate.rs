//! The behaviour of a module with lanes, lane by lane and as plainly as possible: values of at most 64 bits, one
//! clock.

use std::collections::BTreeMap;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::*;
use tilewright_hdl::recording::{Recording, Step};

/// A run of the last module on random inputs, with the reset in the first steps.
pub fn recording(modules: &[Module], steps: u64) -> Recording {
    let top = modules.last().expect("a top");
    let mut state = State::new(top);
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    let mut draw = |width: u32| {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        // Small numbers often, or no index is ever in range.
        let value = if random >> 60 < 6 { random & 7 } else { random >> 3 };
        value & mask(width)
    };
    let step = |number: u64| {
        let inputs = top.inputs.iter().map(|input| {
            let node = top.node(input.node);
            (0..node.shape.lanes()).map(|_| draw(node.width)).collect::<Vec<_>>()
        });
        let (inputs, is_reset) = (inputs.collect::<Vec<_>>(), number == 5 || number == 6);
        let pack = |id: NodeId, values: &[u64]| {
            Bits::join(&values.iter().map(|&value| Bits::new(top.width(id), value)).collect::<Vec<_>>())
        };
        let mut now = Now { modules, module: top, state: &state, inputs: &inputs, known: BTreeMap::new() };
        let outputs = top.outputs.iter().map(|output| {
            let values: Vec<u64> =
                (0..top.shape(output.node).lanes()).map(|lane| now.value(output.node, lane)).collect();
            pack(output.node, &values)
        });
        let outputs = outputs.collect();
        let next = now.next(is_reset);
        let packed = top.inputs.iter().zip(&inputs).map(|(input, values)| pack(input.node, values)).collect();
        state = next;
        let resets = if is_reset && top.clocks[0].reset.is_some() { vec![0] } else { vec![] };
        Step { time_ps: 10_000 * (number + 1), rising: vec![0], resets, inputs: packed, outputs }
    };
    Recording { steps: (0..steps).map(step).collect(), initial: vec![] }
}

fn mask(width: u32) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}

/// The state between the edges, by lane.
#[derive(Clone)]
struct State {
    registers: BTreeMap<NodeId, Vec<u64>>,
    /// The words of each memory, by lane and address.
    words: Vec<Vec<Vec<u64>>>,
}

impl State {
    fn new(module: &Module) -> State {
        let number = |bits: &Bits| bits.to_u64().expect("at most 64 bits");
        let mut registers = BTreeMap::new();
        for register in &module.registers {
            let start = |lane| register.reset.as_ref().map_or(0, |reset| number(reset.lane(lane)));
            registers.insert(register.node, (0..module.shape(register.node).lanes()).map(start).collect());
        }
        let mut words = Vec::new();
        for memory in &module.memories {
            for read in memory.reads.iter().filter(|read| read.clock.is_some()) {
                registers.insert(read.node, vec![0; memory.shape.lanes() as usize]);
            }
            let lane = |lane: u32| {
                let given: Vec<u64> = match &memory.contents {
                    Contents::Unknown => vec![],
                    Contents::Fill(word) => vec![number(word); memory.depth as usize],
                    Contents::Words(words) => words.iter().map(number).collect(),
                    Contents::Each(lanes) => lanes[lane as usize].iter().map(number).collect(),
                };
                (0..memory.depth as usize).map(|address| given.get(address).copied().unwrap_or(0)).collect()
            };
            words.push((0..memory.shape.lanes()).map(lane).collect());
        }
        State { registers, words }
    }
}

/// One cycle of a module.
struct Now<'a> {
    modules: &'a [Module],
    module: &'a Module,
    state: &'a State,
    /// By port and lane.
    inputs: &'a [Vec<u64>],
    known: BTreeMap<(NodeId, u32), u64>,
}

impl Now<'_> {
    fn value(&mut self, id: NodeId, lane: u32) -> u64 {
        if let Some(&known) = self.known.get(&(id, lane)) {
            return known;
        }
        let value = self.compute(id, lane) & mask(self.module.width(id));
        self.known.insert((id, lane), value);
        value
    }

    fn compute(&mut self, id: NodeId, lane: u32) -> u64 {
        let module = self.module;
        let node = module.node(id);
        let shape = node.shape;
        let width = |id: NodeId| module.width(id);
        match &node.op {
            Op::Input(port) => self.inputs[*port as usize][lane as usize],
            Op::Const(value) => value.to_u64().expect("at most 64 bits"),
            Op::Register(_) => self.state.registers[&id][lane as usize],
            Op::Wire(a) => self.value(*a, lane),
            Op::Unary(Unary::Not, a) => !self.value(*a, lane),
            Op::Unary(Unary::AnyOne, a) => u64::from(self.value(*a, lane) != 0),
            Op::Binary(op, a, b) => {
                let (a, b) = (self.value(*a, lane), self.value(*b, lane));
                match op {
                    Binary::And => a & b,
                    Binary::Or => a | b,
                    Binary::Xor => a ^ b,
                    Binary::Add => a.wrapping_add(b),
                    Binary::Sub => a.wrapping_sub(b),
                    Binary::Mul => a.wrapping_mul(b),
                    Binary::MulSigned => unreachable!("no test has it"),
                }
            }
            Op::Compare { relation: Relation::Ge, operands: [a, b], .. } => {
                u64::from(self.value(*a, lane) >= self.value(*b, lane))
            }
            Op::Compare { relation: Relation::Lt, signed: false, operands: [a, b] } => {
                u64::from(self.value(*a, lane) < self.value(*b, lane))
            }
            Op::Mux { select, on_true, on_false } => {
                let chosen = if self.value(*select, lane) == 1 { on_true } else { on_false };
                self.value(*chosen, lane)
            }
            Op::Case { subject, arms, default } => {
                let subject = self.value(*subject, lane);
                let arm = arms.iter().find(|(key, _)| key.to_u64() == Some(subject)).map(|(_, value)| *value);
                self.value(arm.unwrap_or(*default), lane)
            }
            Op::Shift(shift, a, places) => {
                let (a, places) = (self.value(*a, lane), u32::try_from(self.value(*places, lane)).unwrap_or(u32::MAX));
                match shift {
                    Shift::Left => a.checked_shl(places).unwrap_or(0),
                    Shift::Right => a.checked_shr(places).unwrap_or(0),
                    Shift::RightSigned => unreachable!("no test has it"),
                }
            }
            Op::Slice { of, low } => self.value(*of, lane) >> low,
            Op::Extend { of, signed } => {
                let (value, narrow) = (self.value(*of, lane), width(*of));
                let sign = *signed && value >> (narrow - 1) & 1 == 1;
                if sign { value | !mask(narrow) } else { value }
            }
            Op::Read(memory, port) => {
                let read = &module.memories[memory.0 as usize].reads[*port as usize];
                if read.clock.is_some() {
                    return self.state.registers[&id][lane as usize];
                }
                let address = self.shared(read.address, lane);
                self.word(memory.0 as usize, lane, address)
            }
            Op::Output(instance, port) => self.output(instance.0 as usize, *port as usize, lane),
            Op::Broadcast { of, axis } => self.value(*of, shape.across(*axis, lane)),
            Op::Stack { parts, axis } => {
                self.value(parts[shape.along(*axis, lane) as usize], shape.across(*axis, lane))
            }
            Op::Map { of, axis, index, edge } => {
                let (along, across, inner) = (shape.along(*axis, lane), shape.across(*axis, lane), module.shape(*of));
                match index.source(along, inner.extent(*axis)) {
                    Some(from) => self.value(*of, inner.lane(*axis, from, across)),
                    None => self.value(edge.expect("an edge"), across),
                }
            }
            Op::Interleave { parts, axis } => {
                let (along, k) = (shape.along(*axis, lane), parts.len() as u32);
                let part = parts[(along % k) as usize];
                self.value(part, module.shape(part).lane(*axis, along / k, shape.across(*axis, lane)))
            }
            Op::Lane { of, axis, index } => self.value(*of, module.shape(*of).lane(*axis, *index, lane)),
            Op::Pick { of, axis, index } => {
                let (inner, index) = (module.shape(*of), self.value(*index, lane));
                match u32::try_from(index).ok().filter(|index| *index < inner.extent(*axis)) {
                    Some(index) => self.value(*of, inner.lane(*axis, index, lane)),
                    None => 0,
                }
            }
            Op::Reduce { by, of, axis } => {
                let inner = module.shape(*of);
                let lanes = (0..inner.extent(*axis)).map(|along| self.value(*of, inner.lane(*axis, along, lane)));
                let lanes: Vec<u64> = lanes.collect();
                lanes.into_iter().reduce(|a, b| combined(*by, a, b)).expect("a lane")
            }
            Op::Pack { of, axis } => {
                let inner = module.shape(*of);
                let lanes = (0..inner.extent(*axis)).rev();
                let lanes: Vec<u64> = lanes.map(|along| self.value(*of, inner.lane(*axis, along, lane))).collect();
                lanes.into_iter().fold(0, |all, value| all << width(*of) | value)
            }
            Op::Unpack { of, axis } => {
                self.value(*of, shape.across(*axis, lane)) >> (shape.along(*axis, lane) * node.width)
            }
            other => unreachable!("no test has {other:?}"),
        }
    }

    /// A plain value, or that of the lane.
    fn shared(&mut self, id: NodeId, lane: u32) -> u64 {
        self.value(id, if self.module.shape(id).is_plain() { 0 } else { lane })
    }

    fn word(&self, memory: usize, lane: u32, address: u64) -> u64 {
        self.state.words[memory][lane as usize].get(address as usize).copied().unwrap_or(0)
    }

    /// An output of an instance without state.
    fn output(&mut self, index: usize, port: usize, lane: u32) -> u64 {
        let instance = &self.module.instances[index];
        let child = &self.modules[instance.module.0 as usize];
        let output = child.outputs[port].node;
        let lanes = child.shape(output).lanes();
        let inputs: Vec<Vec<u64>> = (child.inputs.iter().zip(&instance.inputs))
            .map(|(input, driver)| {
                let count = child.shape(input.node).lanes();
                (0..count).map(|inner| self.value(*driver, lane / lanes * count + inner)).collect()
            })
            .collect();
        let (state, modules) = (State::new(child), self.modules);
        let mut inside = Now { modules, module: child, state: &state, inputs: &inputs, known: BTreeMap::new() };
        inside.value(output, lane % lanes)
    }

    /// The state after the edge.
    fn next(&mut self, is_reset: bool) -> State {
        let (module, mut next) = (self.module, self.state.clone());
        for register in &module.registers {
            for lane in 0..module.shape(register.node).lanes() {
                let enabled = register.enable.is_none_or(|enable| self.value(enable, lane) == 1);
                let value = match &register.reset {
                    Some(reset) if is_reset => reset.lane(lane).to_u64().expect("at most 64 bits"),
                    _ if enabled => self.value(register.next, lane),
                    _ => continue,
                };
                next.registers.get_mut(&register.node).expect("a register")[lane as usize] = value;
            }
        }
        for (index, memory) in module.memories.iter().enumerate() {
            for lane in 0..memory.shape.lanes() {
                for write in &memory.writes {
                    let (address, data) = (self.shared(write.address, lane), self.value(write.data, lane));
                    if self.shared(write.enable, lane) == 1 && address < memory.depth.into() {
                        next.words[index][lane as usize][address as usize] = data;
                    }
                }
                for read in memory.reads.iter().filter(|read| read.clock.is_some()) {
                    if read.enable.is_none_or(|enable| self.shared(enable, lane) == 1) {
                        let address = self.shared(read.address, lane);
                        let word = self.word(index, lane, address);
                        next.registers.get_mut(&read.node).expect("read data")[lane as usize] = word;
                    }
                }
            }
        }
        next
    }
}

fn combined(by: Reduction, a: u64, b: u64) -> u64 {
    match by {
        Reduction::And => a & b,
        Reduction::Or => a | b,
        Reduction::Xor => a ^ b,
        Reduction::Add => a.wrapping_add(b),
        Reduction::Min => a.min(b),
        Reduction::Max => a.max(b),
    }
}
