//! A coverage test of windows in three forms behind one interface: a stage for each level, a stack, and side by side.
//! `docs/decisions/lines.md` shows lines of them.

use crate::streams::property::Stalls;
use crate::streams::stalls::stalls;
use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_gen::{testbench, tools, verilog};
use tilewright_hdl::*;
use tilewright_sim::{Pauses, Simulation, monitor};

bundle! {
    /// A square of the screen, `1 << level` pixels wide, and the greatest value in it of each edge function of a
    /// triangle.
    struct Window<T> { x: T, y: T, level: T, edges: T }

    struct WindowsIn<T> { windows: Stream<Window<T>, T> }
    struct WindowsOut<T> { leaves: Stream<Window<T>, T> }
}

/// Windows of 8 x 8 pixels are divided three times.
const LEVELS: u32 = 3;

/// The edge functions are `a x + b y + c`; inside the triangle none is negative. This is `(a, b)` of each.
const SLOPES: [(i64, i64); 3] = [(1, 0), (0, 1), (-1, -1)];

fn window() -> Window<Width> {
    Window { x: bits(4), y: bits(4), level: up_to(LEVELS), edges: bits(8).signed().of(row(3)) }
}

/// The decrease of an edge function's greatest value from a window to a quarter, per pixel of the quarter's width.
fn less((a, b): (i64, i64), quarter: u64) -> u64 {
    let along = |slope: i64, upper: bool| if (slope > 0) == upper { 0 } else { slope.unsigned_abs() };
    along(a, quarter & 1 == 1) + along(b, quarter >> 1 == 1)
}

impl Window {
    fn quarter(&self, number: Signal) -> Window {
        let level = self.level - 1;
        let less = |quarter| constants(bits(8).of(row(3)), |edge| less(SLOPES[edge as usize], quarter)).signed();
        let less = case(number, [(0, less(0)), (1, less(1)), (2, less(2))], less(3));
        let place = |upper: Signal| upper.zext(4) << level;
        Window {
            x: self.x | place(number.bit(0)),
            y: self.y | place(number.bit(1)),
            level,
            edges: self.edges - (less << level),
        }
    }
}

block! {
    /// Sends the quarters of each window that a triangle may cover.
    struct Test;
    in = WindowsIn { windows: stream(window()) };
    out = WindowsOut { leaves: stream(window()) };
}

impl Test {
    fn build(&self, m: Module, i: WindowsIn) -> WindowsOut {
        def!(busy = m.reg(bit()).reset(0));
        def!(held = m.reg(window()));
        def!(number = m.reg(2).reset(0));
        def!(quarter = held.quarter(*number));
        def!(covers = !quarter.edges.is_negative().or_all());
        let (leaves, sent) = m.offer(busy & covers, quarter);
        def!(tested = sent | (busy & !covers));
        def!(ends = tested & number.all_ones());
        let next = i.windows.take_when(!busy | ends);
        held.when(next.taken, *next);
        number.when(next.taken, 0).when(tested, number + 1);
        busy.when(next.taken, 1).when(ends, 0);
        WindowsOut { leaves }
    }
}

block! {
    /// Divides windows a number of times, with a stage for each.
    struct Pipe {
        levels: u32,
    }
    in = WindowsIn { windows: stream(window()) };
    out = WindowsOut { leaves: stream(window()) };
}

impl Pipe {
    fn build(&self, m: Module, i: WindowsIn) -> WindowsOut {
        let mut windows = i.windows;
        for level in 0..self.levels {
            windows = m.fifo(&format!("u_fifo{level}"), 2, windows);
            windows = m.instance(&format!("u_test{level}"), &Test, WindowsIn { windows }).leaves;
        }
        WindowsOut { leaves: windows }
    }
}

block! {
    /// Divides windows down to pixels in one unit, to which its own results return, the newest first.
    struct Stack {
        depth: u32,
    }
    in = WindowsIn { windows: stream(window()) };
    out = WindowsOut { leaves: stream(window()) };
}

impl Stack {
    fn build(&self, m: Module, i: WindowsIn) -> WindowsOut {
        def!(again = m.stream_wire(window()));
        let windows = m.arbiter("u_prefer", Turns::Priority, [*again, i.windows]);
        let quarters = m.instance("u_test", &Test, WindowsIn { windows }).leaves;
        let [inner, leaves] = m.split_by(quarters, |window| window.level.eq(0));
        again.drive(m.lifo("u_stack", self.depth, inner));
        WindowsOut { leaves }
    }
}

block! {
    /// Divides the quarters side by side, each by stages of its own.
    struct Tree;
    in = WindowsIn { windows: stream(window()) };
    out = WindowsOut { leaves: stream(window()) };
}

impl Tree {
    fn build(&self, m: Module, i: WindowsIn) -> WindowsOut {
        let quarters = m.instance("u_test", &Test, i).leaves;
        let number = |window: &Window| cat![window.y.bit(LEVELS - 1), window.x.bit(LEVELS - 1)];
        let quarters: [_; 4] = m.split_by(quarters, number);
        let pipes = m.array("u_pipe", 4, &Pipe { levels: LEVELS - 1 }, |_| WindowsIn { windows: stack(quarters) });
        WindowsOut { leaves: m.arbiter("u_arbiter", Turns::RoundRobin, pipes.leaves.lanes()) }
    }
}

