//! Units that walk down quadtrees of triangles, each on its own.
//!
//! It tests wide arithmetic, much of whose results is discarded, and control that differs from lane to lane.

mod unit;

use tilewright_hdl::{Module, Signal, bit, bits, block, constants, def, lit, mux};

use super::{BenchIn, BenchOut};
use crate::word::seed;
use unit::{Unit, UnitIn, UnitOut};

block! {
    /// Units that find the pixels of random triangles by quadtree, and a checksum of the pixels.
    pub struct Qt {
        /// The number of units, at least 1.
        pub units: u32,
        /// Whether each is a module of its own, so that nothing is replicated.
        pub apart: bool,
        /// A screen is `2^level` pixels wide, from 2.
        pub level: u32,
    }
    in = BenchIn { rst: bit() };
    out = BenchOut { csum: bits(32) };
}

block! {
    /// A unit whose seed is fixed.
    struct Seeded {
        number: u32,
        level: u32,
    }
    in = BenchIn { rst: bit() };
    out = UnitOut { hash: bits(32) };
}

impl Seeded {
    fn build(&self, m: Module, i: BenchIn) -> UnitOut {
        Unit { level: self.level }.build(m, UnitIn { rst: i.rst, seed: lit(32, seed(self.number)) })
    }
}

impl Qt {
    /// Units for a screen of 1024 x 1024 pixels.
    pub fn new(units: u32, apart: bool) -> Qt {
        Qt { units, apart, level: 10 }
    }

    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        let level = self.level;
        let hashes: Vec<Signal> = match self.apart {
            false => {
                let units = m.array("u_unit", self.units, &Unit { level }, |_| UnitIn {
                    rst: i.rst,
                    seed: constants(bits(32).of(self.units), seed),
                });
                units.hash.to_vec()
            }
            true => {
                let unit = |number| {
                    m.instance(&format!("u_unit{number}"), &Seeded { number, level }, BenchIn { rst: i.rst }).hash
                };
                (0..self.units).map(unit).collect()
            }
        };
        let folded = hashes.into_iter().reduce(|folded, hash| folded.rotate_left(1) ^ hash);
        def!(csum = m.reg(32));
        csum.next(mux(i.rst, 0, csum.rotate_left(3) + folded.expect("an array has a lane")));
        BenchOut { csum: *csum }
    }
}
