//! The remedies in messages; other tests check the problems.

use crate::messages::common::*;
use tilewright_hdl::*;

codes! { enum Operation { Add, Subtract, And } }

bundle! { struct Entry<T> { resident: T, page: T } }

fn operation(m: Module) -> Signal {
    let operation = m.reg("operation", one_of::<Operation>()).reset(Operation::And);
    operation.next(*operation);
    *operation
}

/// A row of a new register.
fn line(m: Module, lanes: u32) -> Signal {
    let line = m.reg("line", bits(8).of(lanes));
    line.next(0);
    *line
}

/// Each is the one problem of its description, at the user's line.
#[track_caller]
fn each_says(cases: &[(&str, &str, Build)]) {
    for (message, remedy, build) in cases {
        let text = problems(&Case(*build));
        let (first, rest) = text.split_once("\n  --> ").expect("a message has a place");
        assert!(first.starts_with(message) && rest.starts_with('['), "{text}");
        assert!(rest.ends_with(&format!("  help: {remedy}")), "{text}");
    }
}

#[test]
fn of_choices_and_codes() {
    let reads_bits = "`.code::<Enum>()` reads bits as a code of an enum";
    each_says(&[
        (
            "the key 2 of `case` does not fit in 1 bit [T208]",
            "each key is a value of the subject and occurs once",
            |_, i| case(i.c, [(2, i.a)], 0),
        ),
        ("the key 2 of `case` occurs twice [T209]", "each key is a value of the subject and occurs once", |_, i| {
            case(i.a, [(2, i.a), (2, i.a)], 0)
        }),
        ("`is_code` needs a code, but `a` is a number [T206]", reads_bits, |_, i| i.a.is_code().zext(8)),
        ("`choose` needs a code of `Operation`, but `a.slice(0..2)` is a number", reads_bits, |_, i| {
            i.a.trunc(2).choose(|operation: Operation| if operation == Operation::Add { lit(8, 1) } else { lit(8, 0) })
        }),
        (
            "a `Operation` has 2 bits, but `a` has 8 bits [T205]",
            "take the bits of the code, as in `.part(low, width)`",
            |_, i| i.a.code::<Operation>().bits(),
        ),
        (
            "`+` computes with `operation`, a code of `Operation` [T204]",
            "a code is compared, by `.is(..)` and `.eq(..)`, and chosen by; `.bits()` reads it as a number",
            |m, _| operation(m) + 1,
        ),
        (
            "`-` makes a negative number, but `a` is not signed [T202]",
            "`.signed()` reads it in two's complement",
            |_, i| -i.a,
        ),
    ]);
}

#[test]
fn of_registers_and_memories() {
    each_says(&[
        (
            "memory `words` has 2 words, but its contents have 3 [T306]",
            "give at most as many words as the memory has",
            |m, i| m.memory("words", 2, 8, ReadUnderWrite::Old).words([1, 2, 3]).read(i.c),
        ),
        ("memory `words` of 0 words of 8 bits holds nothing [T307]", "depth and width are at least 1", |m, i| {
            m.memory("words", 0, 8, ReadUnderWrite::Old).read(i.c)
        }),
        (
            "memory `words` has 4294967296 words, more than 4294967295 [T308]",
            "use wider words, or several memories",
            |m, i| m.memory("words", 1u64 << 32, 8, ReadUnderWrite::Old).read(i.a.zext(32)),
        ),
        (
            "memory `entries` stores records, whose field `resident` has no lanes, but `page` 4 lanes [T613]",
            "each lane of a memory has whole records: all fields have its lanes",
            |m, i| {
                let entry = Entry { resident: bit(), page: bits(8).of(4) };
                m.memory("entries", 2, entry, ReadUnderWrite::Old).read(i.c).resident
            },
        ),
        (
            "`3` is not a code of `Operation`, the enum of the contents of memory `program` [T207]",
            "name one of its codes",
            |m, i| m.memory("program", 2, one_of::<Operation>(), ReadUnderWrite::Old).fill(3).read(i.c).bits(),
        ),
        (
            "an address of memory `words`, of 2 lanes, has 3 lanes: `line.bit(0)` [T612]",
            "it is plain, one for all lanes, or has the memory's lanes",
            |m, _| {
                let words = m.memory("words", 2, bits(8).of(2), ReadUnderWrite::Old);
                words.read_async(line(m, 3).trunc(1)).sum()
            },
        ),
        ("`r` has 3 lanes, but 2 reset values [T605]", "`.reset(value)` gives all lanes the same value", |m, _| {
            let register = m.reg("r", bits(8).of(3)).reset_each([1, 2]);
            register.next(0);
            register.sum()
        }),
        (
            "`no name` cannot be the name of an attribute [T403]",
            "a name consists of letters, digits and `_`, and is not a reserved word of Verilog",
            |m, i| {
                let r = m.reg("r", 8).attribute("no name", "1");
                r.next(i.a);
                *r
            },
        ),
        (
            "`1st` cannot be the name of a net",
            "a name consists of letters, digits and `_`, and does not start with a digit",
            |m, i| m.pipe("1st", i.a),
        ),
    ]);
}

