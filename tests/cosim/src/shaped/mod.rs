//! Random circuits with shapes, built node by node: what the circuit can be, whatever the language makes of it.

mod build;
pub mod spec;
pub mod strategy;

pub use spec::Spec;
use tilewright_hdl::{Design, Problems};

/// The design of a description, whose top has this name.
///
/// # Errors
///
/// The rules that it breaks, which is a mistake of this crate.
pub fn design(spec: &Spec, name: &str) -> Result<Design, Problems> {
    Design::new(build::modules(spec, name))
}
