//! Chapter 8: the game of life.

use tilewright_hdl::*;

block! {
    /// Cells that live by Conway's rules, a generation a clock.
    pub struct Life {
        /// How many there are along each edge.
        pub edge: u32,
    }
    in(self) LifeIn { load: bit(), cells: bit().of(grid(self.edge, self.edge)) }
    out(self) LifeOut { alive_now: bit().of(grid(self.edge, self.edge)) }
}

impl Life {
    fn build(&self, m: Module, i: LifeIn) -> LifeOut {
        let cells = grid(self.edge, self.edge);
        def!(alive = m.reg(bit().of(cells)).reset(0));
        let one = alive.zext(4);
        let column = one + one.rows().previous(0) + one.rows().following(0);
        def!(square = column + column.columns().previous(0) + column.columns().following(0));
        alive.when(i.load, i.cells).otherwise(square.eq(3) | alive & square.eq(4));
        LifeOut { alive_now: *alive }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn a_glider_moves_by_a_cell_in_four_generations() -> Result<(), tilewright_sim::Error> {
        const GLIDER: [(usize, usize); 5] = [(0, 1), (1, 2), (2, 0), (2, 1), (2, 2)];
        let glider = |by: usize| {
            let mut cells = [0u64; 64];
            GLIDER.iter().for_each(|(row, column)| cells[(row + by) * 8 + column + by] = 1);
            cells
        };
        let mut sim = Simulation::of(&Life { edge: 8 })?;
        sim.set(sim.i.load, 1);
        sim.set_lanes(sim.i.cells, glider(1));
        sim.step();
        sim.set(sim.i.load, 0);
        sim.run(4);
        assert_eq!(sim.lanes(sim.o.alive_now), glider(2));
        Ok(())
    }
}
