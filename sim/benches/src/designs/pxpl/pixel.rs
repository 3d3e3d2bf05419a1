//! A one-bit processor, with 208 bits of memory.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, choose, codes, def, mux, one_of};

/// Bits of memory.
pub const BITS: u32 = 208;

codes! {
    /// The operation of all processors in a clock; S is the bit of x + y, M the bit that is read.
    pub enum Operation {
        /// Nothing.
        Nothing,
        /// Writes S.
        Store,
        /// Writes the sum of S and M, with a carry.
        Add,
        /// Disables those where S, a sign, is 1.
        KeepPositive,
        /// Enables all.
        Everybody,
        /// Compares S with M.
        Compare,
        /// Disables those where S was not less.
        KeepLess,
        /// Writes M.
        Copy,
    }
}

block! {
    /// One of the processors.
    pub struct Pixel;
    in PixelIn {
        rst: bit(),
        /// It is the first bit of a word.
        first: bit(),
        operation: one_of::<Operation>(),
        /// The address that is read.
        read: bits(8),
        /// The address that is written.
        write: bits(8),
        x: bit(),
        y: bit(),
    }
    out PixelOut {
        /// Its result, or 0 if it is disabled.
        result: bit(),
        enable: bit(),
    }
}

impl Pixel {
    fn build(&self, m: Module, i: PixelIn) -> PixelOut {
        def!(memory = m.memory(BITS, bit(), ReadUnderWrite::Old).fill(Bits::zero(1)));
        let [sum_carry, carry, less, enable] = ["sum_carry", "carry", "less", "enable"].map(|name| m.reg(name, bit()));
        let majority = |a, b, c| (a & b) | (a & c) | (b & c);
        def!(sum_carried = sum_carry & !i.first);
        def!(sum = i.x ^ i.y ^ sum_carried);
        def!(word = memory.read_async(i.read));
        def!(carried = carry & !i.first);
        let is = |operation| i.operation.is(operation);
        def! { value = choose!(i.operation, Operation {
            Add => sum ^ word ^ carried,
            Copy => word,
            _ => sum,
        }) }

        sum_carry.when(i.rst, 0).otherwise(majority(i.x, i.y, sum_carried));
        carry.when(i.rst, 0).when(is(Operation::Add), majority(sum, word, carried));
        let so_far = mux(sum.ne(word), word, less & !i.first);
        less.when(i.rst, 0).when(is(Operation::Compare), so_far);
        enable
            .when(i.rst, 1)
            .when(is(Operation::KeepPositive), enable & !sum)
            .when(is(Operation::Everybody), 1)
            .when(is(Operation::KeepLess), enable & less);
        let writes = is(Operation::Store) | is(Operation::Add) | is(Operation::Copy);
        memory.write(writes & enable & !i.rst, i.write, value);
        def!(result = m.reg(bit()));
        result.when(i.rst, 0).otherwise(value & enable);
        PixelOut { result: *result, enable: *enable }
    }
}
