//! How random designs with shapes are drawn: shapes that fill vectors and shapes that do not, values of one part mostly of
//! one size, some of every operation.

use super::spec::*;
use proptest::collection::vec;
use proptest::option::{of, weighted};
use proptest::prelude::*;
use proptest::sample::select;
use tilewright_hdl::ReadUnderWrite;
use tilewright_hdl::ir::{Affine, Binary, Reduction, Relation, Shape, Shift, Unary};

/// Random designs.
pub fn designs() -> impl Strategy<Value = Spec> {
    let parts = prop_oneof![
        3 => vec(part(14), 1..2),
        3 => vec(part(10), 2..3),
        1 => vec(part(7), 3..4),
    ];
    let second_period = weighted(0.2, select(vec![10_000u64, 20_000, 14_000, 6_000]));
    let names = prop_oneof![1 => Just(0u64), 3 => any::<u64>()];
    let order = prop_oneof![3 => Just(0u64), 1 => any::<u64>()];
    let odd = (order, weighted(0.2, Just(()))).prop_map(|(order, reads)| Odd { order, reads_any: reads.is_some() });
    let stimulus = (4..20u8, any::<u64>()).prop_map(|(steps, seed)| Stimulus { steps, seed });
    (parts, second_period, names, odd, stimulus).prop_map(|(parts, second_period, names, odd, stimulus)| Spec {
        parts,
        second_period,
        names,
        odd,
        stimulus,
    })
}

/// Random designs for our own engines alone.
pub fn odd_designs() -> impl Strategy<Value = Spec> {
    designs().prop_map(|spec| Spec { odd: Odd { order: spec.stimulus.seed | 1, ..spec.odd }, ..spec })
}

fn part(most_steps: usize) -> impl Strategy<Value = Part> {
    size().prop_flat_map(move |size| {
        let inputs = vec((width(size), shape_pick()), 1..5);
        (inputs, vec(shape(), 1..3), vec(step(size), 1..most_steps)).prop_map(|(inputs, shapes, steps)| Part {
            inputs,
            shapes,
            steps,
        })
    })
}

fn shape() -> impl Strategy<Value = Shape> {
    let row = || select(vec![1u32, 2, 3, 4, 5, 7, 8, 9, 16, 17, 33]).prop_map(Shape::Row);
    let sides = vec![(1, 1), (1, 4), (5, 1), (2, 2), (2, 3), (3, 5), (4, 4), (5, 8), (8, 2), (1, 17), (9, 3), (4, 9)];
    let grid = || select(sides).prop_map(|(rows, columns)| Shape::Grid(rows, columns));
    prop_oneof![2 => row(), 3 => grid()]
}

/// Plain in a third.
fn shape_pick() -> impl Strategy<Value = ShapePick> {
    prop_oneof![1 => Just(ShapePick(0)), 3 => any::<u8>().prop_map(ShapePick)]
}

/// The width that the values of a part mostly have.
fn size() -> impl Strategy<Value = u32> {
    prop_oneof![3 => Just(0u32), 6 => select(vec![1u32, 1, 3, 5, 8, 8, 12, 16, 16, 24, 32, 32, 48, 64])]
}

fn width(size: u32) -> BoxedStrategy<u32> {
    let any = prop_oneof![
        10 => 1..9u32,
        5 => 9..34u32,
        3 => select(vec![31, 32, 33, 63, 64, 65, 66]),
        2 => 34..72u32,
        1 => select(vec![100u32, 127, 128, 129, 200, 256, 257, 280]),
    ];
    if size == 0 { any.boxed() } else { prop_oneof![5 => Just(size), 2 => any].boxed() }
}

fn pick() -> impl Strategy<Value = Pick> {
    any::<u16>().prop_map(Pick)
}

fn picks<const N: usize>() -> impl Strategy<Value = [Pick; N]> {
    any::<[u16; N]>().prop_map(|numbers| numbers.map(Pick))
}

