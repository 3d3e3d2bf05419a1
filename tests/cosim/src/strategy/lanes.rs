//! Work on rows and grids.

use super::*;

pub fn lane_work() -> impl Strategy<Value = LaneWork> {
    let sizes = (width(), select(vec![2u32, 3, 4, 5, 8, 9, 16, 17]), 2..5u32, any::<bool>());
    (sizes, vec(pick(), 1..4), vec(work(), 1..6), end()).prop_map(
        |((width, lanes, columns, signed), start, works, end)| LaneWork {
            width,
            lanes,
            columns,
            signed,
            start,
            works,
            end,
        },
    )
}

fn work() -> impl Strategy<Value = Work> {
    prop_oneof![
        2 => pick().prop_map(Work::Add),
        1 => any::<u64>().prop_map(Work::Number),
        1 => Just(Work::Before),
        2 => pick().prop_map(Work::Least),
        1 => control().prop_map(Work::Invert),
        2 => (-4..5i8, pick()).prop_map(|(by, edge)| Work::Shifted(by, edge)),
        1 => Just(Work::Reversed),
        1 => any::<u8>().prop_map(Work::Take),
        2 => Just(Work::Turn),
        2 => (of(pattern()), weighted(0.3, pattern()), control())
            .prop_map(|(reset, initial, count)| Work::Hold { reset, initial, count }),
        1 => (of(any::<u8>()), pick()).prop_map(|(initial, chosen)| Work::Colours { initial, chosen }),
        1 => (pick(), any::<bool>()).prop_map(|(address, own)| Work::Remember { address, own }),
    ]
}

fn end() -> impl Strategy<Value = End> {
    prop_oneof![
        2 => Just(End::Sum),
        1 => Just(End::Minimum),
        1 => Just(End::Maximum),
        1 => pick().prop_map(End::Pick),
        1 => Just(End::Pack),
        1 => Just(End::Tree),
        1 => Just(End::Stages),
        1 => Just(End::Least),
    ]
}
