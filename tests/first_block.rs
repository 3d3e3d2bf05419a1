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
        count.when(i.enable & count.eq(self.limit - 1), 0).when(i.enable, count + 1);
        CounterOut { count: *count }
    }
}

#[test]
fn it_starts_again() {
    let mut sim = tilewright_sim::Simulation::of(&Counter { limit: 3 }).unwrap();
    for (enable, count) in [(1, 0), (1, 1), (0, 2), (1, 2), (1, 0)] {
        sim.drive(CounterIn { enable });
        assert_eq!(sim.get(sim.o.count), count);
        sim.step();
    }
}
