//! A scene on the machines, as the page asks for it.

use super::Exported;
use super::picture::{data, drawn};
use crate::machine::Machine;
use crate::shell::{Exit, Failure, progress};
use clap::ValueEnum;
use serde_json::json;
use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use tilewright_scenes::Scene;
use tilewright_view::{Answer, Page, Site};

/// The most frames that are kept: all machines at two places of the camera, and some more.
const MOST_KEPT: usize = 12;

/// A frame: its machine, and the degrees by which the camera is turned.
type Key = (Machine, i32);

/// What is known of a frame.
#[derive(Clone)]
enum State {
    /// Others are drawn before.
    Waiting,
    Drawing,
    Drawn(Arc<Vec<u8>>),
    Failed(String),
}

/// A scene, and its frames.
pub struct FrameSite {
    scene: Arc<Scene>,
    machines: Vec<Machine>,
    /// The one that is shown first.
    first: Machine,
    /// Whether the page can turn the camera.
    orbits: bool,
    shelf: Arc<Shelf>,
}

/// The frames that have been asked for; the newest is the last.
#[derive(Default)]
struct Shelf {
    frames: Mutex<VecDeque<(Key, State)>>,
    /// Raised when a frame has been asked for.
    asked: Condvar,
}

impl FrameSite {
    /// A site that draws what it is asked for, and begins with that machine.
    pub fn live(scene: Scene, first: Machine) -> FrameSite {
        let machines = Machine::value_variants().to_vec();
        let site = FrameSite { scene: Arc::new(scene), machines, first, orbits: true, shelf: Arc::default() };
        let (scene, shelf) = (site.scene.clone(), site.shelf.clone());
        // One thread draws: a machine takes all processors that it can use.
        thread::spawn(move || {
            loop {
                shelf.draw_next(&scene);
            }
        });
        site.frame((first, 0));
        site
    }

    /// A site of these machines, at least one, whose frames are drawn when they are written.
    ///
    /// # Errors
    /// A machine is named twice.
    pub fn of(scene: Scene, machines: &[Machine]) -> Result<FrameSite, Failure> {
        if let Some(twice) = (1..machines.len()).find(|at| machines[..*at].contains(&machines[*at])) {
            let name = machines[twice].name();
            return Err(Failure::new(Exit::BadInput, format!("--machine {name} is given twice: leave one out")));
        }
        let (first, shelf) = (machines[0], Arc::default());
        Ok(FrameSite { scene: Arc::new(scene), machines: machines.to_vec(), first, orbits: false, shelf })
    }

    /// The machine of a name such as `frame/vc1`.
    fn machine(&self, name: &str) -> Option<Machine> {
        let name = name.strip_prefix("frame/")?;
        self.machines.iter().copied().find(|machine| machine.name() == name)
    }

    /// What is known of a frame, which is asked for now.
    fn frame(&self, key: Key) -> State {
        let mut frames = self.shelf.lock();
        if let Some((_, state)) = frames.iter().find(|(of, _)| *of == key) {
            return state.clone();
        }
        if frames.len() == MOST_KEPT {
            frames.pop_front();
        }
        frames.push_back((key, State::Waiting));
        self.shelf.asked.notify_one();
        State::Waiting
    }
}

impl Shelf {
    fn lock(&self) -> MutexGuard<'_, VecDeque<(Key, State)>> {
        self.frames.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set(&self, key: Key, state: State) {
        if let Some((_, kept)) = self.lock().iter_mut().find(|(of, _)| *of == key) {
            *kept = state;
        }
    }

    /// Waits for a frame that has been asked for, and draws it.
    fn draw_next(&self, scene: &Scene) {
        let next = |frames: &VecDeque<(Key, State)>| {
            frames.iter().find(|(_, state)| matches!(state, State::Waiting)).map(|(key, _)| *key)
        };
        let mut frames = self.lock();
        let key @ (machine, turn) = loop {
            match next(&frames) {
                Some(key) => break key,
                None => frames = self.asked.wait(frames).unwrap_or_else(PoisonError::into_inner),
            }
        };
        drop(frames);
        self.set(key, State::Drawing);
        let camera = scene.camera.orbited(f64::from(turn));
        let turned = Scene { camera, ..scene.clone() };
        let result = std::panic::catch_unwind(|| drawn(&turned, machine));
        let state = match result {
            Ok(Ok(picture)) => State::Drawn(Arc::new(picture.json())),
            Ok(Err(failure)) => State::Failed(failure.sentences().collect::<Vec<_>>().join("; ")),
            // The sentence is on the terminal.
            Err(_) => State::Failed("this is a mistake in tilewright, please report it".to_owned()),
        };
        self.set(key, state);
    }
}

impl Site for FrameSite {
    fn page(&self) -> Page {
        Page::Frame
    }

    fn about(&self) -> String {
        let Scene { name, size, .. } = &*self.scene;
        let machine = |machine: &Machine| json!({ "name": machine.name(), "summary": machine.summary() });
        let about = json!({
            "title": format!("{name}, {size} pixels"),
            "summary": "One scene on all machines",
            "machines": self.machines.iter().map(machine).collect::<Vec<_>>(),
            "first": self.first.name(),
            "orbits": self.orbits,
        });
        about.to_string()
    }

    fn data(&self, name: &str, query: &str) -> Answer {
        let Some(machine) = self.machine(name) else { return Answer::Unknown };
        let turn = query.strip_prefix("turn=").and_then(|turn| turn.parse().ok());
        let Some(turn) = turn.filter(|turn| (-180..=180).contains(turn)) else { return Answer::Unknown };
        match self.frame((machine, turn)) {
            State::Waiting => Answer::Working { what: "waiting for another frame".to_owned(), done: None },
            State::Drawing => {
                let (what, done) = progress::now();
                Answer::Working { what: what.to_owned(), done }
            }
            State::Drawn(bytes) => Answer::Whole(bytes.to_vec()),
            State::Failed(sentence) => Answer::Refused(sentence),
        }
    }
}

impl Exported for FrameSite {
    fn whole(&self, name: &str) -> Result<Vec<u8>, Failure> {
        let machine = self.machine(name).expect("the names are those of the machines");
        data(&self.scene, machine).map_err(|failure| failure.of(machine.name()))
    }
}
