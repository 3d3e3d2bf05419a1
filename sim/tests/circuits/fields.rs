//! Words that the compiled engine splits into fields: side by side with the reference engine, the result is the same
//! as for whole words.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, Signal, bit, bits, block, cat, concat, elaborate, lit, mux, row};
use tilewright_sim::{EngineKind, Passes, Simulation};

block! {
    /// Words of two rows and a few fields on their way through a register without a reset, one with a reset, a choice
    /// and two memories.
    struct Cell { policy: ReadUnderWrite }
    in CellIn { x: bits(33), go: bit(), at: bits(3) }
    out CellOut { y: _, word: _ }
}

const WIDTH: u32 = 3 * 24 + 6 * 16 + 33 + 7 + 1;

/// The fields of a word, combined.
fn fold(word: Signal) -> Signal {
    let row3 = word.part(WIDTH - 72, 72).unpack(row(3)).xor_all().zext(64);
    let row6 = word.part(41, 96).unpack(row(6)).xor_all().zext(64);
    // Lanes of it in pairs, and a single one.
    let pairs = word.part(41, 96).unpack(row(3)).xor_all().zext(64);
    let lane = word.part(41 + 32, 16).zext(64);
    row3 ^ (row6 << 7)
        ^ pairs
        ^ (lane << 3)
        ^ word.part(8, 33).zext(64)
        ^ word.part(0, 8).zext(64)
        ^ word.bit(0).zext(64)
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let state = m.reg("state", bits(24).of(row(3))).reset(1);
        state.next(state.rotate_left(5) + i.x.trunc(24));
        let six = i.x.trunc(16) ^ tilewright_hdl::constants(bits(16).of(row(6)), |lane| u64::from(lane) * 77);
        let word = cat![state.pack(), six.pack(), i.x, i.x.part(3, 7), i.go];
        let start = (0..WIDTH / 5).fold(Bits::new(1, 1), |all, n| all.concat(&Bits::new(5, u64::from(n) * 7 % 32)));
        let start = start.resize(WIDTH);

        let kept = m.reg("kept", WIDTH).enable(i.go);
        kept.next(word);
        let other = m.reg("other", WIDTH).reset(start.clone());
        let words = m.memory("words", 5, WIDTH, self.policy).fill(start.clone());
        let more = m.memory("more", 8, WIDTH, self.policy);
        other.next(mux(i.x.bit(2), *kept, mux(i.x.bit(1), words.read_async(i.at), start)));
        words.write(i.x.bit(0), i.at, mux(i.x.bit(4), word, *other));
        more.write(i.go, i.at, *other);
        let read = more.read_when(i.x.bit(5), i.x.part(7, 3));
        let found = words.read(i.at);
        let y = [*kept, *other, read, found].map(fold).into_iter().reduce(|all, one| all.rotate_left(9) ^ one);
        // A word that is shown whole, and one that is used whole.
        let sum = m.reg("sum", 100).reset(0);
        sum.next(concat(&[sum.part(0, 50), sum.part(50, 50)]) + lit(100, 3));
        CellOut { y: y.expect("there are four") ^ sum.part(30, 64), word: mux(i.go, read, *kept) }
    }
}

block! {
    /// One of them, or an array.
    struct Top { cells: u32, policy: ReadUnderWrite }
    in TopIn { x: bits(33), go: bit(), at: bits(3) }
    out TopOut { y: _, last: _ }
}

impl Top {
    fn build(&self, m: Module, i: TopIn) -> TopOut {
        let cells = m.array("u_cell", self.cells, &Cell { policy: self.policy }, |a| {
            let x = a.y.previous(i.x.zext(64)).trunc(33) ^ i.x;
            CellIn { x, go: i.go, at: i.at ^ x.part(9, 3) }
        });
        TopOut { y: cells.y.xor_all(), last: cells.word.last() }
    }
}

fn top(cells: u32, policy: ReadUnderWrite) -> tilewright_hdl::Design {
    elaborate(&Top { cells, policy }).unwrap()
}

fn drive(sim: &mut Simulation, steps: u64) {
    let [x, go, at] = ["x", "go", "at"].map(|name| sim.port(name).unwrap());
    for n in 0..steps {
        sim.set(x, Bits::new(33, n.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 31));
        sim.set(go, (n / 3) & 1);
        sim.set(at, (n * 5 / 4) & 7);
        sim.step();
    }
}

#[test]
fn split_words_are_the_same_on_both_engines() {
    for (cells, policy) in [(1, ReadUnderWrite::Any), (1, ReadUnderWrite::Old), (9, ReadUnderWrite::Any)] {
        for seed in [0, 5] {
            let passes = Passes { looks_after: 3, held_after: 7, ..Passes::default() };
            let mut sim =
                Simulation::with_passes(&top(cells, policy), &passes).unwrap().on(EngineKind::Both).seeded(seed);
            drive(&mut sim, 40);
            sim.reset();
            drive(&mut sim, 40);
        }
    }
}

#[test]
fn words_are_looked_at_and_replaced_whole() {
    let design = top(3, ReadUnderWrite::Old);
    let mut sims = [EngineKind::Reference, EngineKind::Compiled].map(|kind| {
        let mut sim = Simulation::from_design(&design).unwrap().on(kind).seeded(9);
        let start = sim.peek_memory("u_cell[1].more", 3).unwrap();
        sim.poke_memory("u_cell[1].words", 2, start.clone()).unwrap();
        assert_eq!(sim.peek_memory("u_cell[1].words", 2).unwrap(), start);
        drive(&mut sim, 20);
        sim
    });
    for name in ["u_cell[0].kept", "u_cell[1].other", "u_cell[2].more_read", "u_cell[2].sum", "y", "last"] {
        let [whole, split] = sims.each_mut().map(|sim| sim.peek(name).unwrap());
        assert!(!whole.is_zero(), "{name}");
        assert_eq!(whole, split, "{name}");
    }
    for address in 0..5 {
        let [whole, split] = sims.each_ref().map(|sim| sim.peek_memory("u_cell[1].words", address).unwrap());
        assert_eq!(whole, split, "{address}");
    }
}
