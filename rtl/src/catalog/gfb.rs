//! The entries of the global frame buffer and its parts, and of the accumulation buffer.

use tilewright_hdl::{Codes, Scenario, Script, Stream, elaborate, elaborate_at};

use super::shared::{HEIGHT, PIXEL_CLOCK, UNITS, WIDTH, display, two_passes};
use super::{CatalogError, Entry, Parameter, Values};
use crate::clocks::MERGE;
use crate::gfb::{
    Access, Accumulation, AccumulationIn, CrtReadOut, CrtReadOutIn, GfbSequencer, GfbSequencerIn, GfbUnit, GfbUnitIn,
    Host, MultipassControl, MultipassControlIn, Passes, SCAN_LATENCY,
};
use crate::parameter::Screen;

const OVERHEAD: Parameter =
    Parameter { name: "overhead", default: 20, min: 1, max: 255, meaning: "clocks of overhead after a scan line" };

pub(super) const GFB_UNIT: Entry = Entry {
    name: "gfb-unit",
    summary: "paces the scan, feeds the merger, stores the frame and displays it",
    parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD, PIXEL_CLOCK],
    design: |values| Ok(elaborate(&gfb_unit(values, false)?)?),
    scenario: |values| Ok(two_frames(&gfb_unit(values, false)?)),
};

pub(super) const ACCUMULATING_GFB_UNIT: Entry = Entry {
    name: "accumulating-gfb-unit",
    summary: "a global frame buffer unit with an accumulation buffer, which shows the average of several passes",
    parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD, PIXEL_CLOCK],
    design: |values| Ok(elaborate(&gfb_unit(values, true)?)?),
    scenario: |values| Ok(two_frames(&gfb_unit(values, true)?)),
};

pub(super) const MULTIPASS_CONTROL: Entry = Entry {
    name: "multipass-control",
    summary: "decides when a pass is added up, when the average is shown, and when the banks may change",
    parameters: &[],
    design: |_| Ok(elaborate_at(&MultipassControl, MERGE.period)?),
    scenario: |_| Ok(two_pictures()),
};

pub(super) const GFB_SEQUENCER: Entry = Entry {
    name: "gfb-sequencer",
    summary: "paces the merger: the scan, and the pixels that enter and leave the chain",
    parameters: &[WIDTH, HEIGHT, UNITS, OVERHEAD],
    design: |values| Ok(elaborate_at(&sequencer(values)?, MERGE.period)?),
    scenario: |values| Ok(rounds(&sequencer(values)?)),
};

pub(super) const CRT_READ_OUT: Entry = Entry {
    name: "crt-read-out",
    summary: "reads the bank on display, refresh after refresh, and signals when the banks may change",
    parameters: &[WIDTH, HEIGHT, PIXEL_CLOCK],
    design: |values| Ok(elaborate_at(&read_out(values)?, display(values).period)?),
    scenario: |values| Ok(a_refresh(&read_out(values)?, values)),
};

pub(super) const ACCUMULATION: Entry = Entry {
    name: "accumulation",
    summary: "adds up the pictures of several passes and shows their average",
    parameters: &[WIDTH, HEIGHT, PIXEL_CLOCK],
    design: |values| Ok(elaborate(&accumulation(values)?)?),
    scenario: |values| Ok(two_sums(&accumulation(values)?)),
};

fn screen(values: &Values) -> Result<Screen, CatalogError> {
    Ok(Screen::new(values.get_u32("width"), values.get_u32("height"))?)
}

fn gfb_unit(values: &Values, accumulation: bool) -> Result<GfbUnit, CatalogError> {
    let (units, overhead) = (values.get_u32("units"), values.get_u32("overhead"));
    Ok(GfbUnit { screen: screen(values)?, units, overhead, display: display(values), accumulation }.checked()?)
}

fn two_frames(gfb: &GfbUnit) -> Scenario {
    let sequencer = gfb.sequencer();
    let background = 0xffffff_102030;
    let access = |address, writes, word| Stream::of(1, Access { address, writes, word });
    let no_access = Stream::of(0, Access { address: 0, writes: 0, word: 0 });
    let with = |accesses, merged| {
        let host = Host { accesses, background, multipass: two_passes(gfb.accumulation) };
        GfbUnitIn { swap: 0, host, merged }
    };
    let idle = |merged| with(no_access, merged);
    // A swap comes in the display's blanking, and the display begins with one.
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
        script.hold(&idle(merged), merges);
        // A host write in the clock of the swap goes to the previous frame.
        script.clock(&GfbUnitIn { swap: 1, ..with(access(1, 1, 99), merged) });
        script.clock(&with(access(2, 1, 63), merged));
        (0..4).for_each(|pixel| script.clock(&with(access(pixel, 0, 0), merged)));
        // Pixels that entered before the swap leave the chain unchanged.
        script.hold(&idle(merged), stale);
        clock += merges + 6 + stale;
    }
    if gfb.accumulation {
        script.hold(&idle(42), 3 * refresh);
        return script
            .finish("a picture of two passes, each of several rounds of merging; then its average is on display");
    }
    script.finish("two frames: rounds of merging, a swap of the banks in a blanking; then the host writes a pixel, and reads the first four")
}

fn two_pictures() -> Scenario {
    let [host] = two_passes(true).try_into().expect("there is an accumulation buffer");
    let mut script = Script::new(&MultipassControl, MERGE.period);
    let idle = MultipassControlIn { swap: 0, host, busy: 0, blanking: 0 };
    for _picture in 0..2 {
        for _pass in 0..2 {
            script.clock(&MultipassControlIn { swap: 1, blanking: 1, ..idle });
            script.hold(&MultipassControlIn { busy: 1, ..idle }, 6);
            script.hold(&idle, 2);
        }
        // The average is shown until the blanking after the one in which it began.
        script.hold(&MultipassControlIn { blanking: 1, ..idle }, 2);
        script.hold(&idle, 4);
    }
    script.finish("two pictures of two passes: each pass is added up, and the average of both is shown")
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
    script.finish("a round and the beginning of the next one, which a restart interrupts")
}

fn read_out(values: &Values) -> Result<CrtReadOut, CatalogError> {
    Ok(CrtReadOut { screen: screen(values)?, blanking: display(values).blanking })
}

fn a_refresh(crt: &CrtReadOut, values: &Values) -> Scenario {
    let mut script = Script::new(crt, display(values).period);
    script.hold(&CrtReadOutIn { word: 0xffffff_102030 }, crt.refresh_clocks() + 8);
    script.finish("the vertical blanking, and the refresh after it")
}

fn accumulation(values: &Values) -> Result<Accumulation, CatalogError> {
    Ok(Accumulation { screen: screen(values)?, crt: display(values).clock() })
}

fn two_sums(accumulation: &Accumulation) -> Scenario {
    let mut script = Script::new(accumulation, accumulation.crt.period);
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
    script.finish("two passes, each a picture in one colour; then two pixels of the average are read")
}
