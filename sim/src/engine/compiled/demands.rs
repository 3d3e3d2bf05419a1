//! What generated code relies on, as it checks nothing itself: shapes that agree, lanes and memories that are there,
//! addresses that are no wider than a memory needs. A [`tilewright_hdl::ir::Design`] is validated, and
//! [`crate::engine::program::compile`] makes no other programs of it; this is a second look, at what is run.

use tilewright_hdl::ir::{Binary, Unary};
use tilewright_hdl::{index_width, limbs_for};

use crate::engine::program::{Axis, Cell, Kind, Program, ValueId};

/// Checks a program.
///
/// # Panics
///
/// It is not one that [`crate::engine::program::compile`] makes of a valid circuit.
pub(super) fn check(program: &Program) {
    check_order(program);
    for (_, cell) in program.circuit.cells() {
        let fits = Shapes(program).fit(cell);
        assert!(fits, "the operands of an operation do not have the shapes that it takes: {cell:?}");
    }
    let is_flag = |id: ValueId, lanes: u32| Shapes(program).is(id, lanes, 1);
    for register in &program.registers {
        let Cell { lanes, width, .. } = program.circuit[register.value];
        let fits = Shapes(program).is(register.next, lanes, width)
            && register.enable.is_none_or(|enable| is_flag(enable, lanes))
            && register.reset(0).is_none_or(|reset| reset.len() == limbs_for(width));
        assert!(fits, "what a register takes does not have its shape: {register:?}");
    }
    for memory in &program.memories {
        let index = index_width(memory.depth.into());
        let is_address = |id: ValueId| Shapes(program).is(id, memory.lanes, index);
        let reads = memory.reads.iter().all(|port| {
            let data = Shapes(program).is(port.value, memory.lanes, memory.width);
            data && is_address(port.address) && port.enable.is_none_or(|enable| is_flag(enable, memory.lanes))
        });
        let writes = memory.writes.iter().all(|port| {
            let data = Shapes(program).is(port.data, memory.lanes, memory.width);
            data && is_address(port.address) && is_flag(port.enable, memory.lanes)
        });
        let fits = reads && writes && memory.depth > 0;
        assert!(fits, "the ports of a memory do not have its shape: {:?}, {:?}", memory.reads, memory.writes);
    }
    for assert in &program.asserts {
        assert!(program.circuit[assert.condition].width == 1, "an assertion is of more than one bit: {assert:?}");
    }
}

/// Checks that no value is computed of itself.
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

/// Compares the shapes of a program's values.
struct Shapes<'a>(&'a Program);

