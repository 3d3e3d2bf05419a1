//! The position of each pixel on a screen, and its time.

use std::ops::Range;
use tilewright_hdl::{Module, Reg, Signal, below, bit, block, def, mux};

/// The parts of a line in pixels, or of a frame in lines: the visible part, the front porch, the sync pulse and the
/// back porch.
///
/// ```
/// use tilewright_blocks::{Scan, VideoTiming};
///
/// let line = Scan::new(640, [16, 96, 48], false);
/// assert_eq!(line.total(), 800);
/// assert_eq!(line, VideoTiming::VGA.columns);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Scan {
    visible: u32,
    front: u32,
    sync: u32,
    back: u32,
    positive: bool,
}

impl Scan {
    /// `visible` pixels or lines, and those of the front porch, the sync pulse and the back porch. The last argument is
    /// true if the pulse is high.
    ///
    /// ```
    /// use tilewright_blocks::Scan;
    ///
    /// assert_eq!(Scan::new(480, [10, 2, 33], false).total(), 525);
    /// ```
    ///
    /// # Panics
    ///
    /// Nothing is visible, or there is no pulse.
    #[track_caller]
    pub const fn new(visible: u32, [front, sync, back]: [u32; 3], positive: bool) -> Scan {
        assert!(visible > 0 && sync > 0, "a scan has something visible and a sync pulse: each is 1 or more");
        Scan { visible, front, sync, back, positive }
    }

    /// All parts together.
    ///
    /// ```
    /// use tilewright_blocks::VideoTiming;
    ///
    /// let VideoTiming { columns, rows } = VideoTiming::VGA;
    /// let frames = 25_175_000.0 / f64::from(columns.total() * rows.total());
    /// assert_eq!(format!("{frames:.2}"), "59.94"); // a second
    /// ```
    pub const fn total(&self) -> u32 {
        self.visible + self.front + self.sync + self.back
    }

    /// The visible part.
    ///
    /// ```
    /// use tilewright_blocks::VideoTiming;
    ///
    /// let VideoTiming { columns, rows } = VideoTiming::SVGA;
    /// assert_eq!([columns, rows].map(|scan| scan.visible()), [800, 600]);
    /// ```
    pub const fn visible(&self) -> u32 {
        self.visible
    }

    /// Where the pulse is.
    fn pulse(&self) -> Range<u32> {
        let start = self.visible + self.front;
        start..start + self.sync
    }

    /// The level of the pin, inside the pulse or outside it.
    fn level(&self, in_pulse: Reg) -> Signal {
        if self.positive { *in_pulse } else { !in_pulse }
    }
}

block! {
    /// Scans a screen: gives the position of each pixel, and the sync pulses of its lines and frames.
    ///
    /// ```text
    ///            .-----------.  new row   .----------.
    /// enable --->| column    |----------->| row      |
    ///            '-----------'            '----------'
    ///              |   '--> x, hsync        |   '--> y, vsync
    ///              '--------->( & )<--------'
    ///                           '--> active
    /// ```
    ///
    /// A line; a frame has the same parts:
    ///
    /// ```text
    /// x       0 .. visible - 1 | front porch | sync pulse | back porch
    /// active  ~~~~~~~~~~~~~~~~~\______________________________________
    /// hsync   ~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\____________/~~~~~~~~~~~   if it is low
    /// y       row              |             | row + 1
    /// ```
    ///
    /// Latency 1 clock with `enable`. After a reset `x` and `y` are 0. A row begins with the sync pulse before it, so
    /// both pulses begin together, as in VESA and CTA-861. `y` is the same in all visible pixels of a row.
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let tiny = VideoTiming { columns: Scan::new(3, [1, 1, 1], false), rows: Scan::new(1, [0, 1, 1], true) };
    /// let mut sim = Simulation::of(&tiny)?;
    /// sim.reset();
    /// let wave = sim.record(["x", "y", "active", "hsync", "vsync"]);
    /// sim.stream([VideoTimingIn { enable: 1 }; 19]);
    /// wave.expect(r"
    ///     clk    |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
    ///     x      | 0 | 1 | 2 | 3 | 4 | 5 | 0 | 1 | 2 | 3 | 4 | 5 | 0 | 1 | 2 | 3 | 4 | 5 | 0 |
    ///     y      | 0             | 1                     | 2                     | 0         |
    ///     active |~~~~~~~~~~~\___________________________________________________________/~~~~
    ///     hsync  |~~~~~~~~~~~~~~~\___/~~~~~~~~~~~~~~~~~~~\___/~~~~~~~~~~~~~~~~~~~\___/~~~~~~~~
    ///     vsync  |_______________/~~~~~~~~~~~~~~~~~~~~~~~\____________________________________");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct VideoTiming {
        /// The parts of a line.
        pub columns: Scan,
        /// The parts of a frame.
        pub rows: Scan,
    }
    latency = "1 clock with `enable`";
    in VideoTimingIn {
        /// High to go on to the next pixel.
        enable: bit(),
    }
    out(self) VideoTimingOut {
        /// The column of the pixel, which counts on to the end of the line.
        x: below(self.columns.total()),
        /// The row of the pixel, which counts on to the end of the frame.
        y: below(self.rows.total()),
        /// High where the pixel is visible.
        active: bit(),
        /// The sync pulse of lines, with the polarity that their timing sets.
        hsync: bit(),
        /// The sync pulse of frames, with the polarity that their timing sets.
        vsync: bit(),
    }
}

