//! Operations that are combinations of others, compared with Rust's own.

use crate::circuits::engine::of;
use proptest::prelude::*;
use tilewright_hdl::{Module, below, bits, block, lit};

block! {
    /// One of each.
    struct Shorthand;
    in In { a: bits(8), b: bits(8) }
    out Out {
        from: _, scaled: _, signed_scaled: _, left: _, right: _, whole: _, middle: _, follows: _, folded: _, low: _,
        product: _,
    }
}

impl Shorthand {
    fn build(&self, _: Module, i: In) -> Out {
        let mut folded = lit(8, 1);
        folded += i.a;
        folded ^= i.b;
        folded -= 3;
        folded |= i.a;
        folded &= 0x7f;
        Out {
            from: (200u64 - i.a) ^ (1 + i.b) ^ (7u32 & i.a),
            scaled: i.a * 100 + 3 * i.b.zext(13),
            signed_scaled: (i.a.signed() * -3).bits(),
            left: i.a.rotate_left(3),
            right: i.a.rotate_right(11),
            whole: i.a.rotate_left(16) ^ i.b.rotate_right(0),
            middle: i.a.part(2, below(8)),
            follows: i.a.bit(0).implies(i.b.bit(0)),
            folded,
            low: lit(5, 9) ^ i.a.low(),
            product: i.b.trunc(4) * i.a.low(),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn shorthand_is_what_it_stands_for(a: u8, b: u8) {
        let mut sim = of(&Shorthand);
        sim.drive(In { a: a.into(), b: b.into() });
        let folded = (((a.wrapping_add(1) ^ b).wrapping_sub(3)) | a) & 0x7f;
        let wide = |number: u8| u64::from(number);
        let expected = Out {
            from: wide(200u8.wrapping_sub(a) ^ b.wrapping_add(1) ^ (7 & a)),
            scaled: (u64::from(a) * 100 + 3 * u64::from(b)) & 0x7fff,
            signed_scaled: (i64::from(a as i8) * -3) as u64 & 0x7ff,
            left: wide(a.rotate_left(3)),
            right: wide(a.rotate_right(11)),
            whole: wide(a ^ b),
            middle: wide(a >> 2 & 7),
            follows: u64::from(a & 1 == 0 || b & 1 == 1),
            folded: wide(folded),
            low: wide((9 ^ a) & 31),
            product: wide(b & 15) * wide(a & 15),
        };
        prop_assert_eq!(sim.read_u64(), expected);
    }
}
