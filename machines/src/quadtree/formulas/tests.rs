//! The paper's numbers and statements, from the formulas (facts A2, A3, B).

use super::super::stages::Figures;
use super::*;
use proptest::prelude::*;

const M: u32 = 10;
const FORM: f64 = 1.514;

fn matrix(k: u32) -> Rasters {
    Rasters::square(k, M)
}

fn turning(k: u32) -> f64 {
    matrix(k).turning_area(FORM).expect("k is at least 1")
}

/// w_i of the paper's matrix of 2^k x 2^k.
fn windows(k: u32, level: u32, area: f64) -> f64 {
    matrix(k).windows_of(Shape::paper(area), level)
}

fn stages(k: u32, area: f64) -> Stages {
    matrix(k).stages_of(Shape::paper(area), 1.0)
}

fn figures(k: u32, area: f64) -> Figures {
    Figures::of(&matrix(k), &stages(k, area), &stages(0, area))
}

fn slowest(k: u32, area: f64) -> u32 {
    stages(k, area).slowest().expect("there are levels").0
}

/// Areas from 10^-3 to 10^6, 50 a decade.
fn areas() -> impl Iterator<Item = f64> {
    (-150..=300).map(|e| 10_f64.powf(f64::from(e) / 50.0))
}

/// Numbers as the paper, or the facts, print them.
#[track_caller]
fn prints<const N: usize>(values: [f64; N], digits: usize, printed: [&str; N]) {
    assert_eq!(values.map(|value| format!("{value:.digits$}")), printed);
}

/// MPG-EQ4: S_k = 0, 1.8, 23.3, 157, and there w_n = 1.
#[test]
fn areas_where_the_order_of_levels_turns_round() {
    assert_eq!(turning(1), 0.0);
    prints([turning(2), turning(3)], 1, ["1.8", "23.3"]);
    prints([turning(4)], 0, ["157"]);
    assert_eq!(matrix(0).turning_area(FORM), None);
    for k in 1..5 {
        assert!((windows(k, M - k, turning(k)) - 1.0).abs() < 1e-12);
    }
}

/// MPG-F3A: with 2x2 processors windows are as large as their spacing, and levels never have less windows than the one above.
#[test]
fn figure_3_a() {
    assert!((1..=9).all(|level| matrix(1).relative_window(level) == (1.0, 1.0) && windows(1, level, 0.0) == 1.0));
    for area in areas() {
        assert!((1..=9).all(|level| windows(1, level, area) >= 1.0));
        assert!((1..9).all(|level| windows(1, level + 1, area) >= windows(1, level, area)));
    }
}

/// MPG-F3B: with more processors small polygons fall between the windows, the more so the lower the level.
#[test]
fn figure_3_b_to_d() {
    for k in 2..5 {
        let n = M - k;
        assert!((1..n).all(|i| windows(k, i + 1, 0.0) < windows(k, i, 0.0) && windows(k, i, 0.0) < 1.0));
        let large = 20.0 * turning(k);
        assert!((1..n).all(|i| windows(k, i + 1, large) > windows(k, i, large)));
    }
    let turning = [1, 2, 3, 4, 5, 6].map(|level| windows(4, level, 157.0));
    prints(turning, 2, ["1.04", "1.07", "1.13", "1.23", "1.31", "1.00"]);
}

/// MPG-F4: windows are smaller than their spacing, least so on the upper levels.
#[test]
fn figure_4() {
    for k in 2..5 {
        let relative: Vec<f64> = (1..=M - k).map(|level| matrix(k).relative_window(level).0).collect();
        assert!(relative.is_sorted_by(|upper, lower| 1.0 > *upper && upper > lower));
        assert_eq!(relative.last(), Some(&(2.0 / f64::from(1 << k))));
    }
}

