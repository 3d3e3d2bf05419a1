//! The raster of a screen, with the colour of each pixel.

use crate::picture::{Colour, Picture, PictureIn};
use tilewright_blocks::{VideoTiming, VideoTimingIn};
use tilewright_hdl::{Module, Signal, bit, block, def, record};

record! {
    /// What a screen shows in a clock.
    pub struct Shown {
        /// The colour, where a pixel is visible.
        colour: Colour::widths(8),
        /// A pixel is visible.
        active: bit(),
        /// The sync pulse of lines, with the polarity of the timing.
        hsync: bit(),
        /// The sync pulse of frames, with the polarity of the timing.
        vsync: bit(),
    }
}

block! {
    /// Scans a picture: asks it for the colour of each pixel, and sends the sync pulses along.
    ///
    /// ```text
    ///            .--------. x, y, ends  .---------. colour
    /// runs ----->| timing |============>| picture |========>|
    ///            '--------'             '---------'         |==> shown
    ///                 '--- active, hsync, vsync ----[ .. ]->|
    /// ```
    pub struct Screen<P: Picture> {
        /// The picture.
        pub picture: P,
        /// The timing of the screen: at most 1024 visible columns and rows.
        pub timing: VideoTiming,
        /// Each pixel of the picture is two columns wide and two rows high.
        pub double: bool,
    }
    in ScreenIn {
        /// High once all clocks run. The scan begins then.
        runs: bit(),
    }
    out = Shown;
}

impl<P: Picture> Screen<P> {
    fn build(&self, m: Module, i: ScreenIn) -> Shown {
        def!(timing = m.instance(&self.timing, VideoTimingIn { enable: i.runs }));
        def!(below = timing.y.ge(self.timing.rows.visible()));
        def!(was_below = m.reg(bit()).reset(0));
        was_below.next(below);
        let place = |position: Signal| {
            let wide = if position.width() < 11 { position.zext(11) } else { position };
            wide.part(u32::from(self.double), 10)
        };
        let asked = PictureIn { x: place(timing.x), y: place(timing.y), ends: below & !was_below, runs: i.runs };
        def!(picture = m.instance(&self.picture, asked));
        let mut delayed = Pulses { active: timing.active, hsync: timing.hsync, vsync: timing.vsync };
        for clock in 1..=self.picture.latency() {
            delayed = m.pipe(&format!("delayed{clock}"), delayed);
        }
        let Pulses { active, hsync, vsync } = delayed;
        Shown { colour: picture, active, hsync, vsync }
    }
}

tilewright_hdl::bundle! {
    /// What goes along with a pixel.
    struct Pulses<T> { active: T, hsync: T, vsync: T }
}
