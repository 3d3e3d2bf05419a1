//! All results: timed, counted, and measured in the circuit.

use super::circuit::Circuit;
use super::counted::Counted;
use super::estimate::Estimated;
use super::figure_6::{Figure6, PAGES};
use super::idle::Idle;
use super::plan::{Case, Plan};
use super::regions::Regional;
use super::run::{Job, Timed};
use crate::shell::Failure;
use tilewright_machines::{Error, Watch};
use tilewright_report::Origin;

/// All results of the page.
pub struct Found {
    pub plan: Plan,
    pub circuit: Circuit,
    pub counted: Counted,
    pub figure_6: Figure6,
    pub idle: Idle,
    pub regional: Regional,
    pub estimated: Vec<Estimated>,
    timed: Vec<Timed>,
}

impl Found {
    /// Runs everything; `None` if interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Found>, Failure> {
        let circuit = Circuit::measured()?;
        let counted = Counted::all(plan)?;
        let figure_6 = Figure6::ran(PAGES, watch)?;
        let Some(idle) = Idle::found(watch) else { return Ok(None) };
        let Some(regional) = Regional::found(plan, watch) else { return Ok(None) };
        let Some(estimated) = Estimated::all(plan, watch) else { return Ok(None) };
        let Some(timed) = Found::timed(plan, &plan.cases(), watch)? else { return Ok(None) };
        Ok(Some(Found {
            plan: *plan,
            circuit,
            counted,
            figure_6,
            idle: idle?,
            regional: regional?,
            estimated: estimated?,
            timed,
        }))
    }

    /// Runs those cases only.
    #[cfg(test)]
    pub fn of_cases(plan: &Plan, cases: &[Case]) -> Found {
        let timed = Found::timed(plan, cases, &mut Watch::default()).ok().flatten().expect("nothing stops it");
        Found {
            plan: *plan,
            circuit: Circuit { merging: [0; 2], round: 0, accesses: [0; 2], bus: 0.0 },
            counted: Counted::all(plan).expect("there are such machines"),
            figure_6: Figure6::default(),
            idle: Idle { in_blanking: 0.0, together: 0.0, any: 0.0 },
            regional: Regional::default(),
            estimated: Vec::new(),
            timed,
        }
    }

    /// The results with those of another plan's cases.
    #[cfg(test)]
    pub fn and(mut self, other: Found) -> Found {
        self.timed.extend(other.timed);
        self
    }

    /// Runs those cases on the model; equal cases run once.
    fn timed(plan: &Plan, cases: &[Case], watch: &mut Watch) -> Result<Option<Vec<Timed>>, Failure> {
        let Some(jobs) = watch.each("counting pages", cases, |case| Job::of(case, plan)) else { return Ok(None) };
        let jobs = jobs.into_iter().collect::<Result<Vec<Job>, Error>>()?;
        let mut once: Vec<&Job> = Vec::new();
        let mut numbers = Vec::new();
        for job in &jobs {
            let at = once.iter().position(|it| it.is_same(job)).unwrap_or(once.len());
            if at == once.len() {
                once.push(job);
            }
            numbers.push(at);
        }
        let Some(timed) = watch.each("timing", &once, |job| job.run(plan)) else { return Ok(None) };
        let timed = timed.into_iter().collect::<Result<Vec<Timed>, Error>>()?;
        Ok(Some(jobs.iter().zip(numbers).map(|(job, at)| timed[at].of_case(job.case)).collect()))
    }

    pub fn model(&self) -> Origin {
        Origin::model([])
    }

    /// The result of a case, if it was run. A quick look leaves out most cases.
    pub fn of(&self, case: Case) -> Option<&Timed> {
        self.timed.iter().find(|it| it.case == case)
    }

    /// A number of a case, with its place in the statement.
    pub fn at(&self, place: String, case: Case, of: impl Fn(&Timed) -> f64) -> Option<(String, f64)> {
        self.of(case).map(|timed| (place, of(timed)))
    }

    /// A number of one case over that of another.
    pub fn ratio(&self, place: String, [one, other]: [Case; 2], of: impl Fn(&Timed) -> f64) -> Option<(String, f64)> {
        Some((place, of(self.of(one)?) / of(self.of(other)?)))
    }
}
