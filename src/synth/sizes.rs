//! The sizes at which the table of all blocks has them.

/// Values of parameters.
type Size = &'static [(&'static str, u64)];

/// A block's default parameters.
const DEFAULT: &[Size] = &[&[]];

/// The sizes of a block, of which the table has those up to the first that fits. Many blocks of the machines have the sizes of their
/// papers. Some are smaller, so that the device suffices and the tools end within minutes. All other blocks have defaults.
pub fn sizes(block: &str) -> &'static [Size] {
    match block {
        "vc1" => &[&[("width", 64), ("height", 48), ("pages", 64)]],
        "broadcast-bus" | "sync-line" | "vc1-swap" | "gfb-swap" => &[&[("processors", 16)]],
        "lfb-unit" => &[&[("width", 640), ("height", 480), ("pages", 1024)]],
        "patch-table" => &[&[("patches", 19_200), ("pages", 4096)]],
        "page-id-generator" => &[&[("pages", 4096)]],
        "image-memory" => &[&[("pages", 1024)]],
        "scan-counter" | "crt-read-out" => &[&[("width", 640), ("height", 480)]],
        "image-merger" => &[&[("units", 16)]],
        "gfb-unit" => &[&[("width", 160), ("height", 120), ("units", 16)]],
        "accumulating-gfb-unit" => &[&[("width", 24), ("height", 18), ("units", 16)]],
        "gfb-sequencer" => &[&[("width", 640), ("height", 480), ("units", 16)]],
        "accumulation" => &[&[("width", 160), ("height", 120)]],
        "quadtree-generator" => &[&[("width", 160), ("height", 120), ("columns", 1), ("rows", 1), ("stack", 8)]],
        "quadtree-pipe" => &[&[("width", 64), ("height", 64), ("columns", 16), ("rows", 16)]],
        "quadtree-tree" => &[&[("width", 64), ("height", 64), ("columns", 16), ("rows", 16), ("queue", 1)]],
        "quadtree-set-up" | "quadtree-stack" | "coverage-test" | "quadtree-pixel" | "video-controller" => {
            &[&[("width", 640), ("height", 480), ("columns", 4), ("rows", 4)]]
        }
        "raster-processor" | "video-processor" => {
            &[&[("width", 640), ("height", 480), ("columns", 4), ("rows", 4), ("stack", 8)]]
        }
        "video-buffer" => &[
            &[("width", 640), ("height", 480), ("columns", 4), ("rows", 4)],
            &[("width", 160), ("height", 120), ("columns", 4), ("rows", 4)],
        ],
        "pixel-planes-5" => &[&[("width", 16), ("height", 8), ("renderers", 2), ("side", 8)]],
        "ring" => &[&[("renderers", 8)]],
        "pixelflow" => &[&[("line", 4), ("lines", 2)]],
        "region-allocator" => &[&[("renderers", 16)]],
        "image-generation-controller" => &[&[("side", 128)]],
        "array-controller" => &[&[("line", 128), ("lines", 64)]],
        "command-dma" => &[&[("words", 4096)]],
        _ => DEFAULT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::entries;

    #[test]
    fn every_size_is_one_that_its_block_can_have() {
        for entry in entries() {
            for size in sizes(entry.name) {
                if let Err(error) = entry.values(size.iter().copied()) {
                    panic!("{}: {error}", entry.name);
                }
            }
        }
    }
}
