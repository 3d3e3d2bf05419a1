//! Two engines side by side, which must agree on everything that has a name.

use std::fmt;
use std::sync::Arc;

use tilewright_hdl::{Bits, limbs_for};

use crate::engine::{Done, Engine, Failed};
use crate::program::{Program, Triggers, ValueId};

/// Where two engines first differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// The signal's hierarchical name, or that of a memory with the address.
    pub signal: String,
    /// How many instants had passed.
    pub instant: u64,
    /// The clocks that rose.
    pub clocks: Vec<String>,
    /// What the reference engine has.
    pub reference: Bits,
    /// What the other one has.
    pub other: Bits,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Difference { signal, instant, clocks, reference, other } = self;
        write!(
            f,
            "the engines differ in `{signal}` after instant {instant}, an edge of {}: the reference engine has \
             {reference:?}, the other one {other:?}: this is a mistake in tilewright, please report the design",
            clocks.join(" and ")
        )
    }
}

impl std::error::Error for Difference {}

/// Two engines that do the same.
pub(crate) struct Lockstep {
    program: Arc<Program>,
    reference: Box<dyn Engine>,
    other: Box<dyn Engine>,
    /// Every value that has a name, once, in the order of the hierarchy.
    named: Vec<ValueId>,
    instants: u64,
}

impl Lockstep {
    /// Both at the same start.
    pub fn new(program: Arc<Program>, reference: Box<dyn Engine>, other: Box<dyn Engine>) -> Lockstep {
        let mut seen = vec![false; program.values.len()];
        let signals = program.hierarchy.scopes.iter().flat_map(|scope| &scope.signals).map(|signal| signal.value);
        let named: Vec<ValueId> = signals.filter(|id| !std::mem::replace(&mut seen[id.index()], true)).collect();
        let mut lockstep = Lockstep { program, reference, other, named, instants: 0 };
        lockstep.other.watch(&lockstep.named);
        lockstep
    }

    /// The first value that differs.
    fn compare(&mut self, rising: &[usize]) -> Result<(), Box<Difference>> {
        for &id in &self.named {
            let (reference, other) = (self.reference.read(id), self.other.read(id));
            if reference != other {
                let limbs = limbs_for(self.program.value(id).width);
                let lane = (0..reference.len() / limbs)
                    .find(|lane| reference[lane * limbs..][..limbs] != other[lane * limbs..][..limbs])
                    .expect("some lane differs");
                let bits = |of: &[u64]| Bits::from_limbs(self.program.value(id).width, &of[lane * limbs..][..limbs]);
                let (reference, other) = (bits(reference), bits(other));
                return Err(self.difference(self.name(id, lane as u32), rising, reference, other));
            }
        }
        self.compare_memories(rising)
    }

    fn compare_memories(&self, rising: &[usize]) -> Result<(), Box<Difference>> {
        for scope in &self.program.hierarchy.scopes {
            for (name, index) in &scope.memories {
                let memory = &self.program.memories[*index as usize];
                for lane in 0..memory.lanes {
                    for address in 0..memory.depth.min(COMPARED) {
                        let word = |engine: &dyn Engine| engine.word(*index, lane, address);
                        let (reference, other) = (word(&*self.reference), word(&*self.other));
                        if reference != other {
                            let bits = |limbs: &[u64]| Bits::from_limbs(memory.width, limbs);
                            let name = format!("{}.{name}[{address}] of lane {lane}", scope.name);
                            return Err(self.difference(name, rising, bits(&reference), bits(&other)));
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn difference(&self, signal: String, rising: &[usize], reference: Bits, other: Bits) -> Box<Difference> {
        let clocks = rising.iter().map(|&clock| format!("`{}`", self.program.clocks[clock].name)).collect();
        Box::new(Difference { signal, instant: self.instants, clocks, reference, other })
    }

    /// The first name of a lane of a value.
    fn name(&self, id: ValueId, lane: u32) -> String {
        let hierarchy = &self.program.hierarchy;
        let places = (0..self.program.lanes()).flat_map(|run| hierarchy.places(run));
        let names = places.flat_map(|place| {
            let signals = hierarchy.scope(place.scope).signals.iter().filter(move |signal| signal.value == id);
            signals.map(move |signal| (place, signal))
        });
        let mut matching = names.filter(|(place, signal)| place.lane == lane / signal.group.unwrap_or(1));
        matching.next().map_or_else(
            || format!("value {}", id.0),
            |(place, signal)| {
                let path = hierarchy.path_in(place, &signal.name);
                let index = signal.group.map(|group| format!("[{}]", lane % group)).unwrap_or_default();
                let run = hierarchy.run(place);
                let run = if self.program.lanes() > 1 { format!(" of run {run}") } else { String::new() };
                format!("{path}{index}{run}")
            },
        )
    }
}

/// How many words of a memory are compared after each edge; the rest shows when it is read.
const COMPARED: u32 = 64;

impl Engine for Lockstep {
    fn read(&mut self, id: ValueId) -> &[u64] {
        self.reference.read(id)
    }

    fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers) {
        self.reference.write(id, limbs, triggers);
        self.other.write(id, limbs, triggers);
    }

    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        self.reference.word(memory, lane, address)
    }

    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        self.reference.set_word(memory, lane, address, limbs);
        self.other.set_word(memory, lane, address, limbs);
    }

    fn set_reset(&mut self, clock: usize, high: bool) {
        self.reference.set_reset(clock, high);
        self.other.set_reset(clock, high);
    }

    fn check(&mut self, rising: &[usize]) -> Vec<Failed> {
        let failed = self.reference.check(rising);
        assert_eq!(failed, self.other.check(rising), "the engines differ in what assertions fail");
        failed
    }

    fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>> {
        let mut all = Done { edges: 0, changed: Triggers::NONE };
        while all.edges < count {
            let done = self.reference.edges(rising, 1)?;
            assert_eq!(self.other.edges(rising, 1)?.edges, done.edges, "the engines differ in what assertions fail");
            if done.edges == 0 {
                break;
            }
            all = Done { edges: all.edges + 1, changed: all.changed.with(done.changed) };
            self.instants += 1;
            self.compare(rising)?;
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use tilewright_hdl::{Block, Module, Width, bits, bundle, elaborate};

    use super::*;
    use crate::program::compile;
    use crate::reference;

    bundle! {
        pub struct In<T> { pub x: T }
        pub struct Out<T> { pub y: T }
    }

    /// Takes over its input.
    #[derive(Debug)]
    struct Follow;

    impl Block for Follow {
        type In = In;
        type Out = Out;

        fn inputs(&self) -> In<Width> {
            In { x: bits(8) }
        }

        fn build(&self, m: Module, i: In) -> Out {
            let y = m.reg("y", 8).reset(0);
            y.next(i.x);
            Out { y: y.value() }
        }
    }

    #[test]
    fn a_difference_is_named_with_its_clock() {
        let program = Arc::new(compile(&elaborate(&Follow).unwrap()).unwrap());
        let engine = || Box::new(reference::Engine::new(program.clone(), 0));
        let mut lockstep = Lockstep::new(program.clone(), engine(), engine());
        let x = program.inputs[0].value;
        lockstep.write(x, &[5], program.inputs[0].triggers);
        lockstep.edges(&[0], 3).unwrap();
        lockstep.other.write(x, &[6], program.inputs[0].triggers);
        let difference = lockstep.edges(&[0], 2).unwrap_err();
        let Difference { signal, instant, clocks, .. } = &*difference;
        assert_eq!((signal.as_str(), *instant, clocks.as_slice()), ("x", 4, ["`clk`".to_owned()].as_slice()));
    }
}
