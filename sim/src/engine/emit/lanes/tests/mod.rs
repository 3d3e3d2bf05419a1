//! Chains of random operations compared with [`crate::engine::semantics::lane`].

use std::ops::Range;

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Reduction, Shift, Unary};

mod chain;

use super::access::Span;
use super::vectors::low_mask;
use super::*;
use crate::engine::cranelift::Jit;
use crate::engine::cranelift::least;
use crate::engine::strips::{Builder, Type, Value};
use chain::{Random, chain};

/// A chain from each seed, with each strip of vectors of so many bits.
fn check_chains(seeds: Range<u64>, vector: u32, jit: impl Fn() -> Jit) {
    for strip in strips(vector) {
        for seed in seeds.clone() {
            let mut chain = chain(strip, vector, seed.wrapping_mul(3).wrapping_add(strip.into()));
            (0..160).for_each(|_| chain.operation());
            chain.check(jit(), seed % 3 > 0);
        }
    }
}

/// The strips of vectors of so many bits.
fn strips(vector: u32) -> [u32; 3] {
    [vector / 32, vector / 16, vector / 8]
}

fn host() -> Jit {
    Jit::new().unwrap()
}

/// Code, and programs that are evaluated, with the bits of a vector.
fn targets() -> [(u32, fn() -> Jit); 4] {
    [(128, host), (64, || host().evaluating(64)), (128, || host().evaluating(128)), (256, || host().evaluating(256))]
}

/// Each target with each of its strips.
fn targets_and_strips() -> impl Iterator<Item = (u32, fn() -> Jit, u32)> {
    targets().into_iter().flat_map(|(vector, jit)| strips(vector).map(|strip| (vector, jit, strip)))
}

#[test]
fn chains_of_operations_are_as_lane_by_lane() {
    check_chains(1000..1060, 128, host);
}

#[test]
fn chains_of_operations_in_vectors_of_any_width_are_as_lane_by_lane() {
    for (vector, jit) in targets() {
        check_chains(3000..3010, vector, jit);
    }
}

#[test]
fn chains_of_operations_need_no_more_than_a_processor_is_asked_for() {
    check_chains(2000..2020, 128, || Jit::on(least()));
}

/// Run by hand, for a long time: docs/decisions/engine.md has the command.
#[test]
#[ignore = "tries as many chains as LANES_CHAINS says, from LANES_SEED on"]
fn chains_of_operations_from_a_seed_are_as_lane_by_lane() {
    let number = |name| {
        let text: String = std::env::var(name).unwrap_or_else(|_| panic!("{name} says no number"));
        text.parse::<u64>().unwrap_or_else(|_| panic!("{name} is no number: {text}"))
    };
    let seed = number("LANES_SEED");
    for (vector, jit) in targets() {
        check_chains(seed..seed + number("LANES_CHAINS"), vector, jit);
    }
}

#[test]
fn shifts_by_all_amounts_are_as_lane_by_lane() {
    for (vector, jit, strip) in targets_and_strips() {
        let mut chain = chain(strip, vector, 5);
        for width in [2, 5, 8, 13, 16, 24, 25, 32, 40, 64] {
            for amount in [1, 2, 3, 4, 5, 6, 7, 8, 12, 32, 64] {
                let a = chain.input(width);
                let lanes =
                    (0..strip).map(|_| (chain.random.next() % (u64::from(width) + 3)) & low_mask(amount)).collect();
                let by = chain.add(Kind::State, amount, lanes, false);
                let scalar = (chain.random.next() % (u64::from(width) + 3)) & low_mask(amount);
                let uniform = chain.add(Kind::State, amount, vec![scalar; strip as usize], true);
                let known =
                    chain.add(Kind::Const(Bits::new(amount, scalar)), amount, vec![scalar; strip as usize], false);
                for op in [Shift::Left, Shift::Right, Shift::RightSigned] {
                    for by in [by, uniform, known] {
                        let kind = Kind::Shift(op, a, by);
                        let lanes = (0..strip as usize).map(|lane| chain.expected(&kind, width, lane)).collect();
                        chain.add(kind, width, lanes, false);
                    }
                }
            }
        }
        chain.check(jit(), true);
        chain.check(jit(), false);
    }
}

/// Calls code that stores numbers in memory.
#[allow(unsafe_code, reason = "calls generated code")]
fn run(mut jit: Jit, memory: &mut [u64], body: impl FnOnce(&mut Builder, Value)) {
    let code = jit.function(|b, state, _| {
        body(b, state);
        let zero = b.constant(Type::I64, 0);
        b.give(zero);
    });
    // SAFETY: the tests' code stays within the memory.
    unsafe { code.call(memory.as_mut_ptr().cast(), 0, std::ptr::null_mut()) };
}

