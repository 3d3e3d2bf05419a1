//! What generated code relies on, as it checks nothing itself: shapes that agree, lanes and memories that are there,
//! addresses that are no wider than a memory needs. A [`tilewright_hdl::ir::Design`] is validated, and
//! [`crate::engine::program::compile`] makes no other programs of it; this is a second look, at what is run.

use tilewright_hdl::index_width;
use tilewright_hdl::ir::{Binary, Unary};

use crate::engine::program::{Kind, Program, Value, ValueId};

/// Checks a program.
///
/// # Panics
///
/// It is not one that [`crate::engine::program::compile`] makes of a valid circuit.
pub(super) fn check(program: &Program) {
    let mut known: Vec<bool> = program.values.iter().map(|value| value.offset < program.state_end).collect();
    program.constants.iter().for_each(|(id, _)| known[id.index()] = true);
    for operation in &program.operations {
        let result = program.value(operation.result);
        operation.kind.for_each_operand(|operand| {
            let is_known = known.get(operand.index()).is_some_and(|known| *known);
            assert!(is_known, "a circuit uses a value before it is computed: {operation:?}");
        });
        let fits = Shapes(program).fit(&operation.kind, result);
        assert!(fits, "the operands of an operation do not have the shapes that it takes: {operation:?}, {result:?}");
        known[operation.result.index()] = true;
    }
    for (id, bits) in &program.constants {
        assert!(bits.width() == program.value(*id).width, "a constant has another width than its value: {id:?}");
    }
    let is_flag = |id: ValueId, lanes: u32| Shapes(program).is(id, lanes, 1);
    for register in &program.registers {
        let Value { lanes, width, .. } = *program.value(register.value);
        let fits = Shapes(program).is(register.next, lanes, width)
            && register.enable.is_none_or(|enable| is_flag(enable, lanes))
            && register.reset.as_ref().is_none_or(|reset| reset.width() == width);
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
        assert!(program.value(assert.condition).width == 1, "an assertion is of more than one bit: {assert:?}");
    }
}

/// Compares the shapes of a program's values.
struct Shapes<'a>(&'a Program);

impl Shapes<'_> {
    fn is(&self, id: ValueId, lanes: u32, width: u32) -> bool {
        let value = self.0.value(id);
        (value.lanes, value.width) == (lanes, width)
    }

    /// Whether an operation that gives `result` has the operands that it takes.
    fn fit(&self, kind: &Kind, result: &Value) -> bool {
        let Value { lanes, width, .. } = *result;
        let (lanes_of, width_of) = (|id: ValueId| self.0.value(id).lanes, |id: ValueId| self.0.value(id).width);
        let same = |id: ValueId| self.is(id, lanes, width);
        let flag = |id: ValueId| self.is(id, lanes, 1);
        let in_lanes = |id: ValueId| lanes_of(id) == lanes;
        let times = |id: ValueId, n: u32| lanes_of(id).checked_mul(n) == Some(lanes) && width_of(id) == width;
        let by_group = |id: ValueId, n: u32| lanes.checked_mul(n) == Some(lanes_of(id)) && width_of(id) == width;
        match kind {
            Kind::State | Kind::Const(_) => false,
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
            Kind::Broadcast(of, n) | Kind::Tile(of, n) => times(*of, *n),
            Kind::PerLane(parts) => {
                let (first, n) = (parts.first(), parts.len() as u32);
                first.is_some_and(|first| parts.iter().all(|part| lanes_of(*part) == lanes_of(*first)))
                    && parts.iter().all(|part| times(*part, n))
            }
            Kind::Shifted { of, edge, group, .. } => same(*of) && times(*edge, *group),
            Kind::Lane { of, index, group } => by_group(*of, *group) && index < group,
            Kind::Reduce { of, group, .. } => by_group(*of, *group),
        }
    }
}

#[cfg(test)]
mod tests {
    use tilewright_hdl::{Block, Module, ReadUnderWrite, Width, bit, bits, bundle, elaborate};

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
            let words = m.memory("words", 9, 64, ReadUnderWrite::Old);
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
            let cells = m.array("u_cell", 3, &Cell, |a| CellIn { x: a.all(&i.x), word: a.all(&i.word) });
            TopOut { y: tilewright_hdl::mux(i.pick, cells.y.last(), i.word) }
        }
    }

    fn program() -> Program {
        compile(&elaborate(&Top).unwrap(), &Passes::none())
    }

    fn operation(program: &mut Program, is_it: fn(&Kind) -> bool) -> &mut Kind {
        let mut kinds = program.operations.iter_mut().map(|operation| &mut operation.kind);
        kinds.find(|kind| is_it(kind)).expect("the circuit has one")
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
            let lane = operation(program, |kind| matches!(kind, Kind::Lane { .. }));
            if let Kind::Lane { index, .. } = lane {
                *index = 1_000_000;
            }
        });
        assert!(far.starts_with(shapes) && far.contains("1000000"), "{far}");
        let address = refused(|program| {
            let wide = long(program);
            if let Kind::Read { address, .. } = operation(program, |kind| matches!(kind, Kind::Read { .. })) {
                *address = wide;
            }
        });
        assert!(address.starts_with(shapes), "{address}");
        let memory = refused(|program| {
            if let Kind::Read { memory, .. } = operation(program, |kind| matches!(kind, Kind::Read { .. })) {
                *memory = 7;
            }
        });
        assert!(memory.starts_with(shapes), "{memory}");
        let write = refused(|program| program.memories[0].writes[0].address = long(program));
        assert!(write.starts_with("the ports of a memory do not have its shape: "), "{write}");
        let early = refused(|program| program.operations.reverse());
        assert!(early.starts_with("a circuit uses a value before it is computed: "), "{early}");
    }
}
