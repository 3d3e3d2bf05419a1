//! A testbench that looks at every clock sees the same as on the reference engine, even after code is made for its
//! looks.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, def, elaborate, mux};
use tilewright_sim::{EngineKind, Passes, Simulation};

block! {
    /// Outputs that depend on a register, a memory and the inputs; the edge needs the same values.
    struct Mixed;
    in In { add: bits(8), wide: bits(70), store: bit() }
    out Out { sum: _, next: _, word: _, widened: _ }
}

impl Mixed {
    fn build(&self, m: Module, i: In) -> Out {
        let sum = m.reg("sum", 8).reset(3);
        let words = m.memory("words", 16, 8, ReadUnderWrite::Old).fill(Bits::zero(8));
        def!(found = words.read_async(sum.slice(0..4)));
        def!(coming = sum + i.add + found);
        def!(wider = i.wide + coming.zext(70));
        let total = m.reg("total", 70).reset(0);
        total.next(total + wider);
        words.write(i.store, sum.slice(4..8), coming);
        sum.next(coming);
        m.assert(coming.ne(99), "nobody gets to 99");
        Out { sum: *sum, next: coming, word: mux(i.store, found, 0), widened: wider }
    }
}

/// The values seen by a testbench that looks occasionally.
fn seen(kind: EngineKind, looks_after: u64) -> Vec<String> {
    let passes = Passes { looks_after, held_after: 40, ..Passes::default() };
    let mut sim = Simulation::with_passes(&elaborate(&Mixed).unwrap(), &passes).unwrap().on(kind);
    let [add, wide, store, sum, next, word, widened] =
        ["add", "wide", "store", "sum", "next", "word", "widened"].map(|name| sim.port(name).unwrap());
    let mut seen = Vec::new();
    for cycle in 0..400_u64 {
        // Inputs change before a look, after it, or not at all.
        if cycle % 7 == 0 {
            sim.set(add, cycle & 0x1f);
            sim.set(wide, Bits::from_limbs(70, &[cycle * 0x1234_5678_9abc, cycle & 0x3f]));
        }
        // At first at one value only, which has a function before anything else does.
        if cycle % 3 != 0 && cycle > 100 {
            let values = [next, word, sum, widened].map(|port| sim.get(port));
            seen.push(format!("{values:?}"));
        }
        if cycle % 2 == 0 {
            // Another function than that of the outputs.
            seen.push(sim.peek("found").unwrap().to_string());
        }
        if cycle % 11 == 0 {
            sim.set(store, cycle % 2);
        }
        if cycle % 50 == 49 {
            sim.poke_memory("words", 3, cycle & 0xff).unwrap();
        }
        match cycle % 90 {
            89 => sim.try_reset().unwrap(),
            88 => sim.try_run(4).unwrap_or_else(|error| seen.push(error.to_string())),
            _ => sim.try_step().unwrap_or_else(|error| seen.push(error.to_string())),
        }
        seen.push(format!("{:?} {}", sim.get(sum), sim.peek("total").unwrap()));
    }
    seen
}

#[test]
fn looks_change_nothing() {
    let expected = seen(EngineKind::Reference, u64::MAX);
    assert!(expected.iter().any(|line| line.contains("nobody gets to 99")), "an assertion is to fail too");
    for looks_after in [1, 2, 30, u64::MAX] {
        for kind in [EngineKind::Compiled, EngineKind::Both] {
            assert_eq!(seen(kind, looks_after), expected, "{kind:?}, after {looks_after} looks");
        }
    }
}
