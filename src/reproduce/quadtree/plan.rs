//! What is run for the page: everything that the figures need, or a quick look.

use super::TURNING;
use crate::reproduce::effort::Effort;
use tilewright_machines::quadtree::model::{Sweep, Trial, Trials};
use tilewright_machines::quadtree::{Config, Sample, Study, Test};
use tilewright_scenes::{Polygons, Size};

/// Counted and run rectangles of each turning area.
const AT_TURNING: [(f64, u64, u64); 3] =
    [(TURNING[0], 8_000, 1000), (TURNING[1], 8_000, 500), (TURNING[2], 8_000, 300)];
/// The only area that runs on the hardware in a quick look, as the hardware takes longest.
const QUICK_AREA: f64 = 1.0;

impl Effort {
    fn reduced(&self, sample: Sample) -> Sample {
        Sample { polygons: self.at_most(sample.polygons), ..sample }
    }

    /// The count for the paper's figures, with its turning areas.
    pub fn study(&self) -> Study {
        let mut study = Study::paper(self.seed);
        study.samples.extend(AT_TURNING.map(|(area, polygons, _)| Sample { area, polygons }));
        study.samples.sort_by(|a, b| a.area.total_cmp(&b.area));
        study.samples.iter_mut().for_each(|sample| *sample = self.reduced(*sample));
        study
    }

    /// The runs for the figures, with the same areas.
    pub fn trials(&self) -> Trials {
        let mut trials = Trials::paper(self.seed);
        let turning = |(area, _, polygons)| Trial { sample: Sample { area, polygons }, on_hardware: true };
        trials.trials.extend(AT_TURNING.map(turning));
        trials.trials.sort_by(|a, b| a.sample.area.total_cmp(&b.sample.area));
        for trial in &mut trials.trials {
            trial.sample = self.reduced(trial.sample);
            trial.on_hardware &= !self.is_quick() || trial.sample.area == QUICK_AREA;
        }
        trials
    }

    /// The runs with queues of many depths.
    pub fn sweep(&self) -> Sweep {
        let mut sweep = Sweep::paper(self.seed);
        sweep.samples.iter_mut().for_each(|sample| *sample = self.reduced(*sample));
        sweep
    }

    /// The runs of pipes with window queues of many depths, and packet queues of one packet.
    pub fn window_sweep(&self) -> Sweep {
        let samples = vec![self.reduced(Sample { area: 100.0, polygons: 1000 })];
        let forms = vec!["pipe".to_owned()];
        Sweep { forms, packets: vec![1], windows: vec![1, 2, 4, 8, 16, 32, 64], samples, ..Sweep::paper(self.seed) }
    }

    /// The frames: scenes, and sides of the matrix.
    pub fn frames(&self) -> &'static [(&'static str, u32)] {
        let all = &[("teapot", 4), ("ter1k", 4), ("teapot", 16)];
        if self.is_quick() { &all[..1] } else { all }
    }

    /// Their size.
    pub fn frame_size(&self) -> Size {
        let quick = Size::new(64, 48).expect("in range");
        if self.is_quick() { quick } else { Size::VGA }
    }
}

/// The generator of a frame: pipes that test all edges of a window at once.
pub fn config(polygons: &Polygons, side: u32) -> Config {
    Config { matrix: (side, side), test: Test::Parallel, ..Config::for_packets(polygons.size, &polygons.polygons) }
}
