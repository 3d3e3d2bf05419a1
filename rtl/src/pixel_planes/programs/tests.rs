//! The instructions of a primitive, and its edges at the limits of the contract.

use proptest::prelude::*;

use super::super::testing::{Primitive, at, spheres, value};
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
fn a_sphere_is_its_test_and_the_steps_of_a_program_with_curves_where_they_bend() {
    let inside = Quadratic { a: 6, b: 8, c: -16, d: -1, e: 0, f: -1 };
    let (plane, bent) = (Quadratic::from(edge(1, 2, 3)), Quadratic { e: 5, ..edge(1, 2, 3).into() });
    let drawn = |program: &Program, inside: &Quadratic, z, green| {
        names(&program.draw_sphere(8, inside, &Surface { z, rgb: [plane, green, plane] }))
    };
    assert_eq!(drawn(&FLAT, &inside, bent, plane), ["Curve", "TestFirst", "Flag", "FillFlagged"]);
    assert_eq!(
        drawn(&FLAT_LEAST, &inside, bent, plane),
        ["Curve", "TestFirst", "CompareConstant", "Curve", "CompareOn", "CopyFlagged", "FillFlagged"]
    );
    assert_eq!(
        drawn(&SMOOTH_STRICT, &inside, plane, bent),
        [
            "Curve",
            "TestFirst",
            "Compare",
            "EvaluateFlagged",
            "Curve",
            "EvaluateFlagged",
            "EvaluateFlagged",
            "CopyFlagged"
        ]
    );
    // The whole region is inside; the whole region is outside; the inside is a half-plane.
    assert_eq!(drawn(&FLAT, &Quadratic { c: 90, ..inside }, plane, plane), ["Enable", "Flag", "FillFlagged"]);
    assert_eq!(drawn(&FLAT, &Quadratic { c: -26, ..inside }, plane, plane), [""; 0]);
    assert_eq!(drawn(&FLAT, &edge(1, 0, -3).into(), plane, plane), ["TestFirst", "Flag", "FillFlagged"]);
    let curve = FLAT.draw_sphere(8, &inside, &Surface::of_one_colour(plane, 0))[0];
    assert_eq!(curve.coefficients, Coefficients { a: (1 << 40) - 1, b: 0, c: (1 << 40) - 1 });
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
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// The range is that of all pixels, and the bit tested is the sign.
    #[test]
    fn a_quadratic_has_its_range_and_its_sign_in_a_region(
        (side, sphere) in prop::sample::select(vec![2, 4, 8, 16, 32]).prop_flat_map(|side| (Just(side), spheres(side))),
    ) {
        let inside = sphere.inside;
        let pixels: Vec<(u32, u32)> = (0..side).flat_map(|y| (0..side).map(move |x| (x, y))).collect();
        let values = pixels.iter().map(|(x, y)| value(&inside, *x, *y));
        let range = [values.clone().min().unwrap(), values.max().unwrap()];
        prop_assert_eq!(inside.range(side).map(i128::from), range);
        let program = FLAT.draw_sphere(side, &inside, &Surface::of_one_colour(inside, 0));
        let test = program.iter().find(|it| it.operation == Operation::TestFirst.code());
        prop_assert_eq!(test.map_or(0, |test| test.skip as u32 + 1), inside.bits(side));
        prop_assert_eq!(program.is_empty(), range[1] < 0);
        // One bit fewer would not do, except for the trees' minimum.
        let fits = |bits: u32| range.iter().all(|value| (-(1 << (bits - 1))..1 << (bits - 1)).contains(value));
        if let Some(test) = test {
            let bits = test.skip as u32 + 1;
            let levels = side.trailing_zeros();
            prop_assert!(fits(bits) && bits >= levels && (bits == levels || !fits(bits - 1)), "{} bits", bits);
        }
    }

    #[test]
    fn a_quadratic_is_the_same_wherever_it_is_moved(
        coefficients in prop::array::uniform6(-(1i64 << 40)..1 << 40),
        [x0, y0] in prop::array::uniform2(-4096..4096i64),
        [x, y] in prop::array::uniform2(0..256u32),
    ) {
        let [a, b, c, d, e, f] = coefficients;
        let any = Quadratic { a, b, c, d, e, f };
        let moved = any.moved([-x0, -y0]).moved([x0 + i64::from(x), y0]).moved([0, y.into()]);
        prop_assert_eq!(i128::from(moved.c), value(&any, x, y));
        prop_assert_eq!(i128::from(any.at(x.into(), y.into())), value(&any, x, y));
        prop_assert_eq!(any.moved([x0, y0]).moved([-x0, -y0]), any);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// In all forms the bit tested is the sign of the edge, at every pixel, for triangles anywhere in the guard band.
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
