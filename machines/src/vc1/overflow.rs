//! A local frame buffer has run out of pages, and how many would do.
//!
//! Source: VC1-PIG. The machine of the paper swaps its buffers then (VC1-SW4); this one stops.

/// A processing element whose local frame buffer overflowed. `Display` is the whole sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "processor {processor} ran out of its {pages} image memory pages at polygon {polygon}: at least {sufficient} pages per \
     processor would do: pass --pages {sufficient}"
)]
pub struct Overflow {
    /// The processing element, from 0.
    pub processor: usize,
    /// The pages that it has.
    pub pages: u32,
    /// The polygon of the scene, from 0, of which a pixel found no page.
    pub polygon: u32,
    /// The least number of pages with which no processing element overflows.
    pub sufficient: u32,
}
