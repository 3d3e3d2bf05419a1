//! Small edits of the catalogue's blocks, which the tests of each block have to find.
//!
//! Each mutant runs in a process of its own: the tests of `rtl`, built once with a simulator that looks for a mutant in its
//! environment, and of them only those in the module of the block. A mutant that no test finds is said to survive; whether it
//! differs from the block at all is then tried with random inputs.

mod compare;
mod suite;

pub use compare::{Comparison, compare};
pub use suite::{Suite, Verdict};

use crate::stimulus::Numbers;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use tilewright_hdl::Design;
use tilewright_mutants::{Mutant, mutants};
use tilewright_rtl::catalog::ENTRIES;

/// A block in one size, with the mutants of its own module that keep the rules of circuits.
pub struct Subject {
    /// The block's name in the catalogue.
    pub name: &'static str,
    /// The block itself.
    pub design: Design,
    /// The path of the tests of the block, such as `lfb::unit::`.
    pub tests: String,
    /// Its mutants.
    pub mutants: Vec<Mutant>,
}

impl Subject {
    /// The design with a mutant in the place of its top, unless that breaks a rule.
    pub fn with(&self, mutant: &Mutant) -> Option<Design> {
        let mut modules = self.design.modules().to_vec();
        *modules.last_mut()? = mutant.module.clone();
        Design::new(modules).ok()
    }
}

/// Every block of the catalogue in its default size.
pub fn subjects() -> Vec<Subject> {
    let subject = |entry: &tilewright_rtl::catalog::Entry| {
        let values = entry.values([]).expect("nothing is set");
        let design = entry.design(&values).expect("every default goes together");
        let tests = tests_of(design.top().loc.file());
        let all = mutants(design.top());
        let mut subject = Subject { name: entry.name, design, tests, mutants: Vec::new() };
        subject.mutants = all.into_iter().filter(|mutant| subject.with(mutant).is_some()).collect();
        subject
    };
    ENTRIES.iter().map(subject).collect()
}

/// The path of the tests in a file of `rtl`, or in files below it.
fn tests_of(file: &str) -> String {
    let file = file.strip_prefix("rtl/src/").expect("the catalogue's blocks are in `rtl`");
    let path = file.trim_end_matches(".rs").trim_end_matches("/mod");
    format!("{}::", path.replace('/', "::"))
}

/// So many mutants of all subjects, or all if there are fewer: one of each subject in turn, as the seed orders them. Each as the
/// indices of its subject and of itself there.
pub fn choose(subjects: &[Subject], count: usize, seed: u64) -> Vec<(usize, usize)> {
    let mut numbers = Numbers(seed);
    let mut orders: Vec<Vec<usize>> =
        subjects.iter().map(|subject| shuffled(subject.mutants.len(), &mut numbers)).collect();
    let mut chosen = Vec::new();
    while chosen.len() < count && orders.iter().any(|order| !order.is_empty()) {
        let next = orders.iter_mut().enumerate().filter_map(|(subject, order)| Some((subject, order.pop()?)));
        chosen.extend(next);
    }
    chosen.truncate(count);
    chosen.sort_unstable();
    chosen
}

fn shuffled(count: usize, numbers: &mut Numbers) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for i in (1..count).rev() {
        order.swap(i, (numbers.draw() % (i as u64 + 1)) as usize);
    }
    order
}

/// What the tests say of each mutant that was chosen, so many at a time; calls `done` with the number of those that are through.
pub fn run(
    suite: &Suite,
    subjects: &[Subject],
    chosen: &[(usize, usize)],
    jobs: usize,
    done: impl Fn(usize) + Sync,
) -> Vec<Verdict> {
    let next = AtomicUsize::new(0);
    let verdicts = Mutex::new(vec![Verdict::Survives; chosen.len()]);
    let through = AtomicUsize::new(0);
    let work = || {
        while let Some((at, &(subject, mutant))) = chosen.iter().enumerate().nth(next.fetch_add(1, Ordering::Relaxed)) {
            let subject = &subjects[subject];
            let verdict = suite.run(&subject.tests, Some(&subject.mutants[mutant]));
            verdicts.lock().expect("no panic while collecting")[at] = verdict;
            done(through.fetch_add(1, Ordering::Relaxed) + 1);
        }
    };
    std::thread::scope(|scope| (0..jobs).for_each(|_| drop(scope.spawn(work))));
    verdicts.into_inner().expect("no panic while collecting")
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_mutants::mutated;

    #[test]
    fn every_block_has_mutants_that_keep_the_rules_and_are_found_again_by_their_sentences() {
        for subject in subjects() {
            let mut sentences: Vec<String> = subject.mutants.iter().map(Mutant::to_string).collect();
            assert!(sentences.len() >= 5, "{} has {} mutants", subject.name, sentences.len());
            let sentence = &sentences[sentences.len() / 2];
            let again = mutated(&subject.design, sentence).expect("the sentence names a mutant of the design");
            assert_eq!(format!("{:?}", again.top()), format!("{:?}", subject.mutants[sentences.len() / 2].module));
            assert!(mutated(&subject.design, &sentence[1..]).is_none());
            sentences.sort_unstable();
            sentences.dedup();
            assert_eq!(sentences.len(), subject.mutants.len(), "two mutants of {} have one sentence", subject.name);
        }
    }

    #[test]
    fn a_choice_is_of_every_block_and_the_same_for_a_seed() {
        let subjects = subjects();
        let chosen = choose(&subjects, 50, 1);
        assert_eq!((chosen.len(), &chosen), (50, &choose(&subjects, 50, 1)));
        assert_ne!(chosen, choose(&subjects, 50, 2));
        assert!((0..subjects.len()).all(|subject| chosen.iter().filter(|(of, _)| *of == subject).count() == 5));
        let all = subjects.iter().map(|subject| subject.mutants.len()).sum();
        assert_eq!(choose(&subjects, usize::MAX, 1).len(), all);
    }

    #[test]
    fn the_tests_of_a_block_are_in_its_file() {
        assert_eq!(tests_of("rtl/src/lfb/unit.rs"), "lfb::unit::");
        assert_eq!(tests_of("rtl/src/vc1/mod.rs"), "vc1::");
    }
}
