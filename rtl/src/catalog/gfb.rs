//! The entries of the global frame buffer and its parts, and of the accumulation buffer.

use tilewright_hdl::{Codes, Scenario, Script, elaborate, elaborate_at};

use super::shared::{HEIGHT, PIXEL_CLOCK, UNITS, WIDTH, display};
use super::{CatalogError, Entry, Parameter, Values};
use crate::clocks::{CRT, MERGE};
use crate::gfb::{
    Accumulation, AccumulationIn, CrtReadOut, CrtReadOutIn, GfbSequencer, GfbSequencerIn, GfbUnit, GfbUnitIn, Host,
    Passes, SCAN_LATENCY,
};
use crate::parameter::Screen;

const OVERHEAD: Parameter =
    Parameter { name: "overhead", default: 20, min: 1, max: 255, meaning: "clocks of overhead after a scan line" };

pub(super) const GFB_UNIT: Entry = Entry {
    name: "gfb-unit",
    summary: "leads the scan, feeds the merger, keeps the frame and shows it",
    parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD, PIXEL_CLOCK],
    design: |values| Ok(elaborate(&gfb_unit(values)?)?),
    scenario: |values| Ok(two_frames(&gfb_unit(values)?)),
};

pub(super) const GFB_SEQUENCER: Entry = Entry {
    name: "gfb-sequencer",
    summary: "leads the merger: the scan, and what enters and leaves the chain",
    parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD],
    design: |values| Ok(elaborate_at(&sequencer(values)?, MERGE.period)?),
    scenario: |values| Ok(rounds(&sequencer(values)?)),
};

pub(super) const CRT_READ_OUT: Entry = Entry {
    name: "crt-read-out",
    summary: "reads the bank on display, refresh after refresh, and says when the banks may change",
    parameters: &[WIDTH, HEIGHT, PIXEL_CLOCK],
    design: |values| Ok(elaborate_at(&read_out(values)?, display(values).period)?),
    scenario: |values| Ok(a_refresh(&read_out(values)?, values)),
};

pub(super) const ACCUMULATION: Entry = Entry {
    name: "accumulation",
    summary: "adds up the pictures of several passes, and shows their average",
    parameters: &[WIDTH, HEIGHT],
    design: |values| Ok(elaborate(&accumulation(values)?)?),
    scenario: |values| Ok(two_passes(&accumulation(values)?)),
};

fn screen(values: &Values) -> Result<Screen, CatalogError> {
    Ok(Screen::new(values.get_u32("width"), values.get_u32("height"))?)
}

fn gfb_unit(values: &Values) -> Result<GfbUnit, CatalogError> {
    let (units, overhead) = (values.get_u32("units"), values.get_u32("overhead"));
    Ok(GfbUnit { screen: screen(values)?, units, overhead, display: display(values) }.checked()?)
}

fn two_frames(gfb: &GfbUnit) -> Scenario {
    let sequencer = gfb.sequencer();
    let idle = |merged, read_address| {
        let host = Host { read_address, background: 0xffffff_102030 };
        GfbUnitIn { swap: 0, host, merged }
    };
    // A swap comes in a blanking of the display, which begins with one.
    let [line, refresh] = [gfb.read_out().line_clocks(), gfb.read_out().refresh_clocks()]
        .map(|clocks| clocks * gfb.display.period.picoseconds() / MERGE.period.picoseconds());
    let until_dark = |clock: u64| if clock % refresh < 40 * line { 0 } else { refresh - clock % refresh + 4 };
    let drain = u64::from(sequencer.chain() + SCAN_LATENCY);
    let stale = drain + drain.div_ceil(u64::from(gfb.screen.width)) * u64::from(gfb.overhead);

    let mut script = Script::new(gfb, MERGE.period);
    let mut clock = 0;
    for merged in [21, 42] {
        let merges = sequencer.stored_clocks() + 4;
        let merges = merges + until_dark(clock + merges);
        script.hold(&idle(merged, 0), merges);
        script.clock(&GfbUnitIn { swap: 1, ..idle(merged, 0) });
        (0..4).for_each(|pixel| script.clock(&idle(merged, pixel)));
        // What entered before the swap comes out of the chain as it is.
        script.hold(&idle(merged, 0), stale);
        clock += merges + 5 + stale;
    }
    script.finish("two frames: rounds of merging, a swap of the banks in a blanking, and a look at the first pixels")
}

fn sequencer(values: &Values) -> Result<GfbSequencer, CatalogError> {
    let (units, overhead) = (values.get_u32("units"), values.get_u32("overhead"));
    Ok(GfbSequencer { screen: screen(values)?, units, overhead }.checked()?)
}

fn rounds(sequencer: &GfbSequencer) -> Scenario {
    let mut script = Script::new(sequencer, MERGE.period);
    script.hold(&GfbSequencerIn { restart: 0 }, sequencer.stored_clocks() + 6);
    script.clock(&GfbSequencerIn { restart: 1 });
    script.hold(&GfbSequencerIn { restart: 0 }, sequencer.period() / 2);
    script.finish("a round and the beginning of the next one; a restart on the way")
}

fn read_out(values: &Values) -> Result<CrtReadOut, CatalogError> {
    Ok(CrtReadOut { screen: screen(values)?, blanking: display(values).blanking })
}

fn a_refresh(crt: &CrtReadOut, values: &Values) -> Scenario {
    let mut script = Script::new(crt, display(values).period);
    script.hold(&CrtReadOutIn { word: 0xffffff_102030 }, crt.refresh_clocks() + 8);
    script.finish("the vertical blanking, and a refresh behind it")
}

fn accumulation(values: &Values) -> Result<Accumulation, CatalogError> {
    Ok(Accumulation { screen: screen(values)? })
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