/// MPG-F5A: the performance of stacks grows as polygons get smaller, and with the matrix.
#[test]
fn figure_5_a() {
    prints([0, 1, 2, 3, 4].map(|k| figures(k, 1.0).p_s), 3, ["0.050", "0.088", "0.127", "0.169", "0.221"]);
    for k in 0..5 {
        assert!(areas().map(|area| figures(k, area).p_s).is_sorted_by(|small, large| small > large));
        assert!(k == 0 || areas().all(|area| figures(k, area).p_s > figures(k - 1, area).p_s));
    }
}

/// MPG-F5B: efficiency falls with a larger matrix, and with smaller polygons.
#[test]
fn figure_5_b() {
    prints([1, 2, 3].map(|k| figures(k, 100.0).q_a), 2, ["0.73", "0.43", "0.20"]);
    prints([figures(4, 100.0).q_a], 3, ["0.083"]);
    for k in 1..5 {
        assert!(areas().all(|area| figures(k, area).q_a < figures(k - 1, area).q_a));
        assert!(areas().map(|area| figures(k, area).q_a).is_sorted());
    }
}

/// MPG-3Z: the last level limits large polygons, the first small ones, and one in between those of the turning area.
#[test]
fn three_zones_of_figure_6_a() {
    for k in 2..5 {
        let at = [100.0, 1.0, 0.1].map(|times| slowest(k, times * turning(k)));
        assert_eq!((at[0], at[2]), (M - k, 1));
        assert!(1 < at[1] && at[1] < M - k, "{at:?}");
    }
    assert_eq!([100.0, 1.0, 0.1].map(|times| slowest(4, times * turning(4))), [6, 5, 1]);
}

/// MPG-F6A: growth with the matrix is nearly fourfold a step for large polygons only; 141 times of 256 for 1000 pixels.
#[test]
fn growth_of_performance_in_figure_6_a() {
    let growth = |area| [1, 2, 3, 4].map(|k| figures(k, area).p_p / figures(k - 1, area).p_p);
    prints(growth(1000.0), 2, ["3.81", "3.65", "3.39", "3.00"]);
    prints([figures(4, 1000.0).p_p / figures(0, 1000.0).p_p], 0, ["141"]);
    let [first, .., last] = growth(1e5);
    prints([first, last], 2, ["3.98", "3.82"]);
}

/// MPG-PMAX and MPG-CAP: five tests are the least, and w_1 below 1 is worth a little on top.
#[test]
fn greatest_performance_in_figure_6_a() {
    let (root, first) = (4.0, 1.0);
    assert_eq!(MAX_PERFORMANCE, 1.0 / (root + first));
    prints([1, 2, 3, 4].map(|k| figures(k, 0.0).p_p), 3, ["1.000", "1.002", "1.005", "1.011"]);
    for k in 2..5 {
        let small = areas().filter(|area| *area <= turning(k) / 4.0);
        assert!(small.map(|area| figures(k, area).p_p).all(|p_p| (p_p - 1.0).abs() < 0.02));
    }
}

/// MPG-F6B: the greatest loads, 97 to 100 %, at 0.5 to 0.7 S_k, and those at S_k; pipelines of a matrix have more load than one.
#[test]
fn load_in_figure_6_b() {
    let greatest =
        |k| areas().max_by(|a, b| figures(k, *a).r_p.total_cmp(&figures(k, *b).r_p)).expect("there are areas");
    let at = [2, 3, 4].map(greatest);
    prints([at[0]], 2, ["1.26"]);
    prints([at[1], at[2]], 0, ["12", "79"]);
    prints([(2, at[0]), (3, at[1]), (4, at[2])].map(|(k, area)| figures(k, area).r_p), 3, ["0.991", "0.978", "0.968"]);
    assert!((2..5).zip(at).all(|(k, area)| (0.5..=0.7).contains(&(area / turning(k)))), "{at:?}");
    prints([figures(1, 0.0).r_p], 3, ["1.000"]);
    prints([1, 2, 3, 4].map(|k| figures(k, turning(k)).r_p), 2, ["1.00", "0.97", "0.93", "0.91"]);
    assert!((1..5).all(|k| areas().all(|area| figures(k, area).r_p > figures(0, area).r_p)));
}

