//! A serial flash memory as a program: it reads, in SPI mode 0, and refuses everything else.

use std::convert::Infallible;
use tilewright_sim::{Port, Testbench};

/// The levels of the lines to a memory.
#[derive(Clone, Copy, PartialEq)]
pub struct Pins {
    /// Low while the memory is selected.
    pub cs_n: bool,
    /// The clock.
    pub sck: bool,
    /// The line to the memory.
    pub mosi: bool,
}

/// A memory that knows one command to read.
pub struct Flash {
    /// Its bytes.
    pub memory: Vec<u8>,
    /// Whether it knows 0x0b; otherwise it knows 0x03.
    pub is_fast: bool,
    /// The bits that have come since it was selected.
    bits: u64,
    /// The last of them.
    word: u64,
    /// The address that the command gave.
    start: u64,
    was: Pins,
    miso: bool,
}

impl Flash {
    /// With these bytes.
    pub fn new(memory: Vec<u8>, is_fast: bool) -> Flash {
        let was = Pins { cs_n: true, sck: false, mosi: false };
        Flash { memory, is_fast, bits: 0, word: 0, start: 0, was, miso: false }
    }

    /// The level of MISO while the lines are so. Equal levels may be shown several times.
    ///
    /// # Panics
    ///
    /// `sck` is high where the memory is selected or deselected, the command is another one, `mosi` is high after the
    /// address, or the memory is deselected within a byte.
    pub fn shows(&mut self, pins: Pins) -> bool {
        let was = std::mem::replace(&mut self.was, pins);
        if pins.cs_n != was.cs_n {
            assert!(!pins.sck && !was.sck, "SCK is high where CS changes");
            assert!(self.bits.is_multiple_of(8), "the memory is deselected after {} bits", self.bits);
            (self.bits, self.miso) = (0, false);
        } else if pins.cs_n {
            assert_eq!(pins.sck, was.sck, "SCK has an edge while nobody is selected");
        } else if pins.sck && !was.sck {
            self.word = self.word << 1 | u64::from(pins.mosi);
            self.bits += 1;
            assert!(self.bits <= 32 || !pins.mosi, "MOSI is high after the address");
            let command = if self.is_fast { 0x0b } else { 0x03 };
            assert!(self.bits != 8 || self.word & 0xff == command, "command {:#x}", self.word & 0xff);
        } else if !pins.sck && was.sck {
            self.miso = self.next_bit();
        }
        self.miso
    }

    /// After a falling edge of SCK. The bit before the first byte is low.
    fn next_bit(&mut self) -> bool {
        let header = if self.is_fast { 40 } else { 32 };
        if self.bits == 32 {
            self.start = self.word & 0xff_ffff;
        }
        let Some(place) = self.bits.checked_sub(header) else { return false };
        let byte = self.memory[((self.start + place / 8) % self.memory.len() as u64) as usize];
        byte >> (7 - place % 8) & 1 == 1
    }

    /// Shows each bit `delay` clocks after the edge that asks for it, and its opposite before. Checks that no edge
    /// comes sooner than `half_period` clocks after another.
    pub async fn runs(
        &mut self,
        t: &Testbench<'_>,
        [cs_n, sck, mosi, miso]: [Port; 4],
        half_period: u32,
        delay: u32,
    ) -> Infallible {
        let (mut since, mut was) = (half_period, self.was);
        loop {
            t.step().await;
            let [cs_n, sck, mosi] = [cs_n, sck, mosi].map(|pin| t.get_u64(pin) == 1);
            let pins = Pins { cs_n, sck, mosi };
            since += 1;
            if (pins.cs_n, pins.sck) != (was.cs_n, was.sck) {
                assert!(since >= half_period, "an edge after {since} clocks at {} ps", t.time());
                since = 0;
            }
            was = pins;
            let bit = self.shows(pins);
            t.set(miso, bit ^ (!pins.sck && since + 1 < delay));
        }
    }
}
