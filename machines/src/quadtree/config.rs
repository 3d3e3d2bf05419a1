//! The sizes of a generator, and how its video processors are put together.

use serde::{Serialize, Serializer};
use tilewright_rtl::parameter::{ParameterError, Screen};
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_rtl::quadtree::format::{self, Format};
use tilewright_rtl::quadtree::generator::QuadtreeGenerator;
use tilewright_rtl::quadtree::processor::Queues;
use tilewright_rtl::quadtree::raster::Form;
use tilewright_scenes::{Polygon, Size};

use super::rasters::Rasters;

/// What a generator is built for.
///
/// ```
/// use tilewright_machines::quadtree::{Config, Test};
/// use tilewright_scenes::Size;
///
/// let config = Config { matrix: (16, 16), form: "stack:2+pipe".to_owned(), test: Test::Serial, ..Config::new(Size::VGA) };
/// assert_eq!(config.windows()?.levels, 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// The screen in pixels.
    pub size: Size,
    /// Video processors side by side and one below the other, p and q: each 1, 2, 4, 8 or 16 (MPG-SPR).
    pub matrix: (u32, u32),
    /// The most edges of a polygon, 3 to 8.
    pub edges: u32,
    /// What each raster processor is put together from, as [`Form::parse`] reads it, such as `stack:2+pipe` (MPG-RP).
    pub form: String,
    /// How the edges of a window are tested (MPG-EQ5).
    pub test: Test,
    /// What the queues hold (MPG-LIM).
    pub queues: Queues,
    /// Depth alone decides, and of equal depths the first drawn stays, as in
    /// [`golden::render_strict`](tilewright_scenes::golden::render_strict).
    pub strict: bool,
    /// Pixels by which windows are tested wider and higher than their samples, even, 0 to 8 (MPG-WIN).
    pub aperture: u32,
}

impl Config {
    /// A matrix of 4 x 4 video processors with a pipe each, for triangles on a screen of that size.
    pub fn new(size: Size) -> Config {
        Config {
            size,
            matrix: (4, 4),
            edges: 3,
            form: "pipe".to_owned(),
            test: Test::Parallel,
            queues: Queues { broadcast: 2, packets: 4, windows: 2 },
            strict: false,
            aperture: 0,
        }
    }

    /// The same for polygons of as many edges as the one of these has that has most.
    pub fn for_packets(size: Size, packets: &[Polygon]) -> Config {
        let edges = packets.iter().map(|packet| packet.edges.len() as u32).max().unwrap_or(0);
        Config { edges: edges.max(3), ..Config::new(size) }
    }

    /// The sizes of the hardware.
    ///
    /// # Errors
    /// There is no such matrix or aperture, or no hardware for as many edges.
    pub fn format(&self) -> Result<Format, ParameterError> {
        let screen = Screen::new(self.size.width(), self.size.height())?;
        let matrix = format::Matrix::new(self.matrix.0, self.matrix.1)?;
        Format::new(screen, matrix, self.edges)?.with_aperture(self.aperture)
    }

    /// What each raster processor is put together from.
    ///
    /// # Errors
    /// As [`Config::format`] and [`Form::parse`].
    pub fn parsed_form(&self) -> Result<Form, ParameterError> {
        Form::parse(&self.form, &self.format()?)
    }

    /// The hardware.
    ///
    /// # Errors
    /// As [`Config::parsed_form`], or a queue holds nothing or too much.
    pub fn generator(&self) -> Result<QuadtreeGenerator, ParameterError> {
        QuadtreeGenerator::new(self.format()?, self.parsed_form()?, self.test, self.queues)
    }

    /// The rasters, as what counts windows and the formulas know them.
    ///
    /// # Errors
    /// As [`Config::format`].
    pub fn windows(&self) -> Result<Rasters, ParameterError> {
        let (p, q) = self.matrix;
        Ok(Rasters { p, q, levels: self.format()?.levels(), aperture: (self.aperture, self.aperture) })
    }

    /// As a report shows it.
    pub(crate) fn built(&self) -> Result<Built, ParameterError> {
        let Config { size, matrix: (p, q), edges, test, queues, strict, aperture, .. } = *self;
        Ok(Built {
            width: size.width(),
            height: size.height(),
            p,
            q,
            levels: self.format()?.levels(),
            form: self.parsed_form()?.to_string(),
            test,
            edges,
            aperture,
            strict,
            broadcast_queue: queues.broadcast,
            packet_queue: queues.packets,
            window_queue: queues.windows,
        })
    }
}

/// A configuration as a report shows it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Built {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Video processors side by side.
    pub p: u32,
    /// Video processors one below the other.
    pub q: u32,
    /// Levels of division, n.
    pub levels: u32,
    /// What each raster processor is put together from.
    pub form: String,
    /// How edges are tested.
    #[serde(serialize_with = "as_text")]
    pub test: Test,
    /// The most edges of a polygon.
    pub edges: u32,
    /// Pixels by which windows are tested wider.
    pub aperture: u32,
    /// Whether of equal depths the first drawn stays.
    pub strict: bool,
    /// Packets that the broadcast's queue holds.
    pub broadcast_queue: u32,
    /// Packets that the queue before each video processor holds.
    pub packet_queue: u32,
    /// Windows that the queue before each unit of a pipe or tree holds.
    pub window_queue: u32,
}

/// As its text.
fn as_text<S: Serializer>(test: &Test, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(test)
}
