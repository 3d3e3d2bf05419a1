//! How random designs are drawn: mostly small widths with a tail beyond 128 bits, small modules, some of everything;
//! or arrays of arrays whose values are mostly of one size (`strategy/arrays.rs`). `strategy/objects.rs` draws what holds state.

mod arrays;
mod lanes;
mod objects;

use crate::spec::*;
use objects::object;
use proptest::collection::vec;
use proptest::option::{of, weighted};
use proptest::prelude::*;
use proptest::sample::select;
use tilewright_hdl::Radix;
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
    (vec(input(), 0..5), names_clocks(), vec(step(), 1..most_steps)).prop_map(|(inputs, names_clocks, steps)| Part {
        inputs,
        names_clocks,
        steps,
    })
}

fn input() -> impl Strategy<Value = Input> {
    let link = (pick(), any::<bool>()).prop_map(|(of, registered)| Link { of, registered });
    (form(), clock(), weighted(0.4, link)).prop_map(|(form, clock, link)| Input { form, clock, link })
}

/// Numbers most often.
fn meaning() -> impl Strategy<Value = Meaning> {
    prop_oneof![5 => Just(Meaning::Number), 2 => Just(Meaning::Signed), 1 => Just(Meaning::Code)]
}

fn form() -> impl Strategy<Value = Form> {
    (width(), meaning()).prop_map(|(width, meaning)| Form { width, meaning })
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
    on_a_clock(make.boxed())
}

/// A step on some clock, which makes one of these.
fn on_a_clock(make: BoxedStrategy<Make>) -> impl Strategy<Value = Step> {
    // One in ten is enabled, and one in ten names another clock.
    (clock(), weighted(0.1, pick()), weighted(0.1, Just(())), make).prop_map(|(clock, enabled, renamed, make)| Step {
        clock,
        enabled,
        renamed: renamed.is_some(),
        make,
    })
}

/// Whether a part calls its clocks by names of its own.
fn names_clocks() -> impl Strategy<Value = bool> {
    weighted(0.2, Just(())).prop_map(|names| names.is_some())
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
        1 => (pick(), 0..6u32, 0..70u32, any::<bool>())
            .prop_map(|(of, size, by, right)| Make::Rotate { of, size, by, right }),
        2 => with_number().prop_map(Make::WithNumber),
        1 => (pick(), vec((binary(), pick()), 1..4)).prop_map(|(of, with)| Make::Assigned(of, with)),
        1 => picks().prop_map(Make::Implies),
        1 => (control(), prop_oneof![3 => 0..8u64, 1 => any::<u64>()]).prop_map(|(of, value)| Make::Is(of, value)),
    ]
}

fn with_number() -> impl Strategy<Value = WithNumber> {
    let op = prop_oneof![
        3 => binary().prop_map(NumberOp::Binary),
        1 => Just(NumberOp::Product),
        2 => relation().prop_map(NumberOp::Compare),
    ];
    let number = prop_oneof![3 => 0..8u64, 2 => any::<u64>()];
    let radix = select(vec![Radix::Any, Radix::Hex, Radix::Binary]);
    (op, pick(), any::<bool>(), number, radix, any::<bool>())
        .prop_map(|(op, of, signed, number, radix, on_left)| WithNumber { op, of, signed, number, radix, on_left })
}

fn choice() -> impl Strategy<Value = Make> {
    let key = prop_oneof![3 => 0..8u64, 1 => any::<u64>()];
    let arm = || prop_oneof![3 => pick().prop_map(Arm::Value), 1 => pattern().prop_map(Arm::Number)];
    prop_oneof![
        2 => (meaning(), control(), pick(), arm())
            .prop_map(|(meaning, select, on_true, on_false)| Make::Mux { meaning, select, on_true, on_false }),
        1 => (meaning(), vec((control(), arm()), 1..4), pick())
            .prop_map(|(meaning, arms, default)| Make::Select { meaning, arms, default }),
        1 => (meaning(), control(), pick(), vec((key, arm()), 1..5))
            .prop_map(|(meaning, subject, default, arms)| Make::Case { meaning, subject, arms, default }),
        1 => alu(),
        1 => lookup(),
    ]
}

/// Few operations, or as many as an opcode has values.
fn alu() -> impl Strategy<Value = Make> {
    let arm = || (binary(), picks()).prop_map(|(op, operands)| Operation { op, operands });
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
        3 => (meaning(), pick()).prop_map(|(meaning, of)| Make::Wire(meaning, of)),
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
        1 => Just(Statement::Displayed),
    ]
}
