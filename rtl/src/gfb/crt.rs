//! The read-out to the display: the bank on display, line by line, with the blanking around it (VC1-GFB).
//!
//! ```text
//!   0        W    W + 160
//! 0 .--------+-------.
//!   | pixels |       |
//! H +--------'       |
//!   |    blanking    | <- the banks may change in the first of these lines
//!   '----------------' H + 45
//! ```
//!
//! Latency: a pixel appears 1 clock after its address. A refresh takes (W + 160) (H + 45) clocks: 800 x 525 for VGA.
//! The paper gives no timing of its display. Nor does it say in which part of the blanking the banks change;
//! [`Blanking`] makes that a choice.

use crate::clocks::CRT;
use crate::prelude::*;

/// Clocks of a line after its last pixel.
pub const BLANK_COLUMNS: u32 = 160;

/// Blank lines of a refresh, after the last line with pixels.
pub const BLANK_LINES: u32 = 45;

/// The display that shows the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Display {
    /// The period of its pixel clock.
    pub period: Period,
    /// When in the vertical blanking the banks may change.
    pub blanking: Blanking,
}

impl Display {
    /// VGA at 60 Hz: 420,000 clocks a refresh.
    pub const VGA: Display = Display { period: CRT.period, blanking: Blanking::AtStart };

    /// A display that refreshes that screen `hertz` times a second. The period is an even number of picoseconds.
    ///
    /// # Errors
    ///
    /// No such clock exists: the rate is not a positive number, or the period would be below 2 ps or above a second.
    pub fn of_rate(screen: Screen, hertz: f64, blanking: Blanking) -> Result<Display, ParameterError> {
        let clocks = CrtReadOut { screen, blanking }.refresh_clocks() as f64;
        let picoseconds = 2.0 * (1e12 / hertz / clocks / 2.0).floor();
        if !(2.0..=1e12).contains(&picoseconds) {
            let problem = format!("{hertz} refreshes a second: there is no such pixel clock; VGA has 60");
            return Err(ParameterError(problem));
        }
        Ok(Display { period: Period::ps(picoseconds as u64), blanking })
    }

    /// Its pixel clock.
    pub fn clock(&self) -> Clock {
        Clock::new(CRT.name, self.period)
    }
}

/// The lines of the vertical blanking in which the banks may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Blanking {
    /// In the first line.
    AtStart,
    /// In all lines but the last two, in which the display learns of the change.
    Within,
}

block! {
    /// Reads the bank on display, refresh after refresh.
    pub struct CrtReadOut {
        /// The screen: W x H pixels.
        pub screen: Screen,
        /// When in the vertical blanking the banks may change.
        pub blanking: Blanking,
    }
    latency(self) = format!("1 clock from an address to its pixel; a refresh of {} clocks", self.refresh_clocks());
    source = "VC-1, section 3.3, display of the global frame buffer (VC1-GFB, VC1-SW2, VC1-59)";
    in CrtReadOutIn {
        /// The word of the pixel at the address of the previous clock.
        word: bits(WORD),
    }
    out(self) CrtReadOutOut {
        /// The number of the pixel to read, in raster order.
        address: below(self.screen.pixels()),
        /// The outputs to the display.
        pixel: pub struct CrtPixel {
            /// The display gets a pixel in this clock.
            valid: bit(),
            /// The colour of the pixel.
            rgb: bits(24),
        },
        /// The vertical blanking: no pixel is read.
        dark: bit(),
        /// The banks may change.
        window: bit(),
    }
}

impl CrtReadOut {
    /// The clocks of a line, including the blanking after it.
    pub fn line_clocks(&self) -> u64 {
        u64::from(self.screen.width + BLANK_COLUMNS)
    }

    /// The clocks from one refresh to the next.
    pub fn refresh_clocks(&self) -> u64 {
        self.line_clocks() * u64::from(self.screen.height + BLANK_LINES)
    }

    fn build(&self, m: Module, i: CrtReadOutIn) -> CrtReadOutOut {
        let Screen { width, height } = self.screen;
        let (columns, lines) = (width + BLANK_COLUMNS, height + BLANK_LINES);
        def!(x = m.reg(below(columns)).reset(0));
        def!(y = m.reg(below(lines)).reset(height));
        def!(line_ends = x.eq(columns - 1));
        def!(last_line = y.eq(lines - 1));
        x.when(line_ends, 0).otherwise(x + 1);
        y.when(line_ends & last_line, 0).when(line_ends, y + 1);

        def!(dark = y.ge(height));
        def!(reads = x.lt(width) & !dark);
        def!(address = m.reg(below(self.screen.pixels())).reset(0));
        address.when(dark, 0).when(reads, address + 1);
        def!(valid = m.reg(bit()).reset(0));
        valid.next(reads);

        let may_change = match self.blanking {
            Blanking::AtStart => y.eq(height),
            Blanking::Within => dark & y.lt(lines - 2),
        };
        // A register, because the signal crosses to the merger's clock.
        def!(window = m.reg(bit()).reset(0));
        window.next(may_change);
        m.assert(window.implies(dark), "the banks change in a blanking");
        let pixel = CrtPixel { valid: *valid, rgb: i.word.trunc(24) };
        CrtReadOutOut { address: *address, pixel, dark, window: *window }
    }
}

