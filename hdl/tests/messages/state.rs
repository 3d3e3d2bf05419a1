//! Registers, wires and memories.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn registers_and_wires_that_nothing_drives() {
    expect(
        |m, _| {
            let _lonely = m.reg("lonely", 3).reset(0);
            *m.wire("open", 2)
        },
        "register `lonely` of `Case` is never driven [T301]
         --> [let _lonely = m.reg(\"lonely\", 3).reset(0);]
         help: give its next value with `.next(value)`, or with `.when(condition, value)`

         wire `open` of `Case` is never driven [T301]
         --> [*m.wire(\"open\", 2)]
         help: drive it with `.drive(value)`

         2 problems in this description",
    );
}

#[test]
fn registers_and_wires_that_are_driven_twice() {
    expect(
        |m, i| {
            let r = m.reg("r", 8);
            r.next(i.a);
            r.next(0);
            *r
        },
        "`r` is given a next value twice [T302]
         --> [r.next(0);]
         the first time is at [r.next(i.a);]
         `r` is declared at [let r = m.reg(\"r\", 8);]
         help: describe all its updates in one chain: `.when(condition, value).when(..)`, or with `mux` or `select`",
    );
    expect(
        |m, i| {
            let r = m.reg("r", 8);
            r.when(i.c, i.a).when(!i.c, 0);
            r.when(i.b.bit(0), 7);
            *r
        },
        "`r` is given a next value twice [T302]
         --> [r.when(i.b.bit(0), 7);]
         the first time is at [r.when(i.c, i.a).when(!i.c, 0);]
         `r` is declared at [let r = m.reg(\"r\", 8);]
         help: describe all its updates in one chain: `.when(condition, value).when(..)`, or with `mux` or `select`",
    );
    let enabled = |m: Module, i: In| {
        let r = m.reg("r", 8).enable(i.c).enable(!i.c);
        r.next(i.a);
        *r
    };
    assert!(problems(&Case(enabled)).starts_with("`r` is enabled twice [T302]"));
    let driven = |m: Module, i: In| {
        let w = m.wire("w", 8);
        w.drive(i.a);
        w.drive(i.a);
        *w
    };
    assert!(problems(&Case(driven)).starts_with("`w` is driven twice"));
}

#[test]
fn what_a_chain_takes_fits_its_register() {
    expect(
        |m, i| {
            let r = m.reg("r", 8);
            r.when(i.c, 0).when(i.a, r + 1).when(!i.c, 256);
            *r
        },
        "the condition of `when` is 1 bit, but `a` has 8 bits [T106]
         --> [r.when(i.c, 0).when(i.a, r + 1).when(!i.c, 256);]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`

         `256` does not fit in 8 bits, unsigned [T102]
         --> [r.when(i.c, 0).when(i.a, r + 1).when(!i.c, 256);]
         help: an integer takes the width of the signal it meets

         2 problems in this description",
    );
}

#[test]
fn transitions_have_conditions() {
    expect(
        |m, i| {
            let lamp = m.fsm("lamp", Lamp::Off);
            lamp.next(|state| match state {
                Lamp::Off => when(i.a, Lamp::On),
                Lamp::On => when(i.c, Lamp::Off).or_when(i.b, Lamp::On),
            });
            (*lamp).bits().zext(8)
        },
        "the condition of `when` is 1 bit, but `a` has 8 bits [T106]
         --> [Lamp::Off => when(i.a, Lamp::On),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`

         the condition of `or_when` is 1 bit, but `b` has 7 bits [T106]
         --> [Lamp::On => when(i.c, Lamp::Off).or_when(i.b, Lamp::On),]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`

         2 problems in this description",
    );
}

#[test]
fn a_chain_ends_once() {
    expect(
        |m, i| {
            let r = m.reg("r", 8);
            let updates = r.when(i.c, 0);
            updates.otherwise(r + 1);
            updates.otherwise(i.a);
            let _ = updates.when(!i.c, 2);
            *r
        },
        "the chain of `r` continues after its end, `.otherwise(r + 1)` [T304]
         --> [updates.otherwise(i.a);]
         help: `.otherwise(value)` comes once, after all conditions

         the chain of `r` continues after its end, `.otherwise(r + 1)` [T304]
         --> [let _ = updates.when(!i.c, 2);]
         help: `.otherwise(value)` comes once, after all conditions

         2 problems in this description",
    );
}

#[test]
fn contents_are_given_once() {
    expect(
        |m, _| {
            let words = m.memory("words", 4, 8, ReadUnderWrite::Old).fill(1);
            words.words([1, 2]).read_async(0)
        },
        "memory `words` is given contents twice [T303]
         --> [words.words([1, 2]).read_async(0)]
         help: give them once: by `.fill(..)` or by `.words(..)`",
    );
}

#[test]
fn handles_give_their_values_as_signals() {
    let build = |m: Module, i: In| {
        let (register, wire, lamp) = (m.reg("r", 8), m.wire("w", 8), m.fsm("lamp", Lamp::Off));
        register.next(i.a);
        wire.drive(i.a);
        lamp.next(|lamp| match lamp {
            Lamp::Off => when(i.c, Lamp::On),
            Lamp::On => goto(Lamp::Off),
        });
        let values: [Signal; 3] = [*register, *wire, *lamp];
        concat(&values).trunc(8)
    };
    let design = elaborate(&Case(build)).unwrap();
    let node = |id: &ir::NodeId| &design.top().nodes[id.0 as usize];
    let parts = design
        .top()
        .nodes
        .iter()
        .find_map(|node| if let ir::Op::Concat(parts) = &node.op { Some(parts) } else { None });
    let names = parts.unwrap().iter().map(|part| (node(part).name.as_deref(), node(part).width));
    assert_eq!(names.collect::<Vec<_>>(), [(Some("r"), 8), (Some("w"), 8), (Some("lamp"), 1)]);
}

#[test]
fn reset_values_that_are_not_constants() {
    let build = |m: Module, i: In| {
        let r = m.reg("r", 8).reset(i.a);
        r.next(i.a);
        *r
    };
    expect(
        build,
        "the reset value of `r` is not a constant of 8 bits [T115]
         --> [let r = m.reg(\"r\", 8).reset(i.a);]
         help: the reset value is a number known while the block is built",
    );
}

#[test]
fn memories() {
    expect(
        |m, i| {
            let words = m.memory("words", 256, 8, ReadUnderWrite::Old);
            words.write(i.c, i.a, i.a);
            words.write(!i.c, i.a, 0);
            words.read(i.a)
        },
        "memory `words` gets a second write port [T305]
         --> [words.write(!i.c, i.a, 0);]
         `words` is declared at [let words = m.memory(\"words\", 256, 8, ReadUnderWrite::Old);]
         help: share one port with `mux`, or say `.true_dual_port()` if the target has such memories",
    );
    let long = |m: Module, i: In| {
        m.memory("words", 2, 8, ReadUnderWrite::Old)
            .words([Bits::new(8, 1), Bits::new(8, 2), Bits::new(8, 3)])
            .read(i.c)
    };
    assert!(problems(&Case(long)).starts_with("memory `words` has 2 words, but its contents have 3 [T306]"));
    let wide = |m: Module, i: In| m.memory("words", 2, 8, ReadUnderWrite::Old).fill(Bits::new(9, 1)).read(i.c);
    assert!(problems(&Case(wide)).starts_with("`9'h001` does not fit in the 8 bits of the contents of memory `words`"));
    expect(
        |m, i| m.rom("program", bits(4), [3, -1, 16]).read(i.b.trunc(2)),
        "`-1` does not fit in the 4 bits of word 1 of memory `program` [T102]
         --> [|m, i| m.rom(\"program\", bits(4), [3, -1, 16]).read(i.b.trunc(2)),]
         help: a number takes the width and the sign of the declaration

         `16` does not fit in the 4 bits of word 2 of memory `program` [T102]
         --> [|m, i| m.rom(\"program\", bits(4), [3, -1, 16]).read(i.b.trunc(2)),]
         help: a number takes the width and the sign of the declaration

         2 problems in this description",
    );
    let empty = |m: Module, i: In| m.memory("words", 0, 8, ReadUnderWrite::Old).read(i.c);
    assert!(problems(&Case(empty)).starts_with("memory `words` of 0 words of 8 bits holds nothing [T307]"));
}

#[test]
fn widths_that_do_not_fit_a_memory() {
    expect(
        |m, i| m.memory("words", 100, 8, ReadUnderWrite::Old).read(i.a),
        "an address of memory `words` has 7 bits, but `a` has 8 bits [T309]
         --> [|m, i| m.memory(\"words\", 100, 8, ReadUnderWrite::Old).read(i.a),]
         `words` is declared at [|m, i| m.memory(\"words\", 100, 8, ReadUnderWrite::Old).read(i.a),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: cut it with `.trunc(7)`",
    );
    expect(
        |m, i| {
            let words = m.memory("words", 256, 8, ReadUnderWrite::Old);
            words.write(i.c, i.a, i.b);
            words.read_async(i.a)
        },
        "a word of memory `words` has 8 bits, but `b` has 7 bits [T309]
         --> [words.write(i.c, i.a, i.b);]
         `words` is declared at [let words = m.memory(\"words\", 256, 8, ReadUnderWrite::Old);]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: widen it with `.zext(8)` or `.sext(8)`",
    );
}
