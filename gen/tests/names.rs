//! Names of the description that the printer, the testbench or a tool might use for something else.

use tilewright_gen::tools::{self, Problems};
use tilewright_gen::{testbench, verilog};
use tilewright_hdl::recording::Step;
use tilewright_hdl::*;

bundle! {
    struct CellIn<T> { x: T }
    struct CellOut<T> { y: T, done: T }
}

block! {
    /// Adds one.
    struct Cell;
    in = CellIn { x: bits(8) };
    out = CellOut { y: bits(8), done: bit() };
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let y = m.pipe("sum", i.x + 1);
        CellOut { y, done: y.eq(9) }
    }
}

block! {
    /// What a parent feeds its cells.
    struct Row;
    in RowIn { x: [bits(8); 4] }
    out RowOut { y: _, last: _ }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let cells = m.array("u_cell", 4, &Cell, |_| CellIn { x: stack(i.x) });
        RowOut { y: cells.y.sum(), last: cells.done.or_all() }
    }
}

fn clean<B: Block>(block: &B) -> String {
    let files = verilog(&elaborate(block).unwrap_or_else(|problems| panic!("{problems}")));
    tools::lint(&files).unwrap_or_else(|problems| panic!("{problems}\n{}", files.last().unwrap().text));
    files.into_iter().next_back().unwrap().text
}

#[test]
fn a_parents_port_may_have_the_name_of_the_port_it_feeds() {
    clean(&Row);
}

block! {
    /// Feeds cells from ports that are called as arrays call things.
    struct LanePorts;
    in LaneIn { lane: bits(8), i: bits(8), value: bits(8), leaf: bits(8), pair: bits(8), u_cell_y_sum_tree: bits(8) }
    out LaneOut { y: _, sum: _, any: _ }
}

impl LanePorts {
    fn build(&self, m: Module, i: LaneIn) -> LaneOut {
        let parts = [i.lane, i.i, i.value, i.leaf, i.pair, i.u_cell_y_sum_tree];
        let cells = m.array("u_cell", 6, &Cell, |_| CellIn { x: stack(parts) });
        let links = m.array("u_link", 3, &Cell, |row| CellIn { x: row.y.previous(i.lane) });
        LaneOut { y: links.y.last() ^ links.y.sum(), sum: cells.y.sum(), any: cells.done.or_all() }
    }
}

#[test]
fn ports_may_be_called_as_things_of_arrays_are() {
    clean(&LanePorts);
}

bundle! {
    struct LaneOfIn<T> { lane: T }
    struct LaneOfOut<T> { y: T }
}

block! {
    /// A row of cells that hold a memory called as a lane may be, in a module that has a port called as lanes are.
    struct Remembering;
    in = LaneOfIn { lane: bits(8) };
    out = LaneOfOut { y: bits(8) };
}

impl Remembering {
    fn build(&self, m: Module, i: LaneOfIn) -> LaneOfOut {
        let cells = m.array("u_cell", 3, &Remembered, |row| CellIn { x: row.y.previous(i.lane) });
        LaneOfOut { y: cells.y.sum() }
    }
}

block! {
    /// A word, a clock later.
    struct Remembered;
    in = CellIn { x: bits(8) };
    out = LaneOfOut { y: bits(8) };
}

impl Remembered {
    fn build(&self, m: Module, i: CellIn) -> LaneOfOut {
        let words = m.memory("u_lane", 4, 8, ReadUnderWrite::Old);
        words.write(i.x.bit(0), i.x.trunc(2), i.x);
        LaneOfOut { y: words.read(i.x.slice(2..4)) }
    }
}

#[test]
fn a_memory_in_a_lane_does_not_hide_the_lane() {
    assert!(clean(&Remembering).contains("remembered u_u_lane"));
}

block! {
    /// Arrays that are called as things of arrays are.
    struct Arrays;
    in = CellIn { x: bits(8) };
    out ArraysOut { result: _ }
}

