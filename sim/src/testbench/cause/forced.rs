//! States with other values, for tests: what is no cause of a value may be anything.

use tilewright_circuit::Bits;

use super::mask;
use super::names::Names;
use super::operation::Place;
use crate::engine::Saved;
use crate::testbench::checkpoint::Checkpoint;

impl Checkpoint {
    /// The state with other registers, read data and words: `force` gets the name of each, as a
    /// [`Cause`](super::Cause) has it, and its value. Inputs stay.
    #[doc(hidden)]
    pub fn forced(&self, mut force: impl FnMut(&str, &Bits) -> Bits) -> Checkpoint {
        let program = &*self.program;
        let names = Names::new(program);
        let mut limbs = Vec::new();
        let mut other = |place: Place, lane: u32, is_named: bool, value: Bits| {
            let all = mask::all(value.width());
            let name = is_named.then(|| names.show(program, place, lane, &value, &all).name);
            let value = name.map_or_else(|| value.clone(), |name| force(&name, &value));
            limbs.extend_from_slice(value.limbs());
        };
        let is_input = |id| program.inputs.iter().any(|port| port.value == id);
        self.saved.for_each_lane(program, |id, lane, limbs| {
            let is_named = !is_input(id) && names.is_named(program, id, lane);
            other(Place::Value(id), lane, is_named, Bits::from_limbs(program.circuit[id].width, limbs));
        });
        self.saved.for_each_word(program, |memory, lane, address, limbs| {
            let width = program.memories[memory as usize].width;
            other(Place::Word(memory, address), lane, true, Bits::from_limbs(width, limbs));
        });
        let mut forced = self.clone();
        forced.saved = Saved::from_limbs(program, &limbs);
        forced
    }
}
