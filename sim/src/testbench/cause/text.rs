//! The tree of causes as indented text.

use std::collections::BTreeSet;
use std::fmt;

use tilewright_circuit::Bits;

use super::{Cause, End, mask};
use crate::testbench::trace::WaveRadix;
use crate::testbench::trace::radix;

/// A part of the tree by its name, its bits and its cycle.
type Told = (String, u64);

impl Cause {
    /// The name, with the bits that count if these are not all.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// // Of the count, the lower 4 bits are an address.
    /// assert_eq!(sim.why("square")?.causes[1].label(), "count[3:0]");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn label(&self) -> String {
        match mask::run(&self.bits) {
            Some((0, high)) if high + 1 == self.bits.width() => self.name.clone(),
            Some((low, high)) if low == high => format!("{}[{low}]", self.name),
            Some((low, high)) => format!("{}[{high}:{low}]", self.name),
            None => self.name.clone(),
        }
    }

    /// The value of the bits that count: codes by their names, numbers in decimal.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(20);
    /// let cause = &sim.why("square")?.causes[1];
    /// assert_eq!((cause.label().as_str(), cause.number().as_str()), ("count[3:0]", "4"));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn number(&self) -> String {
        match mask::run(&self.bits) {
            Some((low, high)) if high + 1 - low < self.bits.width() => decimal(&self.value.slice(low..high + 1)),
            _ if self.value.width() > 128 => format!("{:?}", self.value),
            _ => radix::text(&self.value, self.meaning, Some(WaveRadix::Decimal)),
        }
    }

    fn write(&self, f: &mut fmt::Formatter, depth: usize, told: &mut BTreeSet<Told>) -> fmt::Result {
        let (label, number, cycle) = (self.label(), self.number(), self.cycle);
        let role = match (depth, self.chooses) {
            (0, _) => "",
            (_, true) => "when ",
            (_, false) => "from ",
        };
        write!(f, "{:1$}{role}{label} = {number}  cycle {cycle}", "", 2 * depth)?;
        if let Some(clock) = &self.clock {
            write!(f, " of {clock}")?;
        }
        if let Some(loc) = &self.loc {
            write!(f, "  {}:{}", loc.file(), loc.line())?;
        }
        let here = (label, cycle);
        match self.end {
            Some(End::Elsewhere) if told.contains(&here) => f.write_str("  see above")?,
            Some(End::Elsewhere) => f.write_str("  see below")?,
            Some(end) => write!(f, "  {end}")?,
            None => {}
        }
        if self.end != Some(End::Elsewhere) {
            told.insert(here);
        }
        f.write_str("\n")?;
        self.causes.iter().try_for_each(|cause| cause.write(f, depth + 1, told))
    }
}

fn decimal(value: &Bits) -> String {
    value.to_u128().map_or_else(|| format!("{value:?}"), |number| number.to_string())
}

impl fmt::Display for Cause {
    /// A line for each cause, and at the end what ended the search before its limits or the start.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.write(f, 0, &mut BTreeSet::new())?;
        self.notes().iter().try_for_each(|note| writeln!(f, "{note}"))
    }
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            End::Input => "input",
            End::Start => "from the start",
            End::Reset => "by reset",
            End::Testbench => "set by the testbench",
            End::Constant => "constant",
            End::Unremembered => "not remembered further",
            End::Cut => "not followed further",
            End::Elsewhere => "see there",
        })
    }
}
