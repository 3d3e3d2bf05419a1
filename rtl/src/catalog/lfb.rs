//! The entries of the local frame buffer and its parts.

use tilewright_hdl::{Scenario, Script, Stream, elaborate, elaborate_at};

use super::shared::{EMPTY, HEIGHT, PAGES, PATCH, WIDTH};
use super::{CatalogError, Entry, Parameter, Values};
use crate::clocks::{MERGE, PE};
use crate::lfb::{
    Draw, ImageMemory, ImageMemoryIn, LfbUnit, LfbUnitIn, PageIdGenerator, PageIdGeneratorIn, PatchTable, PatchTableIn,
    Patches, Request, ScanCounter, ScanCounterIn, ScanLookUp, SendPixel, Wanted, check_edge,
};
use crate::parameter::Screen;
use crate::scan::ScanControl;

pub(super) const LFB_UNIT: Entry = Entry {
    name: "lfb-unit",
    summary: "a virtual local frame buffer: a full screen in less memory",
    parameters: &[WIDTH, HEIGHT, PATCH, PAGES],
    design: |values| Ok(elaborate(&lfb_unit(values)?)?),
    scenario: |values| Ok(draw_swap_and_send(&lfb_unit(values)?)),
};

pub(super) const PATCH_TABLE: Entry = Entry {
    name: "patch-table",
    summary: "gives a patch its page on the first access",
    parameters: &[
        Parameter { name: "patches", default: 8, min: 4, max: 1 << 18, meaning: "patches on the screen" },
        PAGES,
    ],
    design: |values| Ok(elaborate(&patch_table(values))?),
    scenario: |values| Ok(misses_and_hits(&patch_table(values))),
};

pub(super) const PAGE_ID_GENERATOR: Entry = Entry {
    name: "page-id-generator",
    summary: "names the next free page",
    parameters: &[PAGES],
    design: |values| Ok(elaborate_at(&page_id_generator(values), PE.period)?),
    scenario: |values| Ok(take_two_pages(&page_id_generator(values))),
};

pub(super) const IMAGE_MEMORY: Entry = Entry {
    name: "image-memory",
    summary: "keeps the nearer word of each pixel, and clears what it sends",
    parameters: &[PATCH, PAGES],
    design: |values| Ok(elaborate(&image_memory(values)?)?),
    scenario: |values| Ok(draw_thrice_and_send(&image_memory(values)?)),
};

pub(super) const SCAN_COUNTER: Entry = Entry {
    name: "scan-counter",
    summary: "selects the pixel that is sent to the merger next",
    parameters: &[
        WIDTH,
        HEIGHT,
        Parameter { name: "position", default: 1, min: 0, max: 255, meaning: "place in the chain, from 0" },
    ],
    design: |values| Ok(elaborate_at(&scan_counter(values)?, MERGE.period)?),
    scenario: |values| Ok(a_frame(&scan_counter(values)?, values.get_u32("position"))),
};

fn page_id_generator(values: &Values) -> PageIdGenerator {
    PageIdGenerator { pages: values.get_u32("pages") }
}

fn take_two_pages(generator: &PageIdGenerator) -> Scenario {
    let mut script = Script::new(generator, PE.period);
    for (restart, take) in [(0, 0), (0, 1), (0, 0), (0, 1), (0, 0), (1, 0), (0, 1), (0, 0)] {
        script.clock(&PageIdGeneratorIn { restart, take });
    }
    script.finish("two pages are taken; after a restart the first one is free again")
}

fn patch_table(values: &Values) -> PatchTable {
    PatchTable { patches: values.get_u32("patches"), pages: values.get_u32("pages") }
}

fn misses_and_hits(table: &PatchTable) -> Scenario {
    let mut script = Script::new(table, PE.period);
    let none = Stream::of(0, Wanted { patch: 0 });
    let idle = PatchTableIn {
        look_up: none,
        clear: none,
        front: 0,
        settled: 1,
        restart: 0,
        resume: 0,
        scan: ScanLookUp { enable: 1, patch: 3, buffer: 0 },
    };
    script.clock(&idle);
    // The first look-up is accepted at once, and each later one in the last clock of its predecessor.
    for (patch, clocks) in [(3, 1), (3, 4), (1, 3), (3, 4)] {
        script.hold(&PatchTableIn { look_up: Stream::of(1, Wanted { patch }), ..idle }, clocks);
    }
    script.hold(&idle, 4);
    script.clock(&PatchTableIn { clear: Stream::of(1, Wanted { patch: 3 }), ..idle });
    script.hold(&idle, 8);
    script.finish("two patches get a page on their first look-up, in 4 clocks, and are found in 3; then one is cleared")
}

