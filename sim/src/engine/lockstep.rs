//! Two engines side by side, which must agree on everything that has a name, and on covers.

use std::sync::Arc;

use tilewright_circuit::{Bits, limbs_for};

use crate::engine::program::{Memory, Program, Triggers, ValueId, hierarchy};
use crate::engine::reference;
use crate::engine::{Difference, Done, Engine, Failed, Saved, Word};

/// Two engines that run the same circuit.
pub(crate) struct Lockstep {
    program: Arc<Program>,
    reference: reference::Engine,
    other: Box<dyn Engine>,
    /// Every named value, once, in the sequence of the hierarchy, and the counters of covers.
    named: Vec<ValueId>,
    instants: u64,
    /// An input was set since the last comparison.
    touched: bool,
    /// The first difference; after it, neither engine continues.
    found: Option<Box<Difference>>,
}

impl Lockstep {
    /// Both engines at the same start.
    pub fn new(program: Arc<Program>, reference: reference::Engine, other: Box<dyn Engine>) -> Lockstep {
        let mut seen = vec![false; program.circuit.len()];
        let signals = program.hierarchy.scopes.iter().flat_map(|scope| &scope.signals).map(|signal| signal.value);
        let named = signals.chain(program.covers.iter().map(|cover| cover.counter));
        let named: Vec<ValueId> = named.filter(|id| !std::mem::replace(&mut seen[id.index()], true)).collect();
        let mut lockstep = Lockstep { program, reference, other, named, instants: 0, touched: true, found: None };
        lockstep.other.watch(&lockstep.named);
        lockstep
    }

    /// Compares everything, after edges of these clocks, or after none.
    fn compare(&mut self, rising: &[usize]) -> Result<(), Box<Difference>> {
        self.touched = false;
        let compared = self.compare_values(rising).and_then(|()| self.compare_memories(rising));
        compared.inspect_err(|difference| self.found = Some(difference.clone()))
    }

    fn compare_values(&mut self, rising: &[usize]) -> Result<(), Box<Difference>> {
        (0..self.named.len()).try_for_each(|index| self.compare_value(self.named[index], rising))
    }

    fn compare_value(&mut self, id: ValueId, rising: &[usize]) -> Result<(), Box<Difference>> {
        let (reference, other) = (self.reference.read(id), self.other.read(id));
        if reference == other {
            return Ok(());
        }
        let limbs = limbs_for(self.program.value(id).width);
        let lane = (0..reference.len() / limbs)
            .find(|lane| reference[lane * limbs..][..limbs] != other[lane * limbs..][..limbs])
            .expect("some lane differs");
        let bits = |of: &[u64]| Bits::from_limbs(self.program.value(id).width, &of[lane * limbs..][..limbs]);
        let (reference, other) = (bits(reference), bits(other));
        Err(self.difference(self.name(id, lane as u32), rising, reference, other))
    }

    /// Compares the words that the reference engine has written, and others from time to time.
    fn compare_memories(&mut self, rising: &[usize]) -> Result<(), Box<Difference>> {
        let mut words = self.reference.take_written();
        if self.instants.is_multiple_of(ALL_EVERY) {
            let words_of = |(index, memory): (u32, &Memory)| {
                let (lanes, addresses) = (0..memory.lanes, 0..memory.depth.min(COMPARED));
                let words = lanes.flat_map(move |lane| addresses.clone().map(move |address| (lane, address)));
                words.map(move |(lane, address)| Word { memory: index, lane, address })
            };
            words.extend((0..).zip(&self.program.memories).flat_map(words_of));
        }
        words.into_iter().try_for_each(|word| self.compare_word(word, rising))
    }

    fn compare_word(&self, word: Word, rising: &[usize]) -> Result<(), Box<Difference>> {
        let Word { memory, lane, address } = word;
        let (reference, other) = (self.reference.word(memory, lane, address), self.other.word(memory, lane, address));
        if reference == other {
            return Ok(());
        }
        let bits = |limbs: &[u64]| Bits::from_limbs(self.program.memories[memory as usize].width, limbs);
        let mut scopes = self.program.hierarchy.scopes.iter();
        let name = scopes.find_map(|scope| {
            let (name, ..) = scope.memories.iter().find(|(_, index, _)| *index == memory)?;
            Some(format!("{}.{name}[{address}] of lane {lane}", scope.name))
        });
        let name = name.unwrap_or_else(|| format!("memory {memory}, word {address} of lane {lane}"));
        Err(self.difference(name, rising, bits(&reference), bits(&other)))
    }

