//! Going back many times, each time a bit further: passing checkpoints close to the present one make it quick.

use super::remembered::{Past, Point};
use crate::testbench::error::Error;
use crate::testbench::running::Running;

/// How many instants before a visited time there is a passing checkpoint.
const BEFORE: [u64; 4] = [4096, 512, 64, 8];

impl Past {
    /// The earliest time that is remembered.
    pub fn earliest(&self) -> u64 {
        self.points[0].checkpoint.time()
    }

    /// The last time up to `now` at which the testbench set a word: a memory, a lane and an address.
    pub fn set_word(&self, word: [u32; 3], now: u64) -> Option<u64> {
        self.changes.set_word(word, now)
    }

    /// Forgets the passing checkpoints after this time.
    fn forget_passing(&mut self, time: u64) {
        self.points.retain(|point| !point.is_passing || point.checkpoint.time() <= time);
    }
}

impl Running {
    /// Goes back to a time like [`Running::go_to`], as the first of several visits, each earlier. After the last one,
    /// [`Running::end_visits`].
    pub fn visit(&mut self, time: u64) -> Result<(), Error> {
        let now = self.timeline.time();
        if time < now
            && let Some(past) = &mut self.past
        {
            past.forget_passing(time);
            let point = past.points[past.before(time)?].checkpoint.time();
            let period = self.program.clocks.iter().map(|clock| clock.period).min().unwrap_or(1);
            for back in BEFORE.map(|instants| time.saturating_sub(period.saturating_mul(instants))) {
                if back > point {
                    self.go_to(back)?;
                    self.pass();
                }
            }
        }
        self.go_to(time)
    }

    /// Steps, and makes the changes of the new time.
    pub fn step_in_past(&mut self) -> Result<(), Error> {
        self.try_step()?;
        self.catch_up();
        Ok(())
    }

    /// Keeps a passing checkpoint of the present time, which is in the past.
    fn pass(&mut self) {
        let Some(mut past) = self.past.take() else { return };
        let now = self.timeline.time();
        let at = past.points.partition_point(|point| point.checkpoint.time() <= now);
        if past.points[at - 1].checkpoint.time() < now {
            let checkpoint = self.checkpoint(Some(&past.points[at - 1].checkpoint.saved));
            let changes = past.next.unwrap_or(past.changes.end());
            past.points.insert(at, Point { checkpoint, changes, bytes: 0, is_passing: true });
        }
        self.past = Some(past);
    }

    /// Forgets all passing checkpoints.
    pub fn end_visits(&mut self) {
        if let Some(past) = &mut self.past {
            past.points.retain(|point| !point.is_passing);
        }
    }
}
