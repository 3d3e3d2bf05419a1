//! The paper's statements about its machine, each with its rule.

use super::found::{Counted, Coupled, Found, Ran};
use super::reasons::{BELOW, BORDER, COARSE, SHORT, SMALL};
use super::{SIZES, TURNING, by_formula, matrix, shape};
use tilewright_machines::quadtree::model::WindowSizes;
use tilewright_machines::quadtree::{Figures, Point, full_tree};
use tilewright_report::{Origin, Rule, Statement, Verdicts};

/// All statements, in the paper's sequence.
pub fn verdicts(Found { counted, window_sizes, ran, coupled, .. }: &Found) -> Verdicts {
    let statements =
        [windows(counted), sizes(window_sizes), stacks(counted), pipelines(counted), as_run(ran), queues(coupled)];
    Verdicts::new("statements", "Statements of the paper, each with its rule").states(statements.into_iter().flatten())
}

fn at_k(k: u32) -> String {
    format!("k = {k}")
}

fn with(what: &str) -> String {
    what.to_owned()
}

impl Counted {
    /// A figure's quantity at an area, for each matrix.
    fn by_matrix(&self, area: f64, of: fn(&Figures) -> f64) -> impl Iterator<Item = (String, f64)> {
        SIZES.map(|k| (at_k(k), of(&self.at(k, area).figures))).into_iter()
    }

    /// A figure's quantity of a matrix, for each area.
    fn by_area(&self, k: u32, of: fn(&Figures) -> f64) -> impl Iterator<Item = (String, f64)> {
        self.of(k).map(move |point| (format!("S = {}", point.sample.area), of(&point.figures)))
    }
}

/// The windows of the levels of a point.
fn by_level(point: &Point) -> impl Iterator<Item = (String, f64)> {
    (1..=point.matrix.levels).map(|level| (format!("level {level}"), point.windows[level as usize].mean))
}

/// Equations 1 to 4, and figure 3.
fn windows(counted: &Counted) -> Vec<Statement> {
    let everywhere = |of: fn(&Point, usize) -> f64| {
        SIZES.into_iter().flat_map(move |k| {
            counted.of(k).flat_map(move |point| {
                let place = move |level: u32| format!("k = {k}, S = {}, level {level}", point.sample.area);
                (1..=point.matrix.levels).map(move |level| (place(level), of(point, level as usize)))
            })
        })
    };
    let turning = |k: u32| matrix(k).turning_area(shape(1.0).form).expect("there is such an area from k = 1 on");
    let mut statements = vec![
        Statement::new(
            "MPG-EQ1",
            "The mean number of windows on each level is at most the area of the filtered polygon.",
            Rule::AtMost,
        )
        .unit("windows")
        .formula(everywhere(|point, level| point.bounds[level]))
        .found(counted.origin(), everywhere(|point, level| point.windows[level].mean))
        .because(BORDER),
        Statement::new("MPG-EQ4", "At an area S_k the last level has one window.", Rule::Within { percent: 1.0 })
            .unit("pixels")
            .paper([2, 3, 4].map(at_k).into_iter().zip(TURNING))
            .found(Origin::Formula, [2, 3, 4].map(|k| (at_k(k), turning(k)))),
        Statement::new("MPG-EQ4", "At S_k one window is counted on the last level.", Rule::Within { percent: 8.0 })
            .unit("windows")
            .paper([1.0])
            .found(
                counted.origin(),
                [2, 3, 4].into_iter().zip(TURNING).map(|(k, area)| {
                    let point = counted.at(k, area);
                    (at_k(k), point.windows[point.matrix.levels as usize].mean)
                }),
            ),
        Statement::new("MPG-F3A", "For k = 1 every level has at least one window, whatever the area.", Rule::AtLeast)
            .unit("windows")
            .paper([1.0])
            .found(
                counted.origin(),
                counted.of(1).flat_map(|point| {
                    by_level(point).map(|(level, windows)| (format!("S = {}, {level}", point.sample.area), windows))
                }),
            ),
    ];
    statements.extend([1.0, 100.0, 1e5].map(|area| {
        let text = format!("For k = 1 no level has fewer windows than the one before: S = {area}.");
        Statement::new("MPG-F3A", text, Rule::NeverDecreases { with: with("the level") })
            .unit("windows")
            .found(counted.origin(), by_level(counted.at(1, area)))
    }));
    statements.extend([(3, 2.0), (4, 10.0)].map(|(k, area)| {
        let text = format!(
            "For k > 1 and areas far below S_k each level has fewer windows than the one before: k = {k}, S = {area}."
        );
        Statement::new("MPG-F3B", text, Rule::Decreases { with: with("the level") })
            .unit("windows")
            .found(counted.origin(), by_level(counted.at(k, area)))
    }));
    statements
}

