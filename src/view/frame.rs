//! A scene on the machines, as the page asks for it.

use super::Exported;
use super::areas::{self, areas};
use super::moment::{Moment, moment};
use super::picture::drawn;
use super::query::Query;
use super::shelf::{Shelf, State, Wish};
use super::way::{PixelWay, way};
use crate::machine::Machine;
use crate::shell::{Exit, Failure, progress};
use clap::ValueEnum;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread;
use std::time::Duration;
use tilewright_scenes::Scene;
use tilewright_view::{Answer, Page, Site};

/// How long a question waits for its answer before the page is told what is being done.
const PATIENCE: Duration = Duration::from_millis(100);

/// A scene, and its frames.
pub struct FrameSite {
    scene: Arc<Scene>,
    machines: Vec<Machine>,
    /// The one that is shown first.
    first: Machine,
    /// Whether there is a server, which draws what the page asks for.
    is_live: bool,
    shelf: Arc<Shelf<Asked, Made>>,
}

/// What a page asks for: of a machine, and with the camera turned by those degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Asked {
    machine: Machine,
    turn: i32,
    what: What,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum What {
    Frame,
    /// The areas that its units work on.
    Areas,
    /// The way of that pixel.
    Way([u32; 2]),
    /// The block at a step of the way of a pixel.
    Moment([u32; 2], usize),
}

#[derive(Clone)]
enum Made {
    /// A frame, or its areas.
    Data(Arc<Vec<u8>>),
    Way(Arc<PixelWay>),
    Moment(Arc<Moment>),
}

impl Wish for Asked {
    /// All machines at two places of the camera, and some more.
    const MOST: usize = 12;

    fn kind(&self) -> usize {
        match self.what {
            What::Frame => 0,
            What::Areas => 1,
            What::Way(_) => 2,
            What::Moment(..) => 3,
        }
    }

    /// Pixels of another picture, another pixel, or another step.
    fn is_superseded(&self, by: &Asked) -> bool {
        match (self.what, by.what) {
            (What::Frame | What::Areas, _) | (_, What::Areas) => false,
            (_, What::Frame) => self.turn != by.turn,
            (What::Way(pixel), What::Way(other)) => self.turn != by.turn || pixel != other,
            (What::Way(_), What::Moment(..)) => false,
            (What::Moment(..), _) => self != by,
        }
    }
}

impl FrameSite {
    /// A site that draws what it is asked for, and begins with that machine.
    pub fn live(scene: Scene, first: Machine) -> FrameSite {
        let machines = Machine::value_variants().to_vec();
        let site = FrameSite { scene: Arc::new(scene), machines, first, is_live: true, shelf: Arc::new(Shelf::new()) };
        let (scene, shelf) = (site.scene.clone(), site.shelf.clone());
        // One thread draws: a machine takes all processors that it can use.
        thread::spawn(move || {
            loop {
                shelf.make_next(|asked, stop| make(&scene, &shelf, asked, stop));
            }
        });
        site.shelf.ask(Asked { machine: first, turn: 0, what: What::Frame });
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
        let (first, shelf) = (machines[0], Arc::new(Shelf::new()));
        Ok(FrameSite { scene: Arc::new(scene), machines: machines.to_vec(), first, is_live: false, shelf })
    }

    /// The machine of a name such as `frame/vc1`, and what is asked of it.
    fn machine<'a>(&self, name: &'a str) -> Option<(&'a str, Machine)> {
        let (what, name) = name.split_once('/')?;
        self.machines.iter().copied().find(|machine| machine.name() == name).map(|machine| (what, machine))
    }

    /// What a name and a query ask for.
    fn asked(&self, name: &str, query: &Query) -> Option<Asked> {
        let (what, machine) = self.machine(name)?;
        let turn = query.number("turn").filter(|turn| (-180..=180).contains(turn))?;
        let pixel = || Some([query.number("x")?, query.number("y")?]);
        let what = match what {
            "frame" => What::Frame,
            "areas" if areas::name(machine).is_some() => What::Areas,
            "way" => What::Way(pixel()?),
            "moment" => What::Moment(pixel()?, query.number("step")?),
            _ => return None,
        };
        Some(Asked { machine, turn, what })
    }
}

