//! The longest wait of a processing element for the swap of an overflow (VC1-SW4). Two processing elements draw a few bars, and the first
//! frame begins at any time of a refresh.

use super::run::CLOCK;
use std::sync::Arc;
use tilewright_machines::vc1::model::{Dealt, Model};
use tilewright_machines::vc1::{Assign, Config, CostTable};
use tilewright_machines::{Error, Watch};
use tilewright_rtl::clocks::PE;
use tilewright_scenes::{Projection, ScreenVertex, Size};

/// Programs that compute almost nothing, so that an overflow directly follows a swap.
const QUICK: CostTable =
    CostTable { vertex: 0, polygon: 0, area: 0, clip: 0, set_up: 0, row: 0, pixel: 1, clear: 1, send: 1, receive: 1 };

/// Times within a refresh at which the first frame begins.
const TIMES: u64 = 100;

/// The longest waits, in ms.
pub struct Idle {
    /// If the swap before was in a blanking, with that of the global frame buffer.
    pub in_blanking: f64,
    /// If all swapped together before.
    pub together: f64,
    /// If the other one overflowed late in the frame before, and its own swap waited.
    pub any: f64,
}

/// The patches on which two processing elements draw in each frame; each has two pages.
struct Experiment {
    frames: Vec<[i32; 2]>,
    /// The one that is measured, in the last frame.
    processor: usize,
}

impl Idle {
    /// Runs the experiments; `None` if interrupted.
    pub fn found(watch: &mut Watch) -> Option<Result<Idle, Error>> {
        let experiments = [
            Experiment { frames: vec![[1, 1], [1, 1], [1, 1], [1, 1], [3, 1]], processor: 0 },
            Experiment { frames: vec![[1, 1], [3, 1]], processor: 0 },
            Experiment { frames: vec![[3, 1], [1, 3]], processor: 1 },
        ];
        let longest = watch.each("overflowing", &experiments, Experiment::longest)?;
        let longest = longest.into_iter().collect::<Result<Vec<f64>, Error>>();
        Some(longest.map(|it| Idle { in_blanking: it[0], together: it[1], any: it[2] }))
    }
}

impl Experiment {
    fn longest(&self) -> Result<f64, Error> {
        let size = Size::VGA;
        let config = Config {
            processors: 2,
            pages: Some(2),
            cluster: 1,
            assign: Assign::Count,
            apr: None,
            costs: QUICK,
            ..Config::new(size)
        };
        let refresh = (1e12 / config.refresh) as u64 / PE.period.picoseconds();
        let views: Vec<Arc<Projection>> =
            (0..).zip(&self.frames).map(|(number, patches)| Arc::new(bars(size, number == 0, *patches))).collect();
        let mut longest: f64 = 0.0;
        for time in 0..TIMES {
            // Only its small triangle is clipped.
            let costs = CostTable { clip: time * refresh / TIMES, ..QUICK };
            let model = Model::new(Config { costs, ..config })?;
            let mut dealt: Vec<Dealt> = Vec::new();
            for view in &views {
                dealt.push(model.deal(view, dealt.first())?);
            }
            let report = model.render(dealt);
            let waited = report.frames[views.len() - 1].processors[self.processor];
            longest = longest.max(waited.clocks.overflow as f64 / waited.overflows.max(1) as f64 * CLOCK);
        }
        Ok(longest)
    }
}

/// A frame for two. Each draws a small triangle, which is clipped at the border if `is_clipped`, and a bar over a number of patches.
fn bars(size: Size, is_clipped: bool, patches: [i32; 2]) -> Projection {
    let at = |x: i32, y: i32| ScreenVertex { x: 16 * x + 4, y: 16 * y - 8, z: 5, rgb: [200, 100, 50] };
    let left = if is_clipped { -2 } else { 1 };
    let small = [at(left, 41), at(3, 41), at(3, 43)];
    let bar = |row: i32, patches: i32| {
        let right = 4 * patches;
        [[at(0, row), at(right, row), at(right, row + 1)], [at(0, row), at(right, row + 1), at(0, row + 1)]]
    };
    let [[a, b], [c, d]] = [bar(1, patches[0]), bar(9, patches[1])];
    Projection::of_triangles(size, [small, small, a, c, b, d])
}
