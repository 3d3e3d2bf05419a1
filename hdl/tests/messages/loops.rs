//! Combinational loops.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn combinational_loops_name_every_hop() {
    expect(
        |m, i| {
            let w = m.wire("w", 8);
            let once = (*w + i.a).named("once");
            w.drive(once ^ 1);
            once
        },
        "a combinational loop in `Case`: `w` -> `once` -> `once ^ 1` -> `w` [T310]
         --> [let w = m.wire(\"w\", 8);]
         `w` is computed at [let w = m.wire(\"w\", 8);]
         `once` is computed at [let once = (*w + i.a).named(\"once\");]
         `once ^ 1` is computed at [w.drive(once ^ 1);]
         help: put a register into the loop, or break it where a value does not depend on the others",
    );
}

#[test]
fn loops_through_instances_are_found_and_registers_break_them() {
    let text = problems(&Case(|m, _| {
        let w = m.wire("w", 8);
        let back = m.instance("u_inverter", &Inverter { registered: false }, Link { x: *w }).out;
        w.drive(back);
        back
    }));
    assert!(text.starts_with("a combinational loop in `Case`: `w` -> `u_inverter.out` -> `w`"), "{text}");
    elaborate(&Case(|m, _| {
        let w = m.wire("w", 8);
        w.drive(m.instance("u_inverter", &Inverter { registered: true }, Link { x: *w }).out);
        *w
    }))
    .expect("a register breaks the loop");
}

#[test]
fn a_chain_of_lanes_is_no_loop_but_a_ring_is() {
    let chain = |m: Module, i: In| {
        m.array("u_cell", 4, &Inverter { registered: false }, |cells| Link { x: cells.out.previous(i.a) }).out.last()
    };
    elaborate(&Case(chain)).expect("lane 0 starts the chain");
    let text = problems(&Case(|m, _| {
        let w = m.wire("w", 8);
        let cells = m.array("u_cell", 3, &Inverter { registered: false }, |cells| Link { x: cells.out.previous(*w) });
        w.drive(cells.out.last());
        *w
    }));
    assert!(text.starts_with("a combinational loop in `Case`: "), "{text}");
    for lane in ["`u_cell.out[0]`", "`u_cell.out[1]`", "`u_cell.out[2]`", "`w`"] {
        assert!(text.lines().next().unwrap().contains(lane), "{lane} is missing in {text}");
    }
}
