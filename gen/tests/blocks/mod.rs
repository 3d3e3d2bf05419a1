//! Small blocks that the tests of this crate print.
#![allow(dead_code, missing_docs, reason = "each test uses some of them, and the names say it all")]

use tilewright_hdl::*;

block! {
    /// Counts the clocks with `enable` high and starts again at a limit.
    pub struct Counter {
        pub width: u32,
        pub limit: u64,
    }
    latency = "1 clock";
    in CounterIn {
        /// It counts.
        enable: bit(),
    }
    out(self) CounterOut {
        /// The clocks since it began.
        count: bits(self.width),
        /// It is at its limit, and begins anew with the next clock, which is said at such length that it stands above.
        wrapped: bit(),
    }
}

impl Counter {
    fn build(&self, m: Module, i: CounterIn) -> CounterOut {
        let count = m.reg("count", self.width).reset(0);
        def!(at_end = count.eq(self.limit - 1));
        count.enable(i.enable).next(mux(at_end, 0, count + 1));
        CounterOut { count: *count, wrapped: at_end & i.enable }
    }
}

codes! {
    /// What the pump does.
    pub enum Phase { Idle, Fill, Drain }
}

block! {
    /// A state machine.
    pub struct Pump;
    in PumpIn { start: bit(), full: bit(), empty: bit() }
    out PumpOut { busy: _, valve: _ }
}

impl Pump {
    fn build(&self, m: Module, i: PumpIn) -> PumpOut {
        let phase = m.fsm("phase", Phase::Idle);
        phase.next(|phase| match phase {
            Phase::Idle => when(i.start & !i.full, Phase::Fill).or_when(i.start, Phase::Drain),
            Phase::Fill => when(i.full, Phase::Drain),
            Phase::Drain => when(i.empty, Phase::Idle),
        });
        let valve = phase.pick(|phase| lit(4, [0, 0b0011, 0b1100][phase.code() as usize]));
        PumpOut { busy: !phase.is(Phase::Idle), valve }
    }
}

block! {
    /// A line buffer of 1000 words and a table.
    pub struct LineBuffer;
    in LineIn { write: bit(), write_x: bits(10), z: bits(24), x: bits(10), gain: bits(2) }
    out LineOut { nearest: _, scaled: _ }
}

impl LineBuffer {
    fn build(&self, m: Module, i: LineIn) -> LineOut {
        let line = m.memory("line", 1000, 24, ReadUnderWrite::Any).fill(Bits::ones(24));
        line.write(i.write, i.write_x, i.z);
        let gains = m.memory("gains", 4, 8, ReadUnderWrite::Old).words([1, 2, 4, 8]);
        let nearest = line.read(i.x);
        let scaled = nearest.times(gains.read_async(i.gain));
        LineOut { nearest, scaled }
    }
}

block! {
    /// A cell of a systolic row.
    pub struct Cell;
    in CellIn { op: bit(), x: bits(4), left: bits(8), weight: bits(8) }
    out CellOut { q: _, hit: _, sum: _ }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let q = m.reg("q", 8);
        q.next(mux(i.op, i.left + i.x.zext(8), q));
        CellOut { q: *q, hit: q.eq(i.left), sum: (i.left ^ i.weight) + q }
    }
}

block! {
    /// A chain of cells.
    pub struct Row { pub lanes: u32 }
    in RowIn { op: bit(), seed: bits(8) }
    out RowOut { any: _, all: _, last: _, total: _, third: _ }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let cells = m.array("u_cell", self.lanes, &Cell, |row| CellIn {
            op: i.op,
            x: constants(bits(4).of(self.lanes), u64::from),
            left: row.sum.previous(i.seed),
            weight: constants(bits(8).of(self.lanes), |lane| u64::from(lane * lane % 7 * 31)),
        });
        RowOut {
            any: cells.hit.or_all(),
            all: cells.hit.and_all(),
            last: cells.q.last(),
            total: cells.q.sum(),
            third: cells.sum.lane(2),
        }
    }
}

