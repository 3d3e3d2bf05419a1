//! A block of changes.
//!
//! It has the values at its start (the frame), for each variable a chain of its changes, the places of the chains, and
//! the times. A change says how many times after the last one of its variable it is.

use std::collections::HashMap;
use std::ops::RangeInclusive;

use super::number::{long, shorter, signed, unsigned};

/// The type of a block of changes whose chains may be those of earlier variables.
const CHANGES: u8 = 8;
/// The chains are packed by zlib.
const ZLIB: u8 = b'Z';
/// Shorter chains are not packed: the packed one would be longer.
const SHORT_CHAIN: usize = 32;

/// The changes since the last block.
pub struct Section {
    signals: Vec<Signal>,
    /// The values at the first time, a character for each bit.
    frame: Vec<u8>,
    /// The first and the last time; `None` before the first one.
    range: Option<RangeInclusive<u64>>,
    /// The last time, by its index in `times`.
    index: u32,
    /// Each time as the distance from the one before.
    times: Vec<u8>,
    /// The bytes of all chains.
    size: usize,
}

/// A variable.
struct Signal {
    /// `None` for a string.
    width: Option<u32>,
    /// The place of its value in the frame.
    frame: usize,
    /// The index of the time of its last change in the block.
    last: u32,
    /// The last value of a variable of one bit.
    high: bool,
    chain: Vec<u8>,
}

impl Section {
    /// One of variables with these widths; `None` stands for a string.
    pub fn new(widths: &[Option<u32>]) -> Section {
        let mut end = 0;
        let signal = |&width: &Option<u32>| {
            let frame = end;
            end += width.unwrap_or(0) as usize;
            Signal { width, frame, last: 0, high: false, chain: Vec::new() }
        };
        let signals = widths.iter().map(signal).collect();
        Section { signals, frame: vec![b'x'; end], range: None, index: 0, times: Vec::new(), size: 0 }
    }

    /// The bytes that were collected.
    pub fn size(&self) -> usize {
        self.size + self.times.len()
    }

    /// Sets the time of the following changes.
    #[inline]
    pub fn at(&mut self, time: u64) {
        let last = self.range.as_ref().map(|range| *range.end());
        if last == Some(time) {
            return;
        }
        unsigned(&mut self.times, time - last.unwrap_or(0));
        match &mut self.range {
            Some(range) => {
                self.index += 1;
                *range = *range.start()..=time;
            }
            None => self.range = Some(time..=time),
        }
    }

    /// A variable of 1 bit.
    #[inline]
    pub fn bit(&mut self, number: u32, high: bool) {
        let signal = &mut self.signals[number as usize];
        signal.high = high;
        let later = signal.later(self.index);
        self.size += signal.push(later << 2 | u64::from(high) << 1, &[]);
    }

    /// A variable of up to 64 bits.
    #[inline]
    pub fn short(&mut self, number: u32, value: u64) {
        let signal = &mut self.signals[number as usize];
        match signal.width {
            Some(1) => self.bit(number, value != 0),
            Some(width) => {
                // The highest bit is the highest of the first byte.
                let bytes = (value << (u64::BITS - width)).to_be_bytes();
                let later = signal.later(self.index);
                self.size += signal.push(later << 1, &bytes[..width.div_ceil(8) as usize]);
            }
            None => unreachable!("a string is not a number"),
        }
    }

    /// A variable of several bits, from its limbs, the lowest first.
    #[inline]
    pub fn bits(&mut self, number: u32, limbs: &[u64]) {
        let &[limb] = limbs else { return self.wide(number, limbs) };
        self.short(number, limb);
    }

    fn wide(&mut self, number: u32, limbs: &[u64]) {
        let signal = &mut self.signals[number as usize];
        let width = signal.width.unwrap_or(0) as usize;
        let bit = |index: usize| u8::from(limbs[index / 64] >> (index % 64) & 1 != 0);
        // The highest bit is the highest of the first byte, and the lowest bits of the last byte may be free.
        let byte = |byte: usize| {
            (0..8).fold(0, |all, place| {
                let place = 8 * byte + place;
                all << 1 | if place < width { bit(width - 1 - place) } else { 0 }
            })
        };
        let bytes: Vec<u8> = (0..width.div_ceil(8)).map(byte).collect();
        let later = signal.later(self.index);
        self.size += signal.push(later << 1, &bytes);
    }

