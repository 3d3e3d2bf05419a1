//! The next question: why the net that differs has its values in the scenario of its block.

use crate::block::{entries, simulation};
use crate::moment::play_remembered;
use tilewright_hdl::{Bits, DEFAULT_PERIOD};
use tilewright_machines::Step;
use tilewright_sim::{EngineKind, Limits, Simulation};

/// Cycles at the end of a scenario in which another value is looked for.
const CYCLES: u64 = 200;

/// The command that tells the cause of a value of the step's net; `None` if the scenario of its block has no such net.
pub fn command(step: &Step) -> Option<String> {
    let net = step.net.as_deref()?.rsplit('.').next()?;
    let entry = entries().find(|entry| entry.name == step.block)?;
    let values = entry.values([]).ok()?;
    let mut sim = simulation(&entry.design(&values).ok()?, EngineKind::default()).ok()?;
    play_remembered(&mut sim, &entry.scenario(&values).ok()?).ok()?;
    // The lanes of the usual block may be others than those of the machine's.
    let plain = net.split('[').next()?;
    let names = [net.to_owned(), plain.to_owned(), format!("{plain}[0]"), format!("{plain}[0][0]")];
    let signal = names.into_iter().find(|name| value(&mut sim, name).is_some())?;
    let cycle = moment(&mut sim, &signal)?;
    let signal = if signal.contains('[') { format!("'{signal}'") } else { signal };
    Some(format!("tilewright why {} --signal {signal} --at {cycle}", entry.name))
}

fn value(sim: &mut Simulation, signal: &str) -> Option<Bits> {
    Some(sim.why_within(signal, &Limits { depth: 0, ..Limits::default() }).ok()?.value)
}

/// The last cycle in which the signal has another value than at the end, or the last one of all: there it has done something.
fn moment(sim: &mut Simulation, signal: &str) -> Option<u64> {
    let period = sim.program().clocks.first().map_or(DEFAULT_PERIOD.picoseconds(), |clock| clock.period);
    let (last, end) = (sim.time() / period, value(sim, signal)?);
    let mut before = (last.saturating_sub(CYCLES)..last).rev();
    let is_other = |cycle: &u64| sim.go_to(cycle * period).is_ok() && value(sim, signal).is_some_and(|it| it != end);
    Some(before.find(is_other).unwrap_or(last))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(block: &'static str, net: &str) -> Step {
        Step {
            primitive: None,
            unit: "a unit".to_owned(),
            block,
            does: "something".to_owned(),
            clock: "clk".to_owned(),
            cycle: 1,
            time: 10_000,
            net: Some(net.to_owned()),
            values: Vec::new(),
            apart: None,
        }
    }

    /// The pair before the last one is (99, 98) in the scenario of the merging unit, and its nearer word comes four clocks later.
    #[test]
    fn the_next_question_is_about_a_cycle_in_which_the_net_does_something() {
        let command = |block, net| command(&step(block, net));
        let next = command("merging-unit", "u_merger.u_merging_unit[3].nearer").unwrap();
        let cycle = next.strip_prefix("tilewright why merging-unit --signal nearer --at ").unwrap();
        let entry = entries().find(|entry| entry.name == "merging-unit").unwrap();
        let values = entry.values([]).unwrap();
        let mut sim = simulation(&entry.design(&values).unwrap(), EngineKind::default()).unwrap();
        play_remembered(&mut sim, &entry.scenario(&values).unwrap()).unwrap();
        let period = sim.program().clocks[0].period;
        sim.go_to(cycle.parse::<u64>().unwrap() * period).unwrap();
        assert_eq!(value(&mut sim, "nearer").unwrap(), 98);
        assert_eq!(command("merging-unit", "u_merger.u_merging_unit[3].farther"), None);
        assert_eq!(command("no-such-block", "nearer"), None);
    }
}
