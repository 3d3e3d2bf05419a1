//! A coverage test: for each window of the screen, it sends the quarters that a triangle may cover. Two of them in
//! sequence are connected by their streams. `cargo run -p tilewright-hdl --example windows`

use tilewright_hdl::*;
use tilewright_sim::{Pauses, Simulation};

record! {
    /// A square of the screen.
    struct Window {
        /// The column of its left pixels.
        x: bits(5),
        /// The row of its lowest pixels.
        y: bits(5),
        /// The largest value of each edge function of the triangle in it.
        edges: bits(12).signed().of(row(3)),
    }
}

/// The edge functions are `a x + b y + c`; inside of the triangle, none is negative. This is `(a, b)` of each.
const SLOPES: [(i64, i64); 3] = [(1, 0), (0, 1), (-1, -1)];

impl Window {
    /// A quarter of a window that is twice as wide as `half`.
    fn quarter(&self, number: Signal, half: u32) -> Window {
        let place = |upper: Signal| upper.zext(5) << half.ilog2();
        // An edge function is smaller in the half that it points away from.
        let less = |quarter: u64| {
            let [right, upper] = [quarter & 1 == 1, quarter >> 1 == 1];
            let along = |slope: i64, upper: bool| if (slope > 0) == upper { 0 } else { slope.unsigned_abs() };
            let less = |(a, b): (i64, i64)| (along(a, right) + along(b, upper)) * u64::from(half);
            constants(bits(12).of(row(3)), |edge| less(SLOPES[edge as usize])).signed()
        };
        let edges = self.edges - case(number, [(0, less(0)), (1, less(1)), (2, less(2))], less(3));
        Window { x: self.x | place(number.bit(0)), y: self.y | place(number.bit(1)), edges }
    }
}

block! {
    /// Sends the quarters of windows that are twice as wide as `half`, one a clock.
    struct CoverageTest {
        half: u32,
    }
    in TestIn { windows: stream(Window) }
    out TestOut { quarters: stream(Window) }
}

impl CoverageTest {
    fn build(&self, m: Module, i: TestIn) -> TestOut {
        def!(busy = m.reg(bit()).reset(0));
        def!(held = m.reg(Window::widths()));
        def!(number = m.reg(2).reset(0));
        def!(quarter = held.quarter(*number, self.half));
        def!(covers = !quarter.edges.is_negative().or_all());
        let (quarters, sent) = m.offer(busy & covers, quarter);
        def!(tested = sent | (busy & !covers));
        def!(ends = tested & number.all_ones());
        let next = i.windows.take_when(!busy | ends);
        held.when(next.taken, *next);
        number.when(next.taken, 0).when(tested, number + 1);
        busy.when(next.taken, 1).when(ends, 0);
        TestOut { quarters }
    }
}

block! {
    /// From windows of 8 x 8 pixels to those of 2 x 2.
    struct TwoLevels;
    in = TestIn { windows: stream(Window::widths()) };
    out = TestOut { quarters: stream(Window::widths()) };
}

impl TwoLevels {
    fn build(&self, m: Module, i: TestIn) -> TestOut {
        def!(upper = m.instance(&CoverageTest { half: 4 }, i));
        def!(lower = m.instance(&CoverageTest { half: 2 }, TestIn { windows: upper.quarters }));
        lower
    }
}

/// Runs it; a test does so too.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut sim = Simulation::of(&TwoLevels)?;
    sim.reset();
    let wave =
        sim.record(["windows_valid", "windows_ready", "quarters_valid", "quarters_ready", "quarters_x", "quarters_y"]);
    // The triangle x >= 1, y >= 1, x + y <= 6, in the window of the pixels from 0 to 7.
    let (windows, quarters) = (sim.i.windows, sim.o.quarters);
    sim.set_lanes(windows.edges, [7 - 1, 7 - 1, 6]);
    let edges = sim.get(windows.edges).to_u64().expect("they are 36 bits");
    let t = sim.testbench();
    let send = t.send(windows, Window { x: 0, y: 0, edges });
    let receive = t.receive_all(quarters, 10, Pauses::percent(33, 1));
    let ((), leaves) = t.run((send, receive));
    let leaves: Vec<_> = leaves.iter().map(|leaf| (leaf.x, leaf.y)).collect();
    assert_eq!(leaves, [(0, 0), (2, 0), (0, 2), (2, 2), (4, 0), (6, 0), (4, 2), (0, 4), (2, 4), (0, 6)]);
    println!("{wave}");
    print!("{}", tilewright_gen::verilog(&elaborate(&TwoLevels)?)[1].text);
    Ok(())
}
