//! Plain models of a renderer's other units, as far as they are about one pixel.

use std::collections::VecDeque;
use std::sync::LazyLock;

use tilewright_hdl::Codes;
use tilewright_rtl::pixel_planes::pixel::{Control, Enabling, Mask, PixelProcessor, Source};
use tilewright_rtl::pixel_planes::{PERIOD, fields};

use crate::looks::fields;
use crate::told::Checks;

/// The period of the clock in picoseconds.
pub(super) const TICK: u64 = PERIOD.picoseconds();

/// An expression at a pixel, from the bits of its coefficients.
pub(super) struct Expressions {
    at: [i128; 2],
    /// The coefficients' bits so far: of x, y, 1, x², x y and y²; and their number.
    sums: [i128; 6],
    bits: u32,
    has_begun: bool,
    /// What the tree has to give in the next clocks; nothing before the first expression.
    to_come: VecDeque<Option<bool>>,
    /// The last bits, the hardware's and the model's.
    pub last: VecDeque<[bool; 2]>,
}

impl Expressions {
    pub fn new(at: [u32; 2], lag: u32) -> Expressions {
        let to_come = (0..lag).map(|_| None).collect();
        let at = at.map(i128::from);
        Expressions { at, sums: [0; 6], bits: 0, has_begun: false, to_come, last: VecDeque::new() }
    }

    /// Compares the tree's bit in a clock, if it was looked at, with that of the coefficients before. Beyond `longest` bits, nothing is compared.
    pub fn look(&mut self, first: u64, coefficients: [u64; 6], seen: Option<u64>, longest: u64, checks: &mut Checks) {
        if first == 1 {
            (self.sums, self.bits, self.has_begun) = ([0; 6], 0, true);
        }
        let is_used = self.has_begun && u64::from(self.bits) < longest;
        self.to_come.push_back(is_used.then(|| {
            let [x, y] = self.at;
            for (sum, bit) in self.sums.iter_mut().zip(coefficients) {
                *sum |= i128::from(bit) << self.bits;
            }
            let by = [x, y, 1, x * x, x * y, y * y];
            let value = self.sums.iter().zip(by).fold(0_i128, |all, (sum, by)| all.wrapping_add(sum.wrapping_mul(by)));
            value >> self.bits & 1 == 1
        }));
        self.bits = (self.bits + 1).min(120);
        let expected = self.to_come.pop_front().flatten();
        if let (Some(expected), Some(seen)) = (expected, seen) {
            checks.bit("value", seen, expected);
        }
        let expected = expected.unwrap_or(seen == Some(1));
        self.last.push_back([seen.map_or(expected, |seen| seen == 1), expected]);
        if self.last.len() > 64 {
            self.last.pop_front();
        }
    }

    /// The last bits as a number: the hardware's and the model's.
    pub fn word(&self, length: u64) -> [u64; 2] {
        let bits = self.last.iter().rev().take(length as usize).rev().zip(0..);
        bits.fold([0; 2], |words, (pair, place)| [0, 1].map(|of| words[of] | u64::from(pair[of]) << place))
    }
}

/// The nets of a pixel: its control, the tree's bit, and its flags.
pub(super) static CONTROL: LazyLock<Vec<String>> = LazyLock::new(|| {
    let mut nets = fields::<Control>("control", &Control::ZERO);
    nets.extend(["expression", "carry", "enable", "flag"].map(str::to_owned));
    nets
});

/// A pixel processor.
pub(super) struct Pixel {
    pub memory: Vec<bool>,
    pub carry: bool,
    pub enable: bool,
    pub flag: bool,
    /// The address that was written, or could have been.
    pub written: usize,
}

impl Pixel {
    /// The pixel as the hardware has it at the beginning.
    pub fn new(memory: Vec<bool>, [carry, enable, flag]: [bool; 3]) -> Pixel {
        Pixel { memory, carry, enable, flag, written: 0 }
    }

    /// The word of `length` bits at an address.
    pub fn word(&self, address: u64, length: u64) -> u64 {
        (0..length).map(|bit| u64::from(self.memory[(address + bit) as usize]) << bit).sum()
    }

    /// The bit that it reads.
    pub fn read(&self, control: &[u64; 11]) -> bool {
        self.memory[(control[9] as usize).min(PixelProcessor::BITS as usize - 1)]
    }

