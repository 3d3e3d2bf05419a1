//! What the text reads; the rest is tied into `_unused_ok`, so that no linter warns.

use std::collections::{BTreeMap, BTreeSet};
use tilewright_hdl::ir::NodeId;

/// What was read so far.
#[derive(Clone)]
pub struct Usage {
    /// The bits, by node.
    bits: Vec<Vec<u64>>,
    /// Which lanes of a value something reads whole, where not all are read alike.
    lanes: BTreeMap<NodeId, Vec<bool>>,
    /// Clock and reset ports.
    pub clocks: BTreeSet<String>,
    /// Memories of which something reads a word.
    pub memories: BTreeSet<String>,
}

impl Usage {
    /// Nothing is read yet.
    pub fn new(nodes: usize) -> Usage {
        let (lanes, clocks, memories) = (BTreeMap::new(), BTreeSet::new(), BTreeSet::new());
        Usage { bits: vec![Vec::new(); nodes], lanes, clocks, memories }
    }

    /// Bits `low .. low + width` of the node are read.
    pub fn mark(&mut self, id: NodeId, low: u32, width: u32) {
        let limbs = &mut self.bits[id.0 as usize];
        limbs.resize(limbs.len().max((low + width).div_ceil(64) as usize), 0);
        for bit in low..low + width {
            limbs[bit as usize / 64] |= 1 << (bit % 64);
        }
    }

    /// These of a node's so many lanes are read whole.
    pub fn mark_lanes(&mut self, id: NodeId, count: u32, lanes: &[u32]) {
        let read = self.lanes.entry(id).or_insert_with(|| vec![false; count as usize]);
        lanes.iter().for_each(|&lane| read[lane as usize] = true);
    }

    /// The ranges that nothing reads, as lowest bit and width, highest first.
    pub fn unread(&self, id: NodeId, width: u32) -> Vec<(u32, u32)> {
        if self.lanes.get(&id).is_some_and(|lanes| lanes.iter().all(|&read| read)) {
            return Vec::new();
        }
        let limbs = &self.bits[id.0 as usize];
        let read = |bit: u32| limbs.get(bit as usize / 64).is_some_and(|limb| limb >> (bit % 64) & 1 == 1);
        let mut ranges: Vec<(u32, u32)> = Vec::new();
        for bit in (0..width).filter(|&bit| !read(bit)) {
            match ranges.last_mut() {
                Some((low, width)) if *low + *width == bit => *width += 1,
                _ => ranges.push((bit, 1)),
            }
        }
        ranges.reverse();
        ranges
    }
}
