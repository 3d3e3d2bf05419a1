//! Numbers of any integer type where the language takes one, and on the left of operators.

use tilewright_hdl::*;
use tilewright_sim::{example, traced};

#[test]
fn registers_and_wires_have_integers_on_their_left() {
    example(|m| {
        let counter = m.reg("counter", 4).reset(0);
        counter.next(counter + 1);
        let wire = m.wire("wire", 4);
        wire.drive(counter);
        let signal = *counter;
        let (thrice, less): (Signal, Signal) = (signal * 3, !signal + 10);
        m.assert(thrice.eq(3 * signal) & thrice.eq(3 * counter) & thrice.eq(3u8 * wire), "a factor on either side");
        m.assert(less.eq(9 - signal) & less.eq(9i64 - counter) & less.eq(9usize - wire), "what is taken from");
        m.assert((signal & 6).eq(6u16 & counter) & (signal ^ 6).eq(6i8 ^ wire), "bits");
    });
}

/// Each place for a number, with a 3 of this type.
fn places<N: Integer + Leaf>(m: Module, three: N, name: &str) {
    let word = lit(8, 0b0001_1010);
    m.assert(word.bit(three) & word.part(three, 2).eq(0b11), "a bit");
    m.assert(word.rotate_left(three).eq(0b1101_0000) & word.rotate_right(three).eq(0b0100_0011), "places to turn by");
    m.assert(lit(4, three).eq(3) & lit(bits(three), 7).all_ones(), "a value, and a width");
    m.assert(lit(1, 1).repeat(three).eq(7), "times");
    let row = constants(bits(4).of(4), |_| three);
    m.assert(row.lane(three).eq(3) & row.shifted(three, 9).pack().eq(0x3999), "a lane, and what each has");
    m.assert(case(lit(4, three), [(three, lit(4, 9))], 0).eq(9), "a key");
    let words = m.memory(name, three, 8, ReadUnderWrite::Old).fill(0);
    assert_eq!(words.address_width(), 2, "3 words");
    m.assert(words.read_async(1).eq(0), "a word of them");
}

#[test]
fn one_number_in_every_type() {
    example(|m| {
        places(m, 3, "of_i32");
        places(m, 3u8, "of_u8");
        places(m, 3i8, "of_i8");
        places(m, 3u16, "of_u16");
        places(m, 3u32, "of_u32");
        places(m, 3u64, "of_u64");
        places(m, 3i64, "of_i64");
        places(m, 3i128, "of_i128");
        places(m, 3usize, "of_usize");
        places(m, 3isize, "of_isize");
        m.assert(lit(4, true).eq(1) & constants(bit().of(4), |lane| lane < 3).pack().eq(7), "and a `bool`");
    });
}

#[test]
fn keys_of_what_is_signed_are_signed() {
    let example = traced(|m| {
        let x = m.reg("x", bits(4).signed()).reset(-2);
        x.next(x + 1);
        let chosen: Signal = case(x, [(-1, lit(4, 5)), (0, lit(4, 6))], 0);
        let _ = m.pipe("chosen", chosen);
    });
    assert_eq!(example.values("chosen"), [0, 0, 5, 6, 0]);
}
