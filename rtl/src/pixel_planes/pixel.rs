//! The pixel processor: a full adder of one bit, two flags, and 208 bits of memory (PP5-ARCH, facts E3).
//!
//! ```text
//!                              .--[ carry ]<--.
//! expression --.               v              |
//! constant ----+--> operand -->(+)------------+--> result --> [ memory ] write address, where the mask is high
//! word --------'               ^                                  |
//!     ^                        '------- word, where it adds       | read address
//!     '-----------------------------------------------------------'
//!
//! enable: the pixel is inside all edges so far      flag: the new word is less than the stored one
//! ```
//!
//! All processors obey the same control in each clock, each on its own bits. Only their flags make them act differently.
//! A word is processed from its least significant bit up. So when two words are compared, the last bit in which they
//! differ decides.
//!
//! There are two flags, so the result of one primitive can be written where `flag` is set while the edges of the next
//! change `enable`.
//!
//! Latency: 1 clock to memory and flags; one read and one write a clock, each at an address that all processors share.

use crate::prelude::*;

codes! {
    /// The source of the bit that a processor works on.
    pub enum Source {
        /// The linear-expression tree.
        Expression,
        /// The processor's memory, at the read address.
        Memory,
        /// The controller: the same bit for all processors.
        Constant,
    }
}

codes! {
    /// Which processors write their memory.
    pub enum Mask {
        /// None.
        Nobody,
        /// All.
        Everybody,
        /// Those that are enabled.
        Enabled,
        /// Those whose flag is set.
        Flagged,
    }
}

codes! {
    /// The change of the enable flags.
    pub enum Enabling {
        /// The flags keep their values.
        Keep,
        /// All flags are set.
        Set,
        /// All flags are cleared.
        Clear,
        /// A flag is set where the expression's bit, a sign, is 0, and cleared elsewhere.
        Replace,
        /// A flag stays set only where the expression's bit, a sign, is 0.
        Restrict,
    }
}

record! {
    /// The control of all processors in a clock; all zeros mean no action.
    pub struct Control {
        /// Where the operand comes from: a [`Source`].
        source: one_of::<Source>(),
        /// The operand, if it is a constant.
        constant: bit(),
        /// The bit that is read, and the carry, are added to the operand.
        adds: bit(),
        /// The bit is the first of a word: carry and flag restart from 0.
        first: bit(),
        /// Which processors write the result: a [`Mask`].
        mask: one_of::<Mask>(),
        /// The flag is set where the operand's bits so far are less than those in memory.
        compares: bit(),
        /// The comparison sets the flag only where the processor is enabled.
        gates: bit(),
        /// The change of the enable flags: an [`Enabling`].
        enabling: one_of::<Enabling>(),
        /// The flag takes the new value of the enable flag.
        captures: bit(),
        /// The address that is read.
        read: below(PixelProcessor::BITS),
        /// The address that is written.
        write: below(PixelProcessor::BITS),
    }
}

block! {
    /// Processes one bit of a pixel in each clock.
    pub struct PixelProcessor;
    latency = "1 clock to the memory and the flags";
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH)";
    in PixelProcessorIn {
        /// The control of all processors.
        control: Control,
        /// A bit of the expression at this pixel.
        expression: bit(),
    }
    out PixelProcessorOut {
        /// The bit of memory that is read.
        word: bit(),
    }
}

impl PixelProcessor {
    /// The number of bits of memory.
    pub const BITS: u32 = 208;

    fn build(&self, m: Module, i: PixelProcessorIn) -> PixelProcessorOut {
        let c = i.control;
        def!(memory = m.memory(PixelProcessor::BITS, bit(), ReadUnderWrite::Any));
        def!(word = memory.read_async(c.read));
        def! { operand = choose!(c.source, Source {
            Expression => i.expression,
            Memory => word,
            Constant => c.constant,
        }) }

        def!(carry = m.reg(bit()));
        def!(carried = carry & !c.first);
        carry.when(c.adds, (operand & word) | (carried & (operand | word)));
        def!(result = operand ^ (c.adds & (word ^ carried)));

        def!(enable = m.reg(bit()));
        def! { enabled = choose!(c.enabling, Enabling {
            Keep => enable,
            Set => 1,
            Clear => 0,
            Replace => !i.expression,
            Restrict => enable & !i.expression,
        }) }
        enable.next(enabled);

        def!(flag = m.reg(bit()));
        def!(is_less = mux(operand.eq(word), flag & !c.first, word));
        flag.when(c.captures, enabled).when(c.compares, is_less & (enable | !c.gates));

        def! { writes = choose!(c.mask, Mask {
            Nobody => 0,
            Everybody => 1,
            Enabled => enable,
            Flagged => flag,
        }) }
        memory.write(writes, c.write, result);
        PixelProcessorOut { word }
    }
}

#[cfg(test)]
mod tests;
