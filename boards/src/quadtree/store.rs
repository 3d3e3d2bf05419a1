//! The packets of all steps as the words of a memory.

use std::fmt;

use tilewright_hdl::{Bits, Signal, row};
use tilewright_rtl::quadtree::format::{Bounds, EdgeFunction, Format, PLANES, Packet, Plane as Planes};
use tilewright_rtl::quadtree::precision::Precision;
use tilewright_scenes::{Plane, Triangle};

use super::turning::Step;

/// The edges of each packet.
pub(super) const EDGES: u32 = 3;

/// Packets of triangles in a memory, one behind the other in words of the same width, the lowest bits first.
///
/// A packet has its fields in the sequence of the [`Packet`], the first in the lowest bits, without the number of its
/// edges. The bit above them is high in the last packet of a step.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Store {
    format: Format,
    word: u32,
    words: Vec<Bits>,
}

/// Not the words: the text is a part of modules' names and headers.
impl fmt::Debug for Store {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&summary(&self.words))
    }
}

/// What stands for words in a text: their number, and a sum of them.
pub(super) fn summary(words: &[Bits]) -> String {
    // FNV-1a.
    let mix = |sum: u32, limb: &u64| (sum ^ (limb ^ (limb >> 32)) as u32).wrapping_mul(0x0100_0193);
    let sum = words.iter().flat_map(|word| word.limbs()).fold(0x811c_9dc5, mix);
    format!("\"{}_words_{sum:08x}\"", words.len())
}

/// The packets of all steps, and whether each is the last of its step.
pub(super) fn packets(steps: &[Step]) -> impl Iterator<Item = (&Triangle, bool)> {
    steps.iter().flat_map(|step| {
        let of_step = step.packets.iter().enumerate();
        of_step.map(|(number, packet)| (packet, number + 1 == step.packets.len()))
    })
}

/// The increases and the origin of each plane, depth first, without the lower bits that the machine leaves out.
pub(super) fn cut_planes(packet: &Triangle, precision: &Precision) -> [[i64; 3]; PLANES as usize] {
    let cut = |Plane { x, y, origin }: Plane, by: u32| [x, y, origin].map(|number| (number >> by) as i64);
    let [red, green, blue] = packet.rgb.map(|plane| cut(plane, precision.cut_of_colour()));
    [cut(packet.z, precision.cut_of_depth()), red, green, blue]
}

/// The bounds of a packet, in the sequence in which they are stored.
pub(super) fn bounds(packet: &Triangle) -> [i64; 4] {
    let bounds = packet.bounds;
    [bounds.left, bounds.top, bounds.right, bounds.bottom].map(i64::from)
}

/// Fields side by side, the first in the lowest bits.
pub(super) fn joined(fields: impl IntoIterator<Item = Bits>) -> Bits {
    fields.into_iter().reduce(|low, high| high.concat(&low)).expect("there are fields")
}

impl Store {
    /// The packets of these steps, in words of that width.
    pub fn new(format: Format, steps: &[Step], word: u32) -> Store {
        let mut store = Store { format, word, words: Vec::new() };
        packets(steps).for_each(|(packet, is_last)| store.push(packet, is_last));
        store
    }

    /// The width of a word.
    pub fn word(&self) -> u32 {
        self.word
    }

    /// The words.
    pub fn words(&self) -> &[Bits] {
        &self.words
    }

    /// The words of a packet.
    pub fn words_of_packet(&self) -> u32 {
        (self.bits_of_packet() + 1).div_ceil(self.word)
    }

    /// The number of packets.
    pub fn packets(&self) -> u32 {
        self.words.len() as u32 / self.words_of_packet()
    }

    fn push(&mut self, packet: &Triangle, is_last: bool) {
        let precision = self.format.precision();
        let mut fields = Vec::new();
        let mut put = |number: i64, bits: u32| fields.push(Bits::from_i128(bits, number.into()));
        packet.edges.iter().for_each(|edge| put(edge.a.into(), precision.slope));
        packet.edges.iter().for_each(|edge| put(edge.b.into(), precision.slope));
        packet.edges.iter().for_each(|edge| put(edge.c.into(), precision.edge));
        let planes = cut_planes(packet, &precision);
        (0..3).for_each(|number| planes.iter().for_each(|plane| put(plane[number], precision.plane)));
        bounds(packet).into_iter().for_each(|bound| put(bound, precision.position));
        put(is_last.into(), 1);
        let (count, word) = (self.words_of_packet(), self.word);
        let all = joined(fields).resize(count * word);
        self.words.extend((0..count).map(|number| all.slice(number * word..(number + 1) * word)));
    }

    fn bits_of_packet(&self) -> u32 {
        let precision = self.format.precision();
        EDGES * (2 * precision.slope + precision.edge) + 3 * PLANES * precision.plane + 4 * precision.position
    }

    /// The packet in its words side by side, and whether it is the last of its step.
    pub(super) fn packet(&self, words: Signal) -> (Packet, Signal) {
        let precision = self.format.precision();
        let mut at = 0;
        let mut take = |bits: u32, lanes: u32| {
            at += bits * lanes;
            words.part(at - bits * lanes, bits * lanes)
        };
        let mut of_edges = |bits: u32| take(bits, EDGES).unpack(row(EDGES)).signed();
        let edges =
            EdgeFunction { a: of_edges(precision.slope), b: of_edges(precision.slope), c: of_edges(precision.edge) };
        let mut plane = || take(precision.plane, PLANES).unpack(row(PLANES));
        let planes = Planes { x: plane(), y: plane(), origin: plane() };
        let mut bound = || take(precision.position, 1);
        let bounds = Bounds { left: bound(), top: bound(), right: bound(), bottom: bound() };
        let last_edge = tilewright_hdl::lit(Packet::widths(self.format).last_edge.bits(), EDGES - 1);
        (Packet { last_edge, edges, planes, bounds }, take(1, 1))
    }
}
