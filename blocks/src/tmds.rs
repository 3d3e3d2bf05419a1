//! The symbols of DVI and HDMI.

use crate::count_ones::count_ones;
use tilewright_hdl::{Module, binary, bit, bits, block, case, cat, concat, def, mux, record, select};

/// The symbol for each value of `control`, as DVI 1.0 lists them. They have more edges than any symbol of a pixel.
const CONTROL: [u64; 4] = [0b11_0101_0100, 0b00_1010_1011, 0b01_0101_0100, 0b10_1010_1011];

record! {
    /// The result of the first stage for a byte.
    struct Minimized {
        /// A pixel is shown.
        active: bit(),
        /// The control bits to send if no pixel is shown.
        control: bits(2),
        /// The byte with few edges: each bit is one of the byte, combined with the bit before.
        word: bits(8),
        /// The bits were combined by XOR, not by XNOR.
        by_xor: bit(),
    }
}

block! {
    /// Encodes a byte of a colour as a symbol of 10 bits, as DVI and HDMI transmit it.
    ///
    /// This is transition-minimized differential signaling (TMDS). Few bits differ from their neighbours, and as many
    /// ones as zeros are sent in the long run.
    ///
    /// ```text
    ///           .----------.         .--------.
    /// data ====>| minimize |==[ ]===>| invert |
    ///           | edges    |         | or not |==>|\
    ///           '----------'         '--------'   | |==[ ]==> symbol
    ///                                  ^      |   | |
    ///                            [ disparity ]<   | |
    /// control ================[ ]=== codes ======>|/
    /// active -----------------[ ]------------------'
    /// ```
    ///
    /// Latency 2 clocks, a symbol a clock. The disparity is how many more ones than zeros were sent since the last
    /// symbol of `control`. It decides which bytes are inverted.
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&TmdsEncoder)?;
    /// sim.reset();
    /// let pixel = |data| TmdsEncoderIn { active: 1, data, control: 0 };
    /// let symbols: Vec<u64> = sim.stream([pixel(0x10); 5]).into_iter().map(|out| out.symbol).collect();
    /// assert_eq!(symbols[2..], [0b01_1111_0000, 0b01_1111_0000, 0b01_1111_0000]); // balanced each
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct TmdsEncoder;
    latency = "2 clocks";
    in TmdsEncoderIn {
        /// High while a pixel is shown; otherwise `control` is sent.
        active: bit(),
        /// The byte of a pixel.
        data: bits(8),
        /// The control bits outside the picture. In the blue channel, the vertical sync is above the horizontal one.
        control: bits(2),
    }
    out TmdsEncoderOut {
        /// The symbol; the lowest bit is transmitted first.
        symbol: bits(10),
    }
}

impl TmdsEncoder {
    fn build(&self, m: Module, i: TmdsEncoderIn) -> TmdsEncoderOut {
        def!(ones = count_ones(i.data));
        def!(by_xor = ones.lt(4) | (ones.eq(4) & i.data.bit(0)));
        let mut minimized = vec![i.data.bit(0)];
        for place in 1..8 {
            let combined = minimized[place - 1] ^ i.data.bit(place) ^ !by_xor;
            minimized.push(combined.named(&format!("minimized{place}")));
        }
        minimized.reverse();
        let word = concat(&minimized);
        def!(stage = m.pipe(Minimized { active: i.active, control: i.control, word, by_xor }));

        // Halves of how many more ones than zeros there are: a byte or a symbol always has an even number more.
        def!(disparity = m.reg(bits(4).signed()).reset(0));
        def!(excess = count_ones(stage.word).signed() - 4);
        def!(same_sign = !(disparity.is_negative() ^ excess.is_negative()));
        def!(inverts = mux(disparity.eq(0) | excess.eq(0), !stage.by_xor, same_sign));
        def!(of_byte = mux(inverts, -excess, excess));
        let [both, none] = [inverts & stage.by_xor, !inverts & !stage.by_xor];
        def!(of_symbol = select([(both, of_byte + 1), (none, of_byte - 1)], of_byte));
        disparity.next(mux(stage.active, disparity + of_symbol, 0));
        m.assert(disparity.ge(-4) & disparity.le(4), "at most 8 more bits of a kind than of the other were sent");

        let pixel = cat![inverts, stage.by_xor, stage.word ^ inverts.repeat(8)];
        let control = (0..).zip(CONTROL.map(binary));
        def!(symbol = m.pipe(case(cat![stage.active, stage.control], control, pixel)));
        TmdsEncoderOut { symbol }
    }
}
