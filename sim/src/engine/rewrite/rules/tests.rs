//! The effect of each rule on the smallest circuit to which it applies.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Affine, Binary, Reduction, Relation, Shift, Unary};

use super::super::Rewriter;
use crate::engine::Passes;
use crate::engine::explain::operation;
use crate::engine::program::{Axis, Kind, ValueId};

/// Two bytes `a` and `b`, a flag `s`, and four lanes `x` of a byte.
struct Circuit {
    rewriter: Rewriter,
    a: ValueId,
    b: ValueId,
    s: ValueId,
    x: ValueId,
}

impl Circuit {
    fn new() -> Circuit {
        let mut rewriter = Rewriter::new(&Passes::default());
        let [a, b, s, x] = [(1, 8), (1, 8), (1, 1), (4, 8)].map(|(lanes, width)| rewriter.state(lanes, width));
        Circuit { rewriter, a, b, s, x }
    }

    fn byte(&mut self, number: u64) -> ValueId {
        self.rewriter.add(Kind::Const(Bits::new(8, number)), 1, 8)
    }

    fn flag(&mut self, number: u64) -> ValueId {
        self.rewriter.add(Kind::Const(Bits::new(1, number)), 1, 1)
    }

    /// An operation of 8 bits with this number of lanes.
    fn add(&mut self, kind: Kind, lanes: u32) -> ValueId {
        self.rewriter.add(kind, lanes, 8)
    }

    /// The expression of a value in terms of the four inputs.
    fn say(&self, id: ValueId) -> String {
        let name = |id: ValueId| match id {
            id if id == self.a => "a".to_owned(),
            id if id == self.b => "b".to_owned(),
            id if id == self.s => "s".to_owned(),
            id if id == self.x => "x".to_owned(),
            id => match self.rewriter.circuit().constant(id) {
                Some(_) => self.say(id),
                None => format!("({})", self.say(id)),
            },
        };
        if id.0 < 4 {
            return name(id);
        }
        let cell = &self.rewriter.circuit()[id];
        operation(&cell.kind, cell.width, &name, &|memory| format!("memory {memory}"))
    }

    #[track_caller]
    fn is(&self, id: ValueId, text: &str) {
        assert_eq!(self.say(id), text);
    }
}

#[test]
fn names() {
    let mut c = Circuit::new();
    let (a, x) = (c.a, c.x);
    let alias = c.add(Kind::Alias(a), 1);
    c.is(alias, "a");
    let lone = c.add(Kind::Stack { parts: vec![a], inner: 1 }, 1);
    c.is(lone, "a");
    let all = c.add(Kind::Map { of: x, axis: Axis::last(4), count: 4, index: Affine::shift(0), edge: None }, 4);
    c.is(all, "x");
    let edge = Some(a);
    let none = c.add(Kind::Map { of: x, axis: Axis::last(4), count: 4, index: Affine::shift(-4), edge }, 4);
    c.is(none, "4 times a");
}

#[test]
fn constants() {
    let mut c = Circuit::new();
    let (two, three) = (c.byte(2), c.byte(3));
    let sum = c.add(Kind::Binary(Binary::Add, two, three), 1);
    c.is(sum, "5");
    let lanes = c.add(Kind::Broadcast { of: three, axis: Axis::last(4) }, 4);
    c.is(lanes, "3");
    let all = c.add(Kind::Reduce { by: Reduction::Add, of: lanes, axis: Axis::last(4) }, 1);
    c.is(all, "8'h0c");
    let inverted = c.add(Kind::Unary(Unary::Not, lanes), 4);
    c.is(inverted, "8'hfc");
}

#[test]
fn choices() {
    let mut c = Circuit::new();
    let (a, b, s) = (c.a, c.b, c.s);
    let (no, yes, two) = (c.flag(0), c.flag(1), c.byte(2));
    let same = c.add(Kind::Mux { select: s, on_true: a, on_false: a }, 1);
    c.is(same, "a");
    let known = c.add(Kind::Mux { select: no, on_true: a, on_false: b }, 1);
    c.is(known, "b");
    let one_left = c.add(Kind::Select { arms: vec![(no, b), (s, a), (yes, b), (s, two)], default: two }, 1);
    c.is(one_left, "s ? a : b");
    let key = |number| Bits::new(8, number);
    let case = c.add(Kind::Case { subject: two, arms: vec![(key(1), a), (key(2), b)], default: a }, 1);
    c.is(case, "b");
    let arms = vec![(key(1), a), (key(2), b), (key(3), a)];
    let shorter = c.add(Kind::Case { subject: a, arms, default: a }, 1);
    c.is(shorter, "case a { 2: b, else a }");
}

