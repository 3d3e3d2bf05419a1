//! Selects arrays that run instance by instance: those of machines that are arrays themselves.
//!
//! Instances of an array run in lanes, all of them at every edge. An instance whose values have many lanes of its
//! own, and that makes many scalar decisions, gains nothing by that; and idle ones cost as much as busy ones. So each
//! runs by itself, as a *unit*, and the compiled engine skips units that have nothing to do (`running/units`).

use std::collections::BTreeSet;

use tilewright_circuit::ir::{Design, Module};

use super::flatten::Key;
use super::instances::key_of;
use crate::engine::Passes;

/// The most units of an array, because each has code of its own.
const MOST: u32 = 64;
/// The most operations of all units of an array together.
const OPERATIONS: usize = 200_000;

/// The arrays whose instances run separately.
pub(super) fn arrays(design: &Design, passes: &Passes) -> BTreeSet<Key> {
    let mut found = BTreeSet::new();
    let sizes = sizes(design);
    enter(design, design.top(), &Key::new(), &sizes, passes, &mut found);
    found
}

/// The size of a module, including everything in it.
#[derive(Debug, Clone, Copy, Default)]
struct Size {
    /// The most lanes of a value.
    lanes: u32,
    /// Operations on scalars.
    single: usize,
    /// All operations.
    all: usize,
}

/// The size of each module of a design.
fn sizes(design: &Design) -> Vec<Size> {
    let mut sizes: Vec<Size> = Vec::new();
    for module in design.modules() {
        let mut size = Size { lanes: 1, ..Size::default() };
        for node in &module.nodes {
            size.lanes = size.lanes.max(node.shape.lanes());
            size.single += usize::from(node.shape.is_plain());
            size.all += 1;
        }
        for instance in &module.instances {
            // Modules precede those that contain them.
            let inside = sizes[instance.module.0 as usize];
            size.lanes = size.lanes.max(inside.lanes.saturating_mul(instance.shape.lanes()));
            size.single += if instance.shape.is_plain() { inside.single } else { 0 };
            size.all += inside.all;
        }
        sizes.push(size);
    }
    sizes
}

/// Visits a module with one instance, and the single instances in it.
fn enter(design: &Design, module: &Module, key: &Key, sizes: &[Size], passes: &Passes, found: &mut BTreeSet<Key>) {
    for instance in &module.instances {
        let (key, count) = (key_of(key, instance), instance.shape.lanes());
        let Size { lanes, single, all } = sizes[instance.module.0 as usize];
        match instance.shape.is_plain() {
            true => enter(design, design.module(instance.module), &key, sizes, passes, found),
            false => {
                let is_few = (2..=MOST).contains(&count) && all.saturating_mul(count as usize) <= OPERATIONS;
                if is_few && lanes >= passes.apart_from && single >= passes.apart_single {
                    found.insert(key);
                }
            }
        }
    }
}