impl VideoTiming {
    /// 640 x 480 at 59.94 Hz, with a pixel clock of 25.175 MHz.
    ///
    /// ```
    /// use tilewright_blocks::VideoTiming;
    /// assert_eq!([VideoTiming::VGA.columns, VideoTiming::VGA.rows].map(|scan| scan.total()), [800, 525]);
    /// ```
    pub const VGA: VideoTiming =
        VideoTiming { columns: Scan::new(640, [16, 96, 48], false), rows: Scan::new(480, [10, 2, 33], false) };

    /// 800 x 600 at 60.32 Hz, with a pixel clock of 40 MHz.
    ///
    /// ```
    /// use tilewright_blocks::VideoTiming;
    /// assert_eq!([VideoTiming::SVGA.columns, VideoTiming::SVGA.rows].map(|scan| scan.total()), [1056, 628]);
    /// ```
    pub const SVGA: VideoTiming =
        VideoTiming { columns: Scan::new(800, [40, 128, 88], true), rows: Scan::new(600, [1, 4, 23], true) };

    /// 1280 x 720 at 60 Hz, with a pixel clock of 74.25 MHz.
    ///
    /// ```
    /// use tilewright_blocks::VideoTiming;
    /// assert_eq!([VideoTiming::HD.columns, VideoTiming::HD.rows].map(|scan| scan.total()), [1650, 750]);
    /// ```
    pub const HD: VideoTiming =
        VideoTiming { columns: Scan::new(1280, [110, 40, 220], true), rows: Scan::new(720, [5, 5, 20], true) };

    fn build(&self, m: Module, i: VideoTimingIn) -> VideoTimingOut {
        let VideoTiming { columns, rows } = self;
        def!(x = m.reg(below(columns.total())).reset(0));
        def!(y = m.reg(below(rows.total())).reset(0));
        def!(new_row = i.enable & x.eq(columns.pulse().start - 1));
        x.when(i.enable, mux(x.eq(columns.total() - 1), 0, x + 1));
        y.when(new_row, mux(y.eq(rows.total() - 1), 0, y + 1));

        let in_row = during(m, "in_row", i.enable, x, (0..columns.visible, columns.total()));
        let in_column = during(m, "in_column", new_row, y, (0..rows.visible, rows.total()));
        // Registers, because a glitch at a pin would be a pulse.
        let in_hsync = during(m, "in_hsync", i.enable, x, (columns.pulse(), columns.total()));
        let in_vsync = during(m, "in_vsync", new_row, y, (rows.pulse(), rows.total()));
        let active = in_row & in_column;
        m.assert(active.implies(x.lt(columns.visible) & y.lt(rows.visible)), "what is active is visible");
        VideoTimingOut { x: *x, y: *y, active, hsync: columns.level(in_hsync), vsync: rows.level(in_vsync) }
    }
}

/// A register that is high while a position is in a range. The position wraps around, and is 0 after a reset.
fn during(m: Module, name: &str, moves: Signal, position: Reg, (range, total): (Range<u32>, u32)) -> Reg {
    let reaches = |place: u32| moves & position.eq((place + total - 1) % total);
    let register = m.reg(name, bit()).reset(range.contains(&0));
    register.when(reaches(range.start), 1).when(reaches(range.end), 0);
    register
}
