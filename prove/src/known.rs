//! What is known of each statement, after one pass or several.

use crate::prepare::Stated;
use crate::{Outcome, Proof, Stage, Statement};
use std::time::Duration;
use tilewright_hdl::ir::Directive;

/// What is known, by the statement's number.
pub struct Known {
    /// Nothing of an assumption, and nothing at all before the first pass.
    outcomes: Vec<Option<(Outcome, Duration)>>,
    /// The statements to prove.
    wanted: Vec<usize>,
    /// As in [`Proof::ends_after`].
    pub ends_after: Option<u32>,
    /// As in [`Proof::late`].
    pub late: Option<Stage>,
}

impl Known {
    /// Nothing is known yet.
    pub fn nothing(stated: &[Stated]) -> Known {
        let is_wanted = |number: &usize| matches!(stated[*number].directive, Directive::Assert | Directive::Cover);
        let wanted = (0..stated.len()).filter(is_wanted).collect();
        Known { outcomes: stated.iter().map(|_| None).collect(), wanted, ends_after: None, late: None }
    }

    /// What is known of a statement.
    pub fn outcome(&self, number: usize) -> Option<&Outcome> {
        self.outcomes[number].as_ref().map(|(outcome, _)| outcome)
    }

    /// The statements to prove that are not settled.
    pub fn open(&self) -> Vec<usize> {
        let is_open = |number: &usize| !self.outcome(*number).is_some_and(Outcome::is_settled);
        self.wanted.iter().copied().filter(is_open).collect()
    }

    /// Whether all is settled.
    pub fn is_settled(&self) -> bool {
        self.open().is_empty()
    }

    /// Adds what was found, and after which time.
    pub fn add(&mut self, number: usize, outcome: Outcome, time: Duration) {
        self.outcomes[number] = Some((outcome, time));
    }

    /// Adds that the time was over in the conversion: of what is not known yet, nothing was searched.
    pub fn stop_in_conversion(&mut self) {
        for number in self.wanted.clone() {
            self.outcomes[number].get_or_insert((Outcome::Holds { clocks: 0 }, Duration::ZERO));
        }
        self.late = Some(Stage::Conversion);
    }

    /// All of this, statement by statement, at the end of a proof that took `total`.
    pub fn proof(self, stated: Vec<Stated>, total: Duration) -> Proof {
        let all = stated.into_iter().zip(self.outcomes);
        let statements = all.filter_map(|(stated, outcome)| {
            let (outcome, time) = outcome?;
            let time = if outcome.is_settled() { time } else { total };
            let Stated { directive, message, module, loc } = stated;
            Some(Statement { directive, message, module, loc, outcome, time })
        });
        Proof { statements: statements.collect(), ends_after: self.ends_after, late: self.late }
    }
}
