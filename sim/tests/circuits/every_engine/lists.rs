//! Lists of ports, set and read in one call.

use crate::circuits::engine::{engine, of};
use tilewright_hdl::{Bits, Block, Module, Width, bits, bundle};
use tilewright_sim::Batch;

bundle! {
    pub struct Pair<T> { pub left: T, pub right: T }
    pub struct In<T> { pub rows: Vec<Vec<T>>, pub pairs: [Pair<T>; 2], pub more: Vec<T> }
    pub struct Out<T> { pub sums: Vec<T>, pub products: [T; 2], pub wide: Vec<T> }
}

/// Sums of rows, and products of pairs.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Table;

impl Block for Table {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        let pair = || Pair { left: bits(8), right: bits(8) };
        In { rows: vec![vec![bits(8); 2], vec![bits(8); 3]], pairs: [pair(), pair()], more: vec![bits(70)] }
    }

    fn build(&self, m: Module, i: In) -> Out {
        let sum = |row: &Vec<_>| row.iter().copied().reduce(|all, one| all + one).expect("a row has an element");
        let sums = m.pipe("sum", i.rows.iter().map(sum).collect::<Vec<_>>());
        let products = i.pairs.map(|Pair { left, right }| left.times(right));
        Out { sums, products, wide: vec![i.more[0], !i.more[0]] }
    }
}

fn inputs(first: u64) -> In<u64> {
    let pair = |left| Pair { left, right: 10 };
    In { rows: vec![vec![first, 2], vec![3, 4, 5]], pairs: [pair(6), pair(7)], more: vec![u64::MAX] }
}

#[test]
fn a_list_is_set_and_read_in_one_call() {
    let mut sim = of(&Table);
    sim.drive(inputs(1));
    assert_eq!(sim.get_list(|o| &o.products), [60, 70]);
    sim.set_list(|i| &i.rows[1], [50, 60, 70]);
    sim.step();
    assert_eq!(sim.get_list(|o| &o.sums), [3, 180]);
    sim.set_list(|i| &i.rows[0], vec![true, false]);
    sim.set_list(|i| &i.more, [-1_i32]);
    sim.step();
    let Out { sums, wide, .. } = sim.read();
    assert_eq!((sums, wide), (vec![Bits::new(8, 1), Bits::new(8, 180)], vec![Bits::ones(70), Bits::zero(70)]));
}

#[test]
fn a_list_is_one_of_a_run() {
    let mut batch = Batch::of(&Table, 3).unwrap().on(engine());
    (0..3).for_each(|run| batch.drive(run, inputs(run.into())));
    batch.set_list(1, |i| &i.rows[1], [7_u8, 8, 9]);
    batch.step();
    let sums: Vec<_> = (0..3).map(|run| batch.get_list(run, |o| &o.sums)).collect();
    assert_eq!(sums, [[2, 12], [3, 24], [4, 12]]);
    batch.set_list(2, |i| &i.more, [5]);
    assert_eq!(batch.read(2).wide[0], Bits::new(70, 5));
    assert_eq!(batch.read(0).wide[0], Bits::new(70, u64::MAX));
}

#[test]
#[should_panic(expected = "a list of 3 inputs is set to a list of 2: give each input one value")]
fn a_shorter_list_is_not_set() {
    of(&Table).set_list(|i| &i.rows[1], [1, 2]);
}

#[test]
#[should_panic(expected = "a list of 3 inputs is set to a list of 5: give each input one value")]
fn a_longer_list_is_not_set() {
    of(&Table).set_list(|i| &i.rows[1], [1, 2, 3, 4, 5]);
}

#[test]
#[should_panic(expected = "input `rows.0` is a list of 2, but is set to a list of 3")]
fn lists_of_other_lengths_are_not_driven() {
    let rows = vec![vec![1, 2, 3], vec![4, 5]];
    of(&Table).drive(In { rows, ..inputs(1) });
}

#[test]
#[should_panic(expected = "`wide_0` is wider than 64 bits: use `get`")]
fn a_list_of_wide_ports_is_not_read_as_numbers() {
    of(&Table).get_list(|o| &o.wide);
}