    /// A string.
    pub fn string(&mut self, number: u32, text: &str) {
        let signal = &mut self.signals[number as usize];
        let mut bytes = Vec::with_capacity(text.len() + 1);
        unsigned(&mut bytes, text.len() as u64);
        bytes.extend_from_slice(text.as_bytes());
        let later = signal.later(self.index);
        self.size += signal.push(later << 1, &bytes);
    }

    /// Puts the last values into the frame.
    pub fn set_frame(&mut self) {
        for signal in self.signals.iter().filter(|signal| !signal.chain.is_empty()) {
            signal.show(&mut self.frame);
        }
    }

    /// The block, with the first and the last time in it; `None` if it has no time. The next one is then empty.
    pub fn take(&mut self) -> Option<(RangeInclusive<u64>, Vec<u8>)> {
        let range = self.range.take()?;
        let block = self.block(&range);
        self.set_frame();
        for signal in &mut self.signals {
            signal.chain.clear();
            signal.last = 0;
        }
        self.times.clear();
        (self.index, self.size) = (0, 0);
        Some((range, block))
    }

    fn block(&self, range: &RangeInclusive<u64>) -> Vec<u8> {
        let mut body = Vec::new();
        long(&mut body, *range.start());
        long(&mut body, *range.end());
        // The memory that a reader needs.
        long(&mut body, self.size as u64);
        let frame = shorter(&self.frame);
        for number in [self.frame.len(), frame.len(), self.signals.len()] {
            unsigned(&mut body, number as u64);
        }
        body.extend_from_slice(&frame);
        unsigned(&mut body, self.signals.len() as u64);
        let places = self.chains(&mut body);
        body.extend_from_slice(&places);
        long(&mut body, places.len() as u64);
        let times = shorter(&self.times);
        body.extend_from_slice(&times);
        for number in [self.times.len() as u64, times.len() as u64, u64::from(self.index) + 1] {
            long(&mut body, number);
        }
        let mut block = Vec::with_capacity(body.len() + 9);
        block.push(CHANGES);
        long(&mut block, body.len() as u64 + 8);
        block.append(&mut body);
        block
    }

    /// Writes the chains; returns their places. A chain that an earlier variable has, too, is written once.
    fn chains(&self, body: &mut Vec<u8>) -> Vec<u8> {
        let (mut places, mut empty) = (Vec::new(), 0);
        let mut known = HashMap::new();
        let (mut last_place, mut last_same) = (body.len(), 0);
        body.push(ZLIB);
        for (number, signal) in (1_i64..).zip(&self.signals) {
            if signal.chain.is_empty() {
                empty += 1;
                continue;
            }
            flush_empty(&mut places, &mut empty);
            let same = *known.entry((signal.width == Some(1), &signal.chain)).or_insert(number);
            if same < number {
                // The same one as for the last such variable is a zero.
                signed(&mut places, if same == last_same { 1 } else { -same << 1 | 1 });
                last_same = same;
                continue;
            }
            let place = body.len();
            signed(&mut places, ((place - last_place) as i64) << 1 | 1);
            last_place = place;
            let packed = if signal.chain.len() < SHORT_CHAIN { signal.chain.clone() } else { shorter(&signal.chain) };
            unsigned(body, if packed.len() < signal.chain.len() { signal.chain.len() as u64 } else { 0 });
            body.extend_from_slice(&packed);
        }
        flush_empty(&mut places, &mut empty);
        places
    }
}

/// Writes how many variables have not changed.
fn flush_empty(places: &mut Vec<u8>, empty: &mut u64) {
    if *empty > 0 {
        unsigned(places, *empty << 1);
    }
    *empty = 0;
}

impl Signal {
    /// By how many times a change at the time with this index is later than the last one.
    #[inline]
    fn later(&mut self, index: u32) -> u64 {
        u64::from(index - std::mem::replace(&mut self.last, index))
    }

    /// Appends a change; returns its length.
    #[inline]
    fn push(&mut self, number: u64, value: &[u8]) -> usize {
        let start = self.chain.len();
        unsigned(&mut self.chain, number);
        self.chain.extend_from_slice(value);
        self.chain.len() - start
    }

    /// Puts its last value into the frame.
    fn show(&self, frame: &mut [u8]) {
        let Some(width) = self.width.map(|width| width as usize) else { return };
        let character = |high: bool| b'0' + u8::from(high);
        let place = &mut frame[self.frame..self.frame + width];
        if let [only] = place {
            *only = character(self.high);
            return;
        }
        let bytes = &self.chain[self.chain.len() - width.div_ceil(8)..];
        for (index, place) in place.iter_mut().enumerate() {
            *place = character(bytes[index / 8] << (index % 8) & 0x80 != 0);
        }
    }
}
