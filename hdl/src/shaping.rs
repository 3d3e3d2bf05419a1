//! Lanes of operands: a plain operand is the same in every lane; any other change of lanes must be explicit.

use crate::elaboration::{self, Elaboration};
use crate::integers::{Integer, count};
use crate::limits::MOST_LANES;
use crate::signal::Signal;
use std::fmt;
use tilewright_circuit::ir::{Op, Shape};
use tilewright_circuit::{Loc, Mistake, Problem};

/// A row of `lanes` lanes.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let index = constants(bits(8).of(row(4)), |lane| lane);
/// m.assert(index.sum().eq(6), "0 + 1 + 2 + 3");
/// # });
/// ```
///
/// # Panics
///
/// The number is negative. While a block is built, this is a problem of its description instead.
#[track_caller]
pub fn row(lanes: impl Integer) -> Shape {
    Shape::Row(count(lanes))
}

/// A grid of `rows` rows and `columns` columns.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let index = constants(bits(8).of(grid(2, 3)), |lane| lane);
/// m.assert(index.rows().lane(1).lane(0).eq(3), "row by row: the second row begins with lane 3");
/// # });
/// ```
///
/// # Panics
///
/// A number is negative. While a block is built, this is a problem of its description instead.
#[track_caller]
pub fn grid(rows: impl Integer, columns: impl Integer) -> Shape {
    Shape::Grid(count(rows), count(columns))
}

/// A number of lanes: [`row`], [`grid`], or a number for a row of that length.
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!(bits(8).of(4).shape(), bits(8).of(row(4)).shape());
/// assert_eq!(bits(8).of(grid(2, 2)).shape().lanes(), 4);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not say how many lanes there are",
    note = "write a number of lanes, or `row(n)`, or `grid(rows, columns)`"
)]
pub trait IntoShape {
    #[doc(hidden)]
    fn into_shape(self) -> Shape;
}

impl IntoShape for Shape {
    fn into_shape(self) -> Shape {
        self
    }
}

impl<N: Integer> IntoShape for N {
    #[track_caller]
    fn into_shape(self) -> Shape {
        row(self)
    }
}

/// A valid shape for `what`. No lanes, or too many, are a problem, and one lane stands in. An object made with the
/// stand-in is a stand-in itself.
pub(crate) fn sound_shape(e: &mut Elaboration, what: impl fmt::Display, shape: Shape, loc: Loc) -> Shape {
    let sound = match shape {
        Shape::Plain => shape,
        Shape::Row(lanes) => Shape::Row(lanes.max(1)),
        Shape::Grid(rows, columns) => Shape::Grid(rows.max(1), columns.max(1)),
    };
    if sound != shape {
        e.report(
            Problem::new(Mistake::NoLanes, loc, format!("{what} has no lanes"))
                .help("a row, and a side of a grid, is at least 1"),
        );
    } else if u64::from(sound.lanes()) > MOST_LANES {
        let message = format!("{what} has {sound}, more than {MOST_LANES}");
        e.report(
            Problem::new(Mistake::TooManyLanes, loc, message).help("make it smaller, or keep large data in a memory"),
        );
        return match sound {
            Shape::Grid(..) => Shape::Grid(1, 1),
            _ => Shape::Row(1),
        };
    }
    sound
}

/// The signals with the lanes of the first that has any, for `operator`.
#[track_caller]
pub(crate) fn level<const N: usize>(mut signals: [Signal; N], operator: &str) -> [Signal; N] {
    level_all(&mut signals, operator);
    signals
}

/// Like [`level`], for a list; returns the shape.
#[track_caller]
pub(crate) fn level_all(signals: &mut [Signal], operator: &str) -> Shape {
    let Some(&first) = signals.iter().find(|signal| !signal.shape.is_plain()) else { return Shape::Plain };
    for signal in signals {
        *signal = signal.with_lanes_of(first, operator);
    }
    first.shape
}

impl Signal {
    /// The number and layout of its lanes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let index = constants(bits(8).of(row(4)), |lane| lane);
    /// let last = index.shape().lanes() - 1;
    /// m.assert(index.lane(last).eq(3), "a helper need not be told the number of lanes");
    /// # });
    /// ```
    pub fn shape(self) -> Shape {
        self.shape
    }

    /// The signal repeated in each lane of `shape`, as happens to a plain signal that meets a row or a grid.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let ones = lit(8, 1).of(row(4));
    /// m.assert(ones.sum().eq(4), "a plain signal has no lanes to add up");
    /// # });
    /// ```
    #[track_caller]
    pub fn of(self, shape: impl crate::IntoShape) -> Signal {
        let (loc, asked) = (Loc::caller(), shape.into_shape());
        let shape = elaboration::with(|e| sound_shape(e, "a signal", asked, loc));
        if shape != asked {
            return elaboration::with(|e| Signal::zero_in(e, self.width, shape, self.kind, loc));
        }
        if self.shape == shape {
            return self;
        }
        if self.shape.is_plain() {
            return self.spread(shape, loc);
        }
        let id = self.id();
        elaboration::with(|e| {
            let (text, has) = (e.draft().describe(id), self.shape);
            let problem = Problem::new(
                Mistake::UnequalShapes,
                loc,
                format!("`{text}` has {has}, and only a plain signal can be that of {shape}"),
            );
            let help = "a row becomes a grid by `.to_rows(n)`, which repeats it as n rows, or by `.to_columns(n)`";
            e.report_instead_of(&[id], problem.help(help));
            Signal::zero_in(e, self.width, shape, self.kind, loc)
        })
    }

