//! Random strip programs, evaluated and as code.

use proptest::prelude::*;

use super::super::jit::Jit;
use crate::engine::strips::{
    Base, Builder, Bytes, COMPARISONS, Comparison, Load, Loop, Memory, Notes, Only, Program, Type, Value,
};

const INTEGERS: [u32; 4] = [8, 16, 32, 64];
const VECTORS: [Type; 4] = [Type::I8X16, Type::I16X8, Type::I32X4, Type::I64X2];

/// Bytes of the state: the first half is read, the second one written.
const STATE: usize = 512;

/// A step of a random program: what it is, which operands it takes, and a number.
type Step = (u8, u8, u8, u64);

/// A program in progress, with the values that it may use.
struct Random<'b> {
    b: &'b mut Builder,
    numbers: Vec<Value>,
    vectors: Vec<Value>,
    /// The next place to store at.
    free: i32,
}

impl Random<'_> {
    fn number(&self, index: u8) -> Value {
        self.numbers[usize::from(index) % self.numbers.len()]
    }

    /// A vector, as one of that type.
    fn vector(&mut self, index: u8, ty: Type) -> Value {
        let vector = self.vectors[usize::from(index) % self.vectors.len()];
        self.b.cast(ty, vector)
    }

    /// Adds an integer of any size to the numbers.
    fn add_number(&mut self, value: Value) {
        let wide = self.b.type_of(value) == Type::I64;
        let value = if wide { value } else { self.b.zero_extend(Type::I64, value) };
        self.numbers.push(value);
    }

    /// Stores a value in the second half of the state.
    fn store(&mut self, value: Value) {
        let [state, ..] = Program::PARAMETERS;
        self.b.store(value, state, STATE as i32 / 2 + self.free);
        self.free = (self.free + 16) % (STATE as i32 / 2);
    }

    fn step(&mut self, (kind, x, y, number): Step) {
        match kind % 6 {
            0 => self.of_numbers(x, y, number),
            1 | 2 => self.of_vectors(x, y, number),
            3 => self.between(x, y, number),
            4 => self.load(x, number),
            _ => {
                let value = if number.is_multiple_of(2) { self.number(x) } else { self.vector(x, Type::I8X16) };
                self.store(value);
            }
        }
    }

    fn of_numbers(&mut self, x: u8, y: u8, n: u64) {
        let (x, y) = (self.number(x), self.number(y));
        let b = &mut *self.b;
        let constant = constant(n >> 8);
        let value = match n % 20 {
            0 => b.add(x, y),
            1 => b.sub(x, y),
            2 => b.mul(x, y),
            3 => b.and(x, y),
            4 => b.or(x, y),
            5 => b.xor(x, y),
            6 => b.shl(x, y),
            7 => b.shr(x, y),
            8 => b.sar(x, y),
            9 => b.min(x, y),
            10 => b.rotate_left(x, constant & 63),
            11 => b.neg(x),
            12 => b.not(x),
            13 => b.count_ones(x),
            14 => {
                let by = b.constant(Type::I64, constant | 1);
                b.div(x, by)
            }
            15 => b.add_constant(x, constant),
            16 => {
                let narrow = Type::integer(INTEGERS[(n >> 8) as usize % 3]);
                let low = b.truncate(narrow, x);
                if n >> 16 & 1 == 0 { b.zero_extend(Type::I64, low) } else { b.sign_extend(Type::I64, low) }
            }
            17 => {
                let flag = b.compare(COMPARISONS[(n >> 8) as usize % 10].0, x, y);
                b.select(flag, y, x)
            }
            18 => b.constant(Type::I64, constant),
            _ => b.compare(COMPARISONS[(n >> 8) as usize % 10].0, x, y),
        };
        self.add_number(value);
    }

    /// Operations that the emitter uses on vectors; not all sizes have all of them.
    fn of_vectors(&mut self, x: u8, y: u8, n: u64) {
        let ty = VECTORS[(n >> 8) as usize % 4];
        let (p, q) = (self.vector(x, ty), self.vector(y, ty));
        let element = ty.element();
        let b = &mut *self.b;
        let by = |b: &mut Builder| b.constant(Type::I64, (n >> 16 & 0xff) as i64);
        let value = match n % 15 {
            0 => b.add(p, q),
            1 => b.sub(p, q),
            2 if matches!(element, 16 | 32) => b.mul(p, q),
            3 => b.and(p, q),
            4 => b.or(p, q),
            5 => b.xor(p, q),
            6 => b.not(p),
            7 if element < 64 => b.min(p, q),
            8 if element > 8 => {
                let by = by(b);
                b.shl(p, by)
            }
            9 if element > 8 => {
                let by = by(b);
                b.shr(p, by)
            }
            10 if matches!(element, 16 | 32) => {
                let by = by(b);
                b.sar(p, by)
            }
            11 => b.compare(COMPARISONS[(n >> 16) as usize % 10].0, p, q),
            12 => {
                let mask = b.compare(COMPARISONS[(n >> 16) as usize % 10].0, p, q);
                b.blend(mask, p, q)
            }
            13 if element < 64 => match n >> 16 & 3 {
                0 => b.widen_low(false, p),
                1 => b.widen_high(false, p),
                2 => b.widen_low(true, p),
                _ => b.widen_high(true, p),
            },
            _ if matches!(element, 16 | 32) => b.narrow(n >> 16 & 1 == 0, p, q),
            _ => {
                let [p, q] = [p, q].map(|value| b.cast(Type::I8X16, value));
                let bytes = n.to_le_bytes();
                match n >> 16 & 3 {
                    0 => b.swizzle(p, q),
                    1 => {
                        let low = b.numbers(Type::I8X16, |_| 15);
                        let numbers = b.and(q, low);
                        b.look_up(p, numbers)
                    }
                    _ => b.shuffle(p, q, |i| usize::from(bytes[i % 8].rotate_left(i as u32) % 32)),
                }
            }
        };
        self.vectors.push(value);
    }

    /// From numbers to vectors, and back.
    fn between(&mut self, x: u8, y: u8, n: u64) {
        let ty = VECTORS[(n >> 8) as usize % 4];
        let (vector, number) = (self.vector(x, ty), self.number(y));
        let b = &mut *self.b;
        let lane = (n >> 16) as u8 % ty.lanes() as u8;
        let narrow = if ty.element() < 64 { b.truncate(ty.of_lane(), number) } else { number };
        match n % 7 {
            0 => self.vectors.push(b.splat(ty, narrow)),
            1 if ty.element() >= 32 => self.vectors.push(b.lowest(ty, narrow)),
            1 | 2 => self.vectors.push(b.with_lane(vector, narrow, lane)),
            3 => {
                let value = b.lane(vector, lane);
                self.add_number(value);
            }
            4 => {
                let bytes = b.cast(Type::I8X16, vector);
                let value = b.high_bits(Type::I32, bytes);
                self.add_number(value);
            }
            5 => {
                let value = b.any_bit(vector);
                self.add_number(value);
            }
            // Numbers of 24 bits divided by powers of two, as shifts to the right are.
            _ => {
                let vector = b.cast(Type::I32X4, vector);
                let low = b.numbers(Type::I32X4, |_| 0xff_ffff);
                let numbers = b.and(vector, low);
                let floats = b.floats(Type::I32X4.floats(), numbers);
                let power = b.numbers(Type::I32X4.floats(), |_| (127 - (n >> 8 & 31)) << 23);
                let floats = b.mul_float(floats, power);
                self.vectors.push(b.integers(Type::I32X4, floats));
            }
        }
    }

    fn load(&mut self, x: u8, n: u64) {
        let [state, ..] = Program::PARAMETERS;
        let b = &mut *self.b;
        let offset = i32::from(x) % (STATE as i32 - 16);
        match n % 5 {
            4 => self.load_indexed(x, n >> 3),
            0 => {
                let ty = Type::integer(INTEGERS[(n >> 8) as usize % 4]);
                let value = b.load(ty, state, offset / 8 * 8);
                self.add_number(value);
            }
            1 => {
                let load = if n >> 8 & 1 == 0 { Load::ZeroExtended } else { Load::SignExtended };
                let ty = if n >> 9 & 1 == 0 { Type::I16X8 } else { Type::I32X4 };
                self.vectors.push(b.load_as(load, ty, false, state, offset));
            }
            2 => self.vectors.push(b.load(VECTORS[(n >> 8) as usize % 4], state, offset / 16 * 16)),
            _ => self.vectors.push(b.load_as(Load::Whole, VECTORS[(n >> 8) as usize % 4], false, state, offset)),
        }
    }

    /// Loads a byte at a number that is made small enough, mostly.
    fn load_indexed(&mut self, x: u8, n: u64) {
        let (number, [state, ..]) = (self.number(x), Program::PARAMETERS);
        let b = &mut *self.b;
        let shift = n >> 16 & 7;
        let most = 511 - (n >> 8 & 0xff) as i64 + i64::from(n >> 24 & 31 == 0);
        let index = match n % 5 {
            0 => b.and_constant(number, most >> shift),
            1 => {
                let most = b.constant(Type::I64, most >> shift);
                b.min(number, most)
            }
            2 => b.shr_constant(number, 55 + shift as i64),
            3 => {
                let quotient = b.shr_constant(number, 5);
                let start = b.mul_constant(quotient, 32 - i64::from(n >> 24 & 31 == 0));
                let rest = b.sub(number, start);
                b.min(rest, quotient)
            }
            _ => {
                let byte = b.truncate(Type::I8, number);
                b.zero_extend(Type::I64, byte)
            }
        };
        let (scale, offset) = match n % 5 {
            0 | 1 => (shift as i64, 511 - most as i32),
            2 => (shift as i64, 0),
            _ => (0, 255),
        };
        let at = b.shl_constant(index, scale);
        let address = b.add(state, at);
        let value = b.load(Type::I8, address, offset.max(0));
        self.add_number(value);
    }

    /// Steps in a region of their own.
    fn region(&mut self, steps: &[Step]) {
        let (numbers, vectors) = (self.numbers.len(), self.vectors.len());
        steps.iter().for_each(|step| self.step(*step));
        self.numbers.truncate(numbers);
        self.vectors.truncate(vectors);
    }

    /// Steps where a number is odd, and others elsewhere.
    fn branch(&mut self, steps: &[Step], flag: u8) {
        let flag = self.number(flag);
        let flag = self.b.and_constant(flag, 1);
        let (then, otherwise) = steps.split_at(steps.len() / 2);
        let [then, otherwise] = [then, otherwise].map(|steps| {
            self.b.open();
            self.region(steps);
            self.b.close()
        });
        self.b.branch(flag, then, otherwise);
    }

    /// Steps by the two lowest bits of a number.
    fn switch(&mut self, steps: &[Step], subject: u8) {
        let subject = self.number(subject);
        let subject = self.b.and_constant(subject, 3);
        let regions = steps.chunks(steps.len().div_ceil(3).max(1)).map(|steps| {
            self.b.open();
            self.region(steps);
            self.b.close()
        });
        let regions: Vec<_> = regions.collect();
        if !regions.is_empty() {
            let table = (0..4).map(|number| number % regions.len()).collect();
            self.b.switch(subject, table, regions);
        }
    }

    /// Steps repeated up to four times, with a number and a vector carried; it is left early if a number is even.
    fn repeat(&mut self, steps: &[Step], start: u8) {
        let (number, vector) = (self.number(start), self.vector(start, Type::I64X2));
        let zero = self.b.constant(Type::I64, 0);
        let parameters = [Type::I64, Type::I64, Type::I64X2].map(|ty| self.b.parameter(ty));
        let results = [Type::I64, Type::I64X2].map(|ty| self.b.parameter(ty));
        let [at, carried_number, carried_vector] = parameters;
        self.b.open();
        self.numbers.extend([at, carried_number]);
        self.vectors.push(carried_vector);
        steps.iter().for_each(|step| self.step(*step));
        let (number_now, vector_now) = (self.number(u8::MAX), self.vector(u8::MAX, Type::I64X2));
        let odd = self.b.and_constant(number_now, 1);
        self.b.leave_unless(odd, &[number_now, vector_now]);
        let next = self.b.add_constant(at, 1);
        let limit = self.b.constant(Type::I64, 4);
        let more = self.b.compare(Comparison::UnsignedLessThan, next, limit);
        let body = self.b.close();
        let (end, again) = (vec![number_now, vector_now], Some((more, vec![next, number_now, vector_now])));
        let (parameters, start, results) = (parameters.to_vec(), vec![zero, number, vector], results.to_vec());
        self.b.repeat(Loop { parameters, start, body, again, end, results: results.clone() });
        self.numbers.push(results[0]);
        self.vectors.push(results[1]);
    }
}

