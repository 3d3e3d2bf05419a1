//! Signals and memories by name: reading and replacing their values.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::Kind;
use tilewright_hdl::{Bundle, Codes};

use crate::engine::Word;
use crate::engine::program::Triggers;
use crate::testbench::error::UnknownName;
use crate::testbench::lookup::{self, Found};
use crate::testbench::past::Change;
use crate::testbench::port::IntoValue;
use crate::testbench::running::Running;
use crate::testbench::simulation::Simulation;

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// The settled value of any named object, such as `u_cell[3].sum`: a port, a register, a named net, or the data
    /// of a synchronous memory read.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(3);
    /// assert_eq!(sim.peek("late")?, 2); // not a port
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such name; the error suggests the nearest one.
    pub fn peek(&mut self, path: &str) -> Result<Bits, UnknownName> {
        self.circuit.peek(path, 0)
    }

    /// The settled value of a named object as a code of an enum, such as the state of a machine.
    ///
    /// ```
    /// use tilewright_hdl::*;
    /// use tilewright_sim::Simulation;
    ///
    /// codes! { enum Pump { Fill, Drain } }
    ///
    /// block! {
    ///     /// Fills and drains.
    ///     struct Pumps;
    ///     in PumpsIn { go: bit() }
    ///     out PumpsOut { drains: bit() }
    /// }
    ///
    /// impl Pumps {
    ///     fn build(&self, m: Module, i: PumpsIn) -> PumpsOut {
    ///         def!(pump = m.fsm(Pump::Fill));
    ///         pump.next(|pump| match pump {
    ///             Pump::Fill => when(i.go, Pump::Drain),
    ///             Pump::Drain => goto(Pump::Fill),
    ///         });
    ///         PumpsOut { drains: pump.is(Pump::Drain) }
    ///     }
    /// }
    ///
    /// let mut sim = Simulation::of(&Pumps)?;
    /// assert_eq!(sim.code::<Pump>("pump")?, Pump::Fill);
    /// sim.set(sim.i.go, 1);
    /// sim.step();
    /// assert_eq!(sim.code::<Pump>("pump")?, Pump::Drain);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such name; the error suggests the nearest one.
    ///
    /// # Panics
    ///
    /// The object is no code of that enum, or its value is none of the codes.
    #[track_caller]
    pub fn code<C: Codes>(&mut self, path: &str) -> Result<C, UnknownName> {
        let (kind, value) = self.circuit.peek_kind(path)?;
        let of = C::NAMES.of;
        assert!(kind == Kind::Code(C::NAMES), "`{path}` is {kind}, not a code of `{of}`");
        let Some(code) = value.to_u64().and_then(C::from_number) else {
            panic!("`{path}` is {value}, which is no code of `{of}`")
        };
        Ok(code)
    }

    /// A word of a memory.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// assert_eq!(sim.peek_memory("squares", 5)?, 25);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such memory.
    ///
    /// # Panics
    ///
    /// The address is beyond its depth.
    #[track_caller]
    pub fn peek_memory(&self, path: &str, address: u32) -> Result<Bits, UnknownName> {
        self.circuit.peek_word(path, 0, address)
    }

    /// All words of a memory, from address 0 on.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let sim = Simulation::of(&Counter)?;
    /// let squares = sim.peek_words("squares")?;
    /// assert!((0..).zip(&squares).all(|(number, square)| *square == number * number));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such memory.
    pub fn peek_words(&self, path: &str) -> Result<Vec<Bits>, UnknownName> {
        self.circuit.peek_words(path, 0)
    }

    /// Replaces a word of a memory immediately.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.poke_memory("squares", 0, 99)?;
    /// assert_eq!(sim.get(sim.o.square), 99); // an asynchronous read sees it immediately
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such memory.
    ///
    /// # Panics
    ///
    /// The address is beyond its depth, the value does not fit, or the first step of a recording is over. Words poked
    /// before the first step are part of the recording's start.
    #[track_caller]
    pub fn poke_memory(&mut self, path: &str, address: u32, value: impl IntoValue) -> Result<(), UnknownName> {
        self.circuit.poke_word(path, 0, address, value)
    }
}

impl Running {
    /// The value of a named object in one run.
    pub fn peek(&mut self, path: &str, run: u32) -> Result<Bits, UnknownName> {
        let (value, lane) = match self.peeked.get(&run).and_then(|names| names.get(path)) {
            Some(known) => *known,
            None => {
                let Found { signal, lane } = lookup::signal(&self.program.hierarchy, path, run)?;
                let found = (signal.value, lane);
                self.peeked.entry(run).or_default().insert(path.to_owned(), found);
                found
            }
        };
        Ok(self.lane(value, lane))
    }

    /// The meaning and the value of a named object.
    pub fn peek_kind(&mut self, path: &str) -> Result<(Kind, Bits), UnknownName> {
        let kind = lookup::signal(&self.program.hierarchy, path, 0)?.signal.kind;
        Ok((kind, self.peek(path, 0)?))
    }

    /// A word of a memory in one run.
    #[track_caller]
    pub fn peek_word(&self, path: &str, run: u32, address: u32) -> Result<Bits, UnknownName> {
        let (memory, lane) = self.memory(path, run, address)?;
        Ok(self.word_of(memory, lane, address))
    }

    /// A word of a lane of a memory.
    pub fn word_of(&self, memory: u32, lane: u32, address: u32) -> Bits {
        match self.program.memories[memory as usize].width {
            width @ ..=64 => Bits::new(width, self.engine.short_word(memory, lane, address)),
            width => Bits::from_limbs(width, &self.engine.word(memory, lane, address)),
        }
    }

    /// All words of a memory in one run.
    pub fn peek_words(&self, path: &str, run: u32) -> Result<Vec<Bits>, UnknownName> {
        let (memory, lane) = self.memory(path, run, 0)?;
        let layout = &self.program.memories[memory as usize];
        Ok((0..layout.depth).map(|address| self.word_of(memory, lane, address)).collect())
    }

    /// Replaces a word of a memory in one run.
    #[track_caller]
    pub fn poke_word(&mut self, path: &str, run: u32, address: u32, value: impl IntoValue) -> Result<(), UnknownName> {
        let (memory, lane) = self.memory(path, run, address)?;
        let is_start = self.timeline.time() == 0;
        assert!(
            is_start || !self.recorded.contains(&run),
            "`{path}` is poked after the first step of a recording, which could not be repeated: poke before that, or write through the ports"
        );
        match value.into_value(self.program.memories[memory as usize].width) {
            Ok(bits) => {
                self.note(|| Change::Word(Box::new(([memory, lane, address], bits.limbs().to_vec()))));
                self.engine.set_word(memory, lane, address, bits.limbs());
                self.changed = Triggers::ALL;
                if is_start {
                    self.poked.add(Word { memory, lane, address });
                }
            }
            Err(problem) => panic!("a word of `{path}` {problem}"),
        }
        Ok(())
    }

    #[track_caller]
    fn memory(&self, path: &str, run: u32, address: u32) -> Result<(u32, u32), UnknownName> {
        let (memory, lane) = lookup::memory(&self.program.hierarchy, path, run)?;
        let depth = self.program.memories[memory as usize].depth;
        assert!(address < depth, "address {address} of memory `{path}`, which has {depth} words");
        Ok((memory, lane))
    }
}
