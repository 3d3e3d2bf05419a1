//! Changes of shape: signals combined into lanes, and the methods of rows and grids.

use crate::along::Along;
use crate::data::{Data, Layout};
use crate::elaboration;
use crate::fields::{Fields, Leaf};
use crate::index::Index;
use crate::integers::Integer;
use crate::limits::WIDEST;
use crate::names::bits_text;
use crate::operand::{IntoSignal, Operand};
use crate::record::from_leaves;
use crate::shaping::{level_all, sound_shape};
use crate::signal::Signal;
use crate::stream::{backwards, stack_ready};
use crate::uneven::{Uneven, uneven};
use crate::width::Width;
use tilewright_circuit::ir::{Kind, Op, Shape};
use tilewright_circuit::{Loc, Mistake, Problem};

/// Makes a row of signals, records of signals or streams, one in each lane; rows become the rows of a grid. All have
/// the same shape and width.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let sides = stack([lit(8, 3), lit(8, 4), lit(8, 5)]);
/// m.assert((sides + 1).pack().eq(0x060504), "from here on one line replaces three");
/// m.assert(stack([sides, sides]).rows().last().lane(0).eq(3), "rows become a grid");
/// # });
/// ```
#[track_caller]
pub fn stack<B: Fields<Signal>>(values: impl IntoIterator<Item = B>) -> B::With<Signal> {
    let loc = Loc::caller();
    let values: Vec<B> = values.into_iter().collect();
    let Some(first) = values.first() else {
        elaboration::mistake(Mistake::EmptyStack, "a stack of nothing".to_owned(), "give a value for each lane")
    };
    let mut by_lane: Vec<_> = values.iter().map(Fields::leaves).collect();
    for lane in 1..by_lane.len() {
        if let Some(uneven) = uneven(&by_lane[lane], &by_lane[0]) {
            let nodes: Vec<_> = by_lane[lane].iter().map(|(_, signal)| signal.id_at(loc)).collect();
            let Uneven { has, needs, .. } = uneven;
            let message = format!("lane {lane} of a stack has a list{uneven} of {has}, but lane 0 one of {needs}");
            let problem =
                Problem::new(Mistake::ListLength, loc, message).help("give every lane lists of the same length");
            elaboration::with(|e| e.report_instead_of(&nodes, problem));
            by_lane[lane] = by_lane[0].clone();
        }
    }
    let mut stacked = Vec::new();
    for (leaf, is_ready) in backwards(first).into_iter().enumerate() {
        let lanes: Vec<Signal> = by_lane.iter().map(|lane| lane[leaf].1).collect();
        stacked.push(if is_ready { stack_ready(&lanes) } else { stack_signals(lanes) });
    }
    from_leaves(first, stacked)
}

#[track_caller]
fn stack_signals(mut parts: Vec<Signal>) -> Signal {
    let loc = Loc::caller();
    let (width, kind, lanes) = (parts[0].width, parts[0].kind, parts.len() as u32);
    let nodes: Vec<_> = parts.iter().map(|part| part.id_at(loc)).collect();
    if let Some(other) = parts.iter().position(|part| part.width != width) {
        let (first, other) = (bits_text(width), (other, bits_text(parts[other].width)));
        let message =
            format!("the lanes of a stack have different widths: lane 0 has {first}, lane {} {}", other.0, other.1);
        let problem =
            Problem::new(Mistake::UnequalLanes, loc, message).help("make the change of width explicit, lane by lane");
        return elaboration::with(|e| {
            e.report_instead_of(&nodes, problem);
            Signal::zero_in(e, width, Shape::Row(lanes), kind, loc)
        });
    }
    let first = parts[0];
    for part in &mut parts {
        *part = part.of_kind_of(first, "stack");
    }
    let inner = level_all(&mut parts, "stack");
    let nodes: Vec<_> = parts.iter().map(|part| part.id_at(loc)).collect();
    elaboration::with(|e| match inner.with(0, lanes) {
        Some(shape) => Signal::make_in(e, Op::Stack { parts: nodes, axis: 0 }, width, shape, loc).kept_in(e, kind),
        None => {
            let message = format!("a stack of grids, of {inner} each, would have three axes");
            e.report_instead_of(
                &nodes,
                Problem::new(Mistake::ThreeAxes, loc, message).help("shapes have two at most: rows and columns"),
            );
            Signal::zero_in(e, width, inner, kind, loc)
        }
    })
}

