//! Two workers: as many as the processors that the tests are balanced for.

use std::sync::Mutex;
use std::thread;

/// Does `work` on each job, on two threads, in the order of the jobs; so are the results. Jobs that take long go first.
///
/// ```
/// assert_eq!(tilewright_cosim::workers::each(&[3, 4, 5], |number| number * number), [9, 16, 25]);
/// ```
///
/// # Panics
///
/// If `work` does.
pub fn each<J: Sync, R: Send>(jobs: &[J], work: impl Fn(&J) -> R + Sync) -> Vec<R> {
    let left = Mutex::new(jobs.iter().enumerate());
    let next = || left.lock().expect("taking the next job does not panic").next();
    let take = || std::iter::from_fn(next).map(|(number, job)| (number, work(job))).collect::<Vec<_>>();
    let mut results = thread::scope(|scope| {
        let other = scope.spawn(take);
        let mut results = take();
        results.extend(other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        results
    });
    results.sort_by_key(|(number, _)| *number);
    results.into_iter().map(|(_, result)| result).collect()
}
