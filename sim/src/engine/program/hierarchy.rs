//! The names of a program: the tree of instances as in the Verilog, and the value behind each name.

use tilewright_circuit::ir::{Kind, Shape};

use super::ValueId;

/// The index of a scope in [`Hierarchy::scopes`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ScopeId(pub u32);

/// The tree of scopes; the first is the top module.
#[derive(Debug, Clone, Default)]
pub struct Hierarchy {
    /// Every scope, parents before their children.
    pub scopes: Vec<Scope>,
}

/// An instance, or all lanes of an instance array.
#[derive(Debug, Clone)]
pub struct Scope {
    /// The instance's name; the module's name for the top.
    pub name: String,
    /// The name of its module.
    pub module: String,
    /// The scope that contains it.
    pub parent: Option<ScopeId>,
    /// Its replication.
    pub replication: Replication,
    /// The number of instances that it represents: the lanes of its values.
    pub lanes: u32,
    /// The clocks of the module, by the names of its ports.
    pub clocks: Vec<ClockPort>,
    /// Its signals in the sequence of declaration: ports, then the rest.
    pub signals: Vec<Signal>,
    /// Its memories: name, index in [`Program::memories`](super::Program::memories), and shape in this scope.
    pub memories: Vec<(String, u32, Shape)>,
    /// The scopes in it.
    pub children: Vec<ScopeId>,
}

/// Whether a scope is an instance or an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Replication {
    /// A single instance.
    Single,
    /// A whole array of instances of this shape, side by side in lanes.
    Whole(Shape),
    /// One element, by number, of an array of this shape that does not run in lanes.
    Element(Shape, u32),
    /// One of several separate instances of a module that run side by side in lanes.
    Sibling {
        /// Its lane.
        index: u32,
        /// The number of instances.
        of: u32,
    },
}

impl Replication {
    /// The number of lanes for each lane of its parent.
    fn lanes(self) -> u32 {
        match self {
            Replication::Whole(shape) => shape.lanes(),
            Replication::Sibling { of, .. } => of,
            Replication::Single | Replication::Element(..) => 1,
        }
    }
}

/// A clock port of a scope.
#[derive(Debug, Clone)]
pub struct ClockPort {
    /// The clock port.
    pub port: String,
    /// The reset port.
    pub reset: Option<String>,
    /// The clock, by index in [`Program::clocks`](super::Program::clocks).
    pub clock: u32,
}

/// A named value.
#[derive(Debug, Clone)]
pub struct Signal {
    /// Its name.
    pub name: String,
    /// Its role.
    pub role: Role,
    /// Its value. It has the lanes of its scope, times those of its shape.
    pub value: ValueId,
    /// The width of one lane in bits.
    pub width: u32,
    /// Its shape in its own scope.
    pub shape: Shape,
    /// The meaning of its bits.
    pub kind: Kind,
}

/// The lane of a shape in the form of names: nothing, `[3]` or `[1][2]`.
pub fn index(shape: Shape, lane: u32) -> String {
    let axes = (0..shape.axes()).map(|axis| format!("[{}]", shape.along(axis, lane)));
    axes.collect()
}

/// The lane that such a text means, if there is one.
pub fn at_index(shape: Shape, text: &str) -> Option<u32> {
    let lane = match shape {
        Shape::Plain => 0,
        Shape::Row(_) => text.strip_prefix('[')?.strip_suffix(']')?.parse().ok()?,
        Shape::Grid(_, columns) => {
            let (row, column) = text.strip_prefix('[')?.strip_suffix(']')?.split_once("][")?;
            row.parse::<u32>().ok()?.checked_mul(columns)?.checked_add(column.parse().ok()?)?
        }
    };
    // Numbers have several spellings, and columns may be out of range.
    (lane < shape.lanes() && index(shape, lane) == text).then_some(lane)
}

/// The role of a named value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// An input port.
    Input,
    /// An output port, unless a register of the same name drives it.
    Output,
    /// A register, which may be an output port as well.
    Register,
    /// The data register of a synchronous memory read.
    ReadData,
    /// A named net.
    Net,
}

/// One instance: a scope and its lane there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// The scope.
    pub scope: ScopeId,
    /// The lane.
    pub lane: u32,
}

impl Hierarchy {
    /// The scope with this id.
    pub fn scope(&self, id: ScopeId) -> &Scope {
        &self.scopes[id.0 as usize]
    }

