//! A square of one-bit processors under one instruction, fed by a tree that adds bit by bit.
//!
//! ```text
//!      sequencer ---- instruction, addresses ----.
//!          | bits of three coefficients          v
//!          +-----> axis x --- a row of bits --->[processors]--> bits, enabled
//!          '-----> axis y --- a column -------->[  n x n   ]
//! ```
//!
//! It tests one-bit logic, replicated thousands of times, and a memory of bits with one address for all.

mod axis;
mod pixel;

use tilewright_hdl::{Module, Signal, bit, bits, block, cat, def, grid, lit, mux, one_of, select};

use super::{BenchIn, BenchOut};
use crate::word::xorshift;
use axis::{Axis, AxisIn};
use pixel::{BITS, Operation, Pixel, PixelIn};

block! {
    /// A square of one-bit processors, fed by a serial tree.
    pub struct Pxpl {
        /// Processors in a row, and rows; a power of two from 8 to 256.
        pub edge: u32,
    }
    in = BenchIn { rst: bit() };
    out = BenchOut { csum: bits(32) };
}

/// The operations in sequence, for 32 clocks each.
const PROGRAM: [Operation; 8] = [
    Operation::Store,
    Operation::Add,
    Operation::Compare,
    Operation::KeepLess,
    Operation::Store,
    Operation::Copy,
    Operation::KeepPositive,
    Operation::Everybody,
];

impl Pxpl {
    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        let (edge, rst) = (self.edge, i.rst);
        def!(random = m.reg(32));
        random.when(rst, 0x0123_4567).otherwise(xorshift(*random));
        let [clock, step, base] = [("clock", 5), ("step", 3), ("base", 8)].map(|(name, width)| m.reg(name, width));
        def!(is_last = clock.eq(31));
        clock.when(rst, 0).otherwise(clock + 1);
        step.when(rst, 0).when(is_last, step + 1);
        base.when(rst, 0).when(is_last, random.slice(8..16));

        // Operations that set flags work on the last bit only.
        let operation = |operation: Operation| match operation {
            Operation::KeepLess | Operation::KeepPositive => mux(is_last, operation, Operation::Nothing),
            other => mux(lit(1, 1), other, Operation::Nothing),
        };
        let steps = (1..).zip(&PROGRAM[1..]).map(|(number, &it)| (step.eq(number), operation(it)));
        def!(next = select(steps, operation(PROGRAM[0])));
        let within = |address: Signal| mux(address.ge(BITS), address - BITS, address);
        let read = base + clock.zext(8);
        let held = |name: &str, value: Signal| {
            let reg = m.reg(name, value.width());
            reg.when(rst, 0).otherwise(value);
            *reg
        };
        let now = m.reg("operation", one_of::<Operation>());
        now.when(rst, Operation::Nothing).otherwise(next);
        let (read, write) = (held("read", within(read)), held("write", within(read + 37)));
        let [a, b, c] = [("a", 3), ("b", 7), ("c", 23)].map(|(name, at)| held(name, random.bit(at)));
        let first = held("first", clock.eq(0));

        let axis = |name: &str, coefficient, base| {
            m.instance(name, &Axis { edge }, AxisIn { rst, first, base, coefficient }).values
        };
        let (x, y) = (axis("u_x", a, c), axis("u_y", b, lit(1, 0)));
        let pixels = m.array("u_pixel", grid(edge, edge), &Pixel, |_| PixelIn {
            rst,
            first,
            operation: *now,
            read,
            write,
            x: x.to_rows(edge),
            y: y.to_columns(edge),
        });

        // The first and the last 32 bits, and whether an odd number of processors is enabled.
        let ends = 32_u32.div_ceil(edge);
        let row = |number: u32| pixels.result.rows().lane(number).pack();
        let side_by_side = |rows: Vec<Signal>| tilewright_hdl::concat(&rows);
        let low = side_by_side((0..ends).rev().map(row).collect()).trunc(32);
        let high = side_by_side((edge - ends..edge).rev().map(row).collect());
        let high = high.slice(high.width() - 32..high.width());
        let odd = pixels.enable.columns().xor_all().xor_all();
        def!(csum = m.reg(32));
        csum.when(rst, 0).otherwise(csum.rotate_left(1) + (low ^ high) + cat![lit(31, 0), odd]);
        BenchOut { csum: *csum }
    }
}