#[test]
fn of_lanes() {
    let two_axes = "shapes have two at most: rows and columns";
    each_says(&[
        (
            "a tree needs rows with equal numbers of lanes, but `a` has no lanes [T602]",
            "a grid is combined by `.rows()` and `.columns()`, one after the other, and their `sum()`, `minimum()` and so on",
            |_, i| tree(i.a, |a: Signal, b| a + b),
        ),
        ("a stack of grids, of 2 x 2 lanes each, would have three axes [T607]", two_axes, |_, i| {
            stack([i.a.of(grid(2, 2))]).sum()
        }),
        (
            "`.unpack` cannot cut `a`, of 8 bits and no lanes, into 3 lanes [T610]",
            "it cuts a plain word into lanes of equal widths",
            |_, i| i.a.unpack(row(3)).sum(),
        ),
        ("a list of constants has no lanes [T608]", "a row, and a side of a grid, is at least 1", |_, _| {
            constants(bits(8).of(row(0)), |lane| lane).sum()
        }),
        (
            "`.to_rows` needs a row, but `a` has no lanes",
            "a plain signal goes into a grid by `.of(grid(rows, columns))`",
            |_, i| i.a.to_rows(2).sum(),
        ),
        (
            "the edge of `.shifted`, `line`, has 3 lanes, but a column of `a.of(..).of(..)` has 2 lanes",
            "it is plain, or as one column is",
            |m, i| i.a.of(grid(2, 3)).columns().previous(line(m, 3)).sum(),
        ),
        (
            "port `x` of `u_cell`, of 3 lanes, would have three axes in an array of 2 x 2 lanes [T607]",
            "shapes have two axes at most: rows and columns",
            |m, i| m.array("u_cell", grid(2, 2), &Shaped, |_| Link { x: i.a }).out.sum(),
        ),
    ]);
}

/// Inverts three lanes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Shaped;

impl Block for Shaped {
    type In = Link;
    type Out = Out;

    fn inputs(&self) -> Link<Width> {
        Link { x: bits(8).of(3) }
    }

    fn build(&self, _: Module, i: Link) -> Out {
        Out { out: !i.x.sum() }
    }
}

#[test]
fn of_more_lanes_than_are_looked_through() {
    each_says(&[(
        "`w` of `Case` is on a path that comes back to it, of 83886080 lanes: more than 67108864 are not looked through for a combinational loop [T311]",
        "put a register into the path, or make the array smaller",
        |m, i| {
            let w = m.wire("w", bit().of(1 << 24));
            w.drive(!!(!w.previous(0)));
            w.or_all() & i.c
        },
    )]);
}

/// The stand-in for a bad slice is a zero that nobody wrote, and about which nothing is reported.
#[test]
fn of_a_bad_slice_that_is_used_further() {
    let cases: [Build; 6] = [
        |_, i| i.a.slice(4..9) + i.b,
        |_, i| mux(i.c, i.a.slice(4..9), i.a),
        |_, i| i.a.slice(4..9).trunc(6).eq(i.b.slice(0..5)),
        |_, i| cat![i.a.slice(4..9), i.c].slice(0..6),
        |m, i| m.memory("words", 256, 8, ReadUnderWrite::Old).read(i.a.slice(4..9)),
        |m, i| m.instance("u_inverter", &Inverter { registered: true }, Link { x: i.a.slice(4..9) }).out,
    ];
    for build in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with("the slice 4..9 is outside of `a`, which has 8 bits [T103]\n"), "{text}");
        assert!(text.ends_with("  help: a slice is `low..high` with low < high <= 8"), "{text}");
        assert!(!text.contains("`0`"), "{text}");
    }
}
