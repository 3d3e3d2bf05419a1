//! A run by which the two modules differ, which the simulator has replayed.

use super::circuit::{Circuit, State};
use super::miter::{DIFFERENT, OF_OURS, OF_THEIRS, QUIET};
use super::theirs::width;
use super::{Both, First};
use crate::Error;
use crate::answer::value;
use crate::start::{simulation, unsimulated};
use tilewright_hdl::{Bits, Design, Recording};

/// A run at whose end the outputs differ. The simulator has replayed the design's side of it.
///
/// ```
/// # let run = tilewright_prove::Difference {
/// #     module: "hand".to_owned(), clock: 3, outputs: vec!["count".to_owned()],
/// #     recording: Default::default(), theirs: vec![],
/// # };
/// println!("`{}` of {} differs in clock {}", run.outputs.join("`, `"), run.module, run.clock);
/// ```
#[derive(Debug, Clone)]
pub struct Difference {
    /// The name of the module that was written by hand.
    pub module: String,
    /// The clock in which the outputs differ, from 0: the run has one more.
    pub clock: u32,
    /// The outputs that differ.
    pub outputs: Vec<String>,
    /// The run of the design.
    pub recording: Recording,
    /// The other module's outputs, in the sequence of the design's.
    pub theirs: Vec<Value>,
}

/// The values of one of the other module's outputs.
///
/// ```
/// let value = tilewright_prove::Value { name: "count".to_owned(), clocks: vec![] };
/// assert!(value.clocks.is_empty());
/// ```
#[derive(Debug, Clone)]
pub struct Value {
    /// The port's name.
    pub name: String,
    /// Its value in each clock, before the edge at its end. Of a port with lanes, lane 0 is in the lowest bits.
    pub clocks: Vec<Bits>,
}

impl Difference {
    /// The run of these inputs. `plain` is the design without what could stop a simulation.
    ///
    /// # Errors
    ///
    /// The simulator does not show what the circuit does.
    pub(super) fn of(
        plain: &Design,
        both: Both,
        mut inputs: Vec<Vec<bool>>,
        module: String,
    ) -> Result<Difference, Error> {
        let Both { circuit, first } = both;
        simplify(plain, &circuit, &mut inputs);
        let mut states = states(&circuit, &inputs);
        for First { inputs: before, state } in first.into_iter().rev() {
            inputs.insert(0, before);
            states.insert(0, state);
        }
        let names: Vec<String> = plain.top().outputs.iter().map(|port| port.name.clone()).collect();
        let all = |prefix: &str, name: &str| -> Vec<Bits> {
            let name = format!("{prefix}{name}");
            states.iter().map(|state| value(&circuit.output(state, &name))).collect()
        };
        let theirs = names.iter().map(|name| Value { name: name.clone(), clocks: all(OF_THEIRS, name) });
        let theirs: Vec<Value> = theirs.collect();
        let recording = replay(plain, &circuit, &inputs)?;
        for (port, name) in names.iter().enumerate() {
            let expected = all(OF_OURS, name);
            let compared = recording.steps.iter().zip(&expected).enumerate();
            for (clock, (step, expected)) in compared.filter(|(_, (step, _))| step.resets.is_empty()) {
                let found = &step.outputs[port];
                if found != expected {
                    return Err(Error::Unshown(format!("`{name}` is {found:?} in clock {clock}, not {expected:?}")));
                }
            }
        }
        let last = states.len() - 1;
        let is_other = |port: &usize| recording.steps[last].outputs[*port] != theirs[*port].clocks[last];
        let outputs = (0..names.len()).filter(is_other).map(|port| names[port].clone()).collect();
        Ok(Difference { module, clock: last as u32, outputs, recording, theirs })
    }
}

fn states(circuit: &Circuit, inputs: &[Vec<bool>]) -> Vec<State> {
    let mut states: Vec<State> = Vec::with_capacity(inputs.len());
    for now in inputs {
        states.push(circuit.state(states.last(), now));
    }
    states
}

/// Whether the outputs differ in the last clock of a run that is allowed, and that has no reset if there is to be none.
fn shows(circuit: &Circuit, inputs: &[Vec<bool>], is_quiet: bool) -> bool {
    let is = |state: &State, name: &str| circuit.output(state, name) == [true];
    let states = states(circuit, inputs);
    let is_good = |state: &State| circuit.is_allowed(state) && (!is_quiet || is(state, QUIET));
    states.iter().all(is_good) && states.last().is_some_and(|state| is(state, DIFFERENT))
}

/// The most gates that are computed to find values that do not matter.
const MOST_GATES: usize = 50_000_000;

/// Makes zeros of the values that do not matter.
fn simplify(design: &Design, circuit: &Circuit, inputs: &mut [Vec<bool>]) {
    let is_quiet = shows(circuit, inputs, true);
    let top = design.top();
    let reset = top.clocks.first().and_then(|clock| clock.reset.as_deref());
    let ports = top.inputs.iter().map(|port| port.name.as_str());
    let ports: Vec<&[usize]> = ports.filter(|name| Some(*name) != reset).map(|name| circuit.port(name)).collect();
    let clocks = inputs.len();
    let places = (0..clocks).rev().flat_map(|clock| ports.iter().map(move |port| (clock, *port)));
    for (clock, port) in places.take(MOST_GATES / (clocks * circuit.gates()).max(1)) {
        let before = inputs[clock].clone();
        port.iter().for_each(|bit| inputs[clock][*bit] = false);
        if inputs[clock] != before && !shows(circuit, inputs, is_quiet) {
            inputs[clock] = before;
        }
    }
}

/// The run in the simulator.
fn replay(plain: &Design, circuit: &Circuit, inputs: &[Vec<bool>]) -> Result<Recording, Error> {
    let top = plain.top();
    let mut sim = simulation(plain)?;
    let recorder = sim.recording();
    let reset = top.clocks.first().and_then(|clock| Some((clock, clock.reset.as_ref()?)));
    for now in inputs {
        let bits = |name: &str| circuit.port(name).iter().map(|index| now[*index]).collect::<Vec<bool>>();
        for port in &top.inputs {
            // Bits that nothing depends on are not in the circuit.
            let (found, width) = (bits(&port.name), width(top, port.node));
            let value = if found.len() == width as usize { value(&found) } else { Bits::zero(width) };
            let input = sim.port(&port.name).map_err(unsimulated)?;
            sim.set(input, value);
        }
        if let Some((clock, reset)) = reset {
            let level = bits(reset).first().copied().unwrap_or(false);
            sim.set_reset(&clock.port, level != clock.kind.is_active_low());
        }
        sim.try_step().map_err(unsimulated)?;
    }
    Ok(recorder.take())
}
