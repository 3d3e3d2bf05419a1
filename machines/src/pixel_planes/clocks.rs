//! The clocks of a renderer for a primitive, N: from its first operation to the next one's.
//!
//! Source: PP5-UT, facts E3. The clocks follow from the instructions by the controller's [`Schedule`], which agrees with the hardware in each
//! clock. They depend on the memory's remaining work for the primitive before. Here instructions always arrive in time.

use serde::Serialize;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixel_planes::instruction::Instruction;
use tilewright_rtl::pixel_planes::programs::Program;
use tilewright_rtl::pixel_planes::schedule::{Schedule, Step};
use tilewright_scenes::Polygons;

use super::bin::{Bin, Work, bins};
use super::config::Config;

/// The name of the program that draws spheres strictly: `smooth_strict` with quadratics.
pub const SPHERE_STRICT: &str = "sphere_strict";
/// The name of the program that draws spheres and keeps the least word: `smooth_least` with quadratics.
pub const SPHERE_LEAST: &str = "sphere_least";
/// The number of programs for polygons.
const POLYGONS: usize = Program::PRIMITIVES.len();

/// The clocks of the primitives of one program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ProgramClocks {
    /// The program's name; for spheres [`SPHERE_STRICT`] or [`SPHERE_LEAST`].
    pub program: &'static str,
    /// Primitives that it draws; a primitive counts once for each region.
    pub primitives: u64,
    /// Their clocks, from the first operation of each to that of the next.
    pub clocks: u64,
    /// The most clocks of one.
    pub most: u64,
}

impl ProgramClocks {
    /// The clocks without primitives.
    fn none(program: &'static str) -> ProgramClocks {
        ProgramClocks { program, primitives: 0, clocks: 0, most: 0 }
    }

    /// Mean clocks of a primitive, N; 0 without primitives.
    pub fn mean(&self) -> f64 {
        self.clocks as f64 / self.primitives.max(1) as f64
    }

    fn add(&mut self, other: ProgramClocks) {
        self.primitives += other.primitives;
        self.clocks += other.clocks;
        self.most = self.most.max(other.most);
    }
}

/// The clocks of all programs that draw primitives, in the sequence of [`Program::PRIMITIVES`], then for spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tally([ProgramClocks; POLYGONS + 2]);

impl Default for Tally {
    fn default() -> Tally {
        let polygons = Program::PRIMITIVES.map(|program| program.name);
        let names = [&polygons[..], &[SPHERE_STRICT, SPHERE_LEAST]].concat();
        Tally(std::array::from_fn(|number| ProgramClocks::none(names[number])))
    }
}

impl Tally {
    /// The clocks of those programs that draw anything.
    pub fn used(&self) -> impl Iterator<Item = ProgramClocks> {
        self.0.into_iter().filter(|it| it.primitives > 0)
    }

    /// The sum of both.
    pub fn add(&mut self, other: Tally) {
        self.0.iter_mut().zip(other.0).for_each(|(sum, it)| sum.add(it));
    }

    fn count(&mut self, clocks: ProgramClocks) {
        self.0.iter_mut().filter(|it| it.program == clocks.program).for_each(|it| it.add(clocks));
    }
}

/// A renderer that takes instructions of regions and primitives, and counts their clocks.
pub(super) struct Clocked {
    schedule: Schedule,
    pub tally: Tally,
}

impl Clocked {
    pub fn new(side_by_side: bool) -> Clocked {
        Clocked { schedule: Schedule::new(side_by_side), tally: Tally::default() }
    }

    /// Takes the instructions for a region.
    pub fn region(&mut self, instructions: &[Instruction<u64>]) {
        for instruction in instructions {
            self.schedule.take(&Step::from(instruction));
        }
    }

    /// Takes a primitive and returns its clocks. All primitives begin with instructions for the tree alone, so the next one does not matter.
    pub fn primitive(&mut self, program: &'static str, instructions: &[Instruction<u64>]) -> u64 {
        let begun = self.schedule.tree_free();
        self.region(instructions);
        let clocks = self.schedule.tree_free() - begun;
        if !instructions.is_empty() {
            self.tally.count(ProgramClocks { program, primitives: 1, clocks, most: clocks });
        }
        clocks
    }
}

/// The clocks of a scene's primitives in the bins of a machine's regions, by program, computed without the machine. They are those of
/// [`Report::programs`](super::Report::programs).
///
/// ```
/// use tilewright_machines::pixel_planes::{Config, scene_clocks};
/// use tilewright_scenes::{Scene, project_polygons};
///
/// let scene = Scene::builtin("star").expect("a built-in scene");
/// let polygons = project_polygons(&scene, scene.size)?;
/// let clocks = scene_clocks(&Config::new(scene.size), &polygons)?;
/// // Its vectors have one colour each.
/// let programs: Vec<_> = clocks.used().map(|it| it.program).collect();
/// assert_eq!(programs, ["flat_least"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The side of the regions is out of range.
pub fn scene_clocks(config: &Config, polygons: &Polygons) -> Result<Tally, ParameterError> {
    let regions = config.regions()?;
    let mut tally = Tally::default();
    for (region, numbers) in bins(&regions, polygons).iter().enumerate() {
        let bin = Bin::new(region, &regions, config);
        tally.add(Work::new(&bin, numbers, polygons, [0; 3]).programs);
    }
    Ok(tally)
}
