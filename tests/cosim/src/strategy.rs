//! How random designs are drawn: mostly small widths with a tail beyond 128 bits, small modules, some of everything.

use crate::spec::*;
use proptest::collection::vec;
use proptest::option::{of, weighted};
use proptest::prelude::*;
use proptest::sample::select;
use tilewright_hdl::ReadUnderWrite;
use tilewright_hdl::ir::{Reduction, Relation, Shift};

/// Random designs.
pub fn designs() -> impl Strategy<Value = Spec> {
    let parts = prop_oneof![4 => vec(part(14), 1..2), 3 => vec(part(8), 1..4)];
    // Equal periods, a whole ratio, and edges that drift against each other.
    let second_period = weighted(0.4, select(vec![10_000u64, 20_000, 14_000, 26_002, 6_000]));
    (parts, second_period, stimulus()).prop_map(|(parts, second_period, stimulus)| Spec {
        parts,
        second_period,
        stimulus,
    })
}

fn stimulus() -> impl Strategy<Value = Stimulus> {
    (4..24u8, any::<u64>()).prop_map(|(steps, seed)| Stimulus { steps, seed })
}

fn part(most_steps: usize) -> impl Strategy<Value = Part> {
    (vec(input(), 0..5), vec(step(), 1..most_steps)).prop_map(|(inputs, steps)| Part { inputs, steps })
}

fn input() -> impl Strategy<Value = Input> {
    (width(), clock(), weighted(0.3, pick())).prop_map(|(width, clock, link)| Input { width, clock, link })
}

/// A width in bits, around the sizes of machine words more often.
pub fn width() -> impl Strategy<Value = u32> {
    prop_oneof![
        8 => 1..9u32,
        3 => 9..34u32,
        2 => select(vec![31, 32, 33, 63, 64, 65, 66]),
        1 => 34..140u32,
    ]
}

fn clock() -> impl Strategy<Value = ClockPick> {
    prop_oneof![3 => Just(ClockPick::Own), 2 => Just(ClockPick::Second)]
}

fn pick() -> impl Strategy<Value = Pick> {
    any::<u16>().prop_map(Pick)
}

