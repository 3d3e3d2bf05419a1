//! Records as values: in registers, wires and memories, and in choices.

mod choices;
mod codes;
mod declared;
mod lanes;
mod memories;
mod registers;
mod stages;
mod values;
