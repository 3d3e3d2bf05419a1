//! One-hot codes and priorities: as functions of signals, and as blocks.

use tilewright_hdl::{Integer, Module, Signal, below, bit, bits, block, concat, lit};

/// Isolates the first high bit, from the least significant on; the result is 0 if no bit is high.
///
/// ```
/// # use tilewright_blocks::first;
/// # use tilewright_hdl::*;
/// # bundle! {
/// #     /// In.
/// #     pub struct FirstIn<T> { pub requests: T }
/// #     /// Out.
/// #     pub struct FirstOut<T> { pub grant: T }
/// # }
/// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// # struct First;
/// # impl Block for First {
/// #     type In = FirstIn;
/// #     type Out = FirstOut;
/// #     fn inputs(&self) -> FirstIn<Width> { FirstIn { requests: bits(6) } }
/// #     fn build(&self, _: Module, i: FirstIn) -> FirstOut {
/// let grant = first(i.requests); // 000100 of 101100
/// #         FirstOut { grant }
/// #     }
/// # }
/// # let mut sim = tilewright_sim::Simulation::of(&First)?;
/// # sim.set(sim.i.requests, 0b101100);
/// # assert_eq!(sim.get(sim.o.grant), 0b000100);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[track_caller]
pub fn first(requests: Signal) -> Signal {
    requests & (!requests + 1)
}

/// The index of the first high bit, or 0 if there is none: a priority encoder.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::first_index;
/// # tilewright_sim::example(|m| {
/// m.assert(first_index(lit(6, 0b101100)).eq(2), "3 bits, as 6 places need");
/// m.assert(first_index(lit(6, 0)).eq(0), "so check `.any_one()`, too");
/// # });
/// ```
#[track_caller]
pub fn first_index(requests: Signal) -> Signal {
    index_of(first(requests))
}

/// The index of the one high bit, or 0 if there is none. If several are high, the result has no meaning.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::index_of;
/// # tilewright_sim::example(|m| {
/// m.assert(index_of(lit(6, 0b001000)).eq(3), "cheaper than `first_index`, because it does not search");
/// # });
/// ```
#[track_caller]
pub fn index_of(one_hot: Signal) -> Signal {
    let places = 0..one_hot.width();
    let mut digits = Vec::new();
    for digit in (0..below(one_hot.width()).bits()).rev() {
        let high: Vec<Signal> =
            places.clone().filter(|place| place >> digit & 1 == 1).map(|place| one_hot.bit(place)).collect();
        digits.push(if high.is_empty() { lit(1, 0) } else { concat(&high).any_one() });
    }
    concat(&digits)
}

/// A word of `bits` bits in which the bit at place `index` is high: a decoder. If `index` is out of range, no bit is
/// high.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::{index_of, one_hot};
/// # tilewright_sim::example(|m| {
/// m.assert(one_hot(lit(3, 2), 6).eq(0b000100), "6 bits");
/// m.assert(one_hot(lit(3, 7), 6).eq(0), "there is no place 7");
/// m.assert(index_of(one_hot(lit(3, 5), 6)).eq(5), "there and back");
/// # });
/// ```
#[track_caller]
pub fn one_hot(index: Signal, count: impl Integer) -> Signal {
    let width = index.width();
    let mut places = Vec::new();
    for place in (0..count.integer()).rev() {
        let can_be = width >= 64 || place >> width == 0;
        places.push(if can_be { index.eq(place) } else { lit(1, 0) });
    }
    concat(&places)
}

block! {
    /// A decoder: sets the line whose number is the input.
    ///
    /// ```text
    ///            .---.---> bit 0
    /// index ====>| = |---> bit 1
    ///            '---'---> bit 2 ..
    /// ```
    ///
    /// Latency 0 clocks. As a function it is [`one_hot`].
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&Decoder::new(6))?;
    /// sim.drive(DecoderIn { index: 2 });
    /// assert_eq!(sim.read_u64(), DecoderOut { one_hot: 0b000100 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct Decoder {
        lines: u32,
    }
    in(self) DecoderIn {
        /// The number of a line.
        index: below(self.lines),
    }
    out(self) DecoderOut {
        /// A bit for each line, line 0 the lowest; no bit is high for a number without a line.
        one_hot: bits(self.lines),
    }
}

