//! What a page has asked for, and the thread that makes it.

use crate::shell::Failure;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Something that a page can ask for.
pub trait Wish: Copy + PartialEq {
    /// The most that are kept of a kind.
    const MOST: usize;

    /// Its kind, by number: a lower one is made before.
    fn kind(&self) -> usize;

    /// Whether work on it has no reader any more when the other one is asked for.
    fn is_superseded(&self, by: &Self) -> bool;
}

/// What is known of a wish.
#[derive(Clone)]
pub enum State<M> {
    /// Others are made before.
    Waiting,
    Working,
    Made(M),
    Failed(String),
    /// Something else was asked for meanwhile.
    Stopped,
}

/// What has been asked for; of each kind the newest is the last.
pub struct Shelf<W, M> {
    entries: Mutex<Vec<Entry<W, M>>>,
    /// Raised when something has been asked for.
    asked: Condvar,
    /// Raised when nobody works on something any more.
    settled: Condvar,
}

struct Entry<W, M> {
    wish: W,
    state: State<M>,
    /// Stops the work on it.
    stop: Arc<AtomicBool>,
}

impl<W, M> Entry<W, M> {
    fn is_open(&self) -> bool {
        matches!(self.state, State::Waiting | State::Working)
    }
}

impl<W: Wish, M: Clone> Shelf<W, M> {
    /// An empty one.
    pub fn new() -> Shelf<W, M> {
        Shelf { entries: Mutex::default(), asked: Condvar::new(), settled: Condvar::new() }
    }

    /// What is known of a wish, which is asked for now. If that is new, the work on wishes that it supersedes stops. That a wish was stopped
    /// is told once.
    pub fn ask(&self, wish: W) -> State<M> {
        let mut entries = self.lock();
        if let Some(state) = state(&mut entries, wish) {
            return state;
        }
        for entry in entries.iter_mut().filter(|it| it.is_open() && it.wish.is_superseded(&wish)) {
            entry.stop.store(true, Relaxed);
            entry.state = State::Stopped;
        }
        self.settled.notify_all();
        if entries.iter().filter(|it| it.wish.kind() == wish.kind()).count() >= W::MOST {
            let oldest = entries.iter().position(|it| it.wish.kind() == wish.kind() && !it.is_open());
            oldest.map(|place| entries.remove(place));
        }
        entries.push(Entry { wish, state: State::Waiting, stop: Arc::default() });
        self.asked.notify_one();
        State::Waiting
    }

    /// The same, which waits that long for something that is being made.
    pub fn ask_and_wait(&self, wish: W, most: Duration) -> State<M> {
        let now = self.ask(wish);
        if !matches!(now, State::Waiting | State::Working) {
            return now;
        }
        let is_open = |entries: &mut Vec<Entry<W, M>>| entries.iter().any(|it| it.wish == wish && it.is_open());
        let waited = self.settled.wait_timeout_while(self.lock(), most, is_open);
        let (mut entries, _) = waited.unwrap_or_else(PoisonError::into_inner);
        // It may have been forgotten meanwhile.
        state(&mut entries, wish).unwrap_or(State::Stopped)
    }

    /// What has been made of a wish; nothing is asked for.
    pub fn made(&self, wish: W) -> Option<M> {
        let entries = self.lock();
        entries.iter().find(|it| it.wish == wish).and_then(|it| match &it.state {
            State::Made(made) => Some(made.clone()),
            _ => None,
        })
    }

    /// Stops the work on a wish that nobody waits for any more.
    pub fn forget(&self, wish: W) {
        self.lock().retain(|it| {
            let is_meant = it.wish == wish && it.is_open();
            if is_meant {
                it.stop.store(true, Relaxed);
            }
            !is_meant
        });
        self.settled.notify_all();
    }

