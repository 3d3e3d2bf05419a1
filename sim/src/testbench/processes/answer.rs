//! Models that answer within the clock: inputs that follow outputs without an edge between.

use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll};

use tilewright_circuit::Bits;

use super::{Process, Testbench};
use crate::testbench::port::{IntoValue, Port};

/// A model of something outside of the design that has no clock; made by [`Testbench::answer`].
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let (enable, count, t) = (sim.i.enable, sim.o.count, sim.testbench());
/// t.run((t.wait(9), t.answer(enable, [count], |[count]| count < 5)));
/// assert_eq!(t.get_u64(count), 5);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
pub struct Answer<F, const N: usize> {
    to: Port,
    from: [Port; N],
    model: F,
    /// What it answered last.
    last: Option<Bits>,
}

impl Testbench<'_> {
    /// A process that answers within the clock: the input `to` follows the ports `from` as `model` says. Such are the
    /// data of a memory that is read at once, or the level of a line that several sides drive.
    ///
    /// Each process sees the answer in the clock of the question, and so does the edge. The model is asked before each
    /// edge, when all inputs are set; so it may look at what processes change. Answers may depend on each other, but
    /// not in a loop. Nobody waits for the end of this process.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::Simulation;
    /// block! {
    ///     /// Adds up the words of a memory outside, one a clock.
    ///     struct Adder;
    ///     in AdderIn { word: bits(8) }
    ///     out AdderOut { address: bits(4), sum: bits(8) }
    /// }
    /// # impl Adder {
    /// #     fn build(&self, m: Module, i: AdderIn) -> AdderOut {
    /// #         def!(address = m.reg(4).reset(0));
    /// #         address.next(address + 1);
    /// #         def!(sum = m.reg(8).reset(0));
    /// #         sum.next(sum + i.word);
    /// #         AdderOut { address: *address, sum: *sum }
    /// #     }
    /// # }
    ///
    /// let mut sim = Simulation::of(&Adder)?;
    /// let (word, address, sum) = (sim.i.word, sim.o.address, sim.o.sum);
    /// let t = sim.testbench();
    /// let words = [10, 20, 30, 40];
    /// t.run((t.wait(4), t.answer(word, [address], |[address]| words[address as usize % 4])));
    /// assert_eq!(t.get_u64(sum), 10 + 20 + 30 + 40);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// In the run: `to` is an output, a port of `from` is wider than 64 bits, an answer does not fit, or answers
    /// depend on each other in a loop.
    pub fn answer<const N: usize, V: IntoValue, F: FnMut([u64; N]) -> V>(
        &self,
        to: Port,
        from: [Port; N],
        model: F,
    ) -> Answer<F, N> {
        Answer { to, from, model, last: None }
    }
}

impl<const N: usize, V: IntoValue, F: FnMut([u64; N]) -> V> Process for Answer<F, N> {
    type Output = ();
    type Future = Asked<F, N>;
    const IS_MONITOR: bool = true;

    fn future(self) -> Asked<F, N> {
        Asked(self)
    }

    fn output(_: Option<()>) {}

    fn settle(asked: Pin<&mut Asked<F, N>>, testbench: &Testbench) -> bool {
        let Asked(answer) = asked.get_mut();
        let value = (answer.model)(answer.from.map(|port| testbench.get_u64(port)));
        let mut shared = testbench.shared.borrow_mut();
        let value = shared.circuit.fitting(answer.to, value);
        let is_other = answer.last.as_ref() != Some(&value);
        if is_other {
            shared.circuit.set(answer.to, value.clone());
            answer.last = Some(value);
        }
        is_other
    }
}

/// A model in a run: it never ends.
#[doc(hidden)]
pub struct Asked<F, const N: usize>(Answer<F, N>);

// Nothing refers to its parts.
impl<F, const N: usize> Unpin for Asked<F, N> {}

impl<F, const N: usize> Future for Asked<F, N> {
    type Output = ();

    fn poll(self: Pin<&mut Self>, _: &mut Context) -> Poll<()> {
        Poll::Pending
    }
}
