//! Slices and concatenations.

use super::form::{Form, Need, Vector};
use super::vectors::{self, low_mask};
use super::{ELEMENTS, Lanes};
use crate::engine::program::ValueId;
use crate::engine::strips::{Builder, Type};

/// A value within a concatenation.
#[derive(Debug, Clone, Copy)]
struct Piece {
    id: ValueId,
    low: u32,
    width: u32,
}

impl Lanes {
    pub(super) fn slice(&mut self, b: &mut Builder, of: ValueId, low: u32, width: u32) -> Vector {
        if width == 1 {
            return self.bit(b, of, low);
        }
        let entry = &self.values[&of];
        if let Some(constant) = entry.constant {
            let element = self.element(width);
            return self.known_vector(b, width, constant >> low & low_mask(width), element, Need::Clean);
        }
        let from = entry.forms.iter().min_by_key(|form| form.element).expect("a value has a form").clone();
        if from.element == 64 && width <= 32 && low >= 32 {
            let form = Form::Bits(from.form.bits(64).saturating_sub(32));
            let parts = from.parts.chunks(2).map(|pair| vectors::halves(b, pair[0], pair[1], true)).collect();
            let upper = Vector { width, element: 32, form, parts, inverse: None };
            return self.shifted_right(b, &upper, low - 32);
        }
        let signed = from.form.signed_bits(from.element);
        if matches!(from.element, 16 | 32) && !matches!(from.form, Form::Bits(_)) && signed > low {
            let by = b.constant(Type::I64, i64::from(low));
            let parts = vectors::map(&from.parts, |part| b.sar(part, by));
            let form = Form::signed(signed - low, from.element);
            return Vector { width, form, parts, inverse: None, ..from };
        }
        self.shifted_right(b, &Vector { width, ..from }, low)
    }

    /// Zeros are shifted in, except in bytes.
    pub(super) fn shifted_right(&mut self, b: &mut Builder, from: &Vector, by: u32) -> Vector {
        let Vector { width, element, .. } = *from;
        if by == 0 {
            return Vector { inverse: None, ..from.clone() };
        }
        let parts = vectors::map(&from.parts, |part| vectors::shift_dirty(b, part, element, false, by));
        let form = match element {
            8 => Form::Bits(8),
            _ => Form::Bits(from.form.bits(element).saturating_sub(by)),
        };
        Vector { width, element, form, parts, inverse: None }
    }

    pub(super) fn shifted_left(&mut self, b: &mut Builder, from: &Vector, by: u32) -> Vector {
        let Vector { width, element, form, .. } = *from;
        if by == 0 {
            return Vector { inverse: None, ..from.clone() };
        }
        // Nothing may cross into the neighbour.
        let crossing = element == 8 && form.bits(8) + by > 8;
        let kept = if crossing { Some(self.bits(b, 8, 0xff >> by)) } else { None };
        let parts = vectors::map(&from.parts, |part| {
            let part = kept.map_or(part, |kept| b.and(part, kept));
            vectors::shift_dirty(b, part, element, true, by)
        });
        Vector { width, element, form: form.up(by, element), parts, inverse: None }
    }

    pub(super) fn concat(&mut self, b: &mut Builder, parts: &[ValueId], width: u32) -> Vector {
        let mut low = 0;
        let mut pieces = Vec::new();
        for &id in parts.iter().rev() {
            let width = self.width(id);
            pieces.push(Piece { id, low, width });
            low += width;
        }
        self.pieces(b, &pieces, width)
    }

