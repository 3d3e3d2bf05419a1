//! The pixel processor: 8-bit ALU, accumulator, stack of enable flags, and 256 bytes of memory (PFL-NODE, facts E4).
//!
//! ```text
//! expression --.                               .---------.
//! constant ----+--> operand ------------------>|         |---> result --+--> [ accumulator ]
//!         .----'              .--[ carry ]---->|   ALU   |              |
//! accumulator                 |                |         |--> carry     '--> [ memory ] write address
//!                        begins: 0, 1, kept    |         |                       |
//!                              .- word ------->|         |                       | read address
//!                              |               '---------'                       |
//!                              '-------------------------------------------------'
//!
//! enable stack: the top flag enables the pixel   flag: the result of a word's comparison, or a digit of a multiplier
//! ```
//!
//! All processors execute the same control in each clock, each on its own bytes and flags. A word is processed from its
//! least significant byte on, and the carry connects the bytes. A shift to the right starts at the most significant
//! byte.
//!
//! Combining two words into a third takes two clocks per byte. The first moves a byte into the accumulator. The second
//! combines it with the other word and writes memory. With a constant or an expression, one clock per byte is enough.
//! Addresses 0 to 255 are memory. Addresses 256 to 383 are communication registers. They are outside the processor,
//! because network and texture unit also access them ([`array`](super::array)).
//!
//! The sign of an expression bypasses the ALU on its way to the enable flags. The ALU may do something else in that
//! clock. So edges are tested while the previous primitive is still being written.
//!
//! Latency: 1 clock to memory and flags; one read and one write per clock, at addresses that all processors share.

use crate::prelude::*;

codes! {
    /// The source of the operand.
    pub enum Source {
        /// A byte from the controller, the same for all processors.
        Constant,
        /// The linear evaluator.
        Expression,
        /// The accumulator.
        Accumulator,
        /// The accumulator if the flag is set, otherwise 0: the summand for a digit of a multiplier.
        Multiplicand,
    }
}

codes! {
    /// The function of the ALU. `x` is the operand, `w` the byte read, and `c` the carry in.
    pub enum Function {
        /// `x`; the carry stays.
        Operand,
        /// `w`; the carry stays.
        Word,
        /// `w + x + c`.
        Add,
        /// `w - x`, as `w + (255 - x) + c`; c is 1 unless there is a borrow.
        Subtract,
        /// `x`, with the carry of `w - x`: after a whole word, 1 unless the operand is greater.
        Compare,
        /// Bitwise and; the carry stays.
        And,
        /// Bitwise or; the carry stays.
        Or,
        /// Bitwise exclusive or; the carry stays.
        ExclusiveOr,
        /// `w` shifted to the left; c is shifted in, and the bit shifted out is the carry.
        ShiftLeft,
        /// `w` shifted to the right; c is shifted in, and the bit shifted out is the carry.
        ShiftRight,
        /// `(w + x + c) / 2`, with the sum's carry as the top bit; the bit shifted out is the carry. With a
        /// multiplicand as `x`, this processes a digit of a product.
        AddHalved,
    }
}

codes! {
    /// The carry into a byte.
    pub enum Begin {
        /// The carry of the previous byte.
        Kept,
        /// 0: a sum or a shift begins.
        Zero,
        /// 1: a difference begins.
        One,
    }
}

codes! {
    /// Which processors write.
    pub enum Mask {
        /// No processor.
        Nobody,
        /// All processors.
        Everybody,
        /// The enabled processors.
        Enabled,
        /// The processors whose flag is set.
        Flagged,
    }
}

codes! {
    /// A condition in the current clock.
    pub enum Condition {
        /// The operand's top bit, its sign, is 0.
        Positive,
        /// The carry becomes 1.
        Carry,
        /// The carry becomes 0.
        NoCarry,
    }
}

codes! {
    /// The change of the stack of enable flags.
    pub enum Enabling {
        /// The stack does not change.
        Keep,
        /// The top flag becomes 1.
        Set,
        /// The first edge: the top flag becomes 1 if the condition is true, otherwise 0.
        Replace,
        /// Another edge: the top flag becomes 0 unless the condition is true.
        Restrict,
        /// If: pushes a copy of the top flag if the condition is true, otherwise 0.
        Push,
        /// Else: the top flag becomes 1 if it is 0 and the flag below is 1, otherwise 0.
        Invert,
        /// End if: pops the top flag. The lowest flag does not change.
        Pop,
    }
}

codes! {
    /// The change of the flag.
    pub enum Flagging {
        /// The flag does not change.
        Keep,
        /// The flag becomes the condition.
        Condition,
        /// The flag becomes 1 if the condition is true and the processor is enabled, otherwise 0.
        EnabledCondition,
    }
}

