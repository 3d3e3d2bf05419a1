//! Chapter 10: a count of bytes that nothing guards.

use tilewright_hdl::*;

block! {
    /// Counts bytes in a queue of four.
    pub struct Unguarded;
    in UnguardedIn { push: bit(), pop: bit() }
    out UnguardedOut { used: up_to(4) }
}

impl Unguarded {
    fn build(&self, m: Module, i: UnguardedIn) -> UnguardedOut {
        def!(used = m.reg(up_to(4)).reset(0));
        used.when(i.push & !i.pop & used.ne(4), used + 1).when(i.pop & !i.push, used - 1);
        m.assert(used.le(4), "there are four at most");
        UnguardedOut { used: *used }
    }
}
