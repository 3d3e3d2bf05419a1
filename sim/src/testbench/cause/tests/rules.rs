//! The rule of each operation, with all values of small operands.
//!
//! The bits that count are enough: whatever the others are, the bit in question stays. And they matter: other values
//! of them alone change it, unless another part decides it as well, as a second zero of an AND of many bits does.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Affine, Binary, Reduction, Relation, Shift, Unary};

use crate::engine::program::{Axis, Cell, Circuit, Kind, ValueId};
use crate::engine::semantics::{self, Number};
use crate::testbench::cause::mask;
use crate::testbench::cause::operation::{Asked, Demand, Place, demands};

/// An operation on small operands, each with its lanes and its width.
struct Rule {
    circuit: Circuit,
    operands: Vec<(ValueId, u32, u32)>,
    cell: Cell,
    /// Of several parts that decide alike, one may count.
    counts_one: bool,
}

impl Rule {
    fn new(operands: &[(u32, u32)], kind: impl Fn(&[ValueId]) -> Kind, lanes: u32, width: u32) -> Rule {
        let mut circuit = Circuit::default();
        let mut add =
            |&(lanes, width): &(u32, u32)| (circuit.push(Cell::new(Kind::State, lanes, width), None), lanes, width);
        let operands: Vec<_> = operands.iter().map(&mut add).collect();
        let ids: Vec<ValueId> = operands.iter().map(|(id, ..)| *id).collect();
        let cell = Cell::new(kind(&ids), lanes, width);
        Rule { circuit, operands, cell, counts_one: false }
    }

    fn counting_one(self) -> Rule {
        Rule { counts_one: true, ..self }
    }

    /// The number of bits of all operands.
    fn bits(&self) -> u32 {
        self.operands.iter().map(|(_, lanes, width)| lanes * width).sum()
    }

    /// Where a lane of an operand stands in a number that has all operands side by side, and its width.
    fn place(&self, id: ValueId, lane: u32) -> (u32, u32) {
        let index = self.operands.iter().position(|(of, ..)| *of == id).expect("it is an operand");
        let before: u32 = self.operands[..index].iter().map(|(_, lanes, width)| lanes * width).sum();
        let width = self.operands[index].2;
        (before + lane * width, width)
    }

    fn operand(&self, all: u32, id: ValueId, lane: u32) -> Bits {
        let (low, width) = self.place(id, lane);
        Bits::new(width, u64::from(all >> low) & ((1 << width) - 1))
    }

    fn result(&self, all: u32, lane: u32) -> u64 {
        let values: Vec<Vec<[u64; 1]>> = self
            .operands
            .iter()
            .map(|(id, lanes, _)| (0..*lanes).map(|lane| [self.operand(all, *id, lane).limbs()[0]]).collect())
            .collect();
        let mut out = [0];
        let operand = |id: ValueId, lane: u32| Number {
            limbs: &values[id.index()][lane as usize],
            width: self.operands[id.index()].2,
        };
        semantics::lane(&self.cell, lane, &mut out, operand);
        out[0]
    }

    /// The operand bits that count, as a number.
    fn counting(&self, all: u32, lane: u32, bit: u32) -> u32 {
        let bits = mask::one(self.cell.width, bit);
        let asked = Asked { circuit: &self.circuit, cell: &self.cell, lane, bits: &bits };
        let demands = demands(&asked, &mut |id, lane| self.operand(all, id, lane));
        demands.iter().fold(0, |counting, Demand { place, lane, bits, .. }| {
            let Place::Value(id) = place else { panic!("no memories here") };
            counting | (bits.limbs()[0] as u32) << self.place(*id, *lane).0
        })
    }

    fn check(&self) {
        for lane in 0..self.cell.lanes {
            let results: Vec<u64> = (0..1 << self.bits()).map(|all| self.result(all, lane)).collect();
            for bit in 0..self.cell.width {
                self.check_bit(&results, lane, bit);
            }
        }
    }

    fn check_bit(&self, results: &[u64], lane: u32, bit: u32) {
        let at = |all: u32| results[all as usize] >> bit & 1;
        let is_constant = results.iter().all(|result| result >> bit & 1 == at(0));
        for all in 0..results.len() as u32 {
            let counting = self.counting(all, lane, bit);
            let mut matters = false;
            for other in 0..results.len() as u32 {
                let differ = all ^ other;
                let text = || format!("{:?}, bit {bit} of lane {lane}, {all:b} {other:b}", self.cell.kind);
                assert!(differ & counting != 0 || at(all) == at(other), "not enough: {}", text());
                matters |= differ & !counting == 0 && at(all) != at(other);
            }
            let text = || format!("{:?}, bit {bit} of lane {lane}, {all:b}", self.cell.kind);
            assert!(matters || is_constant || self.counts_one, "it does not matter: {}", text());
        }
    }
}

