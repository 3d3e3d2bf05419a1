//! Operations that lead from one shape to another.

use super::*;

impl Builder<'_> {
    /// A value with the axis, which is one of its own.
    fn along(&mut self, of: Pick, axis: u8) -> (NodeId, u32) {
        let of = self.any_lanes(of);
        (of, u32::from(axis) % self.build.shape(of).axes())
    }

    /// A value with at most one axis, and one that can be put in.
    fn room(&mut self, of: Pick, axis: u8) -> (NodeId, u32) {
        let of = self.any(of);
        let of = match self.build.shape(of) {
            Shape::Grid(..) => self.drop(of, u32::from(axis) / 2 % 2, axis.into()),
            _ => of,
        };
        (of, u32::from(axis) % (self.build.shape(of).axes() + 1))
    }

    pub fn lanes(&mut self, make: &Make) -> NodeId {
        match make {
            Make::Broadcast { of, axis, count } => {
                let (of, axis) = self.room(*of, *axis);
                let count = self.count(*count, MOST_LANES / self.build.shape(of).lanes());
                self.build.broadcast(of, axis, count)
            }
            Make::Stack { parts, axis } => {
                let (first, axis) = self.room(parts[0], *axis);
                let (width, shape) = (self.build.width(first), self.build.shape(first));
                let others = parts[1..].iter().take((MOST_LANES / shape.lanes()) as usize - 1);
                let others: Vec<NodeId> = others.map(|pick| self.fit(*pick, width, shape)).collect();
                let parts: Vec<NodeId> = [first].into_iter().chain(others).collect();
                self.build.stack(&parts, axis)
            }
            Make::Map { of, axis, route, count, edge } => {
                let (of, axis) = self.along(*of, *axis);
                let shape = self.build.shape(of);
                let (extent, across) = (shape.extent(axis), shape.without(axis));
                let same = matches!(route, Route::Shift(_) | Route::Reverse);
                let count = if same { extent } else { self.count(*count, MOST_LANES / across.lanes()) };
                self.map(of, axis, count, route.affine(extent, count), *edge)
            }
            Make::Interleave { parts, axis } => {
                let (first, axis) = self.along(parts[0], *axis);
                let (width, shape) = (self.build.width(first), self.build.shape(first));
                let others = parts[1..].iter().take((MOST_LANES / shape.lanes()).max(1) as usize - 1);
                let others: Vec<NodeId> = others.map(|pick| self.fit(*pick, width, shape)).collect();
                let parts: Vec<NodeId> = [first].into_iter().chain(others).collect();
                self.build.interleave(&parts, axis)
            }
            Make::Lane { of, axis, index } => {
                let (of, axis) = self.along(*of, *axis);
                self.build.lane(of, axis, u32::from(*index) % self.build.shape(of).extent(axis))
            }
            Make::PickLane { of, axis, index, bits } => {
                let (of, axis) = self.along(*of, *axis);
                let across = self.build.shape(of).without(axis);
                let index = match bits {
                    Some(bits) => self.fit(*index, *bits, across),
                    None => {
                        let (index, how) = self.choose(*index, across);
                        self.in_shape(index, across, how)
                    }
                };
                self.build.pick(of, axis, index)
            }
            Make::Reduce { by, of, axis } => {
                let (of, axis) = self.along(*of, *axis);
                self.build.reduce(*by, of, axis)
            }
            Make::ReduceAll { by, of } => {
                let mut of = self.any_lanes(*of);
                while !self.build.shape(of).is_plain() {
                    of = self.build.reduce(*by, of, 0);
                }
                of
            }
            Make::Pack { of, axis } => {
                let (of, axis) = self.along(*of, *axis);
                let of = self.cut(of, WIDEST_PACKED / self.build.shape(of).extent(axis));
                self.build.pack(of, axis)
            }
            Make::Unpack { of, axis, count } => {
                let (of, axis) = self.room(*of, *axis);
                let count = self.count(*count, MOST_LANES / self.build.shape(of).lanes());
                let width = (self.build.width(of) / count).max(1) * count;
                let of = self.in_width(of, width, true);
                self.build.unpack(of, axis, count)
            }
            Make::Apart { of, with, axis } => self.apart(*of, with, *axis),
            other => unreachable!("no operation on lanes: {other:?}"),
        }
    }

    /// Lanes of a value, with an edge where that is needed.
    pub fn map(&mut self, of: NodeId, axis: u32, count: u32, index: Affine, edge: Pick) -> NodeId {
        let shape = self.build.shape(of);
        let inside = index.stays_inside(count, shape.extent(axis));
        let edge = (!inside).then(|| self.fit(edge, self.build.width(of), shape.without(axis)));
        self.build.map(of, axis, count, index, edge)
    }

    /// Each lane on its own, and together again.
    fn apart(&mut self, of: Pick, with: &[(Fold, Pick)], axis: u8) -> NodeId {
        let (of, axis) = self.along(of, axis);
        let (width, shape) = (self.build.width(of), self.build.shape(of));
        // Lanes of their own, or one value for all.
        let with: Vec<(Fold, NodeId)> = with
            .iter()
            .map(|&(fold, pick)| {
                let (value, how) = self.choose(pick, shape);
                let value = self.in_width(value, width, how % 2 == 1);
                let is_alike = self.build.shape(value) == shape;
                (fold, if is_alike { value } else { self.in_shape(value, shape.without(axis), how / 2) })
            })
            .collect();
        let lanes = (0..shape.extent(axis)).map(|index| {
            let mut lane = self.build.lane(of, axis, index);
            for &(fold, value) in &with {
                let is_alike = self.build.shape(value) == shape;
                let other = if is_alike { self.build.lane(value, axis, index) } else { value };
                lane = self.fold(fold, lane, other);
            }
            lane
        });
        let lanes: Vec<NodeId> = lanes.collect();
        self.build.stack(&lanes, axis)
    }

    /// Two values of one width and shape, which the result has too.
    pub fn fold(&mut self, fold: Fold, a: NodeId, b: NodeId) -> NodeId {
        let (width, shape) = (self.build.width(a), self.build.shape(a));
        match fold {
            Fold::Binary(op) => {
                let result = self.build.binary(op, a, b);
                self.cut(result, width)
            }
            Fold::Min => {
                let less = self.compare(Relation::Lt, false, a, b);
                self.build.mux(less, a, b)
            }
            Fold::Shifted => self.build.node(Op::Shift(Shift::Left, a, b), width, shape),
            Fold::Chosen => {
                let odd = self.in_width(b, 1, false);
                let inverse = self.build.not(a);
                self.build.mux(odd, a, inverse)
            }
        }
    }
}

impl Route {
    /// The rule for so many lanes of an operand with so many.
    pub fn affine(self, extent: u32, count: u32) -> Affine {
        match self {
            Route::Shift(by) => Affine::shift(by.into()),
            Route::Reverse => Affine { mul: -1, add: extent as i32 - 1, div: 1 },
            Route::Stretch(times) => Affine { mul: 1, add: 0, div: u32::from(times).max(1) },
            Route::Stride(step) => Affine { mul: step.into(), add: 0, div: 1 },
            Route::Spread => Affine { mul: extent as i32, add: 0, div: count },
            Route::Any(affine) => Affine { div: affine.div.max(1), ..affine },
        }
    }
}