#[test]
fn identities() {
    let mut c = Circuit::new();
    let (a, b, s) = (c.a, c.b, c.s);
    let (zero, ones, yes) = (c.byte(0), c.byte(255), c.flag(1));
    for (op, other, text) in [
        (Binary::And, ones, "a"),
        (Binary::And, zero, "0"),
        (Binary::Or, zero, "a"),
        (Binary::Or, ones, "8'hff"),
        (Binary::Xor, zero, "a"),
        (Binary::Add, zero, "a"),
        (Binary::Sub, zero, "a"),
        (Binary::Add, b, "a + b"),
    ] {
        let result = c.add(Kind::Binary(op, a, other), 1);
        c.is(result, text);
    }
    let shifted = c.add(Kind::Shift(Shift::Left, a, zero), 1);
    c.is(shifted, "a");
    let whole = c.add(Kind::Slice(a, 0), 1);
    c.is(whole, "a");
    let is_one = c.rewriter.add(Kind::Compare(Relation::Eq, false, s, yes), 1, 1);
    c.is(is_one, "s");
}

#[test]
fn operations_on_a_value_and_itself() {
    let mut c = Circuit::new();
    let a = c.a;
    for (op, text) in [(Binary::Xor, "0"), (Binary::Sub, "0"), (Binary::And, "a"), (Binary::Add, "a + a")] {
        let result = c.add(Kind::Binary(op, a, a), 1);
        c.is(result, text);
    }
    for (relation, text) in [(Relation::Eq, "1"), (Relation::Le, "1"), (Relation::Ne, "0"), (Relation::Lt, "0")] {
        let result = c.rewriter.add(Kind::Compare(relation, true, a, a), 1, 1);
        c.is(result, text);
    }
}

#[test]
fn lanes_that_are_taken() {
    let mut c = Circuit::new();
    let (a, b, x) = (c.a, c.b, c.x);
    let axis = Axis::last(4);
    let stack = c.add(Kind::Stack { parts: vec![a, b, a, b], inner: 1 }, 4);
    let before = c.add(Kind::Map { of: x, axis, count: 4, index: Affine::shift(-1), edge: Some(b) }, 4);
    let pair = c.add(Kind::Interleave { parts: vec![x, stack], axis }, 8);
    for (of, axis, index, text) in [
        (stack, axis, 1, "b"),
        (before, axis, 0, "b"),
        (before, axis, 3, "lane 2 of 4 of x"),
        (pair, Axis::last(8), 4, "lane 2 of 4 of x"),
        (pair, Axis::last(8), 5, "a"),
    ] {
        let lane = c.add(Kind::Lane { of, axis, index }, 1);
        c.is(lane, text);
    }
}

#[test]
fn wide_words_taken_apart() {
    let mut c = Circuit::new();
    let [high, low] = [40, 32].map(|width| c.rewriter.state(4, width));
    let word = c.rewriter.add(Kind::Concat(vec![high, low]), 4, 72);
    let slice = |c: &mut Circuit, of, at, lanes, width| c.rewriter.add(Kind::Slice(of, at), lanes, width);
    assert_eq!((slice(&mut c, word, 32, 4, 40), slice(&mut c, word, 0, 4, 32)), (high, low));
    let within = slice(&mut c, word, 35, 4, 9);
    assert_eq!(c.rewriter.circuit()[within].kind, Kind::Slice(high, 3));
    let across = slice(&mut c, word, 30, 4, 4);
    assert_eq!(c.rewriter.circuit()[across].kind, Kind::Slice(word, 30));

    let axis = Axis::last(4);
    let lane = c.rewriter.add(Kind::Lane { of: word, axis, index: 2 }, 1, 72);
    let of_high = slice(&mut c, lane, 32, 1, 40);
    assert_eq!(c.rewriter.circuit()[of_high].kind, Kind::Lane { of: high, axis, index: 2 });
    // A word that fits in a machine register is unchanged.
    let short = c.rewriter.add(Kind::Concat(vec![low, low]), 4, 64);
    let of_short = slice(&mut c, short, 0, 4, 32);
    assert_eq!(c.rewriter.circuit()[of_short].kind, Kind::Slice(short, 0));
}

