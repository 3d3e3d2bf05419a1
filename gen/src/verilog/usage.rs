//! The bits that the text reads; all others are tied into `_unused_ok`, so that no linter warns.

use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::NodeId;

/// The reads so far.
#[derive(Clone)]
pub struct Usage {
    /// The bits, by node.
    bits: Vec<Vec<u64>>,
    /// The lanes of a value that are read whole, if not all lanes are read alike.
    lanes: BTreeMap<NodeId, Vec<bool>>,
    /// Clock and reset ports.
    pub clocks: BTreeSet<String>,
    /// Memories with a word that is read.
    pub memories: BTreeSet<String>,
}

impl Usage {
    /// Nothing is read yet.
    pub fn new(nodes: usize) -> Usage {
        let (lanes, clocks, memories) = (BTreeMap::new(), BTreeSet::new(), BTreeSet::new());
        Usage { bits: vec![Vec::new(); nodes], lanes, clocks, memories }
    }

    /// Records that bits `low .. low + width` of the node are read.
    pub fn mark(&mut self, id: NodeId, low: u32, width: u32) {
        let limbs = &mut self.bits[id.0 as usize];
        limbs.resize(limbs.len().max((low + width).div_ceil(64) as usize), 0);
        for bit in low..low + width {
            limbs[bit as usize / 64] |= 1 << (bit % 64);
        }
    }

    /// Records that these of a node's `count` lanes are read whole.
    pub fn mark_lanes(&mut self, id: NodeId, count: u32, lanes: &[u32]) {
        let read = self.lanes.entry(id).or_insert_with(|| vec![false; count as usize]);
        lanes.iter().for_each(|&lane| read[lane as usize] = true);
    }

    /// The unread ranges, as lowest bit and width, highest first.
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
