//! Every block by name, with its parameters and a scenario. The command line lists them, prints them as Verilog and
//! shows them as waves.

mod bus;
mod gfb;
mod lfb;
mod merger;
mod pixel_planes;
mod pixelflow;
mod quadtree;
mod shared;
mod swap;
mod vc1;

pub use tilewright_hdl::catalog::{CatalogError, Entry, Parameter, Values};

/// The blocks of a machine.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// The machine's name on the command line.
    pub machine: &'static str,
    /// The machine's name in a sentence.
    pub title: &'static str,
    /// The whole machine first, then its parts along the path of the data.
    pub entries: &'static [Entry],
}

/// The blocks, grouped by machine.
pub const GROUPS: [Group; 4] = [
    Group { machine: "vc1", title: "the VC-1", entries: VC1 },
    Group { machine: "quadtree", title: "the quadtree generator", entries: QUADTREE },
    Group { machine: "pixel-planes-5", title: "Pixel-planes 5", entries: PIXEL_PLANES },
    Group { machine: "pixelflow", title: "PixelFlow", entries: PIXELFLOW },
];

/// Every block, in the sequence of [`GROUPS`].
pub const ENTRIES: &[Entry] = &all::<55>();

const VC1: &[Entry] = &[
    vc1::VC1,
    bus::BROADCAST_BUS,
    lfb::LFB_UNIT,
    lfb::PATCH_TABLE,
    lfb::PAGE_ID_GENERATOR,
    lfb::IMAGE_MEMORY,
    lfb::SCAN_COUNTER,
    merger::MERGING_UNIT,
    merger::IMAGE_MERGER,
    gfb::GFB_UNIT,
    gfb::ACCUMULATING_GFB_UNIT,
    gfb::MULTIPASS_CONTROL,
    gfb::GFB_SEQUENCER,
    gfb::CRT_READ_OUT,
    gfb::ACCUMULATION,
    swap::VC1_SWAP,
    swap::SYNC_LINE,
    swap::LFB_SWAP,
    swap::GFB_SWAP,
];

const QUADTREE: &[Entry] = &[
    quadtree::QUADTREE_GENERATOR,
    quadtree::VIDEO_PROCESSOR,
    quadtree::SET_UP,
    quadtree::RASTER_PROCESSOR,
    quadtree::QUADTREE_STACK,
    quadtree::QUADTREE_PIPE,
    quadtree::QUADTREE_TREE,
    quadtree::COVERAGE_TEST,
    quadtree::QUADTREE_PIXEL,
    quadtree::VIDEO_BUFFER,
    quadtree::VIDEO_CONTROLLER,
];

const PIXEL_PLANES: &[Entry] = &[
    pixel_planes::PIXEL_PLANES_5,
    pixel_planes::RING,
    pixel_planes::RENDERER,
    pixel_planes::QUADRATIC_RENDERER,
    pixel_planes::IMAGE_GENERATION_CONTROLLER,
    pixel_planes::LINEAR_TREE,
    pixel_planes::QUADRATIC_TREE,
    pixel_planes::PIXEL_PROCESSOR,
    pixel_planes::BACKING_STORE,
    pixel_planes::REGION_ALLOCATOR,
    pixel_planes::FRAME_BUFFER,
];

const PIXELFLOW: &[Entry] = &[
    pixelflow::PIXELFLOW,
    pixelflow::NODE,
    pixelflow::COMMAND_DMA,
    pixelflow::ARRAY_CONTROLLER,
    pixelflow::LINEAR_EVALUATOR,
    pixelflow::PIXEL,
    pixelflow::TEXTURE_UNIT,
    pixelflow::TEXTURE_MEMORY,
    pixelflow::FRAME_BUFFER,
    pixelflow::SAMPLES_FRAME_BUFFER,
    pixelflow::NETWORK_SEQUENCER,
    pixelflow::NETWORK,
    pixelflow::NETWORK_PORT,
    pixelflow::COMPOSITOR,
];

/// The entries of all groups; there must be `COUNT` of them.
const fn all<const COUNT: usize>() -> [Entry; COUNT] {
    let mut all = [VC1[0]; COUNT];
    let (mut group, mut count) = (0, 0);
    while group < GROUPS.len() {
        let entries = GROUPS[group].entries;
        let mut entry = 0;
        while entry < entries.len() {
            all[count] = entries[entry];
            (entry, count) = (entry + 1, count + 1);
        }
        group += 1;
    }
    assert!(count == COUNT, "COUNT is not the number of entries");
    all
}

/// The entry with that name.
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|entry| entry.name == name)
}
