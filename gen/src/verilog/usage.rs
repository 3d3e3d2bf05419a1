//! Which bits of each net the text reads; the rest is tied into `_unused_ok`, so that no linter warns.

use tilewright_hdl::ir::NodeId;

/// The bits read so far, by node.
pub struct Usage(Vec<Vec<u64>>);

impl Usage {
    /// Nothing is read yet.
    pub fn new(nodes: usize) -> Usage {
        Usage(vec![Vec::new(); nodes])
    }

    /// Bits `low .. low + width` of the node are read.
    pub fn mark(&mut self, id: NodeId, low: u32, width: u32) {
        let limbs = &mut self.0[id.0 as usize];
        limbs.resize(limbs.len().max((low + width).div_ceil(64) as usize), 0);
        for bit in low..low + width {
            limbs[bit as usize / 64] |= 1 << (bit % 64);
        }
    }

    /// The ranges that nothing reads, as lowest bit and width, highest first.
    pub fn unread(&self, id: NodeId, width: u32) -> Vec<(u32, u32)> {
        let limbs = &self.0[id.0 as usize];
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
