//! Bits that change places within words.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Affine, Binary, Shift};

use super::making::{Shifted, alternating, shifted};
use super::words::Words;
use crate::engine::program::{Axis, Kind, ValueId};

/// Bits of half a word in which both operands of [`Words::alternate`] are spread at once.
const HALF: u32 = 32;

impl Words<'_> {
    /// Words assembled from shorter ones.
    pub(super) fn joined(&mut self, kind: Kind) -> Kind {
        match kind {
            Kind::Broadcast { of, axis } => Kind::Repeat(self.of(of, axis.inner), axis.count),
            Kind::Stack { parts, inner } => {
                Kind::Concat(parts.into_iter().rev().map(|part| self.of(part, inner)).collect())
            }
            _ => unreachable!("it is not put together: {kind:?}"),
        }
    }

    /// Words with this number of lanes, in which bits of two values alternate.
    pub(super) fn alternating(&mut self, id: ValueId, kind: &Kind, lanes: u32) -> ValueId {
        let (of, count) = alternating(kind).expect("its lanes alternate");
        let half = lanes / 2;
        if count == half {
            let of = of.map(|of| self.of(of, half));
            return self.alternate(id, of);
        }
        // A word of each gives two words.
        let of = of.map(|of| self.of(of, lanes));
        let words = self.circuit[of[0]].lanes;
        let parts = [0, half].map(|low| {
            let halves = of.map(|of| self.push(id, Kind::Slice(of, low), words, half));
            self.alternate(id, halves)
        });
        self.push(id, Kind::Stack { parts: parts.to_vec(), inner: 1 }, 2 * words, lanes)
    }

    /// Words that alternate the bits of two words.
    fn alternate(&mut self, id: ValueId, [even, odd]: [ValueId; 2]) -> ValueId {
        let (words, width) = (self.circuit[even].lanes, self.circuit[even].width);
        let whole = 2 * width;
        let extended = |words_of: &mut Self, of, to| match width == to {
            true => of,
            false => words_of.push(id, Kind::Extend(of, false), words, to),
        };
        if even != odd && whole <= HALF {
            let [even, odd] = [even, odd].map(|of| extended(self, of, HALF));
            let both = self.push(id, Kind::Concat(vec![odd, even]), words, 2 * HALF);
            let both = self.spread(id, both, width);
            // The lower half's bits end before the upper half's begin.
            let parts = [0, HALF - 1].map(|low| self.push(id, Kind::Slice(both, low), words, whole));
            return self.push(id, Kind::Binary(Binary::Or, parts[0], parts[1]), words, whole);
        }
        let mut spread = |of| {
            let of = extended(self, of, whole);
            self.spread(id, of, width)
        };
        let first = spread(even);
        let second = if even == odd { first } else { spread(odd) };
        let second = self.left(id, second, 1);
        self.push(id, Kind::Binary(Binary::Or, first, second), words, whole)
    }

    /// Moves the lowest `count` bits of words to every second place. In words of 64 bits, it moves those of each half
    /// within the half, if they fit.
    ///
    /// ```text
    ///         hgfedcba
    ///     hgfe    dcba     moved by 4
    ///   hg  fe  dc  ba     by 2
    ///  h g f e d c b a     by 1
    /// ```
    fn spread(&mut self, id: ValueId, of: ValueId, count: u32) -> ValueId {
        let (words, width) = (self.circuit[of].lanes, self.circuit[of].width);
        let mut spread = of;
        let mut by = count.next_power_of_two() / 2;
        while by > 0 {
            let moved = self.left(id, spread, by);
            let both = self.push(id, Kind::Binary(Binary::Or, spread, moved), words, width);
            let kept = (0..width).filter(|bit| (bit / by).is_multiple_of(2)).fold(0, |kept, bit| kept | 1 << bit);
            let kept = self.push(id, Kind::Const(Bits::new(width, kept)), words, width);
            spread = self.push(id, Kind::Binary(Binary::And, both, kept), words, width);
            by /= 2;
        }
        spread
    }

    /// Words, shifted to the left.
    fn left(&mut self, id: ValueId, of: ValueId, by: u32) -> ValueId {
        let (words, width) = (self.circuit[of].lanes, self.circuit[of].width);
        let by = Bits::new(6, by.into());
        let by = self.push(id, Kind::Const(by), words, 6);
        self.push(id, Kind::Shift(Shift::Left, of, by), words, width)
    }

    /// Words with this number of lanes whose bits are shifted; bits of the next word, or from beyond the end, are
    /// shifted in.
    pub(super) fn shifted(&mut self, id: ValueId, kind: &Kind, lanes: u32) -> Kind {
        let Shifted { of, count, by, edge } = shifted(kind).expect("its lanes are moved");
        let of = self.of(of, lanes);
        let (words, along, distance) = (self.circuit[of].lanes, count / lanes, by.unsigned_abs());
        let edge = self.push(id, Kind::Extend(edge, true), words / along, lanes);
        let next = Kind::Map {
            of,
            axis: Axis::last(along),
            count: along,
            index: Affine::shift(by.signum()),
            edge: Some(edge),
        };
        let next = self.push(id, next, words, lanes);
        // Bits from the other end of the next word.
        let (kept, entering) = if by > 0 { (distance, 0) } else { (0, lanes - distance) };
        let kept = self.push(id, Kind::Slice(of, kept), words, lanes - distance);
        let entering = self.push(id, Kind::Slice(next, entering), words, distance);
        Kind::Concat(if by > 0 { vec![entering, kept] } else { vec![kept, entering] })
    }
}