record! {
    /// The control of all processors in a clock; all zeros mean no action.
    pub struct Control {
        /// Where the operand comes from: a [`Source`].
        source: one_of::<Source>(),
        /// The operand, if it is a constant.
        constant: bits(8),
        /// The function of the ALU: a [`Function`].
        function: one_of::<Function>(),
        /// The carry into the byte: a [`Begin`].
        begin: one_of::<Begin>(),
        /// Which processors write: a [`Mask`].
        mask: one_of::<Mask>(),
        /// The result goes to the accumulator.
        accumulates: bit(),
        /// The result goes to memory.
        stores: bit(),
        /// What `enabling` and `flagging` depend on: a [`Condition`].
        condition: one_of::<Condition>(),
        /// The change of the enable flags: an [`Enabling`].
        enabling: one_of::<Enabling>(),
        /// `enabling` depends on the expression's sign instead: the condition is true if its top bit is 0.
        by_sign: bit(),
        /// The change of the flag: a [`Flagging`].
        flagging: one_of::<Flagging>(),
        /// The read address.
        read: below(PixelProcessor::BYTES),
        /// The write address.
        write: below(PixelProcessor::BYTES),
    }
}

block! {
    /// Computes one byte of a pixel in every clock.
    pub struct PixelProcessor {
        /// The depth of the stack of enable flags; at least 2.
        pub depth: u32,
    }
    latency = "1 clock to the memory and the flags";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in PixelProcessorIn {
        /// The control of all processors.
        control: Control,
        /// A byte of the expression at this pixel.
        expression: bits(8),
        /// The communication register at the read address, if that is one of a register.
        register_byte: bits(8),
    }
    out PixelProcessorOut {
        /// The result of the ALU.
        result: bits(8),
        /// The result is written to the communication register at the write address.
        writes_register: bit(),
    }
}

impl PixelProcessor {
    /// The bytes of memory, including the communication registers.
    pub const BYTES: u32 = 384;
    /// The address of the first communication register.
    pub const REGISTERS: u32 = 256;
    /// The depth of the machine's stack of enable flags.
    pub const DEPTH: u32 = 8;

    fn build(&self, m: Module, i: PixelProcessorIn) -> PixelProcessorOut {
        let c = i.control;
        def!(memory = m.memory(PixelProcessor::REGISTERS, bits(8), ReadUnderWrite::Any));
        def!(word = mux(is_register(c.read), i.register_byte, memory.read_async(in_memory(c.read))));
        def!(accumulator = m.reg(bits(8)));
        def!(carry = m.reg(bit()));
        def!(flag = m.reg(bit()));
        def! { operand = choose!(c.source, Source {
            Constant => c.constant,
            Expression => i.expression,
            Accumulator => accumulator,
            Multiplicand => mux(*flag, *accumulator, 0),
        }) }
        def! { carried = choose!(c.begin, Begin {
            Kept => carry,
            Zero => 0,
            One => 1,
        }) }

        // Sum and difference, with the carry of the top bits.
        def!(subtracts = c.function.is(Function::Subtract) | c.function.is(Function::Compare));
        def!(addend = mux(subtracts, !operand, operand));
        def!(sum = word + addend + carried.zext(8));
        def!(carry_out = ((word & addend) | ((word | addend) & !sum)).msb());
        def! { result = choose!(c.function, Function {
            Operand | Compare => operand,
            Word => word,
            Add | Subtract => sum,
            And => word & operand,
            Or => word | operand,
            ExclusiveOr => word ^ operand,
            ShiftLeft => cat![word.slice(0..7), carried],
            ShiftRight => cat![carried, word.slice(1..8)],
            AddHalved => cat![carry_out, sum.slice(1..8)],
        }) }
        def! { carry_next = choose!(c.function, Function {
            Add | Subtract | Compare => carry_out,
            ShiftLeft => word.msb(),
            ShiftRight => word.bit(0),
            AddHalved => sum.bit(0),
            _ => carry,
        }) }
        carry.next(carry_next);

        def! { holds = choose!(c.condition, Condition {
            Positive => !operand.msb(),
            Carry => carry_next,
            NoCarry => !carry_next,
        }) }
        def!(enters = mux(c.by_sign, !i.expression.msb(), holds));
        let stack = m.reg("enable", bits(self.depth));
        let (top, next, rest) = (stack.bit(0), stack.bit(1), stack.slice(1..self.depth));
        def! { enables = choose!(c.enabling, Enabling {
            Keep => stack,
            Set => cat![rest, lit(1, 1)],
            Replace => cat![rest, enters],
            Restrict => cat![rest, top & enters],
            Push => cat![stack.slice(0..self.depth - 1), top & enters],
            Invert => cat![rest, next & !top],
            Pop => cat![stack.msb(), rest],
        }) }
        stack.next(enables);
        flag.next(choose!(c.flagging, Flagging {
            Keep => flag,
            Condition => holds,
            EnabledCondition => holds & top,
        }));

        def! { writes = choose!(c.mask, Mask {
            Nobody => 0,
            Everybody => 1,
            Enabled => top,
            Flagged => flag,
        }) }
        accumulator.when(writes & c.accumulates, result);
        def!(stores = writes & c.stores);
        memory.write(stores & !is_register(c.write), in_memory(c.write), result);
        PixelProcessorOut { result, writes_register: stores & is_register(c.write) }
    }
}

/// Whether the address is that of a communication register.
fn is_register(address: Signal) -> Signal {
    address.msb()
}

fn in_memory(address: Signal) -> Signal {
    address.trunc(below(PixelProcessor::REGISTERS))
}

#[cfg(test)]
mod tests;
