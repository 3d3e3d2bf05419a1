//! The block with which the README begins, as it is and with a mistake.

pub mod lib;
pub mod mistake;
