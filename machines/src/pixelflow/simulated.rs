//! The three systems in the transaction model, with the paper's costs or with others.

use serde::Serialize;

use super::costs::{Ticks, milliseconds, ticks};
use super::latency::{Samples, Software, System, Times};
use super::model::{Frame, FrontEnd, Resident, Shading, Timeline, Turn};
use super::workload::{Boxes, Workload};
use tilewright_rtl::parameter::ParameterError;

/// Choices that the paper leaves open, or to a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Choices {
    /// The set-up before each composition (PFL-SETUP).
    pub set_up: Ticks,
    /// Which samples are shaded.
    pub shades: Shades,
    /// Whether colours go the way of the appearance words, instead of the other way in parallel (PFL-NET).
    pub one_way: bool,
}

/// The samples on which a shader works.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Shades {
    /// All: a region is shaded eight times.
    EverySample,
    /// What the samples of a pixel have in common: once.
    OncePerPixel,
}

impl Default for Choices {
    /// No set-up, every sample, both directions.
    fn default() -> Choices {
        Choices { set_up: 0, shades: Shades::EverySample, one_way: false }
    }
}

/// A frame in the model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Simulated {
    /// The time from its beginning to its last pixel in the frame buffer, in milliseconds.
    pub latency: f64,
    /// The busy time of each stage; of several nodes, the longest.
    pub busy: Times,
}

impl Software {
    /// Bytes of a pixel's colour (PFL-BYTES).
    const COLOUR: u32 = 3;
    /// Renderings for eight samples of a pixel, with four each.
    const RENDERINGS: usize = 2;

    /// Regions of a rendering. With eight samples they have a quarter of the size, as four samples are side by side.
    pub fn regions_drawn(&self) -> usize {
        let larger = if self.is_side_by_side() { 4 } else { 1 };
        self.regions as usize * larger
    }

    /// Boxes of 10 x 10 pixels at random places of the paper's screen (PFL-OVERLAP). With eight samples the screen has twice the width and height, and the
    /// boxes have the same size.
    ///
    /// # Errors
    /// As [`Workload::of_boxes`].
    pub fn paper_boxes(&self, primitives: u64, seed: u64) -> Result<Workload, ParameterError> {
        let (sides, regions) = match self.is_side_by_side() {
            true => ([20, 20], [10, 16]),
            false => ([10, 10], [5, 8]),
        };
        let boxes = Boxes { sides, region: [128, 64], regions, seed };
        Workload::of_boxes(boxes, primitives, self.nodes.rasterizers as usize, self.draws())
    }

    /// Runs a frame. The software's overlap and its numbers of composed and shaded regions are for the formula. Here they follow from the workload, whose
    /// regions are [`Software::regions_drawn`].
    ///
    /// ```
    /// use tilewright_machines::pixelflow::{Choices, Nodes, Samples, Software, System, Workload};
    ///
    /// // 19 rasterizers in perfect balance: 15 primitives each in each of 40 regions.
    /// let software = Software::paper(System::NonTexturing, Nodes::paper(0), Samples::One);
    /// let workload = Workload::balanced(19, 40, 15, software.draws());
    /// let found = software.simulate(&workload, Choices::default()).latency;
    /// let formula = Software { overlap: 1.0, ..software }.latency(19.0 * 40.0 * 15.0);
    /// // They differ by the last primitive, and the first region's way to the frame buffer.
    /// assert!((0.0..0.011).contains(&(found - formula)), "{found} ms, {formula} ms");
    /// ```
    ///
    /// # Panics
    /// The system shades, and there is no shader.
    pub fn simulate(&self, workload: &Workload, choices: Choices) -> Simulated {
        match self.system {
            System::NonTexturing => self.simulate_resident(workload, choices),
            System::Base | System::PreSort => self.simulate_regions(workload, choices),
        }
    }

    /// The time of a primitive in a region.
    pub fn draws(&self) -> Ticks {
        ticks(match self.system {
            System::NonTexturing => self.costs.rasterize_plain,
            _ => self.costs.rasterize,
        })
    }

    /// The front end of a system that sorts.
    ///
    /// # Panics
    /// The system does not sort.
    pub fn front_end(&self) -> FrontEnd {
        match self.system {
            System::Base => FrontEnd::Before(ticks(self.costs.transform)),
            System::PreSort => {
                FrontEnd::TwoPasses { sorts: ticks(self.costs.sort), generates: ticks(self.costs.generate) }
            }
            System::NonTexturing => panic!("the non-texturing system does not sort"),
        }
    }

