//! What a primitive is made of, and its edges at the limits of the contract.

use proptest::prelude::*;

use super::super::testing::{Primitive, at};
use super::*;

fn names(program: &[Instruction<u64>]) -> Vec<&'static str> {
    program.iter().map(|instruction| Operation::ALL[instruction.operation as usize].name()).collect()
}

fn edge(a: i64, b: i64, c: i64) -> Expression {
    Coefficients { a, b, c }
}

#[test]
fn edges_that_do_not_cross_the_region_are_left_out_and_so_is_what_is_beyond_one() {
    let (inside, beyond) = (edge(1, 0, 0), edge(1, 1, -15));
    let (left, upper) = (edge(1, 0, -3), edge(0, 1, -3));
    assert_eq!(names(&flat(8, &[inside, left, upper], 0)), ["TestFirst", "TestLast", "FillFlagged"]);
    assert_eq!(names(&flat(8, &[left], 0)), ["TestFirst", "Flag", "FillFlagged"]);
    assert_eq!(names(&flat(8, &[inside], 0)), ["Enable", "Flag", "FillFlagged"]);
    assert_eq!(names(&flat(8, &[left, beyond], 0)), [""; 0]);
    assert_eq!(
        names(&flat_least(8, &[left, upper], &inside, 0)),
        ["TestFirst", "CompareConstant", "Test", "CompareOn", "CopyFlagged", "FillFlagged"]
    );
}

#[test]
fn a_sign_has_as_many_bits_as_the_values_in_the_region() {
    let bits = |side, edge| {
        let [ref test, ..] = flat(side, &[edge], 0)[..] else { unreachable!("it crosses") };
        test.skip + test.length
    };
    // -16384 to 16128, and one more.
    assert_eq!(bits(128, edge(128, 128, -16384)), 15);
    assert_eq!(bits(128, edge(128, 128, -16385)), 16);
    // As many as the trees have levels.
    assert_eq!([bits(8, edge(0, 1, -1)), bits(256, edge(0, 1, -1))], [4, 9]);
    // At the limits of the contract (facts E3).
    assert_eq!(bits(128, edge(65_535, 65_535, -127 * 65_535)), 24);
    assert_eq!(bits(128, edge(65_535, 65_535, -1)), 25);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// The bit that is looked at is the sign, at every pixel, of triangles anywhere in the guard band.
    #[test]
    fn the_sign_does_not_wrap(primitive in super::super::testing::primitives(128)) {
        const SIDE: u32 = 128;
        let Primitive { edges, .. } = primitive;
        for edge in &edges {
            let [least, greatest] = range(SIDE, edge);
            let Some(program) = tests(SIDE, std::slice::from_ref(edge)) else {
                prop_assert!(greatest < 0);
                continue;
            };
            prop_assert!(greatest >= 0);
            for (x, y) in (0..SIDE).step_by(31).flat_map(|y| [0, 1, 63, SIDE - 1].map(|x| (x, y))).chain([(0, SIDE - 1), (SIDE - 1, SIDE - 1)]) {
                let value = at(edge, x, y);
                prop_assert!((least..=greatest).contains(&value));
                let is_inside = match Operation::ALL[program[0].operation as usize] {
                    Operation::Enable => true,
                    _ => value >> program[0].skip & 1 == 0,
                };
                prop_assert!(program[0].skip < 25);
                prop_assert_eq!(is_inside, value >= 0);
            }
        }
    }
}
