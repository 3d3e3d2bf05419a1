//! The passes on a function before code is made of it.

use super::Plan;
use super::sequence::{self, Step};
use super::{branch, divide, quiet};
use crate::engine::function::{Became, Function};
use crate::engine::function::{demands, lower};
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::{Passes, Target};

/// A function in sequence.
pub(crate) struct Planned {
    pub function: Function,
    pub plan: Plan,
    /// The steps of each piece that it is cut into.
    pub pieces: Vec<Vec<Step>>,
}

/// The result of a pass, for observers.
pub(crate) enum Seen<'a> {
    /// The machine operations, and the values in them of the function before.
    Lowered(&'a Function, &'a Became),
    Planned(&'a Function, &'a Plan),
    Branched(&'a Function, &'a Plan),
    Sequenced(&'a Function, &'a Plan, &'a [Vec<Step>]),
}

/// A loop may be this many times longer than a function of scalars: few of its values are live at a time.
const LONG_LOOP: usize = 8;

/// Plans a function.
pub(crate) fn plan(
    function: &Function,
    strips: &StripSizes,
    memories: &[MemoryAt],
    passes: &Passes,
    look: &mut dyn FnMut(Seen),
) -> Planned {
    let (mut function, became) = lower::lower(function, strips, memories, passes);
    demands::check_lowered(&function, strips, memories);
    look(Seen::Lowered(&function, &became));
    let far: Vec<bool> = memories.iter().map(|at| !at.words.together() && at.words.size > passes.near).collect();
    let mut plan = Plan::new(&function, &far, passes.postpone);
    divide::divide(&function, &mut plan, passes.longest.saturating_mul(LONG_LOOP));
    look(Seen::Planned(&function, &plan));
    if passes.branch && passes.target != Target::Functions {
        quiet::quiet(&mut function, &mut plan, strips);
        branch::branch(&mut function, &mut plan, strips, passes);
    }
    look(Seen::Branched(&function, &plan));
    let pieces = sequence::sequence(&mut function, &mut plan, passes.longest);
    look(Seen::Sequenced(&function, &plan, &pieces));
    Planned { function, plan, pieces }
}
