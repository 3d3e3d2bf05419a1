//! The checks of a finished description. Each one looks at one draft and reports every mistake that it finds.

pub(crate) mod domains;
pub(crate) mod drives;
pub(crate) mod foreign;
pub(crate) mod latency;
pub(crate) mod naming;
mod numbering;
pub(crate) mod outputs;
pub(crate) mod pads;
pub(crate) mod stages;
pub(crate) mod streams;
pub(crate) mod synchronizers;
pub(crate) mod unused;
