//! The requirements of code generation on a lowered function: every operation has code, every operand exists, and the
//! padding lanes of the last strip change nothing.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Reduction};

use super::bounds::Bounds;
use super::shapes::{MemoryShape, Shapes};
use crate::engine::function::{Function, Sink};
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::storage;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Axis, Cell, Kind, Lowered, ValueId};

/// Checks a function before code generation, for these strips and memories.
///
/// # Panics
///
/// Lowering has made a mistake.
pub(crate) fn check_lowered(function: &Function, strips: &StripSizes, memories: &[MemoryAt]) {
    let shape = |at: &MemoryAt| MemoryShape { lanes: at.lanes, depth: at.depth, width: at.width };
    let shapes: Vec<MemoryShape> = memories.iter().map(shape).collect();
    let shapes = Shapes { circuit: function.circuit(), memories: &shapes };
    let mut written = vec![false; memories.len()];
    for sink in &function.sinks {
        if let Sink::Write { memory, .. } = sink
            && let Some(written) = written.get_mut(*memory as usize)
        {
            *written = true;
        }
    }
    let mut demands = Demands { function, strips, memories, shapes, written, bounds: Bounds::new(function.circuit()) };
    function.needed().into_iter().for_each(|id| demands.cell(id));
    let holds = function.sinks.iter().filter(|sink| matches!(sink, Sink::ContinueIf(_))).count();
    assert!(holds <= 1, "a lowered function goes on by more than one value");
    function.sinks.iter().for_each(|sink| demands.sink(sink));
}

struct Demands<'a> {
    function: &'a Function,
    strips: &'a StripSizes,
    memories: &'a [MemoryAt],
    shapes: Shapes<'a>,
    /// For each memory.
    written: Vec<bool>,
    bounds: Bounds<'a>,
}