impl Arrays {
    fn build(&self, m: Module, i: CellIn) -> ArraysOut {
        let names =
            ["lane", "value", "leaf", "pair", "i", "y", "done", "x_edge", "x_link", "_unused_lane", "_unused_ok"];
        let x = names.into_iter().fold(i.x, |x, name| {
            let cells = m.array(name, 3, &Cell, |row| CellIn { x: row.y.previous(x) });
            cells.y.sum() ^ cells.done.or_all().zext(8)
        });
        ArraysOut { result: x }
    }
}

#[test]
fn arrays_may_be_called_as_things_of_arrays_are() {
    clean(&Arrays);
}

block! {
    /// Its ports are called as things of a testbench are; in it are lanes and a memory that the bench sets.
    struct BenchNames;
    name = "names";
    in BenchIn {
        cycle: bit(), tb_cycle: bit(), dut: bit(), errors: bit(), want_y: bit(), lane0: bit(), run: bit(), fill: bit(),
        start_u_cell: bit(), gap: bit(), names_tb: bit(),
    }
    out BenchOut { y: _, stimulus: _, tb_want_y: _, expected: _, address: _, fill_words: _ }
}

impl BenchNames {
    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        let cells = m.array("u_cell", 2, &Cell, |_| CellIn { x: i.cycle.zext(8) });
        let words = m.memory("words", 2, 8, ReadUnderWrite::Old);
        words.write(i.tb_cycle, i.dut, cells.y.sum());
        let y = words.read(i.errors);
        BenchOut {
            y,
            stimulus: i.want_y ^ i.lane0,
            tb_want_y: i.run ^ i.fill,
            expected: i.start_u_cell ^ i.gap,
            address: i.names_tb,
            fill_words: cells.done.or_all(),
        }
    }
}

#[test]
fn ports_may_be_called_as_things_of_the_testbench_are() {
    let design = elaborate(&BenchNames).unwrap_or_else(|problems| panic!("{problems}"));
    let step = |number: u64| Step {
        time_ps: 10_000 * (number + 1),
        rising: vec![0],
        resets: vec![],
        // One input after the other is high of those that go through, two by two into an output, the last one alone.
        inputs: (0..11).map(|input| Bits::from(input == 4 + number)).collect(),
        outputs: std::iter::once(Bits::zero(8)).chain((0..5).map(|output| Bits::from(output == number / 2))).collect(),
    };
    let recording = Recording { steps: (0..7).map(step).collect(), initial: Vec::new() };
    let (files, bench) = (verilog(&design), testbench(&design, &recording));
    let run = || -> Result<(), Problems> {
        let _ = tools::replay_in_icarus(&files, &bench)?;
        let _ = tools::replay_in_verilator(&files, &bench)?;
        Ok(())
    };
    run().unwrap_or_else(|problems| panic!("{problems}\n{}", bench.text));
}

bundle! {
    struct SumIn<T> { a: T, b: T }
    struct SumOut<T> { sum: T, lane: T }
}

block! {
    /// Its output is called as its module is, another as an instance in an array.
    struct Sum;
    in = SumIn { a: bits(8), b: bits(8) };
    out = SumOut { sum: bits(8), lane: bits(8) };
}

impl Sum {
    fn build(&self, _: Module, i: SumIn) -> SumOut {
        SumOut { sum: i.a + i.b, lane: i.a ^ i.b }
    }
}

block! {
    /// An array of sums.
    struct Sums;
    in = SumIn { a: bits(8), b: bits(8) };
    out = SumOut { sum: bits(8), lane: bits(8) };
}

impl Sums {
    fn build(&self, m: Module, i: SumIn) -> SumOut {
        let all = m.array("u_sum", 3, &Sum, |row| SumIn { a: row.sum.previous(i.a), b: row.lane.previous(i.b) });
        SumOut { sum: all.sum.last(), lane: all.lane.last() }
    }
}

#[test]
fn a_port_may_have_the_name_of_its_module() {
    assert!(clean(&Sum).contains("module sum_ ("));
    clean(&Sums);
}

/// A tree of this height of instances that are called alike at each level, arrays among them; it prints in two lines.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Nest(u32);

impl std::fmt::Debug for Nest {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "nest of\n    {}", self.0)
    }
}

impl Block for Nest {
    type In = CellIn;
    type Out = CellOut;

    fn name(&self) -> String {
        format!("nest{}", self.0)
    }

