//! Numbers of any size: each is accepted, or is a problem with its line.

use crate::messages::common::*;
use tilewright_hdl::*;

const NUMBERS: [i128; 12] = [
    i128::MIN,
    -(1 << 40),
    -1,
    0,
    1,
    8,
    1 << 17,
    (1 << 31) - 1,
    u32::MAX as i128,
    1 << 40,
    u64::MAX as i128,
    i128::MAX,
];

bundle! {
    struct Word<T> { x: T }
    struct Pair<T> { x: T, y: T }
}

type Describe = fn(Module, Signal, i128) -> Signal;

/// 8 bits in and any output, described by a function of a number.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct Sized(Describe, i128);

impl std::fmt::Debug for Sized {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Sized({})", self.1)
    }
}

impl Block for Sized {
    type In = Word;
    type Out = Word;

    fn inputs(&self) -> Word<Width> {
        Word { x: bits(8) }
    }

    fn build(&self, m: Module, i: Word) -> Word {
        m.ignore(&i);
        Word { x: (self.0)(m, i.x, self.1) }
    }

    fn name(&self) -> String {
        "sized".to_owned()
    }
}

/// Has ports of this size.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Ported(i128, bool);

impl Block for Ported {
    type In = Word;
    type Out = Word;

    fn inputs(&self) -> Word<Width> {
        Word { x: if self.1 { bits(4).of(row(self.0)) } else { bits(self.0) } }
    }

    fn build(&self, m: Module, i: Word) -> Word {
        Word { x: m.pipe("x_held", i.x) }
    }

    fn name(&self) -> String {
        "ported".to_owned()
    }
}

#[test]
fn numbers_of_any_size_are_taken_or_are_problems_with_a_line() {
    let describe: &[Describe] = &[
        |m, x, n| {
            let held = m.reg("held", bits(n)).reset(0);
            held.next(x);
            *held
        },
        |m, _, n| m.wire("made", below(n).of(2)).pack(),
        |m, _, n| m.wire("made", up_to(n)).signed(),
        |m, x, n| {
            let lanes = m.reg("lanes", bits(8).of(row(n))).reset(0);
            lanes.next(x);
            lanes.sum()
        },
        |m, x, n| m.pipe("lanes", x.of(grid(n, n))).rows().or_all().pack(),
        |m, x, n| {
            let table = m.memory("table", n, 8, ReadUnderWrite::Any).fill(3);
            table.write(x.bit(0), 0, x);
            table.read(0)
        },
        |m, x, n| {
            let table = m.memory("table", 4, n, ReadUnderWrite::Any).words([1]);
            table.write(x.bit(0), 0, x);
            table.read_async(0)
        },
        |m, x, n| {
            let widths = Pair { x: bits(n), y: bits(n) };
            let table = m.memory("table", 4, widths, ReadUnderWrite::Any).fill(0);
            table.write(x.bit(0), 0, Pair { x, y: x });
            table.read(0).y
        },
        |m, _, n| m.memory("table", 4, bits(8).of(n), ReadUnderWrite::Any).read_async(0).pack(),
        |m, _, n| m.array("u_ported", n, &Ported(8, false), |them| Word { x: them.x.previous(3) }).x.last(),
        |m, _, n| m.array("u_ported", n, &Ported(n, true), |them| Word { x: them.x }).x.rows().last().pack(),
        |m, x, n| m.instance("u_ported", &Ported(n, false), Word { x }).x,
        |m, x, n| m.instance("u_ported", &Ported(n, true), Word { x }).x.pack(),
        |m, x, n| m.stages(n.min(5000).max(n >> 60), None, Word { x }, |_, word: Word| Word { x: word.x + 1 }).x,
        |_, x, n| x.slice(n..n) ^ x.slice(0..n) ^ x.slice(n..8),
        |_, x, n| x.part(n, n) ^ x.part(0, n) ^ x.part(n, 1),
        |_, x, n| x.bit(n),
        |_, x, n| x.trunc(bits(n)),
        |_, x, n| x.zext(bits(n)),
        |_, x, n| x.signed().sext(bits(n)),
        |_, x, n| x.repeat(n),
        |_, x, n| x.rotate_left(n) ^ x.rotate_right(n),
        |_, x, n| (x << n) ^ (x >> n) ^ (x.signed() >> n).bits(),
        |_, x, n| x + n,
        |_, x, n| n - x,
        |_, x, n| x * n,
        |_, x, n| x.signed().times(lit(bits(8).signed(), n)),
        |_, x, n| x.add_carry(n),
        |_, x, n| x.eq(n) ^ x.signed().lt(n),
        |_, _, n| lit(bits(n), n),
        |_, _, n| lit(64, n),
        |_, _, n| lit(bits(64).signed(), n),
        |_, x, n| mux(x.bit(0), x, n),
        |_, x, n| case(x, [(n, x), (1, x)], n),
        |_, x, n| select([(x.bit(0), n)], x),
        |_, x, n| x.unpack(n).last(),
        |_, x, n| x.unpack(4).lane(n),
        |_, x, n| x.unpack(4).to_rows(n).rows().lane(0).pack(),
        |_, x, n| x.unpack(4).to_columns(n).columns().lane(0).pack(),
        |_, x, n| x.unpack(4).take(n, |i| i / 2).last(),
        |_, x, n| x.unpack(4).take(4, |i| i + n).last(),
        |_, x, n| x.unpack(4).take_or(4, |i| n - i * n, 0).last(),
        |_, x, n| x.unpack(4).take_or(4, |i| i / n - n, 0).last(),
        |_, _, n| constants(bits(8).of(row(n)), |lane| lane & 7).last(),
        |m, _, n| m.rom("table", bits(8), [n, 1]).read_async(0),
    ];
    let silent = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let mut panics = Vec::new();
    for (at, describe) in describe.iter().enumerate() {
        for number in NUMBERS {
            let ended = std::panic::catch_unwind(|| elaborate(&Sized(*describe, number)));
            match ended {
                Ok(Ok(_)) => {}
                Ok(Err(problems)) if problems.0.iter().all(|problem| problem.loc.file().ends_with("limits.rs")) => {}
                Ok(Err(problems)) => panics.push(format!("description {at} of {number}: {problems}")),
                Err(panic) => {
                    panics.push(format!("description {at} of {number}: {:?}", panic.downcast_ref::<String>()))
                }
            }
        }
    }
    std::panic::set_hook(silent);
    assert!(panics.is_empty(), "{}", panics.join("\n"));
}

