//! A run as vectors: what went in and what came out before every edge, for a replay in another simulator.

use std::sync::{Arc, Mutex};

use tilewright_hdl::Bits;

use super::{Observer, View};
use crate::error::Error;
use crate::program::{Port, Program, ValueId};

/// A recorded run from time 0.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Recording {
    /// Input ports: Verilog name and width in bits.
    pub inputs: Vec<(String, u32)>,
    /// Output ports: Verilog name and width in bits.
    pub outputs: Vec<(String, u32)>,
    /// Paths of the registers without a reset value, which started from zero.
    pub zeroed_registers: Vec<String>,
    /// Paths of the memories of unknown contents, which started from zeros.
    pub zeroed_memories: Vec<String>,
    /// Every instant at which a clock rose, in order.
    pub steps: Vec<Step>,
}

/// One instant of a [`Recording`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Step {
    /// The time of the edge in picoseconds.
    pub time: u64,
    /// The clocks that rise, by index among the top module's clocks.
    pub clocks: Vec<usize>,
    /// The clocks whose reset is high.
    pub resets: Vec<usize>,
    /// The inputs in force before the edge, in order of the ports.
    pub inputs: Vec<Bits>,
    /// The outputs settled before the edge, in order of the ports.
    pub outputs: Vec<Bits>,
}

impl Recording {
    pub(crate) fn new(program: &Program) -> Recording {
        let ports =
            |ports: &[Port]| ports.iter().map(|port| (port.name.clone(), program.value(port.value).width)).collect();
        let (zeroed_registers, zeroed_memories) = crate::start::unset(program);
        Recording {
            inputs: ports(&program.inputs),
            outputs: ports(&program.outputs),
            zeroed_registers,
            zeroed_memories,
            steps: Vec::new(),
        }
    }
}

/// Fills a recording.
pub(crate) struct Recorder(pub Arc<Mutex<Recording>>);

impl Observer for Recorder {
    fn sample(&mut self, view: &mut View) -> Result<(), Error> {
        let program = view.program;
        let mut all = |ports: &[Port]| ports.iter().map(|port| bits(view.engine, program, port.value)).collect();
        let step = Step {
            time: view.until,
            clocks: view.rising.to_vec(),
            resets: (0..view.resets.len()).filter(|&clock| view.resets[clock]).collect(),
            inputs: all(&program.inputs),
            outputs: all(&program.outputs),
        };
        self.0.lock().expect("no panic while recording").steps.push(step);
        Ok(())
    }
}

/// A value of one lane.
fn bits(engine: &mut crate::reference::Engine, program: &Program, id: ValueId) -> Bits {
    Bits::from_limbs(program.value(id).width, engine.read(id))
}