/// A constant for each lane, as in `constants(bits(8).of(row(4)), |lane| 3 * lane)`. The lanes of a grid are counted
/// row by row. For a record of widths, `of` returns a record for each lane. A code is given by its number.
///
/// ```
/// # use tilewright_hdl::{Block, Fields, Module, Width, below, bundle, constants, elaborate, row};
/// bundle! {
///     /// A pixel of the screen.
///     pub struct Position<T> { pub x: T, pub y: T }
/// }
/// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// # struct Corners;
/// # impl Block for Corners {
/// #     type In = ();
/// #     type Out = Position;
/// #     fn inputs(&self) {}
/// #     fn build(&self, _: Module, (): ()) -> Position {
/// let widths = Position { x: below(640), y: below(480) }.map(|width| width.of(row(4)));
/// let corners = constants(widths, |i| Position { x: i % 2 * 639, y: i / 2 * 479 });
/// #         corners
/// #     }
/// # }
/// # elaborate(&Corners).unwrap();
/// ```
#[track_caller]
pub fn constants<L: Layout, N: Integer + Leaf>(layout: L, of: impl Fn(u32) -> <L::Value as Data>::Like<N>) -> L::Value {
    let layout = layout.layout();
    let mut fields = Vec::new();
    for (field, (_, width)) in layout.leaves().into_iter().enumerate() {
        fields.push(row_of_constants(width, |lane| of(lane).leaves()[field].1.integer()));
    }
    from_leaves(&layout, fields)
}

#[track_caller]
fn row_of_constants(width: Width, of: impl Fn(u32) -> i128) -> Signal {
    let loc = Loc::caller();
    let shape = elaboration::with(|e| sound_shape(e, "a list of constants", width.shape, loc));
    if shape != width.shape {
        return elaboration::with(|e| Signal::zero_in(e, width.bits.clamp(1, WIDEST), shape, width.kind, loc));
    }
    let values = crate::select::constants(width, (0..shape.lanes()).map(of));
    let bits = values[0].width;
    let row = |values: &[Signal]| {
        let parts = values.iter().map(|value| value.id_at(loc)).collect();
        Signal::make_at(Op::Stack { parts, axis: 0 }, bits, Shape::Row(values.len() as u32), loc)
    };
    let lanes = match shape {
        Shape::Plain => values[0],
        Shape::Row(_) => row(&values),
        Shape::Grid(_, columns) => {
            let parts = values.chunks(columns as usize).map(|values| row(values).node).collect();
            Signal::make_at(Op::Stack { parts, axis: 0 }, bits, shape, loc)
        }
    };
    lanes.kept_as(width.kind)
}

/// Lane 0 of each row, then lane 1 of each, and so on: two rows of four become one of eight.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let even = constants(bits(4).of(row(2)), |lane| [0, 2][lane as usize]);
/// let odd = constants(bits(4).of(row(2)), |lane| [1, 3][lane as usize]);
/// m.assert(interleave([even, odd]).pack().eq(0x3210), "0, 1, 2, 3");
/// # });
/// ```
#[track_caller]
pub fn interleave(rows: impl IntoIterator<Item = Signal>) -> Signal {
    let loc = Loc::caller();
    let mut parts: Vec<Signal> = rows.into_iter().collect();
    if parts.is_empty() {
        elaboration::mistake(Mistake::EmptyStack, "nothing is interleaved".to_owned(), "give it at least one row");
    }
    let first = parts[0].along("interleave");
    for part in &mut parts {
        *part = crate::operand::Value::Signal(*part).like(first.of, "interleave");
    }
    let lanes = u64::from(first.count()) * parts.len() as u64;
    let shape = Shape::Row(u32::try_from(lanes).unwrap_or(u32::MAX));
    let parts = parts.iter().map(|part| part.id_at(loc)).collect();
    Signal::make(Op::Interleave { parts, axis: 0 }, first.of.width, shape).kept_as(first.of.kind)
}

impl Signal {
    /// The rows of a grid as a sequence: `x.rows().previous(above)` gives each row the one above it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.rows().sum().pack().eq(0x753), "the sum of the rows is a row: 0 + 3, 1 + 4, 2 + 5");
    /// m.assert(x.rows().previous(15).pack().eq(0x210_fff), "row 0 takes the edge, row 1 takes row 0");
    /// # });
    /// ```
    #[track_caller]
    pub fn rows(self) -> Along {
        self.axis(0, "rows")
    }

    /// The columns of a grid as a sequence: `x.columns().previous(left)` gives each column the one to its left.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.columns().sum().pack().eq(0xc3), "the sum of the columns: 0 + 1 + 2 and 3 + 4 + 5");
    /// m.assert(x.columns().previous(15).pack().eq(0x43f_10f), "column 0 takes the edge");
    /// # });
    /// ```
    #[track_caller]
    pub fn columns(self) -> Along {
        self.axis(1, "columns")
    }

