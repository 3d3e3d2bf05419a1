//! The windows of a quadtree, one after another: a window comes before its quarters, and they before its neighbour.
//!
//! The number of a pixel has the bits of its column and of its line in turn. So the pixels of a window have numbers in
//! sequence, and its neighbour has the number behind them. A counter and a size are all that there is to store.

use tilewright_hdl::{Module, Signal, bit, bits, block, concat, def, lit, up_to};

block! {
    /// Visits the windows of a quadtree: the quarters of those that pass, and none of the others.
    pub struct Walk {
        /// The binary logarithm of the root's side.
        pub levels: u32,
    }
    ranges { levels: 1..=15 }
    in WalkIn {
        /// The window passes; while one is visited.
        passes: bit(),
        /// The window fails; while one is visited.
        fails: bit(),
    }
    out(self) WalkOut {
        /// A window is visited. No clock passes on the way to its first quarter. On the way to a neighbour one passes,
        /// and one more for each level upwards.
        visits: bit(),
        /// The window is a pixel.
        is_leaf: bit(),
        /// The window's leftmost column.
        left: bits(self.levels),
        /// The window's upper line.
        top: bits(self.levels),
        /// The window's rightmost column.
        right: bits(self.levels),
        /// The window's lower line.
        bottom: bits(self.levels),
        /// The last window has been visited. The root follows.
        ends: bit(),
    }
}

impl Walk {
    fn build(&self, m: Module, i: WalkIn) -> WalkOut {
        let levels = self.levels;
        def!(at = m.reg(2 * levels).reset(0));
        def!(size = m.reg(up_to(levels)).reset(levels));
        def!(climbs = m.reg(bit()).reset(0));

        // The numbers of a window's pixels differ in these bits.
        let every_second = |first: u32| -> Signal {
            let bits: Vec<Signal> = (0..levels).rev().map(|level| at.bit(2 * level + first)).collect();
            concat(&bits)
        };
        let inner: Vec<Signal> = (0..levels).rev().map(|level| size.gt(level)).collect();
        def!(inner = concat(&inner));
        def!(left = every_second(0));
        def!(top = every_second(1));

        def!(is_leaf = size.eq(0));
        def!(leaves = i.fails | (i.passes & is_leaf));
        // The root has no neighbour: the sum is 0 then.
        let pixels: Vec<Signal> = (0..levels).rev().flat_map(|level| [lit(1, 0), size.eq(level)]).collect();
        def!(pixels = concat(&pixels));
        def!(
            is_first = !(0..levels)
                .fold(lit(1, 0), |any, level| { any | (size.eq(level) & (at.bit(2 * level) | at.bit(2 * level + 1))) })
        );
        def!(is_root = size.eq(levels));
        def!(ends = climbs & is_root);
        at.when(leaves, at + pixels);
        // A number that has become that of a first quarter is behind its parent.
        climbs.when(leaves, 1).when(climbs & (is_root | !is_first), 0);
        size.when(i.passes & !is_leaf, size - 1).when(climbs & is_first & !is_root, size + 1);
        m.assume(climbs.implies(!i.passes & !i.fails), "a window passes or fails while it is visited");
        WalkOut { visits: !climbs, is_leaf, left, top, right: left | inner, bottom: top | inner, ends }
    }
}
