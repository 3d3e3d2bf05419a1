//! Lanes of one bit that the compiled engine packs in words: side by side with the reference engine, the result is
//! the same as for separate lanes.

use tilewright_hdl::{
    Bits, Design, Module, ReadUnderWrite, bit, bits, block, codes, constants, elaborate, grid, interleave, lit, mux,
    one_of, row, select, stack,
};
use tilewright_sim::{EngineKind, Pass, Passes, Simulation};

use crate::text_after;

codes! {
    /// The processors that write.
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
    /// A grid of them, whose bits are moved, combined and read.
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

block! {
    /// A row whose bits are permuted.
    struct Places { lanes: u32 }
    in(self) PlacesIn { x: bits(self.lanes), a: bit(), b: bit() }
    out(self) PlacesOut { all: bits(2 * self.lanes), half: bits(self.lanes), one: bit(), parity: bit(), sum: bits(8) }
}

impl Places {
    fn build(&self, m: Module, i: PlacesIn) -> PlacesOut {
        let n = self.lanes;
        let register = |name: &str, lanes: u32| m.reg(name, bit().of(row(lanes))).reset_each((0..lanes).map(|i| i % 2));
        let (even, odd, twice, above) =
            (register("even", n), register("odd", n), register("twice", 2 * n), register("above", 2 * n));
        let held = m.memory("held", 4, bit().of(row(n)), ReadUnderWrite::Old);
        let x = i.x.unpack(row(n));
        let apart: Vec<_> = (0..n).map(|lane| i.x.bit((lane + 1) % n) ^ i.b).collect();
        // Rows of a square, one above the other; in one word, if they fit.
        let square = x.to_rows(2) ^ stack([*even, *odd]);
        held.write(i.a, i.x.bit(0).zext(2), x ^ *odd);
        even.next(held.read_async(i.x.bit(1).zext(2)) ^ stack(apart) ^ odd.previous(i.b));
        odd.when(i.a, !even).otherwise(odd ^ square.rows().lane(1) ^ square.columns().lane(0).lane(0));
        let parents = (x ^ *even).take(2 * n, |lane| lane / 2);
        let turned = interleave([*even, *odd]);
        twice.next(turned ^ (parents & twice.following(i.a)) ^ twice.shifted(3, i.b));
        above.next(twice ^ (twice.previous(i.a) & above) ^ mux(i.b, above.shifted(-2, i.a), interleave([*odd, x])));
        let counts = m.reg("counts", bits(8).of(row(2 * n))).reset(0);
        counts.next(counts + mux(*above, twice.zext(8), constants(bits(8).of(row(2 * n)), u64::from)));
        PlacesOut {
            all: above.pack(),
            half: odd.pack(),
            one: twice.lane(n),
            parity: twice.xor_all(),
            sum: counts.sum().trunc(8),
        }
    }
}

block! {
    /// Rows that are shorter than a strip.
    struct ShortRows { rows: u32, columns: u32, width: u32 }
    in(self) ShortRowsIn { x: bits(self.width) }
    out(self) ShortRowsOut { sum: bits(self.width) }
}

impl ShortRows {
    fn build(&self, m: Module, i: ShortRowsIn) -> ShortRowsOut {
        let shape = grid(self.rows, self.columns);
        let all = m.reg("all", bits(self.width).of(shape)).reset(0);
        let across = m.reg("across", bits(self.width).of(row(self.columns)));
        let down = m.reg("down", bits(self.width).of(row(self.rows)));
        across.next(across.previous(i.x));
        down.next(down.previous(across.lane(1)));
        let steps = constants(bits(self.width).of(row(self.columns)), |lane| u64::from(lane % 2));
        all.next((all ^ across.to_rows(self.rows)) + down.to_columns(self.columns) + steps.to_rows(self.rows));
        ShortRowsOut { sum: all.rows().xor_all().xor_all() }
    }
}

fn square(rows: u32, columns: u32, policy: ReadUnderWrite) -> Design {
    elaborate(&Square { rows, columns, policy }).unwrap()
}

/// Bits are packed whenever they fill a word.
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
        let packed = text_after(&square(8, columns, ReadUnderWrite::Any), Pass::Pack, &passes());
        for name in ["held", "u_processor.chosen", "u_processor.carry"] {
            let line = packed.lines().find(|line| line.starts_with(&format!("{name}, {lanes} lanes a word ")));
            assert!(line.is_some_and(|line| line.contains("= register")), "{name} of {columns}\n{packed}");
        }
    }
}

