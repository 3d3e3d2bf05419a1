//! The windows that the units of a generator divide, while it draws.

use tilewright_rtl::quadtree::raster::Part;
use tilewright_sim::Nets;

use super::config::Config;
use super::hardware::Hardware;
use crate::areas::{Area, Areas};
use crate::error::Error;

/// What a unit shows at its input: whether a window is there, whether it is taken, its size and its place.
const NETS: [&str; 5] = ["valid", "ready", "window_size", "window_x", "window_y"];

/// The windows so far.
pub(super) struct Visits {
    /// By unit, the number of its video processor.
    units: Vec<u32>,
    paths: Vec<String>,
    nets: Option<Nets>,
    values: Vec<u64>,
    /// By unit.
    areas: Areas<usize>,
    matrix: (u32, u32),
    screen: [u32; 2],
    levels: u32,
}

impl Visits {
    /// Those of a machine.
    ///
    /// # Errors
    /// A parameter is out of range.
    pub fn new(config: &Config) -> Result<Visits, Error> {
        let (p, q) = config.matrix;
        let form = config.parsed_form()?;
        let mut inner = Vec::new();
        for (number, part) in form.parts().iter().enumerate() {
            inner.extend(units(number, *part));
        }
        let processors = (0..p * q).flat_map(|number| inner.iter().map(move |unit| (number, unit)));
        let (units, inputs): (Vec<u32>, Vec<String>) =
            processors.map(|(number, unit)| (number, format!("u_processor[{number}].u_raster.{unit}.works"))).unzip();
        let paths: Vec<String> = inputs.iter().flat_map(|input| NETS.map(|net| format!("{input}_{net}"))).collect();
        let screen = [config.size.width(), config.size.height()];
        let levels = config.format()?.levels();
        let values = vec![0; paths.len()];
        Ok(Visits { units, paths, nets: None, values, areas: Areas::new(), matrix: (p, q), screen, levels })
    }

    /// Looks before an edge, which comes at that time.
    pub fn see(&mut self, hardware: &mut Hardware, time: u64) {
        let sim = &mut hardware.sim;
        let nets = self.nets.get_or_insert_with(|| sim.nets(&self.paths).expect("the units have these nets"));
        sim.numbers(nets, &mut self.values);
        for (unit, number) in self.units.iter().enumerate() {
            let [valid, ready, size, x, y] = self.values[unit * NETS.len()..][..NETS.len()] else { continue };
            if ready == 1 {
                self.areas.end(time, &unit);
            }
            if valid == 1 && ready == 1 {
                let area = area(*number, self.matrix, self.screen, (size as u32, x as u32, y as u32));
                let level = self.levels - size as u32;
                self.areas.begin(unit, Area { from: time, level, ..area });
            }
        }
    }

    /// All windows by the time at which a unit took them.
    pub fn into_areas(self) -> Vec<Area> {
        self.areas.take()
    }
}

/// The paths of a part's units.
fn units(number: usize, part: Part) -> Vec<String> {
    match part {
        Part::Stack(_) => vec![format!("u_stack{number}.u_test")],
        Part::Pipe(levels) => (0..levels).map(|level| format!("u_pipe{number}.u_test{level}")).collect(),
        Part::Tree(levels) => {
            let mut branches = vec![format!("u_tree{number}")];
            let mut found = Vec::new();
            for level in 0..levels {
                found.extend(branches.iter().map(|branch| format!("{branch}.u_test")));
                if level + 1 < levels {
                    let of = |branch: &String| [0, 1, 2, 3].map(|quarter| format!("{branch}.u_branch[{quarter}]"));
                    branches = branches.iter().flat_map(of).collect();
                }
            }
            found
        }
    }
}

/// The pixels from the first to the last sample of a window, of a processor with every p-th pixel of every q-th line (MPG-SPR). They may
/// extend beyond the screen.
fn area(number: u32, (p, q): (u32, u32), screen: [u32; 2], (size, x, y): (u32, u32, u32)) -> Area {
    let place = [x * p + number % p, y * q + number / p];
    let samples = (1 << size) - 1;
    let length = [samples * p + 1, samples * q + 1];
    let size = [0, 1].map(|axis| length[axis].min(screen[axis].saturating_sub(place[axis])));
    Area { from: 0, to: u64::MAX, painter: number, level: 0, place, size }
}
