//! Strip programs that are checked and not executed.

use std::sync::Arc;

use tilewright_circuit::ir::Design;

use super::Compiled;
use crate::engine::program::{ValueId, compile};
use crate::engine::strips::Examined;
use crate::engine::{Beginning, Passes};

/// What the checks find of the functions for each edge and of those for its outputs; none is executed.
#[doc(hidden)]
pub fn examined(design: &Design, passes: &Passes) -> Examined {
    let program = Arc::new(compile(design, passes));
    let Ok(mut engine) = Compiled::new(program, &Beginning::default(), &Arc::default()) else {
        return Examined::default();
    };
    engine.jit.examined = Some(Examined::default());
    let clocks: Vec<usize> = (0..engine.program.clocks.len()).collect();
    let all = (clocks.len() > 1).then_some(clocks.as_slice());
    for rising in clocks.chunks(1).chain(all) {
        engine.edge(rising);
    }
    let outputs: Vec<ValueId> = engine.program.outputs.iter().map(|port| port.value).collect();
    engine.show(&outputs);
    engine.jit.examined.take().expect("it was given")
}
