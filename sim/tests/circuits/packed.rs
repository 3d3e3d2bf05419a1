//! Lanes of one bit that the compiled engine packs in words: on it and on the reference engine side by side, all is as if they were
//! apart.

use tilewright_hdl::{
    Bits, Design, Module, ReadUnderWrite, bit, bits, block, codes, constants, elaborate, grid, lit, mux, one_of, row,
    select,
};
use tilewright_sim::{EngineKind, Pass, Passes, Simulation, explain};

codes! {
    /// Who writes.
    enum Mask { Nobody, Everybody, Chosen, Both }
}

block! {
    /// A processor of one bit.
    struct Processor { policy: ReadUnderWrite }
    in ProcessorIn { x: bit(), go: bit(), mask: one_of::<Mask>(), at: bits(3), to: bits(3) }
    out ProcessorOut { y: bit(), word: bit(), read: bit() }
}

impl Processor {
    fn build(&self, m: Module, i: ProcessorIn) -> ProcessorOut {
        let memory = m.memory("memory", 6, bit(), self.policy).fill(Bits::ones(1));
        let other = m.memory("other", 8, bit(), self.policy);
        let word = memory.read_async(i.at);
        let read = other.read_when(i.go, i.at);
        let chosen = m.reg("chosen", bit()).reset(1);
        let carry = m.reg("carry", bit());
        let masked = i.mask.choose(|mask| match mask {
            Mask::Nobody => lit(1, 0),
            Mask::Everybody => lit(1, 1),
            Mask::Chosen => *chosen,
            Mask::Both => chosen & word,
        });
        memory.write(masked, i.to, i.x ^ word ^ carry);
        other.write(i.go, i.to, chosen.ne(word));
        carry.enable(i.x).next((i.x & word) | (carry & (i.x | word)));
        chosen.when(i.go, select([(i.x.lt(word), !carry), (read.signed().lt(i.x.signed()), i.x)], read));
        m.assume(i.go.implies(lit(1, 1)), "nothing");
        ProcessorOut { y: mux(masked, word, *carry), word, read }
    }
}

block! {
    /// A grid of them, whose bits are moved, combined and looked at.
    struct Square { rows: u32, columns: u32, policy: ReadUnderWrite }
    in(self) SquareIn { x: bits(7), go: bit(), mask: one_of::<Mask>(), at: bits(3), all: bits(self.columns) }
    out(self) SquareOut { y: bits(self.columns), any: bit(), odd: bit(), sum: bits(8), last: bit().of(row(self.columns)), picked: bit().of(row(self.columns)) }
}

impl Square {
    fn build(&self, m: Module, i: SquareIn) -> SquareOut {
        let (shape, first) = (grid(self.rows, self.columns), i.x.bit(0));
        let held =
            m.reg("held", bit().of(shape)).reset_each((0..self.rows * self.columns).map(|lane| lane * 5 / 3 % 2));
        let line = m.reg("line", bit().of(row(self.columns))).reset(0);
        line.next(i.all.unpack(row(self.columns)) ^ line.previous(first));
        let column = constants(bit().of(row(self.rows)), |row| u64::from(row % 3 == 1)).to_columns(self.columns);
        let above = held.rows().previous(*line);
        let parents = held.rows().take(self.rows, |row| row / 2);
        let x = (above & column) | (parents & line.to_rows(self.rows) & i.x.bit(1));
        let processors = m.array("u_processor", shape, &Processor { policy: self.policy }, |processors| ProcessorIn {
            x: x ^ processors.read,
            go: i.go,
            mask: i.mask,
            at: i.at,
            to: i.x.part(2, 3),
        });
        let wide = m.reg("wide", bits(2).of(shape)).reset(0);
        wide.next(*wide + 1);
        held.when(i.x.bit(5), processors.y ^ wide.any_one()).when(i.x.bit(6), processors.word ^ i.x.bit(1));
        m.assert(held.le(lit(1, 1).of(shape)).rows().and_all().and_all(), "a bit is 1 at most");
        let counts = m.reg("counts", bits(8).of(row(self.rows))).reset(0);
        counts.next(*counts + (processors.y.columns().last().zext(8) + 1));
        SquareOut {
            y: processors.y.rows().xor_all().pack(),
            any: processors.word.columns().or_all().and_all(),
            odd: held.columns().xor_all().xor_all(),
            sum: counts.sum().trunc(8),
            last: held.rows().lane(self.rows - 1),
            picked: held.rows().pick(i.at),
        }
    }
}

