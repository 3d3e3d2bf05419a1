//! Forward wires: nets that are read before their driver is described, as a ready signal is.

use crate::compare::compared_as_signal;
use crate::elaboration;
use crate::operand::{Operand, operators, reads_as_signal};
use crate::signal::Signal;
use std::ops::Deref;
use tilewright_circuit::ir::NodeId;
use tilewright_circuit::{Loc, Mistake, Problem};

/// A net, or a record of nets, declared before its driver. It reads as its value; call [`drive`](Wire::drive) exactly
/// once.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// def!(ready = m.wire(bit()));
/// def!(count = m.reg(4).reset(0));
/// count.when(ready, count + 1); // read here, ..
/// ready.drive(count.lt(3)); // .. driven there
/// # });
/// assert_eq!(example.values("count"), [0, 1, 2, 3, 3, 3]);
/// ```
#[derive(Debug, Clone, Copy)]
#[must_use]
pub struct Wire<V = Signal> {
    pub(crate) signal: V,
    pub(crate) index: usize,
}

impl<V> Deref for Wire<V> {
    type Target = V;

    fn deref(&self) -> &V {
        &self.signal
    }
}

operators!(Wire);
compared_as_signal!(Wire);
reads_as_signal!(Wire);

impl Wire {
    /// Drives the wire.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(sum = m.wire(8));
    /// sum.drive(250);
    /// m.assert((sum + 10).eq(4), "a number takes the width of the wire");
    /// # });
    /// ```
    #[track_caller]
    pub fn drive(self, value: impl Operand) {
        let loc = Loc::caller();
        let driver = value.operand().like(self.signal, "drive").id();
        if is_here(self.signal, driver, loc) {
            let slot = elaboration::draft(|draft| draft.wires[self.index].driver.replace((driver, loc)));
            report_second_driver(Mistake::DrivenTwice, slot, self.signal.node, "driven", CHOOSE, loc);
        }
    }
}

/// Whether the wire, read as `signal`, and its `driver` belong to the module under construction; an index means
/// nothing in another module. If not, that is a problem.
pub(crate) fn is_here(signal: Signal, driver: NodeId, loc: Loc) -> bool {
    let _ = signal.id_at(loc);
    elaboration::draft(|draft| {
        let here = draft.serial == signal.module;
        if !here {
            draft.in_problems.insert(driver);
        }
        here
    })
}

/// The remedy for two drivers.
pub(crate) const CHOOSE: &str = "choose between the two with `mux` or `select`";

/// A problem if `before` has an earlier driver of `node`.
pub(crate) fn report_second_driver(
    mistake: Mistake,
    before: Option<(NodeId, Loc)>,
    node: NodeId,
    verb: &str,
    help: &str,
    loc: Loc,
) {
    let Some((lost, first)) = before else { return };
    elaboration::with(|e| {
        let draft = e.draft();
        let (name, place) = (draft.describe(node), draft.node(node).loc);
        let problem = Problem::new(mistake, loc, format!("`{name}` is {verb} twice"))
            .note("the first time is", first)
            .note(format!("`{name}` is declared"), place)
            .help(help);
        e.report_instead_of(&[lost], problem);
    });
}
