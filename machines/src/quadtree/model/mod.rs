//! The transaction-level model of a generator: its clocks without its circuit, for runs that take too long on the circuit.
//!
//! ```text
//!                        .-> [queue][set-up] -> stages -> pixels        each stage, asked about a window,
//! packets -> [queue] ----+-> [queue][set-up] -> stages -> pixels        says in which clock it takes it
//!            broadcast   '-> ..
//! ```
//!
//! [`Search`] determines the windows that pass. Their times follow from the clocks in which windows are offered, and from the queues between
//! the stages. All numbers are those of the hardware: its counters, the clock in which it takes each packet, and the clock in which it is
//! idle. [`Simulated`] has the same [`Run`] for the hardware itself.
//!
//! | file | content |
//! |---|---|
//! | `division` | a coverage-test unit: the clocks of a window |
//! | `queue`, `line`, `tree` | units of a pipe, a stack, a tree, one after another |
//! | `processor` | a video processor |
//! | `record` | the numbers of a run |
//! | `simulated` | the same for the hardware |
//! | `square` | the paper's generators |
//! | `trials` | the paper's figures from counters of the model and of the hardware |
//! | `window_sizes` | the widths of windows, from counters |
//! | `sweep` | the loss with queues of some depths |

mod division;
mod line;
mod processor;
mod queue;
mod record;
mod simulated;
mod square;
mod sweep;
mod tree;
mod trials;
mod window_sizes;

use super::rasters::Rasters;
use super::windows::Search;
use crate::run::Watch;
use division::Course;
use processor::{Depths, VideoProcessor};
use std::collections::VecDeque;
use std::sync::atomic::Ordering;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_rtl::quadtree::format::Format;
use tilewright_rtl::quadtree::generator::QuadtreeGenerator;
use tilewright_rtl::quadtree::processor::Queues;
use tilewright_rtl::quadtree::raster::Form;

pub use record::{Counts, Packets, Processor, Run, Visit};
pub use simulated::Simulated;
pub use sweep::{Coupling, Sweep, SweepPoint};
pub use trials::{Measured, OnHardware, Outcome, Trial, Trials};
pub use window_sizes::WindowSizes;

/// Packets between two reports of progress.
const PACKETS_AT_ONCE: usize = 256;

/// The model of a generator.
///
/// ```
/// use tilewright_machines::{Watch, quadtree::{Rectangles, model::{Model, Packets}}};
/// use tilewright_rtl::parameter::Screen;
/// use tilewright_rtl::quadtree::{coverage_test::Test, format::{Format, Matrix}};
/// use tilewright_rtl::quadtree::{generator::QuadtreeGenerator, processor::{Queues, VideoProcessor}, raster::Form};
/// use tilewright_scenes::Size;
///
/// let format = Format::new(Screen::new(1024, 1024)?, Matrix::new(4, 4)?, 4)?.with_aperture(2)?;
/// let queues = Queues { broadcast: 2, packets: 16, windows: 4 };
/// let form = Form::parse("pipe", &format)?;
/// let video_processor = VideoProcessor { format, form, test: Test::Serial, queues };
/// let model = Model::new(&QuadtreeGenerator { video_processor })?;
///
/// let rectangles = Rectangles::new(Size::new(1024, 1024)?, 100.0, 5.0, 1)?;
/// let polygons: Vec<_> = (0..50).map(|index| rectangles.polygon(index)).collect();
/// let run = model.run(Packets::at_once(&polygons), &mut Watch::default()).expect("not interrupted");
/// // A polygon takes at least 4 tests of 4 clocks in a stage, and rectangles of 100 pixels have more than one window.
/// assert!(run.clocks > 50 * 16);
/// assert_eq!(run.processors[0].units[0].results, 50);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Model {
    search: Search,
    form: Form,
    test: Test,
    queues: Queues,
}

impl Model {
    /// The model of that generator.
    ///
    /// # Errors
    /// Its windows are too large for counting, as in [`Rasters::check`].
    pub fn new(generator: &QuadtreeGenerator) -> Result<Model, ParameterError> {
        let processor = &generator.video_processor;
        let search = Search::new(rasters_of(&generator.format()))?;
        Ok(Model { search, form: processor.form.clone(), test: processor.test, queues: processor.queues })
    }

    /// The generator's run on packets, from its reset until it is idle. `None` if interrupted.
    pub fn run(&self, packets: Packets, watch: &mut Watch) -> Option<Run> {
        self.run_with_visits(packets, false, watch).map(|(run, _)| run)
    }

