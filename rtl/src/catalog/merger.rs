//! The entries of the merging unit, and of the chain of merging units.

use tilewright_hdl::{Scenario, Script, elaborate_at};

use super::shared::{EMPTY, UNITS};
use super::{Entry, Values};
use crate::clocks::MERGE;
use crate::merger::{ImageMerger, ImageMergerIn, MergingUnit, MergingUnitIn};

pub(super) const MERGING_UNIT: Entry = Entry {
    name: "merging-unit",
    summary: "sends on the nearer of two pixels, in 4 stages",
    parameters: &[],
    design: |_| Ok(elaborate_at(&MergingUnit, MERGE.period)?),
    scenario: |_| Ok(merging_unit()),
};

pub(super) const IMAGE_MERGER: Entry = Entry {
    name: "image-merger",
    summary: "a chain of merging units",
    parameters: &[UNITS],
    design: |values| Ok(elaborate_at(&image_merger(values), MERGE.period)?),
    scenario: |values| Ok(a_marked_pixel(&image_merger(values))),
};

fn merging_unit() -> Scenario {
    let mut script = Script::new(&MergingUnit, MERGE.period);
    let pairs = [(5, 7), (9, 8), (99, 6), (4, 99), (3, 3), (99, 98)];
    for (left, right) in pairs.into_iter().chain([(0, 0); 5]) {
        script.clock(&MergingUnitIn { left, right, enable: 1 });
    }
    script.finish("six pairs of pixels; the nearer of each comes out 4 clocks later")
}

fn image_merger(values: &Values) -> ImageMerger {
    ImageMerger { units: values.get_u32("units") }
}

fn a_marked_pixel(merger: &ImageMerger) -> Scenario {
    let mut script = Script::new(merger, MERGE.period);
    let mut inputs = ImageMergerIn { left: 7, samples: vec![EMPTY; merger.units as usize], enable: 1 };
    script.clock(&inputs);
    inputs.left = EMPTY;
    script.clock(&inputs);
    script.wait(4 * merger.units + 2);
    script.finish("a flagged pixel enters at the left, and comes out after 4 clocks per unit")
}
