//! Two clocks, and a memory between them.

use tilewright_hdl::{Block, Clock, Module, Period, ReadUnderWrite, Width, bit, bits, bundle};

pub const FAST: Clock = Clock::new("fast", Period::ps(2_000));
pub const SLOW: Clock = Clock::new("slow", Period::ps(3_000));

bundle! {
    pub struct StoreIn<T> { pub write: T, pub to: T, pub data: T, pub read: T, pub from: T }
    pub struct StoreOut<T> { pub word: T, pub at_once: T }
}

/// A memory written on one clock and read on another.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Store {
    pub policy: ReadUnderWrite,
}

impl Block for Store {
    type In = StoreIn;
    type Out = StoreOut;

    fn inputs(&self) -> StoreIn<Width> {
        let fast = |width| bits(width).on(FAST);
        StoreIn { write: bit().on(FAST), to: fast(2), data: fast(8), read: bit().on(SLOW), from: bits(2).on(SLOW) }
    }

    fn build(&self, m: Module, i: StoreIn) -> StoreOut {
        let store = m.memory("store", 4, 8, self.policy);
        store.on(FAST).write(i.write, i.to, i.data);
        let at_once = store.on(SLOW).read_async(i.from).quasi_static("the test knows both clocks");
        StoreOut { word: store.on(SLOW).read_when(i.read, i.from), at_once }
    }
}
