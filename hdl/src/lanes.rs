//! Instance arrays, and the values that have one element for each of their lanes.

use crate::bundle::Fields;
use crate::elaboration;
use crate::ir::{Affine, NodeId, Op, Reduction, Shape};
use crate::loc::Loc;
use crate::operand::Operand;
use crate::problem::Problem;
use crate::signal::Signal;
use crate::uneven::{Uneven, uneven};

/// One value for each lane of an instance array: its outputs, and what may feed its inputs.
#[derive(Debug, Clone, Copy)]
#[must_use]
pub struct Lanes {
    pub(crate) stamp: u32,
    pub(crate) module: u32,
    pub(crate) node: NodeId,
    pub(crate) width: u32,
    pub(crate) count: u32,
}

/// What the closure of [`Module::array`](crate::Module::array) gets: the array's outputs, and ways to feed its inputs.
#[derive(Debug, Clone, Copy)]
pub struct Array<O> {
    /// The outputs of all lanes.
    pub out: O,
    pub(crate) lanes: u32,
}

impl<O> Array<O> {
    /// The number of lanes.
    pub fn count(&self) -> u32 {
        self.lanes
    }

    /// The same signal, or bundle of signals, in every lane.
    #[track_caller]
    pub fn all<B: Fields<Signal>>(&self, value: &B) -> B::With<Lanes> {
        let lanes = self.lanes;
        let loc = Loc::caller();
        value.map_fields("", &mut |_, signal| {
            let op = Op::Broadcast { of: signal.id_at(loc), axis: 0 };
            Lanes::make(op, signal.width, lanes, loc)
        })
    }

    /// A signal, or bundle of signals, for each lane; all of one shape and width.
    #[track_caller]
    pub fn each<B: Fields<Signal>>(&self, values: impl IntoIterator<Item = B>) -> B::With<Lanes> {
        let loc = Loc::caller();
        let values: Vec<B> = values.into_iter().collect();
        let first =
            values.first().unwrap_or_else(|| panic!("an array is fed nothing, at {loc}: give a value for each lane"));
        let mut by_lane: Vec<_> = values.iter().map(Fields::leaves).collect();
        for lane in 1..by_lane.len() {
            if let Some(uneven) = uneven(&by_lane[lane], &by_lane[0]) {
                let nodes: Vec<_> = by_lane[lane].iter().map(|(_, signal)| signal.id_at(loc)).collect();
                let Uneven { has, needs, .. } = uneven;
                let message =
                    format!("lane {lane} of an array is fed a list{uneven} of {has}, but lane 0 one of {needs}");
                let problem = Problem::new(loc, message).help("give every lane lists of the same length");
                elaboration::with(|e| e.report_instead_of(&nodes, problem));
                by_lane[lane] = by_lane[0].clone();
            }
        }
        let mut leaf = 0..;
        first.map(|_| {
            let leaf = leaf.next().expect("endless");
            self.each_signal(by_lane.iter().map(|lane| lane[leaf].1).collect(), loc)
        })
    }

    fn each_signal(&self, signals: Vec<Signal>, loc: Loc) -> Lanes {
        let width = signals[0].width;
        let nodes: Vec<_> = signals.iter().map(|signal| signal.id_at(loc)).collect();
        let same = signals.iter().all(|signal| signal.width == width);
        if signals.len() != self.lanes as usize || !same {
            let message = match same {
                true => format!("an array of {} lanes is fed {} signals", self.lanes, signals.len()),
                false => "the signals that feed one input of an array have different widths".to_owned(),
            };
            let problem = Problem::new(loc, message).help("give one signal for each lane, all of one width");
            elaboration::with(|e| e.report_instead_of(&nodes, problem));
            return self.constants(width, |_| 0);
        }
        Lanes::make(Op::Stack { parts: nodes, axis: 0 }, width, self.lanes, loc)
    }

    /// A constant for each lane, of `width` bits.
    #[track_caller]
    pub fn constants(&self, width: u32, of: impl Fn(u32) -> u64) -> Lanes {
        let loc = Loc::caller();
        let signals = crate::select::constants(width, (0..self.lanes).map(of));
        let width = signals[0].width;
        let nodes = signals.iter().map(|signal| signal.id_at(loc)).collect();
        Lanes::make(Op::Stack { parts: nodes, axis: 0 }, width, self.lanes, loc)
    }

