//! How many pages each processing element needs: a dry run of the same programs without hardware.
//!
//! Source: VC1-PT, VC1-PIG. A page is taken by the first access to a patch, so the demand is the number of patches touched.

use super::assignment::Assignment;
use super::scan_conversion::Pixels;
use serde::Serialize;
use tilewright_rtl::lfb::Patches;
use tilewright_scenes::Triangle;

/// What a processing element draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Demand {
    /// Pixels, each as often as it is drawn.
    pub pixels: u64,
    /// Patches touched, which is the number of pages that suffices.
    pub pages: u32,
}

/// The demand of every processing element.
pub fn demand(assignment: &Assignment, packets: &[Triangle], patches: &Patches) -> Vec<Demand> {
    let of_processor = |polygons: &Vec<super::Polygon>| {
        let mut touched = vec![false; patches.count() as usize];
        let mut pixels = 0;
        for packet in polygons.iter().flat_map(|polygon| &packets[polygon.packets.clone()]) {
            for pixel in Pixels::of(packet) {
                touched[patches.place(pixel.x, pixel.y).patch as usize] = true;
                pixels += 1;
            }
        }
        Demand { pixels, pages: touched.iter().filter(|touched| **touched).count() as u32 }
    };
    assignment.polygons.iter().map(of_processor).collect()
}
