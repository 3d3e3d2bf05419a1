//! Values of thousands of bits, on threads with a small stack: no code may need more than there is.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, concat, elaborate, mux};
use tilewright_sim::{Batch, EngineKind, Simulation};

block! {
    /// A register, a memory, and each kind of operation on wide values, with many of them live at once.
    struct Cell { width: u32, operations: u32 }
    in(self) CellIn { x: bits(self.width), left: bits(self.width), pick: bit() }
    out CellOut { value: _, sum: _ }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let w = self.width;
        let value = m.reg("value", w).reset(5);
        let words = m.memory("words", 4, w, ReadUnderWrite::Any);
        let address = value.slice(0..2);
        let word = words.read(address);
        let mut parts = vec![i.x, i.left, *value, word];
        for n in 0..self.operations {
            let (a, b) = (parts[parts.len() - 1 - n as usize % 3], parts[parts.len() - 2]);
            parts.push(match n % 6 {
                0 => a + b,
                1 => mux(i.pick, a ^ b, !a),
                2 => concat(&[a.slice(0..w / 3), b.slice(w / 3..w)]),
                3 => mux(a.lt(b), a - b, b),
                4 => a << b.slice(0..9),
                _ => (a.slice(1..w).sext(w)) & b,
            });
        }
        let sum = parts.into_iter().reduce(|all, part| all ^ part).expect("there are parts");
        words.write(i.pick, address, sum);
        value.next(sum);
        CellOut { value: *value, sum }
    }
}

block! {
    struct Row { lanes: u32, width: u32, operations: u32 }
    in(self) RowIn { x: bits(self.width), pick: bit() }
    out RowOut { sum: _, all: _, last: _ }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let cell = Cell { width: self.width, operations: self.operations };
        let out =
            m.array("u_cell", self.lanes, &cell, |a| CellIn { x: i.x, left: a.value.previous(i.x), pick: i.pick });
        RowOut { sum: out.value.sum(), all: out.sum.xor_all(), last: out.sum.last() }
    }
}

/// Runs an array on both engines, on a thread with a stack of this many bytes, and a batch of arrays.
fn runs_on(stack: usize, row: &Row) {
    let design = elaborate(row).unwrap();
    let width = row.width;
    let value = move |n: u64| {
        let limb = |i: u32| (u64::from(i) + n).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(i % 64);
        let limbs: Vec<u64> = (0..width.div_ceil(64)).map(limb).collect();
        Bits::from_limbs(width, &limbs)
    };
    let run = move || {
        let mut sim = Simulation::from_design(&design).unwrap().on(EngineKind::Both);
        let [x, pick] = ["x", "pick"].map(|name| sim.port(name).unwrap());
        let outputs = ["sum", "all", "last"].map(|name| sim.port(name).unwrap());
        for n in 0..6 {
            sim.set(x, value(n));
            sim.set(pick, n & 1);
            sim.step();
            let _ = outputs.map(|port| sim.get(port));
        }
        let nonzero = outputs.map(|port| !sim.get(port).is_zero());
        assert_eq!(nonzero, [true; 3]);

        let mut batch = Batch::from_design(&design, 2).unwrap().on(EngineKind::Both);
        for n in 0..6 {
            batch.set_each(x, |run| value(n + u64::from(run)));
            batch.set_all(pick, n & 1);
            batch.step();
        }
        for port in outputs {
            assert_eq!(batch.get(port, 0), sim.get(port));
            assert_ne!(batch.get(port, 1), sim.get(port));
        }
    };
    std::thread::Builder::new().stack_size(stack).spawn(run).unwrap().join().unwrap();
}

#[test]
fn an_array_of_values_of_4096_bits_takes_little_stack() {
    runs_on(256 << 10, &Row { lanes: 5, width: 4096, operations: 60 });
}

#[test]
fn an_array_of_values_of_250_bits_takes_little_stack() {
    runs_on(256 << 10, &Row { lanes: 16, width: 250, operations: 200 });
}

#[test]
fn values_of_a_million_bits_take_little_stack() {
    runs_on(256 << 10, &Row { lanes: 2, width: 1 << 20, operations: 6 });
}
