//! Every block by name, with its parameters and a scenario: what the command line lists, prints and shows as a wave.

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

/// Every block: each machine as a whole, then its parts in the order of the data's way through it.
pub const ENTRIES: &[Entry] = &[
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

/// The entry of that name.
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|entry| entry.name == name)
}
