//! Signals and memories that are looked at in many clocks: their names are looked up once.

use tilewright_hdl::{Bits, Bundle};

use crate::engine::lane;
use crate::engine::program::ValueId;
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
pub struct Nets(Vec<(ValueId, u32)>);

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
        let hierarchy = &self.circuit.program.hierarchy;
        let net = |path: &str| {
            let Found { signal, lane } = lookup::signal(hierarchy, path, 0)?;
            Ok((signal.value, lane))
        };
        let nets: Vec<_> = paths.into_iter().map(|path| net(path.as_ref())).collect::<Result<_, UnknownName>>()?;
        self.circuit.engine.watch(&nets.iter().map(|(value, _)| *value).collect::<Vec<_>>());
        Ok(Nets(nets))
    }

    /// The settled values of these nets, in the sequence of their names.
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
    /// There are more nets than numbers, or one is wider than 64 bits.
    pub fn numbers(&mut self, nets: &Nets, numbers: &mut [u64]) {
        let circuit = &mut self.circuit;
        assert!(nets.0.len() <= numbers.len(), "{} nets, and room for {} numbers", nets.0.len(), numbers.len());
        for (number, (value, at)) in numbers.iter_mut().zip(&nets.0) {
            *number = match circuit.program.value(*value).width {
                0..=64 => circuit.engine.number(*value, *at),
                _ => lane(&circuit.program, &mut *circuit.engine, *value, *at)
                    .to_u64()
                    .expect("a net of 64 bits or less"),
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
        Bits::from_limbs(layout.width, &self.circuit.engine.word(index, lane, address))
    }
}
