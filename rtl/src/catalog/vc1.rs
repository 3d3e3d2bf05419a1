//! The entry of the VC-1's frame buffer subsystem.

use tilewright_hdl::{Scenario, Script, Stream, elaborate};

use super::shared::{
    ACCUMULATION_BUFFER, HEIGHT, PAGES, PATCH, PIXEL_CLOCK, PROCESSORS, RECEIVE_QUEUE, WIDTH, WORD_CLOCKS, display,
    two_passes,
};
use super::{CatalogError, Entry, Values};
use crate::bus::BusWord;
use crate::clocks::{MERGE, PE};
use crate::gfb::{Access, Host};
use crate::lfb::{LfbUnit, Patches, Request, Wanted};
use crate::parameter::Screen;
use crate::vc1::{OVERHEAD, ProcessorIn, Vc1, Vc1In};

pub(super) const VC1: Entry = Entry {
    name: "vc1",
    summary: "the frame buffer subsystem of a VC-1: local frame buffers, image merger, global frame buffer, swap control",
    parameters: &[
        WIDTH,
        HEIGHT,
        PATCH,
        PAGES,
        PROCESSORS,
        RECEIVE_QUEUE,
        WORD_CLOCKS,
        PIXEL_CLOCK,
        ACCUMULATION_BUFFER,
    ],
    design: |values| Ok(elaborate(&vc1(values)?)?),
    scenario: |values| Ok(a_frame(&vc1(values)?)),
};

fn vc1(values: &Values) -> Result<Vc1, CatalogError> {
    let screen = Screen::new(values.get_u32("width"), values.get_u32("height"))?;
    let patches = Patches::new(screen, values.get_u32("patch"))?;
    let lfb = LfbUnit { patches, pages: values.get_u32("pages") }.checked()?;
    Ok(Vc1 {
        lfb,
        processors: values.get_u32("processors"),
        queue: values.get_u32("queue"),
        word_clocks: values.get_u32("clocks"),
        display: display(values),
        overhead: OVERHEAD,
        accumulation: values.get("accumulation") == 1,
    }
    .checked()?)
}

fn a_frame(vc1: &Vc1) -> Scenario {
    let screen = vc1.lfb.patches.screen();
    let Screen { width, height } = screen;
    let [last_x, last_y] = [width - 1, height - 1].map(u64::from);

    let silent = Stream::of(0, BusWord { word: 0, last: 0 });
    let processor = ProcessorIn::default();
    let access = |valid, address| Stream::of(valid, Access { address, writes: 0, word: 0 });
    let multipass = two_passes(vc1.accumulation);
    let host = Host { accesses: access(0, 0), background: 0xffffff_102030, multipass };
    let all = |of: &dyn Fn(u64) -> ProcessorIn<u64>| Vc1In {
        processors: (0..vc1.processors.into()).map(of).collect(),
        command: silent,
        ready: 1,
        host: host.clone(),
    };
    let idle = all(&|_| processor);
    let draw = |x: u64, y: u64, word: u64| ProcessorIn { request: Stream::of(1, Request { x, y, word }), ..processor };

    let mut script = Script::new(vc1, PE.period);
    (0..vc1.processors).for_each(|number| script.ready(&format!("processors_{number}_received"), true));
    // A command of one word.
    script.hold(&Vc1In { command: Stream::of(1, BusWord { word: 1, last: 1 }), ..idle.clone() }, 1);
    for patch in 0..vc1.lfb.patches.count().into() {
        script.clock(&all(&|_| ProcessorIn { clear: Stream::of(1, Wanted { patch }), ..processor }));
        script.hold(&idle, 2);
    }
    script.clock(&all(&|number| draw(0, 0, 20 + number)));
    // This request waits until it is accepted: the first look-up misses, because its patch has no page, and takes 4
    // clocks.
    script.hold(&all(&|number| draw(last_x, last_y, 40 - number % 16)), 4);
    script.hold(&idle, 8);
    script.clock(&all(&|_| ProcessorIn { done: 1, ..processor }));

    script.in_clocks_of(MERGE.period);
    let refresh = vc1.gfb().read_out().refresh_clocks() * vc1.display.period.picoseconds();
    script.hold(&idle, vc1.gfb().sequencer().stored_clocks() + 60 + refresh.div_ceil(MERGE.period.picoseconds()));
    for address in [0, 1, u64::from(screen.pixels()) - 1] {
        script.clock(&Vc1In { host: Host { accesses: access(1, address), ..host.clone() }, ..idle.clone() });
        script.clock(&idle);
    }
    script.finish(
        "every processor clears its table, and draws the first and the last pixel; they swap, the merger keeps the nearest, the display shows them",
    )
}
