//! Where a run starts: which state has any value, and where the printed Verilog has it.

use crate::Error;
use crate::model::Model;
use tilewright_gen::{Net, nets};
use tilewright_hdl::ir::Init;
use tilewright_hdl::recording::Initial;
use tilewright_hdl::{Bits, Design};
use tilewright_sim::{EngineKind, Simulation};

/// The start of all runs of a design.
pub struct Start {
    /// State with any value: its width or words, and the nets.
    pub free: Vec<(Initial, Vec<Net>)>,
    /// Nets with one value. Verilog cannot say where registers start whose lanes differ.
    pub fixed: Vec<(Net, Bits)>,
}

impl Start {
    /// The start of a design, which is printed as `prepared`.
    ///
    /// # Errors
    ///
    /// It cannot be simulated.
    pub fn of(design: &Design, prepared: &Design) -> Result<Start, Error> {
        let free = free(design)?;
        let mut each: Vec<Initial> = Vec::new();
        if let Some(without) = without_each(design) {
            each = self::free(&without)?
                .into_iter()
                .filter(|it| !free.iter().any(|other| other.path == it.path))
                .collect();
            let mut sim = simulation(design)?;
            for start in &mut each {
                start.words = vec![sim.peek(&start.path).map_err(unsimulated)?];
            }
        }
        let fixed = nets(prepared, &each).into_iter().zip(&each);
        let fixed =
            fixed.filter_map(|(nets, start)| Some((nets.into_iter().next()?, start.words[0].clone()))).collect();
        let nets = nets(prepared, &free);
        Ok(Start { free: free.into_iter().zip(nets).collect(), fixed })
    }

    /// What is known of state 0: each expression is true.
    pub fn conditions(&self, model: &Model) -> Vec<String> {
        let has = |net: &Net| model.wires.contains_key(&net.name);
        let fixed = self.fixed.iter().filter(|(net, _)| has(net));
        fixed.flat_map(|(net, value)| equals(model, net, value)).collect()
    }
}

/// The bits of a net in state 0 that a value gives, each as a condition.
fn equals(model: &Model, net: &Net, value: &Bits) -> Vec<String> {
    let (wire, is_bit) = (format!("|{}_n {}@0|", model.top, net.name), model.wires[&net.name] == 1);
    let bit = |index: u32| {
        let is_high = value.slice(index..index + 1) == Bits::new(1, 1);
        let place = net.low + index;
        match (is_bit, is_high) {
            (true, true) => wire.clone(),
            (true, false) => format!("(not {wire})"),
            (false, _) => format!("(= ((_ extract {place} {place}) {wire}) #b{})", u32::from(is_high)),
        }
    };
    (0..value.width()).map(bit).collect()
}

/// The state that a seed fills.
fn free(design: &Design) -> Result<Vec<Initial>, Error> {
    let mut sim = simulation(design)?.seeded(1);
    let recorder = sim.recording();
    // An assertion that fails at once does not matter.
    let _ = sim.try_step();
    Ok(recorder.take().initial)
}

/// The design without the reset values that differ by lane; `None` if there are none.
fn without_each(design: &Design) -> Option<Design> {
    let mut modules = design.clone().into_modules();
    let registers = modules.iter_mut().flat_map(|module| &mut module.registers);
    let mut count = 0;
    for register in registers.filter(|it| it.initial.is_none() && matches!(it.reset, Some(Init::Each(_)))) {
        (register.reset, count) = (None, count + 1);
    }
    (count > 0).then(|| Design::new(modules).expect("a register needs no reset"))
}

/// A simulation that is quickly made.
pub fn simulation(design: &Design) -> Result<Simulation, Error> {
    Ok(Simulation::from_design(design).map_err(unsimulated)?.on(EngineKind::Interpreter))
}

pub fn unsimulated(error: impl Into<tilewright_sim::Error>) -> Error {
    Error::Refused(format!("the design cannot be simulated: {}", error.into()))
}