    /// Waits for a wish, and makes it.
    pub fn make_next(&self, make: impl Fn(W, &AtomicBool) -> Result<M, Failure>) {
        let mut entries = self.lock();
        let (wish, stop) = loop {
            let waiting = entries.iter_mut().filter(|it| matches!(it.state, State::Waiting));
            match waiting.min_by_key(|it| it.wish.kind()) {
                Some(entry) => {
                    entry.state = State::Working;
                    break (entry.wish, entry.stop.clone());
                }
                None => entries = self.asked.wait(entries).unwrap_or_else(PoisonError::into_inner),
            }
        };
        drop(entries);
        let state = match catch_unwind(AssertUnwindSafe(|| make(wish, &stop))) {
            Ok(Ok(made)) => State::Made(made),
            Ok(Err(failure)) => State::Failed(failure.line()),
            // The sentence is on the terminal.
            Err(_) => State::Failed("this is a mistake in tilewright, please report it".to_owned()),
        };
        // One that was stopped may have been asked for again.
        let mut entries = self.lock();
        if let Some(entry) = entries.iter_mut().find(|it| it.is_open() && Arc::ptr_eq(&it.stop, &stop)) {
            entry.state = state;
        }
        self.settled.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Entry<W, M>>> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What is known of a wish that has been asked for. That it was stopped is told once.
fn state<W: Wish, M: Clone>(entries: &mut Vec<Entry<W, M>>, wish: W) -> Option<State<M>> {
    let place = entries.iter().position(|it| it.wish == wish)?;
    Some(match entries[place].state {
        State::Stopped => entries.remove(place).state,
        _ => entries[place].state.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::Exit;

    impl Wish for (usize, u32) {
        const MOST: usize = 2;

        fn kind(&self) -> usize {
            self.0
        }

        /// Of kind 7 the last one counts alone.
        fn is_superseded(&self, by: &Self) -> bool {
            self.0 == 7 && by.0 == 7
        }
    }

    fn made(state: &State<u32>) -> Option<u32> {
        if let State::Made(made) = state { Some(*made) } else { None }
    }

    #[test]
    fn lower_kinds_are_made_first_and_the_oldest_is_forgotten() {
        let shelf = Shelf::<(usize, u32), u32>::new();
        for wish in [(1, 7), (0, 8), (0, 9)] {
            assert!(matches!(shelf.ask(wish), State::Waiting));
        }
        let make = |wish: (usize, u32), _: &AtomicBool| Ok(10 * wish.1);
        shelf.make_next(make);
        assert_eq!((made(&shelf.ask((0, 8))), made(&shelf.ask((1, 7)))), (Some(80), None));
        shelf.make_next(make);
        shelf.make_next(make);
        assert_eq!((shelf.made((0, 9)), shelf.made((1, 7))), (Some(90), Some(70)));
        shelf.ask((0, 10));
        assert_eq!((shelf.made((0, 8)), shelf.made((0, 9))), (None, Some(90)));
    }

    #[test]
    fn what_was_stopped_is_told_once_and_can_be_asked_for_again() {
        let shelf = Shelf::<(usize, u32), u32>::new();
        shelf.ask((7, 1));
        shelf.make_next(|_, stop| {
            // A question that is asked again stops nothing, and another one does.
            shelf.ask((7, 1));
            assert!(!stop.load(Relaxed));
            shelf.ask((7, 2));
            assert!(stop.load(Relaxed));
            Err(Failure::new(Exit::Interrupted, "interrupted"))
        });
        assert!(matches!(shelf.ask((7, 1)), State::Stopped));
        assert!(matches!(shelf.ask((7, 2)), State::Waiting));
        shelf.forget((7, 2));
        shelf.ask((1, 1));
        shelf.make_next(|wish, stop| {
            // Forgotten and asked for again, it is still to be made: this work counts no more.
            shelf.forget(wish);
            shelf.ask(wish);
            assert!(stop.load(Relaxed));
            Ok(1)
        });
        assert!(matches!(shelf.ask((1, 1)), State::Waiting));
        shelf.make_next(|_, stop| if stop.load(Relaxed) { Ok(2) } else { Ok(3) });
        assert_eq!(made(&shelf.ask((1, 1))), Some(3));
    }

    #[test]
    fn a_question_waits_for_its_answer_but_not_for_ever() {
        let shelf = Shelf::<(usize, u32), u32>::new();
        let (soon, long) = (Duration::from_millis(1), Duration::from_mins(10));
        assert!(matches!(shelf.ask_and_wait((0, 1), soon), State::Waiting));
        std::thread::scope(|threads| {
            let asked = threads.spawn(|| shelf.ask_and_wait((0, 1), long));
            shelf.make_next(|wish, _| Ok(wish.1));
            assert_eq!(made(&asked.join().unwrap()), Some(1));
            let asked = threads.spawn(|| shelf.ask_and_wait((7, 2), long));
            while !asked.is_finished() {
                shelf.forget((7, 2));
            }
            assert!(matches!(asked.join().unwrap(), State::Stopped));
        });
    }

    #[test]
    fn a_failure_is_a_sentence() {
        let shelf = Shelf::<(usize, u32), u32>::new();
        shelf.ask((0, 0));
        shelf.make_next(|_, _| Err(Failure::new(Exit::BadInput, "there are spheres")));
        assert!(matches!(shelf.ask((0, 0)), State::Failed(sentence) if sentence == "there are spheres"));
    }
}
