//! The VC-1 on a ULX3S.

use super::{NoScene, Turning, Vc1Picture};
use crate::screen::Screen;
use crate::ulx3s::{self, MachinePll, Socket, at_rest};
use tilewright_blocks::VideoTiming;
use tilewright_hdl::{Module, block, def};
use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::lfb::{LfbUnit, Patches};
use tilewright_rtl::parameter::Screen as Size;

block! {
    /// The VC-1 on a ULX3S. Its own PLL makes the clocks of the paper: 40 MHz for the processing elements, and 12.5 MHz
    /// for the merger.
    pub struct Vc1OnUlx3s {
        /// The machine.
        pub picture: Vc1Picture,
        /// The timing of the screen, which shows each pixel of the machine four times.
        pub timing: VideoTiming,
    }
    name = "vc1_on_ulx3s";
    out = Socket;
}

impl Vc1OnUlx3s {
    /// The machine as it fits an LFE5U-85F: six local frame buffers of 128 pages, a screen of 320 x 240 pixels, and the
    /// star in 24 steps of three degrees.
    ///
    /// # Errors
    ///
    /// The scene does not fit its format.
    pub fn full() -> Result<Vc1OnUlx3s, NoScene> {
        let screen = Size { width: 320, height: 240 };
        let patches = Patches::new(screen, 4).expect("the screen has patches");
        let scene = Turning::star([screen.width, screen.height], 24, 6, 0.62)?;
        let picture = Vc1Picture { lfb: LfbUnit { patches, pages: 128 }, processors: 6, scene };
        Ok(Vc1OnUlx3s { picture, timing: VideoTiming::VGA })
    }

    fn build(&self, m: Module, (): ()) -> Socket {
        m.reset_by_power_on(PE);
        m.reset_by_power_on(MERGE);
        def!(machine_pll = m.instance(&MachinePll, at_rest()));
        let screen = Screen { picture: self.picture.clone(), timing: self.timing.clone(), double: true };
        ulx3s::show(m, &screen, &[machine_pll.lock])
    }
}
