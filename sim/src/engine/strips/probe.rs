//! Runs a strip program in memory of its own, in which each number is the greatest one that its place may have: so
//! indices are as large as they get.

use std::collections::BTreeSet;

use super::bounds::{Access, Base, Bounds, Extent};
use super::evaluate::{Memory, Wild};
use super::program::Program;
use super::value::{Bytes, Value};

/// Where the state, and the first one of what its addresses lead to, begin: no address of this process is so small, and
/// nothing is larger than the distances.
const STATE: u64 = 1 << 40;
const SCRATCH: u64 = 2 << 40;
const STORED: u64 = 3 << 40;

impl Program {
    /// Runs it for one edge, with nothing but the allocations that `bounds` names, each apart from the others.
    ///
    /// # Errors
    /// It accesses what is in none of them.
    pub fn probe(&self, bounds: &Bounds, has_units: bool) -> Result<u64, Wild> {
        self.probe_watched(bounds, has_units, &mut |_, _| {})
    }

    /// Whether each value in such a run is what is known of it. Memories side by side cannot all have their greatest
    /// numbers: with them nothing is run, and the result is `false`.
    ///
    /// # Errors
    /// A value is something else, or the program leaves its memory.
    pub fn probe_facts(&self, bounds: &Bounds, has_units: bool) -> Result<bool, String> {
        if overlap(bounds) {
            return Ok(false);
        }
        let mut other = None;
        let run = self.probe_watched(bounds, has_units, &mut |value, bytes| {
            if other.is_none() {
                other = bounds.refute(self, value, bytes, |base| Some(address(base)));
            }
        });
        match (run, other) {
            (_, Some(other)) => Err(other),
            (Err(Wild(at)), None) => Err(format!("it accesses {at:#x}")),
            (Ok(_), None) => Ok(true),
        }
    }

    fn probe_watched(
        &self,
        bounds: &Bounds,
        has_units: bool,
        watch: &mut impl FnMut(Value, &Bytes),
    ) -> Result<u64, Wild> {
        let mut extents: Vec<(Base, Extent)> = Vec::new();
        for access in &bounds.accesses {
            // The unit is the first one.
            let base = if access.base == Base::Unit { Base::State } else { access.base };
            if !extents.contains(&(base, access.extent)) {
                extents.push((base, access.extent));
            }
        }
        let mut filled: Vec<(u64, Vec<u8>)> = extents
            .iter()
            .map(|(base, extent)| (address(*base).wrapping_add_signed(extent.start), filled(*extent)))
            .collect();
        for (base, _) in &extents {
            let Base::Stored(at) = *base else { continue };
            let place = STATE.wrapping_add_signed(at);
            let holds = |(first, bytes): &&mut (u64, Vec<u8>)| (*first..*first + bytes.len() as u64).contains(&place);
            if let Some((first, bytes)) = filled.iter_mut().find(holds) {
                let offset = (place - *first) as usize;
                bytes[offset..offset + 8].copy_from_slice(&address(*base).to_le_bytes());
            }
        }
        let mut memories: Vec<Memory> =
            filled.iter_mut().map(|(address, bytes)| Memory { address: *address, bytes }).collect();
        let argument = if has_units { 0 } else { 1 };
        let called = &mut |_: u64, _: &[u64]| 1;
        self.evaluate_watched([STATE, argument, SCRATCH], memories.as_mut_slice(), called, watch)
    }
}

/// Whether two allocations have bytes in common.
fn overlap(bounds: &Bounds) -> bool {
    let range = |access: &Access| {
        let Extent { start, end, integer, most, .. } = access.extent;
        let [first, last] = [start, end].map(|at| address(access.base).wrapping_add_signed(at));
        (first, last, integer, most)
    };
    let ranges: BTreeSet<_> = bounds.accesses.iter().map(range).collect();
    ranges.iter().zip(ranges.iter().skip(1)).any(|((_, last, ..), (first, ..))| last > first)
}

/// Where a base is.
fn address(base: Base) -> u64 {
    match base {
        Base::State | Base::Unit => STATE,
        Base::Scratch => SCRATCH,
        Base::Known(address) => address as u64,
        Base::Stored(at) => STORED + ((at as u64) << 32),
    }
}

/// An allocation full of its greatest number.
fn filled(extent: Extent) -> Vec<u8> {
    let size = extent.integer.max(8) as usize / 8;
    let number = if extent.integer == 0 { u64::MAX } else { extent.most };
    number.to_le_bytes()[..size].iter().copied().cycle().take((extent.end - extent.start) as usize).collect()
}
