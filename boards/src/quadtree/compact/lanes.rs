//! Packets as words of an edge and a plane, and the memory that they are in.

use std::fmt;

use tilewright_hdl::{Bits, Signal, bits, record};
use tilewright_rtl::quadtree::format::{Bounds, Format, PLANES};
use tilewright_scenes::Triangle;

use crate::quadtree::store::{bounds, cut_planes, joined, packets, summary};
use crate::quadtree::turning::Step;

/// The words of each packet: one for each plane.
pub(super) const WORDS: u32 = PLANES;

record! {
    /// A word of a packet: word k has edge function k and plane k. The last one has the bounds in place of an edge.
    pub struct Lane(format: Format) {
        /// The coefficients `a`, `b` and `c` of the edge function, the first in the lowest bits. In the last word these
        /// are the bounds, from the left one on, and a bit that is high in the last packet of a step.
        function: bits(function_bits(&format)),
        /// The increase of the plane per pixel to the right.
        x: bits(format.precision().plane),
        /// The increase of the plane per line downward.
        y: bits(format.precision().plane),
        /// The value of the plane at the upper left pixel.
        origin: bits(format.precision().plane),
    }
}

/// The bits of an edge function, or of the bounds and the bit above them.
fn function_bits(format: &Format) -> u32 {
    let precision = format.precision();
    (2 * precision.slope + precision.edge).max(4 * precision.position + 1)
}

/// The bits of a word.
fn word_bits(format: &Format) -> u32 {
    function_bits(format) + 3 * format.precision().plane
}

impl Lane {
    /// The coefficients of the edge function.
    pub(super) fn edge(&self, format: &Format) -> [Signal; 3] {
        let precision = format.precision();
        let part = |low: u32, bits: u32| self.function.part(low, bits).signed();
        [part(0, precision.slope), part(precision.slope, precision.slope), part(2 * precision.slope, precision.edge)]
    }

    /// The bounds.
    pub(super) fn bounds(&self, format: &Format) -> Bounds {
        let bits = format.precision().position;
        let bound = |number: u32| self.function.part(number * bits, bits);
        Bounds { left: bound(0), top: bound(1), right: bound(2), bottom: bound(3) }
    }

    /// Whether the packet is the last of its step.
    pub(super) fn is_last(&self, format: &Format) -> Signal {
        self.function.bit(4 * format.precision().position)
    }

    /// The word that a memory reads.
    pub(super) fn of(format: &Format, word: Signal) -> Lane {
        let (function, plane) = (function_bits(format), format.precision().plane);
        let of_plane = |number: u32| word.part(function + number * plane, plane);
        Lane { function: word.part(0, function), x: of_plane(0), y: of_plane(1), origin: of_plane(2) }
    }
}

/// Packets of triangles as words, one packet behind the other.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Lanes {
    format: Format,
    words: Vec<Bits>,
}

/// Not the words: the text is a part of modules' names and headers.
impl fmt::Debug for Lanes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&summary(&self.words))
    }
}

impl Lanes {
    /// The packets of these steps.
    pub fn new(format: Format, steps: &[Step]) -> Lanes {
        let of_packet = |(packet, is_last)| (0..WORDS).map(move |lane| word(&format, packet, lane, is_last));
        Lanes { format, words: packets(steps).flat_map(of_packet).collect() }
    }

    /// The words.
    pub fn words(&self) -> &[Bits] {
        &self.words
    }

    /// The width of a word.
    pub fn word(&self) -> u32 {
        word_bits(&self.format)
    }
}

/// Word `lane` of a packet.
fn word(format: &Format, packet: &Triangle, lane: u32, is_last: bool) -> Bits {
    let precision = format.precision();
    let bits = |number: i64, bits: u32| Bits::from_i128(bits, number.into());
    let function = match packet.edges.get(lane as usize) {
        Some(edge) => joined([
            bits(edge.a.into(), precision.slope),
            bits(edge.b.into(), precision.slope),
            bits(edge.c.into(), precision.edge),
        ]),
        None => {
            let bounds = bounds(packet).map(|bound| bits(bound, precision.position));
            joined(bounds.into_iter().chain([bits(is_last.into(), 1)]))
        }
    };
    let plane = cut_planes(packet, &precision)[lane as usize].map(|number| bits(number, precision.plane));
    let function = function.resize(function_bits(format));
    joined([function].into_iter().chain(plane))
}
