//! The names that the user gave to values and words.

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::Kind as Meaning;

use super::mask;
use super::operation::Place as Part;
use crate::engine::explain::operation;
use crate::engine::program::hierarchy::{self, Place, Role, ScopeId, Signal};
use crate::engine::program::{Kind, Port, Program, ValueId};

/// The signals of each value, by scope and number, and the memories.
pub(super) struct Names {
    signals: FxHashMap<ValueId, Vec<(ScopeId, usize)>>,
    memories: FxHashMap<u32, Vec<(ScopeId, usize)>>,
}

/// Some bits as they are shown.
pub(super) struct Shown {
    pub name: String,
    pub value: Bits,
    pub bits: Bits,
    pub meaning: Meaning,
    pub role: Option<Role>,
}

impl Names {
    pub fn new(program: &Program) -> Names {
        let (mut signals, mut memories) = (FxHashMap::default(), FxHashMap::default());
        for (id, scope) in (0..).map(ScopeId).zip(&program.hierarchy.scopes) {
            for (index, signal) in scope.signals.iter().enumerate() {
                signals.entry(signal.value).or_insert_with(Vec::new).push((id, index));
            }
            for (index, (_, memory, _)) in scope.memories.iter().enumerate() {
                memories.entry(*memory).or_insert_with(Vec::new).push((id, index));
            }
        }
        Names { signals, memories }
    }

    /// Whether a lane of a value has a name of its own: not only those of ports that it comes through.
    pub fn is_named(&self, program: &Program, id: ValueId, lane: u32) -> bool {
        input(program, id).is_some() || self.find(program, id, lane).is_some()
    }

    /// The best name of a lane of a value: that of a register before that of a port, and then the shortest path.
    fn find<'a>(&self, program: &'a Program, id: ValueId, lane: u32) -> Option<(Place, &'a Signal)> {
        let kind = &program.circuit[id].kind;
        let named = self.signals.get(&id).into_iter().flatten().map(|&(scope, index)| {
            let signal = &program.hierarchy.scope(scope).signals[index];
            (Place { scope, lane: lane / signal.shape.lanes() }, signal)
        });
        let rank = |(place, signal): &(Place, &Signal)| {
            let mut above = 0;
            let mut scope = program.hierarchy.scope(place.scope);
            while let Some(parent) = scope.parent {
                (above, scope) = (above + 1, program.hierarchy.scope(parent));
            }
            let rank = match signal.role {
                Role::Register | Role::ReadData => Some(0),
                Role::Output if above == 0 => Some(1),
                Role::Net => Some(2),
                Role::Output if !is_move(kind) => Some(3),
                Role::Input if !is_move(kind) => Some(4),
                Role::Input | Role::Output => None,
            };
            rank.map(|rank| (rank, above))
        };
        let named = named.filter(|(place, _)| program.hierarchy.is_own(*place));
        let ranked = named.filter_map(|named| Some((rank(&named)?, named)));
        ranked.min_by_key(|(rank, _)| *rank).map(|(_, named)| named)
    }

    /// Some bits of a lane as they are shown, by a name or as an operation.
    pub fn show(&self, program: &Program, part: Part, lane: u32, value: &Bits, bits: &Bits) -> Shown {
        let shown = |name: String, meaning, role| {
            let (value, bits) = (value.clone(), bits.clone());
            Shown { name, value, bits, meaning, role }
        };
        match part {
            Part::Word(memory, address) => {
                let name = self.memory(program, memory, lane);
                shown(format!("{name}[{address}]"), Meaning::Number, None)
            }
            Part::Value(id) => match (input(program, id), self.find(program, id, lane)) {
                (Some(port), _) => lane_of_input(program, port, value, bits),
                (None, Some((place, signal))) => {
                    let lane = hierarchy::index(signal.shape, lane % signal.shape.lanes());
                    let name = format!("{}{lane}", program.hierarchy.path_in(place, &signal.name));
                    shown(name, signal.kind, Some(signal.role))
                }
                (None, None) => shown(self.operation(program, id, lane), Meaning::Number, None),
            },
        }
    }

    fn memory(&self, program: &Program, memory: u32, lane: u32) -> String {
        let scopes = self.memories.get(&memory).into_iter().flatten();
        let mut named = scopes.map(|&(scope, index)| {
            let (name, _, shape) = &program.hierarchy.scope(scope).memories[index];
            (Place { scope, lane: lane / shape.lanes() }, name, *shape)
        });
        let found = named.find(|(place, ..)| program.hierarchy.is_own(*place));
        found.map_or_else(String::new, |(place, name, shape)| {
            let lane = hierarchy::index(shape, lane % shape.lanes());
            format!("{}{lane}", program.hierarchy.path_in(place, name))
        })
    }

    /// An operation in a line; operands without a name are `_`.
    fn operation(&self, program: &Program, id: ValueId, lane: u32) -> String {
        let cell = &program.circuit[id];
        let name = |operand: ValueId| {
            let lane = if program.circuit[operand].lanes == cell.lanes { lane } else { 0 };
            match (self.find(program, operand, lane), program.circuit.constant(operand), input(program, operand)) {
                (Some((_, signal)), ..) => signal.name.clone(),
                (None, Some(bits), _) => bits.to_string(),
                (None, None, Some(port)) => port.name.clone(),
                (None, None, None) => "_".to_owned(),
            }
        };
        operation(&cell.kind, cell.width, &name, &|memory| self.memory(program, memory, lane))
    }
}

/// The port that is this value, if it is an input.
fn input(program: &Program, id: ValueId) -> Option<&Port> {
    program.inputs.iter().find(|port| port.value == id)
}

/// An input; of one with lanes the lane, if all bits are of one. Other names of it are those of nets.
fn lane_of_input(program: &Program, port: &Port, value: &Bits, bits: &Bits) -> Shown {
    let signal = program.hierarchy.scopes[0].signals.iter().find(|signal| signal.name == port.name);
    let (shape, meaning) = signal.map_or_else(Default::default, |signal| (signal.shape, signal.kind));
    let width = value.width() / port.lanes;
    let lanes = [mask::lowest(bits), mask::highest(bits)].map(|bit| bit.unwrap_or(0) / width);
    let part = match lanes {
        [low, high] if low == high => low * width..(low + 1) * width,
        _ => 0..value.width(),
    };
    let is_lane = part.end - part.start == width;
    let lane = if is_lane { hierarchy::index(shape, lanes[0]) } else { String::new() };
    Shown {
        name: format!("{}{lane}", port.name),
        value: value.slice(part.clone()),
        bits: bits.slice(part),
        meaning: if is_lane { meaning } else { Meaning::Number },
        role: Some(Role::Input),
    }
}

/// Whether an operation only brings lanes from one place to another.
fn is_move(kind: &Kind) -> bool {
    matches!(
        kind,
        Kind::Alias(_)
            | Kind::Const(_)
            | Kind::Broadcast { .. }
            | Kind::Stack { .. }
            | Kind::Map { .. }
            | Kind::Interleave { .. }
            | Kind::Lane { .. }
            | Kind::Pack { .. }
            | Kind::Unpack { .. }
    )
}
