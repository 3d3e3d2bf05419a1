//! N of all programs: the worst and the mean clocks of a primitive, for each form of edges, one instruction at a time and side by side.
//!
//! Source: PP5-UT, PP5-UTV, facts E3. The paper's 239 ns a vector are 94 clocks. Its text does not say what its program stored of depth, nor how
//! many bits its words had. So 94 is only shown for comparison.

use std::fmt;

use serde::Serialize;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::programs::{
    Edges, FLAT, FLAT_LEAST, FLAT_STRICT, Program, SMOOTH_LEAST, SMOOTH_STRICT,
};
use tilewright_scenes::{Polygon, Polygons, Size, set_up_line};

use super::bin::{Bin, Work};
use super::clocks::{Clocked, Tally};
use super::config::Config;
use super::formulas::VECTOR_CYCLES;
use super::outline::Binner;
use super::regions::Regions;
use super::vectors::Vectors;
use worst::worst;

mod worst;

/// The primitives of a program here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Vectors, which have four edges and one colour.
    Vectors,
    /// Triangles with planes of colour.
    Triangles,
    /// Convex polygons of eight edges, the greatest number.
    Polygons,
}

/// N of a program.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The program's name.
    pub program: &'static str,
    /// The primitives that it draws.
    pub primitives: Kind,
    /// The form of edges: `fixed`, `own` or `least`.
    pub edges: &'static str,
    /// Whether tree and memory may work on two instructions.
    pub side_by_side: bool,
    /// Clocks of each of many equal primitives with the most possible bits of edges.
    pub worst: u64,
    /// Mean clocks over the primitives of a scene in the bins of its regions, in the sequence of submission. Polygons have no scene.
    pub mean: Option<f64>,
}

/// N of all programs, in regions of 128 x 128 pixels.
///
/// ```
/// use tilewright_machines::pixel_planes::Table;
/// use tilewright_scenes::{Scene, Size, project_polygons};
///
/// let triangles = project_polygons(&Scene::builtin("teapot").expect("a built-in scene"), Size::VGA)?;
/// let table = Table::new(&triangles, 100, 1)?;
/// let row = table.row("flat_strict", "least", false).expect("each has a row");
/// // Four edges of 15, 15, 8 and 8 bits; depth, compared and stored; colour.
/// assert_eq!(row.worst, 46 + 40 + 24 + 24);
/// assert!(row.mean < Some(134.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table {
    /// By program, form of edges and manner.
    pub rows: Vec<Row>,
}

/// The programs, each with its primitives here.
const PROGRAMS: [(&Program, Kind); 10] = [
    (&FLAT, Kind::Vectors),
    (&FLAT_STRICT, Kind::Vectors),
    (&FLAT_LEAST, Kind::Vectors),
    (&SMOOTH_STRICT, Kind::Triangles),
    (&SMOOTH_LEAST, Kind::Triangles),
    (&FLAT, Kind::Polygons),
    (&FLAT_STRICT, Kind::Polygons),
    (&FLAT_LEAST, Kind::Polygons),
    (&SMOOTH_STRICT, Kind::Polygons),
    (&SMOOTH_LEAST, Kind::Polygons),
];

/// The length of vectors in pixels (PP5-UTV).
const LENGTH: f64 = 50.0;

/// Primitives on a screen.
struct Primitives<'a> {
    size: Size,
    polygons: &'a [Polygon],
    bins: Vec<Vec<u32>>,
}