    /// The row repeated as each of `rows` rows of a grid.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(8).of(row(3)), |x| x).to_rows(2);
    /// m.assert(x.pack().eq(0x020100_020100u64), "both rows are 0, 1, 2");
    /// # });
    /// ```
    #[track_caller]
    pub fn to_rows(self, rows: impl Integer) -> Signal {
        self.repeated(0, count(rows), "to_rows")
    }

    /// The row repeated as each of `columns` columns of a grid: lane `i` fills row `i`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let y = constants(bits(8).of(row(2)), |y| y).to_columns(3);
    /// m.assert(y.pack().eq(0x010101_000000u64), "a row of zeros and a row of ones");
    /// # });
    /// ```
    #[track_caller]
    pub fn to_columns(self, columns: impl Integer) -> Signal {
        self.repeated(1, count(columns), "to_columns")
    }

    #[track_caller]
    fn repeated(self, axis: u32, times: u32, method: &str) -> Signal {
        let (loc, id) = (Loc::caller(), self.id());
        elaboration::with(|e| match self.shape {
            Shape::Row(_) => {
                let asked = self.shape.with(axis, times).expect("a row gets a second axis");
                let shape = sound_shape(e, "a grid", asked, loc);
                if shape != asked {
                    return Signal::zero_in(e, self.width, shape, self.kind, loc);
                }
                Signal::make_in(e, Op::Broadcast { of: id, axis }, self.width, shape, loc).kept_in(e, self.kind)
            }
            _ => {
                let text = e.draft().describe(id);
                let problem = Problem::new(
                    Mistake::NeedsLanes,
                    loc,
                    format!("`.{method}` needs a row, but `{text}` has {}", self.shape),
                );
                e.report_instead_of(
                    &[id],
                    problem.help("a plain signal goes into a grid by `.of(grid(rows, columns))`"),
                );
                Signal::zero_in(e, self.width, Shape::Grid(times.max(1), times.max(1)), self.kind, loc)
            }
        })
    }

    /// A plain signal repeated in each lane of a shape.
    pub(crate) fn spread(self, shape: Shape, loc: Loc) -> Signal {
        let node = self.id_at(loc);
        elaboration::with(|e| Signal { node, ..self }.spread_in(e, shape, loc))
    }

    pub(crate) fn spread_in(self, e: &mut Elaboration, shape: Shape, loc: Loc) -> Signal {
        let (node, mut of) = (e.draft().node(self.node), self.node);
        if let (Op::Const(bits), None) = (&node.op, &node.name) {
            let same = Op::Const(bits.clone());
            return Signal::make_in(e, same, self.width, shape, loc).kept_in(e, self.kind);
        }
        if let Shape::Grid(_, columns) = shape {
            of = Signal::make_in(e, Op::Broadcast { of, axis: 0 }, self.width, Shape::Row(columns), loc).node;
        }
        Signal::make_in(e, Op::Broadcast { of, axis: 0 }, self.width, shape, loc).kept_in(e, self.kind)
    }

    /// The signal with the lanes of `left`, for `operator`: a plain one is the same in all of them.
    #[track_caller]
    pub(crate) fn with_lanes_of(self, left: Signal, operator: &str) -> Signal {
        let loc = Loc::caller();
        if self.shape == left.shape {
            return self;
        }
        if self.shape.is_plain() {
            return self.spread(left.shape, loc);
        }
        let (left_id, right_id) = (left.id(), self.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let (left_text, right_text) = (draft.describe(left_id), draft.describe(right_id));
            let message = format!(
                "`{operator}` needs equal shapes: `{left_text}` has {}, `{right_text}` has {}",
                left.shape, self.shape
            );
            let problem = Problem::new(Mistake::UnequalShapes, loc, message)
                .note(format!("`{left_text}` is made"), draft.node(left_id).loc)
                .note(format!("`{right_text}` is made"), draft.node(right_id).loc)
                .help(match (left.shape, self.shape) {
                    (Shape::Plain, _) => "only a plain signal is repeated in every lane by itself; take a lane, or combine all lanes with `.or_all()` and its like",
                    (Shape::Grid(..), Shape::Row(_)) | (Shape::Row(_), Shape::Grid(..)) => {
                        "a row becomes a grid by `.to_rows(n)`, which repeats it as n rows, or by `.to_columns(n)`"
                    }
                    _ => "both sides need equal numbers of lanes, laid out the same way",
                });
            e.report_instead_of(&[left_id, right_id], problem);
            Signal::zero_in(e, self.width, left.shape, self.kind, loc)
        })
    }
}
