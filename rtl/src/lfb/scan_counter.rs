//! The scan counter: selects the pixel that a local frame buffer sends next to the image merger (VC1-SCAN).
//!
//! ```text
//!                .---.          .---.
//! enable --+---->| x |--- end ->| y |--- end of the frame --> [ armed ] -->
//!          |     '---'          '---'
//! restart -+-- preset.x ---- preset.y
//! ```
//!
//! Latency: 1 clock; a pixel for every clock with `enable`.
//!
//! The counter runs freely in raster order, from the upper left to the lower right, and then starts again at once.
//! In the chain each counter runs 4 pixels ahead of the succeeding one. This is the latency of a merging unit, so all
//! samples of a pixel meet. A restart therefore sets every counter but the first near the end of a frame. The pixels up
//! to that end would be sent and cleared in vain: they meet pixels that entered the chain before the restart. `armed`
//! rises with the first whole frame and stays high. From then on, any run of as many pixels as the screen has
//! includes each pixel exactly once.

use crate::prelude::*;

/// How far a scan counter runs ahead of the succeeding one, in pixels.
const LEAD: u32 = crate::merger::STAGES;

block! {
    /// Counts the pixels of the screen in raster order from a preset on, frame after frame.
    pub struct ScanCounter {
        /// The screen.
        pub screen: Screen,
    }
    latency = "1 clock";
    source = "VC-1, section 3.3, scan counter (VC1-SCAN)";
    in(self) ScanCounterIn {
        /// The control of the scan, from the global frame buffer.
        scan: ScanControl,
        /// The pixel to which a restart sets the counter; a constant.
        preset: Position::widths(self.screen),
    }
    out(self) ScanCounterOut {
        /// The pixel to send.
        pixel: Position::widths(self.screen),
        /// The pixel belongs to the first whole frame after the restart, or to a later one.
        armed: bit(),
    }
}

impl ScanCounter {
    /// The preset of the counter at a position of the chain. Position 0 is the first, fed by the global frame buffer.
    /// The chain has at most a quarter as many positions as the screen has pixels.
    pub fn preset(screen: Screen, position: u32) -> Position<u64> {
        // The counter starts this many pixels before the first one, at the end of the previous frame.
        let pixel = (-i64::from(LEAD * position)).rem_euclid(screen.pixels().into()) as u64;
        Position { x: pixel % u64::from(screen.width), y: pixel / u64::from(screen.width) }
    }

    fn build(&self, m: Module, i: ScanCounterIn) -> ScanCounterOut {
        let ScanControl { restart, enable } = i.scan;
        def!(x = m.reg(i.preset.x.width()).reset(0));
        def!(y = m.reg(i.preset.y.width()).reset(0));
        def!(armed = m.reg(bit()).reset(0));
        def!(line_end = enable & x.eq(self.screen.width - 1));
        def!(last_line = y.eq(self.screen.height - 1));
        def!(frame_end = line_end & last_line);

        x.when(restart, i.preset.x).when(line_end, 0).when(enable, x + 1);
        y.when(restart, i.preset.y).when(frame_end, 0).when(line_end, y + 1);
        def!(at_start = i.preset.x.eq(0) & i.preset.y.eq(0));
        armed.when(restart, at_start).when(frame_end, 1);
        m.cover("a whole frame is sent", frame_end & armed);
        ScanCounterOut { pixel: Position { x: *x, y: *y }, armed: *armed }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tilewright_hdl::{Block, bundle, constants};
    use tilewright_sim::Simulation;

    use super::*;

    #[test]
    fn the_counter_goes_in_raster_order_and_holds_without_enable() {
        let screen = Screen { width: 3, height: 2 };
        let mut sim = Simulation::of(&ScanCounter { screen }).unwrap();
        let (i, o) = (sim.i, sim.o);
        let wave = sim.record([i.scan.restart, i.scan.enable, o.pixel.x, o.pixel.y, o.armed]);
        sim.reset();
        let preset = ScanCounter::preset(screen, 1);
        let restart = [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0];
        let enable = [0, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 0];
        for (restart, enable) in restart.into_iter().zip(enable) {
            sim.drive(ScanCounterIn { scan: ScanControl { restart, enable }, preset });
            sim.step();
        }
        wave.expect(
            r"
            clk          |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
            scan_restart |___/~~~\___________________________________/~~~\____
            scan_enable  |_______/~~~~~~~~~~~\___/~~~~~~~~~~~~~~~~~~~~~~~\____
            pixel_x      | 0     | 2 | 0 | 1 | 2     | 0 | 1 | 2 | 0 | 1 | 2 |
            pixel_y      |___________/~~~~~~~~~~~~~~~\___________/~~~~~~~\____
            armed        |___________________________/~~~~~~~~~~~~~~~~~~~\____
            ",
        );
    }

    /// A chain of counters with the presets of their positions.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Chain {
        screen: Screen,
        length: u32,
    }

