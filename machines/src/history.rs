//! What a machine did in the time of a frame: the unit and the time of each written pixel, and the activity of each unit in its clocks.
//!
//! A machine with a [`Recorder`] fills it while it renders. Without one, nothing is kept of a frame.

use std::sync::{Arc, Mutex, PoisonError};

use crate::areas::Area;
use tilewright_scenes::frame::blank;
use tilewright_scenes::{Frame, Size};

/// The place for the history of the last frame that a machine rendered. Clones share it.
///
/// ```
/// use tilewright_machines::{Recorder, Watch, quadtree};
/// use tilewright_scenes::{Scene, Size, project_polygons};
///
/// let (scene, size) = (Scene::builtin("teapot").expect("a built-in scene"), Size::new(16, 12)?);
/// let packets = project_polygons(&scene, size)?.polygons;
/// let recorder = Recorder::default();
/// let mut machine = quadtree::Machine::new(quadtree::Config::for_packets(size, &packets))?.recorded(&recorder);
/// let (frame, _) = machine.render(&packets, scene.background, &mut Watch::default())?;
/// let history = recorder.take().expect("a frame was rendered");
/// assert_eq!(history.picture_at(u64::MAX), frame);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    history: Arc<Mutex<Option<History>>>,
    /// Whether areas are recorded, too.
    pub(crate) has_areas: bool,
}

impl Recorder {
    /// One that also records the areas that units work on, which takes longer.
    pub fn with_areas() -> Recorder {
        Recorder { has_areas: true, ..Recorder::default() }
    }

    /// Takes the history of the last frame.
    pub fn take(&self) -> Option<History> {
        self.history.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    pub(crate) fn put(&self, history: History) {
        *self.history.lock().unwrap_or_else(PoisonError::into_inner) = Some(history);
    }
}

/// The history of a frame. All times are simulated picoseconds from the beginning of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// The size of the picture.
    pub size: Size,
    /// The colour of pixels that nothing covers.
    pub background: [u8; 3],
    /// The width and height of the regions that are drawn one by one, if the machine has regions.
    pub region: Option<[u32; 2]>,
    /// The names of the units that draw, by number, such as `PE 3`.
    pub painters: Vec<String>,
    /// Each change of a pixel, by time.
    pub writes: Vec<Write>,
    /// The activities of units, in the sequence of a chart.
    pub lanes: Vec<Lane>,
    /// The areas that units work on by their begin, if they are recorded and the machine has them.
    pub areas: Vec<Area>,
}

/// A change of a pixel by a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Write {
    /// The time in picoseconds.
    pub time: u64,
    /// The number of the pixel in raster order.
    pub pixel: u32,
    /// The number of the unit.
    pub painter: u32,
    /// The new word of the pixel: depth above colour.
    pub word: u64,
}

/// The activities of a unit, or of several similar units.
#[derive(Clone, Debug, PartialEq)]
pub struct Lane {
    /// Its name, such as `PE 3`.
    pub name: String,
    /// The unit of its spans' amounts: `clocks` or `bits`.
    pub of: &'static str,
    /// The greatest amount in a picosecond.
    pub rate: f64,
    /// The spans, sorted by time.
    pub spans: Vec<Span>,
}

/// An activity of a unit for a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The activity, such as `clearing`.
    pub what: &'static str,
    /// The begin, in picoseconds.
    pub from: u64,
    /// The end, in picoseconds.
    pub to: u64,
    /// The amount: all clocks of that time, or fewer if the unit did it only in some of them.
    pub amount: u64,
}

impl Lane {
    /// One unit, or several, with clocks of that period.
    pub(crate) fn of_clocks(name: impl Into<String>, period: u64, units: u32) -> Lane {
        Lane { name: name.into(), of: "clocks", rate: f64::from(units) / period as f64, spans: Vec::new() }
    }

    /// Adds a span unless it is empty, or lengthens the last span if the activity continues.
    pub(crate) fn add(&mut self, what: &'static str, from: u64, to: u64, amount: u64) {
        if amount == 0 || from == to {
            return;
        }
        let next = Span { what, from, to, amount };
        let (rate, is_full) = (self.rate, next.is_full(self.rate));
        let goes_on = |last: &&mut Span| is_full && last.what == what && last.to == from && last.is_full(rate);
        match self.spans.last_mut().filter(goes_on) {
            Some(last) => (last.to, last.amount) = (to, last.amount + amount),
            None => self.spans.push(next),
        }
    }

