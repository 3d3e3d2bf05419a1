//! Rows and grids where they do not fit.

use crate::messages::common::*;
use tilewright_hdl::*;

fn lanes(m: Module, name: &str, shape: Shape) -> Signal {
    let register = m.reg(name, bits(8).of(shape));
    register.next(0);
    *register
}

#[test]
fn lanes_that_do_not_meet() {
    expect(
        |m, _| {
            let (three, four) = (lanes(m, "three", row(3)), lanes(m, "four", row(4)));
            (three + four).sum()
        },
        "`+` needs equal shapes: `three` has 3 lanes, `four` has 4 lanes [T601]
         --> [(three + four).sum()]
         `three` is made at [let register = m.reg(name, bits(8).of(shape));]
         `four` is made at [let register = m.reg(name, bits(8).of(shape));]
         help: both sides need equal numbers of lanes, laid out the same way",
    );
    expect(
        |m, _| {
            let (square, line) = (lanes(m, "square", grid(3, 3)), lanes(m, "line", row(3)));
            mux(line.eq(2), square, 0).or_all()
        },
        "`mux` needs equal shapes: `line.eq(2)` has 3 lanes, `square` has 3 x 3 lanes [T601]
         --> [mux(line.eq(2), square, 0).or_all()]
         `line.eq(2)` is made at [mux(line.eq(2), square, 0).or_all()]
         `square` is made at [let register = m.reg(name, bits(8).of(shape));]
         help: a row becomes a grid by `.to_rows(n)`, which repeats it as n rows, or by `.to_columns(n)`",
    );
}

/// Contains a long row.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Long;

impl Block for Long {
    type In = Link;
    type Out = Out;

    fn inputs(&self) -> Link<Width> {
        Link { x: bits(8) }
    }

    fn build(&self, m: Module, i: Link) -> Out {
        Out { out: m.pipe("row", i.x.of(1 << 20)).or_all() }
    }
}