/// A number of up to 56 bits, as it is or as one that is often at the end of a range.
fn constant(n: u64) -> i64 {
    let shift = n >> 2 & 63;
    let number = match n & 3 {
        0 => n >> 8,
        1 => n >> 8 & 0xff,
        2 => u64::MAX >> shift,
        _ => 1 << shift,
    };
    number as i64
}

/// A program of these steps.
fn write(b: &mut Builder, steps: &[Step]) {
    let [state, argument, _] = Program::PARAMETERS;
    let vectors = (0..3).map(|i| b.load(VECTORS[i], state, 16 * i as i32)).collect();
    let mut random = Random { b, numbers: vec![argument], vectors, free: 0 };
    for (index, steps) in steps.chunks(8).enumerate() {
        let (numbers, vectors) = (random.numbers.len(), random.vectors.len());
        match index % 4 {
            0 => steps.iter().for_each(|step| random.step(*step)),
            1 => random.branch(steps, steps[0].1),
            2 => random.switch(steps, steps[0].1),
            _ => {
                random.repeat(steps, steps[0].1);
                let results = (random.numbers.pop().expect("a result"), random.vectors.pop().expect("a result"));
                random.numbers.truncate(numbers);
                random.vectors.truncate(vectors);
                random.numbers.push(results.0);
                random.vectors.push(results.1);
            }
        }
    }
    let (vector, number) = (random.vector(u8::MAX, Type::I8X16), random.number(u8::MAX));
    random.store(vector);
    random.b.give(number);
}

