//! The parameters of a machine, and the roles of its nodes.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_rtl::pixelflow::programs::Edges;
use tilewright_scenes::{Field, Size};

use super::costs::{Costs, Ticks};
use super::latency::Nodes;
use super::screen::{Pattern, Screen};

/// The parameters of a machine.
///
/// ```
/// use tilewright_machines::pixelflow::Config;
/// use tilewright_scenes::Size;
///
/// let config = Config { nodes: 6, array: [32, 16], ..Config::new(Size::VGA) };
/// assert_eq!((config.roles()?.rasterizers, config.screen()?.count()), (1, 20 * 30));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// The picture in pixels.
    pub size: Size,
    /// The field of the picture to draw, for an interlaced display.
    pub field: Option<Field>,
    /// Nodes; one of them has the frame buffer.
    pub nodes: u32,
    /// Nodes that shade; the non-texturing system has none.
    pub shaders: u32,
    /// Pixels of an array along x and y: powers of two from 8 to 256.
    pub array: [u32; 2],
    /// Whether the software sorts primitives in a first pass, and makes their instructions in a second one while others are drawn (PFL-PRE).
    pub pre_sort: bool,
    /// The form in which edges are sent.
    pub edges: Edges,
    /// Whether the evaluator may work on the next primitive's edges while the memory stores the one before.
    pub side_by_side: bool,
    /// The set-up before each composition (PFL-SETUP).
    pub set_up: Ticks,
    /// The costs of front end and frame buffer.
    pub costs: Costs,
}

impl Config {
    /// The most nodes.
    pub const MOST_NODES: u32 = 64;
    /// The most regions that fit the memory in the non-texturing system, beside a new word and the network's registers.
    pub const MOST_REGIONS: usize = 44;
    /// The least pixels of an array along an axis.
    pub const SMALLEST: u32 = 8;

    /// The paper's machine: 20 nodes, 4 of them shaders, arrays of 128 x 64 pixels (PFL-NODE, PFL-CFG).
    pub fn new(size: Size) -> Config {
        Config {
            size,
            field: None,
            nodes: 20,
            shaders: 4,
            array: [128, 64],
            pre_sort: false,
            edges: Edges::Least,
            side_by_side: true,
            set_up: 0,
            costs: Costs::default(),
        }
    }

    /// The roles of the nodes, except the one with the frame buffer.
    ///
    /// # Errors
    /// Too few or too many nodes.
    pub fn roles(&self) -> Result<Nodes, ParameterError> {
        let (nodes, shaders, most) = (self.nodes, self.shaders, Config::MOST_NODES);
        if nodes > most {
            return Err(ParameterError(format!("{nodes} nodes: a machine has at most {most}")));
        }
        match nodes.checked_sub(shaders + 1).filter(|rasterizers| *rasterizers > 0) {
            Some(rasterizers) => Ok(Nodes { rasterizers, shaders }),
            None => Err(ParameterError(format!(
                "{nodes} nodes with {shaders} shaders: one has the frame buffer, and none is left to rasterize; give at least {}",
                shaders + 2
            ))),
        }
    }

    /// The hardware of each node's pixels.
    ///
    /// # Errors
    /// The array's sides are out of range.
    pub fn pixels(&self) -> Result<PixelArray, ParameterError> {
        let [width, height] = self.array;
        let sides = Config::SMALLEST..=256;
        if [width, height].iter().any(|side| !side.is_power_of_two() || !sides.contains(side)) {
            return Err(ParameterError(format!(
                "an array of {width}x{height} pixels: each side has to be a power of two from {} to {}",
                sides.start(),
                sides.end()
            )));
        }
        Ok(PixelArray { width, height }.checked()?)
    }

    /// The regions of the picture, or of its field.
    ///
    /// # Errors
    /// As [`Config::pixels`]; or the picture has no odd line.
    pub fn screen(&self) -> Result<Screen, ParameterError> {
        self.pixels()?;
        Screen::sampled(self.size, self.field.map_or(Pattern::ALL, Pattern::field), self.array)
    }
}
