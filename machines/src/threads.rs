//! Work in jobs, on all processors of the computer.

use crate::run::Watch;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, mpsc};
use std::thread;

/// The number of threads that the computer has processors for.
pub(crate) fn all_threads() -> usize {
    thread::available_parallelism().map_or(1, NonZeroUsize::get)
}

impl Watch<'_> {
    /// Does `work` on each job, on all processors of the computer, and reports the progress of the phase after each. The results are in the
    /// sequence of the jobs; `None` if interrupted.
    ///
    /// ```
    /// use tilewright_machines::Watch;
    ///
    /// let squares = Watch::default().each("squaring", &[1, 2, 3], |number| number * number);
    /// assert_eq!(squares, Some(vec![1, 4, 9]));
    /// ```
    pub fn each<J: Sync, R: Send>(
        &mut self,
        phase: &'static str,
        jobs: &[J],
        work: impl Fn(&J) -> R + Sync,
    ) -> Option<Vec<R>> {
        self.each_on(all_threads(), phase, jobs, work)
    }

    /// The same on that number of threads.
    pub(crate) fn each_on<J: Sync, R: Send>(
        &mut self,
        threads: usize,
        phase: &'static str,
        jobs: &[J],
        work: impl Fn(&J) -> R + Sync,
    ) -> Option<Vec<R>> {
        let mut results: Vec<Option<R>> = jobs.iter().map(|_| None).collect();
        let (mut done, cancel) = (0, self.cancel);
        on_threads(threads, jobs, cancel, work, |number, result| {
            results[number] = Some(result);
            done += 1;
            self.report(phase, f64::from(done) / jobs.len() as f64);
        });
        results.into_iter().collect()
    }
}

/// Does `work` on each item, which it may change, on all processors of the computer. Returns the first error in the sequence of the items.
pub(crate) fn each_mut<J: Send, E: Send>(
    jobs: &mut [J],
    work: impl Fn(usize, &mut J) -> Result<(), E> + Sync,
) -> Result<(), E> {
    let left = Mutex::new(jobs.iter_mut().enumerate());
    let failed = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..all_threads() {
            scope.spawn(|| {
                let next = || left.lock().expect("nobody panics with it").next();
                while let Some((number, job)) = next() {
                    if let Err(error) = work(number, job) {
                        failed.lock().expect("nobody panics with it").push((number, error));
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().expect("nobody panics with it");
    failed.into_iter().min_by_key(|(number, _)| *number).map_or(Ok(()), |(_, error)| Err(error))
}

/// Does `work` on each job, on that number of threads. `done` gets the number and the result of each job as it ends, in any sequence. No job
/// begins after the flag is raised.
pub(crate) fn on_threads<J: Sync, R: Send>(
    threads: usize,
    jobs: &[J],
    cancel: Option<&AtomicBool>,
    work: impl Fn(&J) -> R + Sync,
    mut done: impl FnMut(usize, R),
) {
    let heard = |heard| match heard {
        Heard::Said(()) => {}
        Heard::Done(number, result) => done(number, result),
    };
    on_threads_heard(threads, jobs, cancel, |job, _: &dyn Fn(())| work(job), heard);
}

/// A message of a job.
pub(crate) enum Heard<M, R> {
    /// A message during a job.
    Said(M),
    /// The number of a job, and its result.
    Done(usize, R),
}

/// The same, with messages during jobs.
pub(crate) fn on_threads_heard<J: Sync, M: Send, R: Send>(
    threads: usize,
    jobs: &[J],
    cancel: Option<&AtomicBool>,
    work: impl Fn(&J, &dyn Fn(M)) -> R + Sync,
    heard: impl FnMut(Heard<M, R>),
) {
    let next = AtomicUsize::new(0);
    let is_cancelled = || cancel.is_some_and(|flag| flag.load(Ordering::Relaxed));
    let next_job = || {
        let number = next.fetch_add(1, Ordering::Relaxed);
        jobs.get(number).filter(|_| !is_cancelled()).map(|job| (number, job))
    };
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads {
            let (sender, work, next_job) = (sender.clone(), &work, &next_job);
            scope.spawn(move || {
                // The receiver lives as long as this scope.
                let say = |message| drop(sender.send(Heard::Said(message)));
                while let Some((number, job)) = next_job() {
                    let _ = sender.send(Heard::Done(number, work(job, &say)));
                }
            });
        }
        // The channel ends with the last thread.
        drop(sender);
        receiver.iter().for_each(heard);
    });
}