    /// Each lane's own number, of `width` bits.
    #[track_caller]
    pub fn index(&self, width: u32) -> Lanes {
        self.constants(width, u64::from)
    }
}

impl Lanes {
    fn make(op: Op, width: u32, count: u32, loc: Loc) -> Lanes {
        elaboration::with(|e| {
            let (stamp, draft) = (e.stamp, e.draft());
            let node = draft.add(op, width, Shape::Row(count), loc);
            Lanes { stamp, module: draft.serial, node, width, count }
        })
    }

    /// The node, if it belongs to the module under construction; the handle of another module is a panic, as only
    /// a helper that keeps handles between blocks can have one.
    #[track_caller]
    pub(crate) fn id(self) -> NodeId {
        self.id_at(Loc::caller())
    }

    /// As [`Lanes::id`], used at `loc`: for closures, which are their own callers.
    pub(crate) fn id_at(self, loc: Loc) -> NodeId {
        elaboration::with(|e| {
            crate::signal::check_stamp(e, self.stamp, loc);
            assert!(
                e.draft().serial == self.module,
                "lanes of another module are used, at {loc}: pass them through ports"
            );
        });
        self.node
    }

    /// The number of lanes.
    pub fn count(self) -> u32 {
        self.count
    }

    /// The width of one element in bits.
    pub fn width(self) -> u32 {
        self.width
    }

    /// What the neighbour with the next lower index has; lane 0 has `edge`.
    #[track_caller]
    pub fn previous(self, edge: impl Operand) -> Lanes {
        self.shifted(1, edge)
    }

    /// What the neighbour with the next higher index has; the last lane has `edge`.
    #[track_caller]
    pub fn following(self, edge: impl Operand) -> Lanes {
        self.shifted(-1, edge)
    }

    /// Lane `i` has what lane `i - by` has; lanes that have no such neighbour have `edge`.
    #[track_caller]
    pub fn shifted(self, by: i32, edge: impl Operand) -> Lanes {
        let loc = Loc::caller();
        // All are beyond the edge from there on.
        let most = i32::try_from(self.count).unwrap_or(i32::MAX);
        let by = by.clamp(-most, most);
        let shape = self.lane(0);
        let edge = edge.operand().with_width_of(shape, "shifted").id();
        // Where no lane is beyond the edge, nothing takes it.
        if by == 0 {
            elaboration::draft(|draft| draft.ignored.insert(edge));
        }
        let edge = (by != 0).then_some(edge);
        let op = Op::Map { of: self.id(), axis: 0, index: Affine::shift(-by), edge };
        Lanes::make(op, self.width, self.count, loc)
    }

    /// The element of one lane.
    #[track_caller]
    pub fn lane(self, index: u32) -> Signal {
        let loc = Loc::caller();
        if index >= self.count {
            let problem = Problem::new(loc, format!("lane {index} of an array of {} lanes", self.count));
            elaboration::with(|e| e.report(problem.help("lanes count from 0")));
            return crate::lit(self.width, 0);
        }
        Signal::make(Op::Lane { of: self.id(), axis: 0, index }, self.width)
    }

    /// The element of the last lane.
    #[track_caller]
    pub fn last(self) -> Signal {
        self.lane(self.count - 1)
    }

    /// The elements of all lanes, as plain signals.
    #[track_caller]
    pub fn to_vec(self) -> Vec<Signal> {
        let mut signals = Vec::new();
        for lane in 0..self.count {
            signals.push(self.lane(lane));
        }
        signals
    }

    #[track_caller]
    fn reduce(self, reduction: Reduction) -> Signal {
        Signal::make(Op::Reduce { by: reduction, of: self.id(), axis: 0 }, self.width)
    }

    /// Bitwise and of all lanes.
    #[track_caller]
    pub fn and_all(self) -> Signal {
        self.reduce(Reduction::And)
    }

    /// Bitwise or of all lanes.
    #[track_caller]
    pub fn or_all(self) -> Signal {
        self.reduce(Reduction::Or)
    }

    /// Bitwise exclusive or of all lanes.
    #[track_caller]
    pub fn xor_all(self) -> Signal {
        self.reduce(Reduction::Xor)
    }

    /// The sum of all lanes, modulo 2 to the width.
    #[track_caller]
    pub fn sum(self) -> Signal {
        self.reduce(Reduction::Add)
    }
}
