//! A systolic array that multiplies matrices, as a grid of lanes.
//!
//! What it asks of a simulator: as many multipliers as the grid has cells, all alike, each fed by its neighbours on two sides.

use tilewright_hdl::ir::About;
use tilewright_hdl::{Block, Module, Signal, Width, bit, bits, constants, grid, mux, row};

use super::{BenchIn, BenchOut};

/// `size` x `size` cells, and a checksum of all their sums.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Systolic {
    /// The side of the grid, at least 1.
    pub size: u32,
}

impl Block for Systolic {
    type In = BenchIn;
    type Out = BenchOut;

    fn inputs(&self) -> BenchIn<Width> {
        BenchIn { rst: bit() }
    }

    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        let cells = grid(self.size, self.size);
        // What enters a side: a row of generators that start at numbers of their own.
        let side = |name, seed: u64| -> Signal {
            let state = m.reg(name, bits(16).of(row(self.size)));
            let start = constants(bits(16).of(row(self.size)), |lane| (seed + 40_503 * u64::from(lane)) % 65_536);
            state.next(mux(i.rst, start, (*state << 5) + *state + 12_345));
            state.part(8, 8)
        };
        let x = m.reg("x", bits(8).of(cells));
        let y = m.reg("y", bits(8).of(cells));
        let sum = m.reg("sum", bits(16).of(cells));
        x.next(mux(i.rst, 0, x.columns().previous(side("left", 1))));
        y.next(mux(i.rst, 0, y.rows().previous(side("above", 7))));
        sum.next(mux(i.rst, 0, *sum + x * *y));
        let csum = m.reg("csum", 32);
        csum.next(mux(i.rst, 0, csum.rotate_left(3) + sum.xor_all().zext(32)));
        BenchOut { csum: csum.value() }
    }

    fn about(&self) -> About {
        let summary = format!("A systolic array of {0} x {0} cells, each a multiplier and an adder.", self.size);
        About { summary, ..About::default() }
    }
}