fn picks<const N: usize>() -> impl Strategy<Value = [Pick; N]> {
    any::<[u16; N]>().prop_map(|numbers| numbers.map(Pick))
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

fn step() -> impl Strategy<Value = Step> {
    let make =
        prop_oneof![12 => operator().boxed(), 6 => choice().boxed(), 4 => wiring().boxed(), 10 => object().boxed()];
    (clock(), make).prop_map(|(clock, make)| Step { clock, make })
}

fn relation() -> impl Strategy<Value = Relation> {
    select(vec![Relation::Eq, Relation::Ne, Relation::Lt, Relation::Le, Relation::Gt, Relation::Ge])
}

fn shift() -> impl Strategy<Value = Shift> {
    select(vec![Shift::Left, Shift::Right, Shift::RightSigned])
}

fn operator() -> impl Strategy<Value = Make> {
    let unary = select(vec![Unary::Not, Unary::Negative, Unary::AllOnes, Unary::AnyOne, Unary::Parity]);
    let binary = select(vec![Binary::Add, Binary::Sub, Binary::And, Binary::Or, Binary::Xor, Binary::AddCarry]);
    prop_oneof![
        2 => (unary, pick()).prop_map(|(op, a)| Make::Unary(op, a)),
        4 => (binary, picks()).prop_map(|(op, [a, b])| Make::Binary(op, a, b)),
        1 => (any::<bool>(), picks()).prop_map(|(signed, operands)| Make::Product { signed, operands }),
        3 => (relation(), any::<bool>(), picks())
            .prop_map(|(relation, signed, operands)| Make::Compare { relation, signed, operands }),
        2 => (shift(), picks()).prop_map(|(shift, [of, by])| Make::Shift { shift, of, by }),
        1 => (shift(), pick(), 0..70u32).prop_map(|(shift, of, by)| Make::ShiftBy { shift, of, by }),
    ]
}

fn choice() -> impl Strategy<Value = Make> {
    let key = prop_oneof![3 => 0..8u64, 1 => any::<u64>()];
    prop_oneof![
        2 => picks().prop_map(|[select, on_true, on_false]| Make::Mux { select, on_true, on_false }),
        1 => (vec((pick(), pick()), 1..4), pick()).prop_map(|(arms, default)| Make::Select { arms, default }),
        1 => (picks(), vec((key, pick()), 1..5))
            .prop_map(|([subject, default], arms)| Make::Case { subject, arms, default }),
    ]
}

fn wiring() -> impl Strategy<Value = Make> {
    prop_oneof![
        (width(), pattern()).prop_map(|(width, pattern)| Make::Constant(width, pattern)),
        (pick(), 0..140u32, width()).prop_map(|(of, low, width)| Make::Slice { of, low, width }),
        (pick(), 1..70u32, any::<bool>()).prop_map(|(of, by, signed)| Make::Extend { of, by, signed }),
        vec(pick(), 2..5).prop_map(Make::Concat),
        (pick(), 2..5u32).prop_map(|(of, times)| Make::Repeat(of, times)),
        pick().prop_map(Make::Name),
        pick().prop_map(Make::Wire),
        pick().prop_map(Make::Assert),
    ]
}

fn object() -> impl Strategy<Value = Make> {
    let register = (width(), of(pattern()), of(pick()), pick())
        .prop_map(|(width, reset, enable, next)| Make::Register { width, reset, enable, next });
    prop_oneof![
        8 => register,
        1 => machine().prop_map(Make::Machine),
        3 => memory().prop_map(Make::Memory),
        2 => (any::<bool>(), pick()).prop_map(|(synchronize, of)| Make::Cross { synchronize, of }),
        3 => (pick(), vec(pick(), 0..5)).prop_map(|(part, inputs)| Make::Instance { part, inputs }),
        4 => array(),
    ]
}

fn machine() -> impl Strategy<Value = Machine> {
    let state = || (vec((pick(), 0..4u8), 0..3), of(0..4u8)).prop_map(|(when, otherwise)| Exits { when, otherwise });
    ([state(), state(), state(), state()], picks()).prop_map(|(states, chosen)| Machine { states, chosen })
}

fn memory() -> impl Strategy<Value = Memory> {
    let contents = prop_oneof![
        Just(Contents::Unknown),
        pattern().prop_map(Contents::Fill),
        vec(pattern(), 1..8).prop_map(Contents::Words),
    ];
    let policy = prop_oneof![Just(ReadUnderWrite::Old), Just(ReadUnderWrite::Any)];
    let read = (any::<bool>(), of(pick()), pick()).prop_map(|(asynchronous, enable, address)| Read {
        asynchronous,
        enable,
        address,
    });
    let write = || picks().prop_map(|[enable, address, data]| Write { enable, address, data });
    let ports = (vec(read, 1..3), prop_oneof![1 => vec(write(), 0), 4 => vec(write(), 1), 1 => vec(write(), 2)]);
    let depth = prop_oneof![1..9u32, 9..40u32];
    (depth, width(), policy, contents, ports, weighted(0.3, Just(()))).prop_map(
        |(depth, width, policy, contents, (reads, writes), crossing)| Memory {
            depth,
            width,
            policy,
            contents,
            reads,
            writes,
            crossing: crossing.is_some(),
        },
    )
}

fn array() -> impl Strategy<Value = Make> {
    let feed = prop_oneof![
        Just(Feed::Broadcast),
        Just(Feed::Each),
        Just(Feed::Index),
        any::<u8>().prop_map(Feed::Link),
        any::<u8>().prop_map(Feed::Link),
    ];
    let reduction = select(vec![Reduction::And, Reduction::Or, Reduction::Xor, Reduction::Add]);
    let gather =
        prop_oneof![reduction.prop_map(Gather::Reduce), (0..5u32).prop_map(Gather::Lane), Just(Gather::Concat),];
    (pick(), 1..6u32, any::<bool>(), vec((feed, pick()), 0..5), vec(gather, 0..6)).prop_map(
        |(part, lanes, towards_lower, inputs, outputs)| Make::Array { part, lanes, towards_lower, inputs, outputs },
    )
}
