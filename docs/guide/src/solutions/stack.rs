//! Chapter 5: a stack.

use tilewright_hdl::*;

block! {
    /// A stack of bytes. A push onto a full one and a pop of an empty one do nothing; a push wins over a pop.
    pub struct ByteStack {
        /// How many bytes there is room for.
        pub depth: u32,
    }
    in ByteStackIn { push: bit(), data: bits(8), pop: bit() }
    out(self) ByteStackOut { newest: bits(8), used: up_to(self.depth) }
}

impl ByteStack {
    fn build(&self, m: Module, i: ByteStackIn) -> ByteStackOut {
        def!(bytes = m.memory(self.depth, 8, ReadUnderWrite::Any));
        def!(used = m.reg(up_to(self.depth)).reset(0));
        def!(pushes = i.push & used.ne(self.depth));
        bytes.write(pushes, used.low(), i.data);
        used.when(pushes, used + 1).when(i.pop & used.ne(0), used - 1);
        ByteStackOut { newest: bytes.read_async((used - 1).low()), used: *used }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn the_last_in_is_the_first_out() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&ByteStack { depth: 5 })?.seeded(1);
        let mut model = Vec::new();
        for clock in 0..500u64 {
            let (push, pop) = (clock * 7 % 5 > 1, clock * 11 % 17 > clock / 32);
            sim.drive(ByteStackIn { push: push.into(), data: clock % 251, pop: pop.into() });
            assert_eq!(sim.get(sim.o.used), model.len() as u64);
            model.last().into_iter().for_each(|newest| assert_eq!(sim.get(sim.o.newest), *newest));
            match (push && model.len() < 5, pop) {
                (true, _) => model.push(clock % 251),
                (false, true) => drop(model.pop()),
                (false, false) => {}
            }
            sim.step();
        }
        Ok(())
    }
}
