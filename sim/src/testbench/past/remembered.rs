//! The checkpoints and changes that are remembered, and the run between them.

use tilewright_hdl::DEFAULT_PERIOD;

use crate::engine::program::Triggers;
use crate::engine::state_limbs;
use crate::testbench::checkpoint::Checkpoint;
use crate::testbench::condition::Condition;
use crate::testbench::error::Error;
use crate::testbench::past::Unremembered;
use crate::testbench::past::log::{Change, Log, Place};
use crate::testbench::port::Port;
use crate::testbench::running::Running;

/// The fewest instants between two checkpoints, and how many there are for each limb of the state: so many take much
/// longer than to copy the state.
const FEWEST: u64 = 65_536;
const FOR_EACH_LIMB: u64 = 8;

/// What a simulation remembers.
pub(crate) struct Past {
    /// The most bytes.
    most: usize,
    /// The time between two checkpoints, in picoseconds.
    interval: u64,
    /// The time of the next one.
    due: u64,
    /// The checkpoints, the earliest first.
    pub(super) points: Vec<Point>,
    /// The changes since the first checkpoint.
    pub(super) changes: Log,
    /// The bytes of those before the last checkpoint.
    before: usize,
    /// The length of the log at which something is to do before the next change.
    full: usize,
    /// In the past, the next change to make; in the present there is none.
    pub(super) next: Option<Place>,
    /// The latest time that was reached.
    present: u64,
}

/// A checkpoint, its place among the changes, and the bytes that it takes beside the point before.
pub(super) struct Point {
    pub checkpoint: Checkpoint,
    pub changes: Place,
    pub bytes: usize,
    /// It is there only while somebody looks at many earlier times.
    pub is_passing: bool,
}

impl Point {
    fn new(checkpoint: Checkpoint, changes: Place, before: Option<&Point>) -> Point {
        let bytes = checkpoint.saved.bytes_beside(before.map(|point| &point.checkpoint.saved));
        Point { checkpoint, changes, bytes, is_passing: false }
    }
}

impl Past {
    /// Nothing but this checkpoint, as a beginning.
    fn from(checkpoint: Checkpoint, most: usize, interval: u64) -> Past {
        let (present, due) = (checkpoint.time(), checkpoint.time().saturating_add(interval));
        let changes = Log::from(present);
        let points = vec![Point::new(checkpoint, changes.end(), None)];
        let mut past = Past { most, interval, due, points, changes, before: 0, full: 0, next: None, present };
        past.make_room();
        past
    }

    /// The most bytes that it may have.
    pub fn most(&self) -> usize {
        self.most
    }

    /// The time at which something is to do.
    fn pause(&self) -> u64 {
        let next = self.next.and_then(|next| self.changes.after(next));
        next.map_or(self.due, |(_, after)| self.due.min(after.time))
    }

    /// Prepares for changes at this time. What was remembered of later is forgotten.
    #[cold]
    fn prepare(&mut self, now: u64) {
        if let Some(next) = self.next.take() {
            self.fork(now, next);
        }
        self.make_room();
        if self.changes.len() >= self.full {
            self.due = now;
        }
    }

    /// Forgets what comes after this time, and the changes from a place on.
    fn fork(&mut self, now: u64, next: Place) {
        self.changes.truncate(next);
        self.points.retain(|point| point.checkpoint.time() <= now);
        self.present = now;
        self.before = self.changes.bytes(self.points[0].changes, self.last().changes);
        self.due = self.last().checkpoint.time().saturating_add(self.interval);
    }

    /// Sets how many changes there may be before the next checkpoint.
    fn make_room(&mut self) {
        let room = (self.most / 4).saturating_sub(self.recent());
        self.full = self.changes.len() + room / Log::ENTRY;
    }

    /// The bytes of the changes since the last checkpoint.
    fn recent(&self) -> usize {
        self.changes.bytes(self.last().changes, self.changes.end())
    }

    fn last(&self) -> &Point {
        self.points.last().expect("the first point stays until there is another")
    }

    /// The bytes of all that is remembered.
    fn bytes(&self) -> usize {
        self.before + self.recent() + self.points.iter().map(|point| point.bytes).sum::<usize>()
    }

    /// Points have other points before them than they had.
    fn measure(&mut self) {
        for index in 0..self.points.len() {
            let before = index.checked_sub(1).map(|before| &self.points[before].checkpoint.saved);
            self.points[index].bytes = self.points[index].checkpoint.saved.bytes_beside(before);
        }
    }

    /// Adds a checkpoint of the present, and forgets until all fits.
    fn add(&mut self, checkpoint: Checkpoint) {
        self.before += self.recent();
        self.present = checkpoint.time();
        // All changes have been made: this is the present.
        self.next = None;
        self.points.push(Point::new(checkpoint, self.changes.end(), self.points.last()));
        while self.points.len() > 1 && self.bytes() > self.most {
            if self.points.len() == 2 || self.before > self.most / 2 {
                self.forget();
            } else {
                self.thin();
            }
            self.measure();
        }
        self.due = self.present.saturating_add(self.interval);
        self.make_room();
    }

    /// Forgets the time before the second checkpoint.
    fn forget(&mut self) {
        let first = self.points.remove(0).changes;
        let gone = self.points[0].changes;
        self.before -= self.changes.bytes(first, gone);
        self.changes.forget(gone);
        self.points.iter_mut().for_each(|point| point.changes = point.changes.without(gone));
        self.next = self.next.map(|next| next.without(gone));
    }

    /// Leaves every second checkpoint out, but neither the first nor the last.
    fn thin(&mut self) {
        let (mut index, last) = (0, self.points.len() - 1);
        self.points.retain(|_| {
            index += 1;
            (index - 1) % 2 == 0 || index - 1 == last
        });
        self.interval = self.interval.saturating_mul(2);
    }

