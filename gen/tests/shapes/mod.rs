//! Blocks whose text has every way in which the printer lays out expressions, choices and memories.

use crate::blocks::{Row, RowIn};
use tilewright_hdl::*;

block! {
    /// Expressions that are short, long, used twice, or that need a name; choices that nest.
    pub struct Shapes;
    in ShapesIn { a: bits(8), b: bits(8), wide: bits(100), which: bits(3), go: bit() }
    out ShapesOut {
        twice: _,
        chain: _,
        masked: _,
        signs: _,
        products: _,
        parts: _,
        few: _,
        many: _,
        first: _,
        picked: _,
        sampled: _,
    }
}

impl Shapes {
    fn build(&self, m: Module, i: ShapesIn) -> ShapesOut {
        let (a, b, which) = (i.a, i.b, i.which);
        let sum = a + b;
        let chain = (1..9).fold(a, |x, step| (x ^ (b + step)) & (a | (b - step)));
        let masked = (i.wide.slice(0..64) & lit(64, 0x1234_5678_9abc_def0_u64)).slice(0..10);
        let signs = cat![(a ^ b).sext(12), a.slice(1..5).sext(8), a.bit(0).sext(4), b.sext(9), which.sext(32)];
        let signed = (a + 1).signed().lt((b + 1).signed()) & (b ^ 3).signed().ge((a ^ 5).signed());
        let ordered = a.signed().lt(b.signed()) ^ a.signed().gt(3) ^ b.signed().le(-2);
        let parts = cat![
            i.wide.slice(76..90),
            i.wide.slice(70..75),
            i.wide.bit(64),
            sum.slice(2..5),
            !a,
            a.repeat(3),
            signed,
            ordered
        ];

        // As long as two choices, and longer.
        let few = mux(which.bit(0), a, mux(which.bit(1), b, 3));
        let many = mux(which.bit(0), a, mux(which.bit(1), b, mux(which.bit(2), sum, 4)));
        let (one, other) = ((a ^ b) + (a & b), (a | b) - (b ^ 9));
        let first = select([(which.bit(0), one), (which.bit(1), mux(i.go, b, few)), (which.bit(2), other)], 9);
        let picked = case(which, [(0, a), (3, mux(i.go, b, 7)), (5, sum)], many);

        let nested = m.reg("nested", 8).reset(1);
        let level = |depth: u32, inner: Signal| mux(a.bit(depth), mux(b.bit(depth), inner, nested), depth);
        nested.enable(i.go).next((0..6).fold(b, |inner, depth| level(depth, inner)));
        let cased = m.reg("cased", 8);
        cased.next((0..6).fold(b, |inner, depth| case(b.slice(depth..depth + 2), [(1, a)], inner)));
        let kept = m.reg("kept", 8);
        kept.next(mux(!i.go, kept, mux(which.eq(4), nested, a)));
        let last = m.reg("last", 8);
        last.next(select([(i.go, a), (which.bit(0), *last), (which.bit(1), b)], last));
        let held = m.reg("held", 8);
        held.next(select([(i.go, a), (which.bit(0), b), (which.bit(1), *held)], held));
        def!(stopped = !i.go);
        let (once, again) = (m.reg("once", 8), m.reg("again", 8));
        once.next(mux(!i.go, once, a));
        again.next(mux(stopped, again, b));

        ShapesOut {
            twice: sum ^ (sum + 1),
            chain,
            masked,
            signs,
            products: a.times(b) + cat![*kept, last ^ held ^ once ^ again ^ cased],
            parts,
            few,
            many,
            first,
            picked,
            sampled: m.on(Clock::new("slow", Period::ns(14))).synchronize("sampled", kept.bit(0)),
        }
    }
}

block! {
    /// Memories with several ports of each kind, of a depth that addresses exceed or do not.
    pub struct Words;
    in WordsIn { address: bits(4), low: bits(3), data: bits(8), write: bit() }
    out WordsOut { old: _, gated: _, now: _, beyond: _, third: _, constants: _, loaded: _ }
}

impl Words {
    fn build(&self, m: Module, i: WordsIn) -> WordsOut {
        let words = m.memory("words", 11, 8, ReadUnderWrite::Old);
        words.write(i.write, i.address, i.data);
        let old = words.read(i.address);
        let gated = words.read_when(i.write, i.low.zext(4));
        let now = words.read_async(i.address + 1) ^ words.read_async(i.low.zext(4));
        let some = m.memory("some", 5, 8, ReadUnderWrite::Old).words([3, 1, 4]);
        some.write(lit(1, 1), i.low, i.data);
        let filled = m.memory("filled", 16, 8, ReadUnderWrite::Old).fill(0x5a);
        let table = m.memory("table_of_many", 257, 8, ReadUnderWrite::Old).words([Bits::new(8, 7)]);
        let fixed = m.memory("fixed", 4, 8, ReadUnderWrite::Old);
        fixed.write(i.write, lit(2, 3), i.data);
        WordsOut {
            old,
            gated,
            now,
            beyond: words.read_async(lit(4, 12)),
            third: some.read_async(lit(3, 2)),
            constants: some.read(i.low) ^ filled.read(i.address) ^ fixed.read(i.low.slice(0..2)),
            loaded: table.read(cat![i.low, i.address, i.write, i.write]),
        }
    }
}

bundle! {
    pub struct GridOut<T> { pub total: T }
}

/// Two rows of cells: an array of arrays.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Grid;

impl Block for Grid {
    type In = RowIn;
    type Out = GridOut;

    fn inputs(&self) -> RowIn<Width> {
        Row { lanes: 3 }.inputs()
    }

    fn build(&self, m: Module, i: RowIn) -> GridOut {
        let rows = m.array("u_row", 2, &Row { lanes: 3 }, |_| i);
        GridOut { total: rows.total.sum() }
    }
}
