//! The sizes of a generator, and the records that its blocks exchange: packets, and the windows of polygons.

use std::fmt;

use super::banks::{Addresses, Banks};
use super::precision::Precision;
use super::spram::Spram;
use crate::prelude::*;

/// Linear functions of a polygon besides its edges: depth, red, green and blue (k_p of MPG-EQ5).
pub const PLANES: u32 = 4;
/// How many bits a distance on the screen has beyond those of a position: a sign, and twice the widest screen.
const BEYOND: u32 = 2;

/// The matrix of video processors: each has every `columns`-th pixel of every `rows`-th line (MPG-SPR).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Matrix {
    columns: u32,
    rows: u32,
}

impl Matrix {
    /// The greatest number of video processors along a side: k = 4 of the paper.
    pub const MAX_SIDE: u32 = 16;

    /// A matrix of p x q video processors.
    ///
    /// # Errors
    ///
    /// A side is not 1, 2, 4, 8 or 16.
    pub fn new(columns: u32, rows: u32) -> Result<Matrix, ParameterError> {
        if [columns, rows].iter().all(|side| side.is_power_of_two() && *side <= Matrix::MAX_SIDE) {
            return Ok(Matrix { columns, rows });
        }
        Err(ParameterError(format!(
            "a matrix of {columns}x{rows} video processors: each side has to be 1, 2, 4, 8 or 16"
        )))
    }

    /// p, the number of columns.
    pub fn columns(self) -> u32 {
        self.columns
    }

    /// q, the number of rows.
    pub fn rows(self) -> u32 {
        self.rows
    }

    /// The number of video processors, p q.
    pub fn processors(self) -> u32 {
        self.columns * self.rows
    }
}

/// The parameters of a generator; every block of it is built for a format.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Format {
    screen: Screen,
    matrix: Matrix,
    edges: u32,
    aperture: u32,
    precision: Precision,
    banks: Banks,
}

impl Format {
    /// The greatest number of edges of a polygon.
    pub const MAX_EDGES: u32 = 8;
    /// The greatest aperture.
    pub const MAX_APERTURE: u32 = 8;

    /// A generator for a screen, with a matrix of video processors, that draws convex polygons with 3 to `edges` edges.
    ///
    /// # Errors
    ///
    /// `edges` is below 3 or above 8.
    pub fn new(screen: Screen, matrix: Matrix, edges: u32) -> Result<Format, ParameterError> {
        let most = Format::MAX_EDGES;
        if (3..=most).contains(&edges) {
            return Ok(Format {
                screen,
                matrix,
                edges,
                aperture: 0,
                precision: Precision::FULL,
                banks: Banks::TwoPorts,
            });
        }
        Err(ParameterError(format!("polygons of up to {edges} edges: the limit has to be from 3 to {most}")))
    }

    /// This format, with windows that are tested as if they were `aperture` pixels wider and higher than their samples.
    /// This is the aperture of the filter, a = b of MPG-WIN. At 0 a window of one sample is that pixel, and is drawn if
    /// it passes.
    ///
    /// # Errors
    ///
    /// The aperture is odd, or above 8.
    pub fn with_aperture(self, aperture: u32) -> Result<Format, ParameterError> {
        if aperture.is_multiple_of(2) && aperture <= Format::MAX_APERTURE {
            return Ok(Format { aperture, ..self });
        }
        Err(ParameterError(format!("an aperture of {aperture} pixels: it has to be even, and from 0 to 8")))
    }

    /// This format with numbers of other widths than [`Precision::FULL`], for a small machine.
    ///
    /// # Errors
    ///
    /// As [`Precision::checked`], or the screen is too large for the positions.
    pub fn with_precision(self, precision: Precision) -> Result<Format, ParameterError> {
        let (precision, Screen { width, height }) = (precision.checked()?, self.screen);
        let bits = precision.position;
        if width.max(height) <= 1 << bits {
            return Ok(Format { precision, ..self });
        }
        Err(ParameterError(format!("positions of {bits} bits: a screen of {width}x{height} pixels needs more")))
    }

    /// This format, with banks of single-port memories of an iCE40 UltraPlus, [`Banks::Spram`].
    ///
    /// # Errors
    ///
    /// A word has more bits than such a memory's. So this comes after [`Format::with_precision`].
    pub fn with_spram(self) -> Result<Format, ParameterError> {
        let (word, most) = (self.word(), Spram::WORD);
        if word <= most {
            return Ok(Format { banks: Banks::Spram, ..self });
        }
        Err(ParameterError(format!("words of {word} bits in single-port memories: they have to have {most} or fewer")))
    }