#[test]
fn what_is_too_large_is_the_place() {
    expect(
        |m, i| {
            let x = m.reg("x", bits(8).of(grid(1 << 13, 1 << 12)));
            x.next(0);
            x.rows().or_all().or_all() ^ i.a
        },
        "register `x` has 8192 x 4096 lanes, more than 16777216 [T609]
         --> [let x = m.reg(\"x\", bits(8).of(grid(1 << 13, 1 << 12)));]
         help: make it smaller, or keep large data in a memory",
    );
    expect(
        |m, i| {
            let all = m.array("u_all", 32, &Long, |_| Link { x: i.a });
            all.out.or_all() ^ i.a
        },
        "`case_block` has too many lanes: 33554432, more than 16777216 [T903]
         --> [let all = m.array(\"u_all\", 32, &Long, |_| Link { x: i.a });]
         help: make it smaller: fewer lanes, fewer instances in arrays, or fewer words",
    );
    expect(
        |m, i| {
            let words = m.memory("words", u32::MAX, 128, ReadUnderWrite::Old);
            words.read(i.a.zext(32)).trunc(8)
        },
        "`case_block` has a memory of too many 64-bit words in all lanes: 8589934590, more than 4294967296 [T903]
         --> [let words = m.memory(\"words\", u32::MAX, 128, ReadUnderWrite::Old);]
         help: make it smaller: fewer lanes, fewer instances in arrays, or fewer words",
    );
}

#[test]
fn what_has_no_lanes_is_given_some() {
    expect(
        |m, i| {
            let line = lanes(m, "line", row(3));
            let total = m.reg("total", 8);
            total.next(line);
            *total ^ i.a
        },
        "`next` needs equal shapes: `total` has no lanes, `line` has 3 lanes [T601]
         --> [total.next(line);]
         `total` is made at [let total = m.reg(\"total\", 8);]
         `line` is made at [let register = m.reg(name, bits(8).of(shape));]
         help: only a plain signal is repeated in every lane by itself; take a lane, or combine all lanes with `.or_all()` and its like",
    );
}

#[test]
fn what_is_asked_of_another_shape() {
    let cases: [(&str, Build); 13] = [
        ("`.previous` needs a row, but `a` has no lanes [T602]", |_, i| i.a.previous(0)),
        ("`.last` needs a row, but `square` has 2 x 3 lanes", |m, _| lanes(m, "square", grid(2, 3)).last()),
        ("`.columns()` needs a grid, but `line` has 3 lanes [T602]", |m, _| {
            lanes(m, "line", row(3)).columns().sum().sum()
        }),
        ("`.to_rows` needs a row, but `a` has no lanes", |_, i| i.a.to_rows(2).sum()),
        ("`line` has 3 lanes, and only a plain signal can be that of 3 x 3 lanes [T601]", |m, _| {
            lanes(m, "line", row(3)).of(grid(3, 3)).sum()
        }),
        ("lane 3 of a signal of 3 lanes [T603]", |m, _| lanes(m, "line", row(3)).lane(3)),
        ("lane 3 of `.take` would be lane 3 of a signal of 3 lanes [T603]", |m, _| {
            lanes(m, "line", row(3)).take(4, |i| i).sum()
        }),
        ("the rule of `.take` is one that a row of wires cannot follow [T611]", |m, _| {
            lanes(m, "line", row(3)).take(3, |i| i / 2 * 2).sum()
        }),
        ("the index of `.pick`, `which`, has 2 lanes, but a lane of `line` has no lanes [T612]", |m, _| {
            lanes(m, "line", row(3)).pick(lanes(m, "which", row(2)))
        }),
        ("the edge of `.shifted`, `line`, has 3 lanes, but a column of `square` has 2 lanes", |m, _| {
            let square = lanes(m, "square", grid(2, 3));
            square.columns().previous(lanes(m, "line", row(3))).sum()
        }),
        ("`.unpack` cannot cut `a`, of 8 bits and no lanes, into 3 lanes [T610]", |_, i| i.a.unpack(row(3)).sum()),
        ("a stack of grids, of 2 x 2 lanes each, would have three axes [T607]", |_, i| {
            stack([i.a.of(grid(2, 2))]).sum()
        }),
        ("a tree needs rows with equal numbers of lanes, but `a` has no lanes [T602]", |_, i| {
            tree(i.a, |a: Signal, b| a + b)
        }),
    ];
    for (start, build) in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with(start), "{text}");
    }
}

#[test]
fn what_does_not_stack() {
    expect(
        |_, i| stack([i.a.of(3), i.a.of(4)]).sum(),
        "`stack` needs equal shapes: `a.of(..)` has 3 lanes, `a.of(..)` has 4 lanes [T601]
         --> [|_, i| stack([i.a.of(3), i.a.of(4)]).sum(),]
         `a.of(..)` is made at [|_, i| stack([i.a.of(3), i.a.of(4)]).sum(),]
         `a.of(..)` is made at [|_, i| stack([i.a.of(3), i.a.of(4)]).sum(),]
         help: both sides need equal numbers of lanes, laid out the same way",
    );
    expect(
        |_, i| stack([i.a, i.b]).sum(),
        "the lanes of a stack have different widths: lane 0 has 8 bits, lane 1 7 bits [T606]
         --> [|_, i| stack([i.a, i.b]).sum(),]
         help: make the change of width explicit, lane by lane",
    );
}

/// The stand-in has the same kind: the one mistake is the one message.
#[test]
fn a_signed_lane_that_there_is_not() {
    expect(
        |m, i| (m.pipe("line", i.a.signed().of(3)).lane(3) + i.a.signed()).bits(),
        "lane 3 of a signal of 3 lanes [T603]
         --> [|m, i| (m.pipe(\"line\", i.a.signed().of(3)).lane(3) + i.a.signed()).bits(),]
         help: lanes count from 0",
    );
}

#[test]
fn what_is_declared_without_lanes() {
    let cases: [(&str, Build); 6] = [
        ("register `r` has no lanes", |m, _| lanes(m, "r", row(0)).sum()),
        ("wire `w` has no lanes", |m, _| {
            let wire = m.wire("w", bits(8).of(grid(2, 0)));
            wire.drive(0);
            wire.sum()
        }),
        ("memory `words` has no lanes", |m, i| {
            m.memory("words", 4, bits(8).of(row(0)), ReadUnderWrite::Old).read(i.a.trunc(2)).sum()
        }),
        ("a list of constants has no lanes [T608]", |_, _| constants(bits(8).of(row(0)), u64::from).sum()),
        ("an address of memory `words`, of 2 lanes, has 3 lanes: `0`", |m, i| {
            let words = m.memory("words", 4, bits(8).of(row(2)), ReadUnderWrite::Old);
            words.write(i.c, lit(2, 0).of(row(3)), i.a);
            words.read(0).sum()
        }),
        ("`r` has 3 lanes, but 2 reset values [T605]", |m, _| {
            let register = m.reg("r", bits(8).of(row(3))).reset_each([1, 2]);
            register.next(0);
            register.sum()
        }),
    ];
    for (start, build) in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with(start), "{text}");
    }
}
