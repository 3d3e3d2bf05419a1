//! The lanes of a signal along one of its axes.

use crate::elaboration;
use crate::index::Index;
use crate::integers::{self, Integer};
use crate::limits::sound_width;
use crate::operand::{IntoSignal, Operand};
use crate::shaping::sound_shape;
use crate::signal::Signal;
use tilewright_circuit::ir::{Kind, Op, Shape};
use tilewright_circuit::{Loc, Mistake, Problem};

/// The lanes of a row, or the rows or columns of a grid, as a sequence. Made by [`Signal::rows`] and
/// [`Signal::columns`], and for records by [`Lanes::rows`](crate::Lanes::rows) and
/// [`Lanes::columns`](crate::Lanes::columns). Each element has the shape that remains without that axis: for the rows
/// of a grid, a row.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
/// m.assert(x.rows().lane(1).pack().eq(0x543), "an element of the rows is a row, ..");
/// m.assert(x.columns().lane(1).pack().eq(0x41), ".. and so is an element of the columns");
/// # });
/// ```
#[derive(Debug, Clone, Copy)]
#[must_use]
pub struct Along<V = Signal> {
    pub(crate) of: V,
    pub(crate) axis: u32,
}

impl Along {
    /// The number of elements.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// let (rows, columns) = (x.rows().count(), x.columns().count());
    /// m.assert(x.rows().lane(rows - 1).lane(columns - 1).eq(5), "2 and 3");
    /// # });
    /// ```
    pub fn count(self) -> u32 {
        self.of.shape.extent(self.axis)
    }

    fn inner(self) -> Shape {
        self.of.shape.without(self.axis)
    }

    #[track_caller]
    pub(crate) fn dropped(self, op: Op) -> Signal {
        Signal::make(op, self.of.width, self.inner()).kept_as(self.of.kind)
    }