    fn inputs(&self) -> CellIn<Width> {
        CellIn { x: bits(8) }
    }

    fn build(&self, m: Module, i: CellIn) -> CellOut {
        if self.0 == 0 {
            return m.instance("u_left", &Cell, i);
        }
        let left = m.instance("u_left", &Nest(self.0 - 1), CellIn { x: i.x });
        let row = m.array("u_row", 2, &Nest(self.0 - 1), |_| CellIn { x: left.y });
        CellOut { y: row.y.sum(), done: left.done | row.done.or_all() }
    }
}

#[test]
fn an_instance_may_be_called_as_one_inside_of_it() {
    clean(&Nest(2));
    let design = elaborate(&Nest(1)).unwrap();
    // The row adds one to what the left instance made of 4 a clock before.
    let step = |(number, y): (u64, u64)| Step {
        time_ps: 10_000 * (number + 1),
        rising: vec![0],
        resets: vec![],
        inputs: vec![Bits::new(8, 4)],
        outputs: vec![Bits::new(8, y), Bits::zero(1)],
    };
    let recording = Recording { steps: (0..).zip([0, 2, 12, 12]).map(step).collect(), initial: Vec::new() };
    let replayed = tools::replay_in_icarus(&verilog(&design), &testbench(&design, &recording));
    let _ = replayed.unwrap_or_else(|problems| panic!("{problems}"));
}

#[test]
fn parameters_that_print_in_several_lines_stand_in_one() {
    let text = clean(&Nest(0));
    assert!(text.contains("\n// Parameters  nest of 0\n"), "{text}");
}

bundle! {
    struct HeldOut<T> { y: T, lane: T }
}

block! {
    /// Has a port that is called as a lane may be.
    struct Shown;
    in = CellIn { x: bits(8) };
    out ShownOut { u_lane: _ }
}

impl Shown {
    fn build(&self, _: Module, i: CellIn) -> ShownOut {
        ShownOut { u_lane: i.x + 1 }
    }
}

block! {
    /// Has a port that is called as a lane is, and lanes with a net that is called as one may be.
    struct Held;
    in = CellIn { x: bits(8) };
    out = HeldOut { y: bits(8), lane: bits(8) };
}

impl Held {
    fn build(&self, m: Module, i: CellIn) -> HeldOut {
        let shown = m.array("u_shown", 2, &Shown, |row| CellIn { x: row.u_lane.previous(i.x) });
        HeldOut { y: shown.u_lane.last(), lane: shown.u_lane.sum() }
    }
}

block! {
    /// An array of arrays.
    struct Holding;
    in = CellIn { x: bits(8) };
    out = HeldOut { y: bits(8), lane: bits(8) };
}

impl Holding {
    fn build(&self, m: Module, i: CellIn) -> HeldOut {
        let held = m.array("u_held", 3, &Held, |row| CellIn { x: row.y.previous(i.x) });
        HeldOut { y: held.y.last(), lane: held.lane.sum() }
    }
}

#[test]
fn a_net_in_lanes_within_a_lane_does_not_hide_it() {
    assert!(clean(&Holding).contains("held u_u_lane"));
}

#[test]
fn an_output_of_the_name_of_a_read_is_declared_once() {
    block! {
        /// Words of a memory, read at the edge under the names of the outputs.
        struct Words;
        in WordsIn { at: below(12) }
        out WordsOut { whole: bits(8), gated: bits(8) }
    }
    impl Words {
        fn build(&self, m: Module, i: WordsIn) -> WordsOut {
            def!(few = m.memory(8, 8, ReadUnderWrite::Any).fill(1));
            def!(whole = few.read(i.at.trunc(3)));
            def!(many = m.memory(12, 8, ReadUnderWrite::Any).fill(2));
            def!(gated = many.read(i.at));
            WordsOut { whole, gated }
        }
    }
    let text = &verilog(&elaborate(&Words).unwrap())[0].text;
    assert!(text.contains("output reg  [7:0] whole") && !text.contains("    reg [7:0] whole;"), "{text}");
    assert!(text.contains("    assign gated = gated_inside ? gated_word : 8'd0;"), "{text}");
}
