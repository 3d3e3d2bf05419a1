//! Records as values: what registers, wires and memories hold, and what choices are made of.

mod choices;
mod memories;
mod registers;
mod stages;
mod values;
