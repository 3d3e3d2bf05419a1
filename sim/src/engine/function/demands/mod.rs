//! The requirements of generated code, which checks nothing itself: shapes agree, lanes and memories exist, addresses
//! are no wider than their memories need, and lane numbers are in range. A [`tilewright_hdl::ir::Design`] is
//! validated, and [`crate::engine::program::compile`] makes only such programs of it; this is a second check. Each
//! function is checked again when it has been lowered.

mod bounds;
mod lowered;
mod shapes;

use tilewright_circuit::limbs_for;

use crate::engine::program::{Kind, Memory, Program};
pub(crate) use lowered::check_lowered;
use shapes::{MemoryShape, Shapes};

/// Checks a program.
///
/// # Panics
///
/// The program is not one that [`crate::engine::program::compile`] makes of a valid circuit.
pub(crate) fn check(program: &Program) {
    check_order(program);
    let shape = |memory: &Memory| MemoryShape { lanes: memory.lanes, depth: memory.depth, width: memory.width };
    let memories: Vec<MemoryShape> = program.memories.iter().map(shape).collect();
    let shapes = Shapes { circuit: &program.circuit, memories: &memories };
    for (_, cell) in program.circuit.cells() {
        let fits = shapes.fit(cell) && !matches!(cell.kind, Kind::Lowered(_));
        assert!(fits, "the operands of an operation do not have the shapes that it takes: {cell:?}");
    }
    for register in &program.registers {
        let width = program.circuit[register.value].width;
        let fits = shapes.can_take(register.value, register.next, register.enable)
            && register.reset(0).is_none_or(|reset| reset.len() == limbs_for(width));
        assert!(fits, "what a register takes does not have its shape: {register:?}");
    }
    for (index, memory) in (0..).zip(&program.memories) {
        let shape = memories[index as usize];
        let reads = memory.reads.iter().all(|port| {
            let flag = port.enable.is_none_or(|enable| shapes.is(enable, shape.lanes, 1));
            let data = shapes.is(port.value, shape.lanes, shape.width);
            data && flag && shapes.is(port.address, shape.lanes, shape.address())
        });
        let writes = memory.writes.iter().all(|port| shapes.can_write(index, port.enable, port.address, port.data));
        let fits = reads && writes && memory.depth > 0;
        assert!(fits, "the ports of a memory do not have its shape: {:?}, {:?}", memory.reads, memory.writes);
    }
    for assert in &program.asserts {
        assert!(program.circuit[assert.condition].width == 1, "an assertion is of more than one bit: {assert:?}");
    }
}

/// Checks that no value depends on itself.
fn check_order(program: &Program) {
    let circuit = &program.circuit;
    let mut order = vec![0; circuit.len()];
    circuit.needed(circuit.ids()).into_iter().enumerate().for_each(|(at, id)| order[id.index()] = at);
    for (id, cell) in circuit.cells() {
        cell.kind.for_each_operand(|operand| {
            let is_computed = order[operand.index()] < order[id.index()];
            assert!(is_computed, "a circuit uses a value before it is computed: {cell:?}");
        });
    }
}

#[cfg(test)]
mod tests {
    use tilewright_circuit::ReadUnderWrite;
    use tilewright_hdl::{Module, bit, bits, block, def, elaborate};

    use super::*;
    use crate::engine::Passes;
    use crate::engine::program::compile;

    block! {
        /// A memory.
        struct Cell;
        in CellIn { x: bits(4), word: bits(64) }
        out CellOut { y: _ }
    }

    impl Cell {
        fn build(&self, m: Module, i: CellIn) -> CellOut {
            def!(words = m.memory(9, 64, ReadUnderWrite::Old));
            words.write(i.x.bit(0), i.x, i.word);
            CellOut { y: words.read(i.x) ^ words.read_async(i.x) }
        }
    }

    block! {
        /// Memories in lanes.
        struct Top;
        in TopIn { pick: bit(), x: bits(4), word: bits(64) }
        out TopOut { y: _ }
    }

    impl Top {
        fn build(&self, m: Module, i: TopIn) -> TopOut {
            let cells = m.array("u_cell", 3, &Cell, |_| CellIn { x: i.x, word: i.word });
            TopOut { y: tilewright_hdl::mux(i.pick, cells.y.last(), i.word) }
        }
    }

    fn program() -> Program {
        compile(&elaborate(&Top).unwrap(), &Passes::none())
    }

    /// Edits the first operation for which `edit` returns true.
    fn operation(program: &mut Program, edit: impl Fn(&mut Kind) -> bool) {
        let mut edited = program.circuit.cells().filter_map(|(id, cell)| {
            let mut kind = cell.kind.clone();
            edit(&mut kind).then_some((id, kind))
        });
        let (id, kind) = edited.next().expect("the circuit has one");
        drop(edited);
        program.circuit.set_kind(id, kind);
    }

    /// Edits the program, which must then be rejected; returns the message.
    fn refused(edit: impl FnOnce(&mut Program)) -> String {
        let mut program = program();
        edit(&mut program);
        let panic = std::panic::catch_unwind(|| check(&program)).expect_err("it is refused");
        panic.downcast_ref::<String>().expect("it has a sentence").clone()
    }

    #[test]
    fn what_a_circuit_is_compiled_to_is_accepted() {
        check(&program());
    }

    #[test]
    fn what_code_would_reach_out_of_its_memory_for_is_refused() {
        let shapes = "the operands of an operation do not have the shapes that it takes: ";
        let long = |program: &Program| program.memories[0].writes[0].data;
        let far = refused(|program| {
            operation(program, |kind| {
                let Kind::Lane { index, .. } = kind else { return false };
                *index = 1_000_000;
                true
            });
        });
        assert!(far.starts_with(shapes) && far.contains("1000000"), "{far}");
        let address = refused(|program| {
            let wide = long(program);
            operation(program, |kind| {
                let Kind::Read { address, .. } = kind else { return false };
                *address = wide;
                true
            });
        });
        assert!(address.starts_with(shapes), "{address}");
        let memory = refused(|program| {
            operation(program, |kind| {
                let Kind::Read { memory, .. } = kind else { return false };
                *memory = 7;
                true
            });
        });
        assert!(memory.starts_with(shapes), "{memory}");
        let write = refused(|program| program.memories[0].writes[0].address = long(program));
        assert!(write.starts_with("the ports of a memory do not have its shape: "), "{write}");
        let early = refused(|program| {
            let last = program.circuit.ids().next_back().expect("there are values");
            operation(program, |kind| {
                let (Kind::Unary(_, of) | Kind::Binary(_, of, _)) = kind else { return false };
                *of = last;
                true
            });
        });
        assert!(early.starts_with("a circuit uses a value before it is computed: "), "{early}");
    }
}
