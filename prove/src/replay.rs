//! From the solver's values to a recording, which the simulator replays.

use crate::answer::value;
use crate::edges::{Edges, instants};
use crate::model::Model;
use crate::prepare::Stated;
use crate::solver::{Halt, Solver};
use crate::start::{Start, unsimulated};
use crate::{Error, Run};
use tilewright_hdl::ir::{Directive, Module, NodeId};
use tilewright_hdl::recording::{Initial, Step};
use tilewright_hdl::{Bits, Design, Recording};
use tilewright_sim::{Covered, Simulation};

/// What a run is made with.
pub struct Replayer<'a> {
    pub edges: Edges,
    pub design: &'a Design,
    pub model: &'a Model,
    pub start: &'a Start,
    /// At time 0.
    pub sim: Simulation,
}

impl Replayer<'_> {
    /// The run of the solver's model up to clock `last`, at whose end this happens.
    ///
    /// # Errors
    ///
    /// The solver fails, or the simulator does not show it.
    pub fn run(&self, solver: &mut Solver, last: u32, stated: &Stated) -> Result<Run, Halt> {
        let recording = self.recording(solver, last)?;
        let instance = self.shown(&recording, stated)?;
        Ok(Run { clock: last, instance, recording })
    }

    /// The recording of the solver's model.
    fn recording(&self, solver: &mut Solver, last: u32) -> Result<Recording, Halt> {
        let top = self.design.top();
        let with_reset: Vec<usize> = (0..top.clocks.len()).filter(|&it| top.clocks[it].reset.is_some()).collect();
        let mut steps = Vec::new();
        for (at, (time_ps, rising)) in (0..=last).zip(instants(&top.clocks)) {
            let inputs = top.inputs.iter().map(|port| (port.name.clone(), width(top, port.node))).collect();
            let outputs = top.outputs.iter().map(|port| (port.name.clone(), width(top, port.node))).collect();
            steps.push(Step {
                time_ps,
                rising,
                resets: if self.is_in_reset(solver, at)? { with_reset.clone() } else { vec![] },
                inputs: self.wires(solver, at, inputs)?,
                outputs: self.wires(solver, at, outputs)?,
            });
        }
        Ok(Recording { steps, initial: self.initial(solver)? })
    }

    fn is_in_reset(&self, solver: &mut Solver, at: u32) -> Result<bool, Halt> {
        match in_reset(self.design, solver, at) {
            Some(active) => Ok(solver.values(&[active])?[0][0]),
            None => Ok(false),
        }
    }

    /// The values of wires in a clock; those that the model does not have are zero.
    fn wires(&self, solver: &mut Solver, clock: u32, wires: Vec<(String, u32)>) -> Result<Vec<Bits>, Halt> {
        let known: Vec<&(String, u32)> = wires.iter().filter(|(name, _)| self.model.wires.contains_key(name)).collect();
        let expressions: Vec<String> = known.iter().map(|(name, _)| solver.of(&format!("n {name}"), clock)).collect();
        let mut values = solver.values(&expressions)?.into_iter();
        let value = |(name, width): &(String, u32)| match self.model.wires.contains_key(name) {
            true => values.next().map_or_else(|| Bits::zero(*width), |bits| value(&bits)),
            false => Bits::zero(*width),
        };
        Ok(wires.iter().map(value).collect())
    }

    /// The values of the state that may start anyhow.
    fn initial(&self, solver: &mut Solver) -> Result<Vec<Initial>, Halt> {
        let mut all = Vec::new();
        for (start, nets) in &self.start.free {
            let wires = nets.iter().map(|net| (net.name.clone(), 1)).collect();
            let values = self.wires(solver, 0, wires)?;
            let words = start.words.iter().enumerate().map(|(index, word)| {
                let value =
                    values.get(index).zip(nets.get(index)).filter(|(_, net)| self.model.wires.contains_key(&net.name));
                value.map_or_else(
                    || Bits::zero(word.width()),
                    |(value, net)| value.slice(net.low..net.low + word.width()),
                )
            });
            all.push(Initial { words: words.collect(), ..start.clone() });
        }
        Ok(all)
    }

    /// Replays a recording; returns the instance that shows what happens at its end.
    fn shown(&self, recording: &Recording, stated: &Stated) -> Result<String, Halt> {
        let sim = self.sim.another().starting_as(recording);
        let mut sim = sim.map_err(unsimulated)?;
        let ended = sim.replay(recording);
        let found = match (stated.directive, &ended) {
            (Directive::Cover, Ok(())) => {
                let is_hit = |it: &Covered| it.count > 0 && it.loc == stated.loc && it.path.ends_with(&stated.message);
                let hit = sim.covers().into_iter().find(is_hit);
                hit.map(|it| it.path.trim_end_matches(&stated.message).trim_end_matches('.').to_owned())
                    .map(|path| if path.is_empty() { self.design.top().name.clone() } else { path })
            }
            (_, Err(tilewright_sim::Error::Violated(violations))) => {
                let is_last = recording.steps.last().map(|step| step.time_ps);
                let is_it = |it: &&tilewright_sim::Violation| {
                    it.loc == stated.loc && it.message == stated.message && Some(it.time) == is_last
                };
                violations.iter().find(is_it).map(|it| it.instance.clone())
            }
            _ => None,
        };
        let why = || match &ended {
            Ok(()) => format!("`{}` does not happen", stated.message),
            Err(error) => error.to_string(),
        };
        found.ok_or_else(|| Error::Unshown(why()).into())
    }
}

/// The bits of a port in all its lanes.
fn width(module: &Module, node: NodeId) -> u32 {
    module.width(node) * module.shape(node).lanes()
}

/// Whether the reset is active in a clock, as an expression; `None` if there is no reset. Several resets are active
/// together.
pub fn in_reset(design: &Design, solver: &Solver, clock: u32) -> Option<String> {
    let port = design.top().clocks.iter().find(|port| port.reset.is_some())?;
    let level = solver.of(&format!("n {}", port.reset.as_ref()?), clock);
    Some(if port.kind.is_active_low() { format!("(not {level})") } else { level })
}