fn axis() -> impl Strategy<Value = u8> {
    0..2u8
}

fn count() -> impl Strategy<Value = Count> {
    any::<u8>().prop_map(Count)
}

fn pattern() -> impl Strategy<Value = Pattern> {
    prop_oneof![
        Just(Pattern::Zero),
        Just(Pattern::Ones),
        Just(Pattern::One),
        Just(Pattern::Sign),
        Just(Pattern::Alternating),
        any::<u64>().prop_map(Pattern::Number),
    ]
}

fn binary() -> impl Strategy<Value = Binary> {
    use Binary::{Add, And, Mul, MulSigned, Or, Sub, Xor};
    prop_oneof![8 => select(vec![And, Or, Xor, Add, Add, Sub]), 1 => select(vec![Mul, MulSigned])]
}

fn reduction() -> impl Strategy<Value = Reduction> {
    use Reduction::{Add, And, Max, Min, Or, Xor};
    select(vec![And, Or, Xor, Add, Min, Max])
}

fn shift() -> impl Strategy<Value = Shift> {
    select(vec![Shift::Left, Shift::Right, Shift::RightSigned])
}

fn fold() -> impl Strategy<Value = Fold> {
    prop_oneof![
        6 => binary().prop_map(Fold::Binary),
        1 => Just(Fold::Min),
        1 => Just(Fold::Shifted),
        1 => Just(Fold::Chosen),
    ]
}

fn folds() -> impl Strategy<Value = Vec<(Fold, Pick)>> {
    vec((fold(), pick()), 1..4)
}

fn route() -> impl Strategy<Value = Route> {
    let any = (-3..4i32, -6..20i32, 1..5u32).prop_map(|(mul, add, div)| Affine { mul, add, div });
    prop_oneof![
        6 => select(vec![-1i8, 1, -1, 1, 2, -2, 4, -5]).prop_map(Route::Shift),
        1 => Just(Route::Reverse),
        1 => (2..5u8).prop_map(Route::Stretch),
        1 => (2..5u8).prop_map(Route::Stride),
        1 => Just(Route::Spread),
        3 => any.prop_map(Route::Any),
    ]
}

/// A rule that leads to lanes before or behind.
fn link() -> impl Strategy<Value = Link> {
    let tree = || select(vec![(1, -1, 2), (1, -1, 3), (2, 1, 1), (2, 2, 1), (1, -1, 2), (3, 1, 1)]);
    let tree = tree().prop_map(|(mul, add, div)| Route::Any(Affine { mul, add, div }));
    (axis(), prop_oneof![4 => route(), 1 => tree], pick(), folds()).prop_map(|(axis, route, edge, with)| Link {
        axis,
        route,
        edge,
        with,
    })
}

fn step(size: u32) -> impl Strategy<Value = Step> {
    let make = prop_oneof![
        8 => operator(size).boxed(),
        4 => choice(size).boxed(),
        14 => lanes().boxed(),
        10 => object(size).boxed(),
    ];
    (weighted(0.3, Just(())), make).prop_map(|(second, make)| Step { second: second.is_some(), make })
}

