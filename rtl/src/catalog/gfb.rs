//! The entries of the global frame buffer and its sequencer, and of the accumulation buffer.

use tilewright_hdl::{Codes, Scenario, Script, elaborate, elaborate_at};

use super::shared::{HEIGHT, UNITS, WIDTH};
use super::{CatalogError, Entry, Parameter, Values};
use crate::clocks::{CRT, MERGE};
use crate::gfb::{Accumulation, AccumulationIn, GfbSequencer, GfbSequencerIn, GfbUnit, GfbUnitIn, Host, Passes};
use crate::parameter::Screen;

const OVERHEAD: Parameter =
    Parameter { name: "overhead", default: 20, min: 1, max: 255, meaning: "clocks of overhead after a scan line" };

pub(super) const GFB_UNIT: Entry = Entry {
    name: "gfb-unit",
    summary: "leads the scan, feeds the merger and keeps the frame",
    parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD],
    design: |values| Ok(elaborate_at(&gfb_unit(values)?, MERGE.period)?),
    scenario: |values| Ok(two_rounds(&gfb_unit(values)?)),
};

pub(super) const GFB_SEQUENCER: Entry = Entry {
    name: "gfb-sequencer",
    summary: "leads a merging round: the scan, and what enters and leaves the merger",
    parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD],
    design: |values| Ok(elaborate_at(&sequencer(values)?, MERGE.period)?),
    scenario: |values| Ok(a_round(&sequencer(values)?)),
};

pub(super) const ACCUMULATION: Entry = Entry {
    name: "accumulation",
    summary: "adds up the pictures of several passes, and shows their average",
    parameters: &[WIDTH, HEIGHT],
    design: |values| Ok(elaborate(&accumulation(values)?)?),
    scenario: |values| Ok(two_passes(&accumulation(values)?)),
};

fn gfb_unit(values: &Values) -> Result<GfbUnit, CatalogError> {
    let screen = Screen::new(values.get_u32("width"), values.get_u32("height"))?;
    Ok(GfbUnit { screen, units: values.get_u32("units"), overhead: values.get_u32("overhead") })
}

fn two_rounds(gfb: &GfbUnit) -> Scenario {
    let mut script = Script::new(gfb, MERGE.period);
    let host = |start, swap, read_address| Host { start, swap, read_address, background: 0xffffff_102030 };
    for merged in [21, 42] {
        script.clock(&GfbUnitIn { host: host(1, 0, 0), merged });
        script.clock(&GfbUnitIn { host: host(0, 0, 0), merged });
        script.wait(gfb.sequencer().merge_clocks() + 4);
        script.clock(&GfbUnitIn { host: host(0, 1, 0), merged });
        (0..4).for_each(|pixel| script.clock(&GfbUnitIn { host: host(0, 0, pixel), merged }));
    }
    script.finish("two frames: a round of merging each, a swap of the banks, and a look at the first pixels")
}

fn sequencer(values: &Values) -> Result<GfbSequencer, CatalogError> {
    Ok(gfb_unit(values)?.sequencer())
}

fn a_round(sequencer: &GfbSequencer) -> Scenario {
    let mut script = Script::new(sequencer, MERGE.period);
    script.clock(&GfbSequencerIn { start: 1 });
    script.hold(&GfbSequencerIn { start: 0 }, sequencer.merge_clocks() + 6);
    script.finish("a merging round: line by line, and on until the last pixel has left the chain")
}

fn accumulation(values: &Values) -> Result<Accumulation, CatalogError> {
    Ok(Accumulation { screen: Screen::new(values.get_u32("width"), values.get_u32("height"))? })
}

fn two_passes(accumulation: &Accumulation) -> Scenario {
    let mut script = Script::new(accumulation, CRT.period);
    script.in_clocks_of(MERGE.period);
    let passes = Passes::Two.code();
    let idle = AccumulationIn { start: 0, first: 0, word: 0, passes, read_address: 0 };
    for (first, word) in [(1, 0xffffff_102030), (0, 0xffffff_304050)] {
        script.clock(&AccumulationIn { start: 1, first, word, ..idle });
        script.hold(&AccumulationIn { word, ..idle }, accumulation.pass_clocks() + 1);
    }
    let last = u64::from(accumulation.screen.pixels()) - 1;
    for read_address in [1, last] {
        script.hold(&AccumulationIn { read_address, ..idle }, 2);
    }
    script.finish("two passes, of a picture of one colour each, and a look at some pixels, which have the average")
}
