//! The table of a loop's versions, and code that looks a version up in it.

use super::{Emitter, offset};
use crate::engine::layout::{Layout, Place};
use crate::engine::strips::{Comparison, Type};

/// Bits of a version's index in the table.
pub(crate) const SLOT: u32 = 10;
/// Spreads keys over the table: odd, with ones and zeros everywhere.
pub(crate) const SPREAD: i64 = 0x9e37_79b9_7f4a_7c15_u64 as i64;
/// Keys that code notes before it overwrites the first.
pub(crate) const NOTED: u32 = 64;
/// The most bytes of stack that a version takes.
pub(crate) const STACK: usize = 16 << 10;

/// The table of a loop's versions, by offset.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TableAt {
    /// Pairs of a key plus 1 and the address of code.
    pub(crate) table: Place,
    /// The number of noted keys, and the last of them.
    pub(crate) noted: Place,
}

impl TableAt {
    /// Allocates an empty table.
    pub fn new(layout: &mut Layout) -> TableAt {
        TableAt { table: layout.place(2 << SLOT, 64), noted: layout.place(1 + NOTED, 64) }
    }
}

impl Emitter<'_, '_> {
    /// Runs the version of a loop for the present subjects, if there is one; otherwise what `other` emits.
    pub(super) fn version_or(&mut self, index: usize, other: impl FnOnce(&mut Self)) {
        let plan = self.plan;
        let TableAt { table, noted } = self.versions[index];
        let mut key = self.builder.constant(Type::I64, 0);
        let mut bits = 0;
        for &subject in &plan.versioned[index].subjects {
            self.want(subject);
            let number = self.scalars.clean(self.builder, subject)[0];
            let number = self.builder.shl_constant(number, i64::from(bits));
            key = self.builder.or(key, number);
            bits += self.function.cell(subject).width;
        }
        let spread = self.builder.constant(Type::I64, SPREAD);
        let spread = self.builder.mul(key, spread);
        let slot = self.builder.shr_constant(spread, i64::from(64 - SLOT));
        let by = self.builder.shl_constant(slot, 4);
        let entry = self.builder.add(self.state, by);
        let there = self.builder.load(Type::I64, entry, offset(table.offset));
        let sought = self.builder.add_constant(key, 1);
        let is_there = self.builder.compare(Comparison::Equal, there, sought);

        self.builder.open();
        let code = self.builder.load(Type::I64, entry, offset(table.lane(1)));
        let (state, scratch) = (self.state, self.builder.scratch());
        self.builder.call_code(code, &[state, key, scratch], STACK);
        let found = self.builder.close();

        self.builder.open();
        let count = self.builder.load(Type::I64, state, offset(noted.offset));
        let next = self.builder.add_constant(count, 1);
        self.builder.store(next, state, offset(noted.offset));
        let at = self.builder.and_constant(count, i64::from(NOTED - 1));
        let at = self.builder.shl_constant(at, 3);
        let at = self.builder.add(state, at);
        self.builder.store(key, at, offset(noted.lane(1)));
        let before = self.scalars.clone();
        other(self);
        self.scalars = before;
        let missed = self.builder.close();
        self.builder.branch(is_there, found, missed);
    }
}
