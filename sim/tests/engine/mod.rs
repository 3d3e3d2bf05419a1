//! The engine that the tests of a file run on: the compiled one, unless `on_reference` or `on_both` includes the file.

use tilewright_hdl::Block;
use tilewright_sim::{EngineKind, Simulation};

pub const ENGINE: EngineKind = match env!("CARGO_CRATE_NAME").as_bytes() {
    b"on_reference" => EngineKind::Reference,
    b"on_both" => EngineKind::Both,
    _ => EngineKind::Compiled,
};

/// A block on that engine.
#[track_caller]
pub fn of<B: Block>(block: &B) -> Simulation<B::In, B::Out> {
    Simulation::of(block).unwrap().on(ENGINE)
}