    /// The total amount of an activity.
    ///
    /// ```
    /// use tilewright_machines::{Lane, Span};
    ///
    /// let spans = [(0, 30, 3), (50, 90, 2)].map(|(from, to, amount)| Span { what: "drawing", from, to, amount });
    /// let lane = Lane { name: "PE 0".to_owned(), of: "clocks", rate: 0.1, spans: spans.to_vec() };
    /// assert_eq!((lane.amount("drawing"), lane.amount("clearing")), (5, 0));
    /// ```
    pub fn amount(&self, what: &str) -> u64 {
        self.spans.iter().filter(|span| span.what == what).map(|span| span.amount).sum()
    }
}

impl Span {
    /// Whether it took all of the unit's time.
    fn is_full(&self, rate: f64) -> bool {
        self.amount as f64 >= (self.to - self.from) as f64 * rate * (1.0 - 1e-9)
    }
}

impl History {
    /// For each pixel in raster order, the number of the unit whose word it has at the end; `None` where nothing was drawn.
    pub fn owners(&self) -> Vec<Option<u32>> {
        let mut owners = vec![None; self.size.pixels()];
        self.writes.iter().for_each(|write| owners[write.pixel as usize] = Some(write.painter));
        owners
    }

    /// The picture at that time, with all pixels that were written until then.
    pub fn picture_at(&self, time: u64) -> Frame {
        let mut frame = Frame::blank(self.size, self.background);
        let until = self.writes.partition_point(|write| write.time <= time);
        self.writes[..until].iter().for_each(|write| frame.words[write.pixel as usize] = write.word);
        frame
    }
}

/// A picture that is being written, and its changes so far.
#[derive(Debug)]
pub(crate) struct Painting {
    size: Size,
    background: [u8; 3],
    words: Vec<u64>,
    writes: Vec<Write>,
}

impl Painting {
    /// One that is empty.
    pub fn new(size: Size, background: [u8; 3]) -> Painting {
        Painting { size, background, words: vec![blank(background); size.pixels()], writes: Vec::new() }
    }

    /// A unit has a word for a pixel. The pixel takes it if the rule prefers it to the old word.
    pub fn draw(&mut self, write: Write, is_nearer: impl Fn(u64, u64) -> bool) {
        let kept = &mut self.words[write.pixel as usize];
        if is_nearer(write.word, *kept) {
            *kept = write.word;
            self.writes.push(write);
        }
    }

    /// The history of the frame, with the names of units and their activities.
    pub fn into_history(self, painters: Vec<String>, lanes: Vec<Lane>) -> History {
        let Painting { size, background, mut writes, .. } = self;
        // Stable: changes at the same time keep their sequence.
        writes.sort_by_key(|write| write.time);
        History { size, background, region: None, painters, writes, lanes, areas: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_has_what_was_nearest_until_a_time() {
        let size = Size::new(2, 1).expect("in range");
        let mut painting = Painting::new(size, [7; 3]);
        let words = [(30, 1, 90), (10, 0, 50), (20, 0, 60)];
        for (time, painter, word) in words {
            painting.draw(Write { time, pixel: 1, painter, word }, |new, kept| new < kept);
        }
        let history = painting.into_history(vec!["a".to_owned(), "b".to_owned()], Vec::new());
        assert_eq!(history.writes.iter().map(|it| it.word).collect::<Vec<_>>(), [50, 90]);
        assert_eq!(history.picture_at(9).words, [blank([7; 3]); 2]);
        assert_eq!(history.picture_at(10).words, [blank([7; 3]), 50]);
        assert_eq!(history.owners(), [None, Some(1)]);
    }

    #[test]
    fn what_goes_on_is_one_span() {
        let mut lane = Lane::of_clocks("unit", 10, 1);
        for (what, from, to, amount) in
            [("a", 0, 30, 3), ("a", 30, 50, 2), ("a", 50, 90, 1), ("a", 90, 100, 1), ("b", 100, 100, 0)]
        {
            lane.add(what, from, to, amount);
        }
        let spans: Vec<_> = lane.spans.iter().map(|span| (span.from, span.to, span.amount)).collect();
        assert_eq!(spans, [(0, 50, 5), (50, 90, 1), (90, 100, 1)]);
    }
}
