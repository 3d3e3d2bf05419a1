//! A systolic array that multiplies matrices, as a grid of lanes.
//!
//! It tests as many multipliers as the grid has cells, all alike, each fed by its neighbours on two sides.

use tilewright_hdl::{Module, Signal, bit, bits, block, constants, def, grid, mux, row};

use super::{BenchIn, BenchOut};

block! {
    /// A systolic array of cells, each a multiplier and an adder, and a checksum of all their sums.
    pub struct Systolic {
        /// The side of the grid, at least 1.
        pub size: u32,
    }
    in = BenchIn { rst: bit() };
    out = BenchOut { csum: bits(32) };
}

impl Systolic {
    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        let cells = grid(self.size, self.size);
        // The inputs of a side: a row of generators with different starts.
        let side = |name, seed: u64| -> Signal {
            let state = m.reg(name, bits(16).of(row(self.size)));
            let start = constants(bits(16).of(row(self.size)), |lane| (seed + 40_503 * u64::from(lane)) % 65_536);
            state.next(mux(i.rst, start, (*state << 5) + *state + 12_345));
            state.part(8, 8)
        };
        def!(x = m.reg(bits(8).of(cells)));
        def!(y = m.reg(bits(8).of(cells)));
        def!(sum = m.reg(bits(16).of(cells)));
        x.next(mux(i.rst, 0, x.columns().previous(side("left", 1))));
        y.next(mux(i.rst, 0, y.rows().previous(side("above", 7))));
        sum.next(mux(i.rst, 0, *sum + x * *y));
        def!(csum = m.reg(32));
        csum.next(mux(i.rst, 0, csum.rotate_left(3) + sum.xor_all().zext(32)));
        BenchOut { csum: *csum }
    }
}
