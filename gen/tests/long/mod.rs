//! Blocks of one very long chain, choice or concatenation each.

use tilewright_hdl::*;

/// The repeated part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A register that takes a value under each of the conditions.
    Whens,
    /// The same, with some arms that are choices themselves, and some that keep the value.
    MixedWhens,
    /// A `select` with this number of arms.
    Select,
    /// Multiplexers, each in the other one's `else`.
    Muxes,
    /// Multiplexers, each in the other one's `then`.
    DeepMuxes,
    /// A `case` with this number of arms.
    Case,
    /// A concatenation of this number of parts.
    Concat,
    /// A chain of nested operators.
    Or,
    Xor,
    Add,
    Compare,
}

pub const KINDS: [Kind; 11] = [
    Kind::Whens,
    Kind::MixedWhens,
    Kind::Select,
    Kind::Muxes,
    Kind::DeepMuxes,
    Kind::Case,
    Kind::Concat,
    Kind::Or,
    Kind::Xor,
    Kind::Add,
    Kind::Compare,
];

block! {
    /// `count` of them.
    pub struct Long { pub kind: Kind, pub count: u32 }
    in(self) LongIn { bits: bits(self.count), x: bits(20) }
    out LongOut { y: _ }
}

impl Long {
    fn build(&self, m: Module, i: LongIn) -> LongOut {
        let bit = |k: u32| i.bits.bit(k);
        let byte = |k: u32| i.x.trunc(8) ^ (k % 251);
        let count = self.count;
        let y = match self.kind {
            Kind::Whens | Kind::MixedWhens => {
                let held = m.reg("held", 8).reset(0);
                let value = |k: u32| match (self.kind, k % 3) {
                    (Kind::MixedWhens, 0) => mux(i.x.bit(9), byte(k), *held),
                    (Kind::MixedWhens, 1) => *held,
                    _ => byte(k),
                };
                let mut updates = held.when(bit(0), value(0));
                for k in 1..count {
                    updates = updates.when(bit(k), value(k));
                }
                *held ^ i.x.slice(12..20)
            }
            Kind::Select => select((0..count).map(|k| (bit(k), byte(k))), 7) ^ i.x.slice(12..20),
            Kind::Muxes => (0..count).rev().fold(byte(3), |rest, k| mux(bit(k), byte(k), rest)),
            Kind::DeepMuxes => (0..count).rev().fold(byte(3), |rest, k| mux(bit(k), rest, byte(k))),
            Kind::Case => case(i.x, (0..count).map(|k| (k, byte(k))), 7) ^ i.bits.any_one().zext(8),
            Kind::Concat => {
                m.ignore(&i.x);
                // Three does not divide the counts.
                let parts: Vec<Signal> = (0..count).map(|k| bit((k * 3) % count)).collect();
                concat(&parts)
            }
            Kind::Or => (0..count).fold(byte(0), |all, k| all | bit(k).zext(8)),
            Kind::Xor => (0..count).fold(byte(0), |all, k| all ^ bit(k).zext(8)),
            Kind::Add => (0..count).fold(byte(0), |all, k| all + bit(k).zext(8)),
            Kind::Compare => (0..count).fold(byte(0), |all, k| all.lt(byte(k)).zext(8) + bit(k).zext(8)),
        };
        LongOut { y }
    }
}
