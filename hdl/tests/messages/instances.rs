//! What feeds instances and arrays.

use crate::common::*;
use tilewright_hdl::*;

#[test]
fn instances_fed_with_another_width() {
    expect(
        |m, i| m.instance("u_inverter", &Inverter { registered: true }, Link { x: i.b }).out,
        "input `x` of `u_inverter` has 8 bits, but `b` has 7 bits
         --> [|m, i| m.instance(\"u_inverter\", &Inverter { registered: true }, Link { x: i.b }).out,]
         `x` is declared at [Link { x: bits(8) }]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: spell the change of width where the instance is fed",
    );
}

#[test]
fn arrays_fed_with_the_wrong_number_of_lanes() {
    expect(
        |m, i| {
            let cells = m.array("u_cell", 3, &Inverter { registered: true }, |cells| Link { x: cells.each([i.a, i.a]) });
            cells.out.lane(3)
        },
        "an array of 3 lanes is fed 2 signals
         --> [let cells = m.array(\"u_cell\", 3, &Inverter { registered: true }, |cells| Link { x: cells.each([i.a, i.a]) });]
         help: give one signal for each lane, all of one width

         lane 3 of an array of 3 lanes
         --> [cells.out.lane(3)]
         help: lanes count from 0

         2 problems in this description",
    );
    let empty = |m: Module, i: In| {
        m.array("u_cell", 0, &Inverter { registered: true }, |cells| Link { x: cells.all(&i.a) }).out.lane(0)
    };
    assert!(problems(&Case(empty)).starts_with("the array `u_cell` has no lanes"));
}

#[test]
#[should_panic(expected = "an array is fed nothing")]
fn arrays_fed_with_nothing() {
    let _ = elaborate(&Case(|m, _| {
        let feed = |cells: Array<_>| Link { x: cells.each(Vec::<Signal>::new()) };
        m.array::<Inverter>("u_cell", 2, &Inverter { registered: true }, feed).out.last()
    }));
}
