//! Edges until a condition is true, which the repeating function itself checks.

use super::Compiled;
use super::prepare::Prepared;
use crate::engine::cranelift::Code;
use crate::engine::function::{Held, Maker};
use crate::engine::layout::Place;
use crate::engine::program::{Kind, ValueId};
use crate::engine::until::{Order, Until};

/// A function for edges that ends before an edge if a condition is true.
#[derive(Clone, Copy)]
pub(super) struct Stopping {
    /// The edge, by index, and the inputs that it was made for, if any.
    edge: usize,
    held: Option<u64>,
    value: ValueId,
    order: Order,
    /// The place of the number that the value is compared with.
    number: Place,
    code: Code,
}

impl Compiled {
    /// Executes at most `count` edges of these clocks, none of which the condition or a failing assertion precedes;
    /// returns the number.
    pub(super) fn until_edges(&mut self, rising: &[usize], count: u64, until: &Until) -> u64 {
        self.unready();
        self.wake_clocks();
        let edge = self.edge(rising);
        let edges = count - self.call_until(edge, count, until);
        self.edges[edge].pass(edges);
        self.change(self.edges[edge].changes);
        edges
    }

    /// Returns the number of edges left.
    fn call_until(&mut self, edge: usize, count: u64, until: &Until) -> u64 {
        // Inputs that have not changed for long are part of the code.
        let held = self.is_special(edge).then_some(self.inputs_version);
        let matches = |it: &Stopping| (it.edge, it.held, it.value, it.order) == (edge, held, until.value, until.order);
        let index = match self.stopping.iter().position(matches) {
            Some(index) => index,
            None => {
                // Those for earlier inputs will not be called again.
                self.stopping.retain(|it| it.held.is_none_or(|version| version == self.inputs_version));
                let held = if held.is_some() { self.held_inputs() } else { Held::default() };
                let stopping = self.make_stopping(edge, &held, until);
                self.stopping.push(stopping);
                self.stopping.len() - 1
            }
        };
        let Stopping { number, code, .. } = self.stopping[index];
        self.state.put(number, until.number.limbs());
        self.call_with_versions(code, count)
    }

    fn make_stopping(&mut self, edge: usize, held: &Held, until: &Until) -> Stopping {
        let (rising, resets) = self.edges[edge].clocks();
        let width = until.number.width();
        let number = self.layout.place(1, width);
        let program = self.program.clone();
        let mut maker = Maker::new(&program);
        let against = maker.state(width);
        let mut maker = maker.hold(held);
        let value = maker.take(until.value);
        let goes_on = maker.add(Kind::Compare(until.order.otherwise(), false, value, against), 1, 1);
        maker.go_on_if(goes_on);
        let left = self.left_to(&[until.value], &rising, &resets);
        maker.show(&left);
        let mut condition = self.prepare(&maker.finish().0, &[number]);
        condition.is_always_asked = true;
        let places: Vec<Place> = condition.shown().collect();
        let rest = self.prepare_rest((&rising, &resets), held, &left, &places);
        let parts: Vec<Prepared> = [condition].into_iter().chain(rest).collect();
        let held = (!held.is_empty()).then_some(self.inputs_version);
        Stopping { edge, held, value: until.value, order: until.order, number, code: self.compile(&parts) }
    }
}
