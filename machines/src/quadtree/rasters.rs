//! The sparse rasters of a matrix of video processors: sizes of rasters and windows.
//!
//! Source: MPG-WIN, MPG-EQ2, MPG-SPR. Formulas and counts take rasters of any size; the hardware's
//! [`Matrix`](tilewright_rtl::quadtree::format::Matrix) has only the sizes that can be built.

use serde::Serialize;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::format::Matrix;
use tilewright_scenes::MAX_SIDE;

/// The most pixels along a side of all rasters together. Rasters are square, so a screen of the greatest height with a matrix of one row of
/// processors extends this far to the right.
const MOST: u32 = Matrix::MAX_SIDE * MAX_SIDE;

/// The rasters of `p` x `q` video processors. Processor (i, j) has the pixels (pX + i, qY + j), X and Y below 2^n (MPG-SPR).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct Rasters {
    /// Processors in a row, p.
    pub p: u32,
    /// Rows of processors, q.
    pub q: u32,
    /// Levels of division, n: a processor has 2^n x 2^n pixels.
    pub levels: u32,
    /// Width and height of the filter's aperture in pixels, a and b; a formula takes any, the count of windows even ones.
    pub aperture: (u32, u32),
}

impl Rasters {
    /// 2^k x 2^k processors for 2^m x 2^m pixels, with an aperture of 2x2. The paper has k = 0 to 4 and m = 10.
    ///
    /// ```
    /// use tilewright_machines::quadtree::Rasters;
    ///
    /// assert_eq!(Rasters::square(2, 10), Rasters { p: 4, q: 4, levels: 8, aperture: (2, 2) });
    /// ```
    pub fn square(k: u32, m: u32) -> Rasters {
        let side = 1_u32.checked_shl(k).unwrap_or(u32::MAX);
        Rasters { p: side, q: side, levels: m.saturating_sub(k), aperture: (2, 2) }
    }

    /// One processor for the same pixels, with which efficiencies compare. Unless the matrix is square with a power of two, the processor has
    /// the smallest square that contains the pixels.
    ///
    /// ```
    /// use tilewright_machines::quadtree::Rasters;
    ///
    /// assert_eq!(Rasters::square(4, 10).mono(), Rasters::square(0, 10));
    /// ```
    pub fn mono(&self) -> Rasters {
        let side = u64::from(self.p.max(self.q).max(1));
        let added = side.next_power_of_two().trailing_zeros();
        Rasters { p: 1, q: 1, levels: self.levels + added, aperture: self.aperture }
    }

    /// Processors, pq.
    pub fn processors(&self) -> u64 {
        u64::from(self.p) * u64::from(self.q)
    }

    /// Stages of all processors if each is a pipeline with a stage a level: n pq.
    pub fn stages(&self) -> u64 {
        u64::from(self.levels) * self.processors()
    }

    /// From a window of `level`, 0 to n, to its neighbour, in pixels along x and y (MPG-WIN).
    ///
    /// ```
    /// use tilewright_machines::quadtree::Rasters;
    ///
    /// let matrix = Rasters::square(2, 10);
    /// assert_eq!([7, 8].map(|level| matrix.spacing(level)), [(8, 8), (4, 4)]);
    /// assert_eq!([7, 8].map(|level| matrix.window(level)), [(6, 6), (2, 2)]);
    /// ```
    pub fn spacing(&self, level: u32) -> (u32, u32) {
        let samples = 1 << (self.levels - level);
        (self.p * samples, self.q * samples)
    }

    /// Width and height of a window of `level`, 0 to n, in pixels: from its first sample to its last, and the aperture (MPG-WIN).
    pub fn window(&self, level: u32) -> (u32, u32) {
        let (x, y) = self.spacing(level);
        (x - self.p + self.aperture.0, y - self.q + self.aperture.1)
    }

    /// Checks that windows can be counted: there are processors and levels, the pixels are at most 32768x32768, the aperture is even.
    ///
    /// # Errors
    /// The sentence names the violated rule.
    ///
    /// ```
    /// use tilewright_machines::quadtree::Rasters;
    ///
    /// assert!(Rasters::square(4, 10).check().is_ok());
    /// let problem = Rasters { aperture: (2, 3), ..Rasters::square(1, 10) }.check().unwrap_err();
    /// assert_eq!(problem.to_string(), "an aperture of 2x3 pixels: its sides have to be even, from 0 to 2048");
    /// ```
    pub fn check(&self) -> Result<(), ParameterError> {
        let Rasters { p, q, levels, aperture: (a, b) } = *self;
        let side = |processors: u32| u64::from(processors) << levels.min(32);
        let is_side = |aperture: u32| aperture.is_multiple_of(2) && aperture <= MAX_SIDE;
        let problem = if p == 0 || q == 0 {
            format!("a matrix of {p}x{q} video processors: it has to have at least 1x1")
        } else if levels == 0 {
            "a matrix whose windows are divided 0 times: it has to have at least 1 level".to_owned()
        } else if side(p).max(side(q)) > MOST.into() {
            format!(
                "a matrix of {p}x{q} video processors of {levels} levels, which is {}x{} pixels: they may be up to \
                 {MOST}x{MOST}",
                side(p),
                side(q)
            )
        } else if !is_side(a) || !is_side(b) {
            format!("an aperture of {a}x{b} pixels: its sides have to be even, from 0 to {MAX_SIDE}")
        } else {
            return Ok(());
        };
        Err(ParameterError(problem))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_impossible_matrix_has_its_sentence() {
        let sentence = |matrix: Rasters| matrix.check().expect_err("impossible").to_string();
        let possible = Rasters::square(1, 10);
        assert_eq!(
            sentence(Rasters { q: 0, ..possible }),
            "a matrix of 2x0 video processors: it has to have at least 1x1"
        );
        assert_eq!(
            sentence(Rasters { levels: 0, ..possible }),
            "a matrix whose windows are divided 0 times: it has to have at least 1 level"
        );
        assert_eq!(
            sentence(Rasters { p: 3, levels: 14, ..possible }),
            "a matrix of 3x2 video processors of 14 levels, which is 49152x32768 pixels: they may be up to 32768x32768"
        );
        assert_eq!(
            sentence(Rasters { aperture: (1, 2), ..possible }),
            "an aperture of 1x2 pixels: its sides have to be even, from 0 to 2048"
        );
        assert!(sentence(Rasters { levels: u32::MAX, ..possible }).ends_with("they may be up to 32768x32768"));
        assert!(Rasters { p: 5, q: 8, levels: 8, aperture: (0, 4) }.check().is_ok());
        // 2048x2048 pixels in 16 columns: rasters of 128x2048 samples, which are within 2048x2048.
        assert!(Rasters { p: 16, q: 1, levels: 11, aperture: (0, 0) }.check().is_ok());
    }

    /// A processor for the same pixels has as many levels as the whole matrix.
    #[test]
    fn one_processor_has_the_pixels_of_the_matrix() {
        for k in 0..5 {
            assert_eq!(Rasters::square(k, 10).mono(), Rasters::square(0, 10));
        }
        let wide = Rasters { p: 5, q: 3, levels: 6, aperture: (2, 4) };
        assert_eq!(wide.mono(), Rasters { p: 1, q: 1, levels: 9, aperture: (2, 4) });
        // Too many levels must not panic.
        assert_eq!(Rasters::square(40, 10).mono().levels, 32);
    }
}
