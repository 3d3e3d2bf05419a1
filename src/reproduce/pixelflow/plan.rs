//! What is measured for the page, and how much of it.

use crate::reproduce::effort::Effort;
use tilewright_machines::pixelflow::{Choices, Nodes, Samples, Shades, Simulated, Software, System};
use tilewright_rtl::parameter::ParameterError;

/// Eight samples, four side by side, twice: the one way to fit them into the array.
pub const EIGHT: Samples = Samples::Eight { rasterizations: 2.0 };
/// The most primitives of a frame.
const MOST: u64 = 600_000;
/// Latencies at which primitives are compared, in milliseconds: those of the paper's goal first.
pub const LATENCIES: [f64; 5] = [30.0, 35.0, 40.0, 60.0, 80.0];
/// Of these, the goal's.
pub const GOAL: [f64; 3] = [30.0, 35.0, 40.0];

/// A system on 20 nodes, as the paper's figures have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    pub system: System,
    pub shaders: u32,
    pub samples: Samples,
    /// Which samples are shaded, and what else the paper leaves open.
    pub choices: Choices,
}

impl Case {
    /// The system, and its shaders.
    pub fn name(&self) -> &'static str {
        match (self.system, self.shaders) {
            (System::Base, 1) => "base 1",
            (System::Base, _) => "base 4",
            (System::PreSort, 1) => "pre-sort 1",
            (System::PreSort, _) => "pre-sort 4",
            (System::NonTexturing, _) => "non-texturing",
        }
    }

    /// The paper's formula: 40 regions are composed and shaded, whatever the samples are.
    pub fn formula(&self) -> Software {
        Software::paper(self.system, Nodes::paper(self.shaders), self.samples)
    }

    /// Its formula with the regions that are really composed and shaded: with eight samples, 160 regions twice.
    pub fn formula_of_all(&self) -> Software {
        match (self.system, self.samples) {
            (System::NonTexturing, _) | (_, Samples::One) => self.formula(),
            _ => {
                let shaded = if self.choices.shades == Shades::EverySample { 320.0 } else { 40.0 };
                Software { composed: 320.0, shaded, ..self.formula() }
            }
        }
    }

    /// A frame of so many random primitives of 10 x 10 pixels in the model.
    pub fn simulate(&self, software: &Software, primitives: u64, seed: u64) -> Result<Simulated, ParameterError> {
        Ok(software.simulate(&software.paper_boxes(primitives, seed)?, self.choices))
    }
}

/// The work for the page.
pub struct Plan {
    pub effort: Effort,
}

impl Plan {
    /// The curves of a figure.
    pub fn cases(samples: Samples, shades: Shades) -> impl Iterator<Item = Case> {
        let systems = [
            (System::Base, 1),
            (System::Base, 4),
            (System::PreSort, 1),
            (System::PreSort, 4),
            (System::NonTexturing, 0),
        ];
        let choices = Choices { shades, ..Choices::default() };
        systems.into_iter().map(move |(system, shaders)| Case { system, shaders, samples, choices })
    }

    /// One of them.
    pub fn case(system: System, shaders: u32, samples: Samples, shades: Shades) -> Case {
        // Of one sample there is nothing to choose.
        let shades = if samples == Samples::One { Shades::EverySample } else { shades };
        Plan::cases(samples, shades).find(|it| (it.system, it.shaders) == (system, shaders)).expect("there is one")
    }

    /// All of them: one sample, and eight, of which every one is shaded, or what they have in common.
    pub fn all_cases() -> impl Iterator<Item = Case> {
        let all = [(Samples::One, Shades::EverySample), (EIGHT, Shades::EverySample), (EIGHT, Shades::OncePerPixel)];
        all.into_iter().flat_map(|(samples, shades)| Plan::cases(samples, shades))
    }

    /// The primitives of a figure's points.
    pub fn primitives(&self) -> Vec<u64> {
        let steps = [0, 1, 2, 5, 10, 15, 20, 30, 40, 50, 60].into_iter().map(|step| step * 10_000);
        let mut all: Vec<u64> = steps.map(|count| self.effort.at_most(count)).collect();
        all.dedup();
        all
    }

    /// The most primitives that are tried to reach a latency.
    pub fn most(&self) -> u64 {
        self.effort.at_most(2 * MOST)
    }
}
