//! Loops that are too long for one function of machine code.
//!
//! Cranelift's time to allocate registers grows with the square of the scalars that a function uses. So the independent
//! parts of a long loop become loops of their own, which several functions share.

use super::parts::{Part, ordered, parts, places};
use super::{Kernel, Plan, Stage};
use crate::engine::function::Function;

/// Divides loops of more than `most` operations where they have independent parts.
pub(super) fn divide(function: &Function, plan: &mut Plan, most: usize) {
    let mut stages = Vec::new();
    for mut stage in std::mem::take(&mut plan.stages) {
        if stage.kernels.values().all(|kernel| kernel.operations() <= most) {
            stages.push(stage);
            continue;
        }
        let mut loops = Vec::new();
        for (lanes, kernel) in stage.loops() {
            let divided = divided(function, plan, kernel, most).into_iter();
            loops.extend(divided.map(|kernel| Stage { kernels: [(lanes, kernel)].into(), ..Stage::default() }));
        }
        stage.kernels.clear();
        stages.push(stage);
        stages.extend(loops);
    }
    plan.stages = stages;
}

/// The loops that run instead of one, in sequence.
fn divided(function: &Function, plan: &Plan, kernel: &Kernel, most: usize) -> Vec<Kernel> {
    let places = places(kernel);
    let mut joined: Vec<Part> = Vec::new();
    for part in ordered(parts(function, plan, kernel, &places)) {
        match joined.last_mut() {
            Some(last) if last.operations() + part.operations() <= most => last.join(part),
            _ => joined.push(part),
        }
    }
    joined.iter().map(|part| part.kernel(function, kernel, &places)).collect()
}