    #[track_caller]
    pub(crate) fn axis(self, axis: u32, method: &str) -> Along {
        let of = match self.shape {
            Shape::Grid(..) => self,
            _ => self.without_lanes(&format!("`.{method}()` needs a grid"), Shape::Grid(1, 1)),
        };
        Along { of, axis }
    }

    /// The lanes of a row.
    #[track_caller]
    pub(crate) fn along(self, method: &str) -> Along {
        let of = match self.shape {
            Shape::Row(_) => self,
            _ => self.without_lanes(&format!("`.{method}` needs a row"), Shape::Row(1)),
        };
        Along { of, axis: 0 }
    }

    /// A problem with the shape of this signal, and a stand-in for the result.
    #[track_caller]
    fn without_lanes(self, needs: &str, shape: Shape) -> Signal {
        let (loc, id) = (Loc::caller(), self.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let (text, place) = (draft.describe(id), draft.node(id).loc);
            let problem = Problem::new(Mistake::NeedsLanes, loc, format!("{needs}, but `{text}` has {}", self.shape))
                .note(format!("`{text}` is made"), place)
                .help(match self.shape {
                    Shape::Grid(..) => "say along which axis: `.rows()` or `.columns()`",
                    Shape::Row(_) => "a row has one axis, which needs no name",
                    Shape::Plain => "lanes come from a register, a port or a wire that is declared with some, as in `bits(8).of(row(4))`, or from `stack`",
                });
            e.report_instead_of(&[id], problem);
            Signal::zero_in(e, self.width, shape, self.kind, loc)
        })
    }

    /// The word cut into equal parts, one for each lane of `shape`. Lane 0 is the lowest bits; a grid is filled row
    /// by row.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let digits = lit(16, 0x4321).unpack(row(4));
    /// m.assert(digits.lane(0).eq(1), "lane 0 is in the lowest bits");
    /// m.assert((digits + 1).pack().eq(0x5432), "`pack` puts them side by side again");
    /// # });
    /// ```
    #[track_caller]
    pub fn unpack(self, shape: impl crate::IntoShape) -> Signal {
        let (loc, asked) = (Loc::caller(), shape.into_shape());
        let shape = elaboration::with(|e| sound_shape(e, "an unpacked word", asked, loc));
        let (id, lanes) = (self.id(), shape.lanes());
        if shape != asked {
            return elaboration::with(|e| Signal::zero_in(e, self.width, shape, Kind::Number, loc));
        }
        if !self.shape.is_plain() || shape.is_plain() || !self.width.is_multiple_of(lanes) {
            return elaboration::with(|e| {
                let text = e.draft().describe(id);
                let (bits, has) = (bits_text(self.width), self.shape);
                let message = format!("`.unpack` cannot cut `{text}`, of {bits} and {has}, into {shape}");
                e.report_instead_of(
                    &[id],
                    Problem::new(Mistake::UnevenCut, loc, message)
                        .help("it cuts a plain word into lanes of equal widths"),
                );
                Signal::zero_in(e, (self.width / lanes).max(1), shape, Kind::Number, loc)
            });
        }
        let Shape::Grid(rows, _) = shape else {
            return Signal::make(Op::Unpack { of: id, axis: 0 }, self.width / lanes, shape);
        };
        let words = Signal::make(Op::Unpack { of: id, axis: 0 }, self.width / rows, Shape::Row(rows));
        Signal::make(Op::Unpack { of: words.id(), axis: 1 }, self.width / lanes, shape)
    }
}

