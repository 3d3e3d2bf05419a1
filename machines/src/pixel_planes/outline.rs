//! The extent of a primitive, and the squares of a grid to which it is binned.
//!
//! Source: PP5-HVB (bounding box) and PP5-HV (whole columns of regions). Extents are those of the vertices, not of the drawn pixels. For them
//! the formulas are exact as means over all places.
//!
//! No centre of a pixel is on a border of squares, so a square in which a polygon has a pixel meets its extent. In each column, a line has the
//! pixel that contains its point there, so its extent needs no width. If that point is on the border of two pixels, the fill rule may choose the
//! upper one, or for a steep line the left one. So a border of squares belongs to the squares above and to the left of it.

use std::ops::RangeInclusive;
use tilewright_scenes::ScreenVertex;
use tilewright_scenes::packet::SUBPIXELS;

/// The way to find the squares of a primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binner {
    /// All squares that the bounding box of its vertices meets (PP5-HVB).
    Box,
    /// In each column that a line meets, the squares that it passes if it is extended to both sides of the column: at most two (PP5-HV). Lines
    /// of more than 45 degrees have rows instead of columns. Polygons are binned as by [`Binner::Box`].
    Columns,
    /// In each column, the squares between its least and its greatest place there, which are exactly those that it meets. Lines of more than 45
    /// degrees have rows instead of columns.
    Tight,
}

impl Binner {
    /// All of them.
    pub const ALL: [Binner; 3] = [Binner::Box, Binner::Columns, Binner::Tight];
}

/// The vertices of a convex polygon, or of a line.
///
/// ```
/// use tilewright_machines::pixel_planes::{Binner, Outline, Regions};
/// use tilewright_scenes::{ScreenVertex, Size};
///
/// // A long and a short line on a screen of 4x2 regions.
/// let at = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [0; 3] };
/// let (long, short) = (Outline::of(&[at(1, 1), at(510, 200)]), Outline::of(&[at(300, 100), at(330, 120)]));
/// let regions = Regions::new(Size::new(512, 256)?, 128)?;
/// let of = |line| Binner::ALL.map(|binner| regions.of(line, binner));
/// assert_eq!(of(&long), [vec![0, 1, 2, 3, 4, 5, 6, 7], vec![0, 1, 2, 6, 7], vec![0, 1, 2, 6, 7]]);
/// // Extended in its column, it reaches the region below.
/// assert_eq!(of(&short), [vec![2], vec![2, 6], vec![2]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outline {
    /// In 1/16 pixel.
    corners: Vec<Place>,
}

type Place = (i64, i64);

/// Columns of squares, counted from the left border of the screen, each with rows. If transposed, rows with columns.
pub(super) type Spans = Vec<(i64, RangeInclusive<i64>)>;

impl Outline {
    /// The outline of a line's two ends, or of a convex polygon's corners, as in [`tilewright_scenes::Polygons::vertices`].
    pub fn of(vertices: &[ScreenVertex]) -> Outline {
        Outline { corners: vertices.iter().map(|v| (i64::from(v.x), i64::from(v.y))).collect() }
    }

    fn is_line(&self) -> bool {
        self.corners.len() == 2
    }

    /// Whether its extent along y is at most that along x.
    fn is_flat(&self) -> bool {
        let length = |(least, greatest): (i64, i64)| greatest - least;
        length(self.range(|place| place.0)) >= length(self.range(|place| place.1))
    }

    /// The least and the greatest position along an axis.
    fn range(&self, of: impl Fn(&Place) -> i64) -> (i64, i64) {
        let positions = self.corners.iter().map(of);
        positions.fold((i64::MAX, i64::MIN), |(least, greatest), at| (least.min(at), greatest.max(at)))
    }

    /// Rows of squares of `side` pixels by column, or, with `true`, columns by row.
    pub(super) fn spans(&self, binner: Binner, side: u32) -> (Spans, bool) {
        let unit = i64::from(SUBPIXELS) * i64::from(side);
        if self.is_line() && !self.is_flat() {
            (self.transposed().lanes(binner, unit), true)
        } else {
            (self.lanes(binner, unit), false)
        }
    }

    fn lanes(&self, binner: Binner, unit: i64) -> Spans {
        match binner {
            Binner::Columns if self.is_line() => self.whole_columns(unit),
            Binner::Box | Binner::Columns => self.whole_box(unit),
            Binner::Tight => self.tight(unit),
        }
    }

    fn transposed(&self) -> Outline {
        Outline { corners: self.corners.iter().map(|&(x, y)| (y, x)).collect() }
    }

    /// The columns of squares of `unit` that it meets.
    fn columns(&self, unit: i64) -> RangeInclusive<i64> {
        let (least, greatest) = self.range(|place| place.0);
        square(least, unit, self.is_line())..=square(greatest, unit, self.is_line())
    }

    fn whole_box(&self, unit: i64) -> Spans {
        let rows = self.transposed().columns(unit);
        self.columns(unit).map(|column| (column, rows.clone())).collect()
    }

    fn whole_columns(&self, unit: i64) -> Spans {
        let side = Side::between(self.corners[0], self.corners[1]);
        let rows = |column| side.rows(column * unit, (column + 1) * unit, unit, self.is_line());
        self.columns(unit).map(|column| (column, rows(column))).collect()
    }

    fn tight(&self, unit: i64) -> Spans {
        let next = self.corners.iter().cycle().skip(1);
        let sides: Vec<Side> = self.corners.iter().zip(next).map(|(&p, &q)| Side::between(p, q)).collect();
        let rows = |column: i64| {
            let (left, right) = (column * unit, (column + 1) * unit);
            let met = sides.iter().filter(|side| side.from.0 <= right && left <= side.to.0);
            let rows = met.map(|side| side.rows(left.max(side.from.0), right.min(side.to.0), unit, self.is_line()));
            rows.reduce(|all, rows| *all.start().min(rows.start())..=*all.end().max(rows.end()))
        };
        self.columns(unit).filter_map(|column| Some((column, rows(column)?))).collect()
    }
}

/// The number of the square of `unit` that contains a position. On a border it is the square after it, or for a line the one `before`.
fn square(position: i64, unit: i64, before: bool) -> i64 {
    (position - i64::from(before)).div_euclid(unit)
}

/// A side of an outline, from left to right.
struct Side {
    from: Place,
    to: Place,
}

impl Side {
    fn between(p: Place, q: Place) -> Side {
        if p.0 <= q.0 { Side { from: p, to: q } } else { Side { from: q, to: p } }
    }

    /// The rows of squares of `unit` that the side, or its continuation, passes from x = `left` to x = `right`. A vertical side is not
    /// continued.
    fn rows(&self, left: i64, right: i64, unit: i64, before: bool) -> RangeInclusive<i64> {
        let (dx, dy) = (self.to.0 - self.from.0, self.to.1 - self.from.1);
        let (first, last) = match dx {
            0 => (square(self.from.1, unit, before), square(self.to.1, unit, before)),
            // Multiplied by dx, so exact; below 2^40.
            _ => {
                let row = |x: i64| square(self.from.1 * dx + (x - self.from.0) * dy, dx * unit, before);
                (row(left), row(right))
            }
        };
        first.min(last)..=first.max(last)
    }
}
