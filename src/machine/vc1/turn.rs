//! Several pictures of a scene, with the camera in an orbit around it.

use std::cell::RefCell;
use std::collections::VecDeque;

use super::job::golden_of;
use crate::machine::job::Run;
use crate::scene::moved_triangles;
use crate::shell::Failure;
use tilewright_machines::vc1::{Config, Machine, Report, Shown};
use tilewright_rtl::gfb::Passes;
use tilewright_scenes::golden::pass_shifts;
use tilewright_scenes::{Frame, Projection, Scene};

/// An orbit of the camera around a scene.
pub struct Turn<'a> {
    pub config: Config,
    pub scene: &'a Scene,
    pub pictures: u32,
    /// The angle from picture to picture.
    pub degrees: f64,
}

/// The views that the machine has not shown yet, and why it has to stop.
#[derive(Default)]
struct State {
    views: VecDeque<Projection>,
    commanded: u32,
    failure: Option<Failure>,
}

impl Turn<'_> {
    /// The frames of a picture: its passes.
    fn passes(&self) -> u32 {
        self.config.accumulate.map_or(1, Passes::count)
    }

    /// All frames.
    pub fn frames(&self) -> u32 {
        self.pictures * self.passes()
    }

    /// The scene as the camera sees it in a frame.
    ///
    /// # Errors
    /// It cannot be set up.
    pub fn view(&self, frame: u32) -> Result<Projection, Failure> {
        let (picture, pass) = (frame / self.passes(), frame % self.passes());
        let shift = pass_shifts(self.passes()).map_or([0, 0], |shifts| shifts[pass as usize]);
        if picture == 0 {
            return moved_triangles(self.scene, shift);
        }
        let mut scene = self.scene.clone();
        scene.camera = scene.camera.orbited(self.degrees * f64::from(picture));
        moved_triangles(&scene, shift)
    }

    /// The views of all frames.
    ///
    /// # Errors
    /// One cannot be set up.
    pub fn views(&self) -> Result<Vec<Projection>, Failure> {
        (0..self.frames()).map(|frame| self.view(frame)).collect()
    }

    /// Renders the pictures; `seen` gets the number of each, what the display showed, and the software rasterizer's.
    ///
    /// # Errors
    /// The machine cannot be built; a view cannot be set up; Ctrl-C; a waveform cannot be written; those of `seen`.
    pub fn render(
        &self,
        run: &Run,
        mut seen: impl FnMut(u32, Frame, Frame) -> Result<(), Failure>,
    ) -> Result<Report, Failure> {
        let mut machine = Machine::new(self.config)?.on(run.engine());
        run.attach(machine.simulation())?;
        let first = self.view(0)?;
        let background = self.scene.background;
        let state = RefCell::new(State { views: [first].into(), ..State::default() });
        let next = || {
            let mut state = state.borrow_mut();
            let number = state.commanded;
            let view = match number {
                0 => state.views.front().cloned(),
                _ if number == self.frames() => None,
                _ => match self.view(number) {
                    Ok(view) => {
                        state.views.push_back(view.clone());
                        Some(view)
                    }
                    Err(failure) => {
                        state.failure = Some(failure);
                        None
                    }
                },
            };
            state.commanded += 1;
            view
        };
        let passes = self.passes();
        let shown = |shown: Shown| {
            if !(shown.number + 1).is_multiple_of(passes) {
                return true;
            }
            let views: Vec<Projection> = state.borrow_mut().views.drain(..passes as usize).collect();
            let judged = golden_of(&self.config, &views, background)
                .and_then(|golden| seen(shown.number / passes, shown.average.unwrap_or(shown.frame), golden));
            let goes_on = judged.is_ok();
            if let Err(failure) = judged {
                state.borrow_mut().failure = Some(failure);
            }
            goes_on
        };
        let report = run.watch(|watch| machine.render_frames(background, watch, next, shown), Report::picoseconds)?;
        match state.into_inner().failure {
            Some(failure) => Err(failure),
            None => Ok(report),
        }
    }
}
