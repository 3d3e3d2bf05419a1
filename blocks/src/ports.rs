//! The ports of a block with a stream in and a stream out.

use tilewright_hdl::{Stream, bundle};

bundle! {
    /// A stream in. The payload is a word, of which [`StreamBlocks`](crate::StreamBlocks) makes a record.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Fifo, Storage, StreamIn};
    /// # tilewright_sim::example(|m| {
    /// let (into, _) = m.offer(lit(1, 1), lit(8, 7));
    /// let queue = Fifo::new(4, 8, Storage::Registers);
    /// let word = m.instance("u_queue", &queue, StreamIn { into }).out.take_when(1);
    /// m.assert(word.taken.implies(word.eq(7)), "`m.fifo(..)` does the same, and takes records too");
    /// # });
    /// ```
    pub struct StreamIn<T> {
        /// What comes in.
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
    /// let StreamOut { out } = m.instance("u_queue", &queue, StreamIn { into });
    /// net!(taken = out.take_when(1).taken);
    /// # });
    /// assert_eq!(example.values("taken"), [0, 1, 1, 1]); // latency 1 clock
    /// ```
    pub struct StreamOut<T> {
        /// What goes out.
        pub out: Stream<T, T>,
    }
}
