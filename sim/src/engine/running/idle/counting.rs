//! The values that must stay the same for an edge to change nothing but some registers.
//!
//! Registers that *count* change at nearly every edge, and other logic mostly sees only whether they have reached a
//! number: a value of 1 bit. As long as these *flags* and everything else that the edge reads stay the same, all
//! registers that see no more stay the same too.

use std::collections::BTreeSet;

use rustc_hash::FxHashSet;
use tilewright_circuit::ir::Binary;

use crate::engine::program::{Kind, Program, ReadPort, Register, ValueId};

/// Registers of a clock that may count while nothing else happens at its edges.
pub(super) struct Counting {
    /// By value: the requested registers, and those that see more of them than flags.
    pub registers: BTreeSet<ValueId>,
    /// The flags through which others see them.
    pub flags: Vec<ValueId>,
    /// The values that must be 0 in all lanes, so that no memory is written and no word read that another clock may
    /// write.
    pub off: Vec<ValueId>,
}

impl Counting {
    /// For these registers of a clock, of 2 bits or more. `None` if more than `most` would count, or if a word is
    /// read that must not be skipped.
    pub fn of(program: &Program, clock: usize, asked: &[ValueId], most: usize) -> Option<Counting> {
        let order = program.circuit.needed(program.sampled(clock, true));
        let mut registers: BTreeSet<ValueId> = asked.iter().copied().collect();
        loop {
            let seen = Seen::of(program, &order, &registers);
            let own = program.clocks[clock].registers.iter().map(|&index| &program.registers[index as usize]);
            let sees = own.filter(|it| seen.whole.contains(&it.next) && !registers.contains(&it.value));
            let sees: Vec<ValueId> = sees.map(|it| it.value).collect();
            if sees.is_empty() {
                let off = off(program, clock, &seen)?;
                let flags = flags(program, clock, &registers, &seen);
                return Some(Counting { registers, flags, off });
            }
            registers.extend(sees);
            if registers.len() > most {
                return None;
            }
        }
    }
}

/// The values computed from counting registers.
#[derive(Default)]
struct Seen {
    /// More than a flag.
    whole: FxHashSet<ValueId>,
    /// 1 bit.
    flags: FxHashSet<ValueId>,
}

impl Seen {
    /// Among these values, each after its operands.
    fn of(program: &Program, order: &[ValueId], registers: &BTreeSet<ValueId>) -> Seen {
        let mut seen = Seen::default();
        for &id in order {
            let cell = &program.circuit[id];
            let mut is_made_of = registers.contains(&id);
            cell.kind.for_each_operand(|operand| is_made_of |= seen.whole.contains(&operand));
            if is_made_of {
                if cell.width == 1 {
                    seen.flags.insert(id)
                } else {
                    seen.whole.insert(id)
                };
            }
        }
        seen
    }
}

/// The values that must be 0; `None` if one of them cannot be.
fn off(program: &Program, clock: usize, seen: &Seen) -> Option<Vec<ValueId>> {
    let mut off = Vec::new();
    for &(memory, port) in &program.clocks[clock].writes {
        off.push(program.memories[memory as usize].writes[port as usize].enable);
    }
    for &(memory, port) in &program.clocks[clock].reads {
        let ReadPort { address, enable, .. } = program.memories[memory as usize].reads[port as usize];
        if is_shared(program, memory, clock) || seen.whole.contains(&address) {
            off.push(enable?);
        }
    }
    Some(off)
}

/// The flags that are seen outside of those registers themselves.
fn flags(program: &Program, clock: usize, registers: &BTreeSet<ValueId>, seen: &Seen) -> Vec<ValueId> {
    let mut open = program.sampled_but_by(clock, true, |register| registers.contains(&register.value));
    let (mut flags, mut known) = (BTreeSet::new(), FxHashSet::default());
    while let Some(id) = open.pop() {
        if !known.insert(id) {
            continue;
        }
        match seen.flags.contains(&id) {
            true => _ = flags.insert(id),
            false => program.circuit[id].kind.for_each_operand(|operand| open.push(operand)),
        }
    }
    flags.into_iter().collect()
}

/// The registers of a clock that take a sum or a difference with their own value; none of 1 bit, which would be flags
/// themselves.
pub(super) fn counters(program: &Program, clock: usize) -> BTreeSet<ValueId> {
    let circuit = &program.circuit;
    let counts = |register: &&Register| {
        let (mut open, mut known) = (vec![register.next], FxHashSet::default());
        while let Some(id) = open.pop() {
            let kind = &circuit[id].kind;
            if let Kind::Binary(Binary::Add | Binary::Sub, a, b) = *kind
                && [a, b].contains(&register.value)
            {
                return true;
            }
            if known.insert(id) && circuit[id].width > 1 {
                kind.for_each_operand(|operand| open.push(operand));
            }
        }
        false
    };
    let own = program.clocks[clock].registers.iter().map(|&index| &program.registers[index as usize]);
    own.filter(|it| circuit[it.value].width > 1).filter(counts).map(|register| register.value).collect()
}

/// The clocks that change what these registers read to count.
pub(super) fn looks_at(program: &Program, counts: &[&Register]) -> Vec<usize> {
    let roots = counts.iter().flat_map(|it| [Some(it.next), it.enable].into_iter().flatten());
    let needed: FxHashSet<ValueId> = program.circuit.needed(roots).into_iter().collect();
    let is_looked_at = |clock: &usize| states(program, *clock).any(|id| needed.contains(&id));
    (0..program.clocks.len()).filter(is_looked_at).collect()
}

/// Whether another clock writes to a memory.
fn is_shared(program: &Program, memory: u32, clock: usize) -> bool {
    program.memories[memory as usize].writes.iter().any(|write| write.clock as usize != clock)
}

/// The values changed by others that edges of a clock read, besides inputs; `None` if one may be a word of a memory
/// that is not in a register.
pub(super) fn others(program: &Program, clock: usize) -> Option<Vec<ValueId>> {
    let inputs: FxHashSet<ValueId> = program.inputs.iter().map(|port| port.value).collect();
    let own: FxHashSet<ValueId> = states(program, clock).collect();
    let needed = program.circuit.needed(program.sampled(clock, true));
    let mut others = Vec::new();
    for id in needed {
        match program.circuit[id].kind {
            Kind::State if !own.contains(&id) && !inputs.contains(&id) => others.push(id),
            Kind::Read { memory, .. } if is_shared(program, memory, clock) => return None,
            _ => {}
        }
    }
    others.sort_unstable();
    Some(others)
}

/// The state that edges of a clock change: its registers and read data.
pub(super) fn states(program: &Program, clock: usize) -> impl Iterator<Item = ValueId> {
    let clock = &program.clocks[clock];
    let registers = clock.registers.iter().map(|&index| program.registers[index as usize].value);
    registers
        .chain(clock.reads.iter().map(|&(memory, port)| program.memories[memory as usize].reads[port as usize].value))
}
