//! What a pick stands for, and how a value is brought to the width and the shape that it meets.

use super::*;

impl Builder<'_> {
    /// The shape that is picked.
    pub fn shape(&self, ShapePick(pick): ShapePick) -> Shape {
        self.shapes[usize::from(pick) % self.shapes.len()]
    }

    /// The count that is picked, at most so large; along any axis, if the part has no shapes.
    pub fn count(&self, Count(pick): Count, most: u32) -> u32 {
        let mut counts: Vec<u32> = vec![2];
        for shape in &self.part.shapes {
            counts.extend((0..shape.axes()).map(|axis| shape.extent(axis)));
        }
        counts[usize::from(pick) % counts.len()].clamp(1, most.max(1))
    }

    /// The value that is picked, most often one of that shape, and what else the pick says.
    pub fn choose(&self, Pick(pick): Pick, shape: Shape) -> (NodeId, usize) {
        let pick = usize::from(pick);
        let alike: Vec<NodeId> = self.values.iter().copied().filter(|&id| self.build.shape(id) == shape).collect();
        let (from, pick) = match pick % 3 {
            0 => (&self.values, pick / 3),
            _ if alike.is_empty() => (&self.values, pick / 3),
            _ => (&alike, pick / 3),
        };
        (from[pick % from.len()], pick / from.len())
    }

    /// The value that is picked, as it is.
    pub fn any(&self, Pick(pick): Pick) -> NodeId {
        self.values[usize::from(pick) % self.values.len()]
    }

    /// The value that is picked, with an axis at least.
    pub fn any_lanes(&mut self, pick: Pick) -> NodeId {
        let has_lanes = |&id: &NodeId| !self.build.shape(id).is_plain();
        let shaped: Vec<NodeId> = self.values.iter().copied().filter(has_lanes).collect();
        if shaped.is_empty() {
            let plain = self.any(pick);
            return self.build.everywhere(plain, self.wide());
        }
        shaped[usize::from(pick.0) % shaped.len()]
    }

    /// A shape with an axis at least.
    pub fn wide(&self) -> Shape {
        self.shapes.iter().copied().find(|shape| !shape.is_plain()).unwrap_or(Shape::Row(3))
    }

    /// The value that is picked, in that width and shape.
    pub fn fit(&mut self, pick: Pick, width: u32, shape: Shape) -> NodeId {
        let (value, how) = self.choose(pick, shape);
        let value = self.in_width(value, width, how % 2 == 1);
        self.in_shape(value, shape, how / 2)
    }

    /// Cut or widened, with the sign or with zeros.
    pub fn in_width(&mut self, of: NodeId, width: u32, signed: bool) -> NodeId {
        let (has, shape) = (self.build.width(of), self.build.shape(of));
        match has.cmp(&width) {
            std::cmp::Ordering::Equal => of,
            std::cmp::Ordering::Less => self.build.node(Op::Extend { of, signed }, width, shape),
            std::cmp::Ordering::Greater => self.build.node(Op::Slice { of, low: 0 }, width, shape),
        }
    }

    /// Not wider than that.
    pub fn cut(&mut self, of: NodeId, most: u32) -> NodeId {
        let width = self.build.width(of).min(most);
        self.in_width(of, width, false)
    }

    /// The value in another shape, in one of several ways.
    pub fn in_shape(&mut self, of: NodeId, shape: Shape, how: usize) -> NodeId {
        let has = self.build.shape(of);
        match (has, shape) {
            _ if has == shape => of,
            (Shape::Plain, _) => self.build.everywhere(of, shape),
            (Shape::Row(_), Shape::Plain) => self.drop(of, 0, how),
            (Shape::Row(_), Shape::Row(count)) => self.spread(of, 0, count),
            (Shape::Grid(..), Shape::Plain | Shape::Row(_)) => {
                let axis = (0..2).find(|&axis| has.without(axis) == shape).unwrap_or(how as u32 % 2);
                let row = self.drop(of, axis, how / 2);
                self.in_shape(row, shape, how / 8)
            }
            (Shape::Row(_), Shape::Grid(..)) => {
                let first = how as u32 % 2;
                let axis = [first, 1 - first].into_iter().find(|&axis| shape.without(axis) == has).unwrap_or(first);
                let row = self.in_shape(of, shape.without(axis), how / 2);
                self.build.broadcast(row, axis, shape.extent(axis))
            }
            (Shape::Grid(..), Shape::Grid(rows, columns)) => {
                let rows = self.spread(of, 0, rows);
                self.spread(rows, 1, columns)
            }
        }
    }

    /// An axis less.
    pub fn drop(&mut self, of: NodeId, axis: u32, how: usize) -> NodeId {
        let count = self.build.shape(of).extent(axis);
        match how % 4 {
            0 => self.build.lane(of, axis, (how / 4) as u32 % count),
            1 => self.build.reduce(Reduction::Xor, of, axis),
            2 => self.build.reduce(Reduction::Add, of, axis),
            _ => self.build.lane(of, axis, count - 1),
        }
    }

    /// So many lanes along an axis, spread evenly over those that there are.
    pub fn spread(&mut self, of: NodeId, axis: u32, count: u32) -> NodeId {
        let has = self.build.shape(of).extent(axis);
        if has == count {
            return of;
        }
        self.build.map(of, axis, count, Affine { mul: has as i32, add: 0, div: count }, None)
    }
}
