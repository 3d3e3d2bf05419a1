//! A way for a clock to rest: the counting registers, and their code.

use std::collections::BTreeSet;

use tilewright_circuit::ir::{Relation, Unary};

use super::COUNTING;
use super::counting::{self, Counting};
use crate::engine::cranelift::Code;
use crate::engine::function::Maker;
use crate::engine::layout::Place;
use crate::engine::program::{Kind, Register, ValueId};
use crate::engine::running::Compiled;
use crate::engine::running::prepare::Prepared;

/// A way to rest. Where there is no code, there is nothing to do.
pub(super) struct Way {
    /// The counting registers.
    pub registers: BTreeSet<ValueId>,
    /// Stores the flags; ends with an edge left if a memory may be changed or read then.
    pub leave: Option<Code>,
    /// Ends with an edge left if the flags differ.
    pub same: Option<Code>,
    /// An edge of the counters.
    pub go: Option<Code>,
    /// Several edges of the counters, each after a check that the flags are the same.
    pub steps: Option<Code>,
    /// The clocks that change what registers read to count.
    pub looks_at: Vec<usize>,
}

impl Compiled {
    /// Makes code for the remaining work of a clock's edges if these registers count.
    #[cold]
    pub(super) fn make_way(&mut self, clock: usize, counters: &[ValueId]) -> Option<Way> {
        let program = self.program.clone();
        let Counting { registers: counting, flags, off } = Counting::of(&program, clock, counters, COUNTING)?;
        let counts: Vec<&Register> = program.registers.iter().filter(|it| counting.contains(&it.value)).collect();
        let looks_at = counting::looks_at(&program, &counts);
        let shape = |id: &ValueId| (program.circuit[*id].lanes, program.circuit[*id].width);
        let places: Vec<Place> =
            flags.iter().map(shape).map(|(lanes, width)| self.layout.place(lanes, width)).collect();

        let mut leaves = Maker::new(&program);
        let left = leaves.own(&flags);
        let off: Vec<ValueId> = off.iter().map(|&enable| leaves.is_off(enable)).collect();
        leaves.go_on_if_all(&off);
        leaves.leave(&flags, &left);
        let mut looks = Maker::new(&program);
        let left = looks.own(&flags);
        let same: Vec<ValueId> = flags.iter().zip(left).map(|(&flag, left)| looks.is_same(flag, left)).collect();
        looks.go_on_if_all(&same);
        let mut steps = Maker::new(&program);
        steps.registers(counts);

        let [leave, same] = [leaves, looks].map(|maker| self.prepare_way(maker, &places));
        let go = self.prepare_way(steps, &[]);
        let [leave, same_alone, go_alone] = [&leave, &same, &go].map(|it| self.compile_way(it.as_slice()));
        let steps: Vec<Prepared> = same.into_iter().chain(go).collect();
        let steps = self.compile_way(&steps);
        Some(Way { registers: counting, leave, same: same_alone, go: go_alone, steps, looks_at })
    }

    /// Prepares a function with state at these places; `None` if it has no effect.
    fn prepare_way(&mut self, maker: Maker, places: &[Place]) -> Option<Prepared> {
        let (function, _) = maker.finish();
        if function.sinks.is_empty() {
            return None;
        }
        let mut prepared = self.prepare(&function, places);
        prepared.is_always_asked = true;
        Some(prepared)
    }

    fn compile_way(&mut self, parts: &[Prepared]) -> Option<Code> {
        (!parts.is_empty()).then(|| self.compile(parts))
    }
}

impl Maker<'_> {
    /// Whether a flag of the program is 0, lane by lane.
    fn is_off(&mut self, flag: ValueId) -> ValueId {
        let flag = self.take(flag);
        let lanes = self.lanes(flag);
        self.add(Kind::Unary(Unary::Not, flag), lanes, 1)
    }

    /// Whether a flag of the program equals its stored value, lane by lane.
    fn is_same(&mut self, flag: ValueId, left: ValueId) -> ValueId {
        let flag = self.take(flag);
        let lanes = self.lanes(flag);
        self.add(Kind::Compare(Relation::Eq, false, flag, left), lanes, 1)
    }
}
