//! The values of one time, each computed when it is asked for, from the state of the engine.
//!
//! Only what decides is computed: of a choice its condition, then the chosen side.

use std::cell::RefCell;

use rustc_hash::FxHashMap;
use tilewright_circuit::{Bits, limbs_for};

use crate::engine::program::{Kind, Program, ValueId};
use crate::engine::semantics::{self, Number};
use crate::testbench::running::Running;

/// The values of one time.
pub(super) struct Values {
    known: FxHashMap<(ValueId, u32), Box<[u64]>>,
    /// What stands for an operand that is not known yet.
    zeros: Vec<u64>,
}

impl Values {
    pub fn new(program: &Program) -> Values {
        let widest = program.circuit.cells().map(|(_, cell)| cell.width).max().unwrap_or(1);
        Values { known: FxHashMap::default(), zeros: vec![0; limbs_for(widest)] }
    }

    /// Forgets all values: it is another time.
    pub fn clear(&mut self) {
        self.known.clear();
    }

    /// A lane of a value.
    pub fn get(&mut self, running: &mut Running, id: ValueId, lane: u32) -> Bits {
        let width = running.program.circuit[id].width;
        Bits::from_limbs(width, self.limbs(running, id, lane))
    }

    /// Whether a lane of a flag is 1.
    pub fn is_one(&mut self, running: &mut Running, id: ValueId, lane: u32) -> bool {
        self.limbs(running, id, lane)[0] & 1 == 1
    }

    fn limbs(&mut self, running: &mut Running, id: ValueId, lane: u32) -> &[u64] {
        let mut open = vec![(id, lane)];
        while let Some(&(id, lane)) = open.last() {
            match self.known.contains_key(&(id, lane)) {
                true => drop(open.pop()),
                false => self.compute(running, id, lane, &mut open),
            }
        }
        &self.known[&(id, lane)]
    }

    /// Computes a lane of a value, or adds the operands to `open` that have to be known before.
    fn compute(&mut self, running: &mut Running, id: ValueId, lane: u32, open: &mut Vec<(ValueId, u32)>) {
        let program = running.program.clone();
        let cell = &program.circuit[id];
        let count = limbs_for(cell.width);
        if cell.kind == Kind::State {
            let limbs = running.lane(id, lane).limbs().into();
            self.known.insert((id, lane), limbs);
            return;
        }
        let (mut out, missing) = (vec![0; count], RefCell::new(Vec::new()));
        let operand = |id: ValueId, lane: u32| {
            let width = program.circuit[id].width;
            let limbs = self.known.get(&(id, lane)).map(|limbs| &limbs[..]);
            if limbs.is_none() {
                missing.borrow_mut().push((id, lane));
            }
            Number { limbs: limbs.unwrap_or(&self.zeros[..limbs_for(width)]), width }
        };
        let word = |memory: u32, lane: u32, address: Number, out: &mut [u64]| match within(
            address.limbs,
            program.memories[memory as usize].depth,
        ) {
            Some(address) => out.copy_from_slice(&running.engine.word(memory, lane, address)),
            None => out.fill(0),
        };
        semantics::lane_with_words(cell, lane, &mut out, operand, word);
        let missing = missing.into_inner();
        match (missing.first(), &cell.kind) {
            (None, _) => drop(self.known.insert((id, lane), out.into())),
            (Some(first), Kind::Mux { .. } | Kind::Select { .. } | Kind::Case { .. } | Kind::Pick { .. }) => {
                open.push(*first);
            }
            _ => open.extend(missing),
        }
    }
}

/// An address, if it is within the depth.
pub(super) fn within(address: &[u64], depth: u32) -> Option<u32> {
    let (low, high) = address.split_first().expect("a value has a limb");
    (high.iter().all(|&limb| limb == 0) && *low < u64::from(depth)).then_some(*low as u32)
}
