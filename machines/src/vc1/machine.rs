//! A whole VC-1: built for a configuration, it renders frames and reports.

use tilewright_rtl::vc1::{Vc1In, Vc1Out};
use tilewright_scenes::{Frame, Projection};
use tilewright_sim::{EngineKind, Simulation};

use super::config::Config;
use super::hardware::Hardware;
use super::history;
use super::host::Host;
use super::job::Views;
use super::model::Model;
use super::pages::Pages;
use super::processor::Processor;
use super::program::Settings;
use super::report::{Report, Shown};
use super::way::Following;
use crate::error::Error;
use crate::history::{History, Painting, Recorder};
use crate::run::Watch;
use crate::way::Follower;

/// A VC-1, switched off.
pub struct Machine {
    config: Config,
    hardware: Hardware,
    judges_every_refresh: bool,
    recorder: Option<Recorder>,
    follower: Option<Follower>,
}

impl Machine {
    /// Builds the machine.
    ///
    /// # Errors
    /// [`Error::Parameter`] if a parameter is out of range.
    pub fn new(config: Config) -> Result<Machine, Error> {
        let hardware = Hardware::new(&config.hardware()?)?;
        Ok(Machine { config, hardware, judges_every_refresh: false, recorder: None, follower: None })
    }

    /// The same machine, which compares every refresh of its display with its frame buffer. Usually it compares only the first one of each
    /// frame and each average.
    pub fn judging_every_refresh(mut self) -> Machine {
        self.judges_every_refresh = true;
        self
    }

    /// The same machine on that engine of the simulator; the compiled one is the default.
    ///
    /// # Panics
    /// A trace is attached.
    #[track_caller]
    pub fn on(mut self, engine: EngineKind) -> Machine {
        self.hardware.sim = self.hardware.sim.on(engine);
        self
    }

    /// The same machine with a recorder. Pixels are written when a local frame buffer takes them. As in the merger, the least word of a pixel stays.
    /// Several frames are all written into one picture.
    pub fn recorded(mut self, recorder: &Recorder) -> Machine {
        self.recorder = Some(recorder.clone());
        self
    }

    /// The same machine with a follower of a pixel on its screen. It does not stop at what it checks itself, as the way tells it. A frame then has
    /// the colours that the display got. What differed from the model's clocks is its error at the end.
    ///
    /// # Panics
    /// The pixel is outside of the screen.
    #[track_caller]
    pub fn following(mut self, follower: &Follower) -> Machine {
        let (size, [x, y]) = (self.config.size, follower.pixel);
        assert!(x < size.width() && y < size.height(), "pixel {x},{y} is outside of a screen of {size}");
        self.follower = Some(follower.clone());
        self
    }

    /// The simulated hardware, for attaching traces. [`Machine::render`] ends them, also on errors.
    pub fn simulation(&mut self) -> &mut Simulation<Vc1In, Vc1Out> {
        &mut self.hardware.sim
    }

    /// Renders a frame, or a picture with equal passes. Returns the display's colours with the depths of the global frame buffer, and the
    /// report.
    ///
    /// # Errors
    /// As [`Machine::render_frames`].
    pub fn render(
        self,
        projection: &Projection,
        background: [u8; 3],
        watch: &mut Watch,
    ) -> Result<(Frame, Report), Error> {
        let passes = self.config.accumulate.map_or(1, |passes| passes.count() as usize);
        let (mut views, mut frame) = (std::iter::repeat_n(projection, passes).cloned(), None);
        let seen = |shown: Shown| {
            frame = Some(shown.average.unwrap_or(shown.frame));
            true
        };
        let report = self.render_frames(background, watch, || views.next(), seen)?;
        Ok((frame.expect("a view has a frame"), report))
    }

    /// Renders a frame of each of those views, all of one scene. With [`Config::accumulate`] a view is that of a pass, and the last picture
    /// has to be complete. `seen` gets each frame after its first refresh, and returns whether to go on. There has to be at least one
    /// view.
    ///
    /// # Errors
    /// [`Error::Parameter`] if a projection is for another screen, or of another scene than the first one;
    /// [`Error::Displayed`]; [`Error::Cancelled`]; [`Error::Simulation`]; [`Error::Untraced`].
    ///
    /// # Panics
    /// There is no view.
    pub fn render_frames(
        mut self,
        background: [u8; 3],
        watch: &mut Watch,
        views: impl FnMut() -> Option<Projection>,
        seen: impl FnMut(Shown) -> bool,
    ) -> Result<Report, Error> {
        let rendered = self.run(background, watch, views, seen);
        if let (Some(following), Err(error)) = (&mut self.hardware.following, &rendered) {
            following.fails(&mut self.hardware.sim, error);
        }
        // It leaves the way.
        self.hardware.following = None;
        Error::of_both(rendered, self.hardware.sim.finish())
    }

