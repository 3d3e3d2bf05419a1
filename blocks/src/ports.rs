//! The ports of a block with a stream in and a stream out.

use tilewright_hdl::{Stream, bundle};

bundle! {
    /// A stream in. The payload is a word, of which [`StreamBlocks`](crate::StreamBlocks) makes a record.
    pub struct StreamIn<T> {
        /// What comes in.
        pub into: Stream<T, T>,
    }

    /// A stream out.
    pub struct StreamOut<T> {
        /// What goes out.
        pub out: Stream<T, T>,
    }
}
