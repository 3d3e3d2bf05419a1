//! The program of the processors, in instructions of RV32I.

use std::collections::BTreeMap;

/// Registers, by their contents in the program.
const ZERO: u32 = 0;
const RETURN: u32 = 1;
const RANDOM: u32 = 5;
const AT: u32 = 6;
const END: u32 = 7;
const A: u32 = 8;
const B: u32 = 9;
const HASH: u32 = 10;
const BELOW: u32 = 11;

/// The address from which a processor reads its input.
const INPUT: u32 = 0x8000_0000;
/// The number of sorted words.
const WORDS: i32 = 32;

/// Instructions, and the targets of jumps.
#[derive(Default)]
struct Text {
    words: Vec<u32>,
    places: BTreeMap<&'static str, usize>,
    /// Jumps and branches, and their targets.
    jumps: Vec<(usize, &'static str)>,
}

impl Text {
    fn place(&mut self, name: &'static str) {
        self.places.insert(name, self.words.len());
    }

    /// An instruction with an immediate of 12 bits.
    fn immediate(&mut self, opcode: u32, function: u32, to: u32, from: u32, value: i32) {
        self.words.push((value as u32) << 20 | from << 15 | function << 12 | to << 7 | opcode);
    }

    fn add(&mut self, to: u32, from: u32, value: i32) {
        self.immediate(0x13, 0, to, from, value);
    }

    fn and(&mut self, to: u32, from: u32, value: i32) {
        self.immediate(0x13, 7, to, from, value);
    }

    fn shift_left(&mut self, to: u32, from: u32, places: i32) {
        self.immediate(0x13, 1, to, from, places);
    }

    fn shift_right(&mut self, to: u32, from: u32, places: i32) {
        self.immediate(0x13, 5, to, from, places);
    }

    fn shift_right_signed(&mut self, to: u32, from: u32, places: i32) {
        self.immediate(0x13, 5, to, from, places | 0x400);
    }

    /// An operation on two registers.
    fn operate(&mut self, function: u32, alternative: bool, to: u32, left: u32, right: u32) {
        let high = u32::from(alternative) << 30;
        self.words.push(high | right << 20 | left << 15 | function << 12 | to << 7 | 0x33);
    }

    fn load(&mut self, function: u32, to: u32, base: u32, offset: i32) {
        self.immediate(0x03, function, to, base, offset);
    }

    fn store(&mut self, function: u32, from: u32, base: u32, offset: u32) {
        let (high, low) = (offset >> 5, offset & 31);
        self.words.push(high << 25 | from << 20 | base << 15 | function << 12 | low << 7 | 0x23);
    }

    fn upper(&mut self, opcode: u32, to: u32, value: u32) {
        self.words.push(value & 0xffff_f000 | to << 7 | opcode);
    }

    fn branch(&mut self, function: u32, left: u32, right: u32, to: &'static str) {
        self.jumps.push((self.words.len(), to));
        self.words.push(right << 20 | left << 15 | function << 12 | 0x63);
    }

    fn jump(&mut self, link: u32, to: &'static str) {
        self.jumps.push((self.words.len(), to));
        self.words.push(link << 7 | 0x6f);
    }

    /// The instructions, with the distances of jumps filled in.
    fn finish(mut self) -> Vec<u32> {
        for (at, to) in self.jumps {
            let distance = ((self.places[to] as i32 - at as i32) * 4) as u32;
            let bits = |low: u32, count: u32| distance >> low & ((1 << count) - 1);
            let is_branch = self.words[at] & 0x7f == 0x63;
            self.words[at] |= match is_branch {
                true => bits(12, 1) << 31 | bits(5, 6) << 25 | bits(1, 4) << 8 | bits(11, 1) << 7,
                false => bits(20, 1) << 31 | bits(1, 10) << 21 | bits(11, 1) << 20 | bits(12, 8) << 12,
            };
        }
        self.words
    }
}

/// Function codes of loads, stores, branches and operations.
const BYTE: u32 = 0;
const HALF: u32 = 1;
const WORD: u32 = 2;
const BYTE_UNSIGNED: u32 = 4;
const EQUAL: u32 = 0;
const NOT_EQUAL: u32 = 1;
const LESS: u32 = 4;
const ADD: u32 = 0;
const LESS_UNSIGNED: u32 = 3;
const XOR: u32 = 4;

/// Fills an array with random words, sorts it, and mixes its bytes into a hash that it stores; repeatedly.
pub fn program() -> Vec<u32> {
    let mut text = Text::default();
    text.upper(0x37, RANDOM, INPUT);
    text.load(WORD, RANDOM, RANDOM, 0);
    text.add(HASH, ZERO, 0);

    text.place("fill");
    text.add(AT, ZERO, 0);
    text.add(END, ZERO, WORDS * 4);
    text.place("next word");
    text.jump(RETURN, "random");
    text.store(WORD, RANDOM, AT, 0);
    text.add(AT, AT, 4);
    text.branch(NOT_EQUAL, AT, END, "next word");

    // Each word moves down until the one below is not larger.
    text.add(AT, ZERO, 4);
    text.place("insert");
    text.add(BELOW, AT, 0);
    text.load(WORD, A, AT, 0);
    text.place("down");
    text.load(WORD, B, BELOW, -4);
    text.branch(LESS, B, A, "found");
    text.store(WORD, B, BELOW, 0);
    text.add(BELOW, BELOW, -4);
    text.branch(NOT_EQUAL, BELOW, ZERO, "down");
    text.place("found");
    text.store(WORD, A, BELOW, 0);
    text.add(AT, AT, 4);
    text.branch(NOT_EQUAL, AT, END, "insert");

    text.add(AT, ZERO, 0);
    text.place("mix");
    text.load(BYTE_UNSIGNED, A, AT, 0);
    text.load(BYTE, B, AT, 1);
    text.shift_left(BELOW, HASH, 5);
    text.shift_right(HASH, HASH, 27);
    text.operate(XOR, false, HASH, HASH, BELOW);
    text.operate(ADD, false, HASH, HASH, A);
    text.operate(ADD, true, HASH, HASH, B);
    text.operate(LESS_UNSIGNED, false, B, HASH, RANDOM);
    text.shift_right_signed(A, HASH, 3);
    text.operate(XOR, false, HASH, HASH, A);
    text.and(A, HASH, 0x55);
    text.branch(EQUAL, B, ZERO, "kept");
    text.store(BYTE, A, AT, 256);
    text.place("kept");
    text.store(HALF, HASH, AT, 512);
    text.add(AT, AT, 2);
    text.branch(NOT_EQUAL, AT, END, "mix");
    text.jump(ZERO, "fill");

    // The next state of a 32-bit xorshift generator.
    text.place("random");
    text.shift_left(A, RANDOM, 13);
    text.operate(XOR, false, RANDOM, RANDOM, A);
    text.shift_right(A, RANDOM, 17);
    text.operate(XOR, false, RANDOM, RANDOM, A);
    text.shift_left(A, RANDOM, 5);
    text.operate(XOR, false, RANDOM, RANDOM, A);
    text.immediate(0x67, 0, ZERO, RETURN, 0);
    text.finish()
}
