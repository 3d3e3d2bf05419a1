//! The packet of a triangle, or of another convex polygon: the interface between set-up and a rasterizer, golden or
//! hardware, and the formats of its fields.
//!
//! Source: facts E0 (the integer contract), DES-EDGE, DES-Z and DES-W. This module has only types and constants. The
//! formulas that evaluate a packet at a pixel are in [`crate::golden`], and each machine has its own.

/// Sub-pixel positions in a pixel, along each axis.
pub const SUBPIXELS: i32 = 16;
/// Bits of a depth value.
pub const DEPTH_BITS: u32 = 24;
/// The bits of a depth plane's numbers, which are added modulo 2^40; depth is bits 39..16.
pub const DEPTH_PLANE_BITS: u32 = 40;
/// The bits of a colour plane's numbers, which are added modulo 2^24; the channel is bits 23..16.
pub const COLOUR_PLANE_BITS: u32 = 24;
/// The bits of any other parameter's plane, which is added modulo 2^32; the parameter is bits 31..16.
pub const PARAMETER_PLANE_BITS: u32 = 32;
/// Fraction bits of all kinds of plane.
pub const FRACTION_BITS: u32 = 16;
/// The depth of "nothing here": all ones.
pub const EMPTY_DEPTH: u32 = (1 << DEPTH_BITS) - 1;
/// The least depth of a vertex.
pub const NEAREST_VERTEX: u32 = 1;
/// The greatest depth of a vertex; with it, the plane's rounding reaches neither 0 nor [`EMPTY_DEPTH`].
pub const FARTHEST_VERTEX: u32 = (1 << DEPTH_BITS) - 3;
/// Bits of a visibility word, `z << 24 | r << 16 | g << 8 | b`.
pub const WORD_BITS: u32 = 48;
/// The word of an empty local buffer: the identity of the minimum (DES-MIN).
pub const EMPTY: u64 = (1 << WORD_BITS) - 1;

/// A vertex on the screen: the interface between front end and set-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ScreenVertex {
    /// Rightward from the left edge of pixel 0, in 1/16 pixel; fits 16 bits signed.
    pub x: i32,
    /// Downward from the upper edge of row 0, in 1/16 pixel; fits 16 bits signed.
    pub y: i32,
    /// Depth, smaller is nearer; [`NEAREST_VERTEX`] to [`FARTHEST_VERTEX`].
    pub z: u32,
    /// Red, green, blue.
    pub rgb: [u8; 3],
}

/// An edge function over whole pixels: pixel (x, y) is inside iff `a*x + b*y + c >= 0`.
///
/// `c` is the reduced form C' of facts E0: sub-pixel position and top-left rule are folded into it (DES-EDGE).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Edge {
    /// Step per pixel rightward; 17 bits signed (20 in the packet).
    pub a: i32,
    /// Step per row downward; 17 bits signed (20 in the packet).
    pub b: i32,
    /// Value at pixel (0, 0); 32 bits signed.
    pub c: i32,
}

/// A plane over whole pixels in modular arithmetic: `(x*px + y*py + origin) mod 2^n`, with 16 fraction bits.
///
/// n is [`DEPTH_PLANE_BITS`], [`COLOUR_PLANE_BITS`] or [`PARAMETER_PLANE_BITS`]; every field is below 2^n. A sliver's gradients may wrap: only the values at
/// covered pixels matter, and those are in range (DES-Z).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plane {
    /// Step per pixel rightward, modulo 2^n (zx in facts E0).
    pub x: u64,
    /// Step per row downward, modulo 2^n (zy).
    pub y: u64,
    /// Value at pixel (0, 0) plus half a unit for rounding, modulo 2^n (z0).
    pub origin: u64,
}

/// A rectangle of pixels; all four bounds belong to it. For a polygon between the centres of two neighbouring columns
/// it is empty: then `left` is `right + 1`. The same is true of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PixelBox {
    /// Leftmost column.
    pub left: u32,
    /// Uppermost row.
    pub top: u32,
    /// Rightmost column, itself inside.
    pub right: u32,
    /// Lowest row, itself inside.
    pub bottom: u32,
}

impl PixelBox {
    /// Whether no pixel is in the box.
    pub fn is_empty(&self) -> bool {
        self.left > self.right || self.top > self.bottom
    }

    /// Whether pixel (x, y) is in the box.
    pub fn contains(&self, x: u32, y: u32) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }
}

/// The most edges that a packet has.
pub const MOST_EDGES: usize = 8;

/// The packet: one convex polygon, ready for a rasterizer. It has three edges in a [`Triangle`], and 3 to 8 in a
/// [`Polygon`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Packet<E> {
    /// Edge i runs from vertex i to vertex i+1, in the direction that makes the area positive (y points down).
    pub edges: E,
    /// Depth, 40 bits modular.
    pub z: Plane,
    /// Red, green, blue, 24 bits modular each.
    pub rgb: [Plane; 3],
    /// The pixels whose centres the vertices enclose, cut to the screen; no covered pixel lies outside.
    pub bounds: PixelBox,
    /// Twice the area, in 1/256 square pixel; positive.
    pub area2: i64,
    /// The number of the polygon in the scene. Clipping can make several triangles of one polygon. Set-up leaves 0 here
    /// and [`crate::project`] fills it in.
    pub polygon: u32,
}

/// The packet of a triangle. Made by [`crate::set_up`].
pub type Triangle = Packet<[Edge; 3]>;

/// The packet of a convex polygon of 3 to [`MOST_EDGES`] edges. Made by [`crate::set_up_polygon`].
pub type Polygon = Packet<Vec<Edge>>;

impl<E> Packet<E> {
    /// Area in pixels.
    pub fn area(&self) -> f64 {
        self.area2 as f64 / f64::from(2 * SUBPIXELS * SUBPIXELS)
    }
}

impl From<Triangle> for Polygon {
    fn from(triangle: Triangle) -> Polygon {
        let Packet { edges, z, rgb, bounds, area2, polygon } = triangle;
        Packet { edges: edges.to_vec(), z, rgb, bounds, area2, polygon }
    }
}

#[cfg(test)]
mod tests {
    use crate::setup::set_up;
    use crate::size::Size;

    use super::*;

    #[test]
    fn a_packet_tells_its_area_and_its_pixels() {
        let at = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [0; 3] };
        let size = Size::new(40, 40).expect("in range");
        let packet = set_up(&[at(2, 3), at(7, 3), at(2, 12)], size).expect("covers pixels");
        assert_eq!(packet.area(), 22.5);
        let bounds = packet.bounds;
        assert_eq!(bounds, PixelBox { left: 2, top: 3, right: 6, bottom: 11 });
        let inside = (0..40).flat_map(|y| (0..40).map(move |x| (x, y))).filter(|&(x, y)| bounds.contains(x, y));
        assert_eq!(inside.count(), 45);
    }
}