impl Decoder {
    /// A decoder with `lines` lines.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Decoder;
    ///
    /// assert_eq!(Decoder::new(6).inputs().index.bits(), 3);
    /// ```
    ///
    /// # Panics
    ///
    /// `lines` is below 2, so there is nothing to choose.
    #[track_caller]
    pub fn new(lines: u32) -> Decoder {
        check("a decoder", lines);
        Decoder { lines }
    }

    fn build(&self, m: Module, i: DecoderIn) -> DecoderOut {
        let one_hot = one_hot(i.index, self.lines);
        m.assert(first(one_hot).eq(one_hot), "at most one line is high");
        DecoderOut { one_hot }
    }
}

block! {
    /// An encoder: gives the number of the one line that is high.
    ///
    /// ```text
    /// bit 0 ----.----.
    /// bit 1 --->| or |====> index
    /// bit 2 --->'----'
    /// ```
    ///
    /// Latency 0 clocks. As a function it is [`index_of`].
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&Encoder::new(6))?;
    /// sim.drive(EncoderIn { one_hot: 0b001000 });
    /// assert_eq!(sim.read_u64(), EncoderOut { index: 3 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct Encoder {
        lines: u32,
    }
    in(self) EncoderIn {
        /// A bit for each line, line 0 the lowest; at most one line is high.
        one_hot: bits(self.lines),
    }
    out(self) EncoderOut {
        /// The number of the line that is high, or 0 if none is.
        index: below(self.lines),
    }
}

impl Encoder {
    /// An encoder with `lines` lines.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Encoder;
    ///
    /// assert_eq!(Encoder::new(6).name(), "encoder_lines6");
    /// ```
    ///
    /// # Panics
    ///
    /// `lines` is below 2, so there is nothing to distinguish.
    #[track_caller]
    pub fn new(lines: u32) -> Encoder {
        check("an encoder", lines);
        Encoder { lines }
    }

    fn build(&self, m: Module, i: EncoderIn) -> EncoderOut {
        m.assume(first(i.one_hot).eq(i.one_hot), "at most one line is high");
        EncoderOut { index: index_of(i.one_hot) }
    }
}

block! {
    /// A priority encoder: finds the first line that is high, from the lowest on.
    ///
    /// ```text
    ///                .-------.            .----.
    /// requests =====>| first |=====+=====>| or |====> index
    ///             |  '-------'     |      '----'
    ///             |                '================> first
    ///             '--[ or ]-------------------------> any
    /// ```
    ///
    /// Latency 0 clocks. As functions these are [`first`] and [`first_index`].
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&PriorityEncoder::new(6))?;
    /// sim.drive(PriorityEncoderIn { requests: 0b101100 });
    /// assert_eq!(sim.read_u64(), PriorityEncoderOut { first: 0b000100, index: 2, any: 1 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct PriorityEncoder {
        lines: u32,
    }
    in(self) PriorityEncoderIn {
        /// A bit for each line, line 0 the lowest.
        requests: bits(self.lines),
    }
    out(self) PriorityEncoderOut {
        /// Only the first line that is high.
        first: bits(self.lines),
        /// The number of the first line that is high, or 0 if none is.
        index: below(self.lines),
        /// At least one line is high.
        any: bit(),
    }
}

impl PriorityEncoder {
    /// A priority encoder with `lines` lines.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::PriorityEncoder;
    ///
    /// assert_eq!(PriorityEncoder::new(6).name(), "priority_encoder_lines6");
    /// ```
    ///
    /// # Panics
    ///
    /// `lines` is below 2, so there is nothing to distinguish.
    #[track_caller]
    pub fn new(lines: u32) -> PriorityEncoder {
        check("a priority encoder", lines);
        PriorityEncoder { lines }
    }

    fn build(&self, m: Module, i: PriorityEncoderIn) -> PriorityEncoderOut {
        let first = first(i.requests);
        m.assert(i.requests.any_one().implies((first & i.requests).any_one()), "the first line is one that is high");
        PriorityEncoderOut { first, index: index_of(first), any: i.requests.any_one() }
    }
}

/// Panics unless the block has enough lines.
#[track_caller]
fn check(what: &str, lines: u32) {
    assert!(lines > 1, "{what} of {lines} lines: it has 2 or more");
}
