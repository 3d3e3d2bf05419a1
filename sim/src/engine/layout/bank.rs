//! The layout of memories: those with the same ports stand side by side, so that an access to all of them is to a
//! single cache line.

use std::collections::BTreeMap;

use rustc_hash::FxHashSet;
use tilewright_circuit::ir::Contents;

use super::Words;
use super::store::Store;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Cell, Kind, Memory, Program, ValueId};

/// Memories that stand side by side.
pub(crate) type Bank = Store;

/// The common properties of memories that stand side by side.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Ports {
    lanes: u32,
    depth: u32,
    /// Clock, enable and address.
    writes: Vec<(u32, ValueId, ValueId)>,
    /// Addresses, in sequence.
    reads: Vec<ValueId>,
    /// The memory, if it stands alone.
    alone: Option<usize>,
}

/// The places of a program's memories, and their banks, full of zeros.
pub(crate) fn banks(program: &Program, strips: &StripSizes) -> (Vec<MemoryAt>, Vec<Bank>) {
    let mut groups: BTreeMap<Ports, Vec<usize>> = BTreeMap::new();
    for (index, (memory, reads)) in program.memories.iter().zip(reads(program)).enumerate() {
        let writes: Vec<_> = memory.writes.iter().map(|port| (port.clock, port.enable, port.address)).collect();
        let alone = (!program.passes.side_by_side || writes.is_empty()).then_some(index);
        let ports = Ports { lanes: memory.lanes, depth: memory.depth, writes, reads, alone };
        groups.entry(ports).or_default().push(index);
    }
    let common = common(program);
    let mut all = vec![None; program.memories.len()];
    let mut banks = Vec::new();
    for (ports, group) in groups {
        let widths: Vec<u32> = group.iter().map(|&index| program.memories[index].width).collect();
        let addresses = || ports.reads.iter().copied().chain(ports.writes.iter().map(|(.., address)| *address));
        let bits = addresses().map(|id| program.value(id).width).max().unwrap_or(1);
        let together =
            ports.lanes > 1 && widths.iter().all(|&width| width <= 64) && addresses().all(|id| common.contains(&id));
        // Every address that its width can express has a word, so that reads need no check: those beyond the depth
        // stay zero. The width is that of the depth, as `demands` has checked.
        let depth = (ports.depth as usize).max(1 << bits);
        let places = Words::side_by_side(&widths, ports.lanes, depth, together, strips);
        let bank = Bank::new(places[0].1.size, program.passes.guarded);
        let is_full = ports.depth as usize >= 1 << bits;
        for ((&index, &width), &(first, words)) in group.iter().zip(&widths).zip(&places) {
            let address = bank.address() as usize + first;
            let blank = match &program.memories[index].contents {
                Contents::Fill(word) if program.passes.blanks && is_full && width <= 64 => word.limbs()[0],
                _ => 0,
            };
            let (bank, lanes, depth) = (banks.len(), ports.lanes, ports.depth);
            all[index] =
                Some(MemoryAt { bank, first, address, table: None, words, lanes, depth, width, blank, is_full });
        }
        banks.push(bank);
    }
    (all.into_iter().map(|at| at.expect("every memory is in a group")).collect(), banks)
}

/// The addresses at which each memory is read.
fn reads(program: &Program) -> Vec<Vec<ValueId>> {
    let synchronous = |memory: &Memory| memory.reads.iter().map(|read| read.address).collect();
    let mut all: Vec<Vec<ValueId>> = program.memories.iter().map(synchronous).collect();
    for (_, cell) in program.circuit.cells() {
        if let Kind::Read { memory, address } = cell.kind {
            all[memory as usize].push(address);
        }
    }
    for reads in &mut all {
        reads.sort();
        reads.dedup();
    }
    all
}

/// The values that are the same in all lanes, so that one lane represents them.
fn common(program: &Program) -> FxHashSet<ValueId> {
    let is_broadcast = |cell: &Cell| matches!(cell.kind, Kind::Broadcast { of, .. } if program.circuit[of].lanes == 1);
    program.circuit.cells().filter(|(_, cell)| is_broadcast(cell)).map(|(id, _)| id).collect()
}

#[cfg(test)]
mod tests {
    use tilewright_circuit::ReadUnderWrite;
    use tilewright_hdl::{Module, bits, block, elaborate};

    use super::*;
    use crate::engine::Passes;
    use crate::engine::program::compile;

    block! {
        /// Two memories with the same ports, and one that is written at another address.
        struct Memories;
        in In { address: bits(4), enable: bits(1), word: bits(24) }
        out Out { c: _, d: _, o: _ }
    }

    impl Memories {
        fn build(&self, m: Module, i: In) -> Out {
            let [colour, depth, other] =
                ["colour", "depth", "other"].map(|name| m.memory(name, 16, 24, ReadUnderWrite::Old));
            colour.write(i.enable, i.address, i.word);
            depth.write(i.enable, i.address, !i.word);
            other.write(i.enable, !i.address, i.word);
            Out { c: colour.read(i.address), d: depth.read(i.address), o: other.read(i.address) }
        }
    }

    #[test]
    fn memories_with_the_same_ports_share_a_bank() {
        let design = elaborate(&Memories).unwrap();
        let banked = |passes: &Passes| {
            let program = compile(&design, passes);
            let (memories, banks) = banks(&program, &StripSizes::of(&program, 128));
            (memories.iter().map(|at| (at.bank, at.first)).collect::<Vec<_>>(), banks.len())
        };
        let (places, count) = banked(&Passes::default());
        assert_eq!(count, 2);
        assert_eq!((places[0].0, places[0].1, places[1].1), (places[1].0, 0, 4));
        assert_ne!(places[0].0, places[2].0);
        assert_eq!(banked(&Passes { side_by_side: false, ..Passes::default() }).1, 3);
    }
}