#[test]
fn lanes_are_gathered_extracted_and_combined() {
    let mut random = Random(77);
    for (vector, jit, strip) in targets_and_strips() {
        for width in [1, 3, 8, 12, 16, 23, 32, 47, 64] {
            for by in [Reduction::And, Reduction::Or, Reduction::Xor, Reduction::Add] {
                let n = strip as usize;
                let numbers: Vec<u64> = (0..2 * n)
                    .map(|_| match by {
                        Reduction::And => random.number(width) | random.number(width) | random.number(width),
                        _ => random.number(width),
                    })
                    .collect();
                let mut memory = numbers.clone();
                memory.resize(4 * n + 3, 0);
                run(jit(), &mut memory, |b, state| {
                    let mut lanes = Lanes::new(strip, vector);
                    let (x, y, not) = (ValueId(0), ValueId(1), ValueId(2));
                    let scalars: Vec<Value> = (0..2 * n).map(|i| b.load(Type::I64, state, 8 * i as i32)).collect();
                    lanes.gather(b, x, width, &scalars[..n]);
                    lanes.gather(b, y, width, &scalars[n..]);
                    // Undefined upper bits, and back.
                    lanes.evaluate(b, not, &Kind::Unary(Unary::Not, x), width);
                    for lane in 0..n {
                        let [x, not] = [x, not].map(|id| lanes.extract(b, id, lane as u32));
                        b.store(x, state, 8 * (2 * n + lane) as i32);
                        b.store(not, state, 8 * (3 * n + lane) as i32);
                    }
                    let [x, y] = [x, y].map(|id| lanes.carried(b, id));
                    let start = lanes.neutral(b, by, width);
                    let all = lanes.combine(b, by, &start, &x);
                    let all = lanes.combine(b, by, &all, &y);
                    let all = lanes.reduce(b, by, &all);
                    b.store(all, state, 32 * n as i32);
                    if width == 1 {
                        for (i, id) in [ValueId(0), not].into_iter().enumerate() {
                            let any = lanes.any(b, id);
                            let any = b.zero_extend(Type::I64, any);
                            b.store(any, state, (32 * n + 8 * (i + 1)) as i32);
                        }
                    }
                });
                let what = format!("{by:?} of {strip} lanes of {width} bits in {vector}: {numbers:x?}");
                assert_eq!(memory[2 * n..3 * n], numbers[..n], "{what}");
                let inverted: Vec<u64> = numbers[..n].iter().map(|number| !number & low_mask(width)).collect();
                assert_eq!(memory[3 * n..4 * n], inverted, "{what}");
                let combined = numbers.iter().copied().reduce(|x, y| match by {
                    Reduction::And => x & y,
                    Reduction::Or => x | y,
                    Reduction::Xor => x ^ y,
                    Reduction::Add => x.wrapping_add(y),
                    Reduction::Min | Reduction::Max => unreachable!("they are lowered"),
                });
                assert_eq!(memory[4 * n], combined.unwrap() & low_mask(width), "{what}");
                if width == 1 {
                    assert_eq!(memory[4 * n + 1], u64::from(numbers[..n].contains(&1)), "{what}");
                    assert_eq!(memory[4 * n + 2], u64::from(numbers[..n].contains(&0)), "{what}");
                }
            }
        }
    }
}

#[test]
fn old_lanes_remain_where_a_mask_is_zero() {
    for (vector, jit, strip) in targets_and_strips() {
        for (width, storage) in [(1, 8), (1, 64), (5, 8), (12, 16), (16, 64), (30, 32), (50, 64)] {
            let mut random = Random(u64::from(width * storage));
            let lanes: Vec<[u64; 3]> =
                (0..strip).map(|_| [random.next() & 1, random.number(width), random.number(width)]).collect();
            let mut memory = vec![0; 4 * 32];
            (0..strip as usize).for_each(|i| (0..3).for_each(|j| memory[32 * j + i] = lanes[i][j]));
            run(jit(), &mut memory, |b, state| {
                let mut strips = Lanes::new(strip, vector);
                for (j, width) in [1, width, width].into_iter().enumerate() {
                    let numbers: Vec<Value> =
                        (0..strip as i32).map(|i| b.load(Type::I64, state, 256 * j as i32 + 8 * i)).collect();
                    strips.gather(b, ValueId(j as u32), width, &numbers);
                }
                let to = Span { storage, address: state, offset: 768, aligned: false };
                strips.store_where(b, ValueId(0), ValueId(1), ValueId(2), to);
                let mark = strips.mark();
                strips.evaluate(b, ValueId(9), &Kind::Unary(Unary::Not, ValueId(0)), 1);
                strips.forget(mark);
                assert!(!strips.has(ValueId(9)));
            });
            let bytes: Vec<u8> = memory[96..].iter().flat_map(|word| word.to_le_bytes()).collect();
            for (i, [select, new, old]) in lanes.iter().enumerate() {
                let want = if *select == 1 { *new } else { *old };
                let want = if width == 1 { want.wrapping_neg() } else { want };
                let size = storage as usize / 8;
                assert_eq!(bytes[i * size..][..size], want.to_le_bytes()[..size], "{strip} {width} {storage}");
            }
        }
    }
}