/// Makes what is asked for.
fn make(scene: &Scene, shelf: &Shelf<Asked, Made>, asked: Asked, stop: &AtomicBool) -> Result<Made, Failure> {
    let Asked { machine, turn, what } = asked;
    let scene = Scene { camera: scene.camera.orbited(f64::from(turn)), ..scene.clone() };
    Ok(match what {
        What::Frame => Made::Data(Arc::new(drawn(&scene, machine)?.json())),
        What::Areas => Made::Data(Arc::new(areas(&scene, machine, Some(stop))?.json())),
        What::Way(pixel) => Made::Way(Arc::new(way(&scene, machine, pixel, stop)?)),
        What::Moment(pixel, number) => {
            let known = match shelf.made(Asked { what: What::Way(pixel), ..asked }) {
                Some(Made::Way(known)) => known,
                _ => Arc::new(way(&scene, machine, pixel, stop)?),
            };
            let Some(step) = known.way.steps.get(number) else {
                let sentence = format!("the way of the pixel has {} steps", known.way.steps.len());
                return Err(Failure::new(Exit::BadInput, sentence));
            };
            Made::Moment(Arc::new(moment(&scene, machine, (pixel, step), stop)?))
        }
    })
}

impl Made {
    /// The data that the page reads.
    fn answer(&self, query: &Query) -> Answer {
        let whole = |value: &Value| Answer::Whole(value.to_string().into_bytes());
        match self {
            Made::Data(bytes) => Answer::Whole(bytes.to_vec()),
            Made::Way(way) => whole(&way.told),
            Made::Moment(moment) => match query.number("unit").map_or(Ok(None), |unit| moment.unit(unit)) {
                Ok(Some(value)) => whole(&value),
                Ok(None) => Answer::Unknown,
                Err(failure) => refused(&failure),
            },
        }
    }
}

/// A failure as the page tells it.
pub fn refused(failure: &Failure) -> Answer {
    Answer::Refused(failure.line())
}

impl Site for FrameSite {
    fn page(&self) -> Page {
        Page::Frame
    }

    fn about(&self) -> String {
        let Scene { name, size, .. } = &*self.scene;
        let machine = |machine: &Machine| json!({ "name": machine.name(), "summary": machine.summary(), "areas": areas::name(*machine) });
        let about = json!({
            "title": format!("{name}, {size} pixels"),
            "summary": "One scene on all machines",
            "machines": self.machines.iter().map(machine).collect::<Vec<_>>(),
            "first": self.first.name(),
            "orbits": self.is_live,
        });
        about.to_string()
    }

    fn data(&self, name: &str, query: &str) -> Answer {
        let query = Query::of(query);
        let Some(asked) = self.asked(name, &query) else { return Answer::Unknown };
        if query.has("stop") {
            self.shelf.forget(asked);
            return Answer::Whole(b"null".to_vec());
        }
        match self.shelf.ask_and_wait(asked, PATIENCE) {
            State::Waiting => Answer::Working { what: "waiting for other work".to_owned(), done: None },
            State::Working => {
                let (what, done) = progress::now();
                Answer::Working { what: what.to_owned(), done }
            }
            State::Made(made) => made.answer(&query),
            State::Failed(sentence) => Answer::Refused(sentence),
            State::Stopped => Answer::Refused("something else was asked for meanwhile: ask again".to_owned()),
        }
    }
}

impl Exported for FrameSite {
    fn whole(&self, name: &str) -> Result<Vec<u8>, Failure> {
        let (what, machine) = self.machine(name).expect("the names are those of the machines");
        let data = if what == "areas" {
            areas(&self.scene, machine, None).map(|areas| areas.json())
        } else {
            drawn(&self.scene, machine).map(|picture| picture.json())
        };
        data.map_err(|failure| failure.of(machine.name()))
    }
}
