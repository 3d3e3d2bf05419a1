//! Descriptions of a size that reveals superlinear cost.

use std::time::{Duration, Instant};
use tilewright_hdl::*;

bundle! {
    struct Word<T> { x: T }
    struct Result<T> { y: T }
}

/// One word in, one word out, described by a function.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct Big(fn(Module, Signal) -> Signal);

impl Block for Big {
    type In = Word;
    type Out = Result;

    fn inputs(&self) -> Word<Width> {
        Word { x: bits(8) }
    }

    fn build(&self, m: Module, i: Word) -> Result {
        Result { y: (self.0)(m, i.x) + 0 }
    }

    fn name(&self) -> String {
        "big".to_owned()
    }
}

#[test]
fn shared_expressions_cost_once() {
    let design = elaborate(&Big(|_, x| (0..64).fold(x, |x, _| x ^ (x + x)))).unwrap();
    assert_eq!(design.top().nodes.len(), 1 + 2 * 64 + 2);
}

#[test]
fn a_chain_of_a_hundred_thousand_operators() {
    let design = elaborate(&Big(|_, x| (0..100_000).fold(x, |sum, _| sum + x))).unwrap();
    assert_eq!(design.top().nodes.len(), 1 + 100_000 + 2);
}

#[test]
fn a_chain_of_wires_in_the_wrong_order() {
    let design = elaborate(&Big(|m, x| {
        let wires: Vec<_> = (0..20_000).map(|i| m.wire(&format!("w{i}"), 8)).collect();
        wires.windows(2).for_each(|pair| pair[0].drive(pair[1]));
        wires.last().unwrap().drive(x);
        *wires[0]
    }));
    assert_eq!(design.unwrap().top().nodes.len(), 1 + 20_000 + 2);
}

#[test]
fn an_array_of_sixteen_thousand_lanes_is_one_instance() {
    /// Adds one.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Increment;
    impl Block for Increment {
        type In = Word;
        type Out = Result;
        fn inputs(&self) -> Word<Width> {
            Word { x: bits(8) }
        }
        fn build(&self, _: Module, i: Word) -> Result {
            Result { y: i.x + 1 }
        }
    }
    let design =
        elaborate(&Big(|m, x| m.array("u_cell", 16_384, &Increment, |cells| Word { x: cells.y.previous(x) }).y.last()))
            .unwrap();
    let top = design.top();
    assert_eq!((top.instances.len(), top.instances[0].shape), (1, ir::Shape::Row(16_384)));
    assert!(top.nodes.len() < 10);
}

#[test]
fn a_block_that_twice_holds_its_next_smaller_self_is_built_once_a_size() {
    thread_local!(static BUILT: std::cell::Cell<usize> = const { std::cell::Cell::new(0) });
    /// A tree of this height.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Tree(u32);
    impl Block for Tree {
        type In = Word;
        type Out = Result;
        fn inputs(&self) -> Word<Width> {
            Word { x: bits(8) }
        }
        fn build(&self, m: Module, i: Word) -> Result {
            BUILT.set(BUILT.get() + 1);
            if self.0 == 0 {
                return Result { y: !i.x };
            }
            let left = m.instance("u_left", &Tree(self.0 - 1), Word { x: i.x }).y;
            Result { y: left ^ m.instance("u_right", &Tree(self.0 - 1), Word { x: i.x + 1 }).y }
        }
    }
    let design = elaborate(&Tree(30)).unwrap();
    assert_eq!((BUILT.get(), design.modules().len()), (31, 31));
}

/// A limit that no test reaches on any busy machine; with quadratic cost, each would take minutes.
const LONG: Duration = Duration::from_secs(60);

#[track_caller]
fn is_quick(build: fn(Module, Signal) -> Signal) {
    let start = Instant::now();
    let design = elaborate(&Big(build)).unwrap();
    design.latencies();
    assert!(start.elapsed() < LONG, "{:?}", start.elapsed());
}

#[test]
fn a_concatenation_of_262144_parts() {
    is_quick(|_, x| concat(&(0..262_144).map(|part| x.bit(part % 8)).collect::<Vec<_>>()).part(100, 8));
}

#[test]
fn choices_of_100000_arms() {
    is_quick(|_, x| case(x.zext(20), (0..100_000).map(|key| (key, key % 251)), x));
    is_quick(|_, x| select((0..100_000).map(|arm| (x.bit(arm % 8), x)), 0));
}

#[test]
fn a_register_with_100000_updates() {
    is_quick(|m, x| {
        def!(held = m.reg(8).reset(0));
        let mut updates = held.when(x.bit(0), 0);
        for update in 1..100_000 {
            updates = updates.when(x.bit(update % 8), x);
        }
        *held
    });
}

#[test]
fn a_stack_of_100000_lanes() {
    is_quick(|_, x| stack((0..100_000).map(|_| x)).xor_all());
}

#[test]
fn statements_by_the_ten_thousands() {
    is_quick(|m, x| {
        for cover in 0..100_000 {
            m.cover(&format!("cover {cover}"), x.bit(cover % 8));
        }
        for past in 0..20_000 {
            m.assert(m.past(x ^ (past % 256)).eq(m.past(x ^ (past % 256))), "it is itself");
        }
        x
    });
}

#[test]
fn outputs_and_instances_by_the_thousands() {
    bundle! { struct Many<T> { ys: Vec<T> } }
    /// Gives 1,000 outputs and has 1,000 nets.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Lines;
    impl Block for Lines {
        type In = Word;
        type Out = Many;
        fn inputs(&self) -> Word<Width> {
            Word { x: bits(8) }
        }
        fn outputs(&self) -> Vec<(String, Width)> {
            Many { ys: vec![bits(8); 1_000] }.leaves()
        }
        fn build(&self, _: Module, i: Word) -> Many {
            let all = concat(&vec![i.x; 1_000]);
            Many { ys: (0..1_000).map(|at| all.part(8 * at, 8).named(&format!("line{at}"))).collect() }
        }
    }
    is_quick(|m, x| {
        let lines = m.instance("u_lines", &Lines, Word { x }).ys;
        let more = (0..40).map(|at| m.instance(&format!("u_more{at}"), &Lines, Word { x: lines[at] }).ys[at]);
        more.fold(x, |sum, line| sum ^ line)
    });
}
