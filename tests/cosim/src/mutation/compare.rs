//! A block and its mutant under the same random inputs.

use crate::stimulus::Numbers;
use std::fmt;
use tilewright_hdl::Design;
use tilewright_sim::{Error, Port, Simulation};

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

/// How many runs there are, and how long one is at most: it ends at an assertion.
const RUNS: u64 = 200;
const INSTANTS: u64 = 500;

/// Whether a design and its mutant show the same under random inputs.
///
/// # Panics
///
/// A simulation fails otherwise than by an assertion.
pub fn compare(design: &Design, mutant: &Design) -> Comparison {
    let mut instants = 0;
    for seed in 0..RUNS {
        let mut both = [design, mutant].map(|design| Simulated::new(design, seed));
        let mut numbers = Numbers(seed);
        // Conditions that seldom hold, and such that hold most of the time, show different states.
        let stays = numbers.draw() % 8;
        for instant in 0..INSTANTS {
            for (port, input) in design.top().inputs.iter().enumerate() {
                if instant == 0 || numbers.draw() % 8 >= stays {
                    let value = numbers.lanes(design.top().node(input.node));
                    both.iter_mut().for_each(|one| one.sim.set(one.inputs[port], value.clone()));
                }
            }
            let resets = instant == 0 || numbers.draw().is_multiple_of(97);
            for port in 0..design.top().outputs.len() {
                let [one, other] = both.each_mut().map(|one| one.sim.get(one.outputs[port]));
                if instant > 0 && one != other {
                    return Comparison::Differs(instants, format!("`{}` differs", design.top().outputs[port].name));
                }
            }
            instants += 1;
            match both.each_mut().map(|one| one.step(resets)) {
                [true, true] => {}
                [false, false] => break,
                _ => return Comparison::Differs(instants, "an assertion differs".to_owned()),
            }
        }
    }
    Comparison::Same(instants)
}

struct Simulated {
    sim: Simulation,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
}

impl Simulated {
    fn new(design: &Design, seed: u64) -> Simulated {
        let sim = Simulation::from_design(design).expect("every design can be compiled").seeded(seed);
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
        let all = subjects();
        let subject = all.iter().find(|subject| subject.name == "page-id-generator").unwrap();
        assert!(matches!(compare(&subject.design, &subject.design), Comparison::Same(1000..)));
        let mutant = subject.mutants.iter().find(|mutant| mutant.change == "Add becomes Sub").unwrap();
        let comparison = compare(&subject.design, &subject.with(mutant).unwrap());
        assert!(matches!(&comparison, Comparison::Differs(_, what) if what.ends_with("differs")), "{comparison}");
    }
}