    /// Events of the circuit are changed by that function.
    #[cfg(test)]
    pub(crate) fn falsify(&mut self, falsify: impl Fn(super::model::Event) -> Option<super::model::Event> + 'static) {
        self.hardware.notes.falsify = Some(Box::new(falsify));
    }

    fn run(
        &mut self,
        background: [u8; 3],
        watch: &mut Watch,
        mut views: impl FnMut() -> Option<Projection>,
        mut seen: impl FnMut(Shown) -> bool,
    ) -> Result<Report, Error> {
        let patches = self.config.patches()?.count();
        let known = Views::default();
        let of = |number| Processor::new(Settings::of(&self.config, number, patches), known.clone());
        let mut processors: Vec<_> = (0..self.config.processors).map(of).collect();
        if let Some(follower) = &self.follower {
            let following = Following::new(follower, &self.config.hardware()?, background);
            self.hardware.following = Some(Box::new(following));
        }
        self.hardware.reset(background, self.config.accumulate)?;
        let begun = self.hardware.edge();
        if self.recorder.is_some() {
            self.hardware.notes.painting = Some(Painting::new(self.config.size, background));
            let screen = [self.config.size.width(), self.config.size.height()];
            let pages = self.recorder.as_ref().filter(|it| it.has_areas);
            self.hardware.notes.pages = pages.map(|_| Pages::new(self.config.patch, screen, self.config.processors));
            processors = processors.into_iter().map(Processor::logged).collect();
        }
        let mut report = Report {
            machine: self.config.built()?,
            polygons: 0,
            load_words: 0,
            merge_clocks: self.hardware.merge_clocks,
            judged: 0,
            compared: 0,
            frames: Vec::new(),
        };
        let model = Model::new(self.config)?;
        let every = self.judges_every_refresh;
        let mut host = Host::new(self.config, &mut self.hardware, watch, known, every, &model);
        host.run(&mut processors, &mut views, &mut |shown| {
            report.frames.push(shown.report.clone());
            seen(shown)
        })?;
        (report.polygons, report.load_words) = (host.scene.polygons, host.scene.words);
        (report.judged, report.compared) = (host.judged(), host.compared());
        if let (Some(recorder), Some(painting)) = (&self.recorder, self.hardware.notes.painting.take()) {
            let areas = self.hardware.notes.pages.take().map_or_else(Vec::new, Pages::into_areas);
            recorder.put(History { areas, ..history::of(painting, &processors, begun, &report) });
        }
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::{Scene, Size, compare, golden, project};

    /// A bus that flips a bit is where the way of a pixel first differs, and the run goes on to the wrong frame.
    #[test]
    fn a_bus_that_changes_words_is_the_first_difference() {
        let scene = Scene::builtin("star").unwrap();
        let projection = project(&scene, Size::new(16, 12).unwrap()).unwrap();
        let config = Config { processors: 2, apr: Some(0), refresh: 5000.0, ..Config::new(projection.size) };
        let golden = golden::render(projection.size, &projection.triangles, scene.background);
        let follower = Follower::new([8, 6]);
        let mut machine = Machine::new(config).unwrap().following(&follower);
        machine.hardware.flips = 0x80_0000;
        let (frame, _) = machine.render(&projection, scene.background, &mut Watch::default()).unwrap();
        assert!(compare(&frame, &golden).differing > 0);
        let way = follower.take().unwrap();
        let step = way.first_difference().unwrap();
        assert_eq!((step.block, step.values[0].what), ("broadcast-bus", "word"));
    }

    /// The last word of a packet is the colour of its third vertex. A flipped bit of it is visible in the frame (VC1-APR).
    #[test]
    fn what_is_drawn_is_what_came_over_the_bus() {
        let scene = Scene::builtin("table").unwrap();
        let projection = project(&scene, Size::new(64, 48).unwrap()).unwrap();
        let golden = golden::render(projection.size, &projection.triangles, [0; 3]);
        let differing = |apr, flips| {
            let config = Config { processors: 3, apr, refresh: 5000.0, ..Config::new(projection.size) };
            let mut machine = Machine::new(config).unwrap();
            machine.hardware.flips = flips;
            let (frame, _) = machine.render(&projection, [0; 3], &mut Watch::default()).unwrap();
            compare(&frame, &golden).differing
        };
        assert_eq!(differing(Some(20), 0), 0);
        assert!(differing(Some(20), 0x80_0000) > 100);
        assert_eq!(
            differing(None, 0x80_0000),
            0,
            "without polygons on the bus nothing is flipped but a command's view"
        );
    }
}