/// Figure 4.
fn sizes(found: &[WindowSizes]) -> Vec<Statement> {
    let at = |k: u32, level: u32| format!("k = {k}, level {level}");
    let of = |WindowSizes { matrix, hardware, .. }: &WindowSizes| {
        let of_level = |level| (at(matrix.p.ilog2(), level), hardware[level as usize - 1]);
        (1..=matrix.levels).rev().map(of_level).collect::<Vec<_>>()
    };
    let by_formula = |WindowSizes { matrix, .. }: &WindowSizes| {
        let of_level = |level| (at(matrix.p.ilog2(), level), matrix.relative_window(level).0);
        (1..=matrix.levels).rev().map(of_level).collect::<Vec<_>>()
    };
    vec![
        Statement::new("MPG-EQ2", "Relative window sizes are those of equation 2.", Rule::Equals)
            .formula(found.iter().flat_map(by_formula))
            .found(Origin::rtl([]), found.iter().flat_map(of)),
        Statement::new("MPG-F4", "For k > 1 windows are smaller than their spacing.", Rule::AtMost)
            .paper([1.0])
            .found(Origin::rtl([]), found.iter().filter(|it| it.matrix.p > 2).flat_map(of)),
        Statement::new(
            "MPG-F4",
            "Windows come nearer to their spacing from the last level to the first: k = 4.",
            Rule::Increases { with: with("the spacing") },
        )
        .found(Origin::rtl([]), found.iter().filter(|it| it.matrix.p == 16).flat_map(of)),
    ]
}

/// Figure 5.
fn stacks(counted: &Counted) -> Vec<Statement> {
    let origin = || counted.origin();
    let mut statements = vec![
        Statement::new("MPG-F5A", "A larger matrix of stacks is faster: S = 1.", Rule::Increases { with: with("k") })
            .found(origin(), counted.by_matrix(1.0, |it| it.p_s)),
        Statement::new(
            "MPG-F5A",
            "A matrix of stacks is faster with smaller polygons: k = 4.",
            Rule::NeverIncreases { with: with("S") },
        )
        .found(origin(), counted.by_area(4, |it| it.p_s)),
        Statement::new(
            "MPG-F5B",
            "The efficiency of stacks decreases with the size of the matrix: S = 100.",
            Rule::Decreases { with: with("k") },
        )
        .found(origin(), counted.by_matrix(100.0, |it| it.q_a)),
        Statement::new(
            "MPG-F5B",
            "The efficiency of stacks decreases for smaller areas: k = 4.",
            Rule::NeverDecreases { with: with("S") },
        )
        .found(origin(), counted.by_area(4, |it| it.q_a)),
    ];
    statements.push(
        Statement::new(
            "MPG-EQ5",
            "The counted clocks are those of equation 5 with the paper's windows: Q_a at S = 100.",
            Rule::Within { percent: 5.0 },
        )
        .formula(SIZES.map(|k| (at_k(k), by_formula(k, 100.0).q_a)))
        .found(origin(), counted.by_matrix(100.0, |it| it.q_a)),
    );
    statements
}

