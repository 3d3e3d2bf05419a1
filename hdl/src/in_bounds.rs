//! Memories whose addresses never reach beyond the last word.

use crate::data::Data;
use crate::draft::{Draft, DraftMemory, DraftProperty};
use crate::elaboration;
use crate::enabled::PartId;
use crate::memory::Mem;
use tilewright_circuit::ir::{Binary, ClockId, Directive, Node, NodeId, Op, Property, Relation, Unary};
use tilewright_circuit::{Bits, Loc};

impl<V: Data> Mem<V> {
    /// States that no access has an address beyond the last word. An assertion checks every port: of a port with an
    /// enable, where the enable is high. In return Verilog has neither the comparison nor the multiplexer that make a
    /// read beyond the depth 0.
    ///
    /// The statement is of use only where the depth is not a power of two, and the circuit does not show that the
    /// addresses stay below the depth. During a reset nothing is asserted, and the words beyond are undefined there too.
    /// An asynchronous read is checked at the edges of the memory's clock, so a block without registers gets a clock. As
    /// for every assertion, the block gets the clock's reset.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// The samples of a period.
    ///     pub struct Samples;
    ///     in SamplesIn { shows: bit(), at: below(400) }
    ///     out SamplesOut { sample: bits(8) }
    /// }
    ///
    /// impl Samples {
    ///     fn build(&self, m: Module, i: SamplesIn) -> SamplesOut {
    ///         def!(samples = m.memory(400, 8, ReadUnderWrite::Any).fill(7).in_bounds());
    ///         SamplesOut { sample: samples.read_when(i.shows, i.at) }
    ///     }
    /// }
    ///
    /// let design = elaborate(&Samples)?;
    /// assert!(tilewright_gen::verilog(&design)[0].text.contains("if (shows) samples_read <= samples[at];"));
    ///
    /// let mut sim = tilewright_sim::Simulation::of(&Samples)?;
    /// sim.drive(SamplesIn { shows: 0, at: 400 });
    /// sim.step(); // nothing is read
    /// sim.drive(SamplesIn { shows: 1, at: 400 });
    /// assert!(sim.try_step().unwrap_err().to_string().contains("`at` is an address of `samples`, below 400"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[track_caller]
    pub fn in_bounds(self) -> Mem<V> {
        elaboration::draft(|draft| draft.memories[self.index as usize].memory.in_bounds = true);
        self
    }
}

/// An access of a memory whose addresses are said to stay below the depth.
struct Access {
    memory: String,
    depth: u32,
    address: NodeId,
    enable: Option<NodeId>,
    clock: ClockId,
    part: Option<PartId>,
    loc: Loc,
}

/// Adds an assertion for each access of a memory whose addresses are said to stay below the depth.
pub(crate) fn assert_addresses(draft: &mut Draft) {
    for access in accesses(draft) {
        let Access { memory, depth, address, enable, clock, part, loc } = access;
        let &Node { width, shape, .. } = draft.node(address);
        let message = format!("`{}` is an address of `{memory}`, below {depth}", draft.describe(address));
        let count = draft.add(Op::Const(Bits::new(width, u64::from(depth))), width, shape, loc);
        let operands = [address, count];
        let mut condition = draft.add(Op::Compare { relation: Relation::Lt, signed: false, operands }, 1, shape, loc);
        if let Some(enable) = enable {
            let lanes = if shape.is_plain() { draft.node(enable).shape } else { shape };
            let [enable, inside] = [enable, condition].map(|node| draft.in_shape(node, lanes, loc));
            let idle = draft.add(Op::Unary(Unary::Not, enable), 1, lanes, loc);
            condition = draft.add(Op::Binary(Binary::Or, idle, inside), 1, lanes, loc);
        }
        let property = Property { directive: Directive::Assert, clock, condition, message, values: Vec::new(), loc };
        draft.properties.push(DraftProperty { property, part });
    }
}

fn accesses(draft: &mut Draft) -> Vec<Access> {
    let mut accesses = Vec::new();
    for index in 0..draft.memories.len() {
        let DraftMemory { memory, read_parts, read_clocks, write_parts, written, .. } = &draft.memories[index];
        let (name, depth) = (memory.name.clone(), memory.depth);
        // Addresses of a power of two of words cannot reach beyond.
        if !memory.in_bounds || depth.is_power_of_two() {
            continue;
        }
        let access = |address, enable, clock, part, loc| Access {
            memory: name.clone(),
            depth,
            address,
            enable,
            clock,
            part,
            loc,
        };
        let reads = memory.reads.iter().zip(read_parts).zip(read_clocks);
        let reads: Vec<_> = reads.map(|((read, part), clock)| (read.clone(), *part, *clock)).collect();
        let writes = memory.writes.iter().zip(write_parts).zip(written);
        let writes: Vec<_> = writes
            .map(|((write, part), loc)| access(write.address, Some(write.enable), write.clock, *part, *loc))
            .collect();
        for (read, part, clock) in reads {
            let loc = draft.node(read.node).loc;
            accesses.push(access(read.address, read.enable, draft.use_clock(clock), part, loc));
        }
        accesses.extend(writes);
    }
    accesses
}