fn operator(size: u32) -> impl Strategy<Value = Make> {
    use Relation::{Eq, Ge, Gt, Le, Lt, Ne};
    let unary = select(vec![Unary::Not, Unary::AllOnes, Unary::AnyOne, Unary::Parity]);
    let relation = select(vec![Eq, Ne, Lt, Le, Gt, Ge]);
    let shape = shape_pick;
    prop_oneof![
        1 => (width(size), pattern(), shape())
            .prop_map(|(width, pattern, shape)| Make::Constant { width, pattern, shape }),
        2 => (width(size), of(any::<u64>()), shape())
            .prop_map(|(width, seed, shape)| Make::Table { width, seed, shape }),
        2 => (unary, pick()).prop_map(|(op, a)| Make::Unary(op, a)),
        4 => (binary(), pick(), pick()).prop_map(|(op, a, b)| Make::Binary(op, a, b)),
        2 => (relation, any::<bool>(), picks())
            .prop_map(|(relation, signed, operands)| Make::Compare { relation, signed, operands }),
        1 => (shift(), pick(), pick()).prop_map(|(shift, of, by)| Make::Shift { shift, of, by }),
        1 => (shift(), pick(), prop_oneof![0..9u32, 0..70u32])
            .prop_map(|(shift, of, by)| Make::ShiftBy { shift, of, by }),
        2 => (pick(), 0..70u32, width(size)).prop_map(|(of, low, width)| Make::Slice { of, low, width }),
        1 => (pick(), 1..70u32, any::<bool>()).prop_map(|(of, by, signed)| Make::Extend { of, by, signed }),
        1 => vec(pick(), 2..5).prop_map(Make::Concat),
        1 => (pick(), 2..5u32).prop_map(|(of, times)| Make::Repeat(of, times)),
        1 => pick().prop_map(Make::Name),
        1 => pick().prop_map(Make::Assert),
        1 => (pick(), pattern()).prop_map(|(of, pattern)| Make::Never(of, pattern)),
        1 => (pick(), pattern()).prop_map(|(of, pattern)| Make::Sometimes(of, pattern)),
        1 => pick().prop_map(Make::Past),
    ]
}

fn choice(size: u32) -> impl Strategy<Value = Make> {
    let key = prop_oneof![3 => 0..8u64, 1 => any::<u64>()];
    prop_oneof![
        3 => picks().prop_map(|[select, on_true, on_false]| Make::Mux { select, on_true, on_false }),
        1 => (vec((pick(), pick()), 1..4), pick()).prop_map(|(arms, default)| Make::Select { arms, default }),
        2 => (pick(), pick(), vec((key, pick()), 1..9))
            .prop_map(|(subject, default, arms)| Make::Case { subject, arms, default }),
        1 => (pick(), 1..7u32, width(size), vec(pattern(), 3..12))
            .prop_map(|(subject, bits, width, words)| Make::Lookup { subject, bits, width, words }),
    ]
}

fn lanes() -> impl Strategy<Value = Make> {
    let index = (pick(), axis(), pick(), of(prop_oneof![4 => 1..9u32, 1 => 9..140u32]));
    prop_oneof![
        2 => (pick(), axis(), count()).prop_map(|(of, axis, count)| Make::Broadcast { of, axis, count }),
        2 => (vec(pick(), 1..9), axis()).prop_map(|(parts, axis)| Make::Stack { parts, axis }),
        5 => (pick(), axis(), route(), count(), pick())
            .prop_map(|(of, axis, route, count, edge)| Make::Map { of, axis, route, count, edge }),
        2 => (vec(pick(), 1..4), axis()).prop_map(|(parts, axis)| Make::Interleave { parts, axis }),
        2 => (pick(), axis(), any::<u8>()).prop_map(|(of, axis, index)| Make::Lane { of, axis, index }),
        3 => index.prop_map(|(of, axis, index, bits)| Make::PickLane { of, axis, index, bits }),
        3 => (reduction(), pick(), axis()).prop_map(|(by, of, axis)| Make::Reduce { by, of, axis }),
        1 => (reduction(), pick()).prop_map(|(by, of)| Make::ReduceAll { by, of }),
        2 => (pick(), axis()).prop_map(|(of, axis)| Make::Pack { of, axis }),
        2 => (pick(), axis(), count()).prop_map(|(of, axis, count)| Make::Unpack { of, axis, count }),
        2 => (pick(), folds(), axis()).prop_map(|(of, with, axis)| Make::Apart { of, with, axis }),
    ]
}

