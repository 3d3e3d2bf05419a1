//! Helpers for tests: random instructions, and a simple program.

use proptest::prelude::*;

use super::instruction::Instruction;
use super::pixel::{Begin, Condition, Enabling, Flagging, Function, Mask, Source};
use crate::prelude::Codes;

/// Instructions that access the same few words of memory and registers. None synchronizes with a port.
pub(super) fn instructions() -> impl Strategy<Value = Instruction<u64>> {
    let address = || prop_oneof![3 => 8..24u64, 1 => 252..260u64, 1 => 284..292u64, 1 => 316..324u64];
    let coefficient = || prop_oneof![0..1u64 << 40, 0..64u64, (0..64u64).prop_map(|number| (1 << 40) - 1 - number)];
    let codes = (0..4u64, prop_oneof![2 => Just(0u64), 3 => 0..11u64], 0..3u64, 0..4u64, 0..3u64);
    let flags = (prop_oneof![3 => Just(0u64), 2 => 0..7u64], prop_oneof![2 => Just(0u64), 1 => 0..3u64]);
    let bits = prop::array::uniform3(0..2u64);
    let clocks = (0..8u64, 1..9u64);
    let numbers = (address(), address(), prop::array::uniform3(coefficient()));
    (codes, flags, bits, clocks, numbers).prop_map(|(codes, flags, bits, (skip, length), (read, write, [a, b, c]))| {
        let (source, function, begin, mask, condition) = codes;
        let ((enabling, flagging), [accumulates, stores, descends]) = (flags, bits);
        let skip = if source == Source::Expression.code() { skip } else { 0 };
        Instruction {
            source,
            function,
            begin,
            mask,
            accumulates,
            stores,
            condition,
            enabling,
            flagging,
            skip,
            length,
            descends,
            read,
            write,
            sync: 0,
            a,
            b,
            c,
        }
    })
}

/// An edge that is tested by the sign of its last byte.
pub(super) fn edge(enabling: Enabling, [a, b, c]: [i64; 3], bytes: u64) -> Instruction<u64> {
    let [a, b, c] = [a, b, c].map(|coefficient| coefficient as u64 & ((1 << 40) - 1));
    Instruction {
        source: Source::Expression.code(),
        condition: Condition::Positive.code(),
        enabling: enabling.code(),
        skip: bytes - 1,
        a,
        b,
        c,
        ..Instruction::NOTHING
    }
}

/// The parts of a triangle that take clocks: the edges, four planes, a comparison with bytes 0 to 5, and a copy of the
/// new bytes. The plane of depth has 5 bytes, and that of each colour has 3. The results go to bytes 10 to 15, with the
/// depth on top.
pub(super) fn triangle(edges: [[i64; 3]; 3], edge_bytes: u64, planes: [[i64; 3]; 4]) -> Vec<Instruction<u64>> {
    let [first, second, third] = edges;
    let edges = [
        edge(Enabling::Replace, first, edge_bytes),
        edge(Enabling::Restrict, second, edge_bytes),
        edge(Enabling::Restrict, third, edge_bytes),
    ];
    // Each new byte is compared with the stored one, and stays in memory.
    let plane = |begin: Begin, flagging: Flagging, [a, b, c]: [i64; 3], skip: u64, length: u64, address: u64| {
        let [a, b, c] = [a, b, c].map(|coefficient| coefficient as u64 & ((1 << 40) - 1));
        Instruction {
            source: Source::Expression.code(),
            function: Function::Compare.code(),
            begin: begin.code(),
            mask: Mask::Everybody.code(),
            stores: 1,
            condition: Condition::NoCarry.code(),
            flagging: flagging.code(),
            skip,
            length,
            read: address,
            write: address + 10,
            a,
            b,
            c,
            ..Instruction::NOTHING
        }
    };
    let [z, red, green, blue] = planes;
    let (kept, last) = (Begin::Kept, Flagging::EnabledCondition);
    let planes = [
        plane(Begin::One, Flagging::Keep, blue, 2, 1, 0),
        plane(kept, Flagging::Keep, green, 2, 1, 1),
        plane(kept, Flagging::Keep, red, 2, 1, 2),
        plane(kept, last, z, 2, 3, 3),
    ];
    let commit = Instruction {
        function: Function::Word.code(),
        mask: Mask::Flagged.code(),
        stores: 1,
        length: 6,
        read: 10,
        ..Instruction::NOTHING
    };
    [&edges[..], &planes, &[commit]].concat()
}

/// The processor time of this thread in nanoseconds, as Linux counts it. Other work on the machine does not change it.
pub(super) fn processor_time() -> u64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux counts a thread's time");
    text.split(' ').next().and_then(|number| number.parse().ok()).expect("the first number is the time")
}