#[test]
fn what_counts_is_enough_and_matters() {
    for op in [Unary::Not, Unary::Parity] {
        Rule::new(&[(1, 3)], |it| Kind::Unary(op, it[0]), 1, if op == Unary::Not { 3 } else { 1 }).check();
    }
    for op in [Unary::AllOnes, Unary::AnyOne] {
        Rule::new(&[(1, 3)], |it| Kind::Unary(op, it[0]), 1, 1).counting_one().check();
    }
    for op in [Binary::And, Binary::Or, Binary::Xor, Binary::Add, Binary::Sub] {
        Rule::new(&[(1, 3), (1, 3)], |it| Kind::Binary(op, it[0], it[1]), 1, 3).check();
    }
    for op in [Binary::Mul, Binary::MulSigned] {
        Rule::new(&[(1, 3), (1, 2)], |it| Kind::Binary(op, it[0], it[1]), 1, 5).counting_one().check();
    }
    for relation in [Relation::Lt, Relation::Le, Relation::Gt, Relation::Ge] {
        for signed in [false, true] {
            Rule::new(&[(1, 3), (1, 3)], |it| Kind::Compare(relation, signed, it[0], it[1]), 1, 1).check();
        }
    }
    for relation in [Relation::Eq, Relation::Ne] {
        Rule::new(&[(1, 3), (1, 3)], |it| Kind::Compare(relation, false, it[0], it[1]), 1, 1).counting_one().check();
    }
    for op in [Shift::Left, Shift::Right, Shift::RightSigned] {
        Rule::new(&[(1, 4), (1, 3)], |it| Kind::Shift(op, it[0], it[1]), 1, 4).counting_one().check();
    }
    Rule::new(&[(1, 3)], |it| Kind::Slice(it[0], 1), 1, 2).check();
    Rule::new(&[(1, 3), (1, 2)], |it| Kind::Concat(it.to_vec()), 1, 5).check();
    Rule::new(&[(1, 2)], |it| Kind::Repeat(it[0], 3), 1, 6).check();
    for signed in [false, true] {
        Rule::new(&[(1, 2)], |it| Kind::Extend(it[0], signed), 1, 5).check();
    }
}

#[test]
fn a_choice_counts_its_condition_and_its_chosen_side() {
    let mux = |it: &[ValueId]| Kind::Mux { select: it[0], on_true: it[1], on_false: it[2] };
    Rule::new(&[(1, 1), (1, 2), (1, 2)], mux, 1, 2).check();
    let select = |it: &[ValueId]| Kind::Select { arms: vec![(it[0], it[1]), (it[2], it[3])], default: it[4] };
    Rule::new(&[(1, 1), (1, 2), (1, 1), (1, 2), (1, 2)], select, 1, 2).check();
    let keys = [Bits::new(2, 1), Bits::new(2, 3)];
    let case = |it: &[ValueId]| {
        let arms = keys.iter().cloned().zip([it[1], it[2]]).collect();
        Kind::Case { subject: it[0], arms, default: it[3] }
    };
    Rule::new(&[(1, 2), (1, 2), (1, 2), (1, 2)], case, 1, 2).check();
    let rule = Rule::new(&[(1, 1), (1, 2), (1, 2)], mux, 1, 2);
    // With the select at 1 (bit 0), bit 1 of the result is bit 1 of the first side, which is bit 2 of all.
    assert_eq!([rule.counting(0b00001, 0, 1), rule.counting(0b00000, 0, 1)], [0b00101, 0b10001]);
}

#[test]
fn lanes_count_where_they_come_from() {
    let axis = |count: u32, inner: u32| Axis { count, inner };
    Rule::new(&[(2, 2)], |it| Kind::Broadcast { of: it[0], axis: axis(3, 1) }, 6, 2).check();
    Rule::new(&[(2, 2)], |it| Kind::Broadcast { of: it[0], axis: axis(2, 2) }, 4, 2).check();
    Rule::new(&[(2, 2), (2, 2)], |it| Kind::Stack { parts: it.to_vec(), inner: 1 }, 4, 2).check();
    let moved = |it: &[ValueId]| Kind::Map {
        of: it[0],
        axis: axis(3, 1),
        count: 4,
        index: Affine { mul: 1, add: -1, div: 1 },
        edge: Some(it[1]),
    };
    Rule::new(&[(3, 2), (1, 2)], moved, 4, 2).check();
    Rule::new(&[(2, 2), (2, 2)], |it| Kind::Interleave { parts: it.to_vec(), axis: axis(2, 1) }, 4, 2).check();
    Rule::new(&[(4, 2)], |it| Kind::Lane { of: it[0], axis: axis(2, 2), index: 1 }, 2, 2).check();
    let pick = |it: &[ValueId]| Kind::Pick { of: it[0], axis: axis(3, 1), index: it[1] };
    Rule::new(&[(3, 2), (1, 2)], pick, 1, 2).counting_one().check();
    for by in [Reduction::Xor, Reduction::Add, Reduction::Min, Reduction::Max] {
        Rule::new(&[(3, 2)], |it| Kind::Reduce { by, of: it[0], axis: axis(3, 1) }, 1, 2).check();
    }
    for by in [Reduction::And, Reduction::Or] {
        Rule::new(&[(3, 2)], |it| Kind::Reduce { by, of: it[0], axis: axis(3, 1) }, 1, 2).counting_one().check();
    }
    Rule::new(&[(4, 2)], |it| Kind::Pack { of: it[0], axis: axis(2, 1) }, 2, 4).check();
    Rule::new(&[(2, 4)], |it| Kind::Unpack { of: it[0], axis: axis(2, 1) }, 4, 2).check();
}
