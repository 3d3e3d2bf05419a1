//! The pages that each processing element needs, from a dry run of the same programs without hardware.
//!
//! Source: VC1-PT, VC1-PIG, VC1-APR. The first access to a patch takes a page, so the demand is the number of touched patches.

use super::assignment::Assignment;
use super::program::Settings;
use super::scan_conversion::{Pixels, Rows};
use serde::Serialize;
use tilewright_rtl::lfb::Patches;
use tilewright_scenes::Triangle;

/// The demand of a processing element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Demand {
    /// Pixels; a pixel counts each time that it is drawn.
    pub pixels: u64,
    /// Touched patches: the sufficient number of pages.
    pub pages: u32,
}

/// The demand of every processing element, if all draw packets of more than `apr` pixels.
pub fn demand(assignment: &Assignment, packets: &[Triangle], patches: &Patches, apr: Option<u32>) -> Vec<Demand> {
    let is_large = |packet: &&Triangle| Settings::is_large(apr, packet);
    let large: Vec<&Triangle> = packets.iter().filter(is_large).collect();
    let every = assignment.polygons.len() as u32;
    let of_processor = |(polygons, first): (&Vec<super::Polygon>, u32)| {
        let own = polygons.iter().flat_map(|polygon| &packets[polygon.packets.clone()]).filter(|it| !is_large(it));
        let own = own.map(|packet| Pixels::of(packet, Rows::ALL));
        let shared = large.iter().map(|packet| Pixels::of(packet, Rows { first, every }));
        let mut touched = vec![false; patches.count() as usize];
        let mut pixels = 0;
        for pixel in own.chain(shared).flatten() {
            touched[patches.place(pixel.x, pixel.y).patch as usize] = true;
            pixels += 1;
        }
        Demand { pixels, pages: touched.iter().filter(|touched| **touched).count() as u32 }
    };
    assignment.polygons.iter().zip(0..).map(of_processor).collect()
}
