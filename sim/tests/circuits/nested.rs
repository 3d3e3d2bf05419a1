//! Arrays in arrays, on both engines side by side: what loops store, recompute and skip.

use std::collections::BTreeSet;

use tilewright_hdl::{Block, Module, bits, block, bundle, cat, constants, stack};
use tilewright_sim::{EngineKind, Simulation};

/// Runs a block without inputs on both engines. Its output must change, or there would be little to compare.
#[track_caller]
fn agree<B: Block<Out = SumOut>>(block: &B) {
    let mut sim = Simulation::of(block).unwrap().on(EngineKind::Both);
    sim.try_reset().unwrap();
    let mut sums = BTreeSet::new();
    for _ in 0..20 {
        sim.try_step().unwrap();
        sums.insert(sim.get(sim.o.sum).limbs().to_vec());
    }
    assert!(sums.len() > 5, "{sums:?}");
}

bundle! {
    pub struct GroupIn<T> { pub even: T, pub odd: T }
    pub struct SeedIn<T> { pub seed: T }
    pub struct SumOut<T> { pub sum: T }
}

block! {
    /// Adds its row's value to its own.
    struct Adder;
    in AdderIn { row: bits(32), sum: bits(32) }
    out AdderOut { x: _ }
}

impl Adder {
    fn build(&self, m: Module, i: AdderIn) -> AdderOut {
        let own = m.reg("own", 32).reset(7);
        own.next((*own ^ i.sum) + i.row);
        AdderOut { x: *own + i.row }
    }
}

block! {
    /// Uses the sum of its adders, which depends on its own value.
    struct AdderRow;
    in = SeedIn { seed: bits(32) };
    out = SumOut { sum: bits(32) };
}

impl AdderRow {
    fn build(&self, m: Module, i: SeedIn) -> SumOut {
        let held = m.reg("held", 32).reset(1);
        let sum = m.wire("sum", 32);
        let adders = m.array("u_adder", 16, &Adder, |_| AdderIn { row: *held, sum: *sum });
        sum.drive(adders.x.sum());
        held.next(*held + *sum + i.seed);
        SumOut { sum: *sum }
    }
}

/// Blocks, each with a seed.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Rows<B>(u32, B);

impl<B: Block<In = SeedIn, Out = SumOut>> Block for Rows<B> {
    type In = ();
    type Out = SumOut;

    fn inputs(&self) {}

    fn build(&self, m: Module, (): ()) -> SumOut {
        let rows = m.array("u_row", self.0, &self.1, |_| SeedIn {
            seed: constants(bits(32).of(self.0), |lane| 3 * lane as u64 + 1),
        });
        SumOut { sum: rows.sum.xor_all() }
    }
}

#[test]
fn a_row_that_changes_is_seen_as_it_was_by_a_later_loop() {
    agree(&Rows(4, AdderRow));
}

bundle! {
    pub struct LeafIn<T> { pub x: T }
    pub struct LeafOut<T> { pub y: T }
}

block! {
    /// Stores its input.
    struct Leaf;
    in = LeafIn { x: bits(8) };
    out = LeafOut { y: bits(8) };
}

impl Leaf {
    fn build(&self, m: Module, i: LeafIn) -> LeafOut {
        LeafOut { y: m.pipe("held", i.x) }
    }
}

block! {
    /// Two leaves, fed its input and half of it.
    struct Pair;
    in = LeafIn { x: bits(8) };
    out = LeafOut { y: bits(8) };
}

impl Pair {
    fn build(&self, m: Module, i: LeafIn) -> LeafOut {
        let leaves = m.array("u_leaf", 2, &Leaf, |_| LeafIn { x: stack([i.x, i.x >> 1]) });
        LeafOut { y: leaves.y.sum() }
    }
}

block! {
    /// Pairs that are fed values of a counter, the same in every group.
    struct Group;
    in = GroupIn { even: bits(8), odd: bits(8) };
    out = SumOut { sum: bits(8) };
}

impl Group {
    fn build(&self, m: Module, i: GroupIn) -> SumOut {
        let pairs = m.array("u_pair", 4, &Pair, |_| LeafIn { x: stack([i.even, i.odd, i.even + 1, i.even ^ i.odd]) });
        SumOut { sum: pairs.y.sum() }
    }
}

block! {
    /// Groups that are all fed the same.
    struct Groups;
    out = SumOut { sum: bits(8) };
}

impl Groups {
    fn build(&self, m: Module, (): ()) -> SumOut {
        let count = m.reg("count", 8).reset(0);
        count.next(*count + 3);
        let groups = m.array("u_group", 4, &Group, |_| GroupIn { even: *count, odd: !*count });
        SumOut { sum: groups.sum.sum() }
    }
}

#[test]
fn a_row_that_all_groups_share_is_made_into_an_array_of_more_lanes() {
    agree(&Groups);
}

block! {
    /// A value of 1024 bits, computed from a few equally wide ones.
    struct Wide;
    in = LeafIn { x: bits(8) };
    out = LeafOut { y: bits(1024) };
}

impl Wide {
    fn build(&self, m: Module, i: LeafIn) -> LeafOut {
        let mut value = m.pipe("first", i.x);
        for stage in 0..12 {
            value = m.pipe(&format!("stage{stage}"), value + i.x);
        }
        LeafOut { y: cat![value, value.zext(1016)] }
    }
}

block! {
    /// Two of them, combined.
    struct WideRow;
    in = SeedIn { seed: bits(32) };
    out = SumOut { sum: bits(1024) };
}

impl WideRow {
    fn build(&self, m: Module, i: SeedIn) -> SumOut {
        let wide = m.array("u_wide", 2, &Wide, |_| LeafIn { x: stack([i.seed.slice(0..8), i.seed.slice(8..16)]) });
        SumOut { sum: m.pipe("any", wide.y.or_all()) + m.pipe("total", wide.y.sum()) }
    }
}

#[test]
fn groups_of_wide_values_are_reduced_within_their_room() {
    agree(&Rows(9, WideRow));
}
