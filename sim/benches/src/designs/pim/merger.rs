//! Selects the nearer of two pixels, in four stages.

use tilewright_hdl::{Module, block, def, mux};

use super::{Pixel, pixel};

block! {
    /// Takes the pixels, compares the halves of their depths, decides, and selects. Of equally deep pixels it selects
    /// the right one.
    pub struct Merger;
    in MergerIn {
        left: Pixel = pixel(),
        right: Pixel = pixel(),
    }
    out MergerOut {
        nearer: Pixel = pixel(),
    }
}

impl Merger {
    fn build(&self, m: Module, i: MergerIn) -> MergerOut {
        let (left, right) = (m.pipe("left1", i.left), m.pipe("right1", i.right));
        let [left_high, right_high] = [left, right].map(|pixel| pixel.z.slice(12..24));
        let [left_low, right_low] = [left, right].map(|pixel| pixel.z.slice(0..12));
        def!(high_nearer = m.pipe(left_high.lt(right_high)));
        def!(high_equal = m.pipe(left_high.eq(right_high)));
        def!(low_nearer = m.pipe(left_low.lt(right_low)));

        let (left, right) = (m.pipe("left2", left), m.pipe("right2", right));
        let nearer = high_nearer | (high_equal & low_nearer);
        def!(take_left = m.pipe(left.valid & (!right.valid | nearer)));

        let (left, right) = (m.pipe("left3", left), m.pipe("right3", right));
        let chosen = mux(take_left, left, right);
        MergerOut { nearer: m.pipe("nearer", Pixel { valid: left.valid | right.valid, ..chosen }) }
    }
}