    /// Compares flags and the bit that was written, and does what the control says.
    pub fn look(
        &mut self,
        control: &[u64; 11],
        expression: u64,
        (written, flags): (bool, Option<[u64; 3]>),
        checks: &mut Checks,
    ) {
        let [source, constant, adds, first, mask, compares, gates, enabling, captures, read, write] = *control;
        if let Some([carry, enable, flag]) = flags {
            checks.bit("carry", carry, self.carry);
            checks.bit("enable", enable, self.enable);
            checks.bit("flag", flag, self.flag);
        }
        checks.same("memory", u64::from(written), u64::from(self.memory[self.written]));
        let most = PixelProcessor::BITS as usize - 1;
        let kept = self.memory[(read as usize).min(most)];

        let [expression, constant] = [expression, constant].map(|bit| bit == 1);
        let operand = match Source::ALL.get(source as usize) {
            Some(Source::Expression) => expression,
            Some(Source::Memory) => kept,
            _ => constant,
        };
        let carried = self.carry && first == 0;
        let sum = [operand, kept, carried].map(u8::from).iter().sum::<u8>();
        let result = if adds == 1 { sum & 1 == 1 } else { operand };
        let writes = match Mask::ALL[mask as usize] {
            Mask::Nobody => false,
            Mask::Everybody => true,
            Mask::Enabled => self.enable,
            Mask::Flagged => self.flag,
        };
        let before = self.enable;
        self.enable = match Enabling::ALL.get(enabling as usize) {
            Some(Enabling::Set) => true,
            Some(Enabling::Clear) => false,
            Some(Enabling::Replace) => !expression,
            Some(Enabling::Restrict) => before && !expression,
            _ => before,
        };
        if compares == 1 {
            let is_less = if operand == kept { self.flag && first == 0 } else { kept };
            self.flag = is_less && (before || gates == 0);
        } else if captures == 1 {
            self.flag = self.enable;
        }
        if adds == 1 {
            self.carry = sum > 1;
        }
        self.written = (write as usize).min(most);
        if writes {
            self.memory[self.written] = result;
        }
    }
}

/// What is looked at of a backing store.
pub(super) struct Stored {
    pub claim: u64,
    pub region: u64,
    pub plane: u64,
    pub number: u64,
    pub word: u64,
    pub ready: u64,
    pub free: u64,
    /// Of the plane at its output: whether there is one, the region, the line, the number, and the pixel's bit.
    pub out: [u64; 5],
}

/// A backing store.
pub(super) struct Store {
    line: u64,
    side: u64,
    free: bool,
    region: u64,
    bits: [Option<bool>; fields::WORD.bits as usize],
    /// The clock in which the region was complete.
    complete: Option<u64>,
    /// Planes that have left.
    sent: u64,
}

impl Store {
    pub fn new(line: u32, side: u32) -> Store {
        let (line, side) = (line.into(), side.into());
        Store { line, side, free: true, region: 0, bits: [None; 48], complete: None, sent: 0 }
    }

    /// Compares its outputs in a clock. Returns whether the last plane of the pixel leaves.
    pub fn look(&mut self, clock: u64, it: &Stored, checks: &mut Checks) -> bool {
        let all = self.side * u64::from(fields::WORD.bits);
        let is_shown = self.complete.is_some_and(|complete| clock >= complete + 2) && self.sent < all;
        let (line, plane) = (self.sent / 48, self.sent % 48);
        checks.bit("free", it.free, self.free);
        let [valid, region, seen_line, seen_plane, bit] = it.out;
        checks.bit("planes_valid", valid, is_shown);
        if is_shown {
            checks.same("planes_region", region, self.region);
            checks.same("planes_line", seen_line, line);
            checks.same("planes_plane", seen_plane, plane);
            if let Some(kept) = self.bits[plane as usize].filter(|_| line == self.line) {
                checks.bit("planes_bits", bit, kept);
            }
        }
        let leaves = is_shown && it.ready == 1;
        if leaves {
            self.sent += 1;
            if self.sent == all {
                (self.free, self.complete) = (true, None);
            }
        }
        if it.claim == 1 {
            (self.free, self.region) = (false, it.region);
        }
        if it.plane == 1 {
            if let Some(kept) = self.bits.get_mut(it.number as usize) {
                *kept = Some(it.word == 1);
            }
            if it.number == 47 {
                (self.complete, self.sent) = (Some(clock), 0);
            }
        }
        leaves && line == self.line && plane == 47
    }

    /// The word that it has of the pixel.
    pub fn word(&self) -> u64 {
        self.bits.iter().zip(0..).map(|(bit, place)| u64::from(*bit == Some(true)) << place).sum()
    }
}