impl Demands<'_> {
    fn cell(&mut self, id: ValueId) {
        let function = self.function;
        let cell = function.cell(id);
        cell.kind.for_each_operand(|operand| {
            assert!(operand < id, "a lowered function uses a value before it is computed: {cell:?}");
        });
        let fits = self.shapes.fit(cell);
        assert!(fits, "the operands of a lowered operation do not have the shapes that it takes: {cell:?}");
        assert!(self.is_known(cell), "a lowered operation is none that there is code for: {cell:?}");
    }

    /// Whether an operation whose operands have the right shapes has code.
    fn is_known(&mut self, cell: &Cell) -> bool {
        let Cell { ref kind, lanes, width } = *cell;
        let lanes_of = |id: ValueId| self.function.cell(id).lanes;
        let width_of = |id: ValueId| self.function.cell(id).width;
        match *kind {
            Kind::Read { .. } | Kind::Map { .. } | Kind::Interleave { .. } | Kind::Pick { .. } => false,
            // Each lane repeated, or a row repeated.
            Kind::Broadcast { axis, .. } => axis.inner == 1 || axis.lanes() == lanes,
            Kind::Stack { ref parts, inner } => inner == 1 || self.are_rows(parts, inner, cell),
            Kind::Lane { axis, .. } => axis.inner == 1,
            Kind::Reduce { by, of, axis } => {
                let is_carried = !matches!(by, Reduction::Min | Reduction::Max);
                axis.inner == 1 && is_carried && (axis.count < lanes_of(of) || self.is_masked(by, of))
            }
            Kind::Pack { of, axis } => lanes == 1 && self.are_limbs(axis, width_of(of)),
            Kind::Unpack { axis, .. } => lanes == axis.count && self.are_limbs(axis, width),
            Kind::Lowered(ref lowered) => match *lowered {
                Lowered::Gather { of, at } => {
                    lanes_of(of) > 1 && width_of(at) <= 64 && self.bounds.most(at) < lanes_of(of).into()
                }
                Lowered::Slide { .. } => lanes > 1,
                Lowered::Word { memory, address } => self.is_one_address(memory, address),
                Lowered::WordOf { memory, at, .. } => {
                    let of = &self.memories[memory as usize];
                    let stays = !self.written[memory as usize] && of.words.together();
                    let is_small = of.lanes > 1 && width <= 64 && width_of(at) <= 64;
                    lanes > 1 && stays && is_small && self.bounds.most(at) < of.lanes.into()
                }
                Lowered::Rotate { .. } => lanes == 1 && matches!(width, 8 | 16 | 32 | 64),
                Lowered::Assemble { .. } => lanes == 1 && width > 64,
            },
            _ => true,
        }
    }

    /// Whether joined rows can be copied by vectors.
    fn are_rows(&self, parts: &[ValueId], inner: u32, cell: &Cell) -> bool {
        let element = storage(self.strips, cell.lanes, cell.width);
        parts.len() as u32 * inner == cell.lanes
            && (inner * element).is_multiple_of(self.strips.vector())
            && element == storage(self.strips, inner, cell.width)
    }

    /// Whether lanes of this width have the layout of the limbs of the value that they are parts of.
    fn are_limbs(&self, axis: Axis, width: u32) -> bool {
        let all = axis.count * width;
        axis.inner == 1 && storage(self.strips, axis.count, width) == width && all.is_multiple_of(64)
    }

    /// Whether the padding lanes of the last strip add nothing to a reduction of all lanes.
    fn is_masked(&self, by: Reduction, of: ValueId) -> bool {
        let Cell { ref kind, lanes, .. } = *self.function.cell(of);
        lanes == 1
            || self.is_whole(lanes)
            || match *kind {
                Kind::Mux { select, on_false, .. } => {
                    let neutral = self.function.circuit().constant(on_false);
                    let is_neutral = |bits: &Bits| match by {
                        Reduction::And => bits.not().is_zero(),
                        _ => bits.is_zero(),
                    };
                    self.function.is_table(select) && neutral.is_some_and(is_neutral)
                }
                _ => false,
            }
    }

    /// Whether the lanes fill every strip.
    fn is_whole(&self, lanes: u32) -> bool {
        lanes.is_multiple_of(self.strips.strip(lanes))
    }

    /// Whether a memory whose words are together has the same address in all lanes; code uses one of them.
    fn is_one_address(&self, memory: u32, address: ValueId) -> bool {
        let is_one = match self.function.cell(address).kind {
            // A value that crosses into a unit is state there, and was the same in all lanes where it was computed.
            Kind::Const(_) | Kind::State => true,
            Kind::Broadcast { of, .. } => self.function.cell(of).lanes == 1,
            _ => false,
        };
        is_one || !self.memories[memory as usize].words.together()
    }

    fn sink(&self, sink: &Sink) {
        let shapes = &self.shapes;
        let is = |id: ValueId, width: u32| shapes.is(id, 1, width);
        let fits = match *sink {
            Sink::Register { state, next, enable } => {
                self.function.cell(state).kind == Kind::State && shapes.can_take(state, next, enable)
            }
            Sink::Write { memory, enable, address, data } => {
                shapes.can_write(memory, enable, address, data)
                    && self.is_one_address(memory, address)
                    && self.is_existing(enable)
            }
            // A shown value is stored where it is computed.
            Sink::Show(value) => self.function.circuit().constant(value).is_none(),
            Sink::ContinueIf(value) => is(value, 1),
            Sink::Row { row, value, .. } => is(row, 64) && self.function.cell(value).lanes == 1,
        };
        assert!(fits, "a lowered function does what there is no code for: {sink:?}");
    }

    /// Whether a flag is 0 in the padding lanes of the last strip.
    fn is_existing(&self, flag: ValueId) -> bool {
        let Cell { ref kind, lanes, .. } = *self.function.cell(flag);
        let is_table = |id: ValueId| self.function.is_table(id);
        lanes == 1
            || self.is_whole(lanes)
            || match *kind {
                Kind::Binary(Binary::And, a, b) => is_table(a) || is_table(b),
                _ => is_table(flag),
            }
    }
}
