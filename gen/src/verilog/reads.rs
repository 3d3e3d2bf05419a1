//! Read ports of memories: their names, and whether their address can exceed the depth.

use super::scope::Names;
use tilewright_circuit::ir::{Memory, Module, NodeId, Op};

/// The names of a synchronous read port.
#[derive(Debug, Clone)]
pub struct ReadNames {
    /// The data: a register, or a net where the word is gated.
    pub data: String,
    /// The registers before the data, if the address can exceed the depth.
    pub raw: Option<RawRead>,
}

/// The registers of a read whose address can exceed the depth.
#[derive(Debug, Clone)]
pub struct RawRead {
    /// The word from the array.
    pub word: String,
    /// Whether the address was inside.
    pub inside: String,
}

/// The names of every read port, by memory; asynchronous ports have none.
///
/// The data has the name from the description, or else `m_read` for memory `m`; with several synchronous ports
/// `m_read0`, `m_read1` and so on.
pub fn name_reads(module: &Module, beyond: &[Vec<bool>], taken: &mut Names) -> Vec<Vec<Option<ReadNames>>> {
    module.memories.iter().zip(beyond).map(|(memory, beyond)| name_reads_of(module, memory, beyond, taken)).collect()
}

fn name_reads_of(module: &Module, memory: &Memory, beyond: &[bool], taken: &mut Names) -> Vec<Option<ReadNames>> {
    let several = memory.reads.iter().filter(|read| read.clock.is_some()).count() > 1;
    let mut index = 0;
    let mut names = Vec::with_capacity(memory.reads.len());
    for (read, &beyond) in memory.reads.iter().zip(beyond) {
        names.push(read.clock.map(|_| {
            let number = if several { index.to_string() } else { String::new() };
            index += 1;
            let named = module.node(read.node).name.clone();
            let data = named.unwrap_or_else(|| taken.fresh(&format!("{}_read{number}", memory.name)));
            let raw = beyond.then(|| RawRead {
                word: taken.fresh(&format!("{data}_word")),
                inside: taken.fresh(&format!("{data}_inside")),
            });
            ReadNames { data, raw }
        }));
    }
    names
}

/// The highest value of a width.
fn highest_value(width: u32) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}

/// The value of a constant address; one of more than 64 bits counts as the largest.
pub fn constant_address(module: &Module, address: NodeId) -> Option<u64> {
    match &module.node(address).op {
        Op::Const(value) => Some(value.to_u64().unwrap_or(u64::MAX)),
        Op::Wire(to) => constant_address(module, *to),
        _ => None,
    }
}

/// Whether the address of a read port can exceed the depth by its width, unless its value is known not to, or the
/// description says that it does not.
pub fn can_exceed(module: &Module, memory: &Memory, address: NodeId) -> bool {
    if memory.in_bounds {
        return false;
    }
    let node = module.node(address);
    let highest = match &node.op {
        Op::Extend { of, signed: false } => highest_value(module.width(*of)),
        _ => highest_value(node.width),
    };
    constant_address(module, address).is_none() && highest >= u64::from(memory.depth)
}
