//! A simulated board.

use tilewright_boards::icebreaker::{PIXEL, Pmod};
use tilewright_boards::receiver::{Lines, Seen, received};
use tilewright_boards::ulx3s::SERIAL;
use tilewright_hdl::{Block, elaborate};
use tilewright_sim::Simulation;

/// A board that runs, and what its pins have sent.
pub struct Board {
    sim: Simulation,
    /// The names of the registers of the pins' models, which have the bits of both edges.
    bits: [String; 4],
    pub lines: Lines,
}

impl Board {
    pub fn new<B: Block>(top: &B) -> Board {
        let sim = Simulation::from_design(&elaborate(top).unwrap()).unwrap().seeded(5);
        let bits = std::array::from_fn(|lane| format!("u_tmds[{lane}].sent"));
        Board { sim, bits, lines: Lines::default() }
    }

    /// Lets clocks of the lines pass, of which nobody receives anything.
    pub fn skip(&mut self, clocks: usize) {
        self.sim.step_clock(SERIAL, clocks as u64);
    }

    /// The value of a signal.
    pub fn peek(&mut self, signal: &str) -> u64 {
        self.sim.peek(signal).unwrap().to_u64().unwrap()
    }

    /// Receives what the pins send in these clocks of the lines.
    pub fn receive(&mut self, clocks: usize) {
        for _ in 0..clocks {
            self.sim.step_clock(SERIAL, 1);
            for (line, bits) in self.lines.iter_mut().zip(&self.bits) {
                let sent = self.sim.peek(bits).unwrap().to_u64().unwrap();
                line.extend([sent & 1 == 1, sent & 2 == 2]);
            }
        }
    }
}

/// What a receiver sees of a ULX3S in these clocks of its lines.
pub fn seen<B: Block>(top: &B, clocks: usize) -> Vec<Seen> {
    let mut board = Board::new(top);
    board.receive(clocks);
    assert_eq!(board.sim.peek("locked").unwrap(), 1);
    received(&board.lines).unwrap()
}

/// What a PMOD of an iCEBreaker takes in clocks of the pixels, after others. A pixel's lower bits are 0.
pub fn seen_of_pmod<B: Block<Out = Pmod>>(top: &B, after: usize, clocks: usize) -> Vec<Seen> {
    let mut sim = Simulation::of(top).unwrap().seeded(5);
    let pins = sim.o;
    if after > 0 {
        sim.step_clock(PIXEL, after as u64);
    }
    let seen = (0..clocks).map(|_| {
        sim.step_clock(PIXEL, 1);
        let mut pin = |port| sim.get_u64(port);
        match pin(pins.active) {
            1 => Seen::Pixel([pins.red, pins.green, pins.blue].map(|port| (pin(port) << 4) as u8)),
            _ => Seen::Blank { hsync: pin(pins.hsync) == 1, vsync: pin(pins.vsync) == 1 },
        }
    });
    seen.collect()
}
