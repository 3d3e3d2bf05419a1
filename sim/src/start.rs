//! Which state a reset leaves alone.

use std::collections::BTreeSet;

use tilewright_hdl::ir::Contents;

use crate::program::Program;
use crate::program::hierarchy::Role;

/// The paths of registers without a reset value (and of synchronous read data), and of memories of unknown contents.
pub(crate) fn unset(program: &Program) -> (Vec<String>, Vec<String>) {
    let with_reset: BTreeSet<_> =
        program.registers.iter().filter(|register| register.reset.is_some()).map(|register| register.value).collect();
    let (mut registers, mut memories) = (Vec::new(), Vec::new());
    for place in program.hierarchy.places() {
        let scope = program.hierarchy.scope(place.scope);
        for signal in &scope.signals {
            let is_state = matches!(signal.role, Role::Register | Role::ReadData);
            if is_state && !with_reset.contains(&signal.value) {
                registers.push(program.hierarchy.path_in(place, &signal.name));
            }
        }
        for (name, index) in &scope.memories {
            if program.memories[*index as usize].contents == Contents::Unknown {
                memories.push(program.hierarchy.path_in(place, name));
            }
        }
    }
    (registers, memories)
}
