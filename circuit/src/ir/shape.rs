//! The shape of a value: plain, a row of lanes, or a grid of lanes.

use std::fmt;

/// The number and layout of a value's elements. Each element, called a lane, has the node's width.
///
/// Axis 0 of a row counts its lanes. Axis 0 of a grid counts its rows, axis 1 its columns. Linear lists of lanes are
/// in row-major order: lane `(row, column)` of a grid is lane `row * columns + column`.
///
/// ```
/// # use tilewright_hdl::*;
/// let shapes = [Shape::Plain, row(5), grid(3, 4)];
/// assert_eq!(shapes.map(|shape| shape.to_string()), ["no lanes", "5 lanes", "3 x 4 lanes"]);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shape {
    /// A single value, without lanes.
    #[default]
    Plain,
    /// A row with this number of lanes.
    Row(u32),
    /// A grid with this number of rows and of columns.
    Grid(u32, u32),
}

impl Shape {
    /// The total number of lanes; 1 for a plain value. It saturates at [`u32::MAX`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!([Shape::Plain, row(1), grid(3, 4)].map(Shape::lanes), [1, 1, 12]);
    /// ```
    pub fn lanes(self) -> u32 {
        match self {
            Shape::Plain => 1,
            Shape::Row(count) => count,
            Shape::Grid(rows, columns) => rows.saturating_mul(columns),
        }
    }

    /// Whether this is a single value, without lanes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // A row of one lane is not plain: it does not broadcast as a plain value does.
    /// assert!(Shape::Plain.is_plain() && !row(1).is_plain());
    /// ```
    pub fn is_plain(self) -> bool {
        self == Shape::Plain
    }

    /// The number of axes: 0, 1 or 2.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!([Shape::Plain, row(5), grid(1, 1)].map(Shape::axes), [0, 1, 2]);
    /// ```
    pub fn axes(self) -> u32 {
        match self {
            Shape::Plain => 0,
            Shape::Row(_) => 1,
            Shape::Grid(..) => 2,
        }
    }

    /// The number of lanes along an axis; 1 if the shape has no such axis.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!((grid(3, 4).extent(0), grid(3, 4).extent(1)), (3, 4));
    /// assert_eq!(row(5).extent(1), 1);
    /// ```
    pub fn extent(self, axis: u32) -> u32 {
        match (self, axis) {
            (Shape::Row(count), 0) => count,
            (Shape::Grid(rows, _), 0) => rows,
            (Shape::Grid(_, columns), 1) => columns,
            _ => 1,
        }
    }

    /// The shape without an axis; unchanged if there is no such axis.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // A grid without its row axis has the shape of one row.
    /// assert_eq!((grid(3, 4).without(0), grid(3, 4).without(1)), (row(4), row(3)));
    /// ```
    pub fn without(self, axis: u32) -> Shape {
        match (self, axis) {
            (Shape::Row(_), 0) => Shape::Plain,
            (Shape::Grid(_, columns), 0) => Shape::Row(columns),
            (Shape::Grid(rows, _), 1) => Shape::Row(rows),
            _ => self,
        }
    }

    /// The shape with an axis of `count` lanes inserted, the reverse of [`without`](Shape::without). `None` if that
    /// would be a third axis or leave a gap.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!((row(4).with(0, 3), row(4).with(1, 3)), (Some(grid(3, 4)), Some(grid(4, 3))));
    /// assert_eq!(grid(3, 4).with(0, 2), None);
    /// ```
    pub fn with(self, axis: u32, count: u32) -> Option<Shape> {
        match (self, axis) {
            (Shape::Plain, 0) => Some(Shape::Row(count)),
            (Shape::Row(columns), 0) => Some(Shape::Grid(count, columns)),
            (Shape::Row(rows), 1) => Some(Shape::Grid(rows, count)),
            _ => None,
        }
    }

    /// The product of the extents after an axis: the distance of neighbours along that axis in row-major order.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // The lane below is 4 further; the lane to the right is the next one.
    /// assert_eq!((grid(3, 4).inner(0), grid(3, 4).inner(1)), (4, 1));
    /// ```
    pub fn inner(self, axis: u32) -> u32 {
        match (self, axis) {
            (Shape::Grid(_, columns), 0) => columns,
            _ => 1,
        }
    }

    /// The product of the extents before an axis.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let shape = grid(3, 4);
    /// assert!([0, 1].iter().all(|&axis| shape.outer(axis) * shape.extent(axis) * shape.inner(axis) == shape.lanes()));
    /// ```
    pub fn outer(self, axis: u32) -> u32 {
        match (self, axis) {
            (Shape::Grid(rows, _), 1) => rows,
            _ => 1,
        }
    }

    /// The index of lane `lane` along an axis.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // Lane 11 of 3 x 5 is in row 2, column 1.
    /// assert_eq!((grid(3, 5).along(0, 11), grid(3, 5).along(1, 11)), (2, 1));
    /// ```
    pub fn along(self, axis: u32, lane: u32) -> u32 {
        lane / self.inner(axis) % self.extent(axis)
    }