    /// What a bank of a video buffer is made of.
    pub fn banks(&self) -> Banks {
        self.banks
    }

    /// The widths of the numbers.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// The width of a pixel's word: its depth above its colour.
    pub fn word(&self) -> u32 {
        self.precision.depth + 3 * self.precision.colour
    }

    /// The screen.
    pub fn screen(&self) -> Screen {
        self.screen
    }

    /// The matrix of video processors.
    pub fn matrix(&self) -> Matrix {
        self.matrix
    }

    /// The greatest number of edges of a polygon.
    pub fn edges(&self) -> u32 {
        self.edges
    }

    /// The aperture in pixels.
    pub fn aperture(&self) -> u32 {
        self.aperture
    }

    /// The pixels of a video processor in a line of the screen.
    pub fn columns(&self) -> u32 {
        self.screen.width.div_ceil(self.matrix.columns)
    }

    /// The lines of the screen in which a video processor has pixels.
    pub fn rows(&self) -> u32 {
        self.screen.height.div_ceil(self.matrix.rows)
    }

    /// The address of a video processor's pixel in the banks of its video buffer.
    pub fn address(&self, x: u32, y: u32) -> u32 {
        Addresses::of(self.columns(), self.rows()).number(x, y)
    }

    /// n: a video processor's pixels lie within a window of 2^n x 2^n samples, which is divided n times, at least once.
    pub fn levels(&self) -> u32 {
        self.columns().max(self.rows()).next_power_of_two().trailing_zeros().max(1)
    }

    /// The width of an edge function in a window, signed.
    pub fn edge_bits(&self) -> u32 {
        self.precision.edge + self.excess()
    }

    /// The width of a distance in pixels, signed.
    pub fn distance_bits(&self) -> u32 {
        self.precision.position + BEYOND + self.excess()
    }

    /// The bits that a position in the square window of all samples needs beyond those of a position on the screen. It
    /// is more than 0 if a video processor has far more columns than lines, or the reverse.
    fn excess(&self) -> u32 {
        let spacing = self.matrix.columns.max(self.matrix.rows);
        (self.levels() + spacing.trailing_zeros()).saturating_sub(self.precision.position)
    }

    /// The widths of a polygon's bounds.
    fn bounds(&self) -> Bounds<Width> {
        let position = bits(self.precision.position);
        Bounds { left: position, top: position, right: position, bottom: position }
    }

    /// The widths of a place: the first and the last sample of a video processor along each axis.
    pub fn place(&self) -> Bounds<Width> {
        let distance = bits(self.distance_bits()).signed();
        Bounds { left: distance, top: distance, right: distance, bottom: distance }
    }

    /// The place of the video processor in that column and row of the matrix.
    pub fn place_of(&self, column: u32, row: u32) -> Bounds<i64> {
        let (half, last) = (i64::from(self.aperture / 2), (1 << self.levels()) - 1);
        let ends = |offset: u32, spacing: u32| (i64::from(offset) - half, i64::from(offset + last * spacing) + half);
        let (left, right) = ends(column, self.matrix.columns);
        let (top, bottom) = ends(row, self.matrix.rows);
        Bounds { left, top, right, bottom }
    }

    /// The width of the steps of edge functions between samples that are `spacing` pixels apart.
    fn step(&self, spacing: u32) -> Width {
        bits(self.precision.slope - 1 + spacing.trailing_zeros()).of(row(self.edges))
    }
}

/// The format as text, for the names of a generator's modules.
impl fmt::Debug for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Format {
            screen: Screen { width, height },
            matrix: Matrix { columns, rows },
            edges,
            aperture,
            precision,
            banks,
        } = self;
        let aperture = if *aperture > 0 { format!("_aperture{aperture}") } else { String::new() };
        let full = *precision == Precision::FULL;
        let precision = if full { String::new() } else { format!("_{precision:?}") };
        let banks = if *banks == Banks::TwoPorts { "" } else { "_spram" };
        write!(f, "{:?}", format!("{width}x{height}_{columns}x{rows}_edges{edges}{aperture}{precision}{banks}"))
    }
}

bundle! {
    /// Four bounds of a rectangle in pixels, or the distances past them.
    pub struct Bounds<T> {
        /// The left bound, a column of pixels, or the distance past it.
        pub left: T,
        /// The upper bound, a line of pixels, or the distance past it.
        pub top: T,
        /// The right bound, a column of pixels, or the distance past it.
        pub right: T,
        /// The lower bound, a line of pixels, or the distance past it.
        pub bottom: T,
    }
}

