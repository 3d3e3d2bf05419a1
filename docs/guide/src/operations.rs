//! Chapter 3: operations that change a width, each stated.

#[cfg(test)]
mod tests {
    use tilewright_hdl::*;

    #[test]
    fn widths_change_where_it_is_said() {
        tilewright_sim::example(|m| {
            let word = lit(8, 0xa5);
            m.assert(word.zext(12).eq(hex(0x0a5)), "zeros in front");
            m.assert(word.sext(12).eq(hex(0xfa5)), "copies of the top bit in front");
            m.assert(word.trunc(4).eq(hex(0x5)), "the low bits");
            m.assert(word.slice(2..6).eq(binary(0b1001)), "bits 2 to 5, as in Rust");
            m.assert(word.part(4, 4).eq(hex(0xa)), "4 bits from bit 4 on");
            m.assert(word.bit(2).eq(1) & word.msb().eq(1), "one bit");
            m.assert(cat![word, lit(4, 7)].eq(hex(0xa57)), "side by side, the first on top");
            m.assert(lit(2, 0b10).repeat(3).eq(binary(0b101010)), "several times");
            m.assert((word + 100).eq(9), "a sum has the width of its operands and wraps: 265 - 256");
            m.assert(word.add_carry(100).eq(265), "one bit more, so nothing is lost");
            m.assert((word * 100).eq(16500), "a product has the bits of both: 8 + 7");
            m.assert((lit(4, 3) + word.low()).eq(8), "as many low bits as what they meet has");
        });
    }
}
