//! Every operator at every width against big integers.

use crate::circuits::engine::of;
use num_bigint::BigUint;
use proptest::prelude::*;
use tilewright_hdl::{Bits, Module, bits, block, case, mux, select};

block! {
    /// All operators on two operands of `width` bits.
    struct Operators { width: u32 }
    in(self) Operands { a: bits(self.width), b: bits(self.width), by: bits(10) }
    out Results {
        sum: _, difference: _, product: _, product_signed: _, product_mixed: _, both_set: _, any_set: _, differ: _,
        inverse: _, lt: _, le: _, gt: _, ge: _, eq: _, ne: _, lt_signed: _, ge_signed: _, left: _, right: _,
        right_signed: _, slice: _, both: _, twice: _, zext: _, sext: _, all_ones: _, any_one: _, parity: _, mux: _,
        select: _, chosen: _, zero_swapped: _,
    }
}

impl Operators {
    fn build(&self, _: Module, Operands { a, b, by }: Operands) -> Results {
        let w = self.width;
        Results {
            sum: a + b,
            difference: a - b,
            product: a.times(b),
            product_signed: (a.signed() * b.signed()).bits(),
            product_mixed: (by.signed() * a.signed()).bits(),
            both_set: a & b,
            any_set: a | b,
            differ: a ^ b,
            inverse: !a,
            lt: a.lt(b),
            le: a.le(b),
            gt: a.gt(b),
            ge: a.ge(b),
            eq: a.eq(b),
            ne: a.ne(b),
            lt_signed: a.signed().lt(b.signed()),
            ge_signed: a.signed().ge(b.signed()),
            left: a << by,
            right: a >> by,
            right_signed: (a.signed() >> by).bits(),
            slice: a.slice(w / 3..w),
            both: tilewright_hdl::cat![a, by, b],
            twice: a.repeat(2),
            zext: a.zext(w + 70),
            sext: a.sext(w + 70),
            all_ones: a.all_ones(),
            any_one: a.any_one(),
            parity: a.parity(),
            mux: mux(by.bit(0), a, b),
            chosen: case(by.slice(0..2), [(1, a), (2, b)], !a),
            zero_swapped: case(a, [(0, b)], a),
            select: select([(by.bit(1), a), (by.bit(2), b)], a ^ b),
        }
    }
}

fn number(bits: &Bits) -> BigUint {
    let digits: Vec<u32> = bits.limbs().iter().flat_map(|limb| [*limb as u32, (limb >> 32) as u32]).collect();
    BigUint::new(digits)
}

/// The width and two values of it, with a preference for the corners.
fn operands() -> impl Strategy<Value = (u32, Bits, Bits, u32)> {
    let width = prop_oneof![1..=70u32, Just(63), Just(64), Just(65), Just(127), Just(128), Just(129), 70..=400u32];
    width.prop_flat_map(|width| {
        let value = prop_oneof![
            3 => prop::collection::vec(any::<u64>(), 7).prop_map(move |limbs| Bits::from_limbs(width, &limbs)),
            1 => Just(Bits::zero(width)),
            1 => Just(Bits::ones(width)),
            1 => Just(Bits::zero(width).not().slice(0..1).resize(width)),
        ];
        (Just(width), value.clone(), value, prop_oneof![0..=width, 0..1024u32])
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn operators_agree_with_big_integers((width, a, b, by) in operands()) {
        let mut sim = of(&Operators { width });
        sim.drive_bits(Operands { a: a.clone(), b: b.clone(), by: Bits::new(10, by.into()) });
        let got = sim.read();
        let (x, y) = (number(&a), number(&b));
        let one = BigUint::from(1u8);
        let modulus = &one << width;
        let wide = &one << (2 * width);
        // Two's complement: the value minus `2 ^ width` if the sign is set, kept positive modulo a larger power.
        let extend = |x: &BigUint, to: u32| if x.bit(u64::from(width) - 1) { x + (&one << to) - &modulus } else { x.clone() };
        let order = |x: &BigUint| (x + (&one << (width - 1))) % &modulus;
        let kept = by.min(width);
        let expect = |name: &str, got: &Bits, expected: BigUint| {
            prop_assert_eq!(number(got), expected, "{} of {} and {} by {}", name, a, b, by);
            Ok(())
        };
        let flag = |value: bool| BigUint::from(u8::from(value));
        expect("sum", &got.sum, (&x + &y) % &modulus)?;
        expect("difference", &got.difference, (&x + &modulus - &y) % &modulus)?;
        expect("product", &got.product, &x * &y)?;
        expect("product_signed", &got.product_signed, extend(&x, 2 * width) * extend(&y, 2 * width) % &wide)?;
        let mixed = &one << (width + 10);
        let amount = BigUint::from(by) + if by >= 512 { &mixed - (&one << 10) } else { BigUint::ZERO };
        expect("product_mixed", &got.product_mixed, extend(&x, width + 10) * amount % &mixed)?;
        expect("and", &got.both_set, &x & &y)?;
        expect("or", &got.any_set, &x | &y)?;
        expect("xor", &got.differ, &x ^ &y)?;
        expect("not", &got.inverse, &modulus - &one - &x)?;
        expect("lt", &got.lt, flag(x < y))?;
        expect("le", &got.le, flag(x <= y))?;
        expect("gt", &got.gt, flag(x > y))?;
        expect("ge", &got.ge, flag(x >= y))?;
        expect("eq", &got.eq, flag(x == y))?;
        expect("ne", &got.ne, flag(x != y))?;
        expect("lt_signed", &got.lt_signed, flag(order(&x) < order(&y)))?;
        expect("ge_signed", &got.ge_signed, flag(order(&x) >= order(&y)))?;
        expect("left", &got.left, (&x << by) % &modulus)?;
        expect("right", &got.right, &x >> by)?;
        expect("right_signed", &got.right_signed, (extend(&x, 2 * width) >> kept) % &modulus)?;
        expect("slice", &got.slice, &x >> (width / 3))?;
        expect("both", &got.both, (&x << (width + 10)) + (BigUint::from(by) << width) + &y)?;
        expect("twice", &got.twice, (&x << width) + &x)?;
        expect("zext", &got.zext, x.clone())?;
        expect("sext", &got.sext, extend(&x, width + 70))?;
        expect("all_ones", &got.all_ones, flag(x == &modulus - &one))?;
        expect("any_one", &got.any_one, flag(x != BigUint::ZERO))?;
        expect("parity", &got.parity, flag(x.count_ones() % 2 == 1))?;
        expect("chosen", &got.chosen, match by % 4 { 1 => x.clone(), 2 => y.clone(), _ => &modulus - &one - &x })?;
        expect("zero_swapped", &got.zero_swapped, if x == BigUint::ZERO { y.clone() } else { x.clone() })?;
        expect("mux", &got.mux, if by & 1 == 1 { x.clone() } else { y.clone() })?;
        expect("select", &got.select, if by & 2 == 2 { x.clone() } else if by & 4 == 4 { y.clone() } else { &x ^ &y })?;
    }
}
