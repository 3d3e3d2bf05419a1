//! Chapter 7: two stages of a pipeline that meet.

use tilewright_hdl::*;

bundle! { pub struct Pair<T> { pub left: T, pub right: T } }

block! {
    /// Compares numbers that entered at different times.
    pub struct Stages;
    in StagesIn { left: bits(8), right: bits(8) }
    out StagesOut { lesser: bits(8) }
}

impl Stages {
    fn build(&self, m: Module, i: StagesIn) -> StagesOut {
        let pair = m.stages(2, None, Pair { left: i.left, right: i.right }, |_, pair| pair);
        StagesOut { lesser: mux(i.right.lt(pair.left), i.right, pair.left) }
    }
}
