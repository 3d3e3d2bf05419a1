//! Signals and memories that are looked at in many clocks: their names are looked up once.

use tilewright_circuit::Bits;
use tilewright_hdl::Bundle;

use crate::engine::{Limb, Limbs};
use crate::testbench::error::UnknownName;
use crate::testbench::lookup::{self, Found};
use crate::testbench::simulation::Simulation;

/// Named signals of a circuit, for [`Simulation::numbers`].
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let nets: tilewright_sim::Nets = sim.nets(["count"])?;
/// let mut numbers = [7];
/// sim.numbers(&nets, &mut numbers);
/// assert_eq!(numbers, [0]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Nets(Limbs);

impl Nets {
    /// The numbers that they take together.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// assert_eq!(sim.nets(["count", "late"])?.count(), 2);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The bits of one of these numbers.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// assert_eq!(sim.nets(["enable", "count"])?.width(1), 8);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There are fewer numbers.
    pub fn width(&self, number: usize) -> u32 {
        self.0[number].width
    }
}

/// A memory of a circuit, for [`Simulation::word`].
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let sim = Simulation::of(&Counter)?;
/// let squares: tilewright_sim::Memory = sim.memory("squares")?;
/// assert_eq!(sim.word(squares, 3), 9);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Memory {
    index: u32,
    lane: u32,
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Looks up names as [`Simulation::peek`] does, and prepares for reading them together in many clocks.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let nets = sim.nets(["count", "late"])?;
    /// sim.set(sim.i.enable, 1);
    /// let mut numbers = [0; 2];
    /// for clock in 0..3 {
    ///     sim.numbers(&nets, &mut numbers);
    ///     assert_eq!(numbers[0], clock);
    ///     sim.step();
    /// }
    /// assert_eq!(numbers, [2, 1]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such name; the error suggests the nearest one.
    pub fn nets(&mut self, paths: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Nets, UnknownName> {
        let program = &self.circuit.program;
        let mut limbs = Vec::new();
        for path in paths {
            let Found { signal, lane } = lookup::signal(&program.hierarchy, path.as_ref(), 0)?;
            let value = signal.value;
            let bits = program.value(value).width;
            let limb = |number: u32| Limb { value, lane, number, width: (bits - 64 * number).min(64) };
            limbs.extend((0..bits.div_ceil(64)).map(limb));
        }
        Ok(Nets(limbs.into()))
    }

    /// The settled values of these nets, in the sequence of their names. One of more than 64 bits takes as many numbers as it needs, the lowest bits
    /// first.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let nets = sim.nets(["enable", "count"])?;
    /// sim.set(sim.i.enable, 1);
    /// sim.step();
    /// let mut numbers = [0; 2];
    /// sim.numbers(&nets, &mut numbers);
    /// assert_eq!(numbers, [1, 1]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There are fewer numbers than the nets take.
    pub fn numbers(&mut self, nets: &Nets, numbers: &mut [u64]) {
        let (circuit, count) = (&mut self.circuit, nets.count());
        assert!(count <= numbers.len(), "nets of {count} numbers, and room for {}", numbers.len());
        if circuit.engine.glance(&nets.0, numbers) {
            return;
        }
        for (number, limb) in numbers.iter_mut().zip(nets.0.iter()) {
            *number = match circuit.program.value(limb.value).width {
                0..=64 => circuit.engine.number(limb.value, limb.lane),
                _ => circuit.lane(limb.value, limb.lane).limbs()[limb.number as usize],
            };
        }
    }

    /// Looks up the name of a memory, which is read in many clocks.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let sim = Simulation::of(&Counter)?;
    /// let squares = sim.memory("squares")?;
    /// assert_eq!(sim.word(squares, 12), 144);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such memory.
    pub fn memory(&self, path: &str) -> Result<Memory, UnknownName> {
        let (index, lane) = lookup::memory(&self.circuit.program.hierarchy, path, 0)?;
        Ok(Memory { index, lane })
    }

    /// A word of a memory.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let sim = Simulation::of(&Counter)?;
    /// let squares = sim.memory("squares")?;
    /// assert_eq!(sim.word(squares, 5), 25);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The address is beyond its depth.
    #[track_caller]
    pub fn word(&self, memory: Memory, address: u32) -> Bits {
        let Memory { index, lane } = memory;
        let layout = &self.circuit.program.memories[index as usize];
        assert!(address < layout.depth, "address {address} of a memory of {} words", layout.depth);
        self.circuit.word_of(index, lane, address)
    }
}
