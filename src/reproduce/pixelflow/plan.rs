//! What is measured for the page.

use super::frames::{Spec, Which};
use crate::reproduce::effort::Effort;
use tilewright_machines::pixelflow::{Choices, Nodes, Samples, Shades, Simulated, Software, System};
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::Size;

/// Eight samples as four side by side, twice: the only way to fit them into the array.
pub const EIGHT: Samples = Samples::Eight { rasterizations: 2.0 };
/// The most primitives of a frame.
const MOST: u64 = 600_000;
/// Latencies at which primitives are compared, in milliseconds: those of the paper's goal first.
pub const LATENCIES: [f64; 5] = [30.0, 35.0, 40.0, 60.0, 80.0];
/// The goal's latencies, of these.
pub const GOAL: [f64; 3] = [30.0, 35.0, 40.0];

/// Random triangles of a frame of the circuit.
const TRIANGLES: [u64; 3] = [1000, 3000, 8000];
const FEW_TRIANGLES: [u64; 2] = [100, 300];

/// A system on 20 nodes, as in the paper's figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    pub system: System,
    pub shaders: u32,
    pub samples: Samples,
    /// Which samples are shaded, and other choices that the paper leaves open.
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

    /// The paper's formula, with 40 composed and shaded regions whatever the samples are.
    pub fn formula(&self) -> Software {
        Software::paper(self.system, Nodes::paper(self.shaders), self.samples)
    }

    /// Its formula with the actual number of composed and shaded regions: with eight samples, 160 regions twice.
    pub fn formula_of_all(&self) -> Software {
        match (self.system, self.samples) {
            (System::NonTexturing, _) | (_, Samples::One) => self.formula(),
            _ => {
                let shaded = if self.choices.shades == Shades::EverySample { 320.0 } else { 40.0 };
                Software { composed: 320.0, shaded, ..self.formula() }
            }
        }
    }

    /// A frame of random primitives of 10 x 10 pixels in the model.
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
        // With one sample there is no choice.
        let shades = if samples == Samples::One { Shades::EverySample } else { shades };
        Plan::cases(samples, shades).find(|it| (it.system, it.shaders) == (system, shaders)).expect("there is one")
    }

    /// All curves: one sample, and eight samples shaded each, or once per pixel.
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

    /// The most primitives that are tried for a latency.
    pub fn most(&self) -> u64 {
        self.effort.at_most(2 * MOST)
    }

    /// The screen of the circuit's frames: the paper's, or one with the same number of smaller regions.
    pub fn size(&self) -> Size {
        let scale = self.scale();
        Size::new(640 / scale, 512 / scale).expect("in range")
    }

    /// Pixels of an array along x and y.
    pub fn array(&self) -> [u32; 2] {
        [128, 64].map(|side| side / self.scale())
    }

    /// The side of a triangle's box in pixels.
    pub fn box_side(&self) -> u32 {
        10_u32.div_ceil(self.scale())
    }

    fn scale(&self) -> u32 {
        if self.effort.is_quick() { 8 } else { 1 }
    }

    /// The systems that draw random triangles in the circuit.
    pub fn curves(&self) -> Vec<Spec> {
        let systems = [(System::Base, 1), (System::Base, 4), (System::PreSort, 4), (System::NonTexturing, 0)];
        systems.map(|(system, shaders)| Plan::triangles(system, shaders)).to_vec()
    }

    /// The system that draws them for two eyes.
    pub fn stereo(&self) -> Spec {
        Plan::triangles(System::Base, 4)
    }

    fn triangles(system: System, shaders: u32) -> Spec {
        Spec { which: Which::Triangles(0), system, shaders, is_half: false }
    }

    /// All frames that the circuit draws.
    pub fn frames(&self) -> Vec<Spec> {
        let built_in = |name, samples, system, shaders| Spec {
            which: Which::BuiltIn(name, samples),
            system,
            shaders,
            is_half: false,
        };
        let pictures = [
            built_in("teapot", 1, System::NonTexturing, 0),
            built_in("textured", 1, System::Base, 4),
            built_in("textured", 8, System::Base, 4),
        ];
        let (pictures, counts) = match self.effort.is_quick() {
            false => (&pictures[..], &TRIANGLES[..]),
            true => (&pictures[..2], &FEW_TRIANGLES[..]),
        };
        let mut counts: Vec<u64> = counts.iter().map(|count| self.effort.at_most(*count)).collect();
        counts.dedup();
        let triangles = |spec: Spec| counts.iter().map(move |count| Spec { which: Which::Triangles(*count), ..spec });
        let curves = self.curves().into_iter().chain([Spec { is_half: true, ..self.stereo() }]);
        pictures.iter().copied().chain(curves.flat_map(triangles)).collect()
    }
}
