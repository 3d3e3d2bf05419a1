//! The names of a module's own lanes: `NAME[i]` in a row, `NAME[i][j]` in a grid.

use std::fs;

use tilewright_hdl::ir::*;
use tilewright_hdl::{Bits, Design};
use tilewright_sim::{Error, Simulation, Vcd};

use crate::circuits::build::Build;

/// A row of counters with different starts, a grid of their sums, a memory for each lane, and a condition on each.
fn machine() -> Design {
    let b = &mut Build::new("machine");
    let step = b.input("step", 8, Shape::Row(3));
    let starts = [5, 6, 7].map(|start| Bits::new(8, start)).to_vec();
    let count = b.register("count", 8, Shape::Row(3), Some(Init::Each(starts)));
    let next = b.add(count, step);
    b.next(count, None, next);
    let (rows, columns) = (b.broadcast(count, 1, 3), b.broadcast(count, 0, 3));
    let sums = b.add(rows, columns);
    let sums = b.named("sums", sums);
    b.output("total", sums);
    let memory = b.memory("words", 4, 8, Shape::Row(3));
    let (address, always) = (b.constant(2, 1, Shape::Plain), b.constant(1, 1, Shape::Plain));
    b.write(memory, always, address, count);
    let word = b.read(memory, false, address, None);
    b.output("word", word);
    let limit = b.constant(8, 99, Shape::Row(3));
    let below =
        b.node(Op::Compare { relation: Relation::Ne, signed: false, operands: [count, limit] }, 1, Shape::Row(3));
    b.assert(below, "no counter is at 99");
    Design::new(vec![b.module.clone()]).unwrap()
}

/// The values of the three inputs.
fn steps(lanes: [u64; 3]) -> Bits {
    Bits::new(24, lanes[0] | lanes[1] << 8 | lanes[2] << 16)
}

#[test]
fn lanes_are_peeked_and_poked_by_their_numbers() {
    let mut sim = Simulation::from_design(&machine()).unwrap();
    let step = sim.port("step").unwrap();
    sim.set(step, steps([1, 10, 20]));
    assert_eq!(sim.peek("count[2]").unwrap(), 7);
    sim.step();
    assert_eq!(["count[0]", "count[1]", "count[2]"].map(|lane| sim.peek(lane).unwrap().to_u64().unwrap()), [6, 16, 27]);
    assert_eq!(sim.peek("sums[1][2]").unwrap(), 16 + 27);
    assert_eq!(sim.peek_memory("words[1]", 1).unwrap(), 6);
    sim.poke_memory("words[1]", 1, 200).unwrap();
    let word = sim.port("word").unwrap();
    assert_eq!(sim.get_u64(word), 5 | 200 << 8 | 7 << 16);
    for name in ["count[3]", "count", "sums[0]", "sums[0][3]", "sums[00][1]"] {
        let error = sim.peek(name).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
    }
}

#[test]
fn a_waveform_has_each_lane() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("machine.vcd");
    let mut sim = Simulation::from_design(&machine()).unwrap();
    sim.trace(Vcd::to(&file)).unwrap();
    sim.run(2);
    sim.finish().unwrap();
    let text = fs::read_to_string(&file).unwrap();
    let names: Vec<&str> = text.lines().filter(|line| line.starts_with("$var")).collect();
    for (name, value) in
        [("count[0] [7:0]", "b101"), ("count[2] [7:0]", "b111"), ("sums[2][1] [7:0]", "b1101"), ("step[1] [7:0]", "b0")]
    {
        let found: Vec<&&str> = names.iter().filter(|line| line.contains(&format!(" {name} $end"))).collect();
        let [line] = found[..] else { panic!("{name}: {names:?}") };
        let id = line.split(' ').nth(3).unwrap();
        assert!(text.contains(&format!("\n{value} {id}\n")), "{name} is not {value}:\n{text}");
    }
}

#[test]
fn an_assertion_that_fails_in_a_lane_names_the_instance() {
    let mut sim = Simulation::from_design(&machine()).unwrap();
    let step = sim.port("step").unwrap();
    sim.set(step, steps([0, 0, 92]));
    sim.step();
    let Err(Error::Violated(violations)) = sim.try_step() else { panic!("counter 2 is at 99") };
    assert_eq!((violations.len(), violations[0].instance.as_str()), (1, "machine"));
}