fn object(size: u32) -> impl Strategy<Value = Make> {
    let reset = prop_oneof![
        1 => Just(Reset::Keeps),
        2 => pattern().prop_map(Reset::Same),
        2 => any::<u64>().prop_map(Reset::Each),
    ];
    let start = (width(size), shape_pick(), reset, weighted(0.2, pattern()));
    let start = start.prop_map(|(width, shape, reset, initial)| Start { width, shape, reset, initial }).boxed();
    let register = (start.clone(), of(pick()), pick(), weighted(0.3, link()));
    let register = register.prop_map(|(start, enable, next, link)| Make::Register { start, enable, next, link });
    let chosen = (start, vec((pick(), pick()), 1..4)).prop_map(|(start, updates)| Make::Chosen { start, updates });
    let held = prop_oneof![Just(Held::Net), Just(Held::Register), pick().prop_map(Held::Memory)];
    let record = (vec(pick(), 2..5), held).prop_map(|(fields, held)| Make::Record { fields, held });
    let feed = prop_oneof![
        4 => Just(Feed::Value),
        1 => Just(Feed::Index),
        3 => (axis(), pick()).prop_map(|(axis, edge)| Feed::Previous { axis, edge }),
    ];
    let copies = prop_oneof![4 => Just(1u8), 1 => 2..7u8];
    let instance = (prop_oneof![2 => Just(Pick(0)), 1 => pick()], shape_pick(), copies, vec((feed, pick()), 0..5));
    let instance = instance.prop_map(|(part, shape, copies, inputs)| Make::Instance { part, shape, copies, inputs });
    let chain = (width(size), shape_pick(), vec(link(), 1..4)).prop_map(|(width, shape, links)| Make::Chain {
        width,
        shape,
        links,
    });
    let ladder = (pick(), axis(), fold()).prop_map(|(of, axis, fold)| Make::Ladder { of, axis, fold });
    prop_oneof![
        7 => register,
        2 => chosen,
        1 => record,
        4 => memory(size).prop_map(Make::Memory),
        6 => instance,
        4 => chain,
        1 => ladder,
    ]
}

fn maybe_plain() -> impl Strategy<Value = MaybePlain> {
    (pick(), any::<bool>()).prop_map(|(pick, plain)| MaybePlain { pick, plain })
}

fn memory(size: u32) -> impl Strategy<Value = Store> {
    let contents = prop_oneof![
        Just(Filling::Unknown),
        pattern().prop_map(Filling::Fill),
        vec(pattern(), 1..8).prop_map(Filling::Words),
        (any::<u64>(), 1..8u8).prop_map(|(seed, words)| Filling::Each(seed, words)),
    ];
    let policy = prop_oneof![Just(ReadUnderWrite::Old), Just(ReadUnderWrite::Any)];
    let read = (any::<bool>(), weighted(0.2, Just(())), of(maybe_plain()), maybe_plain());
    let read = read.prop_map(|(asynchronous, crossing, enable, address)| Read {
        asynchronous,
        crossing: crossing.is_some(),
        enable,
        address,
    });
    let write =
        || (maybe_plain(), maybe_plain(), pick()).prop_map(|(enable, address, data)| Write { enable, address, data });
    let writes = prop_oneof![1 => vec(write(), 0), 4 => vec(write(), 1), 2 => vec(write(), 2)];
    let depth = prop_oneof![2 => 1..9u32, 2 => 9..40u32, 1 => select(vec![2, 4, 8, 16, 32])];
    // One in three has the same address in all lanes.
    let common = weighted(0.35, pick());
    ((depth, width(size), shape_pick()), policy, contents, vec(read, 1..3), writes, weighted(0.25, width(size)), common)
        .prop_map(|((depth, width, shape), policy, contents, mut reads, mut writes, twin, common)| {
            if let Some(pick) = common {
                let common = MaybePlain { pick, plain: true };
                reads.iter_mut().for_each(|read| read.address = common);
                writes.iter_mut().for_each(|write| write.address = common);
            }
            Store { depth, width, shape, policy, contents, reads, writes, twin }
        })
}
