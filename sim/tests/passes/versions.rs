//! Loops that get versions for frequent cases.

use tilewright_hdl::{Module, bit, bits, block, mux, row};
use tilewright_sim::{Pass, Passes};

use crate::passes::{after_with, is};

block! {
    /// A row of numbers that are mixed; two fields of an instruction select too little to justify loops of their own.
    struct Mixer;
    in MixerIn { adds: bit(), inverts: bit(), x: bits(8) }
    out MixerOut { all: bits(8) }
}

impl Mixer {
    fn build(&self, m: Module, i: MixerIn) -> MixerOut {
        let sum = m.reg("sum", bits(8).of(row(2048))).reset(0);
        let number = mux(i.adds, *sum + i.x, *sum ^ i.x);
        let mixed = (1..6).fold(number, |all, round| (all + *sum).rotate_left(round) ^ all);
        sum.next(mux(i.inverts, !mixed, mixed));
        MixerOut { all: sum.lane(3) }
    }
}

#[test]
fn versions() {
    let text = after_with(&Mixer, Pass::Branch, &Passes { versions_from: 100, ..Passes::default() });
    let first: String = text.lines().take(3).map(|line| format!("{line}\n")).collect();
    is(
        &first,
        r"
        an edge of clk:
        stage 0
          loop over 2048 lanes: in versions by adds inverts; else
    ",
    );
}