    fn difference(&self, signal: String, rising: &[usize], reference: Bits, other: Bits) -> Box<Difference> {
        let clocks = rising.iter().map(|&clock| format!("`{}`", self.program.clocks[clock].name)).collect();
        Box::new(Difference { signal, instant: self.instants, clocks, reference, other })
    }

    /// The difference for an assertion that fails on one engine only.
    fn assertion(&self, failed: Failed, on_reference: bool) -> Box<Difference> {
        let assert = &self.program.asserts[failed.assert as usize];
        let hierarchy = &self.program.hierarchy;
        let path = hierarchy.path(hierarchy.instance(&assert.scopes, failed.lane / assert.group));
        let path = if path.is_empty() { &hierarchy.scopes[0].name } else { &path };
        let bit = |holds: bool| Bits::new(1, u64::from(holds));
        self.difference(format!("{path}: {}", assert.message), &[], bit(!on_reference), bit(on_reference))
    }

    /// The first name of a lane of a value.
    fn name(&self, id: ValueId, lane: u32) -> String {
        let hierarchy = &self.program.hierarchy;
        if let Some(cover) = self.program.covers.iter().find(|cover| cover.counter == id) {
            return hierarchy.path_in(hierarchy.instance(&cover.scopes, lane / cover.group), &cover.name);
        }
        let places = (0..self.program.lanes()).flat_map(|run| hierarchy.places(run));
        let names = places.flat_map(|place| {
            let signals = hierarchy.scope(place.scope).signals.iter().filter(move |signal| signal.value == id);
            signals.map(move |signal| (place, signal))
        });
        let mut matching = names.filter(|(place, signal)| place.lane == lane / signal.shape.lanes());
        matching.next().map_or_else(
            || format!("value {}", id.0),
            |(place, signal)| {
                let path = hierarchy.path_in(place, &signal.name);
                let index = hierarchy::index(signal.shape, lane % signal.shape.lanes());
                let run = hierarchy.run(place);
                let run = if self.program.lanes() > 1 { format!(" of run {run}") } else { String::new() };
                format!("{path}{index}{run}")
            },
        )
    }
}

/// The number of unwritten words of a memory that are compared; a difference in others is found when they are read.
const COMPARED: u32 = 64;
/// The number of instants between comparisons of unwritten words.
const ALL_EVERY: u64 = 256;

impl Engine for Lockstep {
    fn versions(&self) -> u64 {
        self.other.versions()
    }

    fn left_out(&self) -> u64 {
        self.other.left_out()
    }

    fn read(&mut self, id: ValueId) -> &[u64] {
        if self.found.is_none() {
            self.found = self.compare_value(id, &[]).err();
        }
        self.reference.read(id)
    }

    fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers) {
        self.touched = true;
        self.reference.write(id, limbs, triggers);
        self.other.write(id, limbs, triggers);
    }

    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        self.reference.word(memory, lane, address)
    }

    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        self.touched = true;
        self.reference.set_word(memory, lane, address, limbs);
        self.other.set_word(memory, lane, address, limbs);
    }

    fn set_reset(&mut self, clock: usize, high: bool) {
        self.touched = true;
        self.reference.set_reset(clock, high);
        self.other.set_reset(clock, high);
    }

    fn restore(&mut self, program: &Program, saved: &Saved) {
        self.touched = true;
        self.reference.restore(program, saved);
        self.other.restore(program, saved);
    }

    fn check(&mut self, rising: &[usize]) -> Vec<Failed> {
        let (failed, other) = (self.reference.check(rising), self.other.check(rising));
        let only = |these: &[Failed], those: &[Failed]| these.iter().copied().find(|it| !those.contains(it));
        if self.found.is_none() {
            let on_reference = only(&failed, &other).map(|it| (it, true));
            let differing = on_reference.or_else(|| only(&other, &failed).map(|it| (it, false)));
            self.found = differing.map(|(it, on_reference)| self.assertion(it, on_reference));
        }
        failed
    }

    fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>> {
        let mut all = Done { edges: 0, changed: Triggers::NONE };
        while all.edges < count {
            let fails = !self.check(rising).is_empty();
            self.agree()?;
            if fails {
                break;
            }
            let done = self.reference.edges(rising, 1)?;
            let other = self.other.edges(rising, 1)?;
            assert_eq!((done.edges, other.edges), (1, 1), "no assertion fails, so the edge happens on both engines");
            all = Done { edges: all.edges + 1, changed: all.changed.with(done.changed) };
            self.instants += 1;
            self.compare(rising)?;
        }
        Ok(all)
    }

    fn agree(&mut self) -> Result<(), Box<Difference>> {
        match &self.found {
            Some(difference) => Err(difference.clone()),
            None if self.touched => self.compare(&[]),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use tilewright_hdl::{Module, bits, block, def, elaborate};

    use super::*;
    use crate::engine::Beginning;
    use crate::engine::program::compile;
    use crate::engine::reference;
    use crate::{Error, Simulation};

    block! {
        /// Stores its input.
        struct Follow;
        in In { x: bits(8) }
        out Out { y: _ }
    }

    impl Follow {
        fn build(&self, m: Module, i: In) -> Out {
            def!(y = m.reg(8).reset(0));
            y.next(i.x);
            m.assert(i.x.ne(99), "nobody says 99");
            Out { y: *y }
        }
    }

    /// Two engines side by side, the second with a different input.
    fn apart(x: u64, other: u64) -> Lockstep {
        let program = Arc::new(compile(&elaborate(&Follow).unwrap(), &crate::Passes::default()));
        let engine = || reference::Engine::new(program.clone(), &Beginning::of(vec![0]));
        let mut lockstep = Lockstep::new(program.clone(), engine(), Box::new(engine()));
        lockstep.write(program.inputs[0].value, &[5], program.inputs[0].triggers);
        lockstep.edges(&[0], 3).unwrap();
        let input = &program.inputs[0];
        lockstep.reference.write(input.value, &[x], input.triggers);
        lockstep.other.write(input.value, &[other], input.triggers);
        lockstep
    }

    #[test]
    fn a_difference_is_named_with_its_clock() {
        let mut lockstep = apart(5, 6);
        let difference = lockstep.edges(&[0], 2).unwrap_err();
        let Difference { signal, instant, clocks, .. } = &*difference;
        assert_eq!((signal.as_str(), *instant, clocks.as_slice()), ("x", 4, ["`clk`".to_owned()].as_slice()));
        assert_eq!(lockstep.edges(&[0], 1), Err(difference), "nothing goes on");
    }

    #[test]
    fn what_follows_from_inputs_is_compared_before_the_edge() {
        let mut lockstep = apart(5, 6);
        lockstep.touched = true;
        let sentence = "the engines differ in `x` after instant 3, before the next edge: the reference engine has 8'h05, \
                        the other one 8'h06: this is a mistake in tilewright, please report the design";
        assert_eq!(lockstep.edges(&[0], 2).unwrap_err().to_string(), sentence);
    }

    #[test]
    fn what_is_read_is_compared() {
        let mut lockstep = apart(5, 6);
        assert_eq!(lockstep.read(lockstep.program.inputs[0].value), [5]);
        assert_eq!(lockstep.agree().unwrap_err().signal, "x");
    }

    #[test]
    fn an_assertion_that_fails_on_one_engine_is_a_difference() {
        for (x, other) in [(99, 5), (5, 99)] {
            let difference = apart(x, other).edges(&[0], 2).unwrap_err();
            assert_eq!(difference.signal, "follow: nobody says 99");
            assert_eq!(
                (difference.reference, difference.other),
                (Bits::new(1, (x == 5).into()), Bits::new(1, (x == 99).into()))
            );
        }
        let done = apart(99, 99).edges(&[0], 2).unwrap();
        assert_eq!(done.edges, 0);
    }

    #[test]
    fn a_simulation_stops_at_a_difference_and_leaves_its_trace() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("follow.vcd");
        for traced in [false, true] {
            let mut sim = Simulation::of(&Follow).unwrap();
            if traced {
                sim.trace(crate::Vcd::to(&file)).unwrap();
            }
            sim.circuit.engine.replace(Box::new(apart(5, 6)));
            let Err(Error::Differs(difference)) = sim.try_run(9) else { panic!("the engines agree") };
            assert_eq!(difference.signal, "x");
            assert!(matches!(sim.finish(), Err(Error::Differs(_))));
        }
        assert!(std::fs::read_to_string(&file).unwrap().contains("$enddefinitions"));
    }
}
