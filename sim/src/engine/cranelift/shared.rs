//! Code that simulations of one circuit share: to make it takes most of the time that each of them needs to begin.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use rustc_hash::{FxHashMap, FxHashSet};

use super::jit::Made;
use super::target::Unsupported;
use crate::engine::strips::Program;

/// The functions of simulations of one circuit, by their programs.
#[derive(Default)]
pub(crate) struct SharedCode {
    /// There are several simulations. One alone makes nothing twice, and so keeps nothing here.
    is_shared: AtomicBool,
    functions: Mutex<FxHashMap<Program, Arc<Made>>>,
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

    /// The code of these programs; `make` makes what nobody has made yet. Simulations on several threads wait for each
    /// other, as they mostly need the same functions.
    ///
    /// # Errors
    ///
    /// Those of `make`.
    pub(in crate::engine) fn find_or_make(
        &self,
        programs: &[Program],
        make: impl FnOnce(&[&Program]) -> Result<Vec<Made>, Unsupported>,
    ) -> Result<Vec<Arc<Made>>, Unsupported> {
        // Functions are entered when they are complete, so a panic leaves nothing half done.
        let mut functions = self.functions.lock().unwrap_or_else(PoisonError::into_inner);
        let new: FxHashSet<&Program> = programs.iter().filter(|program| !functions.contains_key(program)).collect();
        let new: Vec<&Program> = new.into_iter().collect();
        let made = make(&new)?.into_iter().map(Arc::new);
        functions.extend(new.into_iter().cloned().zip(made));
        Ok(programs.iter().map(|program| functions[program].clone()).collect())
    }

    /// How many functions simulations share.
    #[cfg(test)]
    pub fn len(&self) -> usize {
        self.functions.lock().unwrap_or_else(PoisonError::into_inner).len()
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
