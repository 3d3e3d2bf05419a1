//! The event-driven model of the machine: its clocks without its circuit, for runs that take too long on the circuit.
//!
//! ```text
//!  views --> host --command--> [ bus ] ==words==> processor ==accesses==> [ LFB ]
//!              ^                  ^                 |  ^                    |
//!              |                  '----- words -----'  '---- overflow ------'
//!              '------ sync line ------ all drawn          swaps |
//!                                                                v
//!                       shown <---- banks change <---- [ merger, global frame buffer ]
//! ```
//!
//! The program of a processing element is the machine's own. The hardware behind its ports is not simulated clock by clock. Formulas give the times of
//! accesses, pages, words and swaps from the last events. A processing element runs ahead of the others while all its inputs are known, and stays
//! behind while its inputs do not matter to others.
//!
//! All clocks are those of the hardware ([`Vc1`]). [`Machine::render`](super::Machine::render) compares in every run:
//!
//! - each access, received word, overflow, swap, resumption and program end of each processing element;
//! - each word on the bus;
//! - each change of the banks and restart of the scan, and each refresh that is checked;
//! - each number of a [`FrameReport`](super::FrameReport).
//!
//! | file | content |
//! |---|---|
//! | `host` | commands, and the sequence of all events |
//! | `due` | the schedule of processing elements |
//! | `senders` | the rotation of senders on the bus |
//! | `processor` | a program, run from event to event |
//! | `lfb` | the times of a local frame buffer's accesses, pages and overflows |
//! | `bus` | the words on the bus and in the receive queues |
//! | `merger` | the times of sent pixels and of changes of the banks |
//! | `timing` | the clocks, their crossings, and the blankings of the display |
//! | `event` | the events and their places |
//! | `regions` | the region-based machine of Table 1 |
//! | `estimate` | the paper's two passes beyond 16 processing elements |
//!
//! A frame of ter1k with 16 processing elements takes 20 ms, one of ter250 some 90 ms, and with 256 some 120 ms. Polygons that all draw
//! cost more, as each processing element receives each. With 256 and a threshold of 31 pixels a frame of ter1k takes 220 ms. One of ter250
//! that is sent each time takes 2.5 to 3.5 s.
//! `cargo test --release -p tilewright-machines --test all a_frame_takes_milliseconds -- --ignored --nocapture` prints these.
//!
//! ```
//! use std::sync::Arc;
//! use tilewright_machines::vc1::{Config, model::Model};
//! use tilewright_scenes::{Scene, Size};
//!
//! let mut scene = Scene::builtin("star").expect("a built-in scene");
//! scene.size = Size::new(64, 48)?;
//! let view = Arc::new(scene.project()?);
//! let model = Model::new(Config { refresh: 5000.0, ..Config::new(scene.size) })?;
//! // A still view, four times.
//! let report = model.still(&view, 4)?;
//! assert_eq!(report.frames.len(), 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bus;
mod due;
mod estimate;
mod event;
mod host;
mod lfb;
mod merger;
mod processor;
mod regions;
mod senders;
mod timing;

use std::sync::Arc;

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::vc1::Vc1;
use tilewright_scenes::Projection;

pub(crate) use self::host::Run;
use super::config::{Built, Config};
use super::job::View;
use super::report::Report;

pub use estimate::Estimate;
pub use event::{Event, Place, What};
pub use regions::{RegionFrame, Regions};

/// The model of a machine.
#[derive(Clone, Debug)]
pub struct Model {
    config: Config,
    built: Built,
    vc1: Vc1,
    /// The end of its reset.
    reset: u64,
}

/// A view whose polygons are assigned to the processing elements of a machine. Clones share it.
#[derive(Clone, Debug)]
pub struct Dealt(Arc<View>);

impl Dealt {
    #[cfg(test)]
    pub(crate) fn view(&self) -> Arc<View> {
        self.0.clone()
    }
}

impl Model {
    /// The model of the machine of that configuration.
    ///
    /// # Errors
    /// A parameter is out of range, as [`Config::hardware`] says.
    pub fn new(config: Config) -> Result<Model, ParameterError> {
        let vc1 = config.hardware()?;
        Ok(Model { config, built: config.built()?, reset: timing::reset_time(&vc1), vc1 })
    }

    /// The number of processing elements.
    pub(crate) fn processors(&self) -> u32 {
        self.config.processors
    }

    /// Assigns the polygons of a view by [`Config::assign`]; `first` is the result for the first view, unless this is it.
    ///
    /// # Errors
    /// The view is for another screen, or of another scene than the first one.
    pub fn deal(&self, view: &Arc<Projection>, first: Option<&Dealt>) -> Result<Dealt, ParameterError> {
        let first = first.map(|Dealt(view)| &view.assignment);
        Ok(Dealt(Arc::new(View::new(&self.config, view.clone(), first)?)))
    }

    /// Renders a frame of each of those views, all of one scene; the report is that of
    /// [`Machine::render_frames`](super::Machine::render_frames), without judged refreshes.
    pub fn render(&self, views: impl IntoIterator<Item = Dealt>) -> Report {
        self.observe(views, |_| {})
    }

    /// Renders a number of frames of one view.
    ///
    /// # Errors
    /// As [`Model::deal`].
    pub fn still(&self, view: &Arc<Projection>, frames: usize) -> Result<Report, ParameterError> {
        let dealt = self.deal(view, None)?;
        Ok(self.render(std::iter::repeat_n(dealt, frames)))
    }

    /// As [`Model::render`]; `seen` gets all events. Those at one place are sorted by time.
    pub fn observe(&self, views: impl IntoIterator<Item = Dealt>, seen: impl FnMut(Event)) -> Report {
        self.report(Run::new(self, seen), views)
    }

    /// Goes through a run with these views.
    fn report<S: FnMut(Event)>(&self, mut run: Run<'_, S>, views: impl IntoIterator<Item = Dealt>) -> Report {
        for Dealt(view) in views {
            run.advance(u64::MAX, true);
            run.command(view);
        }
        run.advance(u64::MAX, true);
        run.advance(u64::MAX, false);
        let scene = run.scene();
        Report {
            machine: self.built.clone(),
            polygons: scene.polygons,
            load_words: scene.words,
            merge_clocks: self.vc1.gfb().sequencer().merge_clocks(),
            judged: 0,
            compared: 0,
            frames: run.shown.into(),
        }
    }
}

#[cfg(test)]
mod tests;
