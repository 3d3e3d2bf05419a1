//! Pipelines of records.

use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    struct Sum<T> { valid: T, sum: T, parts: [T; 2] }
    struct SumIn<T> { enable: T, start: Sum<T> }
}

/// Adds a part in each of three stages; the sum grows a bit in each.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Adder;

impl Block for Adder {
    type In = SumIn;
    type Out = Sum;

    fn inputs(&self) -> SumIn<Width> {
        SumIn { enable: bit(), start: Sum { valid: bit(), sum: bits(4), parts: [bits(4), bits(4)] } }
    }

    fn build(&self, m: Module, i: SumIn) -> Sum {
        m.stages(3, i.enable, i.start.cleared(|start| start.valid), |stage, now| {
            let part = now.parts[stage as usize % 2].zext(now.sum.width());
            Sum { sum: now.sum.add_carry(part), ..now }
        })
    }
}

#[test]
fn registers_are_named_by_field_and_stage() {
    let design = elaborate(&Adder).unwrap();
    let module = design.top();
    let names: Vec<_> = module.registers.iter().map(|register| module.register_name(register)).collect();
    let expected = ["valid", "sum", "parts_0", "parts_1"];
    assert_eq!(names, (1..=3).flat_map(|stage| expected.map(|name| format!("{name}{stage}"))).collect::<Vec<_>>());
    let resets: Vec<_> = module.registers.iter().map(|register| register.reset.is_some()).collect();
    assert_eq!(resets, [true, false, false, false].repeat(3));
}

#[test]
fn it_takes_a_record_a_clock_where_it_is_enabled() {
    let mut sim = Simulation::of(&Adder).unwrap();
    sim.reset();
    let wave = sim.record(["enable", "start_sum", "valid1", "sum1", "sum2", "valid", "sum"]);
    for (enable, valid, sum) in [(1, 1, 15), (1, 0, 0), (0, 0, 0), (1, 1, 1), (1, 0, 0), (1, 0, 0), (1, 0, 0)] {
        sim.drive(SumIn { enable, start: Sum { valid, sum, parts: [15, 1] } });
        sim.step();
    }
    wave.expect(
        r"
        clk       |~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/
        enable    |~~~~~~~~~\____/~~~~~~~~~~~~~~~~~~~~
        start_sum | f  | 0       | 1  | 0            |
        valid1    |____/~~~~\_________/~~~~\__________
        sum1      | 0  | 10 | 1       | 2  | 1       |
        sum2      | 0       | 1f      | 10 | 11 | 10 |
        valid     |___________________/~~~~\____/~~~~~
        sum       | 0                 | 20 | 11 | 12 |
        ",
    );
}

codes! { enum Mode { Idle, Load, Store } }

bundle! { struct Coded<T> { mode: T, offset: T, valid: T } }

/// In each stage, a reset clears signed fields and codes as it clears flags.
#[test]
fn fields_of_any_kind_are_cleared() {
    let example = tilewright_sim::traced(|m| {
        let start = Coded { mode: lit(2, 2).code::<Mode>(), offset: lit(4, 7).signed(), valid: lit(1, 1) };
        let end = m.stages(2, None, start.cleared(|start| start), |_, coded| coded);
        def!(is_idle = end.mode.is(Mode::Idle));
        def!(offset = end.offset);
        def!(valid = end.valid);
    });
    assert_eq!(example.values("is_idle"), [1, 1, 0]);
    assert_eq!(example.values("offset"), [0, 0, 7]);
    assert_eq!(example.values("valid"), [0, 0, 1]);
}

bundle! {
    struct AccessIn<T> { enable: T, mode: T, start: Access<T> }
    struct Access<T> { address: T, value: T }
}

block! {
    /// Values that may meet in a pipeline: those outside of it, those of the same stage, and those explicitly allowed.
    struct Allowed;
    in = AccessIn { enable: bit(), mode: bit(), start: Access { address: bits(4), value: bits(8) } };
    out AccessOut { sum: _, found: _, risen: _ }
}

impl Allowed {
    fn build(&self, m: Module, i: AccessIn) -> AccessOut {
        let words = m.memory("words", 16, 8, ReadUnderWrite::Old).fill(Bits::zero(8));
        // A read beside the first stage joins it, and so does the result of `pipe_when`.
        let found = words.read_when(i.enable, i.start.address);
        let kept = m.pipe_when(i.enable, "kept", i.start.value);
        let first = m.stages(1, i.enable, i.start, |_, access| access);
        let start = Access { value: mux(i.mode, found + kept, first.value), ..first };
        def!(late = m.stages(2, i.enable, start, |_, access| access));
        words.write(i.mode, late.address, late.value);
        // A register accumulates: it takes values of one stage and meets every stage. So does a delay with another
        // condition.
        let total = m.reg("total", 8).reset(0);
        total.when(i.mode, total + late.value);
        let other = m.pipe_when(i.mode, "other", late.value);
        // A feedback, and a neighbour in time.
        let start = Access { value: *total ^ i.start.value, ..i.start };
        def!(fed = m.stages(2, None, start, |_, access| access));
        let risen = fed.any_stage().value - i.start.value;
        AccessOut {
            sum: total ^ late.value ^ other,
            found: found & first.value,
            risen: risen ^ fed.address.any_stage().zext(8),
        }
    }
}

#[test]
fn what_is_of_one_record_or_of_none_meets() {
    elaborate(&Allowed).unwrap();
}

bundle! {
    struct StreamIn<T> { points: Stream<Pair<T>, T> }
    struct Pair<T> { x: T, y: T }
    struct StreamOut<T> { sums: Stream<Pair<T>, T> }
}

/// Adds x to y in each of two stages.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Elastic;

impl Block for Elastic {
    type In = StreamIn;
    type Out = StreamOut;

    fn inputs(&self) -> StreamIn<Width> {
        StreamIn { points: stream(Pair { x: bits(4), y: bits(4) }) }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        def!(sum = m.stream_stages(2, i.points, |_, pair| Pair { y: pair.x + pair.y, ..pair }));
        StreamOut { sums: sum }
    }
}

/// Bubbles close while the receiver waits, until all stages are full; then the sender waits.
#[test]
fn stages_of_a_stream_hold_while_the_next_one_is_full() {
    let mut sim = Simulation::of(&Elastic).unwrap();
    sim.reset();
    let o = sim.o.sums;
    let wave = sim.record([
        "points_valid",
        "points_x",
        "points_ready",
        "sum_full1",
        "sum_full2",
        "sum_y1",
        "sum_y2",
        "sums_ready",
    ]);
    for (valid, x, ready) in
        [(1, 1, 1), (0, 0, 0), (1, 2, 0), (1, 3, 0), (1, 3, 0), (1, 3, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1)]
    {
        sim.set(o.ready, ready);
        sim.drive(StreamIn { points: Stream::of(valid, Pair { x, y: 0 }) });
        sim.step();
    }
    wave.expect(
        r"
        clk          |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        points_valid |~~~\___/~~~~~~~~~~~~~~~\____________
        points_x     | 1 | 0 | 2 | 3         | 0         |
        points_ready |~~~~~~~~~~~\_______/~~~~~~~~~~~~~~~~
        sum_full1    |___/~~~\___/~~~~~~~~~~~~~~~\________
        sum_full2    |_______/~~~~~~~~~~~~~~~~~~~~~~~\____
        sum_y1       | 0 | 1     | 2         | 3         |
        sum_y2       | 0     | 2             | 4 | 6     |
        sums_ready   |~~~\_______________/~~~~~~~~~~~~~~~~
        ",
    );
}
