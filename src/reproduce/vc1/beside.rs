//! A run of the circuit, compared with the model's run of the same views.

use std::sync::Arc;
use tilewright_machines::Error;
use tilewright_machines::vc1::model::{Model, Place, What};
use tilewright_machines::vc1::{Config, Report};
use tilewright_scenes::Projection;

/// The differences between the two.
pub struct Beside {
    /// Frames with different numbers.
    pub differing: u64,
    /// Sums of a processing element's clocks in a frame that differ from the clocks between its swaps, from the second frame on.
    pub unaccounted: u64,
}

impl Beside {
    /// Runs the model for frames of a still view.
    ///
    /// # Errors
    /// There is no such machine.
    pub fn of(config: &Config, view: &Arc<Projection>, circuit: &Report) -> Result<Beside, Error> {
        let model = Model::new(*config)?;
        let frames = circuit.frames.len();
        let mut swaps = Swaps::new(circuit.machine.processors);
        let views = std::iter::repeat_n(model.deal(view, None)?, frames);
        let modelled = model.observe(views, |event| {
            if let Place::Processor(number) = event.place {
                swaps.see(number as usize, event.what, event.clock);
            }
        });
        let pairs = circuit.frames.iter().zip(&modelled.frames);
        let differing =
            pairs.filter(|(circuit, model)| circuit != model).count() + frames.abs_diff(modelled.frames.len());
        Ok(Beside { differing: differing as u64, unaccounted: swaps.unaccounted(circuit) })
    }
}

/// The swaps at the ends of frames, by processing element.
struct Swaps {
    clocks: Vec<Vec<u64>>,
    /// The next swap of each.
    is_due: Vec<bool>,
}

impl Swaps {
    fn new(processors: u32) -> Swaps {
        Swaps { clocks: vec![Vec::new(); processors as usize], is_due: vec![false; processors as usize] }
    }

    fn see(&mut self, processor: usize, what: What, clock: u64) {
        match what {
            What::Due => self.is_due[processor] = true,
            What::Swaps if std::mem::take(&mut self.is_due[processor]) => self.clocks[processor].push(clock),
            _ => {}
        }
    }

    /// Sums of clocks that differ from those between swaps.
    fn unaccounted(&self, report: &Report) -> u64 {
        let wrong = |(number, clocks): (usize, &Vec<u64>)| {
            let between = clocks.windows(2).map(|pair| pair[1] - pair[0]);
            let sums = report.frames.iter().skip(1).map(|frame| frame.processors[number].clocks.total());
            between.zip(sums).filter(|(between, sum)| between != sum).count()
                + report.frames.len().abs_diff(clocks.len())
        };
        self.clocks.iter().enumerate().map(wrong).sum::<usize>() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_machines::Watch;
    use tilewright_machines::vc1::Machine;
    use tilewright_scenes::{Scene, Size, project};

    #[test]
    fn a_clock_too_many_is_seen() -> Result<(), Box<dyn std::error::Error>> {
        let size = Size::new(64, 48)?;
        let view = Arc::new(project(&Scene::builtin("star").ok_or("a built-in scene")?, size)?);
        let config = Config { processors: 2, refresh: 5000.0, ..Config::new(size) };
        let mut views = std::iter::repeat_n((*view).clone(), 3);
        let mut report =
            Machine::new(config)?.render_frames([0; 3], &mut Watch::default(), || views.next(), |_| true)?;
        let beside = |report: &Report| Beside::of(&config, &view, report).map(|it| (it.differing, it.unaccounted));
        assert_eq!(beside(&report)?, (0, 0));
        report.frames[1].processors[1].clocks.sync += 1;
        assert_eq!(beside(&report)?, (1, 1));
        Ok(())
    }
}
