//! The number of lanes that a kernel processes at a time.
//!
//! A vector contains as many elements of one size as fit; smaller values are widened to fill it, larger ones take
//! several vectors. With vectors of 128 bits, strips of 4 suit 32-bit values, and strips of 16 suit 8-bit values.

use std::collections::BTreeMap;

use tilewright_circuit::ir::Affine;

use crate::engine::layout::element;
use crate::engine::program::{Axis, Cell, Kind, Program};

/// For each lane count: the strip of a kernel, and the distance of the furthest neighbour that it reads. A strip has as
/// many lanes as a vector has integers of 8, 16 or 32 bits.
#[derive(Debug, Clone)]
pub(crate) struct StripSizes {
    /// Bits of a vector.
    vector: u32,
    strips: BTreeMap<u32, Strip>,
}

#[derive(Debug, Clone, Copy)]
struct Strip {
    size: u32,
    /// In lanes.
    reach: u32,
}

impl Default for StripSizes {
    fn default() -> Self {
        StripSizes { vector: 128, strips: BTreeMap::new() }
    }
}

impl StripSizes {
    /// Strips for the values of a program, in vectors of so many bits.
    pub fn of(program: &Program, vector: u32) -> StripSizes {
        let mut arrays: BTreeMap<u32, Array> = BTreeMap::new();
        for (_, cell) in program.circuit.cells().filter(|(_, cell)| cell.lanes > 1) {
            arrays.entry(cell.lanes).or_default().add(cell);
        }
        let strip = |array: Array, lanes| Strip { size: array.strip(lanes, vector), reach: array.reach };
        let strips = arrays.into_iter().map(|(lanes, array)| (lanes, strip(array, lanes))).collect();
        StripSizes { vector, strips }
    }

    /// Bits of a vector.
    pub fn vector(&self) -> u32 {
        self.vector
    }

    /// The strip of arrays with this number of lanes.
    pub fn strip(&self, lanes: u32) -> u32 {
        self.strips.get(&lanes).map_or(self.vector / 32, |strip| strip.size)
    }

    /// The number of lanes before and after such an array that code may read.
    pub fn reach(&self, lanes: u32) -> u32 {
        self.strips.get(&lanes).map_or(0, |strip| strip.reach)
    }
}

/// The values of one lane count.
#[derive(Debug, Clone, Default)]
struct Array {
    /// The number of values with elements of 8, 16, 32 and 64 bits; flags, which fit any element, are not counted.
    elements: [u32; 4],
    /// The furthest neighbour.
    reach: u32,
    /// The sizes of groups of lanes that share something.
    groups: Vec<u32>,
}

impl Array {
    fn add(&mut self, cell: &Cell) {
        if cell.width > 1 {
            self.elements[element(cell.width).min(64).ilog2() as usize - 3] += 1;
        }
        let mut group = |axis: Axis| {
            let group = if axis.inner > 1 { axis.inner } else { axis.count };
            self.groups.extend((group < cell.lanes).then_some(group));
        };
        match cell.kind {
            Kind::Broadcast { axis, .. } => group(axis),
            Kind::Map { axis, index: Affine { mul: 1, add, div: 1 }, .. } => {
                group(axis);
                let reach = add.unsigned_abs().saturating_mul(axis.inner);
                self.reach = self.reach.max(reach.min(cell.lanes));
            }
            _ => {}
        }
    }

    /// The size of a strip: what suits most values, or a smaller size that divides the groups.
    fn strip(&self, lanes: u32, vector: u32) -> u32 {
        let [bytes, words, doubles, quads] = self.elements;
        let filling @ [of_bytes, of_words, of_doubles] = [8, 16, 32].map(|element| vector / element);
        let most = match () {
            () if bytes > words + 2 * (doubles + quads) => of_bytes,
            () if bytes + words > 2 * (doubles + quads) => of_words,
            () => of_doubles,
        };
        let most = most.min(lanes.next_power_of_two()).max(of_doubles);
        let sizes = filling.into_iter().filter(|&size| size <= most);
        let divides = |size: &u32| self.groups.iter().all(|group| group.is_multiple_of(*size));
        sizes.into_iter().find(divides).unwrap_or(most)
    }
}

#[cfg(test)]
mod tests {
    use tilewright_circuit::Bits;

    use super::*;
    use crate::engine::program::ValueId;

    /// The strip of `lanes` numbers of these widths, with a repetition along an axis.
    fn strip(lanes: u32, widths: &[u32], axis: Axis) -> u32 {
        let mut array = Array::default();
        widths.iter().for_each(|&width| array.add(&Cell { kind: Kind::Const(Bits::zero(width)), lanes, width }));
        array.add(&Cell { kind: Kind::Broadcast { of: ValueId(0), axis }, lanes, width: 1 });
        array.strip(lanes, 128)
    }

    #[test]
    fn most_values_fill_a_vector() {
        let everywhere = Axis::last(100);
        assert_eq!(strip(100, &[8], everywhere), 16);
        assert_eq!(strip(100, &[8, 8, 16], everywhere), 16);
        assert_eq!(strip(100, &[8, 16], everywhere), 8);
        assert_eq!(strip(100, &[8, 8, 32], everywhere), 4);
        assert_eq!(strip(6, &[8], Axis::last(6)), 8);
    }

    #[test]
    fn a_strip_is_in_one_group() {
        assert_eq!([16, 24, 20, 18].map(|group| strip(10 * group, &[8], Axis::last(group))), [16, 8, 4, 16]);
        assert_eq!([16, 24, 20].map(|inner| strip(10 * inner, &[8], Axis { count: 10, inner })), [16, 8, 4]);
    }

    #[test]
    fn a_strip_fills_a_vector_of_the_target() {
        let array = Array { elements: [1, 0, 0, 0], ..Array::default() };
        assert_eq!([64, 128, 256].map(|vector| array.strip(100, vector)), [8, 16, 32]);
        let array = Array { elements: [0, 0, 1, 0], ..Array::default() };
        assert_eq!([64, 128, 256].map(|vector| array.strip(2, vector)), [2, 4, 8]);
    }
}
