//! Modules written by hand are equal to designs, or a run shows where they differ.

use crate::harness::design;
use std::path::PathBuf;
use tempfile::TempDir;
use tilewright_gen::tools::skipped_without;
use tilewright_hdl::*;
use tilewright_prove::{Difference, Equivalence, Error, Stage, Verdict};

block! {
    /// Counts to `limit - 1`, and keeps what was counted last.
    struct Counter { limit: u64 }
    in CounterIn { enable: bit() }
    out(self) CounterOut { count: below(self.limit), last: below(self.limit) }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        def!(count = m.reg(below(self.limit)).reset(0));
        count.when(i.enable & count.eq(self.limit - 1), 0).when(i.enable, count + 1);
        CounterOut { count: *count, last: m.pipe("last", *count) }
    }
}

/// A counter by hand, whose register `last` has no reset either.
const COUNTER: &str = "
module counted #(parameter LIMIT = 6) (
    input            clk, rst, enable,
    output reg [2:0] count, last
);
    wire [2:0] next;
    following #(.LIMIT(LIMIT)) f (.count(count), .next(next));
    always @(posedge clk) begin
        last <= count;
        if (rst) count <= 0;
        else if (enable) count <= next;
    end
endmodule
module following #(parameter LIMIT = 6) (input [2:0] count, output [2:0] next);
    assign next = count == LIMIT - 1 ? 0 : count + 1;
endmodule
";

/// A folder with a file.
fn hand(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("hand.v");
    std::fs::write(&file, text).unwrap();
    (folder, file)
}

fn lacks_tools() -> bool {
    skipped_without(&["yosys", "yosys-abc"]).is_some()
}

/// The run by which a file differs from a design.
#[track_caller]
fn difference(design: &Design, text: &str) -> Box<Difference> {
    let (_folder, file) = hand(text);
    match Equivalence::to([&file]).prove(design) {
        Ok(Verdict::Differs(run)) => run,
        other => panic!("{other:?}"),
    }
}