/// A state of 16-byte limbs, so that its vectors are aligned.
#[derive(Clone, Debug, PartialEq)]
#[repr(align(16))]
struct State([u8; STATE]);

/// What a program's code leaves: its result and the state.
#[allow(unsafe_code, reason = "calls generated code")]
fn run(steps: &[Step], argument: u64, mut state: State) -> (u64, State) {
    let mut jit = Jit::new().unwrap();
    let code = jit.function(|b, _, _| write(b, steps));
    // SAFETY: the program stays within the state: the evaluator found no other access.
    let result = unsafe { code.call(state.0.as_mut_ptr(), argument, std::ptr::null_mut()) };
    (result, state)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn code_does_what_the_evaluator_does(
        steps in proptest::collection::vec(any::<Step>(), 1..80),
        argument in any::<u64>(),
        bytes in proptest::collection::vec(any::<u8>(), STATE),
    ) {
        let state = State(bytes.try_into().expect("it has this length"));
        let mut builder = Builder::new(128);
        write(&mut builder, &steps);
        let (program, _kept) = builder.finish();
        prop_assert_eq!(program.verify(), Ok(()));
        let (text, addresses) = program.text_and_addresses(&Notes::NONE);
        prop_assert_eq!(Program::parse(&text, &addresses), Ok(program.settled()));
        // What is shown to stay in the state stays in it.
        let Ok(bounds) = program.check(&Only(STATE as i64)) else { return Ok(()) };
        let mut evaluated = state.clone();
        let address = 1 << 20;
        let mut memories = [Memory { address, bytes: &mut evaluated.0 }];
        let mut unexpected = Vec::new();
        let watch = &mut |value: Value, bytes: &Bytes| {
            unexpected.extend(bounds.refute(&program, value, bytes, |base| (base == Base::State).then_some(address)));
        };
        let called = &mut |_: u64, _: &[u64]| unreachable!("it calls nothing");
        let result = program.evaluate_watched([address, argument, 0], memories.as_mut_slice(), called, watch);
        let result = result.map_err(|wild| TestCaseError::fail(format!("{wild:?}")))?;
        prop_assert!(unexpected.is_empty(), "{unexpected:?}\n{text}");
        prop_assert_eq!(run(&steps, argument, state), (result, evaluated));
    }
}
