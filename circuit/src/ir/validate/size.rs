//! Limits on the size of a design: the totals of nested arrays, and the depth of instances.

use crate::bits::limbs_for;
use crate::ir::{Instance, Memory, Module, Node};
use crate::limits::{DEEPEST, MOST_LANES, MOST_LIMBS, MOST_MEMORY_LIMBS};
use crate::loc::Loc;
use crate::mistake::Mistake;
use crate::problem::Problem;

/// The size of a module, including everything in it.
#[derive(Clone, Copy)]
struct Size {
    depth: usize,
    /// Lanes of the value with the most, through nested arrays.
    lanes: u64,
    /// 64-bit limbs of the largest value, in all lanes.
    limbs: u64,
    /// The same for the largest memory.
    memory: u64,
}

pub(super) fn check(modules: &[Module], problems: &mut Vec<Problem>) {
    let mut sizes: Vec<Size> = Vec::with_capacity(modules.len());
    for module in modules {
        let size = size(module, &sizes);
        let mut limit = |what: &str, has: u64, most: u64, loc: Option<Loc>| {
            if has > most {
                let message = format!("`{}` has {what}: {has}, more than {most}", module.name);
                problems.push(Problem::new(Mistake::TooLargeDesign, loc.unwrap_or(module.loc), message).help(SMALLER));
            }
        };
        // The place is the node that is too large by itself; otherwise the total is too large.
        let node =
            |is_large: &dyn Fn(&Node) -> bool| module.nodes.iter().find(|node| is_large(node)).map(|node| node.loc);
        let memory = module.memories.iter().find(|memory| words(memory) > MOST_MEMORY_LIMBS).map(|memory| memory.loc);
        limit("instances nested too deep", size.depth as u64, DEEPEST as u64, None);
        limit("too many lanes", size.lanes, MOST_LANES, node(&|node| lanes(node) > MOST_LANES));
        let value = "a value of too many 64-bit words in all lanes";
        limit(value, size.limbs, MOST_LIMBS, node(&|node| limbs(node) > MOST_LIMBS));
        limit("a memory of too many 64-bit words in all lanes", size.memory, MOST_MEMORY_LIMBS, memory);
        sizes.push(size);
    }
}

const SMALLER: &str = "make it smaller: fewer lanes, fewer instances in arrays, or fewer words";

fn lanes(node: &Node) -> u64 {
    node.shape.lanes().into()
}

fn limbs(node: &Node) -> u64 {
    lanes(node) * limbs_for(node.width) as u64
}

fn words(memory: &Memory) -> u64 {
    let a_lane = u64::from(memory.depth).saturating_mul(limbs_for(memory.width) as u64);
    a_lane.saturating_mul(memory.shape.lanes().into())
}

fn size(module: &Module, below: &[Size]) -> Size {
    let mut size = Size { depth: 1, lanes: 1, limbs: 1, memory: 0 };
    for node in &module.nodes {
        size.lanes = size.lanes.max(lanes(node));
        size.limbs = size.limbs.max(limbs(node));
    }
    size.memory = module.memories.iter().map(words).max().unwrap_or(0);
    for Instance { module, shape, .. } in &module.instances {
        let (child, lanes) = (below[module.0 as usize], u64::from(shape.lanes()));
        size.depth = size.depth.max(child.depth + 1);
        size.lanes = size.lanes.max(child.lanes.saturating_mul(lanes));
        size.limbs = size.limbs.max(child.limbs.saturating_mul(lanes));
        size.memory = size.memory.max(child.memory.saturating_mul(lanes));
    }
    size
}
