//! The pipelined image merger: a linear chain of merging units (VC1-PIM).
//!
//! ```text
//!            samples[0]    samples[1]          samples[n-1]
//!                |             |                    |
//!                v             v                    v
//! left --> [merging unit]->[merging unit]-> .. ->[merging unit] --> merged
//! ```
//!
//! Latency: 4 n clocks; a pixel every clock. While `enable` is low, all registers keep their values. Unit `i` must get
//! its sample 4 i clocks after the left sample of the same pixel. The scan counters' lead ensures this (VC1-SCAN).

use super::unit::{MergingUnit, MergingUnitIn, STAGES};
use crate::prelude::*;

block! {
    /// Merges the images of the local frame buffers: passes on the nearest sample of each pixel.
    pub struct ImageMerger {
        /// The number of merging units.
        pub units: u32,
    }
    ranges { units: 1.. }
    latency(self) = format!("{} clocks with `enable`", STAGES * self.units);
    source = "VC-1, section 3.3, pipelined image merger (VC1-PIM)";
    in(self) ImageMergerIn {
        /// The pixel that enters the chain at its left end.
        left: bits(WORD),
        /// The pixel of each local frame buffer.
        samples: [bits(WORD); self.units],
        /// The chain advances.
        enable: bit(),
    }
    out ImageMergerOut {
        /// The nearest of the samples that met in the chain.
        merged: bits(WORD),
    }
}

impl ImageMerger {
    fn build(&self, m: Module, i: ImageMergerIn) -> ImageMergerOut {
        def!(
            merging_unit = m.array(self.units, &MergingUnit, |units| MergingUnitIn {
                left: units.nearer.previous(i.left),
                right: stack(i.samples),
                enable: i.enable,
            })
        );
        ImageMergerOut { merged: merging_unit.nearer.last() }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tilewright_sim::Simulation;

    use super::*;

    const EMPTY: u64 = (1 << 48) - 1;

    /// A pixel at the left end comes out after 4 n clocks, which is 64 for the VC-1's 16 units.
    #[test]
    fn a_marked_pixel_takes_4_clocks_a_unit() {
        for units in [1, 2, 3, 16] {
            let mut sim = Simulation::of(&ImageMerger { units }).unwrap();
            let samples = vec![EMPTY; units as usize];
            let drive = |sim: &mut Simulation<ImageMergerIn, ImageMergerOut>, left| {
                sim.drive(ImageMergerIn { left, samples: samples.clone(), enable: 1 });
                sim.step();
            };
            (0..100).for_each(|_| drive(&mut sim, EMPTY));
            drive(&mut sim, 7);
            let mut clocks = 1;
            while sim.get_u64(sim.o.merged) != 7 {
                drive(&mut sim, EMPTY);
                clocks += 1;
                assert!(clocks < 200, "the pixel never comes out");
            }
            assert_eq!(clocks, 4 * units);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// The stream of each unit runs 4 pixels behind that of its predecessor. The streams merge to their minimum,
        /// even when the chain pauses.
        #[test]
        fn the_nearest_of_all_comes_out(
            units in 1..6_usize,
            pixels in prop::collection::vec(prop::array::uniform6(0..50u64), 1..20),
            advances in prop::collection::vec(prop::bool::weighted(0.7), 1..60),
        ) {
            let mut sim = Simulation::of(&ImageMerger { units: units as u32 }).unwrap();
            let at = |step: usize, stream: usize| pixels.get(step).map_or(EMPTY, |pixel| pixel[stream]);
            let mut step = 0_usize;
            for advance in advances {
                if let Some(pixel) = step.checked_sub(4 * units).and_then(|first| pixels.get(first)) {
                    prop_assert_eq!(sim.get_u64(sim.o.merged), *pixel[..=units].iter().min().unwrap());
                }
                let samples = (0..units).map(|unit| at(step.wrapping_sub(4 * unit), unit + 1)).collect();
                sim.drive(ImageMergerIn { left: at(step, 0), samples, enable: advance.into() });
                sim.step();
                step += usize::from(advance);
            }
        }
    }
}
