use tilewright_hdl::*;

block! {
    /// Counts from 0 to `limit - 1` and starts again.
    pub struct Counter { pub limit: u64 }
    in CounterIn { enable: bit() }
    out(self) CounterOut { count: below(self.limit) }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        def!(count = m.reg(below(self.limit)).reset(0));
        def!(at_end = count.eq(self.limit - 1));
        count.when(i.enable & at_end, 0).when(i.enable, count + i.enable);
        CounterOut { count: *count }
    }
}