    /// The same, and the visits of all windows, by video processor and unit.
    ///
    /// ```
    /// use tilewright_machines::{Watch, quadtree::model::{Model, Packets}};
    /// use tilewright_rtl::parameter::Screen;
    /// use tilewright_rtl::quadtree::{coverage_test::Test, format::{Format, Matrix}};
    /// use tilewright_rtl::quadtree::{generator::QuadtreeGenerator, processor::{Queues, VideoProcessor}, raster::Form};
    /// use tilewright_scenes::{ScreenVertex, Size, set_up};
    ///
    /// let format = Format::new(Screen::new(2, 2)?, Matrix::new(1, 1)?, 3)?;
    /// let queues = Queues { broadcast: 1, packets: 1, windows: 1 };
    /// let form = Form::parse("stack", &format)?;
    /// let video_processor = VideoProcessor { format, form, test: Test::Serial, queues };
    /// let model = Model::new(&QuadtreeGenerator { video_processor })?;
    ///
    /// // A triangle that covers the upper left pixel.
    /// let at = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [0; 3] };
    /// let polygons = [set_up(&[at(0, 0), at(2, 0), at(0, 2)], Size::new(2, 2)?).unwrap().into()];
    /// let (_, visits) = model.visits(Packets::at_once(&polygons), &mut Watch::default()).unwrap();
    /// let [set_up, test] = &visits[0][..] else { panic!("two units") };
    /// // Two queues take a clock each, and the set-up 4. The first test takes 3, and its window 4.
    /// assert_eq!((set_up.sent[0], test.taken), (5, 5));
    /// assert_eq!(test.sent[0], 12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn visits(&self, packets: Packets, watch: &mut Watch) -> Option<(Run, Vec<Vec<Visit>>)> {
        self.run_with_visits(packets, true, watch)
    }

    /// Clocks until each video processor would be idle if it never had to wait for another. The paper's estimates leave out that coupling
    /// (MPG-LIM). `None` if interrupted.
    pub fn uncoupled(&self, packets: Packets, watch: &mut Watch) -> Option<Vec<u64>> {
        let mut processors = self.processors(packets, self.queues.packets as usize, false);
        let mut offered = 0;
        for packet in 0..packets.polygons.len() {
            goes_on(packet, packets, watch).then_some(())?;
            offered += packets.pause(packet) + 1;
            processors.iter_mut().for_each(|processor| processor.take_at_once(packet as u32, offered));
        }
        processors.iter_mut().for_each(VideoProcessor::finish);
        Some(processors.iter().map(VideoProcessor::idle).collect())
    }

    fn run_with_visits(&self, packets: Packets, keeps: bool, watch: &mut Watch) -> Option<(Run, Vec<Vec<Visit>>)> {
        let mut processors = self.processors(packets, self.queues.packets as usize, keeps);
        let mut broadcast = Broadcast::new(self.queues.broadcast as usize);
        let mut taken: Vec<u64> = Vec::with_capacity(packets.polygons.len());
        for packet in 0..packets.polygons.len() {
            goes_on(packet, packets, watch).then_some(())?;
            let offered = taken.last().map_or(0, |clock| clock + 1) + packets.pause(packet);
            taken.push(broadcast.send(offered, |clock| {
                let takes = processors.iter_mut().map(|processor| processor.take(packet as u32, clock));
                takes.max().unwrap_or(clock)
            }));
        }
        processors.iter_mut().for_each(VideoProcessor::finish);
        let is_nothing = packets.polygons.is_empty();
        let clocks = if is_nothing { 0 } else { processors.iter().map(VideoProcessor::idle).max().unwrap_or(0) };
        let (processors, visits) = processors.into_iter().map(VideoProcessor::into_record).unzip();
        Some((Run { taken, clocks, broadcast: broadcast.counts, processors }, visits))
    }

    fn processors<'a>(&'a self, packets: Packets<'a>, depth: usize, keeps_visits: bool) -> Vec<VideoProcessor<'a>> {
        let course = Course { search: &self.search, polygons: packets.polygons, test: self.test };
        let depths = Depths { packets: depth, windows: self.queues.windows as usize };
        let roots = self.search.processors().map(|processor| self.search.root(processor));
        roots.map(|root| VideoProcessor::new(course, &self.form, root, depths, keeps_visits)).collect()
    }
}

/// The queue of the broadcast, which gives each packet to all video processors.
struct Broadcast {
    depth: usize,
    /// The clocks in which the last packets were sent; their number is the size of the queue.
    gone: VecDeque<u64>,
    counts: Counts,
}

impl Broadcast {
    fn new(depth: usize) -> Broadcast {
        Broadcast { depth, gone: VecDeque::new(), counts: Counts::default() }
    }

    /// Takes a packet that is offered from a clock on, and returns the clock of that. `all` returns the clock in which all video processors
    /// have a packet that is offered to them from a clock on.
    fn send(&mut self, offered: u64, all: impl FnOnce(u64) -> u64) -> u64 {
        let room = if self.gone.len() == self.depth { self.gone.pop_front() } else { None };
        let taken = offered.max(room.map_or(0, |clock| clock + 1));
        let shown = self.gone.back().copied().or(room).unwrap_or(0).max(taken) + 1;
        let gone = all(shown);
        self.gone.push_back(gone);
        self.counts += Counts { busy: 1, stalled: gone - shown, results: 1 };
        taken
    }
}

/// Reports the progress of a run from time to time; false if it has to stop.
fn goes_on(packet: usize, packets: Packets, watch: &mut Watch) -> bool {
    if packet.is_multiple_of(PACKETS_AT_ONCE) {
        watch.report("counting clocks", packet as f64 / packets.polygons.len() as f64);
    }
    !watch.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
}

/// The rasters of a format.
fn rasters_of(format: &Format) -> Rasters {
    let (matrix, aperture) = (format.matrix(), format.aperture());
    Rasters { p: matrix.columns(), q: matrix.rows(), levels: format.levels(), aperture: (aperture, aperture) }
}

#[cfg(test)]
mod tests;