    /// The index of lane `lane` in the shape [`without`](Shape::without) an axis.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // The position of lane 11 of 3 x 5 in its row, and in its column.
    /// assert_eq!((grid(3, 5).across(0, 11), grid(3, 5).across(1, 11)), (1, 2));
    /// ```
    pub fn across(self, axis: u32, lane: u32) -> u32 {
        let inner = self.inner(axis);
        lane / inner / self.extent(axis) * inner + lane % inner
    }

    /// The lane at index `along` of an axis and index `across` of the shape without it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let shape = grid(3, 5);
    /// assert_eq!(shape.lane(0, 2, 1), 11);
    /// assert_eq!(shape.lane(0, shape.along(0, 7), shape.across(0, 7)), 7);
    /// ```
    pub fn lane(self, axis: u32, along: u32, across: u32) -> u32 {
        let inner = self.inner(axis);
        (across / inner * self.extent(axis) + along) * inner + across % inner
    }

    /// This shape followed by another: the shape, seen from outside, of a port of shape `other` of an array of this
    /// shape. `None` for more than two axes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // A row of 2 blocks, each with a port of 3 lanes, needs a 2 x 3 grid.
    /// assert_eq!(row(2).beside(row(3)), Some(grid(2, 3)));
    /// assert_eq!(grid(2, 3).beside(row(4)), None);
    /// ```
    pub fn beside(self, other: Shape) -> Option<Shape> {
        match (self, other) {
            (shape, Shape::Plain) | (Shape::Plain, shape) => Some(shape),
            (Shape::Row(rows), Shape::Row(columns)) => Some(Shape::Grid(rows, columns)),
            _ => None,
        }
    }
}

/// The text for messages: `no lanes`, `1 lane`, `5 lanes`, `3 x 4 lanes`.
impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Shape::Plain => f.write_str("no lanes"),
            Shape::Row(1) => f.write_str("1 lane"),
            Shape::Row(count) => write!(f, "{count} lanes"),
            Shape::Grid(rows, columns) => write!(f, "{rows} x {columns} lanes"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Shape::{self, Grid, Plain, Row};

    #[test]
    fn axes_are_put_in_and_dropped() {
        for (shape, axis, with) in [(Plain, 0, Row(3)), (Row(5), 0, Grid(3, 5)), (Row(5), 1, Grid(5, 3))] {
            assert_eq!(shape.with(axis, 3), Some(with));
            assert_eq!(with.without(axis), shape);
            assert_eq!(with.extent(axis), 3);
            assert_eq!(with.axes(), shape.axes() + 1);
            assert_eq!(with.outer(axis) * with.extent(axis) * with.inner(axis), with.lanes());
        }
        for (shape, axis) in [(Plain, 1), (Row(5), 2), (Grid(1, 1), 0)] {
            assert_eq!(shape.with(axis, 3), None);
        }
        assert_eq!((Row(5).without(1), Row(5).extent(1)), (Row(5), 1));
    }

    #[test]
    fn neighbours_are_row_major() {
        assert_eq!((Grid(3, 5).inner(0), Grid(3, 5).inner(1)), (5, 1));
        assert_eq!((Grid(3, 5).outer(0), Grid(3, 5).outer(1)), (1, 3));
        assert_eq!((Row(5).inner(0), Row(5).outer(0), Row(5).lanes()), (1, 1, 5));
        assert_eq!(Grid(1 << 20, 1 << 20).lanes(), u32::MAX);
    }

    #[test]
    fn a_lane_stands_along_an_axis_and_across_it() {
        // Lane 11 of a 3 x 5 grid is in row 2, column 1.
        assert_eq!((Grid(3, 5).along(0, 11), Grid(3, 5).across(0, 11)), (2, 1));
        assert_eq!((Grid(3, 5).along(1, 11), Grid(3, 5).across(1, 11)), (1, 2));
        for (shape, axis) in [(Row(7), 0), (Grid(3, 5), 0), (Grid(3, 5), 1)] {
            for lane in 0..shape.lanes() {
                let (along, across) = (shape.along(axis, lane), shape.across(axis, lane));
                assert!(along < shape.extent(axis) && across < shape.without(axis).lanes());
                assert_eq!(shape.lane(axis, along, across), lane);
            }
        }
    }

    #[test]
    fn shapes_stand_beside_each_other_up_to_two_axes() {
        assert_eq!(Plain.beside(Grid(2, 3)), Some(Grid(2, 3)));
        assert_eq!(Grid(2, 3).beside(Plain), Some(Grid(2, 3)));
        assert_eq!(Row(2).beside(Row(3)), Some(Grid(2, 3)));
        assert_eq!(Grid(2, 3).beside(Row(1)), None);
        assert_eq!(Row(1).beside(Grid(2, 3)), None);
    }

    #[test]
    fn messages_say_it() {
        let text = |shape: Shape| shape.to_string();
        assert_eq!([Plain, Row(1), Row(5), Grid(3, 4)].map(text), ["no lanes", "1 lane", "5 lanes", "3 x 4 lanes"]);
    }
}
