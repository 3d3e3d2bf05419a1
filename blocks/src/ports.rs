//! The ports of a block with a stream in and a stream out.

use tilewright_hdl::{Module, Stream, bundle};

bundle! {
    /// A stream in. The payload is a word; [`StreamBlocks`](crate::StreamBlocks) makes a record of it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Fifo, Storage, StreamIn};
    /// # tilewright_sim::example(|m| {
    /// let (into, _) = m.offer(lit(1, 1), lit(8, 7));
    /// let queue = Fifo::new(4, 8, Storage::Registers);
    /// def!(queue = m.instance(&queue, StreamIn { into }));
    /// let word = queue.out.take_when(1);
    /// m.assert(word.taken.implies(word.eq(7)), "`m.fifo(..)` does the same, and takes records too");
    /// # });
    /// ```
    pub struct StreamIn<T> {
        /// The input words.
        pub into: Stream<T, T>,
    }

    /// A stream out.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Fifo, Storage, StreamIn, StreamOut};
    /// # let example = tilewright_sim::traced(|m| {
    /// let (into, _) = m.offer(lit(1, 1), lit(8, 7));
    /// let queue = Fifo::new(4, 8, Storage::Registers);
    /// def!(queue = m.instance(&queue, StreamIn { into }));
    /// def!(taken = queue.out.take_when(1).taken);
    /// # });
    /// assert_eq!(example.values("taken"), [0, 1, 1, 1]); // latency 1 clock
    /// ```
    pub struct StreamOut<T> {
        /// The output words.
        pub out: Stream<T, T>,
    }
}

/// Asserts that a word of a stream whose `valid` comes from registers is not withdrawn. Tests check that it stays the
/// same word (`holds` of a testbench): an assertion would have to store every word a second time.
pub(crate) fn state_that_it_stays(m: Module, out: &Stream) {
    let waits = m.past(out.valid & !out.ready);
    m.assert(waits.implies(out.valid), "a word that is shown is not withdrawn");
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_hdl::{bit, bits, block};
    use tilewright_sim::Simulation;

    block! {
        /// Shows the given words, whether they were taken or not.
        struct Careless;
        in CarelessIn { valid: bit(), word: bits(4) }
        out CarelessOut { out: stream(bits(4)) }
    }

    impl Careless {
        fn build(&self, m: Module, i: CarelessIn) -> CarelessOut {
            let (valid, word) = (m.pipe("full", i.valid), m.pipe("held", i.word));
            let (out, _) = m.offer(valid, word);
            state_that_it_stays(m, &out);
            CarelessOut { out }
        }
    }

    /// Whether the rule is true while these words are shown and taken.
    fn holds(shown: [(u64, u64, u64); 3]) -> bool {
        let mut sim = Simulation::of(&Careless).unwrap();
        sim.reset();
        shown.into_iter().all(|(valid, word, ready)| {
            sim.drive(CarelessIn { valid, word });
            sim.set(sim.o.out.ready, ready);
            sim.try_step().is_ok()
        }) && sim.try_step().is_ok()
    }

    #[test]
    fn what_is_shown_is_not_withdrawn() {
        assert!(holds([(1, 5, 0), (1, 5, 0), (1, 5, 0)]), "the word waits");
        assert!(holds([(1, 5, 0), (1, 7, 1), (0, 0, 1)]), "the word is taken");
        assert!(!holds([(1, 5, 0), (0, 5, 0), (0, 5, 0)]), "the word is withdrawn");
    }
}
