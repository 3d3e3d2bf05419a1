//! The product of two matrices in a systolic array: a grid of cells, through which one matrix moves to the right and the other down.
//! `cargo run -p tilewright-hdl --example systolic`

use tilewright_hdl::*;
use tilewright_sim::Simulation;

block! {
    /// `size` x `size` cells. Row `i` of the left matrix enters row `i` of the grid, `i` clocks late; column `j` of the other one enters
    /// column `j`, `j` clocks late.
    struct Systolic {
        size: u32,
    }
    in(self) SystolicIn { clear: bit(), left: bits(8).of(row(self.size)), above: bits(8).of(row(self.size)) }
    out(self) SystolicOut { product: bits(16).of(grid(self.size, self.size)) }
}

impl Systolic {
    fn build(&self, m: Module, i: SystolicIn) -> SystolicOut {
        let cells = grid(self.size, self.size);
        def!(x = m.reg(bits(8).of(cells)));
        def!(y = m.reg(bits(8).of(cells)));
        def!(sum = m.reg(bits(16).of(cells)));
        x.next(x.columns().previous(i.left));
        y.next(y.rows().previous(i.above));
        sum.when(i.clear, 0).otherwise(*sum + x * *y);
        SystolicOut { product: *sum }
    }
}

/// Runs it; a test does so too.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    const N: usize = 4;
    let (a, b) = (
        [[1, 2, 3, 4], [5, 6, 7, 8], [9, 8, 7, 6], [5, 4, 3, 2]],
        [[2, 0, 1, 3], [1, 1, 0, 2], [0, 3, 2, 1], [4, 1, 1, 0]],
    );
    let array = Systolic { size: N as u32 };
    let mut sim = Simulation::of(&array)?;
    let ports = (sim.i, sim.o);
    for clock in 0..3 * N {
        // The element that enters row or column `lane` now; none before it begins and after it ends.
        let turn = |lane: usize| clock.checked_sub(lane).filter(|k| *k < N);
        sim.set(ports.0.clear, clock == 0);
        sim.set_lanes(ports.0.left, (0..N).map(|row| turn(row).map_or(0u64, |k| a[row][k])));
        sim.set_lanes(ports.0.above, (0..N).map(|column| turn(column).map_or(0u64, |k| b[k][column])));
        sim.step();
    }
    let product: Vec<u64> = sim.lanes(ports.1.product);
    for (i, j) in (0..N * N).map(|cell| (cell / N, cell % N)) {
        assert_eq!(product[N * i + j], (0..N).map(|k| a[i][k] * b[k][j]).sum());
    }
    println!("{product:?}");
    print!("{}", tilewright_gen::verilog(&elaborate(&array)?)[0].text);
    Ok(())
}
