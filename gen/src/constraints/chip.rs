//! What a design says about its chip: clocks with their periods, and ports.

use crate::verilog::top_ports;
use tilewright_circuit::Period;
use tilewright_circuit::ir::{Design, Instance, Module};

/// The chip of a design.
pub struct Chip {
    pub name: String,
    pub clocks: Vec<ChipClock>,
    /// The ports with their widths, as Verilog has them without models.
    pub ports: Vec<(String, u32)>,
}

/// A clock of a chip.
pub struct ChipClock {
    /// The net in the top, which is also the port if it comes from outside.
    pub net: String,
    pub period: Period,
    /// Where it is made; `None` if it comes from outside.
    pub made: Option<Made>,
}

/// A clock that a foreign module makes.
pub struct Made {
    /// The pin at which it leaves the instance, such as `u_pll/CLKOP`.
    pub pin: String,
    /// The pin for the clock from which it is made, and how it is made, if the periods tell.
    pub source: Option<(String, Ratio)>,
}

/// The frequency of a made clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ratio {
    /// That of its source, times this number.
    Times(u64),
    /// That of its source, divided by this number.
    Part(u64),
}

impl Chip {
    pub fn of(design: &Design) -> Chip {
        let top = design.top();
        let clock = |clock: &tilewright_circuit::ir::Clock| ChipClock {
            net: clock.port.clone(),
            period: clock.period.expect("a clock of the top has a period"),
            made: clock.name.and_then(|name| made(design, top, name)),
        };
        Chip { name: top.name.clone(), clocks: top.clocks.iter().map(clock).collect(), ports: top_ports(design) }
    }
}

/// Where the clock of this name is made.
fn made(design: &Design, top: &Module, name: &str) -> Option<Made> {
    top.instances.iter().find_map(|instance| {
        let foreign = design.module(instance.module).foreign.as_ref()?;
        let (_, port) = foreign.makes.iter().find(|(clock, _)| clock.name == name)?;
        let pin = |port: &str| format!("{}/{port}", instance.name);
        let source = source(design, top, instance, name).map(|(port, ratio)| (pin(&port), ratio));
        Some(Made { pin: pin(port), source })
    })
}

/// The first port for a clock other than the made one, and how the made one follows from it.
fn source(design: &Design, top: &Module, instance: &Instance, name: &str) -> Option<(String, Ratio)> {
    let child = design.module(instance.module);
    let period = |name: Option<&str>| {
        let inner = child.clocks.iter().position(|clock| clock.name == name)?;
        top.clocks[instance.clocks[inner].0 as usize].period
    };
    let (of, port) = child.foreign.as_ref()?.clocks.iter().find(|(clock, _)| clock.map(|it| it.name) != Some(name))?;
    let from = period(of.map(|clock| clock.name))?.picoseconds();
    let to = top.clocks.iter().find(|clock| clock.name == Some(name))?.period?.picoseconds();
    let ratio = match () {
        () if from.is_multiple_of(to) => Ratio::Times(from / to),
        () if to.is_multiple_of(from) => Ratio::Part(to / from),
        () => return None,
    };
    Some((port.clone(), ratio))
}