/// Figure 6.
fn pipelines(counted: &Counted) -> Vec<Statement> {
    let origin = || counted.origin();
    let growth = |area: f64| {
        let mono = counted.at(0, area).figures.p_p;
        SIZES.map(move |k| (at_k(k), counted.at(k, area).figures.p_p / mono))
    };
    let proportional = || SIZES.map(|k| (at_k(k), 4_f64.powi(k as i32)));
    let whole_tree = |k: u32| full_tree(10) as f64 / (matrix(k).levels as f64 * matrix(k).processors() as f64);
    vec![
        Statement::new(
            "MPG-F6A",
            "For large polygons performance grows with the number of processors: S = 100 000.",
            Rule::Within { percent: 10.0 },
        )
        .unit("times one processor")
        .paper(proportional())
        .found(origin(), growth(1e5)),
        Statement::new(
            "MPG-F6A",
            "At S = 1000 performance still grows almost in proportion to the processors.",
            Rule::Within { percent: 10.0 },
        )
        .unit("times one processor")
        .paper(proportional())
        .found(origin(), growth(1e3))
        .because(COARSE),
        Statement::new(
            "MPG-CAP",
            "For small polygons the performance of pipelines is P_max, one polygon in five tests: S = 1.",
            Rule::Within { percent: 2.0 },
        )
        .unit("P_max")
        .paper([1.0])
        .found(origin(), [3, 4].map(|k| (at_k(k), counted.at(k, 1.0).figures.p_p))),
        Statement::new(
            "MPG-3Z",
            "For small polygons the first stage limits a pipeline, for large ones the last: k = 4.",
            Rule::Equals,
        )
        .unit("level")
        .paper([("S = 1", 1.0), ("S = 100000", 6.0)])
        .found(
            origin(),
            [1.0, 1e5].map(|area| {
                let slowest = counted.at(4, area).stages.slowest().map_or(0, |(level, _)| level);
                (format!("S = {area}"), f64::from(slowest))
            }),
        ),
        Statement::new(
            "MPG-F6B",
            "Near S_k the load of the pipelines is greatest, and almost 100 %: at S_k.",
            Rule::Within { percent: 5.0 },
        )
        .paper([1.0])
        .found(origin(), [2, 3, 4].into_iter().zip(TURNING).map(|(k, area)| (at_k(k), counted.at(k, area).figures.r_p)))
        .because(BELOW),
        Statement::new(
            "MPG-F6B",
            "Near S_k the load is almost 100 %: greatest load of all areas.",
            Rule::Within { percent: 5.0 },
        )
        .paper([1.0])
        .found(
            origin(),
            [2, 3, 4].map(|k| (at_k(k), counted.by_area(k, |it| it.r_p).map(|(_, load)| load).fold(0.0, f64::max))),
        ),
        Statement::new("MPG-F6B", "The load grows with the matrix: S = 200.", Rule::Increases { with: with("k") })
            .found(origin(), counted.by_matrix(200.0, |it| it.r_p)),
        Statement::new("MPG-F6B", "The load grows with the matrix: S = 1.", Rule::Increases { with: with("k") })
            .found(origin(), counted.by_matrix(1.0, |it| it.r_p))
            .because(SMALL),
        Statement::new(
            "MPG-F6B",
            "The load of a matrix is above that of one processor, for all areas: k = 4.",
            Rule::AtLeast,
        )
        .unit("times one processor’s")
        .paper([1.0])
        .found(
            origin(),
            counted.of(4).map(|point| {
                let area = point.sample.area;
                (format!("S = {area}"), point.figures.r_p / counted.at(0, area).figures.r_p)
            }),
        ),
        Statement::new("MPG-QP", "Pipelines are less efficient than stacks: k = 4.", Rule::AtMost)
            .unit("times the stacks’")
            .paper([1.0])
            .found(origin(), counted.by_area(4, |it| it.q_p / it.q_a)),
        Statement::new(
            "MPG-TREE",
            "A full quadtree has the same greatest performance with some thousand times as many units.",
            Rule::WithinFactor { factor: 2.0 },
        )
        .unit("times the units")
        .paper([1000.0])
        .found(Origin::Formula, [(at_k(4), whole_tree(4))]),
        Statement::new(
            "MPG-TREE",
            "A full quadtree has the same performance for areas from 1 to some bound.",
            Rule::AtMost,
        )
        .cannot_be_compared("the bound is illegible in the print; S_k is the likeliest reading"),
    ]
}

/// The figures' statements for running matrices.
fn as_run(ran: &Ran) -> Vec<Statement> {
    let fastest = |k: u32| ran.on_hardware(k, |it| it.pipes_ran).into_iter().find(|(area, _)| *area == 1.0);
    vec![
        Statement::new(
            "MPG-CAP",
            "For small polygons the pipelines’ performance is P_max: as they ran, with all waits, S = 1.",
            Rule::Within { percent: 5.0 },
        )
        .unit("P_max")
        .paper([1.0])
        .found(ran.rtl(), [3, 4].into_iter().filter_map(|k| Some((at_k(k), fastest(k)?.1)))),
    ]
}

/// The paper's assumption of a loose coupling.
fn queues(coupled: &Coupled) -> Vec<Statement> {
    let kept = |form: &'static str, depth: f64| {
        let of = move |area: f64| {
            let at = format!("S = {area}");
            coupled.loss(4, form, area).into_iter().find(|it| it.0 == depth).map(|(_, loss)| (at, 1.0 - loss))
        };
        coupled.areas().into_iter().filter_map(of)
    };
    let loosely = |form: &'static str, name: &str, depth: f64, packets: &str| {
        let text =
            format!("FIFOs couple the processors so loosely that none waits: {name}, queues of {packets}, k = 4.");
        Statement::new("MPG-LIM", text, Rule::Within { percent: 5.0 })
            .unit("of the speed without waits")
            .paper([1.0])
            .found(coupled.origin(), kept(form, depth))
    };
    let by_depth = |(depth, loss): (f64, f64)| (format!("depth {depth}"), loss);
    vec![
        loosely("pipe", "pipelines", 64.0, "64 packets"),
        loosely("stack", "stacks", 64.0, "64 packets"),
        loosely("pipe", "pipelines", 1.0, "one packet"),
        loosely("stack", "stacks", 1.0, "one packet").because(SHORT),
        Statement::new(
            "MPG-LIM",
            "Deeper queues never lose more: pipelines, k = 4, S = 100.",
            Rule::NeverIncreases { with: with("the depth") },
        )
        .found(coupled.origin(), coupled.loss(4, "pipe", 100.0).into_iter().map(by_depth)),
        Statement::new(
            "MPG-LIM",
            "Deeper queues never lose more: stacks, k = 4, S = 100.",
            Rule::NeverIncreases { with: with("the depth") },
        )
        .found(coupled.origin(), coupled.loss(4, "stack", 100.0).into_iter().map(by_depth)),
    ]
}
