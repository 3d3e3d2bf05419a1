//! Flags of lanes, and whether any lane has one.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::{times, work};
use crate::engine::function::Function;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::plan::{Plan, Stage};
use crate::engine::program::{Kind, ValueId};

/// A loop of more strip operations combines no flags: it could then have no versions.
const MOST: usize = 4095;

/// Flags of lanes that earlier loops compute, or that are in registers.
pub(super) struct Flags {
    /// The stage of each.
    stages: FxHashMap<ValueId, usize>,
    /// Whether any lane has it, if that is asked for.
    pub any: BTreeMap<ValueId, ValueId>,
}

impl Flags {
    /// Those of these stages.
    pub fn of(function: &Function, before: &[Stage], strips: &StripSizes) -> Flags {
        // Lanes beside an array may have anything.
        let is_whole = |lanes: u32| lanes > 1 && lanes.is_multiple_of(strips.strip(lanes));
        let flags = function.circuit().cells().filter(|(_, cell)| cell.width == 1 && is_whole(cell.lanes));
        let states = flags.filter(|(_, cell)| cell.kind == Kind::State).map(|(id, _)| (id, 0));
        let mut stages: FxHashMap<ValueId, usize> = states.collect();
        for (number, stage) in before.iter().enumerate() {
            let small = stage.kernels.iter().filter(|(lanes, kernel)| work(kernel, times(**lanes, strips)) <= MOST);
            for (&lanes, kernel) in small.filter(|(lanes, _)| is_whole(**lanes)) {
                let is_flag = |id: &&ValueId| {
                    let cell = function.cell(**id);
                    cell.width == 1 && cell.lanes == lanes
                };
                stages.extend(kernel.cells.iter().filter(is_flag).map(|id| (*id, number)));
            }
        }
        Flags { stages, any: BTreeMap::new() }
    }

    /// Whether that value is one.
    pub fn has(&self, value: ValueId) -> bool {
        self.stages.contains_key(&value)
    }

    /// Adds what is asked for to the loops that compute the flags.
    pub fn place(self, function: &Function, plan: &mut Plan, before: &mut [Stage]) {
        for (flag, any) in self.any {
            let kernels = &mut before[self.stages[&flag]].kernels;
            kernels.entry(function.cell(flag).lanes).or_default().cells.push(any);
            plan.live_out.insert(any);
        }
    }
}
