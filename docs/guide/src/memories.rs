//! Chapter 5: what a read gives whose word is written at the same edge.

use tilewright_hdl::*;

block! {
    /// Three memories that are written and read alike.
    pub struct Memories;
    in MemoriesIn {
        /// Writes `data`.
        write: bit(),
        /// Where it writes and reads.
        address: bits(2),
        /// What it writes.
        data: bits(8),
    }
    out MemoriesOut {
        /// Read at once.
        at_once: bits(8),
        /// Read at the edge, the old word where it is written.
        old: bits(8),
        /// Read at the edge, any word where it is written.
        any: bits(8),
    }
}

impl Memories {
    fn build(&self, m: Module, i: MemoriesIn) -> MemoriesOut {
        def!(first = m.memory(4, 8, ReadUnderWrite::Old).fill(0x11));
        def!(second = m.memory(4, 8, ReadUnderWrite::Any).fill(0x11));
        first.write(i.write, i.address, i.data);
        second.write(i.write, i.address, i.data);
        MemoriesOut { at_once: first.read_async(i.address), old: first.read(i.address), any: second.read(i.address) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn a_read_beside_a_write() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Memories)?;
        let wave = sim.record([sim.i.write, sim.i.address, sim.i.data, sim.o.at_once, sim.o.old, sim.o.any]);
        for (write, address, data) in [(0, 1, 0), (1, 1, 0x55), (0, 1, 0), (0, 2, 0), (0, 0, 0)] {
            sim.drive(MemoriesIn { write, address, data });
            sim.step();
        }
        wave.expect(
            r"
            clk     |____/~~\_/~~\_/~~\_/~~\_/
            write   |____/~~~~\_______________
            address | 1            | 2  | 0  |
            data    | 0  | 55 | 0            |
            at_once | 11      | 55 | 11      |
            old     | 0  | 11      | 55 | 11 |
            any     | 0  | 11 | ee | 55 | 11 |",
        );
        Ok(())
    }
}
