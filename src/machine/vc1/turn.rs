//! Several frames of a scene around which the camera turns.

use std::cell::RefCell;
use std::collections::VecDeque;

use super::golden_of;
use crate::machine::job::Run;
use crate::scene::triangles;
use crate::shell::Failure;
use tilewright_machines::vc1::{Config, Machine, Report, Shown};
use tilewright_scenes::{Frame, Projection, Scene};

/// A turn around a scene.
pub struct Turn<'a> {
    pub config: Config,
    pub scene: &'a Scene,
    pub frames: u32,
    pub degrees: f64,
}

/// What the machine has not yet shown, and why it has to stop.
#[derive(Default)]
struct State {
    views: VecDeque<Projection>,
    commanded: u32,
    failure: Option<Failure>,
}

impl Turn<'_> {
    /// Renders the frames; `seen` gets each with the software rasterizer's.
    ///
    /// # Errors
    /// The machine cannot be built; a view cannot be set up; Ctrl-C; a waveform cannot be written; those of `seen`.
    pub fn render(
        &self,
        run: &Run,
        mut seen: impl FnMut(Shown, Frame) -> Result<(), Failure>,
    ) -> Result<Report, Failure> {
        let mut machine = Machine::new(self.config)?.on(run.engine());
        run.attach(machine.simulation())?;
        let mut scene = self.scene.clone();
        // The scene as the camera sees it in a frame.
        let mut view_of = |number: u32| {
            scene.camera = self.scene.camera.orbited(self.degrees * f64::from(number));
            triangles(&scene)
        };
        let first = view_of(0)?;
        let background = self.scene.background;
        let state = RefCell::new(State { views: [first].into(), ..State::default() });
        let next = || {
            let mut state = state.borrow_mut();
            let number = state.commanded;
            let view = match number {
                0 => state.views.front().cloned(),
                _ if number == self.frames => None,
                _ => match view_of(number) {
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
        let shown = |shown| {
            let view = state.borrow_mut().views.pop_front().expect("each frame has a view");
            let judged = golden_of(&view, background).and_then(|golden| seen(shown, golden));
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
