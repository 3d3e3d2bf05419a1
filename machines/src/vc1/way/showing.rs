//! The display: when the read-out reads the pixel, and the colour that it gets.

use tilewright_rtl::clocks::CRT;
use tilewright_rtl::gfb::{BLANK_COLUMNS, BLANK_LINES};
use tilewright_rtl::vc1::Vc1;

use super::{Followed, Sim, net, word};
use crate::told::{At, Edge, Told, compared};

/// The model of the read-out: a counter of clocks.
pub(super) struct Showing {
    followed: Followed,
    period: u64,
    columns: u64,
    lines: u64,
    height: u64,
    /// The display's edges at the end of the reset.
    begun: Option<u64>,
}

impl Showing {
    pub fn new(machine: &Vc1, followed: Followed) -> Showing {
        let screen = machine.lfb.patches.screen();
        Showing {
            followed,
            period: machine.display.period.picoseconds(),
            columns: (screen.width + BLANK_COLUMNS).into(),
            lines: (screen.height + BLANK_LINES).into(),
            height: screen.height.into(),
            begun: None,
        }
    }

    /// The reset ends after that edge.
    pub fn begins(&mut self, clock: u64) {
        self.begun = Some(clock);
    }

    /// The column and line of the read-out after that edge.
    fn place(&self, clock: u64) -> [u64; 2] {
        let clocks = clock - self.begun.unwrap_or_default();
        [clocks % self.columns, (self.height + clocks / self.columns) % self.lines]
    }

    /// Looks at the display after an edge.
    pub fn look(&mut self, sim: &mut Sim, clock: u64, told: &mut Told) {
        let Followed { x, y, number, .. } = self.followed;
        let edge = Edge { clock: CRT.name, number: clock + 1, time: (clock + 1) * self.period };
        if self.place(clock) == [u64::from(x), u64::from(y)] {
            let address = net(sim, "u_gfb.u_crt.address");
            let at = At { unit: "display read-out".to_owned(), block: "crt-read-out", edge };
            let values = vec![compared("pixel", address, number)];
            told.tell(at.step("reads the pixel", values).on("u_gfb.u_crt.address"));
        }
        if self.place(clock - 1) == [u64::from(x), u64::from(y)] {
            let shown = 1 - sim.get_u64(sim.o.shown);
            let expected = word(sim, &format!("u_gfb.banks[{shown}]"), number) & 0xff_ffff;
            let came = net(sim, "u_gfb.u_crt.word") & 0xff_ffff;
            let at = At { unit: "global frame buffer".to_owned(), block: "gfb-unit", edge };
            let values = vec![compared("colour", format!("{came:06x}"), format!("{expected:06x}"))];
            told.tell(
                at.step(format!("reads the pixel of bank {shown} for the display"), values).on("u_gfb.u_crt.word"),
            );
            let [valid, rgb] = [sim.o.pixel.valid, sim.o.pixel.rgb].map(|port| sim.get_u64(port));
            let colour = if valid == 1 { format!("{rgb:06x}") } else { "nothing".to_owned() };
            let at = At { unit: "display read-out".to_owned(), block: "crt-read-out", edge };
            let values = vec![compared("colour", colour, format!("{came:06x}"))];
            told.tell(at.step("shows the pixel", values).on("pixel_rgb"));
        }
    }
}
