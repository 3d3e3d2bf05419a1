//! A quadtree unit: finds the windows of the screen that a triangle covers.
//!
//! A window is a square of `2^level` pixels. Every clock, its four quarters are tested against the three edges: each
//! is outside, covered, or to be divided again. The unit descends into the first of the latter; the others wait on a
//! stack.

use tilewright_hdl::{
    Bits, Module, ReadUnderWrite, Reg, Signal, bit, bits, block, cat, def, index_width, lit, mux, select,
};

use crate::word::xorshift;

const EDGES: u64 = 3;

block! {
    /// A unit with a source of random triangles.
    pub struct Unit {
        /// A screen is `2^level` pixels wide.
        pub level: u32,
    }
    in UnitIn {
        rst: bit(),
        seed: bits(32),
    }
    out UnitOut {
        /// A hash of everything found so far.
        hash: bits(32),
    }
}

/// An edge of the triangle: a x + b y + value, which is negative outside.
#[derive(Clone, Copy)]
struct Edge {
    /// At the corner of the window.
    value: Reg,
    a: Reg,
    b: Reg,
}

impl Edge {
    fn new(m: Module, value: u32, number: u64) -> Edge {
        let reg = |name: &str, width| m.reg(&format!("{name}{number}"), width);
        Edge { value: reg("value", value), a: reg("a", 8), b: reg("b", 8) }
    }

    /// The growth of the value over 2^level pixels, to the right and downwards.
    fn steps(&self, level: Signal) -> [Signal; 2] {
        [self.a, self.b].map(|slope| slope.sext(self.value.width()) << level)
    }

    /// The signs of the values at the nearest and the farthest corner of each quarter of a window. The farthest one
    /// is negative if the whole quarter is outside, the nearest one if some of it is. A quarter of one pixel has one
    /// corner.
    fn test(&self, half: Signal, single: Signal) -> [[Signal; 2]; 4] {
        let [right, down] = self.steps(half);
        let least = mux(self.a.msb(), right, 0) + mux(self.b.msb(), down, 0);
        let most = mux(self.a.msb(), 0, right) + mux(self.b.msb(), 0, down);
        let beyond = mux(single, 0, most);
        let corner = *self.value;
        [corner, corner + right, corner + down, corner + right + down]
            .map(|value| [(value + least).msb(), (value + beyond).msb()])
    }
}

impl Unit {
    pub(super) fn build(&self, m: Module, i: UnitIn) -> UnitOut {
        let (rst, screen) = (i.rst, self.level);
        // The width of an edge's value.
        let value_width = screen + 10;
        def!(random = m.reg(32));
        random.next(mux(rst, i.seed, xorshift(*random)));

        // The window, and the triangle.
        def!(busy = m.reg(1));
        let (level, x, y) = (m.reg("level", 4), m.reg("x", screen), m.reg("y", screen));
        let edges = [0, 1, 2].map(|number| Edge::new(m, value_width, number));
        def!(half = level - 1);
        def!(single = half.eq(0));
        let tests = edges.map(|edge| edge.test(half, single));
        let any = |quarter: usize, corner: usize| {
            tests.iter().map(|test| test[quarter][corner]).reduce(|a, b| a | b).expect("a triangle has edges")
        };
        let quarters = |of: &dyn Fn(usize) -> Signal| cat![of(3), of(2), of(1), of(0)];
        def!(inside = quarters(&|quarter| !any(quarter, 1)));
        def!(whole = quarters(&|quarter| single | !any(quarter, 0)));
        def!(found = inside & whole);
        def!(divided = inside & !whole);

        // The stack: the remaining quarters of each window above, and its edges' values.
        let (places, window) = (screen.next_power_of_two(), 2 * screen + 8);
        def!(depth = m.reg(index_width(places.into())));
        let windows = m.memory("stack", places, window, ReadUnderWrite::Old).fill(Bits::zero(window));
        let edge_values = 3 * value_width;
        let values = m.memory("stack_values", places, edge_values, ReadUnderWrite::Old).fill(Bits::zero(edge_values));
        def!(top = depth - 1);
        def!(waiting = windows.read_async(top));
        def!(waiting_values = values.read_async(top));

        // The next window is a quarter of this one, or of a waiting one.
        def!(down = divided.ne(0));
        def!(back = !down & depth.ne(0));
        def!(todo = mux(down, divided, waiting.slice(2 * screen + 4..window)));
        def!(parent_level = mux(down, *level, waiting.slice(2 * screen..2 * screen + 4)));
        def!(parent_y = mux(down, *y, waiting.slice(screen..2 * screen)));
        def!(parent_x = mux(down, *x, waiting.slice(0..screen)));
        def!(child_level = parent_level - 1);
        def!(quarter = select([(todo.bit(0), 0_u64), (todo.bit(1), 1), (todo.bit(2), 2)], lit(2, 3)));
        def!(rest = todo & (todo - 1));
        def!(edge_length = lit(screen, 1) << child_level);
        let moved = |position: Signal, by: Signal, axis: u32| position + mux(quarter.bit(axis), by, 0);
        let parent_values = [0, 1, 2].map(|number| {
            let own = *edges[number as usize].value;
            mux(down, own, waiting_values.slice(number * value_width..(number + 1) * value_width))
        });

        def!(push = busy & down & rest.ne(0));
        def!(update = busy & back);
        let entry = cat![rest, parent_level, parent_y, parent_x];
        windows.write(push | update, mux(push, *depth, top), entry);
        let [value0, value1, value2] = parent_values;
        values.write(push, depth, cat![value2, value1, value0]);
        let pops = update & rest.eq(0);
        depth.enable(rst | push | pops).next(select([(rst, lit(depth.width(), 0)), (push, depth + 1)], top));

        // A new triangle is loaded edge by edge, each through a random point near the middle of the screen.
        def!(loaded = m.reg(2));
        def!(last_edge = loaded.eq(EDGES - 1));
        loaded.enable(rst | !busy).next(mux(rst | last_edge, 0, loaded + 1));
        busy.next(!rst & mux(busy, down | back, last_edge));
        let (a, b) = (random.slice(0..8), random.slice(8..16));
        let middle = |slope: Signal| slope.sext(value_width) << u64::from(screen - 1);
        def!(value = random.slice(16..18 + screen).zext(value_width) - middle(a) - middle(b));
        for ((number, edge), parent) in (0_u64..).zip(edges).zip(parent_values) {
            let [right, down] = edge.steps(child_level);
            let loads = !busy & loaded.eq(number);
            edge.a.enable(!rst & loads).next(a);
            edge.b.enable(!rst & loads).next(b);
            edge.value.enable(!rst & (busy | loads)).next(mux(busy, moved(moved(parent, right, 0), down, 1), value));
        }
        def!(starts = rst | !busy);
        level.next(mux(starts, u64::from(screen), child_level));
        x.next(mux(starts, 0, moved(parent_x, edge_length, 0)));
        y.next(mux(starts, 0, moved(parent_y, edge_length, 1)));

        def!(hash = m.reg(32));
        let seen = cat![found, divided, *level, *y, *x].zext(32);
        hash.enable(rst | busy).next(mux(rst, 0, hash.rotate_left(1) + seen));
        UnitOut { hash: *hash }
    }
}
