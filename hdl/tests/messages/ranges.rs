//! Parameters that are out of their ranges.

use crate::messages::common::*;
use tilewright_hdl::*;

block! {
    /// Stores words.
    struct Queue {
        depth: u32,
        width: u32,
        gap: i32,
        /// In thousandths.
        r#loop: u16,
    }
    in(self) QueueIn { word: bits(self.width) }
    ranges(self) {
        depth: 2..=8,
        /// A word has bits, and [`u64`] can represent it.
        ///
        /// So do tests.
        width: 1..65,
        gap: ..=-1,
        r#loop: ..1000,
    }
    out QueueOut { shown: _ }
}

impl Queue {
    fn build(&self, m: Module, i: QueueIn) -> QueueOut {
        let most = self.width - 1;
        QueueOut { shown: m.pipe("held", i.word) & lit(i.word.width(), most) }
    }
}

const QUEUE: Queue = Queue { depth: 2, width: 8, gap: -1, r#loop: 0 };

#[test]
fn the_first_parameter_out_of_its_range_is_named_with_what_would_do() {
    assert_eq!(QUEUE.clone().checked(), Ok(QUEUE));
    let problem = |queue: Queue| queue.checked().unwrap_err().to_string();
    assert_eq!(problem(Queue { depth: 9, ..QUEUE }), "`depth` of `Queue` is 9: it has to be from 2 to 8");
    assert_eq!(
        problem(Queue { width: 65, ..QUEUE }),
        "`width` of `Queue` is 65: it has to be at least 1 and below 65. A word has bits, and `u64` can represent it."
    );
    assert_eq!(problem(Queue { gap: 0, ..QUEUE }), "`gap` of `Queue` is 0: it has to be at most -1");
    assert_eq!(problem(Queue { r#loop: 1000, ..QUEUE }), "`loop` of `Queue` is 1000: it has to be below 1000");
}

block! {
    /// Draws.
    struct Renderer { side: u32, line: i16, edge: u8, any: u64 }
    ranges {
        side: powers_of_two(2..=256),
        /// A line is sent 8 pixels at a time.
        line: multiples_of(8, -16..64),
        edge: any_of([4, 8, 16]),
        any: powers_of_two(..),
    }
    name(self) = format!("renderer_{}", self.side);
}

impl Renderer {
    fn build(&self, _: Module, (): ()) {}
}

#[test]
fn parameters_that_are_powers_multiples_or_a_few_values() {
    const RENDERER: Renderer = Renderer { side: 2, line: -8, edge: 16, any: 1 << 63 };
    assert_eq!(RENDERER.clone().checked(), Ok(RENDERER));
    let problem = |renderer: Renderer| renderer.checked().unwrap_err().to_string();
    for (side, line, edge) in [(256, 56, 4), (16, 0, 8)] {
        assert!(Renderer { side, line, edge, ..RENDERER }.checked().is_ok(), "{side} {line} {edge}");
    }
    for side in [0, 1, 3, 255, 512] {
        let sentence = format!("`side` of `Renderer` is {side}: it has to be a power of two, from 2 to 256");
        assert_eq!(problem(Renderer { side, ..RENDERER }), sentence);
    }
    for line in [-24, 4, 64] {
        let sentence = "it has to be a multiple of 8, at least -16 and below 64. A line is sent 8 pixels at a time.";
        assert!(problem(Renderer { line, ..RENDERER }).ends_with(sentence), "{line}");
    }
    assert!(problem(Renderer { edge: 5, ..RENDERER }).ends_with("is 5: it has to be 4, 8 or 16"));
    assert!(problem(Renderer { any: 0, ..RENDERER }).ends_with("is 0: it has to be a power of two"));
}

/// The capacities of two queues.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Queues {
    packets: u32,
    r#for: u32,
}

block! {
    /// Has queues.
    struct Processor { queues: Queues }
    ranges { queues.packets: 1..=64, queues.r#for: powers_of_two(2..) }
}

impl Processor {
    fn build(&self, _: Module, (): ()) {}
}

#[test]
fn a_range_may_be_that_of_a_field() {
    let problem = |packets, r#for| {
        let processor = Processor { queues: Queues { packets, r#for } };
        processor.checked().map_or_else(|problem| problem.to_string(), |_| String::new())
    };
    assert_eq!(problem(64, 2), "");
    assert_eq!(problem(0, 2), "`queues.packets` of `Processor` is 0: it has to be from 1 to 64");
    assert_eq!(problem(1, 3), "`queues.for` of `Processor` is 3: it has to be a power of two, at least 2");
}

#[test]
fn a_block_may_name_its_module() {
    assert_eq!(Renderer { side: 64, line: 0, edge: 4, any: 1 }.name(), "renderer_64");
}

#[test]
fn a_block_out_of_its_ranges_is_not_built() {
    expect(
        |m, i| {
            let sum = i.a + i.b;
            m.instance("u_queue", &Queue { width: 0, depth: 0, ..QUEUE }, QueueIn { word: sum }).shown
        },
        "`+` needs equal widths: `a` has 8 bits, `b` has 7 bits [T101]
         --> [let sum = i.a + i.b;]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`

         `depth` of `Queue` is 0: it has to be from 2 to 8 [T501]
         --> [m.instance(\"u_queue\", &Queue { width: 0, depth: 0, ..QUEUE }, QueueIn { word: sum }).shown]

         2 problems in this description",
    );
    let problems = elaborate(&Queue { width: 0, depth: 0, ..QUEUE }).unwrap_err();
    assert_eq!(problems.0.len(), 1, "{problems}");
    elaborate(&QUEUE).expect("the arena was cleared");
}
