//! Descriptions of a size that would show anything worse than linear.

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
