//! The entries of the catalogue.

use tilewright_hdl::{Scenario, Script, elaborate_at};

use super::{CatalogError, Entry, Parameter, Values, lfb, vc1};
use crate::clocks::MERGE;
use crate::gfb::{GfbUnit, GfbUnitIn, Host, Sequencer, SequencerIn};
use crate::merger::{ImageMerger, ImageMergerIn, MergingUnit, MergingUnitIn};
use crate::parameter::Screen;

pub(super) const EMPTY: u64 = (1 << 48) - 1;

pub(super) const WIDTH: Parameter =
    Parameter { name: "width", default: 16, min: 2, max: 2048, meaning: "pixels in a scan line of the screen" };
pub(super) const HEIGHT: Parameter =
    Parameter { name: "height", default: 8, min: 2, max: 2048, meaning: "scan lines of the screen" };
const UNITS: Parameter =
    Parameter { name: "units", default: 4, min: 1, max: 256, meaning: "merging units in the chain" };
const OVERHEAD: Parameter =
    Parameter { name: "overhead", default: 20, min: 1, max: 255, meaning: "clocks of overhead after a scan line" };

/// Every block: the whole, then its parts in the order of the data's way through it.
pub const ENTRIES: &[Entry] = &[
    vc1::VC1,
    lfb::LFB_UNIT,
    lfb::PATCH_TABLE,
    lfb::PAGE_ID_GENERATOR,
    lfb::IMAGE_MEMORY,
    lfb::SCAN_COUNTER,
    Entry {
        name: "merging-unit",
        summary: "sends on the nearer of two pixels, in 4 stages",
        parameters: &[],
        design: |_| Ok(elaborate_at(&MergingUnit, MERGE.period)?),
        scenario: |_| Ok(merging_unit()),
    },
    Entry {
        name: "image-merger",
        summary: "a chain of merging units",
        parameters: &[UNITS],
        design: |values| Ok(elaborate_at(&image_merger(values), MERGE.period)?),
        scenario: |values| Ok(a_marked_pixel(&image_merger(values))),
    },
    Entry {
        name: "gfb-unit",
        summary: "leads the scan, feeds the merger and keeps the frame",
        parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD],
        design: |values| Ok(elaborate_at(&gfb_unit(values)?, MERGE.period)?),
        scenario: |values| Ok(two_rounds(&gfb_unit(values)?)),
    },
    Entry {
        name: "gfb-sequencer",
        summary: "leads a merging round: the scan, and what enters and leaves the merger",
        parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD],
        design: |values| Ok(elaborate_at(&sequencer(values)?, MERGE.period)?),
        scenario: |values| Ok(a_round(&sequencer(values)?)),
    },
];

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
    script.wait(u64::from(4 * merger.units) + 2);
    script.finish("a marked pixel enters at the left and comes out 4 clocks a unit later")
}

fn gfb_unit(values: &Values) -> Result<GfbUnit, CatalogError> {
    let screen = Screen::new(values.get_u32("width"), values.get_u32("height"))?;
    Ok(GfbUnit::new(screen, values.get_u32("units"), values.get_u32("overhead"))?)
}

fn two_rounds(gfb: &GfbUnit) -> Scenario {
    let mut script = Script::new(gfb, MERGE.period);
    let host = |start, swap, read_address| Host { start, swap, read_address, background: 0xffffff_102030 };
    for merged in [21, 42] {
        script.clock(&GfbUnitIn { host: host(1, 0, 0), merged });
        script.clock(&GfbUnitIn { host: host(0, 0, 0), merged });
        script.wait(gfb.merge_clocks() + 4);
        script.clock(&GfbUnitIn { host: host(0, 1, 0), merged });
        (0..4).for_each(|pixel| script.clock(&GfbUnitIn { host: host(0, 0, pixel), merged }));
    }
    script.finish("two frames: a round of merging each, a swap of the banks, and a look at the first pixels")
}

fn sequencer(values: &Values) -> Result<Sequencer, CatalogError> {
    Ok(gfb_unit(values)?.sequencer())
}

fn a_round(sequencer: &Sequencer) -> Scenario {
    let mut script = Script::new(sequencer, MERGE.period);
    script.clock(&SequencerIn { start: 1 });
    script.hold(&SequencerIn { start: 0 }, sequencer.merge_clocks() + 6);
    script.finish("a merging round: line by line, and on until the last pixel has left the chain")
}
