//! The model of the machine that goes from event to event: its clocks without its circuit, for runs that the circuit is too slow for.
//!
//! ```no_run
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
mod estimate;
mod event;
mod host;
mod lfb;
mod merger;
mod processor;
mod regions;
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
    /// When its reset ends.
    reset: u64,
}

/// A view whose polygons are dealt to the processing elements of a machine. A clone shares it.
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

    /// How many processing elements there are.
    pub(crate) fn processors(&self) -> u32 {
        self.config.processors
    }

    /// Deals the polygons of a view as [`Config::assign`] says; `first` is what came of the first view, unless this is it.
    ///
    /// # Errors
    /// The view is for another screen, or of another scene than the first one.
    pub fn deal(&self, view: &Arc<Projection>, first: Option<&Dealt>) -> Result<Dealt, ParameterError> {
        let first = first.map(|Dealt(view)| &view.assignment);
        Ok(Dealt(Arc::new(View::new(&self.config, view.clone(), first)?)))
    }

    /// Renders a frame of each of those views, all of one scene; the report is that of
    /// [`Machine::render_frames`](super::Machine::render_frames), with no refresh judged.
    pub fn render(&self, views: impl IntoIterator<Item = Dealt>) -> Report {
        self.observe(views, |_| {})
    }

    /// Renders as many frames of one view.
    ///
    /// # Errors
    /// As [`Model::deal`].
    pub fn still(&self, view: &Arc<Projection>, frames: usize) -> Result<Report, ParameterError> {
        let dealt = self.deal(view, None)?;
        Ok(self.render(std::iter::repeat_n(dealt, frames)))
    }

    /// As [`Model::render`]; `seen` gets all that happens. What happens at one place comes in order.
    pub fn observe(&self, views: impl IntoIterator<Item = Dealt>, seen: impl FnMut(Event)) -> Report {
        let mut run = Run::new(self, seen);
        for Dealt(view) in views {
            run.advance(u64::MAX, true);
            run.command(view);
        }
        run.advance(u64::MAX, true);
        run.advance(u64::MAX, false);
        self.report(run)
    }

    fn report<S: FnMut(Event)>(&self, run: Run<'_, S>) -> Report {
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