    bundle! {
        struct Pixels<T> { pixel: Vec<Position<T>>, armed: Vec<T> }
    }

    impl Block for Chain {
        type In = ScanControl;
        type Out = Pixels;

        fn inputs(&self) -> ScanControl<Width> {
            ScanControl::widths()
        }

        fn build(&self, m: Module, i: ScanControl) -> Pixels {
            let widths = Position::widths(self.screen);
            let preset = |position| ScanCounter::preset(self.screen, position);
            def!(
                scan_counter = m.array(self.length, &ScanCounter { screen: self.screen }, |_| ScanCounterIn {
                    scan: i,
                    preset: Position {
                        x: constants(widths.x.of(self.length), |lane| preset(lane).x),
                        y: constants(widths.y.of(self.length), |lane| preset(lane).y),
                    },
                })
            );
            let (x, y) = (scan_counter.pixel.x.to_vec(), scan_counter.pixel.y.to_vec());
            Pixels {
                pixel: x.into_iter().zip(y).map(|(x, y)| Position { x, y }).collect(),
                armed: scan_counter.armed.to_vec(),
            }
        }
    }

    #[test]
    fn each_counter_runs_4_pixels_ahead_of_the_succeeding_one_and_sends_from_the_first_whole_frame_on() {
        let (screen, length) = (Screen { width: 7, height: 5 }, 8);
        let frame = u64::from(screen.pixels());
        let mut sim = Simulation::of(&Chain { screen, length }).unwrap();
        sim.reset();
        sim.drive(ScanControl { restart: 1, enable: 0 });
        sim.step();
        sim.drive(ScanControl { restart: 0, enable: 1 });
        for clock in 0..3 * frame {
            let Pixels { pixel, armed } = sim.read_u64();
            let numbers: Vec<u64> = pixel.iter().map(|at| at.y * u64::from(screen.width) + at.x).collect();
            assert!(numbers.windows(2).all(|pair| pair[0] == (pair[1] + 4) % frame), "{numbers:?} in clock {clock}");
            for (position, armed) in (0..).zip(armed) {
                assert_eq!(armed == 1, clock >= 4 * position, "position {position} in clock {clock}");
            }
            sim.step();
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Compares with division (VC1-SCAN). The counter at position p of the chain starts 4 p pixels before the end
        /// of a frame. It is armed from its first whole frame on. A restart takes the preset that is there in the same
        /// clock.
        #[test]
        fn it_counts_a_frame_from_its_preset_on(
            (width, height) in (1..9u32, 1..7u32),
            steps in prop::collection::vec((prop::bool::weighted(0.03), prop::bool::weighted(0.85), 0..20u32), 1..400),
            seed in any::<u64>(),
        ) {
            let screen = Screen { width, height };
            let frame = u64::from(width * height);
            let mut sim = Simulation::of(&ScanCounter { screen }).unwrap().seeded(seed);
            sim.reset();
            let (mut restarted, mut until_first, mut advanced, mut frames) = (false, 0, 0, 0);
            for (restart, enable, position) in steps {
                let preset = ScanCounter::preset(screen, position);
                let scan = ScanControl { restart: restart.into(), enable: enable.into() };
                sim.drive(ScanCounterIn { scan, preset });
                let ScanCounterOut { pixel, armed } = sim.read_u64();
                let number = (frame - until_first + advanced) % frame;
                prop_assert_eq!((pixel.x, pixel.y), (number % u64::from(width), number / u64::from(width)));
                // Without a restart the counter begins at the first pixel, and is armed when it returns there.
                let is_armed = if restarted { advanced >= until_first } else { advanced >= frame };
                prop_assert_eq!(armed == 1, is_armed);
                frames += u64::from(is_armed && enable && number == frame - 1);
                sim.step();
                if restart {
                    (restarted, until_first, advanced) = (true, u64::from(4 * position) % frame, 0);
                } else if enable {
                    advanced += 1;
                }
            }
            prop_assert_eq!(sim.covered("a whole frame is sent").unwrap(), frames);
        }
    }
}
