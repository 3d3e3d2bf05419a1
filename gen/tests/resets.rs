//! Each kind of reset in the Verilog and its testbench.

use tilewright_gen::{testbench, tools, verilog};
use tilewright_hdl::recording::Step;
use tilewright_hdl::*;

codes! { enum Way { Left, Right } }

block! {
    /// A counter, a pipeline, lanes, a state machine and a statement.
    struct Kinds;
    in KindsIn { enable: bit() }
    out KindsOut { count: bits(4), late: bits(4), all: bits(12), way: _ }
}

impl Kinds {
    fn build(&self, m: Module, i: KindsIn) -> KindsOut {
        def!(count = m.reg(4).reset(9));
        count.enable(i.enable).next(count + 1);
        def!(late = m.pipe(*count));
        def!(ring = m.reg(bits(4).of(row(3))).reset_each([7, 8, 9]));
        ring.next(ring.previous(ring.last()));
        def!(way = m.reg(one_of::<Way>()).reset(Way::Right));
        way.when(i.enable, Way::Left);
        m.assert(m.past(i.enable).implies(count.ne(m.past(*count))), "it counts");
        KindsOut { count: *count, late, all: ring.pack(), way: *way }
    }
}

fn design(reset: Reset) -> Design {
    elaborate_at(&Kinds, DefaultClock::new(DEFAULT_PERIOD).reset(reset)).unwrap()
}

/// The same design on a clock whose registers act where it falls.
fn falling(reset: Reset) -> Design {
    elaborate_at(&Kinds, DefaultClock::new(DEFAULT_PERIOD).reset(reset).falling()).unwrap()
}

fn text(reset: Reset) -> String {
    verilog(&design(reset))[0].text.clone()
}

/// The line that contains this, without what the place adds.
fn line<'a>(text: &'a str, part: &str) -> &'a str {
    let found = text.lines().find(|line| line.contains(part)).unwrap_or_else(|| panic!("no {part} in {text}"));
    found.split("//").next().unwrap().trim()
}

#[test]
fn registers_with_a_reset_wait_for_it_and_others_do_not() {
    for (reset, events, condition, runs) in [
        (Reset::Synchronous, "posedge clk", "if (rst) ", "!rst && "),
        (Reset::SynchronousLow, "posedge clk", "if (!rst_n) ", "rst_n && "),
        (Reset::Asynchronous, "posedge clk or posedge rst", "if (rst) ", "!rst && "),
        (Reset::AsynchronousLow, "posedge clk or negedge rst_n", "if (!rst_n) ", "rst_n && "),
    ] {
        let text = text(reset);
        let port = if reset.is_active_low() { "rst_n" } else { "rst" };
        assert!(text.contains(&format!("    input  wire        {port},\n")), "{text}");
        assert!(text.contains(&format!("always @({events}) begin\n        {condition}count <= 4'd9;\n")), "{text}");
        assert!(text.contains("always @(posedge clk) begin\n        late <= count;\n"), "{text}");
        assert!(text.contains(&format!("if ({runs}")), "{text}");
        assert!(!text.contains("initial count"), "{text}");
    }
}

#[test]
fn without_a_reset_its_values_are_those_at_power_on() {
    let text = text(Reset::PowerOn);
    assert!(!text.contains("rst"), "{text}");
    assert_eq!(line(&text, "initial count"), "initial count = 4'd9;");
    assert_eq!(line(&text, "initial way"), "initial way = WAY_RIGHT;");
    assert!(text.contains("always @(posedge clk) begin\n        if (enable) count <= count + 4'd1;\n"), "{text}");
    assert_eq!(line(&text, "initial ring"), "initial ring = ring_reset[3:0];");
}

#[test]
fn a_value_that_nothing_takes_is_not_printed() {
    block! {
        /// Lanes with values at power-on and after a reset.
        struct Both;
        out BothOut { all: bits(12) }
    }
    impl Both {
        fn build(&self, m: Module, _: ()) -> BothOut {
            def!(ring = m.reg(bits(4).of(row(3))).initial(1).reset_each([7, 8, 9]));
            ring.next(ring.previous(ring.last()));
            BothOut { all: ring.pack() }
        }
    }
    let text = |reset| {
        let design = elaborate_at(&Both, DefaultClock::new(DEFAULT_PERIOD).reset(reset)).unwrap();
        verilog(&design)[0].text.clone()
    };
    assert!(text(Reset::Asynchronous).contains("ring_reset"));
    let text = text(Reset::PowerOn);
    assert!(text.contains("initial ring = 4'd1;") && !text.contains("ring_reset"), "{text}");
}

