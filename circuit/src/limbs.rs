//! Arithmetic on numbers of any width, as 64-bit limbs, the lowest first. Results fill all of `out`; the caller
//! clears the bits above the width.

use std::cmp::Ordering;

use crate::Bits;

/// A number of so many bits, in limbs; the bits above are zero.
#[derive(Clone, Copy)]
pub struct Number<'a> {
    pub limbs: &'a [u64],
    pub width: u32,
}

impl<'a> From<&'a Bits> for Number<'a> {
    fn from(bits: &'a Bits) -> Number<'a> {
        Number { limbs: bits.limbs(), width: bits.width() }
    }
}

impl Number<'_> {
    /// Its lowest bit.
    pub fn is_one(&self) -> bool {
        self.limbs[0] & 1 == 1
    }

    /// Its highest bit.
    pub fn sign(&self) -> bool {
        bit(self.limbs, self.width - 1)
    }

    /// The value, or `limit` if it is that or more.
    pub fn at_most(&self, limit: u32) -> u32 {
        match self.limbs[1..].iter().all(|&limb| limb == 0) {
            true => self.limbs[0].min(u64::from(limit)) as u32,
            false => limit,
        }
    }

    /// With zeros or, if signed, copies of its highest bit up to a width.
    pub fn extend(self, out: &mut [u64], signed: bool, width: u32) {
        copy(out, 0, self.limbs, 0, self.width);
        if signed && self.sign() {
            set(out, self.width, width);
        }
    }
}

/// `a + b`, or `a - b`.
#[inline]
pub fn add(out: &mut [u64], a: &[u64], b: &[u64], subtract: bool) {
    let flip = if subtract { u64::MAX } else { 0 };
    let mut carry = subtract;
    for (out, (a, b)) in out.iter_mut().zip(a.iter().zip(b)) {
        let (sum, first) = a.overflowing_add(b ^ flip);
        let (sum, second) = sum.overflowing_add(u64::from(carry));
        (*out, carry) = (sum, first | second);
    }
}

/// `a * b` modulo the size of `out`, both unsigned.
#[inline]
pub fn multiply(out: &mut [u64], a: &[u64], b: &[u64]) {
    out.fill(0);
    for (i, &a) in a.iter().enumerate() {
        let mut carry = 0;
        for (j, &b) in b.iter().enumerate().take(out.len().saturating_sub(i)) {
            let sum = u128::from(a) * u128::from(b) + u128::from(out[i + j]) + u128::from(carry);
            (out[i + j], carry) = (sum as u64, (sum >> 64) as u64);
        }
        if let Some(next) = out.get_mut(i + b.len()) {
            *next = carry;
        }
    }
}

/// `a` compared with `b`, with equal numbers of limbs, unsigned.
#[inline]
pub fn compare(a: &[u64], b: &[u64]) -> Ordering {
    a.iter().rev().cmp(b.iter().rev())
}

/// Bit `index`.
#[inline]
pub fn bit(a: &[u64], index: u32) -> bool {
    a[index as usize / 64] >> (index % 64) & 1 == 1
}

/// Copies bits `from .. from + count` of `a` to bits `to ..` of `out`, which must be zero there.
#[inline]
pub fn copy(out: &mut [u64], to: u32, a: &[u64], from: u32, count: u32) {
    let mut done = 0;
    while done < count {
        let (source, target) = (from + done, to + done);
        let step = (count - done).min(64 - source % 64).min(64 - target % 64);
        let bits = a[source as usize / 64] >> (source % 64) & (u64::MAX >> (64 - step));
        out[target as usize / 64] |= bits << (target % 64);
        done += step;
    }
}

/// Sets bits `from .. to`.
#[inline]
pub fn set(out: &mut [u64], from: u32, to: u32) {
    let mut at = from;
    while at < to {
        let step = (to - at).min(64 - at % 64);
        out[at as usize / 64] |= (u64::MAX >> (64 - step)) << (at % 64);
        at += step;
    }
}
