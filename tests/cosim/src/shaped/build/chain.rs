//! Values that read themselves in other lanes: nets, within the clock; registers, at the next edge.

use super::*;

/// Where along an axis values come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// From lanes with lower numbers.
    Before,
    /// From lanes with higher ones.
    Behind,
}

impl Direction {
    /// The direction of a rule for so many lanes; `None` if a lane comes from itself, or from both sides.
    fn of(index: Affine, count: u32) -> Option<Direction> {
        let mut all = (0..count).filter_map(|lane| Some((lane, index.source(lane, count)?)));
        match all.clone().all(|(lane, from)| from < lane) {
            true => Some(Direction::Before),
            false => all.all(|(lane, from)| from > lane).then_some(Direction::Behind),
        }
    }

    pub fn neighbour(self) -> Affine {
        Affine::shift(if self == Direction::Before { -1 } else { 1 })
    }
}

impl Builder<'_> {
    /// What a value that has lanes is in other lanes; these lie in one direction for each axis, if directions are given.
    fn other_lanes(&mut self, of: NodeId, link: &Link, directions: Option<&mut [Option<Direction>; 2]>) -> NodeId {
        let shape = self.build.shape(of);
        let axis = u32::from(link.axis) % shape.axes();
        let count = shape.extent(axis);
        let mut index = link.route.affine(count, count);
        if let Some(directions) = directions {
            let wanted = &mut directions[axis as usize];
            let has = Direction::of(index, count);
            *wanted = wanted.or(has).or(Some(Direction::Before));
            if has != *wanted {
                index = wanted.expect("it is set").neighbour();
            }
        }
        self.map(of, axis, count, index, link.edge)
    }

    /// What is made of other lanes of a value.
    pub fn follow(&mut self, of: NodeId, link: &Link, directions: Option<&mut [Option<Direction>; 2]>) -> NodeId {
        let (width, shape) = (self.build.width(of), self.build.shape(of));
        let other = self.other_lanes(of, link, directions);
        link.with.iter().fold(other, |value, (fold, pick)| {
            let with = self.fit(*pick, width, shape);
            self.fold(*fold, value, with)
        })
    }

    /// A named net of that shape, to be driven.
    fn wire(&mut self, name: &str, width: u32, shape: Shape) -> NodeId {
        let name = self.name(name, Kind::Inner);
        let wire = self.build.node(Op::Wire(NodeId(0)), width, shape);
        self.build.named(&name, wire)
    }

    fn drive(&mut self, wire: NodeId, driver: NodeId) {
        self.build.module.nodes[wire.0 as usize].op = Op::Wire(driver);
    }

    /// A net for each link, driven by what follows from it and from the next one in other lanes.
    pub fn chain(&mut self, number: usize, width: u32, shape: ShapePick, links: &[Link]) {
        let shape = match self.shape(shape) {
            Shape::Plain => self.wide(),
            shape => shape,
        };
        let wires = (0..links.len()).map(|index| self.wire(&format!("w{number}_{index}"), width, shape));
        let wires: Vec<NodeId> = wires.collect();
        let mut directions = [None; 2];
        let ways = wires.iter().zip(links).map(|(&wire, link)| self.follow(wire, link, Some(&mut directions)));
        let ways: Vec<NodeId> = ways.collect();
        for (index, &wire) in wires.iter().enumerate() {
            let next = ways[(index + 1) % ways.len()];
            let both = if ways.len() > 1 { self.build.xor(ways[index], next) } else { next };
            self.drive(wire, both);
        }
        self.values.extend(&wires);
    }

    /// Each lane of a net made of the one before, by nodes of its own.
    pub fn ladder(&mut self, number: usize, of: Pick, axis: u8, fold: Fold) {
        let of = self.any_lanes(of);
        let (width, shape) = (self.build.width(of), self.build.shape(of));
        let axis = u32::from(axis) % shape.axes();
        let wire = self.wire(&format!("w{number}"), width, shape);
        let lanes = (0..shape.extent(axis)).map(|index| {
            let lane = self.build.lane(of, axis, index);
            if index == 0 {
                return lane;
            }
            let before = self.build.lane(wire, axis, index - 1);
            self.fold(fold, before, lane)
        });
        let lanes: Vec<NodeId> = lanes.collect();
        let all = self.build.stack(&lanes, axis);
        self.drive(wire, all);
        self.values.push(wire);
    }
}