    /// The top module's instance in a run; the first run is 0.
    pub fn top(&self, run: u32) -> Place {
        Place { scope: ScopeId(0), lane: run }
    }

    /// The run that an instance belongs to.
    pub fn run(&self, place: Place) -> u32 {
        place.lane / (self.scope(place.scope).lanes / self.scopes[0].lanes)
    }

    /// The instances directly in an instance, with their names: `u_cell[3]` for an element of an array.
    pub fn children(&self, of: Place) -> Vec<(String, Place)> {
        let element = |scope: ScopeId| {
            let child = self.scope(scope);
            let count = if let Replication::Whole(shape) = child.replication { shape.lanes() } else { 1 };
            (0..count).map(move |i| match child.replication {
                Replication::Single => (child.name.clone(), Place { scope, lane: of.lane }),
                Replication::Sibling { index, of: n } => {
                    (child.name.clone(), Place { scope, lane: of.lane * n + index })
                }
                Replication::Element(shape, i) => {
                    (format!("{}{}", child.name, index(shape, i)), Place { scope, lane: of.lane })
                }
                Replication::Whole(shape) => {
                    (format!("{}{}", child.name, index(shape, i)), Place { scope, lane: of.lane * count + i })
                }
            })
        };
        self.scope(of.scope).children.iter().flat_map(|&child| element(child)).collect()
    }

    /// The instance of that name directly in an instance, if there is one.
    pub fn child(&self, of: Place, name: &str) -> Option<Place> {
        self.scope(of.scope).children.iter().find_map(|&scope| {
            let child = self.scope(scope);
            let rest = name.strip_prefix(child.name.as_str())?;
            let lane = match child.replication {
                Replication::Single => rest.is_empty().then_some(of.lane),
                Replication::Sibling { index, of: n } => rest.is_empty().then_some(of.lane * n + index),
                Replication::Element(shape, i) => (rest == index(shape, i)).then_some(of.lane),
                Replication::Whole(shape) => at_index(shape, rest).map(|i| of.lane * shape.lanes() + i),
            };
            Some(Place { scope, lane: lane? })
        })
    }

    /// The instance of a lane of values that these scopes share.
    pub fn instance(&self, scopes: &[ScopeId], lane: u32) -> Place {
        let mut places = scopes.iter().map(|&scope| Place { scope, lane });
        places.find(|&place| self.is_own(place)).expect("a lane is in some instance")
    }

    /// Whether a lane of a scope's values is its own, not that of an instance beside it.
    pub(crate) fn is_own(&self, place: Place) -> bool {
        let (mut scope, mut lane) = (self.scope(place.scope), place.lane);
        loop {
            if matches!(scope.replication, Replication::Sibling { index, of } if lane % of != index) {
                return false;
            }
            lane /= scope.replication.lanes();
            match scope.parent {
                Some(parent) => scope = self.scope(parent),
                None => return true,
            }
        }
    }

    /// An instance's path below the top, such as `u_row[1].u_cell[3]`; empty for the top.
    pub fn path(&self, place: Place) -> String {
        let mut names = Vec::new();
        let Place { mut scope, mut lane } = place;
        while let Some(parent) = self.scope(scope).parent {
            let here = self.scope(scope);
            names.push(match here.replication {
                Replication::Single | Replication::Sibling { .. } => here.name.clone(),
                Replication::Element(shape, i) => format!("{}{}", here.name, index(shape, i)),
                Replication::Whole(shape) => format!("{}{}", here.name, index(shape, lane % shape.lanes())),
            });
            lane /= here.replication.lanes();
            scope = parent;
        }
        names.reverse();
        names.join(".")
    }

    /// The path of a named object in an instance.
    pub fn path_in(&self, place: Place, name: &str) -> String {
        match self.path(place) {
            path if path.is_empty() => name.to_string(),
            path => format!("{path}.{name}"),
        }
    }

    /// Every instance of a run, each before those in it, in the sequence of declaration.
    pub fn places(&self, run: u32) -> Vec<Place> {
        let mut open = vec![self.top(run)];
        let mut all = Vec::new();
        while let Some(place) = open.pop() {
            all.push(place);
            open.extend(self.children(place).into_iter().rev().map(|(_, child)| child));
        }
        all
    }
}