impl Table {
    /// The clocks of a scene's triangles, and of the same number of random vectors of 50 pixels on the paper's screen.
    ///
    /// # Errors
    /// The screen has no regions of 128 x 128 pixels.
    pub fn new(triangles: &Polygons, vectors: u64, seed: u64) -> Result<Table, ParameterError> {
        let screen = Regions::paper();
        let random = Vectors::new(screen, LENGTH, None, seed)?;
        let ends = (0..vectors).map(|index| random.ends(index));
        let lines = ends.filter_map(|ends| Some((ends, set_up_line(ends, screen.size())?)));
        let (ends, lines): (Vec<_>, Vec<_>) = lines.unzip();
        let vectors = Primitives { size: screen.size(), polygons: &lines, bins: screen.bins(&ends, Binner::Tight) };
        let regions = Config::new(triangles.size).regions()?;
        let bins = regions.bins(&triangles.vertices, Binner::Tight);
        let triangles = Primitives { size: triangles.size, polygons: &triangles.polygons, bins };

        let mut rows = Vec::new();
        for (program, kind) in PROGRAMS {
            let primitives = match kind {
                Kind::Vectors => Some(&vectors),
                Kind::Triangles => Some(&triangles),
                Kind::Polygons => None,
            };
            for (edges, side_by_side) in Edges::ALL.into_iter().flat_map(|edges| [(edges, false), (edges, true)]) {
                let mean = primitives.map(|it| it.clocks(program, edges, side_by_side)).transpose()?;
                let worst = steady_clocks(program, &worst(program, kind, edges)?, side_by_side);
                let (program, edges) = (program.name, edges.name());
                rows.push(Row { program, primitives: kind, edges, side_by_side, worst, mean });
            }
        }
        Ok(Table { rows })
    }

    /// The row of a program, by name, with edges of that form.
    pub fn row(&self, program: &str, edges: &str, side_by_side: bool) -> Option<&Row> {
        self.rows.iter().find(|it| (it.program, it.edges, it.side_by_side) == (program, edges, side_by_side))
    }

    /// The table in Markdown: for each program and form of edges, worst and mean one at a time, then side by side.
    pub fn markdown(&self) -> Vec<String> {
        let pairs = self.rows.chunks(2);
        let pairs = pairs.map(|pair| {
            let Row { program, primitives, edges, .. } = pair[0];
            let mean = |it: &Row| it.mean.map_or(String::new(), |mean| format!("{mean:.1} "));
            let clocks: String = pair.iter().map(|it| format!(" {} | {}|", it.worst, mean(it))).collect();
            format!("| `{program}` | {primitives} | {edges} |{clocks}")
        });
        pairs.collect()
    }
}

impl Primitives<'_> {
    /// The mean clocks of one program over all primitives in all their regions.
    fn clocks(&self, program: &'static Program, edges: Edges, side_by_side: bool) -> Result<f64, ParameterError> {
        let config = Config { edges, side_by_side, ..Config::new(self.size) };
        let regions = config.regions()?;
        let mut tally = Tally::default();
        for (region, numbers) in self.bins.iter().enumerate() {
            let bin = Bin::new(region, &regions, &config);
            let draw = |number: u32| bin.draw(program, &self.polygons[number as usize]);
            let drawn = numbers.iter().map(|&number| (number, program.name, draw(number)));
            tally.add(Work::of(&bin, drawn, [0; 3]).programs);
        }
        Ok(tally.used().next().map_or(0.0, |it| it.mean()))
    }
}

/// Clocks of each of many equal primitives, after the first ones.
pub(super) fn steady_clocks(program: &Program, instructions: &[Instruction<u64>], side_by_side: bool) -> u64 {
    const MANY: usize = 8;
    let mut clocked = Clocked::new(side_by_side);
    (0..MANY).map(|_| clocked.primitive(program.name, instructions)).last().expect("there are many")
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Kind::Vectors => "vectors",
            Kind::Triangles => "triangles",
            Kind::Polygons => "polygons of 8 edges",
        })
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "| program | primitives | edges | one at a time: worst | mean | side by side: worst | mean |")?;
        writeln!(f, "|---|---|---|---|---|---|---|")?;
        self.markdown().iter().try_for_each(|line| writeln!(f, "{line}"))?;
        write!(f, "The paper's 239 ns a vector are {VECTOR_CYCLES} clocks.")
    }
}

#[cfg(test)]
mod tests;