    /// Pieces from the lowest up.
    fn pieces(&mut self, b: &mut Builder, pieces: &[Piece], width: u32) -> Vector {
        if width == 1 {
            let element = self.pick(8, &[(pieces[0].id, Need::Signed)], 0);
            return self.number(b, pieces[0].id, element, Need::Signed);
        }
        let least = self.element(width);
        let candidates = ELEMENTS.into_iter().filter(|&element| element >= least);
        let costs = candidates.map(|element| (self.pieces_cost(pieces, element), element));
        let (cost, element) = costs.min().expect("64 bits are enough");
        let half = least / 2;
        let split = pieces.iter().position(|piece| piece.low == half).filter(|_| half >= self.element(1));
        if let Some(at) = split {
            let low = &pieces[..at];
            let high: Vec<Piece> = pieces[at..].iter().map(|piece| Piece { low: piece.low - half, ..*piece }).collect();
            let halves = self.pieces_cost(low, half) + self.pieces_cost(&high, half) + self.parts(least) as u32;
            if halves < cost {
                let low = self.pieces_at(b, low, half, half);
                let high = self.pieces_at(b, &high, width - half, half);
                let mut parts = Vec::new();
                for (&low, &high) in low.parts.iter().zip(&high.parts) {
                    for upper in [false, true] {
                        let both = vectors::interleave(b, low, high, half, upper);
                        parts.push(b.cast(b.vector(least), both));
                    }
                }
                let form = match high.form {
                    Form::Bits(bits) => Form::Bits(bits + half),
                    _ => Form::signed(high.form.signed_bits(half) + half, least),
                };
                return Vector { width, element: least, form, parts, inverse: None };
            }
        }
        self.pieces_at(b, pieces, width, element)
    }

    /// The form in which a piece is needed: single bits as masks, but a constant's bit is in its final position.
    fn piece_need(&self, pieces: &[Piece], at: usize, element: u32) -> Need {
        match pieces[at] {
            Piece { id, width: 1, .. } if self.cost(id, element, Need::Clean) > 0 => Need::Signed,
            _ if at + 1 == pieces.len() => Need::Any,
            _ => Need::Clean,
        }
    }

    fn pieces_cost(&self, pieces: &[Piece], element: u32) -> u32 {
        let mut cost = 0;
        for (i, piece) in pieces.iter().enumerate() {
            if self.known(piece.id).is_some() {
                continue;
            }
            let need = self.piece_need(pieces, i, element);
            cost += self.cost(piece.id, element, need);
            let shift = u32::from(need == Need::Signed || piece.low > 0);
            cost += (shift + u32::from(i > 0)) * self.parts(element) as u32;
        }
        cost
    }

    fn pieces_at(&mut self, b: &mut Builder, pieces: &[Piece], width: u32, element: u32) -> Vector {
        let mut constant = 0;
        let mut sum: Option<Vector> = None;
        for (i, piece) in pieces.iter().enumerate() {
            if let Some(known) = self.known(piece.id) {
                constant |= known << piece.low;
                continue;
            }
            let need = self.piece_need(pieces, i, element);
            let vector = self.number(b, piece.id, element, need);
            let moved = match need {
                Need::Signed => {
                    let bit = self.bits(b, element, 1 << piece.low);
                    let parts = vectors::map(&vector.parts, |part| b.and(part, bit));
                    Vector { width, element, form: Form::Bits(piece.low + 1), parts, inverse: None }
                }
                _ => Vector { width, ..self.shifted_left(b, &vector, piece.low) },
            };
            sum = Some(match sum {
                None => moved,
                Some(sum) => self.either(b, &sum, &moved),
            });
        }
        if constant == 0
            && let Some(sum) = sum
        {
            return sum;
        }
        let known = self.known_vector(b, width, constant, element, Need::Clean);
        sum.map_or(known.clone(), |sum| self.either(b, &sum, &known))
    }

    fn either(&mut self, b: &mut Builder, x: &Vector, y: &Vector) -> Vector {
        let parts = vectors::map2(&x.parts, &y.parts, |x, y| b.or(x, y));
        Vector { form: x.form.or(y.form, x.element), parts, inverse: None, ..*x }
    }

    pub(super) fn repeat(&mut self, b: &mut Builder, of: ValueId, times: u32, width: u32) -> Vector {
        let single = self.width(of);
        if single == 1 {
            let element = self.pick(self.element(width), &[(of, Need::Signed)], 0);
            let mask = self.number(b, of, element, Need::Signed);
            return Vector { width, inverse: None, ..mask };
        }
        let least = self.element(width);
        if times > 2 && matches!(least, 16 | 32) {
            let number = self.number(b, of, least, Need::Clean);
            let factor = (0..times).fold(0, |factor, i| factor | 1 << (i * single));
            let factor = self.bits(b, least, factor);
            let parts = vectors::map(&number.parts, |part| b.mul(part, factor));
            let form = Form::Bits(width.min(number.form.bits(least) + width - single));
            return Vector { width, element: least, form, parts, inverse: None };
        }
        let pieces: Vec<Piece> = (0..times).map(|i| Piece { id: of, low: i * single, width: single }).collect();
        self.pieces(b, &pieces, width)
    }
}
