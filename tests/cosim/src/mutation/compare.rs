//! A block and its mutant under the same random inputs.

use crate::stimulus::Numbers;
use std::fmt;
use tilewright_hdl::{Bits, Design};
use tilewright_sim::{EngineKind, Error, Port, Simulation};

/// What random inputs show of a mutant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Comparison {
    /// In so many instants nothing differs: it may be the same circuit.
    Same(u64),
    /// After so many instants something does.
    Differs(u64, String),
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Comparison::Same(instants) => write!(f, "nothing differs in {instants} instants of random inputs"),
            Comparison::Differs(instants, what) => write!(f, "{what} after {instants} instants of random inputs"),
        }
    }
}

/// How many instants there are at least, of how many runs at most, and how long one is at most: it ends at an assertion.
const ENOUGH: u64 = 50_000;
const RUNS: u64 = 300;
const INSTANTS: u64 = 500;

/// Whether a design and its mutant show the same under random inputs, from a reset on.
///
/// # Panics
///
/// A simulation fails otherwise than by an assertion.
pub fn compare(design: &Design, mutant: &Design) -> Comparison {
    let mut instants = 0;
    for seed in 0..RUNS {
        let mut both = [design, mutant].map(|design| Simulated::new(design, seed));
        if let Some(what) = differ(design, &mut both, &mut Numbers(seed), &mut instants) {
            return Comparison::Differs(instants, what);
        }
        if instants >= ENOUGH {
            break;
        }
    }
    Comparison::Same(instants)
}

/// What differs in a run, if something does; counts its instants.
fn differ(design: &Design, both: &mut [Simulated; 2], numbers: &mut Numbers, instants: &mut u64) -> Option<String> {
    let top = design.top();
    // Single bits that are seldom high, or most of the time; and what stays for a while. Each shows other states.
    let (high, stays) = ([1, 2, 4, 8, 15][(numbers.draw() % 5) as usize], numbers.draw() % 8);
    for instant in 0..INSTANTS {
        for (port, input) in top.inputs.iter().enumerate() {
            let node = top.node(input.node);
            if instant == 0 || numbers.draw() % 8 >= stays {
                let value = match node.width {
                    1 if node.shape.is_plain() => Bits::new(1, u64::from(numbers.draw() % 16 < high)),
                    _ => numbers.lanes(node),
                };
                both.iter_mut().for_each(|one| one.sim.set(one.inputs[port], value.clone()));
            }
        }
        for (port, output) in top.outputs.iter().enumerate().filter(|_| instant > 0) {
            let [one, other] = both.each_mut().map(|one| one.sim.get(one.outputs[port]));
            if one != other {
                return Some(format!("`{}` differs", output.name));
            }
        }
        *instants += 1;
        let resets = instant == 0 || numbers.draw().is_multiple_of(97);
        match both.each_mut().map(|one| one.step(resets)) {
            [true, true] => {}
            [false, false] => return None,
            _ => return Some("an assertion differs".to_owned()),
        }
    }
    None
}

struct Simulated {
    sim: Simulation,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
}

impl Simulated {
    /// The design at the start, with any values in what no reset sets.
    fn new(design: &Design, seed: u64) -> Simulated {
        let sim = Simulation::from_design(design).expect("every design can be compiled");
        // A run is too short for code to be worth its making.
        let sim = sim.on(EngineKind::Interpreter).seeded(seed);
        let port = |name: &str| sim.port(name).expect("the design has the port");
        let inputs = design.top().inputs.iter().map(|input| port(&input.name)).collect();
        let outputs = design.top().outputs.iter().map(|output| port(&output.name)).collect();
        Simulated { sim, inputs, outputs }
    }

    /// Whether every assertion holds at the next instant.
    fn step(&mut self, resets: bool) -> bool {
        match if resets { self.sim.try_reset() } else { self.sim.try_step() } {
            Ok(_) => true,
            Err(Error::Violated(_)) => false,
            Err(problem) => panic!("{problem}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mutation::subjects;

    #[test]
    fn a_mutant_differs_and_the_block_itself_does_not() {
        let [subject] = &subjects(|_, name| name == "page-id-generator")[..] else { panic!("there is one") };
        assert!(matches!(compare(&subject.design, &subject.design), Comparison::Same(2000..)));
        let mutant = subject.mutants.iter().find(|mutant| mutant.change == "Add becomes Sub").unwrap();
        let comparison = compare(&subject.design, &subject.with(mutant).unwrap());
        assert!(matches!(&comparison, Comparison::Differs(_, what) if what.ends_with("differs")), "{comparison}");
    }
}