const LANES: [u32; 15] = [2, 3, 5, 7, 8, 12, 16, 17, 24, 31, 32, 33, 48, 64, 128];

#[test]
fn bits_that_change_places_are_the_same_on_both_engines() {
    for lanes in LANES {
        let design = elaborate(&Places { lanes }).unwrap();
        for passes in [passes(), Passes::default(), Passes { fold: false, ..Passes::default() }] {
            let mut sim = Simulation::with_passes(&design, &passes).unwrap().on(EngineKind::Both).seeded(lanes.into());
            let [x, a, b] = ["x", "a", "b"].map(|name| sim.port(name).unwrap());
            for n in 1..40_u64 {
                let drawn = n.wrapping_mul(0x9e37_79b9_7f4a_7c15);
                sim.set(x, Bits::from_limbs(128, &[drawn, drawn >> 3]).resize(lanes));
                sim.set(a, drawn >> 50 & 1);
                sim.set(b, drawn >> 40 & 1);
                sim.step();
            }
        }
    }
}

#[test]
fn a_row_is_packed_in_one_word() {
    for (lanes, in_a_word) in [(2, 4), (5, 10), (16, 32), (31, 62), (32, 64), (64, 64)] {
        let packed = text_after(&elaborate(&Places { lanes }).unwrap(), Pass::Pack, &Passes::default());
        let line = packed.lines().find(|line| line.starts_with(&format!("twice, {in_a_word} lanes a word ")));
        assert!(line.is_some(), "{lanes}\n{packed}");
    }
}

block! {
    /// Rows of numbers whose lanes are permuted, in a regular way and in an irregular one.
    struct Regular { lanes: u32, width: u32 }
    in(self) RegularIn { x: bits(self.width) }
    out(self) RegularOut { sum: bits(self.width) }
}

impl Regular {
    fn build(&self, m: Module, i: RegularIn) -> RegularOut {
        let n = self.lanes;
        let number = |lanes: u32| bits(self.width).of(row(lanes));
        let [all, twice, half] = [("all", n), ("twice", 2 * n), ("half", n / 2)]
            .map(|(name, lanes)| m.reg(name, number(lanes)).reset_each((0..lanes).map(|lane| lane % 2)));
        all.next((all.previous(i.x) + i.x) ^ half.take(n, |lane| lane / 2));
        twice.next((twice ^ interleave([*all, !*all])) + all.take(2 * n, |lane| (lane + 1) / 3));
        half.next(all.take(n / 2, |lane| lane * 2) ^ twice.take(n / 2, |lane| lane * 4 + 1));
        let [lines, more] = [("lines", n / 4), ("more", n / 4 * 2)]
            .map(|(name, rows)| m.reg(name, bits(self.width).of(grid(rows, 4))).reset(1));
        lines.next((lines + i.x) ^ more.rows().take(n / 4, |row| row * 2) ^ lines.columns().previous(i.x));
        more.next(more + lines.rows().take(n / 4 * 2, |row| row / 2));
        RegularOut { sum: twice.xor_all() + half.xor_all() + more.rows().xor_all().xor_all() }
    }
}

#[test]
fn lanes_that_change_places_are_the_same_on_both_engines() {
    for (lanes, width) in [(8, 8), (16, 8), (32, 30), (64, 64), (12, 16), (34, 5), (16, 1), (16, 70)] {
        let design = elaborate(&Regular { lanes, width }).unwrap();
        let apart = Passes { pack_from: u32::MAX, ..passes() };
        for passes in [passes(), apart] {
            let mut sim = Simulation::with_passes(&design, &passes).unwrap().on(EngineKind::Both);
            let x = sim.port("x").unwrap();
            for n in 0..20_u64 {
                let drawn = (n + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                sim.set(x, Bits::from_limbs(128, &[drawn, drawn >> 3]).resize(width));
                sim.step();
            }
        }
    }
}

#[test]
fn rows_shorter_than_a_strip_are_the_same_on_both_engines() {
    for (rows, columns, width) in [(6, 2, 64), (5, 2, 40), (3, 4, 8), (7, 2, 1), (9, 8, 8), (33, 2, 16), (4, 2, 70)] {
        let design = elaborate(&ShortRows { rows, columns, width }).unwrap();
        let mut sim = Simulation::with_passes(&design, &passes()).unwrap().on(EngineKind::Both);
        let x = sim.port("x").unwrap();
        for n in 0..20_u64 {
            let drawn = (n + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            sim.set(x, Bits::from_limbs(128, &[drawn, drawn >> 3]).resize(width));
            sim.step();
        }
    }
}
