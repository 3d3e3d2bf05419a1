//! An I2C bus of programs: its lines, and an EEPROM on it, which looks at the lines in every clock.

use std::cell::Cell;
use std::convert::Infallible;
use tilewright_sim::{Answer, Pauses, Port, Testbench};

/// What a device does to SCL and to SDA: it pulls them low, or not.
#[derive(Default)]
pub struct Pulls {
    scl: Cell<bool>,
    sda: Cell<bool>,
}

/// The two lines of a bus.
pub struct Bus<'t, 's> {
    /// The testbench of the chip at the bus.
    pub t: &'t Testbench<'s>,
    /// The inputs that pull SCL and SDA low, and the outputs that show the lines.
    lines: [Port; 4],
    /// Two devices.
    pulls: [Pulls; 2],
}

impl<'t, 's> Bus<'t, 's> {
    /// The inputs that pull SCL and SDA low, and the outputs that show the lines.
    pub fn new(t: &'t Testbench<'s>, lines: [Port; 4]) -> Bus<'t, 's> {
        Bus { t, lines, pulls: Default::default() }
    }

    /// The levels of SCL and SDA.
    pub fn levels(&self) -> (bool, bool) {
        let [.., scl, sda] = self.lines;
        (self.t.get_u64(scl) == 1, self.t.get_u64(sda) == 1)
    }

    /// Device `number` pulls SCL low, or releases it.
    pub fn pull_scl(&self, number: usize, low: bool) {
        self.pulls[number].scl.set(low);
    }

    /// Device `number` pulls SDA low, or releases it.
    pub fn pull_sda(&self, number: usize, low: bool) {
        self.pulls[number].sda.set(low);
    }

    /// The process that pulls SCL low as long as a device does.
    pub fn scl(&self) -> Answer<impl FnMut([u64; 0]) -> bool, 0> {
        self.t.answer(self.lines[0], [], |[]| self.pulls.iter().any(|pulls| pulls.scl.get()))
    }

    /// The process that pulls SDA low as long as a device does.
    pub fn sda(&self) -> Answer<impl FnMut([u64; 0]) -> bool, 0> {
        self.t.answer(self.lines[1], [], |[]| self.pulls.iter().any(|pulls| pulls.sda.get()))
    }
}

/// How a slave stretches the clock.
pub struct Stretching {
    when: Pauses,
    longest: u32,
}

impl Stretching {
    /// Never.
    pub const NONE: Stretching = Stretching { when: Pauses::NONE, longest: 0 };

    /// After a falling edge of SCL, with this probability, for up to `longest` clocks.
    pub fn new(percent: u64, longest: u32, seed: u64) -> Stretching {
        Stretching { when: Pauses::percent(percent, seed), longest }
    }

    /// The clocks for which SCL is kept low after a falling edge.
    fn next(&mut self) -> u32 {
        (self.when.next_length() * 5).min(self.longest)
    }
}

/// What an [`Eeprom`] does with the byte on the bus.
#[derive(Clone, Copy, PartialEq)]
enum Byte {
    /// It is for others.
    Ignored,
    /// It may be the EEPROM's address.
    Address,
    /// It is where to read or write.
    Pointer,
    /// It is stored.
    Stored,
    /// The EEPROM sends it.
    Sent(u64),
}

/// An EEPROM: the first byte of a write is an address, and the others are stored from there on. A read goes on where
/// the last access has ended. The address wraps at the end of the memory.
pub struct Eeprom {
    /// Its address on the bus.
    pub address: u64,
    /// Its bytes.
    pub memory: Vec<u64>,
    /// It refuses each byte to be stored while this is true.
    pub is_protected: bool,
    pointer: usize,
    byte: Byte,
    /// The bits of the byte so far, of the eight and the acknowledgement.
    bits: u32,
    word: u64,
    accepted: bool,
}

impl Eeprom {
    /// At this address of the bus, with these bytes.
    pub fn new(address: u64, memory: Vec<u64>) -> Eeprom {
        let (byte, is_protected) = (Byte::Ignored, false);
        Eeprom { address, memory, is_protected, pointer: 0, byte, bits: 0, word: 0, accepted: false }
    }

    /// Is device 0 of the bus.
    pub async fn runs(&mut self, bus: &Bus<'_, '_>, mut stretching: Stretching) -> Infallible {
        let (mut scl_was, mut sda_was, mut stretched) = (true, true, 0u32);
        loop {
            bus.t.step().await;
            let (scl, sda) = bus.levels();
            if scl && scl_was && sda != sda_was {
                (self.byte, self.bits, self.word) = (if sda { Byte::Ignored } else { Byte::Address }, 0, 0);
            } else if scl && !scl_was {
                self.samples(sda);
            } else if !scl && scl_was {
                bus.pull_sda(0, self.pulls_sda());
                stretched = stretching.next();
                bus.pull_scl(0, stretched > 0);
            } else if stretched > 0 {
                stretched -= 1;
                bus.pull_scl(0, stretched > 0);
            }
            (scl_was, sda_was) = (scl, sda);
        }
    }

    /// SCL has risen.
    fn samples(&mut self, sda: bool) {
        if self.bits < 8 {
            self.word = self.word << 1 | u64::from(sda);
        } else {
            self.accepted = !sda;
        }
        self.bits += 1;
    }

    /// SCL has fallen; whether SDA is to be low for the next bit.
    fn pulls_sda(&mut self) -> bool {
        if self.bits == 8 {
            return self.acknowledges();
        }
        if self.bits == 9 {
            self.goes_on();
            (self.bits, self.word) = (0, 0);
        }
        match self.byte {
            Byte::Sent(byte) => byte >> (7 - self.bits) & 1 == 0,
            _ => false,
        }
    }

    /// Takes a whole byte; whether it is acknowledged.
    fn acknowledges(&mut self) -> bool {
        match self.byte {
            Byte::Ignored | Byte::Sent(_) => false,
            Byte::Address => self.word >> 1 == self.address,
            Byte::Pointer => {
                self.pointer = self.word as usize % self.memory.len();
                true
            }
            Byte::Stored if self.is_protected => false,
            Byte::Stored => {
                self.memory[self.pointer] = self.word;
                self.pointer = (self.pointer + 1) % self.memory.len();
                true
            }
        }
    }

    /// After an acknowledgement: what the next byte is.
    fn goes_on(&mut self) {
        self.byte = match self.byte {
            _ if !self.accepted => Byte::Ignored,
            Byte::Address if self.word & 1 == 1 => self.next_sent(),
            Byte::Address => Byte::Pointer,
            Byte::Sent(_) => self.next_sent(),
            Byte::Pointer | Byte::Stored => Byte::Stored,
            Byte::Ignored => Byte::Ignored,
        };
    }

    fn next_sent(&mut self) -> Byte {
        let byte = self.memory[self.pointer];
        self.pointer = (self.pointer + 1) % self.memory.len();
        Byte::Sent(byte)
    }
}
