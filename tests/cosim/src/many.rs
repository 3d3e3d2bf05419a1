//! Several stimuli of a design at once, each against a run of it alone in the reference engine.

use crate::spec::Stimulus;
use crate::stimulus::Numbers;
use std::collections::BTreeSet;
use tilewright_hdl::ir::{Node, NodeId};
use tilewright_hdl::{Bits, Design};
use tilewright_sim::{Batch, EngineKind, Error, Port, Simulation};

/// How many runs a batch has, by the number of the design: rows that fill vectors and rows that do not.
const RUNS: [u32; 8] = [2, 3, 4, 2, 5, 8, 3, 17];

/// How many runs the design of that number has at once.
fn runs(number: u64) -> u32 {
    RUNS[(number % RUNS.len() as u64) as usize]
}

/// The engine of a design's batch: to make code for every batch would take a campaign half as long again.
fn engine(number: u64) -> EngineKind {
    match (number / RUNS.len() as u64).is_multiple_of(2) {
        true => EngineKind::Compiled,
        false => EngineKind::Reference,
    }
}

/// What happens at each step: whether a reset, which all runs have together.
fn resets(stimulus: &Stimulus) -> impl Iterator<Item = bool> {
    let mut numbers = Numbers(!stimulus.seed);
    (0..stimulus.steps).map(move |_| numbers.draw().is_multiple_of(12))
}

/// The inputs of one run.
struct Inputs<'a> {
    numbers: Numbers,
    /// The ports, and whether the outside of a pad drives by it.
    ports: Vec<(&'a Node, bool)>,
}

impl<'a> Inputs<'a> {
    fn new(design: &'a Design, stimulus: &Stimulus, run: u32) -> Inputs<'a> {
        let top = design.top();
        let pads = top.instances.iter().filter(|pad| design.module(pad.module).is_pad);
        let drive: BTreeSet<NodeId> = pads.filter_map(|pad| Some(pad.outside()?[1])).collect();
        let ports = top.inputs.iter().map(|input| (top.node(input.node), drive.contains(&input.node))).collect();
        Inputs { numbers: Numbers(stimulus.seed.wrapping_add(u64::from(run) << 32)), ports }
    }

    /// What the next step sets: the input's index and its value.
    fn next(&mut self) -> Vec<(usize, Bits)> {
        let Inputs { numbers, ports } = self;
        let set = ports.iter().enumerate().filter_map(|(index, (node, drives))| {
            let stays = numbers.draw().is_multiple_of(4);
            // An assertion ends all runs where both sides of a pad drive it and differ.
            let value = |numbers: &mut Numbers| match *drives && !numbers.draw().is_multiple_of(16) {
                true => Bits::zero(1),
                false => numbers.lanes(node),
            };
            (!stays).then(|| (index, value(numbers)))
        });
        set.collect()
    }
}

/// The ports of a design by name: inputs, outputs.
fn ports(design: &Design, port: impl Fn(&str) -> Port) -> (Vec<Port>, Vec<Port>) {
    let top = design.top();
    let inputs = top.inputs.iter().map(|input| port(&input.name));
    (inputs.collect(), top.outputs.iter().map(|output| port(&output.name)).collect())
}

/// The outputs of a run alone after each step, up to one before which an assertion fails.
fn alone(design: &Design, stimulus: &Stimulus, run: u32) -> Result<Vec<Vec<Bits>>, Error> {
    let mut sim = Simulation::from_design(design)?.on(EngineKind::Reference).seeded(seed(run));
    let (inputs, outputs) = ports(design, |name| sim.port(name).expect("it is a port"));
    let mut values = Inputs::new(design, stimulus, run);
    let mut steps = Vec::new();
    for reset in resets(stimulus) {
        values.next().into_iter().for_each(|(index, value)| sim.set(inputs[index], value));
        let done = if reset { sim.try_reset() } else { sim.try_step() };
        match done {
            Err(Error::Violated(_)) => break,
            done => done?,
        }
        steps.push(outputs.iter().map(|port| sim.get(*port)).collect());
    }
    Ok(steps)
}

/// What a run starts from; the first from zeros.
fn seed(run: u32) -> u64 {
    u64::from(run)
}

/// Runs several stimuli of the design of that number at once, and says where one differs from its run alone.
///
/// # Errors
///
/// The first difference, or what the simulator says if it does not take the design.
pub fn check(design: &Design, stimulus: &Stimulus, number: u64) -> Result<(), String> {
    let (runs, engine) = (runs(number), engine(number));
    let text = |error: Error| error.to_string();
    let alone = (0..runs).map(|run| alone(design, stimulus, run)).collect::<Result<Vec<_>, _>>().map_err(text)?;
    let mut batch = Batch::from_design(design, runs).map_err(text)?.on(engine).seeded(seed);
    let (inputs, outputs) = ports(design, |name| batch.port(name).expect("it is a port"));
    let mut values: Vec<Inputs> = (0..runs).map(|run| Inputs::new(design, stimulus, run)).collect();
    for (step, reset) in resets(stimulus).enumerate() {
        for (run, values) in (0..).zip(&mut values) {
            values.next().into_iter().for_each(|(index, value)| batch.set(inputs[index], run, value));
        }
        let done = if reset { batch.try_reset() } else { batch.try_step() };
        // An assertion that fails in one run stops all.
        let fails = alone.iter().any(|steps| steps.len() == step);
        match done {
            Err(Error::Violated(_)) if fails => break,
            Ok(()) if fails => return Err(format!("at step {step} no assertion fails, but it does in a run alone")),
            done => done.map_err(text)?,
        }
        for (port, output) in design.top().outputs.iter().enumerate() {
            let all = batch.get_each(outputs[port]);
            if all.len() != alone.len() {
                return Err(format!("output {} has {} values in {runs} runs", output.name, all.len()));
            }
            for ((run, found), alone) in all.into_iter().enumerate().zip(&alone) {
                let expected = &alone[step][port];
                if found != *expected {
                    let name = &output.name;
                    return Err(format!(
                        "after step {step}, output {name} of run {run} of {runs} is {found}, alone {expected}"
                    ));
                }
            }
        }
    }
    Ok(())
}
