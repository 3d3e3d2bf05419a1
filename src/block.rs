//! The block that a command is given, and its parameters.

use crate::engine::tell_fallback;
use crate::names::{self, Names, are_alike};
use crate::shell::{Exit, Failure, progress};
use clap::Args;
use std::num::{IntErrorKind, ParseIntError};
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_hdl::ir::Clock;
use tilewright_hdl::{Design, Reset, limbs_for};
use tilewright_sim::{EngineKind, Probe, Simulation};

/// A block of the catalogue with parameters.
#[derive(Args)]
pub struct BlockArguments {
    /// Name of a block; `tilewright list blocks` shows all names
    #[arg(value_name = "BLOCK", value_parser = blocks(), hide_possible_values = true)]
    block: &'static Entry,
    /// Value of a parameter; may be repeated. `tilewright list BLOCK` shows names and ranges
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    settings: Vec<(String, u64)>,
}

impl BlockArguments {
    /// The block and the values of its parameters.
    ///
    /// # Errors
    /// There is no such parameter, a value is out of its range, or one is set twice.
    pub fn find(&self) -> Result<(&'static Entry, Values), Failure> {
        Ok((self.block, values(self.block, &self.settings)?))
    }
}

/// The values of a block's parameters, of which some are set.
///
/// # Errors
/// There is no such parameter, a value is out of its range, or one is set twice.
pub fn values(block: &'static Entry, given: &[(String, u64)]) -> Result<Values, Failure> {
    let mut settings: Vec<(&str, u64)> = Vec::new();
    for (name, value) in given {
        let name = parameter(block, name)?;
        if settings.iter().any(|(before, _)| *before == name) {
            return Err(Failure::new(Exit::BadInput, format!("{name} is set twice: give one --set {name}=VALUE")));
        }
        settings.push((name, *value));
    }
    Ok(block.values(settings)?)
}

/// The circuit of a block.
///
/// # Errors
/// The values of its parameters do not go together.
pub fn design(block: &Entry, values: &Values) -> Result<Design, Failure> {
    progress::phase("elaborating");
    Ok(block.design(values)?)
}

/// The circuit of a block whose own clock resets in this way.
///
/// # Errors
/// The values of its parameters do not go together, or it has no reset on a clock of its own.
pub fn design_with(block: &Entry, values: &Values, reset: Reset) -> Result<Design, Failure> {
    progress::phase("elaborating");
    let design = block.design_with(values, reset)?;
    // Without a reset, a clock is of the usual kind.
    let resets = |clock: &Clock| clock.name.is_none() && (clock.reset.is_some() || clock.kind == Reset::PowerOn);
    if !design.top().clocks.iter().any(resets) {
        let sentence = format!("{} has no reset on a clock of its own, which --reset is for: leave it out", block.name);
        return Err(Failure::new(Exit::BadInput, sentence));
    }
    Ok(design)
}

/// The parser of a block's name.
pub fn blocks() -> Names<&'static Entry> {
    Names::new("block", entries().map(|entry| (entry.name, entry))).listed_by("tilewright list blocks")
}

/// The parameter of a block that a user means.
///
/// # Errors
/// There is none of that name.
fn parameter<'a>(block: &Entry, given: &'a str) -> Result<&'a str, Failure> {
    let known: Vec<&'static str> = block.parameters.iter().map(|it| it.name).collect();
    match known.iter().find(|name| are_alike(given, name)) {
        Some(name) => Ok(name),
        // The catalogue has a sentence for it.
        None if known.is_empty() => Ok(given),
        None => {
            let lead = format!("{} has no parameter `{given}`", block.name);
            Err(Failure::new(Exit::BadInput, names::unknown(&lead, given, &known)))
        }
    }
}

/// Every block: those of the machines, then those that any design uses.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    tilewright_rtl::catalog::ENTRIES.iter().chain(tilewright_blocks::catalog::ENTRIES)
}

/// Reads the setting of a parameter.
///
/// # Errors
/// A sentence that says what to give.
pub fn setting(text: &str) -> Result<(String, u64), &'static str> {
    let (name, value) = text.split_once('=').ok_or("write it as NAME=VALUE, such as width=16")?;
    let value = value.parse().map_err(|problem: ParseIntError| match problem.kind() {
        IntErrorKind::PosOverflow => "no parameter has a value as large as this",
        _ => "the value has to be a whole number, such as width=16",
    })?;
    Ok((name.to_owned(), value))
}

/// The most bytes that the memories of a simulated block may take: 2 GiB.
const MOST_BYTES: u64 = 2 << 30;

/// A simulation, on that engine, of a design whose memories are not too large for this computer.
///
/// # Errors
/// Its memories are too large, or it cannot be simulated.
pub fn simulation(design: &Design, engine: EngineKind) -> Result<Simulation, Failure> {
    check_memories(design)?;
    progress::phase("compiling");
    let sim = Simulation::from_design(design)?.on(engine);
    tell_fallback(&sim);
    Ok(sim)
}

/// All ports of a simulation, as its waves show them: one with lanes lane by lane.
pub fn ports(sim: &Simulation) -> Vec<Probe> {
    let path = |name: &str, lanes: u32| if lanes > 1 { format!("{name}[*]") } else { name.to_owned() };
    let ports = sim.program().inputs.iter().chain(&sim.program().outputs);
    ports.map(|port| Probe::Path(path(&port.name, port.lanes))).collect()
}

/// Whether a design's memories are not too large for this computer.
///
/// # Errors
/// They are.
pub fn check_memories(design: &Design) -> Result<(), Failure> {
    let bytes = memory_bytes(design);
    if bytes > MOST_BYTES {
        let [needed, most] = [bytes.div_ceil(1 << 20), MOST_BYTES >> 20];
        let sentence = format!(
            "the block's memories take {needed} MiB in a simulation, and the limit is {most} MiB: --set smaller parameters"
        );
        return Err(Failure::new(Exit::BadInput, sentence));
    }
    Ok(())
}

/// The bytes of all memories of all instances; words are kept in limbs of 64 bits.
fn memory_bytes(design: &Design) -> u64 {
    let mut sizes: Vec<u64> = Vec::with_capacity(design.modules().len());
    for module in design.modules() {
        let own = module.memories.iter().map(|it| 8 * u64::from(it.depth) * limbs_for(it.width) as u64);
        let inner =
            module.instances.iter().map(|it| u64::from(it.shape.lanes()).saturating_mul(sizes[it.module.0 as usize]));
        sizes.push(own.chain(inner).fold(0, u64::saturating_add));
    }
    sizes.last().copied().unwrap_or(0)
}