fn square(rows: u32, columns: u32, policy: ReadUnderWrite) -> Design {
    elaborate(&Square { rows, columns, policy }).unwrap()
}

/// Bits are packed wherever there are as many as a word has.
fn passes() -> Passes {
    Passes { pack_from: 8, looks_after: 5, held_after: 9, ..Passes::default() }
}

fn drive(sim: &mut Simulation, steps: u64) {
    let [x, go, mask, at, all] = ["x", "go", "mask", "at", "all"].map(|name| sim.port(name).unwrap());
    for n in 0..steps {
        let drawn = n.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        sim.set(x, drawn >> 57);
        sim.set(go, drawn >> 50 & 1);
        sim.set(mask, drawn >> 40 & 3);
        sim.set(at, (drawn >> 30 & 7) % 6);
        let width = sim.get(all).width();
        sim.set(all, Bits::from_limbs(128, &[drawn, drawn >> 3]).resize(width));
        sim.step();
    }
}

const SIZES: [(u32, u32); 6] = [(1, 64), (4, 16), (3, 32), (2, 128), (8, 8), (5, 24)];

#[test]
fn packed_bits_are_the_same_on_both_engines() {
    for (rows, columns) in SIZES {
        for (policy, seed) in [(ReadUnderWrite::Any, 0), (ReadUnderWrite::Old, 5)] {
            let design = square(rows, columns, policy);
            let mut sim = Simulation::with_passes(&design, &passes()).unwrap().on(EngineKind::Both).seeded(seed);
            drive(&mut sim, 40);
            sim.reset();
            drive(&mut sim, 40);
        }
    }
}

#[test]
fn packed_bits_are_looked_at_and_replaced_one_by_one() {
    let design = square(4, 16, ReadUnderWrite::Old);
    let mut sims = [EngineKind::Reference, EngineKind::Compiled].map(|kind| {
        let mut sim = Simulation::with_passes(&design, &passes()).unwrap().on(kind).seeded(9);
        let start = sim.peek_memory("u_processor[1][3].other", 3).unwrap();
        let inverted = Bits::new(1, u64::from(start.is_zero()));
        sim.poke_memory("u_processor[1][3].other", 3, inverted.clone()).unwrap();
        assert_eq!(sim.peek_memory("u_processor[1][3].other", 3).unwrap(), inverted);
        drive(&mut sim, 20);
        sim
    });
    let mut ones = 0;
    for (row, column) in (0..4).flat_map(|row| (0..16).map(move |column| (row, column))) {
        let scope = format!("u_processor[{row}][{column}]");
        for name in ["carry", "chosen", "read", "word", "y"] {
            let [apart, packed] = sims.each_mut().map(|sim| sim.peek(&format!("{scope}.{name}")).unwrap());
            assert_eq!(apart, packed, "{scope}.{name}");
            ones += u32::from(!apart.is_zero());
        }
        for address in 0..6 {
            let [apart, packed] =
                sims.each_ref().map(|sim| sim.peek_memory(&format!("{scope}.other"), address).unwrap());
            assert_eq!(apart, packed, "{scope}, {address}");
        }
    }
    assert!((64..4 * 64).contains(&ones), "some bits are set, some are not: {ones}");
}

#[test]
fn bits_are_packed_in_words_as_long_as_what_is_moved_together() {
    for (columns, lanes) in [(64, 64), (16, 16), (128, 64), (24, 8)] {
        let explained = explain(&square(8, columns, ReadUnderWrite::Any), &passes());
        let packed = &explained.iter().find(|it| it.pass == Pass::Pack).expect("every pass is explained").text;
        for name in ["held", "u_processor.chosen", "u_processor.carry"] {
            let line = packed.lines().find(|line| line.starts_with(&format!("{name}, {lanes} lanes a word ")));
            assert!(line.is_some_and(|line| line.contains("= register")), "{name} of {columns}\n{packed}");
        }
    }
}