    /// The last checkpoint up to this time.
    pub(super) fn before(&self, time: u64) -> Result<usize, Unremembered> {
        let count = self.points.partition_point(|point| point.checkpoint.time() <= time);
        let earliest = self.points[0].checkpoint.time();
        count.checked_sub(1).ok_or(Unremembered::Forgotten { time, earliest })
    }
}

impl Running {
    /// Remembers the past from now on.
    pub fn remember(&mut self, most: usize) {
        self.remember_often(most, FEWEST.max(FOR_EACH_LIMB * state_limbs(&self.program) as u64));
    }

    /// Remembers with a checkpoint after so many instants of the first clock.
    pub fn remember_often(&mut self, most: usize, instants: u64) {
        let period = self.program.clocks.first().map_or(DEFAULT_PERIOD.picoseconds(), |clock| clock.period);
        let past = Past::from(self.checkpoint(None), most, instants.saturating_mul(period));
        self.past = Some(Box::new(past));
        self.pause_at = self.next_pause();
    }

    /// Notes a change, if anything is remembered.
    #[inline]
    pub fn note(&mut self, change: impl FnOnce() -> Change) {
        if let Some(past) = &mut self.past {
            let now = self.timeline.time();
            if past.changes.len() >= past.full {
                past.prepare(now);
                self.pause_at = past.due.min(self.resting.until());
            }
            let beside = past.changes.push(now, change());
            past.full = past.full.saturating_sub(beside / Log::ENTRY);
        }
    }

    /// Whether something is to do before the next instant.
    pub fn is_due(&self) -> bool {
        self.pause_at != u64::MAX && self.timeline.time() >= self.pause_at
    }

    /// The time at which something is to do.
    pub fn next_pause(&self) -> u64 {
        self.past.as_ref().map_or(u64::MAX, |past| past.pause()).min(self.resting.until())
    }

    /// Does what is due before the next instant.
    #[inline]
    pub fn attend(&mut self) {
        if self.is_due() {
            self.catch_up();
        }
    }

    /// Wakes observers, and goes on in the past.
    #[cold]
    pub(super) fn catch_up(&mut self) {
        self.wake();
        self.change_as_in_past();
        self.pause_at = self.next_pause();
    }

    /// Makes the changes of this time in the past, and keeps a checkpoint in the present.
    fn change_as_in_past(&mut self) {
        let Some(mut past) = self.past.take() else { return };
        let now = self.timeline.time();
        while let Some((change, after)) = past.next.and_then(|next| past.changes.after(next))
            && after.time <= now
        {
            self.make(&change);
            past.next = Some(after);
        }
        if now >= past.due {
            past.add(self.checkpoint(Some(&past.last().checkpoint.saved)));
        }
        self.past = Some(past);
    }

    /// How many instants of the only clock come before something is to do; at least 1.
    pub fn until_pause(&self) -> u64 {
        match (self.pause_at, &self.program.clocks[..]) {
            (u64::MAX, _) | (_, []) => u64::MAX,
            (pause, [clock, ..]) => pause.saturating_sub(self.timeline.time()).div_ceil(clock.period).max(1),
        }
    }

    fn make(&mut self, change: &Change) {
        match change {
            Change::Input(port, limb) => self.write(Port { index: *port }, &[*limb]),
            Change::Wide(wide) => self.write(Port { index: wide.0 }, &wide.1),
            Change::Reset(clock, is_active) => self.set_reset(*clock as usize, *is_active),
            Change::Word(word) => {
                let ([memory, lane, address], limbs) = &**word;
                self.engine.set_word(*memory, *lane, *address, limbs);
                self.may_have_changed(Triggers::ALL);
            }
        }
    }

    /// Goes to a time.
    #[track_caller]
    pub fn go_to(&mut self, time: u64) -> Result<(), Error> {
        let now = self.timeline.time();
        if time < now {
            self.check_no_trace();
            let past = self.past.as_mut().ok_or(Unremembered::Nothing { now })?;
            let point = past.before(time)?;
            past.present = past.present.max(now);
            self.go_back_to(point);
        }
        self.try_run_to(time)?;
        self.catch_up();
        Ok(())
    }

    /// Goes to a checkpoint, with the changes that were made at its time.
    fn go_back_to(&mut self, point: usize) {
        let Some(mut past) = self.past.take() else { return };
        let Point { checkpoint, changes, .. } = &past.points[point];
        past.next = Some(*changes);
        past.full = 0;
        self.go_on_from(checkpoint);
        self.past = Some(past);
        self.catch_up();
    }

    /// Goes back to the last instant before now after which a condition was true.
    #[track_caller]
    pub fn run_until_back(&mut self, condition: Condition) -> Result<Option<u64>, Error> {
        let (until, now) = (self.until(condition), self.timeline.time());
        self.check_no_trace();
        let past = self.past.as_mut().ok_or(Unremembered::Nothing { now })?;
        past.present = past.present.max(now);
        let times: Vec<u64> = past.points.iter().map(|point| point.checkpoint.time()).collect();
        let mut end = now;
        for point in (0..times.len()).rev().filter(|&point| times[point] < now) {
            self.go_back_to(point);
            let mut last = None;
            while self.timeline.time() < end {
                if until.holds(self.engine.read(until.value)) {
                    last = Some(self.timeline.time());
                }
                self.try_step()?;
                self.catch_up();
            }
            if let Some(time) = last {
                return self.go_to(time).map(|()| last);
            }
            end = times[point];
        }
        self.go_to(now)?;
        Ok(None)
    }
}