fn image_memory(values: &Values) -> Result<ImageMemory, CatalogError> {
    let edge = values.get_u32("patch");
    check_edge(edge)?;
    Ok(ImageMemory { pages: values.get_u32("pages"), page_pixels: edge.pow(2) })
}

fn draw_thrice_and_send(memory: &ImageMemory) -> Scenario {
    let mut script = Script::new(memory, PE.period);
    let idle = ImageMemoryIn {
        draw: Draw { valid: 0, page: 1, offset: 5, word: 0 },
        front: 0,
        send: SendPixel { enable: 0, resident: 1, page: 1, offset: 5, buffer: 0 },
    };
    for word in [70, 60, 65] {
        script.clock(&ImageMemoryIn { draw: Draw { valid: 1, word, ..idle.draw }, ..idle });
        script.hold(&idle, 2);
    }
    let swapped = ImageMemoryIn { front: 1, ..idle };
    script.hold(&swapped, 3);
    script.hold(&ImageMemoryIn { send: SendPixel { enable: 1, ..idle.send }, ..swapped }, 10);
    script.finish("three words are drawn on a pixel, and the smallest stays; sending it clears the pixel")
}

fn scan_counter(values: &Values) -> Result<ScanCounter, CatalogError> {
    Ok(ScanCounter { screen: Screen::new(values.get_u32("width"), values.get_u32("height"))? })
}

fn a_frame(counter: &ScanCounter, position: u32) -> Scenario {
    let mut script = Script::new(counter, MERGE.period);
    let preset = ScanCounter::preset(counter.screen, position);
    let scan = |restart, enable| ScanCounterIn { scan: ScanControl { restart, enable }, preset };
    script.clock(&scan(0, 0));
    script.clock(&scan(1, 0));
    script.hold(&scan(0, 1), counter.screen.pixels());
    script.hold(&scan(0, 0), 4);
    script.hold(&scan(0, 1), 4 * position + 4);
    script.finish("a restart, and a frame with a pause near its end")
}

fn lfb_unit(values: &Values) -> Result<LfbUnit, CatalogError> {
    let screen = Screen::new(values.get_u32("width"), values.get_u32("height"))?;
    let patches = Patches::new(screen, values.get_u32("patch"))?;
    Ok(LfbUnit { patches, pages: values.get_u32("pages") }.checked()?)
}

fn draw_swap_and_send(unit: &LfbUnit) -> Scenario {
    let mut script = Script::new(unit, PE.period);
    let screen = unit.patches.screen();
    let edge = u64::from(unit.patches.edge());
    let idle = LfbUnitIn {
        request: Stream::of(0, Request { x: 0, y: 0, word: EMPTY }),
        clear: Stream::of(0, Wanted { patch: 0 }),
        swap: 0,
        resume: 0,
        scan: ScanControl { restart: 0, enable: 0 },
        preset: ScanCounter::preset(screen, 0),
    };
    // The merge clock drives the scan's control; its period is a bit more than three processor clocks.
    script.hold(&LfbUnitIn { scan: ScanControl { restart: 1, enable: 0 }, ..idle }, 4);
    // Two patches, each a miss on its first access. A request waits until it is accepted.
    for (x, word, clocks) in [(0, 70, 1), (1, 50, 4), (edge, 60, 3), (edge, 40, 4)] {
        script.hold(&LfbUnitIn { request: Stream::of(1, Request { x, y: 0, word }), ..idle }, clocks);
    }
    script.hold(&idle, 8);
    script.clock(&LfbUnitIn { swap: 1, ..idle });
    for patch in [0, 1] {
        script.clock(&LfbUnitIn { clear: Stream::of(1, Wanted { patch }), ..idle });
        script.hold(&idle, 2);
    }
    let sending = LfbUnitIn { scan: ScanControl { restart: 0, enable: 1 }, ..idle };
    script.hold(&LfbUnitIn { request: Stream::of(1, Request { x: 2, y: 1, word: 30 }), ..sending }, 1);
    script.hold(&sending, 4 * edge + 30);
    script.finish(
        "four pixels of two patches are drawn; the buffers are swapped, and the scan sends and clears the pixels",
    )
}
