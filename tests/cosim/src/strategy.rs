//! How random designs are drawn: mostly small widths with a tail beyond 128 bits, small modules, some of everything;
//! or arrays of arrays whose values are mostly of one size (`strategy/arrays.rs`).

mod arrays;
mod lanes;

use crate::spec::*;
use lanes::lane_work;
use proptest::collection::vec;
use proptest::option::{of, weighted};
use proptest::prelude::*;
use proptest::sample::select;
use tilewright_hdl::ReadUnderWrite;
use tilewright_hdl::ir::{Relation, Shift};

/// Random designs.
pub fn designs() -> impl Strategy<Value = Spec> {
    let parts = prop_oneof![4 => vec(part(14), 1..2), 3 => vec(part(8), 1..4), 3 => arrays::nested()];
    // Other simulators take long to read what is large.
    let room = prop_oneof![7 => 100..250u32, 1 => 250..900u32];
    // Equal periods, a whole ratio, and edges that drift against each other.
    let second_period = weighted(0.4, select(vec![10_000u64, 20_000, 14_000, 26_002, 6_000]));
    let names = prop_oneof![1 => Just(0u64), 4 => any::<u64>()];
    (parts, room, second_period, names, stimulus()).prop_map(|(parts, room, second_period, names, stimulus)| Spec {
        parts,
        room,
        second_period,
        names,
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
    let link = (pick(), any::<bool>()).prop_map(|(of, registered)| Link { of, registered });
    (width(), clock(), weighted(0.4, link)).prop_map(|(width, clock, link)| Input { width, clock, link })
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

/// A pick that is often the first value, which an array often gives to all of its lanes: what is chosen, enabled or
/// addressed by it is so in all lanes alike.
fn control() -> impl Strategy<Value = Pick> {
    prop_oneof![2 => Just(Pick(0)), 3 => pick()]
}

/// The parts of arrays and instances: often the last one, so that arrays nest.
fn part_pick() -> impl Strategy<Value = Pick> {
    prop_oneof![2 => Just(Pick(0)), 1 => pick()]
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

fn binary() -> impl Strategy<Value = Binary> {
    select(vec![Binary::Add, Binary::Sub, Binary::And, Binary::Or, Binary::Xor, Binary::AddCarry])
}

fn operator() -> impl Strategy<Value = Make> {
    let unary = select(vec![Unary::Not, Unary::Negative, Unary::AllOnes, Unary::AnyOne, Unary::Parity]);
    prop_oneof![
        2 => (unary, pick()).prop_map(|(op, a)| Make::Unary(op, a)),
        4 => (binary(), picks()).prop_map(|(op, [a, b])| Make::Binary(op, a, b)),
        1 => (any::<bool>(), picks()).prop_map(|(signed, operands)| Make::Product { signed, operands }),
        3 => (relation(), any::<bool>(), picks())
            .prop_map(|(relation, signed, operands)| Make::Compare { relation, signed, operands }),
        2 => (shift(), pick(), control()).prop_map(|(shift, of, by)| Make::Shift { shift, of, by }),
        2 => (shift(), pick(), prop_oneof![0..9u32, 0..70u32], any::<bool>())
            .prop_map(|(shift, of, by, literal)| Make::ShiftBy { shift, of, by, literal }),
        1 => (pick(), 0..4u32, 0..63u32).prop_map(|(of, size, by)| Make::Rotate { of, size, by }),
        1 => (control(), prop_oneof![3 => 0..8u64, 1 => any::<u64>()]).prop_map(|(of, value)| Make::Is(of, value)),
    ]
}

fn choice() -> impl Strategy<Value = Make> {
    let key = prop_oneof![3 => 0..8u64, 1 => any::<u64>()];
    prop_oneof![
        2 => (control(), picks())
            .prop_map(|(select, [on_true, on_false])| Make::Mux { select, on_true, on_false }),
        1 => (vec((control(), pick()), 1..4), pick()).prop_map(|(arms, default)| Make::Select { arms, default }),
        1 => (control(), pick(), vec((key, pick()), 1..5))
            .prop_map(|(subject, default, arms)| Make::Case { subject, arms, default }),
        1 => alu(),
        1 => lookup(),
    ]
}

/// Few operations, or as many as an opcode has values.
fn alu() -> impl Strategy<Value = Make> {
    let arm = || (binary(), picks()).prop_map(|(op, operands)| Arm { op, operands });
    let arms = prop_oneof![3 => vec(arm(), 1..8), 1 => vec(arm(), 8..30)];
    (control(), 1..7u32, arms, pick()).prop_map(|(subject, bits, arms, default)| Make::Alu {
        subject,
        bits,
        arms,
        default,
    })
}

fn lookup() -> impl Strategy<Value = Make> {
    (control(), 1..9u32, width(), vec(pattern(), 3..12)).prop_map(|(subject, bits, width, words)| Make::Lookup {
        subject,
        bits,
        width,
        words,
    })
}

fn wiring() -> impl Strategy<Value = Make> {
    prop_oneof![
        5 => (width(), pattern()).prop_map(|(width, pattern)| Make::Constant(width, pattern)),
        3 => (pick(), 0..140u32, width()).prop_map(|(of, low, width)| Make::Slice { of, low, width }),
        3 => (pick(), 1..70u32, any::<bool>()).prop_map(|(of, by, signed)| Make::Extend { of, by, signed }),
        3 => vec(pick(), 2..5).prop_map(Make::Concat),
        3 => (pick(), 2..5u32).prop_map(|(of, times)| Make::Repeat(of, times)),
        3 => pick().prop_map(Make::Name),
        3 => pick().prop_map(Make::Wire),
        5 => (statement(), pick()).prop_map(|(statement, of)| Make::State(statement, of)),
        1 => (pick(), pattern()).prop_map(|(of, pattern)| Make::Never(of, pattern)),
    ]
}

fn statement() -> impl Strategy<Value = Statement> {
    prop_oneof![
        2 => Just(Statement::Assert),
        1 => Just(Statement::Assume),
        1 => pattern().prop_map(Statement::Cover),
        1 => Just(Statement::Rises),
        1 => Just(Statement::Falls),
        2 => (0..3u8).prop_map(Statement::Past),
    ]
}

fn coded() -> impl Strategy<Value = Coded> {
    (any::<bool>(), 0..5u8, vec((control(), 0..5u8), 1..4), picks(), pick()).prop_map(
        |(begins_with_reset, first, updates, chosen, raw)| Coded { begins_with_reset, first, updates, chosen, raw },
    )
}

fn in_parts() -> impl Strategy<Value = InParts> {
    (1..5u32, prop_oneof![1 => Just(8), 1 => 1..20u32], 1..20u32, any::<bool>(), picks())
        .prop_map(|(parts, width, depth, asynchronous, ports)| InParts { parts, width, depth, asynchronous, ports })
}

fn declared() -> impl Strategy<Value = Declared> {
    let lanes = prop_oneof![Just(0), 1..6u32];
    ([width(), width()], 1..4u32, lanes, any::<u64>(), picks())
        .prop_map(|(widths, list, lanes, numbers, picks)| Declared { widths, list, lanes, numbers, picks })
}

fn object() -> impl Strategy<Value = Make> {
    let register = prop_oneof![
        2 => (width(), of(pattern()), of(control()), pick()).prop_map(|(width, reset, enable, next)| Make::Register {
            width,
            reset,
            enable,
            updates: Vec::new(),
            next: Some(next)
        }),
        1 => (width(), of(pattern()), of(control()), vec((control(), pick()), 1..4), of(pick())).prop_map(
            |(width, reset, enable, updates, next)| Make::Register { width, reset, enable, updates, next }
        ),
    ];
    prop_oneof![
        8 => register,
        2 => chain(),
        1 => machine().prop_map(Make::Machine),
        3 => memory().prop_map(Make::Memory),
        1 => records().prop_map(Make::Records),
        1 => coded().prop_map(Make::Coded),
        1 => (pattern(), of(pattern()), pick()).prop_map(|(initial, reset, next)| Make::PowerOn { initial, reset, next }),
        1 => in_parts().prop_map(Make::InParts),
        1 => declared().prop_map(Make::Declared),
        2 => lane_work().prop_map(Make::Lanes),
        2 => (any::<bool>(), pick()).prop_map(|(synchronize, of)| Make::Cross { synchronize, of }),
        3 => (part_pick(), vec(pick(), 0..5)).prop_map(|(part, inputs)| Make::Instance { part, inputs }),
        4 => arrays::array(1..6),
    ]
}

fn chain() -> impl Strategy<Value = Make> {
    (width(), 1..5u32, any::<bool>(), of(control()), pick())
        .prop_map(|(width, length, ring, enable, from)| Make::Chain { width, length, ring, enable, from })
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
    let read = (any::<bool>(), of(control()), pick()).prop_map(|(asynchronous, enable, address)| Read {
        asynchronous,
        enable,
        address,
    });
    let write = || (control(), picks()).prop_map(|(enable, [address, data])| Write { enable, address, data });
    let ports = (vec(read, 1..3), prop_oneof![1 => vec(write(), 0), 4 => vec(write(), 1), 2 => vec(write(), 2)]);
    let depth = prop_oneof![2 => 1..9u32, 2 => 9..40u32, 1 => select(vec![2, 4, 8, 16, 32])];
    let width = || prop_oneof![2 => width(), 1 => select(vec![1, 8, 16, 32, 48, 64, 65, 100])];
    let widths = (width(), weighted(0.25, width()));
    // One in three has the same address in all lanes, if the first value is the same there.
    let options = (weighted(0.3, Just(())), weighted(0.35, Just(Pick(0))));
    (depth, widths, policy, contents, ports, options).prop_map(
        |(depth, (width, twin), policy, contents, (mut reads, mut writes), (crossing, common))| {
            if let Some(common) = common {
                reads.iter_mut().for_each(|read| read.address = common);
                writes.iter_mut().for_each(|write| write.address = common);
            }
            Memory { depth, width, policy, contents, reads, writes, crossing: crossing.is_some(), twin }
        },
    )
}

fn records() -> impl Strategy<Value = Records> {
    let widths = ([width(), width(), width(), width()], 0..3u32);
    let updates = (vec((control(), of(pick())), 0..4), of(pick()));
    let memory = (1..20u32, vec(pattern(), 0..4), any::<bool>(), picks());
    (widths, of(pattern()), updates, memory, 0..4u32).prop_map(
        |((widths, list), reset, (updates, otherwise), (depth, contents, asynchronous, ports), stages)| Records {
            widths,
            list,
            reset,
            updates,
            otherwise,
            depth,
            contents,
            asynchronous,
            ports,
            stages,
        },
    )
}
