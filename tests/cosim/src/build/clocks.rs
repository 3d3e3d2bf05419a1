//! The clocks of random designs, and the names that parts and steps have for them.

use super::{Builder, PartBlock};
use crate::features::Feature;
use crate::spec::*;
use tilewright_hdl::*;

/// What parts call their own clock and the second one.
const OF_PARTS: [&str; 2] = ["line", "video"];

/// What steps call them.
const OF_STEPS: [&str; 2] = ["field", "panel"];

/// The ports that these names would have.
pub fn ports() -> impl Iterator<Item = String> {
    let names = OF_PARTS.into_iter().chain(OF_STEPS).chain(["second"]);
    let named = names.flat_map(|name| ["clk", "rst", "rst_n"].map(|port| format!("{name}_{port}")));
    named.chain(["clk", "rst", "rst_n"].map(str::to_owned))
}

impl PartBlock {
    /// The design's second clock.
    pub fn second(&self) -> Option<Clock> {
        let ([_, reset], [_, edge]) = (self.spec.stimulus.resets(), self.spec.stimulus.edges());
        self.spec.second_period.map(|period| Clock { edge, ..Clock::new("second", Period::ps(period)).reset(reset) })
    }

    /// The clock's place in the bundles.
    pub fn domain(&self, clock: ClockPick) -> usize {
        usize::from(clock == ClockPick::Second && self.spec.second_period.is_some())
    }

    /// The clock of that place, as the part names it; `None` for the module's own.
    pub fn clock(&self, domain: usize) -> Option<Clock> {
        let named = self.names_clocks().then(|| self.stand_in(domain, OF_PARTS)).flatten();
        named.or_else(|| self.second().filter(|_| domain == 1))
    }

    /// Whether it has names of its own for its clocks.
    pub fn names_clocks(&self) -> bool {
        self.part().names_clocks && !self.is_top()
    }

    /// A clock in whose place the one of that place may run. A part's own clock is any of the design's, so there is
    /// none for it if those differ.
    pub fn stand_in(&self, domain: usize, names: [&'static str; 2]) -> Option<Clock> {
        let ([reset, _], [edge, _]) = (self.spec.stimulus.resets(), self.spec.stimulus.edges());
        let own = Clock { edge, ..Clock::new(names[0], DEFAULT_PERIOD).reset(reset) };
        match (domain, self.second()) {
            (0, second) => {
                let is_clear = second.is_none_or(|it| Clock { name: own.name, ..it } == own);
                is_clear.then_some(own)
            }
            (_, second) => second.map(|it| Clock { name: names[1], ..it }),
        }
    }
}

impl Builder<'_> {
    /// The module seen from a clock.
    pub fn on(&self, domain: usize) -> Module {
        self.clock(domain).map_or(self.module, |clock| self.module.on(clock))
    }

    /// The clock of that place, as the step or the part names it; `None` for the module's own.
    pub fn clock(&self, domain: usize) -> Option<Clock> {
        let renamed = self.renamed.filter(|(of, _)| *of == domain).map(|(_, clock)| clock);
        renamed.or_else(|| self.block.clock(domain))
    }

    /// A step on its clock, which may be enabled.
    pub fn step(&mut self, number: usize, step: &Step) {
        let d = self.block.domain(step.clock);
        let Some(enable) = step.enabled else { return self.make_renamed(d, number, step) };
        Feature::Enabled.used();
        let enable = self.pick_fit(d, enable, 1);
        self.on(d).enabled(enable, || self.make_renamed(d, number, step));
    }

    /// The step, which may name another clock than its own.
    fn make_renamed(&mut self, d: usize, number: usize, step: &Step) {
        let stand_in = self.block.stand_in(d, OF_STEPS).filter(|_| step.renamed);
        let Some(stand_in) = stand_in else { return self.make(d, number, step) };
        Feature::Renamed.used();
        self.on(d).in_place_of(stand_in, || {
            self.renamed = Some((d, stand_in));
            self.make(d, number, step);
            self.renamed = None;
        });
    }
}