/// "Load grows with the matrix" holds from a sixth of S_k on, and not of the smallest polygons (MPG-F6B).
#[test]
fn load_grows_with_the_matrix_but_of_small_polygons() {
    let grows = |k, area| figures(k, area).r_p > figures(k - 1, area).r_p;
    assert!(areas().all(|area| grows(1, area)));
    for k in 2..5 {
        assert!(areas().filter(|area| *area > turning(k) / 5.9).all(|area| grows(k, area)), "k = {k}");
        assert!(areas().filter(|area| *area < turning(k) / 100.0).all(|area| !grows(k, area)), "k = {k}");
    }
}

/// MPG-QP: a matrix of pipelines is less efficient than one of stacks.
#[test]
fn efficiency_in_figure_6_b() {
    for k in 0..5 {
        assert!(areas().all(|area| figures(k, area).q_p <= figures(k, area).q_a + 1e-15));
    }
}

/// MPG-TREE: a full tree of processing elements is so many times larger than the matrix of pipelines that is as fast.
#[test]
fn a_full_tree_is_three_orders_larger() {
    assert_eq!(full_tree(M), 1_398_100);
    prints([4, 3, 2].map(|k| full_tree(M) as f64 / matrix(k).stages() as f64), 0, ["910", "3121", "10923"]);
}

fn any_matrix() -> impl Strategy<Value = Rasters> {
    (1..40_u32, 1..40_u32, 1..11_u32, 0..6_u32, 0..6_u32).prop_map(|(p, q, levels, a, b)| {
        let aperture = (a, b);
        Rasters { p, q, levels, aperture }
    })
}

fn any_shape() -> impl Strategy<Value = Shape> {
    (0.0..1e5_f64, 1.0..4.0_f64).prop_map(|(area, form)| Shape { area, form })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// MPG-EQ3 is MPG-EQ1 on the last level, for any matrix.
    #[test]
    fn pixel_windows_are_windows_of_the_last_level(matrix in any_matrix(), shape in any_shape()) {
        let (first, third) = (matrix.windows_of(shape, matrix.levels), matrix.pixel_windows_of(shape));
        prop_assert!((first - third).abs() <= 1e-12 * first.max(1.0), "{} and {}", first, third);
    }

    /// MPG-EQ2 is the size of a window over the spacing of windows (MPG-WIN).
    #[test]
    fn relative_windows_are_windows_over_spacings(matrix in any_matrix(), level in any::<prop::sample::Index>()) {
        let level = 1 + level.index(matrix.levels as usize) as u32;
        let (window, spacing) = (matrix.window(level), matrix.spacing(level));
        let exact = [(window.0, spacing.0), (window.1, spacing.1)].map(|(w, s)| f64::from(w) / f64::from(s));
        let (a, b) = matrix.relative_window(level);
        prop_assert!((a - exact[0]).abs() < 1e-12 && (b - exact[1]).abs() < 1e-12, "{}, {} for {:?}", a, b, exact);
    }

    /// The two sides of MPG-EQ6.
    #[test]
    fn work_is_the_sum_of_the_stages(matrix in any_matrix(), shape in any_shape(), ratio in 0.1..3.0_f64) {
        let (sum, work) = (matrix.stages_of(shape, ratio).total(), matrix.work_of(shape, ratio));
        prop_assert!((sum / work - 1.0).abs() < 1e-12, "{} and {}", sum, work);
    }

    /// MPG-EQ4 is the root of w_n = 1 for matrices that are not square, too.
    #[test]
    fn at_the_turning_area_there_is_one_window(matrix in any_matrix(), form in 1.0..4.0_f64) {
        let windows = |area| matrix.pixel_windows_of(Shape { area, form });
        match matrix.turning_area(form) {
            Some(area) => prop_assert!((windows(area) - 1.0).abs() < 1e-9, "{} windows", windows(area)),
            None => prop_assert!(windows(0.0) > 1.0),
        }
    }
}
