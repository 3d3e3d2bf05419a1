//! The vocabulary of the blocks' descriptions: the language, and the words that the machines share.

pub use tilewright_hdl::*;

pub use crate::clocks::{MERGE, PE};
pub use crate::parameter::{ParameterError, Screen};
pub use crate::scan::{Position, ScanControl};
pub use crate::word::{WORD, empty};
