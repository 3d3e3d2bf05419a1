//! The frame buffer in each clock, as far as it is about one pixel.

use tilewright_rtl::pixelflow::frame_buffer::{FrameBuffer, FrameBufferIn, FrameBufferOut};
use tilewright_sim::Simulation;

use super::array::Place;
use super::{FRAME_BUFFER, Observer};
use crate::error::Error;
use crate::looks::Looks;
use crate::pixelflow::costs::Ticks;
use crate::told::{Checks, Told, Unit, compared, value, violated};

const CLOCK: (&str, u64) = ("clk", 10_000);
const PORT: [&str; 5] = ["start", "port_pixel", "port_address", "port_writes", "done"];

/// A frame buffer.
pub(in crate::pixelflow) struct StoreObserver {
    told: Told,
    tick: Ticks,
    /// The number of the pixel's word in its chip.
    number: u64,
    samples: u64,
    pixels: u64,
    turn: u64,
    /// The region of the pixel, and the number of its pixel in a scan.
    region: usize,
    shown: usize,
    unit: Unit,
    /// What the buffer sees of the pixel's chip.
    seen: String,
    looks: Looks,
    clock: Option<u64>,
    regions: usize,
    sums: [u64; 3],
    colour: Option<[u64; 3]>,
}

impl StoreObserver {
    /// For the pixel of that number in a scan.
    pub fn new(buffer: &FrameBuffer, place: Place, region: usize, shown: usize) -> StoreObserver {
        let mut looks = Looks::default();
        looks.add("", PORT);
        let seen = format!("seen[{}]", place.chip);
        looks.add("", [seen.as_str()]);
        let is_one = buffer.samples == 1;
        let side = if is_one { 1 } else { 4 };
        StoreObserver {
            told: Told::of(FRAME_BUFFER),
            tick: 0,
            number: if is_one { place.pixel.into() } else { (place.at[0] / 2).into() },
            samples: buffer.samples.into(),
            pixels: (buffer.processors() / side).into(),
            turn: buffer.turn().into(),
            region,
            shown,
            unit: Unit::new(
                "frame buffer",
                if is_one { "pixelflow-frame-buffer" } else { "pixelflow-samples-frame-buffer" },
                CLOCK,
                "",
            ),
            seen,
            looks,
            clock: None,
            regions: 0,
            sums: [0; 3],
            colour: None,
        }
    }

    /// The processor and the register that are read.
    fn place(&self, round: u64, at: u64) -> [u64; 2] {
        if self.samples == 1 {
            return [round, at];
        }
        let (sample, register) = (at / 6, at % 6);
        [(sample >> 1) * 2 * self.pixels + 2 * round + sample % 2, register]
    }

    fn gather(&mut self, at: u64, seen: u64) {
        if at == 0 {
            self.sums = [0; 3];
        }
        self.sums[at as usize % 3] += seen;
        if at + 1 == 3 * self.samples {
            let half = self.samples / 2;
            let [blue, green, red] = self.sums.map(|sum| (sum + half) / self.samples);
            self.colour = Some([red, green, blue]);
            let values = vec![value("colour", format!("{red:02x}{green:02x}{blue:02x}"))];
            self.told.tell(self.unit.step_at(&self.seen, self.tick / 2, None, "takes the pixel's colour", values));
        }
    }

    /// Compares the colour that is displayed as a pixel of that number.
    pub fn shows(&mut self, number: usize, colour: [u8; 3]) {
        if number != self.shown {
            return;
        }
        let right =
            self.colour.map_or("nothing".to_owned(), |[red, green, blue]| format!("{red:02x}{green:02x}{blue:02x}"));
        let [red, green, blue] = colour;
        let values = vec![compared("colour", format!("{red:02x}{green:02x}{blue:02x}"), right)];
        let cycle = self.tick / 2 + 1 + number as u64;
        self.told.tell(self.unit.step_at("pixels_valid", cycle, None, "displays the pixel", values));
    }

    /// The scan has ended after that number of pixels.
    pub fn ends(&mut self, pixels: usize) {
        if pixels <= self.shown {
            let values = vec![compared("colour", "nothing", "a colour")];
            self.told.tell(self.unit.step_at("pixels_valid", self.tick / 2 + 1, None, "displays the pixel", values));
        }
    }
}

impl Observer<FrameBufferIn, FrameBufferOut> for StoreObserver {
    fn now(&mut self, tick: Ticks) {
        self.tick = tick;
    }

    fn look(&mut self, sim: &mut Simulation<FrameBufferIn, FrameBufferOut>) {
        self.looks.look(sim);
        let mut checks = Checks::default();
        let [start, pixel, address, writes, done, seen] = self.looks.from(0);
        checks.same("port_writes", writes, 0);
        let all = self.turn * (self.pixels + 1);
        match self.clock {
            None => checks.same("done", done, 0),
            Some(now) => {
                let (round, at) = (now / self.turn, now % self.turn);
                if round < self.pixels && at < 3 * self.samples {
                    let [to, register] = self.place(round, at);
                    checks.same("port_pixel", pixel, to);
                    checks.same("port_address", address, register);
                    if round == self.number && self.regions == self.region + 1 {
                        self.gather(at, seen);
                    }
                }
                checks.bit("done", done, now + 1 == all);
            }
        }
        let step = self.unit.differing(self.tick / 2, "reads the colours of a region", &mut checks);
        self.told.extend(step);
        self.clock = match (start, self.clock) {
            (1, _) => {
                self.regions += 1;
                Some(0)
            }
            (_, Some(now)) if now + 1 < all => Some(now + 1),
            _ => None,
        };
    }

    fn fail(&mut self, error: &Error) {
        let Some((_, sentence)) = violated(error).filter(|_| !self.told.differs()) else { return };
        self.told.tell(self.unit.fails(self.tick / 2, sentence));
    }

    fn told(&mut self) -> &mut Told {
        &mut self.told
    }
}
