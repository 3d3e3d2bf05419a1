//! Small edits of blocks, which the tests of each block have to find.
//!
//! Each mutant runs in a process of its own: the tests of the block's crate, built once with a simulator that looks for a mutant in
//! its environment. Of `rtl` only the tests in the module of the block run. A mutant that no test finds is said to
//! survive; whether it differs from the block at all is then tried with random inputs.

mod compare;
mod subject;
mod suite;

pub use compare::{Comparison, compare};
pub use subject::{Subject, subjects};
pub use suite::{Suite, Verdict};

use crate::stimulus::Numbers;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use tilewright_mutants::Mutant;

/// So many mutants of all subjects, or all if there are fewer: one of each subject in turn, as the seed orders them. For each
/// subject the indices of its mutants.
pub fn choose(subjects: &[Subject], count: usize, seed: u64) -> Vec<Vec<usize>> {
    let mut numbers = Numbers(seed);
    let shuffled = |subject: &Subject| shuffled(subject.mutants.len(), &mut numbers);
    let mut orders: Vec<Vec<usize>> = subjects.iter().map(shuffled).collect();
    let mut chosen = vec![Vec::new(); subjects.len()];
    let mut left = count;
    while left > 0 && orders.iter().any(|order| !order.is_empty()) {
        for (order, chosen) in orders.iter_mut().zip(&mut chosen) {
            if let Some(mutant) = order.pop().filter(|_| left > 0) {
                chosen.push(mutant);
                left -= 1;
            }
        }
    }
    chosen.iter_mut().for_each(|chosen| chosen.sort_unstable());
    chosen
}

fn shuffled(count: usize, numbers: &mut Numbers) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for i in (1..count).rev() {
        order.swap(i, (numbers.draw() % (i as u64 + 1)) as usize);
    }
    order
}

/// What the tests whose path contains `tests` say of each mutant, so many at a time.
pub fn run(suite: &Suite, tests: &str, mutants: &[&Mutant], jobs: usize) -> Vec<Verdict> {
    let next = AtomicUsize::new(0);
    let verdicts = Mutex::new(vec![Verdict::Survives; mutants.len()]);
    let work = || {
        while let Some((at, mutant)) = mutants.iter().enumerate().nth(next.fetch_add(1, Ordering::Relaxed)) {
            let verdict = suite.run(tests, Some(mutant));
            verdicts.lock().expect("no panic while collecting")[at] = verdict;
        }
    };
    std::thread::scope(|scope| (0..jobs).for_each(|_| drop(scope.spawn(work))));
    verdicts.into_inner().expect("no panic while collecting")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_is_of_every_block_and_the_same_for_a_seed() {
        let subjects = subjects(|_, _| true);
        let chosen = choose(&subjects, 3 * subjects.len(), 1);
        assert_eq!(chosen, choose(&subjects, 3 * subjects.len(), 1));
        assert_ne!(chosen, choose(&subjects, 3 * subjects.len(), 2));
        assert!(chosen.iter().all(|chosen| chosen.len() == 3 && chosen.is_sorted()), "{chosen:?}");
        let all = choose(&subjects, usize::MAX, 1);
        for (subject, chosen) in subjects.iter().zip(all) {
            assert_eq!(chosen, (0..subject.mutants.len()).collect::<Vec<_>>());
        }
    }
}
