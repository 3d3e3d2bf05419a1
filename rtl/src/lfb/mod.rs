//! The local frame buffer of the VC-1: a full virtual screen in a smaller memory, by demand paging of patches.

mod image_memory;
mod page_id_generator;
mod patch_table;
mod patches;
mod scan_counter;
mod unit;

pub use image_memory::{Draw, ImageMemory, ImageMemoryIn, ImageMemoryOut, SendPixel};
pub use page_id_generator::{PageIdGenerator, PageIdGeneratorIn, PageIdGeneratorOut};
pub use patch_table::{PatchTable, PatchTableIn, PatchTableOut, ScanLookUp, Wanted};
pub(crate) use patches::check_edge;
pub use patches::{Patches, Place};
pub use scan_counter::{ScanCounter, ScanCounterIn, ScanCounterOut};
pub use unit::{LfbUnit, LfbUnitIn, LfbUnitOut, Request};