#[cfg(test)]
mod tests {
    use tilewright_sim::Simulation;

    use super::*;

    fn read_out(width: u32, height: u32, blanking: Blanking) -> CrtReadOut {
        CrtReadOut { screen: Screen { width, height }, blanking }
    }

    /// 60 Hz, and the 59.94 Hz of VC1-59.
    #[test]
    fn a_refresh_of_the_vc1_is_that_of_vga() {
        assert_eq!(read_out(640, 480, Blanking::AtStart).refresh_clocks(), 800 * 525);
        let period = |hertz| Display::of_rate(Screen::VC1, hertz, Blanking::AtStart).map(|it| it.period.picoseconds());
        assert_eq!([60.0, 59.94].map(period), [Ok(39_682), Ok(39_722)]);
        assert_eq!(Display::VGA.period.picoseconds(), 39_682);
        for hertz in [0.0, -1.0, f64::NAN, 1e9] {
            let problem = period(hertz).unwrap_err().to_string();
            assert_eq!(problem, format!("{hertz} refreshes a second: there is no such pixel clock; VGA has 60"));
        }
    }

    /// Three refreshes: each pixel once, in raster order, 1 clock after its address, with 160 clocks between lines.
    #[test]
    fn it_reads_every_pixel_once_in_a_refresh() {
        for (width, height) in [(3, 2), (1, 5), (16, 8)] {
            let crt = read_out(width, height, Blanking::AtStart);
            let mut sim = Simulation::of(&crt).unwrap().seeded(7);
            sim.reset();
            let (line, lines) = (u64::from(width + 160), u64::from(height + 45));
            // A refresh begins after a blanking.
            sim.step_clock("clk", 45 * line);
            for clock in 0..3 * line * lines {
                let (x, y) = (clock % line, clock / line % lines);
                let reads = x < u64::from(width) && y < u64::from(height);
                if reads {
                    assert_eq!(sim.get_u64(sim.o.address), y * u64::from(width) + x);
                }
                assert_eq!(sim.get_u64(sim.o.dark) == 1, y >= u64::from(height));
                sim.step();
                let word = 0xabcdef_000000 + clock % 0x1000000;
                sim.set(sim.i.word, word);
                assert_eq!(sim.get_u64(sim.o.pixel.valid) == 1, reads, "{clock}");
                assert_eq!(sim.get_u64(sim.o.pixel.rgb), word & 0xffffff);
            }
        }
    }

    /// Resets in the middle of a line, and in the blanking.
    #[test]
    fn a_reset_begins_with_a_blanking() {
        let mut sim = Simulation::of(&read_out(4, 2, Blanking::AtStart)).unwrap().seeded(3);
        sim.reset();
        for clocks in [45 * 164 + 2, 45 * 164 + 166, 20] {
            let [dark, window, valid] = [sim.o.dark, sim.o.window, sim.o.pixel.valid].map(|port| sim.get_u64(port));
            assert_eq!((sim.get_u64(sim.o.address), dark, window, valid), (0, 1, 0, 0));
            sim.run(clocks);
            sim.reset();
        }
        // The first pixel comes after the 45 lines of a blanking.
        sim.run(45 * 164);
        assert_eq!((sim.get_u64(sim.o.dark), sim.get_u64(sim.o.address)), (0, 0));
    }

    /// The lines in which the window is open, one clock late because it is a register.
    #[test]
    fn the_banks_may_change_in_the_first_line_or_in_all_but_the_last_two() {
        for (blanking, last) in [(Blanking::AtStart, 1), (Blanking::Within, 43)] {
            let mut sim = Simulation::of(&read_out(4, 2, blanking)).unwrap();
            sim.reset();
            for clock in 0..2 * 164 * 47u64 {
                sim.step();
                let line = clock / 164 % 47;
                assert_eq!(sim.get_u64(sim.o.window) == 1, line < last, "clock {clock}");
            }
        }
    }
}
