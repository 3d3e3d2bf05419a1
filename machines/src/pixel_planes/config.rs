//! The parameters of a machine.

use serde::Serialize;
use tilewright_rtl::parameter::{ParameterError, Screen};
use tilewright_rtl::pixel_planes::SIDE;
use tilewright_rtl::pixel_planes::frame_buffer::FrameBuffer;
use tilewright_rtl::pixel_planes::machine::PixelPlanes5;
use tilewright_rtl::pixel_planes::programs::Edges;
use tilewright_rtl::pixel_planes::renderer::Renderer;
use tilewright_rtl::pixel_planes::ring::Ring;
use tilewright_scenes::Size;

use super::geometry::GeometryCosts;
use super::regions::Regions;

/// The parameters of a machine.
///
/// ```
/// use tilewright_machines::pixel_planes::Config;
/// use tilewright_scenes::Size;
///
/// let config = Config { renderers: 4, side: 64, ..Config::new(Size::VGA) };
/// assert_eq!(config.regions()?.count(), 10 * 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Config {
    /// The screen in pixels.
    pub size: Size,
    /// Renderers, B: 1 to [`Config::MOST_RENDERERS`].
    pub renderers: u32,
    /// Pixels along a side of a region, S: a power of two from 8 to 256.
    pub side: u32,
    /// Size of each renderer's queue, in instructions.
    pub queue: u32,
    /// Bandwidth of the ring in Mbit/s: a multiple of 40, which is one bit in each clock.
    pub ring: u32,
    /// Depth alone is compared, and the first drawn of equal depths stays, as in
    /// [`golden::render_strict`](tilewright_scenes::golden::render_strict).
    pub strict: bool,
    /// The tree may work on the next primitive's edges while the memory stores the one before.
    pub side_by_side: bool,
    /// The form in which edges are sent.
    pub edges: Edges,
    /// Renderers evaluate quadratics, as spheres need.
    pub quadratic: bool,
    /// Geometry processors: 1 to [`Config::MOST_GEOMETRY`].
    pub geometry: u32,
    /// The costs of their program.
    pub costs: GeometryCosts,
}

impl Config {
    /// The most renderers.
    pub const MOST_RENDERERS: u32 = 32;
    /// The most geometry processors.
    pub const MOST_GEOMETRY: u32 = 256;
    /// The ring of the machine that was built, in Mbit/s: 5 Gbit/s, or 125 bits in each clock of 25 ns.
    pub const RING: u32 = 5000;
    /// A ring, in Mbit/s, that is enough for any machine: an instruction for each renderer and a plane in each clock.
    pub const AMPLE_RING: u32 = 320_000;
    /// The smallest region's side in pixels.
    pub const SMALLEST_SIDE: u32 = 8;

    /// 16 renderers with regions of 128 x 128 pixels (PP5-ARCH, PP5-UTV), for a screen of that size. The paper's text does not mention the
    /// number of geometry processors; two for each renderer are a choice.
    pub fn new(size: Size) -> Config {
        let (renderers, costs) = (16, GeometryCosts::default());
        Config {
            size,
            renderers,
            side: SIDE,
            queue: 64,
            ring: Config::RING,
            strict: false,
            side_by_side: true,
            edges: Edges::Least,
            quadratic: false,
            geometry: 2 * renderers,
            costs,
        }
    }

    /// The screen's regions.
    ///
    /// # Errors
    /// The side is out of range.
    pub fn regions(&self) -> Result<Regions, ParameterError> {
        if self.side < Config::SMALLEST_SIDE {
            let (side, least) = (self.side, Config::SMALLEST_SIDE);
            return Err(ParameterError(format!(
                "regions of {side}x{side} pixels: the side has to be from {least} to 256 pixels"
            )));
        }
        Regions::new(self.size, self.frame_buffer()?.side)
    }

    /// The hardware of each renderer.
    ///
    /// # Errors
    /// The side of regions, the queue or the number of renderers is out of range.
    pub fn renderer(&self) -> Result<Renderer, ParameterError> {
        if !(1..=Config::MOST_RENDERERS).contains(&self.renderers) {
            let (asked, most) = (self.renderers, Config::MOST_RENDERERS);
            return Err(ParameterError(format!("{asked} renderers: a machine has from 1 to {most}")));
        }
        self.regions()?;
        Ok(Renderer { side: self.side, queue: self.queue, quadratic: self.quadratic }.checked()?)
    }

    /// Checks the number of geometry processors.
    ///
    /// # Errors
    /// It is out of range.
    pub(crate) fn check_geometry(&self) -> Result<(), ParameterError> {
        match (1..=Config::MOST_GEOMETRY).contains(&self.geometry) {
            true => Ok(()),
            false => {
                let (asked, most) = (self.geometry, Config::MOST_GEOMETRY);
                Err(ParameterError(format!("{asked} geometry processors: a machine has from 1 to {most}")))
            }
        }
    }

    /// The hardware between geometry processors, renderers and frame buffer.
    ///
    /// # Errors
    /// The ring's bandwidth is not a whole number of bits in a clock, or too high; or as [`Config::renderer`].
    pub fn ring(&self) -> Result<Ring, ParameterError> {
        let (renderers, side) = (self.renderers, self.renderer()?.side);
        Ok(Ring { renderers, side, rate: Ring::bits_a_clock(self.ring)? }.checked()?)
    }

    /// The hardware that assembles regions to a frame.
    ///
    /// # Errors
    /// As [`Config::regions`].
    pub fn frame_buffer(&self) -> Result<FrameBuffer, ParameterError> {
        let screen = Screen::new(self.size.width(), self.size.height())?;
        Ok(FrameBuffer { screen, side: self.side }.checked()?)
    }

    /// The whole machine as one circuit.
    ///
    /// # Errors
    /// As [`Config::ring`] and [`Config::frame_buffer`].
    pub fn hardware(&self) -> Result<PixelPlanes5, ParameterError> {
        let screen = Screen::new(self.size.width(), self.size.height())?;
        let rate = Ring::bits_a_clock(self.ring)?;
        let Config { renderers, side, queue, quadratic, .. } = *self;
        Ok(PixelPlanes5 { screen, renderers, side, queue, rate, quadratic }.checked()?)
    }

    /// The configuration for a report.
    pub(crate) fn built(&self) -> Built {
        let Config { size, renderers, side, queue, ring, strict, side_by_side, edges, quadratic, geometry, costs } =
            *self;
        let (width, height, edges) = (size.width(), size.height(), edges.name());
        Built { width, height, renderers, side, queue, ring, strict, side_by_side, edges, quadratic, geometry, costs }
    }
}

/// A configuration in a report.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Built {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Renderers.
    pub renderers: u32,
    /// Pixels along a side of a region.
    pub side: u32,
    /// Size of each renderer's queue, in instructions.
    pub queue: u32,
    /// Bandwidth of the ring in Mbit/s.
    pub ring: u32,
    /// Whether the first drawn of equal depths stays.
    pub strict: bool,
    /// Whether tree and memory may work on two instructions.
    pub side_by_side: bool,
    /// The form in which edges are sent: `fixed`, `own` or `least`.
    pub edges: &'static str,
    /// Whether renderers evaluate quadratics.
    pub quadratic: bool,
    /// Geometry processors.
    pub geometry: u32,
    /// Clocks of their program's steps.
    pub costs: GeometryCosts,
}
