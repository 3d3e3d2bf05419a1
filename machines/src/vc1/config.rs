//! The parameters of a VC-1, with the paper's as defaults.

use serde::Serialize;
use tilewright_rtl::bus::BroadcastBus;
use tilewright_rtl::clocks::MERGE;
use tilewright_rtl::gfb::{Blanking, Display, Passes};
use tilewright_rtl::lfb::{LfbUnit, Patches};
use tilewright_rtl::parameter::{ParameterError, Screen};
use tilewright_rtl::vc1::{OVERHEAD, Vc1};
use tilewright_scenes::Size;

use super::assignment::Assign;
use super::cost::CostTable;
use super::cursor::Cursor;
use super::words::POLYGON_WORDS;

/// Pixels of an image memory: 4096 pages of 4x4, 1/4.7 of the screen (VC1-LFB).
const IMAGE_MEMORY_PIXELS: u32 = 65_536;

/// The least picoseconds of a line of the display that contain swaps and their crossings: 4 clocks of the merger.
const SHORTEST_LINE: u64 = 4 * MERGE.period.picoseconds();

/// The parameters of a VC-1 and of its programs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// The screen in pixels; 640x480 in the paper (VC1-TM).
    pub size: Size,
    /// Processing elements, 1 to [`Config::MAX_PROCESSORS`]; 16 in the paper (VC1-PE).
    pub processors: u32,
    /// The side of a patch in pixels: 4, 8 or 16; usually 4 (VC1-PT).
    pub patch: u32,
    /// Pages of image memory in each buffer; `None` means the paper's 65536 pixels (VC1-LFB), or the whole screen if that is less.
    pub pages: Option<u32>,
    /// Polygons of a cluster, at least 1 (VC1-CLU).
    pub cluster: u32,
    /// The way in which polygons are assigned.
    pub assign: Assign,
    /// The area in pixels above which a packet is sent to all processing elements, and all draw it (VC1-APR); `None` if no packet is.
    pub apr: Option<u32>,
    /// The costs of the processing elements' program.
    pub costs: CostTable,
    /// Size of each receive queue in words of 32 bits, at least 2. The paper does not say; 64 is our choice.
    pub queue: u32,
    /// Time of a word on the bus in clocks of the processing elements, 1 to 255; 6 in the paper (VC1-NET).
    pub word_clocks: u32,
    /// Clocks of the merger after each scan line, 1 to [`Config::MAX_OVERHEAD`]; 20 in the paper (VC1-TM).
    pub overhead: u32,
    /// Refreshes of the display in a second; 60 in the paper, which may be 59.94 (VC1-59).
    pub refresh: f64,
    /// When in the display's vertical blanking the banks of the global frame buffer change.
    pub blanking: Blanking,
    /// Whether the host sends the whole scene over the bus before each command (VC1-IMM).
    pub immediate: bool,
    /// The number of passes whose average is a picture; each frame is a pass (VC1-ACB).
    pub accumulate: Option<Passes>,
    /// The cursor that the host writes into each displayed frame (VC1-HOSTP). It is not possible with `accumulate`, as an average does not show it.
    pub cursor: Option<Cursor>,
}

impl Config {
    /// The most processing elements.
    pub const MAX_PROCESSORS: u32 = 256;

    /// The most clocks of overhead.
    pub const MAX_OVERHEAD: u32 = 1000;

    /// The VC-1 of the paper for a screen of that size.
    pub fn new(size: Size) -> Config {
        Config {
            size,
            processors: 16,
            patch: 4,
            pages: None,
            cluster: 32,
            assign: Assign::Once,
            apr: Some(500),
            costs: CostTable::default(),
            queue: BroadcastBus::QUEUE,
            word_clocks: BroadcastBus::WORD_CLOCKS,
            overhead: OVERHEAD,
            refresh: 60.0,
            blanking: Blanking::AtStart,
            immediate: false,
            accumulate: None,
            cursor: None,
        }
    }

    /// The patches of the screen.
    ///
    /// # Errors
    /// The side of patches is out of range, or the screen is smaller than 2x2 patches.
    pub fn patches(&self) -> Result<Patches, ParameterError> {
        Patches::new(Screen::new(self.size.width(), self.size.height())?, self.patch)
    }

    /// Pages of image memory in each buffer.
    ///
    /// # Errors
    /// As [`Config::patches`].
    pub fn pages(&self) -> Result<u32, ParameterError> {
        let patches = self.patches()?;
        Ok(self.pages.unwrap_or_else(|| (IMAGE_MEMORY_PIXELS / patches.pixels()).min(patches.count())))
    }

