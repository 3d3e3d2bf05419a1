//! A frame coming into being, as the page reads it.

use crate::columns::{differences, packed_columns};
use serde::{Serialize, Serializer};

/// What a machine did in the time of a frame. All times are clocks from the beginning of the run.
///
/// ```
/// use tilewright_view::{Clock, Picture, Unit, Write};
///
/// let picture = Picture {
///     machine: "vc1".to_owned(),
///     title: "star".to_owned(),
///     size: [2, 1],
///     background: [0; 3],
///     clock: Clock { name: "40 MHz".to_owned(), picoseconds: 25_000 },
///     end: 9,
///     units: vec![Unit { name: "PE 0".to_owned(), colour: [200, 40, 40] }],
///     grids: Vec::new(),
///     kinds: Vec::new(),
///     lanes: Vec::new(),
///     identical: true,
///     verdict: "identical to the golden image".to_owned(),
///     writes: vec![Write { clock: 7, pixel: 1, unit: 0, depth: 3, colour: [1, 2, 3] }],
/// };
/// assert!(String::from_utf8(picture.json()).unwrap().contains("\"machine\":\"vc1\""));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Picture {
    /// The machine's name.
    pub machine: String,
    /// The scene's name.
    pub title: String,
    /// Columns and rows of pixels.
    pub size: [u32; 2],
    /// Red, green and blue of pixels that nothing covers.
    pub background: [u8; 3],
    /// The clock in which times are counted.
    pub clock: Clock,
    /// The end of the frame in clocks.
    pub end: u64,
    /// The units that draw, by number.
    pub units: Vec<Unit>,
    /// The grids that can be laid over the picture.
    pub grids: Vec<Grid>,
    /// The activities of units.
    pub kinds: Vec<Kind>,
    /// What each unit did, in the sequence of a chart.
    pub lanes: Vec<Lane>,
    /// Whether the frame is the golden image.
    pub identical: bool,
    /// A sentence on that.
    pub verdict: String,
    /// Each change of a pixel, by time.
    #[serde(serialize_with = "packed")]
    pub writes: Vec<Write>,
}

/// A clock of a machine.
///
/// ```
/// let clock = tilewright_view::Clock { name: "40 MHz".to_owned(), picoseconds: 25_000 };
/// assert_eq!(1_000_000 / clock.picoseconds, 40);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Clock {
    /// What it clocks.
    pub name: String,
    /// Its period.
    pub picoseconds: u64,
}

/// A unit that draws.
///
/// ```
/// let unit = tilewright_view::Unit { name: "PE 3".to_owned(), colour: [20, 97, 168] };
/// assert_eq!(unit.colour[2], 168);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unit {
    /// Its name, such as `PE 3`.
    pub name: String,
    /// Red, green and blue of its pixels where the owners are shown.
    pub colour: [u8; 3],
}

/// Parts of the screen that the machine treats as a whole.
///
/// ```
/// let grid = tilewright_view::Grid { name: "regions".to_owned(), size: [128, 128] };
/// assert_eq!(640 / grid.size[0], 5);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Grid {
    /// What they are, such as `regions`.
    pub name: String,
    /// The width and height of each in pixels.
    pub size: [u32; 2],
}

/// An activity of units.
///
/// ```
/// let kind = tilewright_view::Kind { name: "stalled".to_owned(), waits: true };
/// assert!(kind.waits);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Kind {
    /// Its name, such as `clearing`.
    pub name: String,
    /// Whether the unit waits for another one.
    pub waits: bool,
}

/// What a unit, or several similar ones, did over time.
///
/// ```
/// use tilewright_view::{Lane, Part};
///
/// let lane = Lane { name: "PE 0".to_owned(), parts: vec![Part(0, 7, vec![(0, 1.0)])] };
/// assert_eq!(lane.parts[0].1 - lane.parts[0].0, 7);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Lane {
    /// Its name, such as `PE 3`.
    pub name: String,
    /// Parts of the time that do not overlap, sorted.
    pub parts: Vec<Part>,
}

/// A part of the time: its first clock, the clock after its last one, and the share of each activity, by the number of its kind.
///
/// ```
/// let half = tilewright_view::Part(0, 8, vec![(2, 0.5)]);
/// assert_eq!(half.2[0].1, 0.5);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Part(pub u64, pub u64, pub Vec<(usize, f64)>);

/// A change of a pixel by a unit.
///
/// ```
/// let write = tilewright_view::Write { clock: 7, pixel: 1, unit: 0, depth: 3, colour: [1, 2, 3] };
/// assert_eq!(write.colour, [1, 2, 3]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Write {
    /// The clock.
    pub clock: u32,
    /// The number of the pixel in raster order.
    pub pixel: u32,
    /// The number of the unit.
    pub unit: u32,
    /// The new depth.
    pub depth: u32,
    /// Red, green and blue.
    pub colour: [u8; 3],
}

impl Picture {
    /// The data of the page, as JSON.
    ///
    /// ```
    /// use tilewright_view::for_examples::picture;
    ///
    /// let json = String::from_utf8(picture().json()).unwrap();
    /// assert!(json.starts_with('{') && json.contains("\"machine\":\"vc1\""));
    /// ```
    pub fn json(&self) -> Vec<u8> {
        serde_json::to_vec(self).expect("it has names for keys and finite numbers")
    }
}

/// Five columns: clocks and pixels as differences, which are small, then units, depths and colours.
fn packed<S: Serializer>(writes: &[Write], to: S) -> Result<S::Ok, S::Error> {
    let column = |of: fn(&Write) -> u32| writes.iter().map(of).collect::<Vec<u32>>();
    let columns = [
        differences(&column(|it| it.clock)),
        differences(&column(|it| it.pixel)),
        column(|it| it.unit),
        column(|it| it.depth),
        column(|it| u32::from_be_bytes([0, it.colour[0], it.colour[1], it.colour[2]])),
    ];
    to.serialize_str(&packed_columns(&columns))
}