record! {
    /// A row of edge functions `a x + b y + c` of whole pixels, at least 0 inside (facts E0, the reduced form).
    pub struct EdgeFunction(format: Format) {
        /// Coefficient of x: the increase of the edge function per pixel to the right.
        a: bits(format.precision.slope).signed().of(row(format.edges)),
        /// Coefficient of y: the increase of the edge function per line downward.
        b: bits(format.precision.slope).signed().of(row(format.edges)),
        /// The value of the edge function at the upper left pixel.
        c: bits(format.precision.edge).signed().of(row(format.edges)),
    }

    /// A row of linear functions of whole pixels, added modulo a power of two: depth, red, green, blue.
    pub struct Plane(format: Format) {
        /// Coefficient of x: the increase of the plane per pixel to the right.
        x: bits(format.precision.plane).of(row(PLANES)),
        /// Coefficient of y: the increase of the plane per line downward.
        y: bits(format.precision.plane).of(row(PLANES)),
        /// The value of the plane at the upper left pixel, plus half a unit for rounding.
        origin: bits(format.precision.plane).of(row(PLANES)),
    }

    /// A convex polygon, as the geometry processor sends it to all video processors.
    pub struct Packet(format: Format) {
        /// The number of the polygon's edges, less one.
        last_edge: below(Format::MAX_EDGES),
        /// The edge functions of the polygon; those beyond the last edge are ignored.
        edges: EdgeFunction::widths(format),
        /// The attributes of the polygon.
        planes: Plane::widths(format),
        /// The pixels whose centres lie within the extent of the polygon's vertices along each axis.
        bounds: Bounds = format.bounds(),
    }

    /// The values that all windows of a polygon share, for the samples of one video processor.
    pub struct Polygon(format: Format) {
        /// The number of the polygon's edges, less one.
        last_edge: below(Format::MAX_EDGES),
        /// The step of each edge function per sample along x, as a decrease from its greatest value.
        step_x: format.step(format.matrix.columns),
        /// The step of each edge function per sample along y, as a decrease from its greatest value.
        step_y: format.step(format.matrix.rows),
        /// Whether each edge function is greatest at the right side of a window.
        right: bit().of(row(format.edges)),
        /// Whether each edge function is greatest at the lower side of a window.
        lower: bit().of(row(format.edges)),
        /// The increase of each plane per sample to the right.
        plane_x: bits(format.precision.plane).of(row(PLANES)),
        /// The increase of each plane per sample downward.
        plane_y: bits(format.precision.plane).of(row(PLANES)),
    }

    /// A square window of samples, with the values at its place.
    pub struct Window(format: Format) {
        /// The binary logarithm of the window's side in samples: n less the level.
        size: up_to(format.levels()),
        /// The column of the window's leftmost samples.
        x: bits(format.levels()),
        /// The row of the window's uppermost samples.
        y: bits(format.levels()),
        /// The greatest value of each edge function in the window; those beyond the polygon's last edge are ignored.
        edges: bits(format.edge_bits()).signed().of(row(format.edges)),
        /// How far the window extends inward past each bound of the polygon, in pixels; negative if it lies outside the bound.
        bounds: Bounds = format.place(),
        /// The value of each plane at the window's upper left sample.
        planes: bits(format.precision.plane).of(row(PLANES)),
    }

    /// A window, and the polygon that may cover it.
    pub struct Work(format: Format) {
        /// The polygon.
        polygon: Polygon::widths(format),
        /// The window.
        window: Window::widths(format),
    }
}

impl Bounds {
    /// The values for a quarter: each decreases by the quarter's extent, unless the quarter shares the side of the window
    /// from which it is measured.
    pub(super) fn quarter(&self, number: Signal, size: Signal, matrix: Matrix) -> Bounds {
        let reaches = |bound: Signal, is_there: Signal, spacing: u32| {
            bound - mux(is_there, 0, lit(bound.width(), spacing) << size).signed()
        };
        let (right, lower) = (number.bit(0), number.bit(1));
        Bounds {
            left: reaches(self.left, right, matrix.columns),
            top: reaches(self.top, lower, matrix.rows),
            right: reaches(self.right, !right, matrix.columns),
            bottom: reaches(self.bottom, !lower, matrix.rows),
        }
    }

    /// Whether something lies outside one of four bounds, given how far it extends past each.
    pub(super) fn is_beyond(&self) -> Signal {
        let Bounds { left, top, right, bottom } = *self;
        left.is_negative() | top.is_negative() | right.is_negative() | bottom.is_negative()
    }
}
