//! The parameters of a generator, and the structure of its video processors.

use serde::{Serialize, Serializer};
use tilewright_rtl::parameter::{ParameterError, Screen};
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_rtl::quadtree::format::{self, Format};
use tilewright_rtl::quadtree::generator::QuadtreeGenerator;
use tilewright_rtl::quadtree::processor::{Queues, VideoProcessor};
use tilewright_rtl::quadtree::raster::Form;
use tilewright_scenes::{Polygon, Size};

use super::rasters::Rasters;

/// The parameters of a generator.
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
    /// Columns and rows of video processors, p and q: each 1, 2, 4, 8 or 16 (MPG-SPR).
    pub matrix: (u32, u32),
    /// The most edges of a polygon, 3 to 8.
    pub edges: u32,
    /// The parts of each raster processor, in the notation of [`Form::parse`], such as `stack:2+pipe` (MPG-RP).
    pub form: String,
    /// How the edges of a window are tested (MPG-EQ5).
    pub test: Test,
    /// The sizes of the queues (MPG-LIM).
    pub queues: Queues,
    /// Depth alone is compared, and the first drawn of equal depths stays, as in
    /// [`golden::render_strict`](tilewright_scenes::golden::render_strict).
    pub strict: bool,
    /// Pixels by which tested windows are wider and higher than their samples; even, 0 to 8 (MPG-WIN).
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

    /// The same for the most edges of these polygons.
    pub fn for_packets(size: Size, packets: &[Polygon]) -> Config {
        let edges = packets.iter().map(|packet| packet.edges.len() as u32).max().unwrap_or(0);
        Config { edges: edges.max(3), ..Config::new(size) }
    }

    /// The sizes of the hardware.
    ///
    /// # Errors
    /// The matrix, the aperture or the number of edges is out of range.
    pub fn format(&self) -> Result<Format, ParameterError> {
        let screen = Screen::new(self.size.width(), self.size.height())?;
        let matrix = format::Matrix::new(self.matrix.0, self.matrix.1)?;
        Format::new(screen, matrix, self.edges)?.with_aperture(self.aperture)
    }

    /// The parts of each raster processor.
    ///
    /// # Errors
    /// As [`Config::format`] and [`Form::parse`].
    pub fn parsed_form(&self) -> Result<Form, ParameterError> {
        Form::parse(&self.form, &self.format()?)
    }

    /// The hardware.
    ///
    /// # Errors
    /// As [`Config::parsed_form`], or the size of a queue is out of range.
    pub fn generator(&self) -> Result<QuadtreeGenerator, ParameterError> {
        let Config { test, queues, .. } = *self;
        let processor = VideoProcessor { format: self.format()?, form: self.parsed_form()?, test, queues };
        Ok(QuadtreeGenerator { video_processor: processor.checked()? })
    }

    /// The rasters for counts of windows and for formulas.
    ///
    /// # Errors
    /// As [`Config::format`].
    pub fn windows(&self) -> Result<Rasters, ParameterError> {
        let (p, q) = self.matrix;
        Ok(Rasters { p, q, levels: self.format()?.levels(), aperture: (self.aperture, self.aperture) })
    }

    /// The configuration for a report.
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

/// A configuration in a report.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Built {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Columns of video processors.
    pub p: u32,
    /// Rows of video processors.
    pub q: u32,
    /// Levels of division, n.
    pub levels: u32,
    /// The parts of each raster processor.
    pub form: String,
    /// The way in which edges are tested.
    #[serde(serialize_with = "as_text")]
    pub test: Test,
    /// The most edges of a polygon.
    pub edges: u32,
    /// Pixels by which tested windows are wider.
    pub aperture: u32,
    /// Whether the first drawn of equal depths stays.
    pub strict: bool,
    /// Size of the broadcast's queue, in packets.
    pub broadcast_queue: u32,
    /// Size of the queue before each video processor, in packets.
    pub packet_queue: u32,
    /// Size of the queue before each unit of a pipe or tree, in windows.
    pub window_queue: u32,
}

/// The form as a text.
fn as_text<S: Serializer>(test: &Test, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(test)
}