#[test]
fn what_is_the_same_in_all_lanes() {
    let mut c = Circuit::new();
    let (a, b, x) = (c.a, c.b, c.x);
    let lanes = |c: &mut Circuit, of| c.add(Kind::Broadcast { of, axis: Axis::last(4) }, 4);
    let (many_a, many_b) = (lanes(&mut c, a), lanes(&mut c, b));
    let sum = c.add(Kind::Binary(Binary::Add, many_a, many_b), 4);
    c.is(sum, "4 times (a + b)");
    let mixed = c.add(Kind::Binary(Binary::Add, many_a, x), 4);
    c.is(mixed, "(4 times a) + x");
    let again = c.add(Kind::Broadcast { of: many_a, axis: Axis::last(3) }, 12);
    c.is(again, "12 times a");
    let row = c.add(Kind::Stack { parts: vec![many_a, many_b], inner: 1 }, 8);
    c.is(row, "4 times (lanes a, b), 2 lanes apart");
}

#[test]
fn lanes_that_are_computed_alike() {
    let mut c = Circuit::new();
    let (a, x) = (c.a, c.x);
    let part = |c: &mut Circuit, index| {
        let lane = c.add(Kind::Lane { of: x, axis: Axis::last(4), index }, 1);
        c.add(Kind::Binary(Binary::Xor, lane, a), 1)
    };
    let parts = (0..4).map(|index| part(&mut c, index)).collect();
    let all = c.add(Kind::Stack { parts, inner: 1 }, 4);
    c.is(all, "x ^ (4 times a)");
}

#[test]
fn reductions() {
    let mut c = Circuit::new();
    let grid = c.rewriter.state(24, 8);
    let by = Reduction::Xor;
    let reduced = |c: &mut Circuit, first: Axis, second: Axis| {
        let of = c.add(Kind::Reduce { by, of: grid, axis: first }, 24 / first.count);
        let twice = c.add(Kind::Reduce { by, of, axis: second }, 24 / first.count / second.count);
        match c.rewriter.circuit()[twice].kind {
            Kind::Reduce { of, axis, .. } if of == grid => Some((axis.count, axis.inner)),
            _ => None,
        }
    };
    // In 2 x 3 x 4 lanes: the last two axes in both sequences, the first two, and two that are not adjacent.
    assert_eq!(reduced(&mut c, Axis::last(4), Axis::last(3)), Some((12, 1)));
    assert_eq!(reduced(&mut c, Axis { count: 3, inner: 4 }, Axis::last(4)), Some((12, 1)));
    assert_eq!(reduced(&mut c, Axis { count: 3, inner: 4 }, Axis { count: 2, inner: 4 }), Some((6, 4)));
    assert_eq!(reduced(&mut c, Axis { count: 2, inner: 12 }, Axis { count: 3, inner: 4 }), Some((6, 4)));
    assert_eq!(reduced(&mut c, Axis::last(4), Axis { count: 2, inner: 3 }), None);
}

#[test]
fn packed() {
    let mut c = Circuit::new();
    let (a, x, axis) = (c.a, c.x, Axis::last(4));
    let parts = c.rewriter.add(Kind::Unpack { of: a, axis }, 4, 2);
    let part = c.rewriter.add(Kind::Lane { of: parts, axis, index: 3 }, 1, 2);
    c.is(part, "a[7:6]");
    let again = c.rewriter.add(Kind::Pack { of: parts, axis }, 1, 8);
    c.is(again, "a");
    let whole = c.rewriter.add(Kind::Pack { of: x, axis }, 1, 32);
    let lanes = c.rewriter.add(Kind::Unpack { of: whole, axis }, 4, 8);
    c.is(lanes, "x");
    let halves = c.rewriter.add(Kind::Unpack { of: whole, axis: Axis::last(2) }, 2, 16);
    c.is(halves, "2 parts of (4 lanes of x side by side)");
    let b = c.b;
    let stack = c.rewriter.add(Kind::Stack { parts: vec![a, b], inner: 1 }, 2, 8);
    let both = c.rewriter.add(Kind::Pack { of: stack, axis: Axis::last(2) }, 1, 16);
    c.is(both, "{b, a}");
}