#[test]
fn a_period_of_any_length_is_one_or_a_problem() {
    for period in [Period::ps(1 << 51), Period::ps(u64::MAX - 1), Period::ns(u64::MAX)] {
        let text = elaborate_at(&Inverter { registered: true }, period).unwrap_err().to_string();
        assert!(text.starts_with(&format!("the default clock has a period of {period}, more than ")), "{text}");
    }
    elaborate_at(&Inverter { registered: true }, Period::ps(1 << 50)).unwrap();
    expect(
        |m, _| *m.on(Clock::new("slow", Period::ns(u64::MAX))).reg("held", 8).when(lit(1, 1), 1),
        "clock `slow` has a period of 18446744073709551614 ps, more than 1125899906842624 ps [T806]
         --> [|m, _| *m.on(Clock::new(\"slow\", Period::ns(u64::MAX))).reg(\"held\", 8).when(lit(1, 1), 1),]
         help: a period is some nanoseconds, and 18 minutes at most",
    );
}

#[test]
fn pipelines_of_too_many_stages() {
    expect(
        |m, i| m.stages(1 << 17, None, Word { x: i.a }, |_, word| word).x,
        "a pipeline of 131072 stages has more than 65536 [T754]
         --> [|m, i| m.stages(1 << 17, None, Word { x: i.a }, |_, word| word).x,]
         help: a memory can delay by as many clocks as it has words",
    );
}

block! {
    /// Has a list of ports.
    struct Listed { ports: u32 }
    in(self) ListedIn { list: [bits(8); self.ports] }
    out ListedOut { first: bits(8) }
}

impl Listed {
    fn build(&self, m: Module, i: ListedIn) -> ListedOut {
        m.ignore(&i);
        ListedOut { first: i.list[0] }
    }
}

#[test]
fn lists_of_too_many_ports() {
    let text = problems(&Listed { ports: 70_000 });
    assert_eq!(
        text,
        "a list of 70000 ports, more than 65536 [T509]\n  --> [block! {]\n  help: lanes are one port: `bits(8).of(row(lanes))`"
    );
}

#[test]
#[should_panic(expected = "a list of 70000 ports, more than 65536 [T509], at hdl/tests/messages/limits.rs:")]
fn lists_of_too_many_ports_outside_of_a_description() {
    let _ = Listed { ports: 70_000 }.inputs();
}