/// The methods that a row has directly, because it has one axis only.
macro_rules! of_a_row {
    ($($(#[$doc:meta])* fn $name:ident($($argument:ident: $ty:ty),*) -> $out:ty;)*) => {
        impl Signal {$(
            $(#[$doc])*
            #[track_caller]
            pub fn $name(self, $($argument: $ty),*) -> $out {
                self.along(stringify!($name)).$name($($argument),*)
            }
        )*}
    };
}

of_a_row! {
    /// The number of lanes of a row.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let digits = lit(16, 0x4321).unpack(4);
    /// m.assert(digits.lane(digits.count() - 1).eq(4), "a number known while the block is built");
    /// # });
    /// ```
    fn count() -> u32;
    /// The lane of a row with this number, counted from 0.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let digits = lit(16, 0x4321).unpack(4);
    /// m.assert(digits.lane(1).eq(2), "a lane by a number; `pick` selects one by a signal");
    /// # });
    /// ```
    fn lane(index: impl Integer) -> Signal;
    /// The last lane of a row.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let digits = lit(16, 0x4321).unpack(4);
    /// m.assert(digits.last().eq(4), "the output of a chain");
    /// # });
    /// ```
    fn last() -> Signal;
    /// The lanes of a row, as separate signals.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let digits = lit(16, 0x4321).unpack(4).to_vec();
    /// m.assert(concat(&digits).eq(0x1234), "side by side, but the first most significant");
    /// # });
    /// ```
    fn to_vec() -> Vec<Signal>;
    /// Each lane of a row takes the value of its lower neighbour; lane 0 takes `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = lit(16, 0x4321).unpack(4);
    /// m.assert(x.previous(9).pack().eq(0x3219), "all one lane up");
    /// # });
    /// ```
    fn previous(edge: impl Operand) -> Signal;
    /// Each lane of a row takes the value of its higher neighbour; the last lane takes `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = lit(16, 0x4321).unpack(4);
    /// m.assert((x.following(0) - x).lane(0).eq(1), "differences of neighbours, lane by lane");
    /// # });
    /// ```
    fn following(edge: impl Operand) -> Signal;
    /// Lane `i` of a row takes the value of lane `i - by`, or `edge` if there is none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = lit(16, 0x4321).unpack(4);
    /// m.assert(x.shifted(2, 0).pack().eq(0x2100), "lane 2 takes lane 0");
    /// m.assert(x.shifted(-1, 9).pack().eq(x.following(9).pack()), "the other direction");
    /// # });
    /// ```
    fn shifted(by: impl Integer, edge: impl Operand) -> Signal;
    /// A row of `count` lanes: lane `i` is lane `index(i)` of this one, as in `take(2 * n, |i| i / 2)`, which gives
    /// each node of a tree its parent.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = lit(16, 0x4321).unpack(4);
    /// m.assert(x.take(2, |i| 2 * i + 1).pack().eq(0x42), "every second lane, from lane 1 on");
    /// m.assert(x.take(8, |i| i / 2).pack().eq(0x44332211u64), "each lane twice");
    /// # });
    /// ```
    fn take(count: impl Integer, index: impl FnOnce(Index) -> Index) -> Signal;
    /// Like [`take`](Signal::take), but an index out of range gives `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = lit(16, 0x4321).unpack(4);
    /// m.assert(x.take_or(6, |i| i - 1, 9).pack().eq(0x94321_9), "a border around a row");
    /// # });
    /// ```
    fn take_or(count: impl Integer, index: impl FnOnce(Index) -> Index, edge: impl Operand) -> Signal;
    /// The lanes of a row in reverse.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let word = lit(8, 0b1100_1010);
    /// m.assert(word.unpack(8).reversed().pack().eq(0b0101_0011), "the bits of a word in reverse");
    /// # });
    /// ```
    fn reversed() -> Signal;
    /// The lane of a row whose number is the value of `index`; zero if there is none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(count = m.reg(3).reset(0));
    /// count.next(count + 1);
    /// let square = constants(bits(4).of(row(4)), |lane| lane * lane).pick(count);
    /// m.assert(count.lt(4).implies(square.zext(6).eq(*count * *count)), "a table in logic");
    /// m.assert(count.ge(4).implies(square.eq(0)), "lanes 4 to 7 do not exist");
    /// # });
    /// ```
    fn pick(index: impl IntoSignal) -> Signal;
}

/// The methods that a grid has too, which combine all lanes.
macro_rules! of_all_lanes {
    ($($(#[$doc:meta])* $name:ident;)*) => {
        impl Signal {$(
            $(#[$doc])*
            #[track_caller]
            pub fn $name(self) -> Signal {
                match self.shape {
                    Shape::Grid(..) => self.columns().$name().along(stringify!($name)).$name(),
                    _ => self.along(stringify!($name)).$name(),
                }
            }
        )*}
    };
}

of_all_lanes! {
    /// Bitwise and of all lanes.
    and_all;
    /// Bitwise or of all lanes.
    or_all;
    /// Bitwise exclusive or of all lanes.
    xor_all;
    /// The sum of all lanes, modulo 2 to the width.
    sum;
    /// The smallest of all lanes; signed lanes are compared in two's complement.
    minimum;
    /// The largest of all lanes; signed lanes are compared in two's complement.
    maximum;
    /// All lanes side by side in one word, lane 0 in the lowest bits; a grid is packed row by row.
    pack;
}
