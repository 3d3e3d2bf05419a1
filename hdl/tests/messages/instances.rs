//! The inputs of instances and arrays.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn instances_fed_with_another_width() {
    expect(
        |m, i| m.instance("u_inverter", &Inverter { registered: true }, Link { x: i.b }).out,
        "input `x` of `u_inverter` has 8 bits, but `b` has 7 bits [T503]
         --> [|m, i| m.instance(\"u_inverter\", &Inverter { registered: true }, Link { x: i.b }).out,]
         `x` is declared at [Link { x: bits(8) }]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: make the change of width explicit where the instance is fed",
    );
}

#[test]
fn arrays_fed_with_the_wrong_number_of_lanes() {
    expect(
        |m, i| {
            let cells = m.array("u_cell", 3, &Inverter { registered: true }, |_| Link { x: stack([i.a, i.a]) });
            cells.out.lane(3)
        },
        "input `x` of `u_cell` has 3 lanes, but `stack(..)` has 2 lanes [T503]
         --> [let cells = m.array(\"u_cell\", 3, &Inverter { registered: true }, |_| Link { x: stack([i.a, i.a]) });]
         `x` is declared at [Link { x: bits(8) }]
         `stack(..)` is made at [let cells = m.array(\"u_cell\", 3, &Inverter { registered: true }, |_| Link { x: stack([i.a, i.a]) });]
         help: feed a plain signal, the same for all lanes, or one lane for each; `stack` makes a row of signals

         lane 3 of a signal of 3 lanes [T603]
         --> [cells.out.lane(3)]
         help: lanes count from 0

         2 problems in this description",
    );
    let empty =
        |m: Module, i: In| m.array("u_cell", 0, &Inverter { registered: true }, |_| Link { x: i.a }).out.lane(0);
    assert!(problems(&Case(empty)).starts_with("the array `u_cell` has no lanes [T608]"));
}

#[test]
fn a_stack_of_nothing() {
    expect(
        |_, _| stack(Vec::<Signal>::new()).last(),
        "a stack of nothing [T604]
         --> [|_, _| stack(Vec::<Signal>::new()).last(),]
         help: give a value for each lane",
    );
}

#[test]
fn nothing_that_is_interleaved() {
    expect(
        |_, _| interleave(Vec::<Signal>::new()).last(),
        "nothing is interleaved [T604]
         --> [|_, _| interleave(Vec::<Signal>::new()).last(),]
         help: give it at least one row",
    );
}
