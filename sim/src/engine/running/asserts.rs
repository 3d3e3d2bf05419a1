//! The assertions of an edge.
//!
//! An edge checks assertions before it changes anything. Assertions often look at all lanes: at adjacent inputs, at
//! whether all queues are empty, at which lane is first. Some of this takes a loop of its own, or a load and a store
//! for each lane. Such results stay in memory for the edge, which needs them again. The edge computes the rest anew,
//! lane by lane.

use rustc_hash::FxHashSet;

use super::Compiled;
use super::prepare::Prepared;
use crate::engine::function::{Held, Maker};
use crate::engine::program::{Circuit, Kind, ValueId};

/// From this number of lanes on, values that are placed side by side are kept.
const SIDE_BY_SIDE: u32 = 4;

impl Compiled {
    /// Whether all assertions pass at an edge of these clocks.
    pub(super) fn holds(&mut self, rising: &[usize]) -> bool {
        let made = self.checks.iter().find(|(clocks, resets, _)| clocks == rising && *resets == self.resets);
        let code = match made {
            Some((_, _, code)) => *code,
            None => {
                let check = Maker::new(&self.program).check(rising, &self.resets);
                let check = check.map(|function| self.prepare(&function, &[]));
                let code = check.map(|check| self.compile(std::slice::from_ref(&check)));
                self.checks.push((rising.to_vec(), self.resets.clone(), code));
                code
            }
        };
        let Some(code) = code else { return true };
        self.check_asserts(true);
        self.call(code, 1) == 0
    }

    /// Prepares the functions for an edge of these clocks: the assertions, for clocks that are not in reset, and the
    /// changes.
    pub(super) fn prepare_edges(&mut self, rising: &[usize], resets: &[bool], held: &Held) -> Vec<Prepared> {
        let program = self.program.clone();
        let shared = if self.apart.is_none() { self.left_by_check(rising, resets, held) } else { Vec::new() };
        let mut maker = Maker::new(&program).hold(held);
        maker.show(&shared);
        let check = maker.check(rising, resets).map(|check| self.prepare_edge(&check, &[]));
        let places: Vec<_> = check.iter().flat_map(Prepared::shown).collect();
        let edge = Maker::new(&program).give(&shared).hold(held).edge(rising).0;
        let edge = self.prepare_edge(&edge, &places);
        check.into_iter().chain([edge]).collect()
    }

    /// The values that assertions compute and an edge needs too, if they take a loop or many parts.
    fn left_by_check(&self, rising: &[usize], resets: &[bool], held: &Held) -> Vec<ValueId> {
        let program = &self.program;
        let asserts = rising.iter().filter(|&&clock| !resets[clock]).flat_map(|&clock| &program.clocks[clock].asserts);
        let conditions = asserts.map(|&assert| program.asserts[assert as usize].condition);
        let sampled = rising.iter().flat_map(|&clock| program.sampled(clock, false)).collect();
        let mut maker = Maker::new(program).hold(held);
        let mut shared = borders(&program.circuit, conditions, sampled);
        shared.retain(|id| {
            let value = maker.take(*id);
            !matches!(maker.kind(value), Kind::Const(_) | Kind::State)
        });
        shared
    }
}

/// Among the values computed for `of`, those that `others` need and that are reduced from many lanes or assembled
/// from many values.
fn borders(circuit: &Circuit, of: impl Iterator<Item = ValueId>, others: Vec<ValueId>) -> Vec<ValueId> {
    let computed: FxHashSet<ValueId> = circuit.needed(of).into_iter().collect();
    let (mut seen, mut borders, mut open) = (FxHashSet::default(), Vec::new(), others);
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        if computed.contains(&id) && is_border(circuit, id) {
            borders.push(id);
        } else {
            circuit[id].kind.for_each_operand(|operand| open.push(operand));
        }
    }
    borders.sort_unstable();
    borders
}

/// Whether a value of one lane is made from many lanes, or a value of many lanes from single ones.
fn is_border(circuit: &Circuit, id: ValueId) -> bool {
    let cell = &circuit[id];
    match &cell.kind {
        Kind::Reduce { of, .. } | Kind::Lane { of, .. } | Kind::Pick { of, .. } | Kind::Pack { of, .. } => {
            cell.lanes == 1 && circuit[*of].lanes > 1 && circuit[*of].kind != Kind::State
        }
        Kind::Stack { parts, .. } => cell.lanes >= SIDE_BY_SIDE && circuit[parts[0]].lanes == 1,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use tilewright_hdl::{Block, Module, Width, bit, bits, block, bundle, def, elaborate, stack};

    use super::*;
    use crate::engine::Passes;
    use crate::engine::program::{Program, compile};

    bundle! {
        struct RowIn<T> { workers: Vec<WorkerIn<T>> }
        struct RowOut<T> { count: T }
    }

    block! {
        /// Adds up its input, with two assertions about it.
        struct Worker;
        in WorkerIn { line: bits(8) }
        out WorkerOut { sum: _ }
    }

    impl Worker {
        fn build(&self, m: Module, i: WorkerIn) -> WorkerOut {
            def!(sum = m.reg(8).reset(0));
            sum.next(sum + i.line);
            m.assert(sum.ne(0xff), "a sum that does not come");
            m.assert(i.line.ne(9), "nine is not given");
            WorkerOut { sum: *sum }
        }
    }

    /// Several workers, and the number of times at which all are even.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Row;

    impl Block for Row {
        type In = RowIn;
        type Out = RowOut;

        fn inputs(&self) -> RowIn<Width> {
            RowIn { workers: vec![Worker.inputs(); 8] }
        }

        fn build(&self, m: Module, i: RowIn) -> RowOut {
            let lines = stack(i.workers);
            let workers = m.array("u_worker", 8, &Worker, |_| lines);
            def!(even = (!workers.sum.bit(0)).and_all());
            def!(count = m.reg(8).reset(0));
            count.when(even, count + 1);
            m.assert(even | count.ne(0), "the first sums are even");
            def!(_told = m.reg(bit()).reset(0));
            _told.next(even);
            RowOut { count: *count }
        }
    }

    fn program() -> Program {
        compile(&elaborate(&Row).unwrap(), &Passes::default())
    }

    #[test]
    fn what_takes_a_loop_or_many_parts_is_left_for_the_edge() {
        let program = program();
        let conditions = program.asserts.iter().map(|assert| assert.condition);
        let left = borders(&program.circuit, conditions, program.sampled(0, false));
        let kinds: Vec<_> = left.iter().map(|&id| &program.circuit[id].kind).collect();
        assert!(matches!(kinds[..], [Kind::Reduce { .. }, Kind::Stack { .. }]), "{kinds:?}");
    }

    #[test]
    fn what_must_hold_in_as_many_lanes_is_one_condition() {
        let program = program();
        let check = Maker::new(&program).check(&[0], &[false]).unwrap();
        let needed = check.needed();
        let reduced = needed.iter().filter(|&&id| matches!(check.cell(id).kind, Kind::Reduce { .. }));
        assert_eq!((program.asserts.len(), reduced.count()), (3, 2), "that of all lanes, and whether all are even");
    }
}
