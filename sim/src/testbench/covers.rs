//! The counts of covers.

use tilewright_circuit::Loc;
use tilewright_hdl::Bundle;

use crate::engine::program::Cover;

use super::batch::Batch;
use super::error::UnknownName;
use super::running::Running;
use super::simulation::Simulation;

/// A cover of a running circuit, in one instance.
///
/// ```
/// use tilewright_hdl::*;
///
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(2) }
/// def!(count = m.reg(2).reset(0));
/// count.when(i.enable, count + 1);
/// m.cover("it is at 0", count.eq(0));
/// #     ShownOut { count: *count }
/// # };
/// let mut sim = tilewright_sim::Simulation::from_design(&design).unwrap();
/// sim.run(10);
/// let covered = &sim.covers()[0];
/// assert_eq!((&*covered.path, covered.count), ("it is at 0", 10));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Covered {
    /// Its name after the instance's path: `u_table.a page is taken`.
    pub path: String,
    /// The number of edges at which it was hit while the reset was not active, summed over its lanes.
    pub count: u64,
    /// The place in the description.
    pub loc: Loc,
}

impl Running {
    /// The covers of a run, in the sequence of declaration.
    pub fn covers(&mut self, run: u32) -> Vec<Covered> {
        let program = self.program.clone();
        let mut all = Vec::new();
        for (index, cover) in program.covers.iter().enumerate() {
            let counted = self.counted(index);
            for (lanes, lane) in counted.chunks(cover.group as usize).zip(0..) {
                let place = program.hierarchy.instance(&cover.scopes, lane);
                if program.hierarchy.run(place) == run {
                    let path = program.hierarchy.path_in(place, &cover.name);
                    all.push(Covered { path, count: lanes.iter().sum(), loc: cover.loc });
                }
            }
        }
        all
    }

    /// The count of the cover with this path in a run.
    pub fn covered(&mut self, path: &str, run: u32) -> Result<u64, UnknownName> {
        let all = self.covers(run);
        let found = all.iter().find(|cover| cover.path == path).map(|cover| cover.count);
        found.ok_or_else(|| UnknownName::new("cover", path, &all.into_iter().map(|it| it.path).collect::<Vec<_>>()))
    }

    /// The count of a cover in each lane, without the edges at which its reset was active.
    fn counted(&mut self, index: usize) -> Vec<u64> {
        let cover = &self.program.covers[index];
        let (value, clock) = (cover.counter, cover.clock as usize);
        let now = self.engine.read(value).to_vec();
        let until = if self.resets[clock] { self.before_reset[index].clone() } else { now };
        until.iter().zip(&self.in_reset[index]).map(|(counted, ignored)| counted.wrapping_sub(*ignored)).collect()
    }

    /// Notes that a clock's reset begins or ends: edges between do not count.
    pub fn cover_reset(&mut self, clock: usize, high: bool) {
        let program = self.program.clone();
        for (index, cover) in program.covers.iter().enumerate().filter(|(_, cover)| cover.clock as usize == clock) {
            let now = self.engine.read(cover.counter).to_vec();
            if high {
                self.before_reset[index] = now;
            } else {
                let before = std::mem::take(&mut self.before_reset[index]);
                let ignored = self.in_reset[index].iter_mut().zip(now.iter().zip(before));
                ignored.for_each(|(ignored, (now, before))| *ignored = ignored.wrapping_add(now.wrapping_sub(before)));
            }
        }
    }

    /// Sets all counts to zero.
    pub fn clear_covers(&mut self) {
        let lanes = |cover: &Cover| self.program.value(cover.counter).lanes as usize;
        self.in_reset = self.program.covers.iter().map(|cover| vec![0; lanes(cover)]).collect();
        self.before_reset = vec![Vec::new(); self.program.covers.len()];
    }
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// The number of edges at which the cover with this name was hit while the reset was not active:
    /// `sim.covered("u_table.a page is taken")`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// Counts from 0 to 9 repeatedly.
    ///     pub struct Digit;
    ///     in DigitIn { count: bit() }
    ///     out DigitOut { digit: below(10) }
    /// }
    ///
    /// impl Digit {
    ///     fn build(&self, m: Module, i: DigitIn) -> DigitOut {
    ///         def!(digit = m.reg(below(10)).reset(0));
    ///         def!(wraps = i.count & digit.eq(9));
    ///         digit.when(wraps, 0).when(i.count, digit + 1);
    ///         m.cover("all digits are counted", wraps);
    ///         m.cover("it is stable", m.stable(digit));
    ///         DigitOut { digit: *digit }
    ///     }
    /// }
    ///
    /// let mut sim = tilewright_sim::Simulation::of(&Digit)?;
    /// sim.set(sim.i.count, 1);
    /// sim.run(25);
    /// assert_eq!(sim.covered("all digits are counted")?, 2);
    /// assert_eq!(sim.uncovered(), ["it is stable"]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such cover; the error suggests the nearest name.
    pub fn covered(&mut self, path: &str) -> Result<u64, UnknownName> {
        self.circuit.covered(path, 0)
    }

    /// All covers, in the sequence of declaration, with their counts.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// assert!(sim.covers().is_empty()); // the block has none
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn covers(&mut self) -> Vec<Covered> {
        self.circuit.covers(0)
    }

    /// The covers that were never hit.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// assert!(sim.uncovered().is_empty()); // without covers, none is missing
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn uncovered(&mut self) -> Vec<String> {
        self.covers().into_iter().filter(|cover| cover.count == 0).map(|cover| cover.path).collect()
    }
}

impl<I: Bundle, O: Bundle> Batch<I, O> {
    /// The number of edges at which the cover with this name was hit in a run.
    ///
    /// ```
    /// use tilewright_hdl::*;
    ///
    /// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(2) }
    /// def!(count = m.reg(2).reset(0));
    /// count.when(i.enable, count + 1);
    /// m.cover("it is at 0", count.eq(0));
    /// #     ShownOut { count: *count }
    /// # };
    /// let mut batch = tilewright_sim::Batch::from_design(&design, 2).unwrap();
    /// batch.set(batch.port("enable").unwrap(), 1, 1);
    /// batch.run(8);
    /// assert_eq!([0, 1].map(|run| batch.covered("it is at 0", run).unwrap()), [8, 2]);
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such cover; the error suggests the nearest name.
    pub fn covered(&mut self, path: &str, run: u32) -> Result<u64, UnknownName> {
        self.ready().circuit.covered(path, run)
    }
}
