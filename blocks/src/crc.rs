//! A cyclic redundancy check.

use tilewright_hdl::{Module, bit, bits, block, concat, def, hex, mux};

/// The bit of a byte that is sent first.
///
/// ```
/// use tilewright_blocks::{BitOrder, Crc};
///
/// let ethernet = Crc::new(32, 0x04c1_1db7, 0xffff_ffff, BitOrder::LeastFirst);
/// let bzip2 = Crc::new(32, 0x04c1_1db7, 0xffff_ffff, BitOrder::MostFirst);
/// assert_ne!(ethernet, bzip2);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BitOrder {
    /// The least significant bit: Ethernet, ZIP, USB. The check is also read in that direction.
    LeastFirst,
    /// The most significant bit: XMODEM, SD cards.
    MostFirst,
}

block! {
    /// Divides a message by a polynomial, one byte per clock, and keeps the remainder: a cyclic redundancy check.
    ///
    /// ```text
    ///          .---------------------------.
    ///          v                           |
    /// data ==>[+]--> 8 steps of division --+-->[ rest ]==> crc
    /// ```
    ///
    /// Latency 1 clock. A standard's final inversion (`!crc` for Ethernet) is left to the reader of `crc`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{BitOrder, Crc, CrcIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(at = m.reg(4).reset(0));
    /// at.when(at.ne(9), at + 1);
    /// let message = CrcIn { restart: lit(1, 0), take: at.ne(9), data: at.zext(8) + u64::from(b'1') }; // "123456789"
    /// let crc = Crc::new(32, 0x04c1_1db7, 0xffff_ffff, BitOrder::LeastFirst);
    /// def!(check = !m.instance("u_crc", &crc, message).crc);
    /// # });
    /// let checks: [u64; 10] = example.values("check");
    /// assert_eq!(checks[9], 0xcbf4_3926); // as tables of these codes say
    /// ```
    pub struct Crc {
        width: u32,
        polynomial: u64,
        start: u64,
        order: BitOrder,
    }
    latency = "1 clock";
    in CrcIn {
        /// Begins a message, with priority over `take`.
        restart: bit(),
        /// `data` is the next byte of the message.
        take: bit(),
        /// A byte of the message.
        data: bits(8),
    }
    out(self) CrcOut {
        /// The remainder of the bytes that were taken.
        crc: bits(self.width),
    }
}

impl Crc {
    /// A check of `width` bits, from 2 to 64. `polynomial` leaves out the highest term; `start` is the initial
    /// remainder.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::{BitOrder, Crc};
    ///
    /// let design = elaborate(&Crc::new(16, 0x1021, 0xffff, BitOrder::MostFirst))?; // CRC-16/CCITT
    /// # assert!(tilewright_gen::verilog(&design)[0].text.contains("16'h1021"));
    /// # Ok::<(), Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// `width` is out of range, or the polynomial or the remainder has more bits.
    #[track_caller]
    pub fn new(width: u32, polynomial: u64, start: u64, order: BitOrder) -> Crc {
        assert!((2..=64).contains(&width), "a CRC of {width} bits: it has from 2 to 64");
        let most = u64::MAX >> (64 - width);
        assert!(
            polynomial <= most && start <= most,
            "a CRC of {width} bits by {polynomial:#x} from {start:#x} on: both have {width} bits, the highest term of the polynomial left out"
        );
        Crc { width, polynomial, start, order }
    }

    fn build(&self, m: Module, i: CrcIn) -> CrcOut {
        def!(rest = m.reg(self.width).reset(hex(self.start)));
        let mut next = *rest;
        for step in 0..8 {
            let sent = match self.order {
                BitOrder::LeastFirst => i.data.bit(step),
                BitOrder::MostFirst => i.data.bit(7 - step),
            };
            let shifted = next << 1;
            next = mux(next.msb() ^ sent, shifted ^ hex(self.polynomial), shifted).named(&format!("after{}", step + 1));
        }
        rest.when(i.restart, hex(self.start)).when(i.take, next);
        let crc = match self.order {
            BitOrder::LeastFirst => concat(&(0..self.width).map(|place| rest.bit(place)).collect::<Vec<_>>()),
            BitOrder::MostFirst => *rest,
        };
        CrcOut { crc }
    }
}
