//! The comparison of circuit and model: all events and frames have to be equal.
//!
//! The circuit's events are stored until the model has reached the same time, about every thousand clocks. Then both are compared, place by place,
//! and the earliest difference is reported.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

use super::job::View;
use super::model::{Event, Model, Place, Run, What};
use super::report::{FrameReport, ProcessorReport};
use crate::error::Error;

/// The receiver of the model's events.
type Sink = Box<dyn FnMut(Event)>;

/// The model that runs beside a circuit.
pub(crate) struct Comparison<'a> {
    model: Run<'a, Sink>,
    /// The model's events since the last comparison.
    expected: Rc<RefCell<Vec<Event>>>,
    /// By place, the circuit's events that the model has not reached yet.
    seen: Vec<VecDeque<Event>>,
    /// Views that the circuit's host has commanded, and the model's host has not.
    views: VecDeque<Arc<View>>,
    /// Frames of the circuit that the model has not shown yet.
    frames: VecDeque<FrameReport>,
    /// The number of the next one.
    frame: u64,
    /// The number of equal events.
    pub compared: u64,
}

impl<'a> Comparison<'a> {
    pub fn new(model: &'a Model) -> Comparison<'a> {
        let expected = Rc::new(RefCell::new(Vec::new()));
        let sink = expected.clone();
        let places = model.processors() as usize + 2;
        Comparison {
            model: Run::new(model, Box::new(move |event| sink.borrow_mut().push(event))),
            expected,
            seen: vec![VecDeque::new(); places],
            views: VecDeque::new(),
            frames: VecDeque::new(),
            frame: 0,
            compared: 0,
        }
    }

    /// The circuit's host commands a frame of that view.
    pub fn command(&mut self, view: Arc<View>) {
        self.views.push_back(view);
    }

    /// The circuit has shown a frame.
    pub fn show(&mut self, frame: FrameReport) {
        self.frames.push_back(frame);
    }

    /// Notes an event of the circuit.
    pub fn see(&mut self, events: impl IntoIterator<Item = Event>) {
        for event in events {
            let place = self.index(event.place);
            self.seen[place].push_back(event);
        }
    }

    fn index(&self, place: Place) -> usize {
        match place {
            Place::Processor(number) => number as usize,
            Place::Bus => self.seen.len() - 2,
            Place::Merger => self.seen.len() - 1,
        }
    }

    /// Compares a refresh of the display that is judged: the edges of the processing elements' clock just before the end of its blanking, and at its
    /// first pixel.
    ///
    /// # Errors
    /// [`Error::Differs`].
    pub fn refresh(&mut self, dawn: u64, pixel: u64) -> Result<(), Error> {
        let (expected_dawn, expected_pixel) = self.model.refresh_from(dawn);
        self.equal("the display", "the end of a blanking", dawn, [dawn, expected_dawn])?;
        self.equal("the display", "the clock of the first pixel of a refresh", pixel, [pixel, expected_pixel])
    }

    /// Advances the model to that edge, which the circuit has reached, and compares.
    ///
    /// # Errors
    /// [`Error::Differs`].
    pub fn compare(&mut self, until: u64) -> Result<(), Error> {
        loop {
            self.model.advance(until, true);
            match self.views.pop_front() {
                Some(view) if self.model.may_command() => self.model.command(view),
                other => {
                    self.views.extend(other);
                    break;
                }
            }
        }
        self.model.advance(until, false);
        let mut first: Option<(u64, Error)> = None;
        let mut differs = |event: Event, seen: Option<Event>, expected: Option<Event>| {
            let time = event.picoseconds();
            if first.as_ref().is_none_or(|(earliest, _)| time < *earliest) {
                first = Some((time, difference(event, seen, expected)));
            }
        };
        let mut is_wrong = vec![false; self.seen.len()];
        for expected in self.expected.take() {
            let place = self.index(expected.place);
            if is_wrong[place] {
                continue;
            }
            let seen = self.seen[place].pop_front();
            if seen == Some(expected) {
                self.compared += 1;
                continue;
            }
            is_wrong[place] = true;
            let earlier = seen.filter(|seen| seen.clock < expected.clock).unwrap_or(expected);
            differs(earlier, seen, Some(expected));
        }
        for (events, is_wrong) in self.seen.iter().zip(is_wrong) {
            if let Some(seen) = events.front().filter(|_| !is_wrong) {
                differs(*seen, Some(*seen), None);
            }
        }
        if let Some((_, error)) = first {
            return Err(error);
        }
        while !self.frames.is_empty() && !self.model.shown.is_empty() {
            self.compare_frame()?;
        }
        Ok(())
    }

    /// Compares the next frame.
    fn compare_frame(&mut self) -> Result<(), Error> {
        let (Some(seen), Some(expected)) = (self.frames.pop_front(), self.model.shown.pop_front()) else {
            return Ok(());
        };
        let unit = format!("frame {}", self.frame);
        self.frame += 1;
        let clock = seen.times.shown.unwrap_or_default() / Event::PE_PERIOD;
        for (name, of) in FRAME {
            self.equal(&unit, name, clock, [&seen, &expected].map(of))?;
        }
        for (number, pair) in seen.processors.iter().zip(&expected.processors).enumerate() {
            let unit = format!("processing element {number} in {unit}");
            for (name, of) in PROCESSOR {
                self.equal(&unit, name, clock, [pair.0, pair.1].map(of))?;
            }
            let clocks = [pair.0, pair.1].map(|it| it.clocks.all());
            for (name, at) in CLOCKS.into_iter().zip(0..) {
                self.equal(&unit, name, clock, clocks.map(|all| all[at]))?;
            }
        }
        Ok(())
    }

    fn equal(&mut self, unit: &str, signal: &'static str, clock: u64, [seen, expected]: [u64; 2]) -> Result<(), Error> {
        if seen != expected {
            return Err(Error::Differs { unit: unit.to_owned(), signal, clock, seen, expected });
        }
        self.compared += 1;
        Ok(())
    }
}

/// A number of a report, with its name.
type Number<Report> = (&'static str, fn(&Report) -> u64);

/// Numbers of a frame.
const FRAME: [Number<FrameReport>; 9] = [
    ("the number of packets", |it| it.packets),
    ("the number of words on the bus", |it| it.words),
    ("the time of the command in ps", |it| it.times.command),
    ("the time at which all had drawn in ps", |it| it.times.drawn.unwrap_or_default()),
    ("the time at which all had swapped in ps", |it| it.times.swapped.unwrap_or_default()),
    ("the time at which it was merged in ps", |it| it.times.merged.unwrap_or_default()),
    ("the time at which it was shown in ps", |it| it.times.shown.unwrap_or_default()),
    ("the time at which its average was shown in ps", |it| it.times.averaged.unwrap_or_default()),
    ("the number of refreshes", |it| it.refreshes),
];

/// Numbers of a processing element in a frame.
const PROCESSOR: [Number<ProcessorReport>; 6] = [
    ("the number of polygons", |it| it.polygons.into()),
    ("the number of expected clocks", |it| it.expected),
    ("the number of pixels", |it| it.pixels),
    ("the number of pages", |it| it.pages.into()),
    ("the number of overflows", |it| it.overflows),
    ("the number of polygons sent", |it| it.broadcast),
];

/// Its clocks, in the sequence of [`Clocks::NAMES`](super::Clocks::NAMES).
const CLOCKS: [&str; 10] = [
    "the number of clocks of clearing",
    "the number of clocks of geometry",
    "the number of clocks of rasterization",
    "the number of clocks of sending",
    "the number of clocks of receiving",
    "the number of stalled clocks",
    "the number of clocks of waiting for the bus",
    "the number of clocks of waiting in overflows",
    "the number of clocks of waiting for the sync line",
    "the number of clocks of waiting for the swap",
];

/// The difference between the circuit's and the model's events; `event` is the earlier one.
fn difference(event: Event, seen: Option<Event>, expected: Option<Event>) -> Error {
    let unit = match event.place {
        Place::Processor(number) => format!("processing element {number}"),
        Place::Bus => "the bus".to_owned(),
        Place::Merger => "the merger".to_owned(),
    };
    let at = |other: Option<Event>| other.filter(|it| it.clock == event.clock && it.what.kind() == event.what.kind());
    let (signal, [seen, expected]) = match (at(seen), at(expected)) {
        (Some(seen), Some(expected)) => (event.what.value_name(), [seen, expected].map(|it| it.what.value())),
        (seen, expected) => (event.what.kind(), [seen, expected].map(|it| it.is_some().into())),
    };
    Error::Differs { unit, signal, clock: event.clock, seen, expected }
}

impl What {
    /// The name of an event's count in a clock.
    pub(crate) fn kind(self) -> &'static str {
        match self {
            What::Draws(_) => "the number of pixels taken",
            What::Clears(_) => "the number of entries cleared",
            What::Receives(_) => "the number of words received",
            What::Ends => "the number of program ends",
            What::Due => "the number of sync lines seen",
            What::Overflows => "the number of overflows",
            What::Swaps => "the number of swaps",
            What::Resumes => "the number of resumptions",
            What::Carries(..) => "the number of words taken",
            What::Restarts => "the number of scan restarts",
            What::Shows(_) => "the number of changes of the banks",
        }
    }

    /// The name and the value of an event's data.
    fn value_name(self) -> &'static str {
        match self {
            What::Draws(_) => "the pixel taken",
            What::Clears(_) => "the entry cleared",
            What::Receives(_) => "the word received",
            What::Carries(..) => "the sender above its word",
            What::Shows(_) => "the ordinal of a change of the banks",
            other => other.kind(),
        }
    }

    fn value(self) -> u64 {
        match self {
            What::Draws(it) | What::Clears(it) | What::Receives(it) | What::Shows(it) => it.into(),
            What::Carries(sender, word) => u64::from(sender) << 32 | u64::from(word),
            What::Ends | What::Due | What::Overflows | What::Swaps | What::Resumes | What::Restarts => 1,
        }
    }
}

#[cfg(test)]
mod tests;
