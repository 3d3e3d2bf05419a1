//! The global frame buffer unit.

mod unit;

pub use unit::{GfbUnit, GfbUnitIn, GfbUnitOut, Host, View};
