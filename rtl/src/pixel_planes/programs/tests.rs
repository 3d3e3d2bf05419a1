//! What a primitive is made of, and its edges at the limits of the contract.

use proptest::prelude::*;

use super::super::testing::{Primitive, at};
use super::edges::range;
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
    let surface = Surface::of_one_colour(inside, 0);
    for form in Edges::ALL {
        let drawn = |program: &Program, edges: &[Expression]| names(&program.draw(8, form, edges, &surface));
        assert_eq!(drawn(&FLAT, &[inside, left, upper]), ["TestFirst", "TestLast", "FillFlagged"]);
        assert_eq!(drawn(&FLAT, &[left]), ["TestFirst", "Flag", "FillFlagged"]);
        assert_eq!(drawn(&FLAT, &[inside]), ["Enable", "Flag", "FillFlagged"]);
        assert_eq!(drawn(&FLAT, &[left, beyond]), [""; 0]);
        assert_eq!(
            drawn(&FLAT_LEAST, &[left, upper]),
            ["TestFirst", "Test", "CompareConstant", "CompareOn", "CopyFlagged", "FillFlagged"]
        );
        assert_eq!([inside, beyond, left].map(|edge| form.bits(8, &edge) > 0), [false, false, true]);
    }
}

#[test]
fn all_programs_have_the_edges_first_and_take_the_tree_alone_for_them() {
    let surface = Surface { z: edge(1, 2, 3), rgb: [edge(4, 5, 6); 3] };
    for program in Program::PRIMITIVES {
        for edges in [&[][..], &[edge(1, 0, -3)]] {
            let first = program.draw(8, Edges::Least, edges, &surface)[0].operation;
            let code = Operation::ALL[first as usize].microcode();
            assert_eq!([code.on_tree, code.on_memory], [1, 0], "{}", program.name);
        }
    }
}

#[test]
fn one_colour_is_that_of_planes_without_a_slope() {
    for rgb in [0, 0x12_34_56, 0xff_ff_ff, 0x80_00_7f] {
        assert_eq!(Surface::of_one_colour(edge(0, 0, 0), rgb).colour(), rgb);
    }
}

#[test]
fn a_sign_has_as_many_bits_as_the_values_in_the_region() {
    let bits = |side, edge| Edges::ALL.map(|form| form.bits(side, &edge));
    // -16384 to 16128, and one more.
    assert_eq!(bits(128, edge(128, 128, -16384)), [25, 15, 8]);
    assert_eq!(bits(128, edge(128, 128, -16385)), [25, 16, 9]);
    // As many as the trees have levels.
    assert_eq!([bits(8, edge(0, 1, -1)), bits(256, edge(0, 1, -1))], [[21, 4, 4], [26, 9, 9]]);
    // At the limits of the contract (facts E3).
    assert_eq!(bits(128, edge(65_535, 65_535, -127 * 65_535)), [25, 24, 8]);
    assert_eq!(bits(128, edge(65_535, 65_535, -1)), [25, 25, 9]);
    assert_eq!(bits(128, edge(-64, 65, 0)), [25, 15, 15]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// In all forms the bit that is looked at is the sign of the edge, at every pixel, of triangles anywhere in the guard band.
    #[test]
    fn the_sign_does_not_wrap(primitive in super::super::testing::primitives(128)) {
        const SIDE: u32 = 128;
        let Primitive { edges, .. } = primitive;
        for (edge, form) in edges.iter().flat_map(|edge| Edges::ALL.map(|form| (edge, form))) {
            let [least, greatest] = range(SIDE, edge);
            let Some(program) = form.tests(SIDE, std::slice::from_ref(edge)) else {
                prop_assert!(greatest < 0);
                continue;
            };
            prop_assert!(greatest >= 0);
            let test = &program[0];
            let Coefficients { a, b, c } = test.coefficients;
            let [a, b, c] = [a, b, c].map(|number| (number << 24) as i64 >> 24);
            let sent = Coefficients { a, b, c };
            for (x, y) in (0..SIDE).step_by(31).flat_map(|y| [0, 1, 63, SIDE - 1].map(|x| (x, y))).chain([(0, SIDE - 1), (SIDE - 1, SIDE - 1)]) {
                let value = at(edge, x, y);
                prop_assert!((least..=greatest).contains(&value));
                let is_inside = match Operation::ALL[test.operation as usize] {
                    Operation::Enable => true,
                    _ => at(&sent, x, y) >> test.skip & 1 == 0,
                };
                let most = if form == Edges::Least { 15 } else { 25 };
                prop_assert!(test.skip < most);
                prop_assert_eq!(is_inside, value >= 0, "{:?}", form);
            }
        }
    }
}