bundle! {
    pub struct Pair<T> { pub a: T, pub b: T }
    pub struct One<T> { pub y: T }
}

/// A block of two inputs of 8 bits and one output, described by a function.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
pub struct Small {
    pub name: &'static str,
    pub build: fn(Module, Pair) -> Signal,
}

impl std::fmt::Debug for Small {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl Block for Small {
    type In = Pair;
    type Out = One;

    fn inputs(&self) -> Pair<Width> {
        Pair { a: bits(8), b: bits(8) }
    }

    fn build(&self, m: Module, i: Pair) -> One {
        m.ignore(&i);
        One { y: (self.build)(m, i) }
    }

    fn name(&self) -> String {
        self.name.to_string()
    }
}

block! {
    /// A count of one clock, sampled by another.
    pub struct Clocks;
    out ClocksOut { count: _, seen: _ }
}

impl Clocks {
    fn build(&self, m: Module, (): ()) -> ClocksOut {
        let count = m.reg("count", 8);
        count.next(count + 1);
        let seen = m.on(Clock::new("slow", Period::ns(14))).reg("seen", 8);
        seen.next(count.quasi_static("the test looks at what a race would spoil"));
        ClocksOut { count: *count, seen: *seen }
    }
}

block! {
    /// Registers that say what they take when: alone and together, with and without reset, and one with an enable and a
    /// last word.
    pub struct Updates;
    name = "priorities";
    in UpdatesIn { clear: bit(), load: bit(), step: bit(), value: bits(8) }
    out UpdatesOut { count: _, loads: _, last: _, moved: _ }
}

impl Updates {
    fn build(&self, m: Module, i: UpdatesIn) -> UpdatesOut {
        let [count, loads] = ["count", "loads"].map(|name| m.reg(name, 8).reset(0));
        count.when(i.clear, 0).when(i.load, i.value).when(i.step, count + 1);
        loads.when(i.clear, 0).when(i.load, loads + 1);
        let last = m.reg("last", 8);
        last.when(i.load, i.value).when(i.clear, 0xff);
        let moved = m.reg("moved", 2).enable(!i.clear);
        moved.when(i.load, 2).when(i.step, 1).otherwise(0);
        UpdatesOut { count: *count, loads: *loads, last: *last, moved: *moved }
    }
}

block! {
    /// A single register by priority, after a reset.
    pub struct Latest;
    in LatestIn { forget: bit(), load: bit(), value: bits(8) }
    out LatestOut { latest: _ }
}

impl Latest {
    fn build(&self, m: Module, i: LatestIn) -> LatestOut {
        let latest = m.reg("latest", 8).reset(0);
        latest.when(i.forget, 0).when(i.load, i.value);
        LatestOut { latest: *latest }
    }
}

bundle! {
    /// A place on the screen.
    pub struct Place<T> {
        /// Counted from the left.
        pub x: T,
        /// Counted from the top.
        pub y: T,
    }

    /// A place as it is seen.
    pub struct Seen<T> {
        pub left: T,
        pub top: T,
    }
}

block! {
    /// Sends each place on, mirrored.
    pub struct Mirror;
    in MirrorIn {
        /// Where things are.
        places: [Place = Place { x: bits(8), y: bits(7) }; 2],
        /// The axis.
        axis: Place { x: bit(), y: bit() },
        /// Where there are any.
        valid: [bit(); 2],
    }
    out MirrorOut {
        /// Where they look to be.
        places: [Seen] = _,
        /// Some are seen.
        seen: bit(),
    }
}

impl Mirror {
    pub fn build(&self, _: Module, i: MirrorIn) -> MirrorOut {
        let flip = |flips, value: Signal| mux(flips, !value, value);
        let see = |place: &Place| Seen { left: flip(i.axis.x, place.x), top: flip(i.axis.y, place.y) };
        let places = i.places.iter().map(see);
        MirrorOut { places: places.collect(), seen: i.valid[0] | i.valid[1] }
    }
}
