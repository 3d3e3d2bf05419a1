//! The division of the screen into patches, and the position of a pixel in them (VC1-PT).
//!
//! ```text
//! x  [ column        | low bits ]      patch  = row * columns + column
//! y  [ row           | low bits ]      offset = { low bits of y, low bits of x }
//! ```

use tilewright_hdl::{Signal, Width, below, bundle, cat, lit, up_to};

use crate::parameter::{ParameterError, Screen};
use crate::scan::Position;

bundle! {
    /// The position of a pixel: its patch, and its place in the patch.
    pub struct Place<T> {
        /// The number of the patch, row by row from the upper left.
        pub patch: T,
        /// The number of the pixel in the patch, row by row.
        pub offset: T,
    }
}

/// A screen divided into square patches. A page of image memory stores one patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Patches {
    screen: Screen,
    edge: u32,
}

/// Whether patches may have this edge.
pub(crate) fn check_edge(edge: u32) -> Result<(), ParameterError> {
    if [4, 8, 16].contains(&edge) {
        return Ok(());
    }
    Err(ParameterError(format!("patches of {edge} x {edge} pixels: the edge has to be 4, 8 or 16")))
}

impl Patches {
    /// Patches with an edge of 4 (the best), 8 or 16 pixels.
    ///
    /// # Errors
    ///
    /// The edge has another length, or the screen is smaller than 2 x 2 patches.
    pub fn new(screen: Screen, edge: u32) -> Result<Patches, ParameterError> {
        check_edge(edge)?;
        if screen.width <= edge || screen.height <= edge {
            let Screen { width, height } = screen;
            return Err(ParameterError(format!(
                "a screen of {width} x {height} pixels has fewer than 2 x 2 patches of {edge} x {edge}: \
                 take a larger screen or smaller patches"
            )));
        }
        Ok(Patches { screen, edge })
    }

    /// The screen.
    pub fn screen(&self) -> Screen {
        self.screen
    }

    /// The edge of a patch in pixels.
    pub fn edge(&self) -> u32 {
        self.edge
    }

    /// The number of patches side by side; the last one may extend beyond the screen's right edge.
    pub fn columns(&self) -> u32 {
        self.screen.width.div_ceil(self.edge)
    }

    /// The number of patches on the screen.
    pub fn count(&self) -> u32 {
        self.columns() * self.screen.height.div_ceil(self.edge)
    }

    /// The number of pixels in a patch, and of words in a page.
    pub fn pixels(&self) -> u32 {
        self.edge * self.edge
    }

    /// The width of a patch number.
    pub fn patch_width(&self) -> Width {
        below(self.count())
    }

    /// The width of a pixel's place in its patch.
    pub fn offset_width(&self) -> Width {
        below(self.pixels())
    }

    /// The position of the pixel, in signals.
    pub fn locate(&self, pixel: Position) -> Place {
        let shift = self.edge.ilog2();
        let high = |signal: Signal| signal.slice(shift..signal.width());
        let columns = lit(up_to(self.columns()), self.columns());
        let product = || high(pixel.y).times(columns).trunc(self.patch_width());
        let first_of_row = sum(high(pixel.y), self.columns(), self.patch_width()).unwrap_or_else(product);
        let column = high(pixel.x).zext(self.patch_width());
        Place { patch: first_of_row + column, offset: cat![pixel.y.trunc(shift), pixel.x.trunc(shift)] }
    }

    /// The position of the pixel, in numbers.
    pub fn place(&self, x: u32, y: u32) -> Place<u64> {
        let patch = y / self.edge * self.columns() + x / self.edge;
        let offset = y % self.edge * self.edge + x % self.edge;
        Place { patch: patch.into(), offset: offset.into() }
    }
}

/// The product with a number of two bits, as the sum of two shifted values: a multiplier of an FPGA takes longer than an adder.
/// 640 pixels have 160 = 128 + 32 columns.
fn sum(value: Signal, factor: u32, width: Width) -> Option<Signal> {
    let low = factor.trailing_zeros();
    let high = (factor & !(1 << low)).trailing_zeros();
    let value = (factor.count_ones() == 2).then(|| value.zext(width))?;
    Some((value << high) + (value << low))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_hdl::{Module, block};
    use tilewright_sim::Simulation;

    block! {
        /// Locates a pixel.
        struct Locator { width: u32 }
        in(self) LocatorIn { x: below(self.width), y: below(HEIGHT) }
        out(self) LocatorOut { patch: self.patches().patch_width(), offset: self.patches().offset_width() }
    }

    const HEIGHT: u32 = 20;

    impl Locator {
        fn patches(&self) -> Patches {
            Patches::new(Screen { width: self.width, height: HEIGHT }, 4).unwrap()
        }

        fn build(&self, _: Module, i: LocatorIn) -> LocatorOut {
            let Place { patch, offset } = self.patches().locate(Position { x: i.x, y: i.y });
            LocatorOut { patch, offset }
        }
    }

    /// The columns of patches are 16, 5, 12 and 7, which have one, two, two and three bits.
    #[test]
    fn the_circuit_locates_every_pixel() {
        for width in [64, 18, 48, 28] {
            let locator = Locator { width };
            let mut sim = Simulation::of(&locator).unwrap();
            for (x, y) in (0..HEIGHT).flat_map(|y| (0..width).map(move |x| (x, y))) {
                sim.drive(LocatorIn { x: x.into(), y: y.into() });
                let LocatorOut { patch, offset } = sim.read_u64();
                assert_eq!(Place { patch, offset }, locator.patches().place(x, y), "{x}, {y} of {width}");
            }
        }
    }

    #[test]
    fn the_vc1_has_the_patch_counts_of_the_paper() {
        let count = |edge| Patches::new(Screen::VC1, edge).unwrap().count();
        assert_eq!([4, 8, 16].map(count), [19200, 4800, 1200]);
    }

    #[test]
    fn a_patch_that_cannot_be_is_refused_in_a_sentence() {
        let problem = |width, edge| Patches::new(Screen { width, height: 480 }, edge).unwrap_err().to_string();
        assert_eq!(problem(640, 5), "patches of 5 x 5 pixels: the edge has to be 4, 8 or 16");
        assert_eq!(
            problem(16, 16),
            "a screen of 16 x 480 pixels has fewer than 2 x 2 patches of 16 x 16: \
             take a larger screen or smaller patches"
        );
    }
}