    /// The signal with the lanes of one of these, for use in `method`; a signal with other lanes is a problem.
    #[track_caller]
    fn one(self, signal: Signal, what: &str, method: &str) -> Signal {
        let (loc, inner) = (Loc::caller(), self.inner());
        if signal.shape == inner {
            return signal;
        }
        if signal.shape.is_plain() {
            return signal.spread(inner, loc);
        }
        let (id, of) = (signal.id(), self.of.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let (text, of) = (draft.describe(id), draft.describe(of));
            let one = match (self.axis, self.of.shape) {
                (_, Shape::Row(_)) => "lane",
                (0, _) => "row",
                _ => "column",
            };
            let message =
                format!("{what} of `.{method}`, `{text}`, has {}, but a {one} of `{of}` has {inner}", signal.shape);
            let problem =
                Problem::new(Mistake::OtherLayout, loc, message).help(format!("it is plain, or as one {one} is"));
            e.report_instead_of(&[id], problem);
            Signal::zero_in(e, signal.width, inner, signal.kind, loc)
        })
    }

    /// Element `index`, counted from 0.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.rows().lane(1).lane(2).eq(5), "row 1, and its column 2");
    /// # });
    /// ```
    #[track_caller]
    pub fn lane(self, index: impl Integer) -> Signal {
        let (loc, index, count) = (Loc::caller(), index.integer(), self.count());
        if !(0..count.into()).contains(&index) {
            let problem = Problem::new(Mistake::NoSuchLane, loc, format!("lane {index} of a signal of {count} lanes"))
                .help("lanes count from 0");
            let id = self.of.id();
            return elaboration::with(|e| {
                e.report_instead_of(&[id], problem);
                Signal::zero_in(e, self.of.width, self.inner(), self.of.kind, loc)
            });
        }
        self.dropped(Op::Lane { of: self.of.id(), axis: self.axis, index: index as u32 })
    }

    /// The last element.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.columns().last().pack().eq(0x52), "the right border of a grid, a lane for each row");
    /// # });
    /// ```
    #[track_caller]
    pub fn last(self) -> Signal {
        self.lane(self.count() - 1)
    }

    /// All elements, as separate signals.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// let [upper, lower] = x.rows().to_vec()[..] else { unreachable!("two rows") };
    /// m.assert((lower - upper).eq(3).and_all(), "rows that meet lane by lane");
    /// # });
    /// ```
    #[track_caller]
    pub fn to_vec(self) -> Vec<Signal> {
        let mut signals = Vec::new();
        for lane in 0..self.count() {
            signals.push(self.lane(lane));
        }
        signals
    }

    /// Each element takes the value of its lower neighbour; the first takes `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// let left = lit(8, 0xba).unpack(2);
    /// m.assert(x.columns().previous(left).pack().eq(0x43b_10a), "the edge is plain, or shaped like a column");
    /// # });
    /// ```
    #[track_caller]
    pub fn previous(self, edge: impl Operand) -> Signal {
        self.shifted(1, edge)
    }

    /// Each element takes the value of its higher neighbour; the last takes `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.rows().following(15).pack().eq(0xfff_543), "the row below; the last row takes the edge");
    /// # });
    /// ```
    #[track_caller]
    pub fn following(self, edge: impl Operand) -> Signal {
        self.shifted(-1, edge)
    }

    /// Element `i` takes the value of element `i - by`, or `edge` if there is none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.columns().shifted(2, 0).pack().eq(0x300_000), "column 2 takes column 0");
    /// # });
    /// ```
    #[track_caller]
    pub fn shifted(self, by: impl Integer, edge: impl Operand) -> Signal {
        // From this distance on, every element is beyond the edge.
        let most = i128::from(self.count());
        let by = by.integer().clamp(-most, most);
        self.map(self.count(), |i| i - by, Some(edge), "shifted")
    }

    /// A sequence of `count` elements: element `i` is element `index(i)` of this one, as in `take(2 * n, |i| i / 2)`.
    /// No index may be out of range.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 2)), |lane| lane);
    /// let doubled = x.rows().take(4, |i| i / 2).columns().take(4, |i| i / 2);
    /// m.assert(doubled.rows().last().pack().eq(0x3322), "each lane becomes a 2 x 2 square");
    /// # });
    /// ```
    #[track_caller]
    pub fn take(self, count: impl Integer, index: impl FnOnce(Index) -> Index) -> Signal {
        self.map(integers::count(count), index, None::<u32>, "take")
    }

    /// Like [`take`](Along::take), but an index out of range gives `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 2)), |lane| lane);
    /// m.assert(x.rows().take_or(3, |i| i - 1, 15).pack().eq(0x32_10_ff), "a border above");
    /// # });
    /// ```
    #[track_caller]
    pub fn take_or(self, count: impl Integer, index: impl FnOnce(Index) -> Index, edge: impl Operand) -> Signal {
        self.map(integers::count(count), index, Some(edge), "take_or")
    }

    /// The elements in reverse order.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.rows().reversed().pack().eq(0x210_543), "upside down");
    /// m.assert(x.columns().reversed().pack().eq(0x345_012), "from right to left");
    /// # });
    /// ```
    #[track_caller]
    pub fn reversed(self) -> Signal {
        let count = self.count();
        self.map(count, |i| count - 1 - i, None::<u32>, "reversed")
    }

    #[track_caller]
    fn map(self, count: u32, index: impl FnOnce(Index) -> Index, edge: Option<impl Operand>, method: &str) -> Signal {
        let (loc, id) = (Loc::caller(), self.of.id());
        #[expect(clippy::manual_map, reason = "a closure would be the caller that messages name")]
        let edge = match edge {
            Some(edge) => Some(self.one(edge.operand().with_width_of(self.of, method), "the edge", method).id()),
            None => None,
        };
        let asked = self.inner().with(self.axis, count).expect("the axis is put back");
        let shape = elaboration::with(|e| sound_shape(e, format_args!("what `.{method}` gives"), asked, loc));
        if shape != asked {
            return elaboration::with(|e| Signal::zero_in(e, self.of.width, shape, self.of.kind, loc));
        }
        let (axis, has) = (self.axis, self.count());
        let (mistake, message, help) = match index(Index::lane()).affine() {
            None => (
                Mistake::UnfollowedRule,
                format!("the rule of `.{method}` is one that a row of wires cannot follow"),
                "a rule multiplies and adds before it divides, in 32 bits, as in `(2 * i + 1) / 3`",
            ),
            Some(index) => match (index.stays_inside(shape.extent(axis), has), edge) {
                (is_inside, edge) if is_inside || edge.is_some() => {
                    // If no index is out of range, `edge` is never used.
                    elaboration::draft(|draft| draft.ignored.extend(edge.filter(|_| is_inside)));
                    let op = Op::Map { of: id, axis, index, edge: edge.filter(|_| !is_inside) };
                    return Signal::make(op, self.of.width, shape).kept_as(self.of.kind);
                }
                _ => {
                    let beyond = (0..shape.extent(axis)).find(|lane| index.source(*lane, has).is_none());
                    let lane = beyond.unwrap_or(0);
                    let from = index.at(lane);
                    let message = format!("lane {lane} of `.{method}` would be lane {from} of a signal of {has} lanes");
                    (
                        Mistake::NoSuchLane,
                        message,
                        "`.take_or(n, |i| .., edge)` gives a value for lanes beyond the ends",
                    )
                }
            },
        };
        elaboration::with(|e| {
            e.report_instead_of(&[id], Problem::new(mistake, loc, message).help(help));
            Signal::zero_in(e, self.of.width, shape, self.of.kind, loc)
        })
    }

    /// The element whose number is the value of `index`; zero if there is none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.rows().pick(lit(1, 1)).pack().eq(0x543), "one row, selected by a signal");
    /// # });
    /// ```
    #[track_caller]
    pub fn pick(self, index: impl IntoSignal) -> Signal {
        let index = self.one(index.into(), "the index", "pick");
        self.dropped(Op::Pick { of: self.of.id(), axis: self.axis, index: index.id() })
    }

    /// All elements side by side in one word, element 0 in the lowest bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.columns().pack().lane(1).eq(0x543), "a row of words, one for each row of the grid");
    /// # });
    /// ```
    #[track_caller]
    pub fn pack(self) -> Signal {
        let (loc, id) = (Loc::caller(), self.of.id());
        let width = u64::from(self.of.width) * u64::from(self.count());
        elaboration::with(|e| {
            let sound = sound_width(e, &[id], "a word of packed lanes", width, loc);
            let inner = self.inner();
            if width != sound.into() {
                return Signal::zero_in(e, sound, inner, Kind::Number, loc);
            }
            Signal::make_in(e, Op::Pack { of: id, axis: self.axis }, sound, inner, loc)
        })
    }
}