/// The pixels of the triangle in a window of the largest size, sorted. `edges` are the greatest values in the window.
fn pixels(edges: [i64; 3]) -> Vec<(u64, u64)> {
    let inside = |x: i64, y: i64| {
        let last = (1 << LEVELS) - 1;
        let at = |(edge, (a, b)): (i64, (i64, i64))| {
            // `edge` is the greatest value in the window, at the corner towards which the function rises.
            let corner = |slope: i64| if slope > 0 { last } else { 0 };
            edge + a * (x - corner(a)) + b * (y - corner(b))
        };
        edges.into_iter().zip(SLOPES).all(|function| at(function) >= 0)
    };
    let all = (0..1 << LEVELS).flat_map(|y| (0..1 << LEVELS).map(move |x| (x, y)));
    let mut pixels: Vec<_> = all.filter(|&(x, y)| inside(x as i64, y as i64)).collect();
    pixels.sort_unstable();
    pixels
}

/// A form's results for triangles, and the number of clocks that it takes.
fn divided<B: Block<In = WindowsIn, Out = WindowsOut>>(
    form: &B,
    triangles: &[[i64; 3]],
    stalls: Stalls,
) -> (Vec<(u64, u64)>, u64) {
    let mut sim = Simulation::of(form).unwrap();
    sim.reset();
    drive(&mut sim, triangles, stalls)
}

fn drive(
    sim: &mut Simulation<WindowsIn, WindowsOut>,
    triangles: &[[i64; 3]],
    stalls: Stalls,
) -> (Vec<(u64, u64)>, u64) {
    let (windows, leaves) = (sim.i.windows, sim.o.leaves);
    let packed = |edges: &[i64; 3]| edges.iter().rev().fold(0, |word, edge| word << 8 | (*edge as u64 & 0xff));
    let count = triangles.iter().map(|edges| pixels(*edges).len()).sum();
    let t = sim.testbench();
    t.limit(10_000);
    let start = t.time();
    let Stalls { senders, receivers, seed } = stalls;
    let sent = triangles.iter().map(|edges| Window { x: 0, y: 0, level: LEVELS.into(), edges: packed(edges) });
    let receive = async {
        let received = t.receive_all(leaves, count, Pauses::percent(receivers, seed)).await;
        let clocks = (t.time() - start) / 10_000;
        t.expect_silence(leaves, 100).await;
        (received, clocks)
    };
    let send = t.send_all(windows, sent.collect::<Vec<_>>(), Pauses::percent(senders, seed));
    let ((), (received, clocks), ()) = t.run((send, receive, monitor(t.holds(leaves))));
    let mut received: Vec<_> = received.iter().map(|leaf| (leaf.x, leaf.y)).collect();
    received.sort_unstable();
    (received, clocks)
}

/// The depth that a stack needs if each window is covered completely: three siblings on each level but the last, for
/// the two branches between which it alternates, and one window more.
const DEPTH: u32 = 2 * 3 * (LEVELS - 1) + 1;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn all_forms_find_the_pixels_of_triangles(
        triangles in prop::collection::vec([-2i64..20, -2i64..20, -2i64..20], 0..5),
        stalls in stalls(),
    ) {
        let mut expected: Vec<_> = triangles.iter().flat_map(|edges| pixels(*edges)).collect();
        expected.sort_unstable();
        prop_assert_eq!(&divided(&Pipe { levels: LEVELS }, &triangles, stalls).0, &expected);
        prop_assert_eq!(&divided(&Stack { depth: DEPTH }, &triangles, stalls).0, &expected);
        prop_assert_eq!(&divided(&Tree, &triangles, stalls).0, &expected);
    }
}

const NO_STALLS: Stalls = Stalls { senders: 0, receivers: 0, seed: 1 };

/// The clocks for eight windows that are covered completely.
fn whole<B: Block<In = WindowsIn, Out = WindowsOut>>(form: &B) -> u64 {
    divided(form, &[[127; 3]; 8], NO_STALLS).1
}

#[test]
fn one_unit_tests_a_quarter_a_clock_and_stages_work_at_the_same_time() {
    let tested = 8 * (4 + 16 + 64);
    assert_eq!(whole(&Stack { depth: DEPTH }), tested + 1);
    assert_eq!(whole(&Pipe { levels: LEVELS }), 8 * 64 + 6);
    assert_eq!(whole(&Tree), 8 * 64 + 5);
}

#[test]
#[should_panic(expected = "ps for `leaves_valid` to be 1")]
fn a_smaller_stack_is_stuck() {
    whole(&Stack { depth: DEPTH - 1 });
}

fn icarus_repeats<B: Block<In = WindowsIn, Out = WindowsOut>>(form: &B) {
    let design = elaborate(form).unwrap();
    let mut sim = Simulation::of(form).unwrap();
    let recording = sim.recording();
    sim.reset();
    drive(&mut sim, &[[7, 7, 6], [4, 5, 9]], Stalls { senders: 20, receivers: 40, seed: 3 });
    let files = verilog(&design);
    if let Err(problems) = tools::lint(&files) {
        panic!("{form:?}: {problems}");
    }
    let bench = testbench(&design, &recording.take());
    if let Err(problems) = tools::replay_in_icarus(&files, &bench) {
        panic!("{form:?}: {problems}");
    }
}

#[test]
fn other_simulators_agree_on_all_forms() {
    icarus_repeats(&Pipe { levels: LEVELS });
    icarus_repeats(&Stack { depth: DEPTH });
    icarus_repeats(&Tree);
}