/// The recorded steps of a run, with the reset active at the second and third.
fn run(reset: Reset) -> Recording {
    let step = |(time, (resets, [count, late, all, way])): (u64, (bool, [u64; 4]))| Step {
        time_ps: time * 10_000,
        rising: vec![0],
        resets: if resets && reset.has_port() { vec![0] } else { vec![] },
        inputs: vec![Bits::new(1, 1)],
        outputs: vec![Bits::new(4, count), Bits::new(4, late), Bits::new(12, all), Bits::new(1, way)],
    };
    let (before, after): ([_; 2], [_; 2]) = match reset {
        // At the second step the registers are set already.
        Reset::Asynchronous | Reset::AsynchronousLow => {
            ([[9, 0, 0x987, 1], [9, 9, 0x987, 1]], [[9, 9, 0x987, 1], [9, 9, 0x987, 1]])
        }
        Reset::Synchronous | Reset::SynchronousLow => {
            ([[9, 0, 0x987, 1], [10, 9, 0x879, 0]], [[9, 10, 0x987, 1], [9, 9, 0x987, 1]])
        }
        Reset::PowerOn => ([[9, 0, 0x987, 1], [10, 9, 0x879, 0]], [[11, 10, 0x798, 0], [12, 11, 0x987, 0]]),
    };
    let states = before.into_iter().chain(after);
    let steps = (1..).zip([false, true, true, false].into_iter().zip(states)).map(step);
    Recording { steps: steps.collect(), initial: vec![] }
}

#[test]
fn a_falling_clock_has_the_other_edge_everywhere() {
    for reset in Reset::ALL {
        let (rising, falling) = (text(reset), verilog(&falling(reset))[0].text.clone());
        assert_eq!(rising.replace("posedge clk", "negedge clk"), falling, "{reset:?}");
        // Registers with a reset and without one, and statements for formal tools and for simulators.
        assert!(falling.matches("negedge clk").count() >= 4, "{falling}");
    }
}

/// At a recorded step either clock has its edge.
#[test]
fn a_testbench_drives_each_kind() {
    for (reset, design) in Reset::ALL.into_iter().flat_map(|reset| [(reset, design(reset)), (reset, falling(reset))]) {
        let (files, bench) = (verilog(&design), testbench(&design, &run(reset)));
        let _ = tools::replay_in_icarus(&files, &bench).unwrap_or_else(|problem| panic!("{reset:?}: {problem}"));
    }
}

/// Verilator takes seconds, so it takes one kind here; random designs have all.
#[test]
fn verilator_resets_asynchronously() {
    let (design, recording) = (falling(Reset::AsynchronousLow), run(Reset::AsynchronousLow));
    let _ = tools::replay_in_verilator(&verilog(&design), &testbench(&design, &recording)).unwrap();
}

#[test]
fn a_testbench_tells_the_kinds_apart() {
    let (sound, recording) = (design(Reset::Synchronous), run(Reset::Asynchronous));
    match tools::replay_in_icarus(&verilog(&sound), &testbench(&sound, &recording)) {
        Ok(checked) => assert_eq!(checked, tools::Checked::Skipped),
        Err(problem) => assert!(problem.to_string().contains("FAIL: cycle 1: count is a, expected 9"), "{problem}"),
    }
}

#[test]
fn no_linter_complains_of_any_kind() {
    let kinds = Reset::ALL.into_iter().flat_map(|reset| [(reset, design(reset)), (reset, falling(reset))]);
    let (kinds, designs): (Vec<Reset>, Vec<_>) = kinds.map(|(reset, design)| (reset, verilog(&design))).unzip();
    let files: Vec<&[_]> = designs.iter().map(|files| &files[..]).collect();
    if let Err(problems) = tools::lint_all(&files) {
        let first = problems.into_iter().map(|(of, problem)| format!("{:?}: {problem}", kinds[of])).next();
        panic!("{}", first.unwrap());
    }
}

codes! { enum Light { Red, Green, Blue } }

block! {
    /// A register of codes that no reset sets: its reset value is in no line.
    struct Unset;
    in UnsetIn { go: bit() }
    out UnsetOut { light: _ }
}

impl Unset {
    fn build(&self, m: Module, i: UnsetIn) -> UnsetOut {
        def!(light = m.reg(one_of::<Light>()).reset(Light::Green).initial(Light::Red));
        light.when(i.go, Light::Blue);
        UnsetOut { light: *light }
    }
}

#[test]
fn a_code_that_no_line_mentions_is_not_declared() {
    let files = verilog(&elaborate_at(&Unset, DefaultClock::new(DEFAULT_PERIOD).reset(Reset::PowerOn)).unwrap());
    tools::lint(&files).unwrap_or_else(|problems| panic!("{problems}\n{}", files[0].text));
    let text = &files[0].text;
    assert!(text.contains("initial light = LIGHT_RED;"), "{text}");
    assert!(text.contains("    // Not used here: LIGHT_GREEN = 1.\n"), "{text}");
}
