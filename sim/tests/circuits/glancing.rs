//! Nets of single lanes that are read together in each clock: each engine gives the same numbers.

use tilewright_hdl::ir::*;
use tilewright_hdl::{Bits, Design};
use tilewright_sim::{EngineKind, Simulation};

use crate::circuits::build::Build;

/// Rows and grids that are computed by every operation across lanes; flags that are packed; words of memories; a wide sum. Returns the names of lanes.
fn machine() -> (Design, Vec<String>) {
    let b = &mut Build::new("machine");
    let mut names = Vec::new();
    let mut name = |of: &str, shape: Shape| match shape {
        Shape::Plain => names.push(of.to_owned()),
        Shape::Row(count) => names.extend((0..count).map(|lane| format!("{of}[{lane}]"))),
        Shape::Grid(rows, columns) => {
            names.extend((0..rows * columns).map(|at| format!("{of}[{}][{}]", at / columns, at % columns)));
        }
    };
    let step = b.input("step", 8, Shape::Row(6));
    let starts = (5..11).map(|start| Bits::new(8, start)).collect();
    let count = b.register("count", 8, Shape::Row(6), Some(Init::Each(starts)));
    let next = b.add(count, step);
    b.next(count, None, next);
    let (rows, columns) = (b.broadcast(count, 1, 6), b.broadcast(next, 0, 6));
    let sums = b.add(rows, columns);
    let edge = b.constant(8, 77, Shape::Plain);
    let mut computed =
        vec![("sums", sums), ("left", b.previous(next, 0, edge)), ("both", b.interleave(&[count, next], 0))];
    computed.push(("pair", b.stack(&[next, step], 1)));
    for (name, by) in [
        ("all_of", Reduction::And),
        ("any_of", Reduction::Or),
        ("odd_of", Reduction::Xor),
        ("sum", Reduction::Add),
        ("least", Reduction::Min),
        ("most", Reduction::Max),
    ] {
        computed.push((name, b.reduce(by, sums, 1)));
    }
    let packed = b.pack(next, 0);
    computed.push(("nibbles", b.unpack(packed, 0, 12)));
    computed.push(("word_of_all", packed));
    let zero = b.constant(8, 2, Shape::Row(6));
    let index = b.and(count, zero);
    computed.push(("picked", b.pick(sums, 1, index)));
    computed.push(("fourth", b.lane(sums, 0, 3)));
    // Enough flags to be packed into words.
    let begin = (0..70).map(|lane| Bits::new(1, lane % 3 % 2)).collect();
    let flags = b.register("flags", 1, Shape::Row(70), Some(Init::Each(begin)));
    let one = b.constant(1, 1, Shape::Plain);
    let moved = b.previous(flags, 0, one);
    let mixed = b.xor(flags, moved);
    b.next(flags, None, mixed);
    computed.push(("mixed", mixed));
    let wide = b.register("wide", 70, Shape::Row(6), None);
    let lowest = b.constant(70, 0x3fff_ffff_ffff, Shape::Row(6));
    let wider = b.add(wide, lowest);
    b.next(wide, None, wider);
    computed.push(("wider", wider));
    let memory = b.memory("words", 4, 8, Shape::Row(6));
    let (address, always) = (b.constant(2, 1, Shape::Plain), b.constant(1, 1, Shape::Plain));
    b.write(memory, always, address, count);
    computed.push(("word", b.read(memory, false, address, None)));
    for (of, node) in computed {
        name(of, b.shape(node));
        let node = b.named(of, node);
        b.output(&format!("{of}_out"), node);
    }
    name("count", Shape::Row(6));
    name("flags", Shape::Row(70));
    (Design::new(vec![b.module.clone()]).unwrap(), names)
}

#[test]
fn lanes_that_are_read_together_are_those_of_the_reference() {
    let (design, names) = machine();
    let mut all = [EngineKind::Reference, EngineKind::Compiled].map(|kind| {
        let mut sim = Simulation::from_design(&design).unwrap().on(kind).seeded(7);
        sim.reset();
        let nets = sim.nets(&names).unwrap();
        let numbers = vec![0; nets.count()];
        (sim, nets, numbers)
    });
    // All but the wide ones take one number.
    assert_eq!(all[0].1.count(), names.len() + 6);
    // Long enough for code of an edge that looks at a port again.
    for clock in 0..700_u64 {
        for (sim, nets, numbers) in &mut all {
            if clock % 50 == 0 {
                let step = sim.port("step").unwrap();
                sim.set(step, Bits::new(48, clock.wrapping_mul(0x9e37_79b9_7f4a) & 0xffff_ffff_ffff));
            }
            let port = sim.port("all_of_out").unwrap();
            sim.get(port);
            sim.numbers(nets, numbers);
        }
        let [(_, _, reference), (_, _, compiled)] = &all;
        assert_eq!(compiled, reference, "in clock {clock} of {names:?}");
        // A second look is the same.
        let (sim, nets, numbers) = &mut all[1];
        let before = numbers.clone();
        sim.numbers(nets, numbers);
        assert_eq!(*numbers, before);
        all.iter_mut().for_each(|(sim, ..)| sim.step());
    }
    assert!(all[0].2.iter().any(|number| *number > 255));
}

/// Inputs, registers, computed values and constants of one lane, which are read where they are.
#[test]
fn single_values_are_those_of_the_reference_in_any_buffer() {
    let b = &mut Build::new("machine");
    let step = b.input("step", 8, Shape::Plain);
    let count = b.register("count", 8, Shape::Plain, Some(Init::Same(Bits::new(8, 5))));
    let next = b.add(count, step);
    b.next(count, None, next);
    let flag = b.register("flag", 1, Shape::Plain, None);
    let one = b.constant(1, 1, Shape::Plain);
    let other = b.xor(flag, one);
    b.next(flag, None, other);
    let fixed = b.constant(8, 77, Shape::Plain);
    let (fixed, sum) = (b.named("fixed", fixed), b.named("sum", next));
    b.output("sum_out", sum);
    b.output("fixed_out", fixed);
    let design = Design::new(vec![b.module.clone()]).unwrap();
    let mut all = [EngineKind::Reference, EngineKind::Compiled].map(|kind| {
        let mut sim = Simulation::from_design(&design).unwrap().on(kind);
        sim.reset();
        let nets = sim.nets(["step", "count", "flag", "sum", "fixed"]).unwrap();
        (sim, nets)
    });
    for clock in 0..700_u64 {
        let [reference, compiled] = all.each_mut().map(|(sim, nets)| {
            let (step, sum) = (sim.port("step").unwrap(), sim.port("sum_out").unwrap());
            if clock % 3 == 0 {
                sim.set(step, clock % 256);
            }
            if clock % 7 == 0 {
                sim.get(sum);
            }
            let mut numbers = vec![clock; 6];
            sim.numbers(nets, &mut numbers);
            sim.step();
            numbers
        });
        assert_eq!(compiled, reference, "in clock {clock}");
        assert_eq!((compiled[4], compiled[5]), (77, clock));
    }
}