    fn simulate_resident(&self, workload: &Workload, choices: Choices) -> Simulated {
        let frame = Resident {
            workload,
            overhead: ticks(self.costs.overhead),
            transforms: ticks(self.costs.transform_plain),
            samples: if self.samples == Samples::One { 1 } else { 8 },
            composes: choices.set_up + self.composes(Software::PLAIN),
            loads: ticks(self.costs.load),
        };
        let passes = frame.run();
        let longest = |of: &dyn Fn(&super::Share) -> Ticks| workload.shares.iter().map(of).max().unwrap_or(0);
        let regions = workload.regions as Ticks;
        Simulated {
            latency: milliseconds(passes.last().map_or(0, |pass| pass.loaded)),
            busy: Times {
                front: milliseconds(longest(&|it| frame.overhead + frame.transforms * it.primitives() as Ticks)),
                generate: 0.0,
                rasterize: milliseconds(frame.samples as Ticks * longest(&super::Share::draws)),
                compose: milliseconds(frame.samples as Ticks * regions * frame.composes),
                shade: 0.0,
                load: milliseconds(regions * frame.loads),
            },
        }
    }

    fn simulate_regions(&self, workload: &Workload, choices: Choices) -> Simulated {
        let turns = self.turns(workload.regions, choices);
        let (overhead, front_end) = (ticks(self.costs.overhead), self.front_end());
        let shaders = self.nodes.shaders as usize;
        let frame = Frame { workload, overhead, front_end, turns, shaders, one_way: choices.one_way };
        let time = frame.run();
        Simulated { latency: milliseconds(time.latency()), busy: busy(&frame, &time) }
    }

    /// The turns of all regions, from the rasterizers to the frame buffer.
    fn turns(&self, regions: usize, choices: Choices) -> Vec<Turn> {
        let renderings = if self.is_side_by_side() { Software::RENDERINGS } else { 1 };
        // A region of eight samples has a quarter of a shader's pixels: four regions are shaded together.
        let together = match choices.shades {
            Shades::OncePerPixel if self.is_side_by_side() => 4,
            _ => 1,
        };
        let whole = ticks(self.costs.addresses + self.costs.look_up);
        let composes = choices.set_up + self.composes(Software::APPEARANCE);
        let colours = choices.set_up + self.composes(Software::COLOUR);
        let loads = ticks(self.costs.load * self.regions) * together as Ticks / regions as Ticks;
        let turn = |region: usize, rendering: usize| {
            let is_last = rendering + 1 == renderings && (region % together + 1 == together || region + 1 == regions);
            let takes = if is_last || together == 1 { whole } else { 0 };
            let shader = region / together % self.nodes.shaders as usize;
            let shading = Shading { shader, takes, sends: if is_last { colours } else { 0 } };
            Turn { region: region as u16, composes, shades: Some(shading), loads: if is_last { loads } else { 0 } }
        };
        (0..regions).flat_map(|region| (0..renderings).map(move |rendering| turn(region, rendering))).collect()
    }

    fn composes(&self, bytes: u32) -> Ticks {
        Ticks::from(bytes) * ticks(self.costs.composed_byte)
    }

    fn is_side_by_side(&self) -> bool {
        self.system != System::NonTexturing && self.samples != Samples::One
    }
}

/// The busy times of the stages.
fn busy(frame: &Frame, time: &Timeline) -> Times {
    let most = |all: &[Ticks]| milliseconds(all.iter().copied().max().unwrap_or(0));
    let of_turns = |of: &dyn Fn(&Turn) -> Ticks| frame.turns.iter().map(of).sum::<Ticks>();
    let mut shaders = vec![0; frame.shaders];
    for Shading { shader, takes, .. } in frame.turns.iter().filter_map(|turn| turn.shades) {
        shaders[shader] += takes;
    }
    Times {
        front: most(&time.front),
        generate: most(&time.generated),
        rasterize: most(&time.drawn),
        compose: milliseconds(of_turns(&|turn| turn.composes)),
        shade: most(&shaders),
        load: milliseconds(of_turns(&|turn| turn.loads)),
    }
}

#[cfg(test)]
mod tests;
