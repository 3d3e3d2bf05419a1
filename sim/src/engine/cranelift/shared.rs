//! Code that simulations of one circuit share: to make it takes most of the time that each of them needs to begin.

use std::hash::{Hash, Hasher};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use rustc_hash::{FxHashMap, FxHasher};

use super::jit::Made;
use super::target::Unsupported;
use crate::engine::strips::Program;

/// The functions whose programs have one hash.
type Alike = Vec<(Program, Arc<Made>)>;

/// The functions of simulations of one circuit, by their programs.
#[derive(Default)]
pub(crate) struct SharedCode {
    /// There are several simulations. One alone makes nothing twice, and so keeps nothing here.
    is_shared: AtomicBool,
    functions: Mutex<FxHashMap<u64, Alike>>,
}

impl SharedCode {
    /// There will be another simulation of the circuit.
    pub fn share(&self) {
        self.is_shared.store(true, Ordering::Relaxed);
    }

    /// Whether there are several simulations.
    pub fn is_shared(&self) -> bool {
        self.is_shared.load(Ordering::Relaxed)
    }

    /// The code of this program, which `make` makes if nobody has. Simulations on several threads wait for each
    /// other, as they mostly need the same functions.
    ///
    /// # Errors
    ///
    /// Those of `make`.
    pub(in crate::engine) fn find_or_make(
        &self,
        program: Program,
        make: impl FnOnce(&Program) -> Result<Made, Unsupported>,
    ) -> Result<Arc<Made>, Unsupported> {
        let mut hasher = FxHasher::default();
        program.hash(&mut hasher);
        // A function is entered when it is complete, so a panic leaves nothing half done.
        let mut functions = self.functions.lock().unwrap_or_else(PoisonError::into_inner);
        let alike = functions.entry(hasher.finish()).or_default();
        if let Some((_, made)) = alike.iter().find(|(other, _)| *other == program) {
            return Ok(made.clone());
        }
        let made = Arc::new(make(&program)?);
        alike.push((program, made.clone()));
        Ok(made)
    }

    /// How many functions simulations share.
    #[cfg(test)]
    pub fn len(&self) -> usize {
        self.functions.lock().unwrap_or_else(PoisonError::into_inner).values().map(Vec::len).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::jit::Jit;
    use super::*;
    use crate::engine::strips::Type;

    /// Makes a function that returns this number.
    fn add_function(jit: &mut Jit, number: i64) {
        jit.function(|b, _, _| {
            let number = b.constant(Type::ADDRESS, number);
            b.give(number);
        });
    }

    #[test]
    fn what_is_made_of_the_same_is_made_once() {
        let shared = Arc::new(SharedCode::default());
        let mut jits = [(); 2].map(|()| Jit::new().unwrap().sharing(shared.clone()));
        add_function(&mut jits[0], 7);
        assert_eq!(shared.len(), 0, "one alone keeps nothing");
        shared.share();
        for (number, functions) in [(7, 1), (8, 2)] {
            jits.iter_mut().for_each(|jit| add_function(jit, number));
            assert_eq!(shared.len(), functions);
        }
    }
}
