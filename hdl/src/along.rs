//! The lanes of a signal along one of its axes.

use crate::bits::Bits;
use crate::elaboration;
use crate::index::Index;
use crate::ir::{Kind, Op, Reduction, Shape};
use crate::limits::sound_width;
use crate::loc::Loc;
use crate::operand::{IntoSignal, Operand};
use crate::problem::Problem;
use crate::shaping::{extent, sound_shape};
use crate::signal::Signal;
use crate::width::Count;

/// The lanes of a row, or the rows or the columns of a grid, one after another: made by [`Signal::rows`] and [`Signal::columns`]. Each of
/// its lanes is what is left without that axis: of the rows of a grid, a row.
#[derive(Debug, Clone, Copy)]
#[must_use]
pub struct Along {
    pub(crate) of: Signal,
    pub(crate) axis: u32,
}

impl Along {
    /// How many there are.
    pub fn count(self) -> u32 {
        self.of.shape.extent(self.axis)
    }

    fn inner(self) -> Shape {
        self.of.shape.without(self.axis)
    }

    #[track_caller]
    fn dropped(self, op: Op) -> Signal {
        Signal::make(op, self.of.width, self.inner()).kept_as(self.of.kind)
    }

    /// The signal with the lanes of one of these, as which it stands in `method`; if it has others, that is a problem.
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
            let problem = Problem::new(loc, message).help(format!("it is plain, or as one {one} is"));
            e.report_instead_of(&[id], problem);
            Signal::zero_in(e, signal.width, inner, signal.kind, loc)
        })
    }

    /// The one of that number, counted from 0.
    #[track_caller]
    pub fn lane(self, index: u32) -> Signal {
        let (loc, count) = (Loc::caller(), self.count());
        if index >= count {
            let problem =
                Problem::new(loc, format!("lane {index} of a signal of {count} lanes")).help("lanes count from 0");
            return elaboration::with(|e| {
                e.report(problem);
                Signal::zero_in(e, self.of.width, self.inner(), self.of.kind, loc)
            });
        }
        self.dropped(Op::Lane { of: self.of.id(), axis: self.axis, index })
    }

    /// The last one.
    #[track_caller]
    pub fn last(self) -> Signal {
        self.lane(self.count() - 1)
    }

    /// All of them, as signals of their own.
    #[track_caller]
    pub fn to_vec(self) -> Vec<Signal> {
        let mut signals = Vec::new();
        for lane in 0..self.count() {
            signals.push(self.lane(lane));
        }
        signals
    }

    /// What the neighbour of the next lower number has; the first has `edge`.
    #[track_caller]
    pub fn previous(self, edge: impl Operand) -> Signal {
        self.shifted(1, edge)
    }

    /// What the neighbour of the next higher number has; the last has `edge`.
    #[track_caller]
    pub fn following(self, edge: impl Operand) -> Signal {
        self.shifted(-1, edge)
    }

    /// Number `i` has what number `i - by` has; those that have no such neighbour have `edge`.
    #[track_caller]
    pub fn shifted(self, by: i32, edge: impl Operand) -> Signal {
        // All are beyond the edge from there on.
        let most = i32::try_from(self.count()).unwrap_or(i32::MAX);
        let by = by.clamp(-most, most);
        self.map(self.count(), |i| i - by, Some(edge), "shifted")
    }

    /// `count` of them: number `i` is the one that `index` says, as in `take(2 * n, |i| i / 2)`. There is one for each.
    #[track_caller]
    pub fn take(self, count: impl Count, index: impl FnOnce(Index) -> Index) -> Signal {
        self.map(extent(count), index, None::<u32>, "take")
    }

    /// As [`take`](Along::take); where `index` leads beyond the ends, `edge`.
    #[track_caller]
    pub fn take_or(self, count: impl Count, index: impl FnOnce(Index) -> Index, edge: impl Operand) -> Signal {
        self.map(extent(count), index, Some(edge), "take_or")
    }

    /// The last first.
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
        let shape = self.inner().with(self.axis, count).expect("the axis is put back");
        let shape = elaboration::with(|e| sound_shape(e, &format!("what `.{method}` gives"), shape, loc));
        let (axis, has) = (self.axis, self.count());
        let (problem, help) = match index(Index::lane()).affine() {
            None => (
                format!("the rule of `.{method}` is none that a row of wires can follow"),
                "a lane's number is multiplied and added to before it is divided, in 32 bits, as in `(2 * i + 1) / 3`",
            ),
            Some(index) => match (index.stays_inside(shape.extent(axis), has), edge) {
                (is_inside, edge) if is_inside || edge.is_some() => {
                    // Where no lane is beyond the ends, nothing takes the edge.
                    elaboration::draft(|draft| draft.ignored.extend(edge.filter(|_| is_inside)));
                    let op = Op::Map { of: id, axis, index, edge: edge.filter(|_| !is_inside) };
                    return Signal::make(op, self.of.width, shape).kept_as(self.of.kind);
                }
                _ => {
                    let beyond = (0..shape.extent(axis)).find(|lane| index.source(*lane, has).is_none());
                    let lane = beyond.unwrap_or(0);
                    let from = index.at(lane);
                    let message = format!("lane {lane} of `.{method}` would be lane {from} of a signal of {has} lanes");
                    (message, "`.take_or(n, |i| .., edge)` says what lanes beyond the ends have")
                }
            },
        };
        elaboration::with(|e| {
            e.report_instead_of(&[id], Problem::new(loc, problem).help(help));
            Signal::zero_in(e, self.of.width, shape, self.of.kind, loc)
        })
    }

    /// The one whose number `index` is; zero beyond the last.
    #[track_caller]
    pub fn pick(self, index: impl IntoSignal) -> Signal {
        let index = self.one(index.into(), "the index", "pick");
        self.dropped(Op::Pick { of: self.of.id(), axis: self.axis, index: index.id() })
    }

    #[track_caller]
    fn reduce(self, by: Reduction) -> Signal {
        self.dropped(Op::Reduce { by, of: self.of.id(), axis: self.axis })
    }

    /// Bitwise and of all.
    #[track_caller]
    pub fn and_all(self) -> Signal {
        self.reduce(Reduction::And)
    }

    /// Bitwise or of all.
    #[track_caller]
    pub fn or_all(self) -> Signal {
        self.reduce(Reduction::Or)
    }

    /// Bitwise exclusive or of all.
    #[track_caller]
    pub fn xor_all(self) -> Signal {
        self.reduce(Reduction::Xor)
    }

    /// The sum of all, modulo 2 to the width.
    #[track_caller]
    pub fn sum(self) -> Signal {
        self.reduce(Reduction::Add)
    }

    /// The smallest; of signed ones in two's complement.
    #[track_caller]
    pub fn minimum(self) -> Signal {
        self.extreme(Reduction::Min)
    }

    /// The largest; of signed ones in two's complement.
    #[track_caller]
    pub fn maximum(self) -> Signal {
        self.extreme(Reduction::Max)
    }

    #[track_caller]
    fn extreme(self, by: Reduction) -> Signal {
        if self.of.kind != Kind::Signed {
            return self.reduce(by);
        }
        // With the sign bit inverted, the order is that of unsigned numbers.
        let places = self.of.width - 1;
        let sign = if places == 0 { Bits::ones(1) } else { Bits::ones(1).concat(&Bits::zero(places)) };
        let of = self.of.bits() ^ sign.clone();
        (Along { of, ..self }.reduce(by) ^ sign).kept_as(Kind::Signed)
    }

    /// Side by side in one word, number 0 in the lowest bits.
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