#[track_caller]
fn refusal(design: &Design, text: &str) -> String {
    let (_folder, file) = hand(text);
    match Equivalence::to([&file]).prove(design) {
        Err(Error::Refused(sentence)) => sentence.replace(&file.display().to_string(), "hand.v"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn equal_modules_are_proved_equal_and_parameters_decide() {
    if lacks_tools() {
        return;
    }
    let (_folder, file) = hand(COUNTER);
    let design = design(&Counter { limit: 6 });
    let equal = Equivalence::to([&file]).prove(&design).unwrap();
    assert!(matches!(equal, Verdict::Equal), "{equal:?}");
    let other = Equivalence::to([&file]).module("counted").parameter("LIMIT", 5).prove(&design).unwrap();
    let Verdict::Differs(run) = other else { panic!("{other:?}") };
    // A clock of reset, and five in which it counts.
    assert_eq!((run.module.as_str(), run.clock, &run.outputs[..]), ("counted", 6, &["count".to_owned()][..]));
    let counts = |values: &[Bits]| values.iter().map(|it| it.to_u64().unwrap()).collect::<Vec<_>>();
    assert_eq!(counts(&run.theirs[0].clocks), [0, 0, 1, 2, 3, 4, 0]);
    let ours: Vec<Bits> = run.recording.steps.iter().map(|step| step.outputs[0].clone()).collect();
    assert_eq!(counts(&ours), [0, 0, 1, 2, 3, 4, 5]);
    tilewright_sim::Simulation::from_design(&design).unwrap().replay(&run.recording).unwrap();
}

#[test]
fn a_reset_that_does_not_always_reset_is_found() {
    if lacks_tools() {
        return;
    }
    let run = difference(&design(&Counter { limit: 6 }), &COUNTER.replace("if (rst)", "if (rst && last == 0)"));
    assert!(run.recording.steps.iter().skip(1).any(|step| !step.resets.is_empty()), "{run:?}");
}

#[test]
fn what_depends_on_an_undefined_value_differs() {
    if lacks_tools() {
        return;
    }
    let text = COUNTER.replace("last <= count;", "last <= enable ? count : 3'bx;");
    assert_eq!(difference(&design(&Counter { limit: 6 }), &text).outputs, ["last"]);
}

/// Each mistake in the file, and what the sentence says.
#[test]
fn mistakes_in_the_file_are_named_with_their_places() {
    if lacks_tools() {
        return;
    }
    let design = design(&Counter { limit: 6 });
    for (from, to, sentence) in [
        ("endmodule\nmodule", "module", "hand.v:13: syntax error"),
        ("endmodule\nmodule", "absent a();\nendmodule\nmodule", "`counted` contains a `absent`"),
        ("enable,\n", "enable, spare,\n", "hand.v:3: counter_limit6 has no port `spare`"),
        (" count, last", " last", "hand.v:2: `counted` has no port `count`, which is an output of 3 bits"),
        ("[2:0] count, last", "[3:0] count, last", "hand.v:4: `count` has 4 bits, and 3 bits in counter_limit6"),
        ("enable,\n    output reg", "\n    output reg enable, output reg", "`enable` is output, and an input in"),
        ("posedge clk", "negedge clk", "hand.v:8: this is at the other edge of `clk`"),
        ("posedge clk", "posedge enable", "hand.v:8: this is on another clock than `clk`"),
        ("last <= count;", "last <= clk;", "`clk` is used as a value here"),
        ("last <= count;\n", "last <= big[count];\n", "have 131072 bits, and a proof takes 65536"),
    ] {
        let mut text = COUNTER.replacen(from, to, 1);
        assert_ne!(text, COUNTER);
        if to.contains("big") {
            text = text.replacen(
                "wire [2:0] next;",
                "wire [2:0] next; reg [31:0] big [0:4095]; always @(posedge clk) big[count] <= 0;",
                1,
            );
        }
        let said = refusal(&design, &text);
        assert!(said.contains(sentence), "{sentence}\n{said}");
    }
    let (_folder, file) = hand(COUNTER);
    for (asked, sentence) in [
        (Equivalence::to([&file]).parameter("WIDTH", 5), "the module has no parameter `WIDTH`"),
        (Equivalence::to([&file]).module("hand"), "there is no module `hand`: choose one of"),
        (Equivalence::to([&file]).begin("start", 1), "has no input `start`: name one of enable"),
        (Equivalence::to([&file]).begin("enable", 2), "2 has no room in the 1 bits of `enable`"),
        (Equivalence::to(["absent.v"]), "absent.v: cannot be read"),
    ] {
        let Err(Error::Refused(said)) = asked.prove(&design) else { panic!("{sentence}") };
        assert!(said.contains(sentence), "{sentence}\n{said}");
    }
}

block! {
    /// Two products of a pair: without a clock, and with lanes.
    struct Products;
    in ProductsIn { left: bits(4).of(row(2)), right: bits(4).of(row(2)) }
    out ProductsOut { products: bits(8).of(row(2)) }
}

impl Products {
    fn build(&self, _: Module, i: ProductsIn) -> ProductsOut {
        ProductsOut { products: i.left.times(i.right) }
    }
}

#[test]
fn lanes_are_in_one_vector_and_no_clock_is_needed() {
    if lacks_tools() {
        return;
    }
    let text = "module m(input [7:0] left, right, output [15:0] products);
        assign products = {8'd0 + left[7:4] * right[7:4], 8'd0 + left[3:0] * right[3:0]}; endmodule";
    let (_folder, file) = hand(text);
    let found = Equivalence::to([&file]).prove(&design(&Products)).unwrap();
    assert!(matches!(found, Verdict::Equal), "{found:?}");
    let run = difference(&design(&Products), &text.replace("left[7:4] *", "left[7:4] &"));
    assert_eq!((run.clock, run.theirs[0].clocks[0].width()), (0, 16));
}

block! {
    /// Divides, where the divisor is assumed not to be 0.
    struct Half;
    in HalfIn { word: bits(3), zero: bit() }
    out HalfOut { halved: bits(3) }
}

impl Half {
    fn build(&self, m: Module, i: HalfIn) -> HalfOut {
        m.assume(!i.zero, "the word is not zero");
        def!(halved = m.reg(3));
        halved.next(i.word.slice(1..3).zext(3));
        HalfOut { halved: *halved }
    }
}

#[test]
fn modules_are_compared_where_the_assumptions_hold() {
    if lacks_tools() {
        return;
    }
    let text = "module m(input clk, rst, input [2:0] word, input zero, output reg [2:0] halved);
        always @(posedge clk) halved <= zero && !rst ? 3'd7 : word >> 1; endmodule";
    let (_folder, file) = hand(text);
    let found = Equivalence::to([&file]).prove(&design(&Half)).unwrap();
    assert!(matches!(found, Verdict::Equal), "{found:?}");
    // A search of one clock that leaves no time for a proof knows little.
    let deep = text.replace("reg [2:0] halved);", "reg [2:0] halved); reg [39:0] n; always @(posedge clk) n <= n + 1;");
    let deep = deep.replace("zero && !rst ?", "n[39:8] == 77 ?");
    let (_folder, file) = hand(&deep);
    let open = Equivalence::to([&file]).depth(3).seconds(2).prove(&design(&Half)).unwrap();
    assert!(matches!(open, Verdict::Open { clocks: ..=3, .. }), "{open:?}");
    // Without any, Yosys does not end.
    let open = Equivalence::to([&file]).seconds(0).prove(&design(&Half)).unwrap();
    assert!(matches!(open, Verdict::Open { clocks: 0, late: Some(Stage::Conversion) }), "{open:?}");
}

const FAST: Clock = Clock::new("fast", Period::ns(3));
const SLOW: Clock = Clock::new("slow", Period::ns(7));

#[test]
fn a_design_of_several_clocks_is_refused() {
    block! {
        /// A bit on each of two clocks.
        struct Two;
        in TwoIn { a: bit().on(FAST), b: bit().on(SLOW) }
        out TwoOut { one: bit(), other: bit() }
    }
    impl Two {
        fn build(&self, m: Module, i: TwoIn) -> TwoOut {
            TwoOut { one: m.on(FAST).pipe("one", i.a), other: m.on(SLOW).pipe("other", i.b) }
        }
    }
    let said = refusal(&elaborate(&Two).unwrap(), "module hand; endmodule");
    let expected =
        "`two` has several clocks (fast_clk, slow_clk), and modules of one clock are compared: compare its blocks";
    assert_eq!(said, expected);
}
