//! Units that walk down quadtrees of triangles, each on its own.
//!
//! What it asks of a simulator: wide arithmetic with much that is computed in vain, and control that differs from lane to lane.

mod unit;

use tilewright_hdl::ir::About;
use tilewright_hdl::{Block, Module, Signal, Width, bit, bits, constants, lit, mux};

use super::{BenchIn, BenchOut};
use crate::word::seed;
use unit::{Unit, UnitIn, UnitOut};

/// The units, and a checksum of what they find.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Qt {
    /// How many, at least 1.
    pub units: u32,
    /// Whether each is a module of its own, so that nothing is replicated.
    pub apart: bool,
}

/// A unit whose seed is fixed.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Seeded(u32);

impl Block for Seeded {
    type In = BenchIn;
    type Out = UnitOut;

    fn inputs(&self) -> BenchIn<Width> {
        BenchIn { rst: bit() }
    }

    fn build(&self, m: Module, i: BenchIn) -> UnitOut {
        Unit.build(m, UnitIn { rst: i.rst, seed: lit(32, seed(self.0)) })
    }

    fn name(&self) -> String {
        format!("qt_unit_{}", self.0)
    }
}

impl Block for Qt {
    type In = BenchIn;
    type Out = BenchOut;

    fn inputs(&self) -> BenchIn<Width> {
        BenchIn { rst: bit() }
    }

    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        let hashes: Vec<Signal> = match self.apart {
            false => {
                let units = m.array("u_unit", self.units, &Unit, |_| UnitIn {
                    rst: i.rst,
                    seed: constants(bits(32).of(self.units), seed),
                });
                units.hash.to_vec()
            }
            true => {
                let unit =
                    |number| m.instance(&format!("u_unit{number}"), &Seeded(number), BenchIn { rst: i.rst }).hash;
                (0..self.units).map(unit).collect()
            }
        };
        let folded = hashes.into_iter().reduce(|folded, hash| folded.rotate_left(1) ^ hash);
        let csum = m.reg("csum", 32);
        csum.next(mux(i.rst, 0, csum.rotate_left(3) + folded.expect("an array has a lane")));
        BenchOut { csum: csum.value() }
    }

    fn about(&self) -> About {
        About {
            summary: format!("{} units that find the pixels of random triangles by quadtree.", self.units),
            ..About::default()
        }
    }
}