    /// The hardware.
    ///
    /// # Errors
    /// A parameter is out of range.
    pub fn hardware(&self) -> Result<Vc1, ParameterError> {
        self.check()?;
        let lfb = LfbUnit { patches: self.patches()?, pages: self.pages()? }.checked()?;
        let display = Display::of_rate(lfb.patches.screen(), self.refresh, self.blanking)?;
        let Config { processors, queue, word_clocks, overhead, .. } = *self;
        let accumulation = self.accumulate.is_some();
        let vc1 = Vc1 { lfb, processors, queue, word_clocks, display, overhead, accumulation }.checked()?;
        let line = vc1.gfb().read_out().line_clocks() * display.period.picoseconds();
        if line < SHORTEST_LINE {
            let refresh = self.refresh;
            let problem = format!(
                "{refresh} refreshes a second: a line of the display would take {line} ps; it has to take at least {SHORTEST_LINE}"
            );
            return Err(ParameterError(problem));
        }
        Ok(vc1)
    }

    /// The configuration for a report.
    pub(crate) fn built(&self) -> Result<Built, ParameterError> {
        let Config { size, processors, patch, cluster, assign, apr, costs, queue, word_clocks, .. } = *self;
        let Config { overhead, refresh, immediate, accumulate, .. } = *self;
        Ok(Built {
            width: size.width(),
            height: size.height(),
            processors,
            patch,
            patches: self.patches()?.count(),
            pages: self.pages()?,
            cluster,
            assign,
            apr,
            costs,
            queue,
            word_clocks,
            overhead,
            refresh,
            immediate,
            passes: accumulate.map_or(1, Passes::count),
        })
    }

    /// Checks what the hardware does not check itself.
    fn check(&self) -> Result<(), ParameterError> {
        let Config { size, processors, cluster, costs, queue, overhead, accumulate, cursor, .. } = *self;
        let is_outside = |it: &Cursor| it.x >= size.width() || it.y >= size.height();
        let problem = if !(1..=Config::MAX_PROCESSORS).contains(&processors) {
            let most = Config::MAX_PROCESSORS;
            format!("a VC-1 of {processors} processing elements: it has to have from 1 to {most}")
        } else if cluster == 0 {
            "clusters of 0 polygons: they have to have at least 1".to_owned()
        } else if (queue as usize) < POLYGON_WORDS {
            format!("receive queues of {queue} words: they need space for a polygon, which has {POLYGON_WORDS}")
        } else if [costs.pixel, costs.clear, costs.send, costs.receive].contains(&0) {
            "a cost table with accesses in 0 clocks: a pixel, a cleared entry and a word take at least 1 each"
                .to_owned()
        } else if !(1..=Config::MAX_OVERHEAD).contains(&overhead) {
            format!("an overhead of {overhead} clocks a scan line: it has to be from 1 to {}", Config::MAX_OVERHEAD)
        } else if let Some(Cursor { x, y }) = cursor.filter(is_outside) {
            format!("a cursor at {x},{y} on a screen of {size}: its upper left corner has to be on the screen")
        } else if accumulate.is_some() && cursor.is_some() {
            "a cursor and pictures of several passes: their average does not show it".to_owned()
        } else {
            return Ok(());
        };
        Err(ParameterError(problem))
    }
}

/// A configuration in a report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Built {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Processing elements.
    pub processors: u32,
    /// The side of a patch in pixels.
    pub patch: u32,
    /// Patches of the screen.
    pub patches: u32,
    /// Pages of image memory in each buffer.
    pub pages: u32,
    /// Polygons of a cluster.
    pub cluster: u32,
    /// The way in which polygons are assigned.
    pub assign: Assign,
    /// The area in pixels above which all processing elements draw a packet.
    pub apr: Option<u32>,
    /// Clocks of the program's steps.
    pub costs: CostTable,
    /// Words of a receive queue.
    pub queue: u32,
    /// Clocks of a word on the bus.
    pub word_clocks: u32,
    /// Clocks of the merger after each scan line.
    pub overhead: u32,
    /// Refreshes of the display in a second.
    pub refresh: f64,
    /// Whether the scene is sent before each command.
    pub immediate: bool,
    /// The number of passes whose average is a picture; 1 if each frame is a picture.
    pub passes: u32,
}