impl Shapes<'_> {
    fn is(&self, id: ValueId, lanes: u32, width: u32) -> bool {
        let cell = &self.0.circuit[id];
        (cell.lanes, cell.width) == (lanes, width)
    }

    /// Whether an operation has the operands that it takes.
    fn fit(&self, cell: &Cell) -> bool {
        let Cell { ref kind, lanes, width } = *cell;
        let (lanes_of, width_of) = (|id: ValueId| self.0.circuit[id].lanes, |id: ValueId| self.0.circuit[id].width);
        let same = |id: ValueId| self.is(id, lanes, width);
        let flag = |id: ValueId| self.is(id, lanes, 1);
        let in_lanes = |id: ValueId| lanes_of(id) == lanes;
        // Without an axis, and with one, which groups of the lanes are.
        let less = |id: ValueId, axis: Axis| {
            lanes_of(id).checked_mul(axis.count) == Some(lanes) && lanes_of(id).is_multiple_of(axis.inner)
        };
        let more = |id: ValueId, axis: Axis| {
            lanes.checked_mul(axis.count) == Some(lanes_of(id)) && lanes.is_multiple_of(axis.inner)
        };
        let wide = |id: ValueId| width_of(id) == width;
        match kind {
            Kind::State => true,
            Kind::Const(bits) => bits.width() == width,
            Kind::Alias(of) | Kind::Unary(Unary::Not, of) => same(*of),
            Kind::Unary(_, of) => in_lanes(*of) && width == 1,
            Kind::Binary(Binary::Mul | Binary::MulSigned, a, b) => {
                in_lanes(*a) && in_lanes(*b) && width_of(*a).checked_add(width_of(*b)) == Some(width)
            }
            Kind::Binary(_, a, b) => same(*a) && same(*b),
            Kind::Compare(_, _, a, b) => in_lanes(*a) && self.is(*b, lanes, width_of(*a)) && width == 1,
            Kind::Shift(_, of, by) => same(*of) && in_lanes(*by),
            Kind::Mux { select, on_true, on_false } => flag(*select) && same(*on_true) && same(*on_false),
            Kind::Select { arms, default } => {
                arms.iter().all(|(condition, value)| flag(*condition) && same(*value)) && same(*default)
            }
            Kind::Case { subject, arms, default } => {
                let key = width_of(*subject);
                in_lanes(*subject)
                    && arms.iter().all(|(bits, value)| bits.width() == key && same(*value))
                    && same(*default)
            }
            Kind::Slice(of, low) => in_lanes(*of) && low.checked_add(width).is_some_and(|high| high <= width_of(*of)),
            Kind::Concat(parts) => {
                parts.iter().all(|part| in_lanes(*part))
                    && parts.iter().map(|part| u64::from(width_of(*part))).sum::<u64>() == u64::from(width)
            }
            Kind::Repeat(of, n) => in_lanes(*of) && width_of(*of).checked_mul(*n) == Some(width),
            Kind::Extend(of, _) => in_lanes(*of) && width_of(*of) <= width,
            Kind::Read { memory, address } => {
                let memory = self.0.memories.get(*memory as usize);
                memory.is_some_and(|memory| {
                    (memory.lanes, memory.width) == (lanes, width)
                        && self.is(*address, lanes, index_width(memory.depth.into()))
                })
            }
            Kind::Broadcast { of, axis } => less(*of, *axis) && wide(*of),
            Kind::Stack { parts, inner } => {
                let axis = Axis { count: parts.len() as u32, inner: *inner };
                !parts.is_empty() && parts.iter().all(|part| less(*part, axis) && wide(*part))
            }
            Kind::Map { of, axis, count, index, edge } => {
                let to = Axis { count: *count, ..*axis };
                let is_whole = |axis: Axis, lanes: u32| axis.lanes() > 0 && lanes.is_multiple_of(axis.lanes());
                is_whole(*axis, lanes_of(*of))
                    && is_whole(to, lanes)
                    && lanes_of(*of) / axis.lanes() == lanes / to.lanes()
                    && wide(*of)
                    && index.div > 0
                    && match edge {
                        Some(edge) => less(*edge, to) && wide(*edge),
                        None => (0..*count).all(|lane| index.source(lane, axis.count).is_some()),
                    }
            }
            Kind::Interleave { parts, axis } => {
                parts.first().is_some_and(|first| lanes_of(*first).is_multiple_of(axis.lanes()))
                    && parts
                        .iter()
                        .all(|part| wide(*part) && lanes_of(*part).checked_mul(parts.len() as u32) == Some(lanes))
            }
            Kind::Lane { of, axis, index } => more(*of, *axis) && wide(*of) && *index < axis.count,
            Kind::Pick { of, axis, index } => more(*of, *axis) && wide(*of) && in_lanes(*index),
            Kind::Reduce { of, axis, .. } => more(*of, *axis) && wide(*of),
            Kind::Pack { of, axis } => more(*of, *axis) && width_of(*of).checked_mul(axis.count) == Some(width),
            Kind::Unpack { of, axis } => less(*of, *axis) && width.checked_mul(axis.count) == Some(width_of(*of)),
            // No program has what only code does.
            Kind::Gather { .. } | Kind::Slide { .. } | Kind::Word { .. } | Kind::WordOf { .. } | Kind::Rotate(..) => {
                false
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use tilewright_hdl::{Block, Module, ReadUnderWrite, Width, bit, bits, bundle, def, elaborate};

    use super::*;
    use crate::engine::Passes;
    use crate::engine::program::compile;

    bundle! {
        struct CellIn<T> { x: T, word: T }
        struct CellOut<T> { y: T }
    }

    /// A memory.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Cell;

    impl Block for Cell {
        type In = CellIn;
        type Out = CellOut;

        fn inputs(&self) -> CellIn<Width> {
            CellIn { x: bits(4), word: bits(64) }
        }

        fn build(&self, m: Module, i: CellIn) -> CellOut {
            def!(words = m.memory(9, 64, ReadUnderWrite::Old));
            words.write(i.x.bit(0), i.x, i.word);
            CellOut { y: words.read(i.x) ^ words.read_async(i.x) }
        }
    }

    bundle! {
        struct TopIn<T> { pick: T, x: T, word: T }
        struct TopOut<T> { y: T }
    }

    /// Memories in lanes.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Top;

    impl Block for Top {
        type In = TopIn;
        type Out = TopOut;

        fn inputs(&self) -> TopIn<Width> {
            TopIn { pick: bit(), x: bits(4), word: bits(64) }
        }

        fn build(&self, m: Module, i: TopIn) -> TopOut {
            let cells = m.array("u_cell", 3, &Cell, |_| CellIn { x: i.x, word: i.word });
            TopOut { y: tilewright_hdl::mux(i.pick, cells.y.last(), i.word) }
        }
    }

    fn program() -> Program {
        compile(&elaborate(&Top).unwrap(), &Passes::none())
    }

    /// Edits the first operation that is taken.
    fn operation(program: &mut Program, edit: impl Fn(&mut Kind) -> bool) {
        let mut edited = program.circuit.cells().filter_map(|(id, cell)| {
            let mut kind = cell.kind.clone();
            edit(&mut kind).then_some((id, kind))
        });
        let (id, kind) = edited.next().expect("the circuit has one");
        drop(edited);
        program.circuit.set_kind(id, kind);
    }

    /// Edits the program, which is then refused.
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
