//! Blocks that the examples of this crate run.

use tilewright_circuit::ReadUnderWrite;
use tilewright_hdl::catalog::{Entry, Parameter};
use tilewright_hdl::{DEFAULT_PERIOD, Module, Script, bit, bits, block, def, elaborate};

block! {
    /// Counts, and squares the count.
    pub struct Counter;
    in CounterIn {
        /// Counts while high.
        enable: bit(),
    }
    out CounterOut {
        /// The count.
        count: bits(8),
        /// The square of its lower 4 bits.
        square: bits(8),
    }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        def!(count = m.reg(8).reset(0));
        count.when(i.enable, count + 1);
        m.assert(count.lt(200), "it counts to less than 200");
        let _ = m.pipe("late", *count);
        def!(squares = m.memory(16, 8, ReadUnderWrite::Any));
        let squares = squares.words((0..16).map(|x| x * x));
        def!(square = squares.read_async(count.trunc(4)));
        CounterOut { count: *count, square }
    }
}

/// The counter, whose scenario has a parameter for its clocks.
pub const COUNTER: Entry = Entry {
    name: "counter",
    summary: "counts",
    parameters: &[Parameter { name: "clocks", default: 4, min: 1, max: 100, meaning: "how long it counts" }],
    design: |_| Ok(elaborate(&Counter)?),
    scenario: |values| {
        let mut script = Script::new(&Counter, DEFAULT_PERIOD);
        script.hold(&CounterIn { enable: 1 }, values.get("clocks"));
        Ok(script.finish("it counts"))
    },
};

block! {
    /// The products of two lists, element by element, and of two rows, lane by lane.
    pub struct Products;
    in ProductsIn {
        /// A list of factors.
        left: [bits(8); 3],
        /// A list of factors.
        right: [bits(8); 3],
        /// A row of factors.
        lanes: bits(8).of(4),
    }
    out ProductsOut {
        /// Element by element.
        products: [bits(16); 3],
        /// Lane by lane.
        squares: bits(16).of(4),
    }
}

impl Products {
    fn build(&self, _: Module, i: ProductsIn) -> ProductsOut {
        let products = i.left.iter().zip(&i.right).map(|(left, right)| *left * *right).collect();
        ProductsOut { products, squares: i.lanes * i.lanes }
    }
}

block! {
    /// Adds one to each word.
    pub struct Increment;
    in IncrementIn {
        /// The stream that comes in.
        words: stream(8),
    }
    out IncrementOut {
        /// Each word plus one.
        sums: stream(8),
    }
}

impl Increment {
    fn build(&self, m: Module, i: IncrementIn) -> IncrementOut {
        def!(full = m.reg(bit()).reset(0));
        def!(sum = m.reg(8));
        let (sums, sent) = m.offer(full, *sum);
        let words = i.words.take_when(!full | sent);
        sum.when(words.taken, *words + 1);
        full.when(words.taken, 1).when(sent, 0);
        IncrementOut { sums }
    }
}

block! {
    /// Delays each word by a clock.
    pub struct Delay;
    in DelayIn {
        /// The input.
        word: bits(8),
    }
    out DelayOut {
        /// The previous input.
        late: bits(8),
    }
}

impl Delay {
    fn build(&self, m: Module, i: DelayIn) -> DelayOut {
        DelayOut { late: m.pipe("held", i.word) }
    }
}
