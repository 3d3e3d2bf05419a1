//! A checkpoint as a file: two lines of text, then numbers of 64 bits, where each run of zeros is one count.

use std::io::{Read, Write};

use tilewright_hdl::Bundle;

use crate::engine::{Saved, fingerprint, for_each_width, state_limbs};
use crate::testbench::checkpoint::{Checkpoint, CheckpointError};
use crate::testbench::running::Running;
use crate::testbench::simulation::Simulation;

/// What a file begins with.
const MAGIC: &str = "tilewright checkpoint, format ";
/// It changes with what follows.
const FORMAT: u32 = 1;

impl Checkpoint {
    /// Writes it to a file, or to anything else. [`Checkpoint::read`] reads it.
    ///
    /// ```
    /// # use tilewright_sim::{Checkpoint, Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.run(3);
    /// let (saved, mut file) = (sim.checkpoint(), Vec::new());
    /// saved.write(&mut file).unwrap();
    /// assert_eq!(Checkpoint::read(&file[..], &sim).unwrap(), saved);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Those of `to`.
    pub fn write(&self, mut to: impl Write) -> std::io::Result<()> {
        let numbers = self.numbers();
        let mut bytes = format!("{MAGIC}{FORMAT}\n{} {:016x}\n", self.top(), fingerprint(&self.program)).into_bytes();
        let packed = pack(&numbers);
        packed.iter().chain([&check(&packed)]).for_each(|number| bytes.extend(number.to_le_bytes()));
        to.write_all(&bytes)
    }

    /// Reads what [`Checkpoint::write`] has written, for a simulation of the same design.
    ///
    /// ```
    /// # use tilewright_sim::{Checkpoint, Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let newer = Checkpoint::read(&b"tilewright checkpoint, format 99\n"[..], &sim).unwrap_err();
    /// assert_eq!(newer.to_string(), "the checkpoint has format 99, and this version reads format 1: make it again");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// It is no checkpoint, has another format, is of another design, or is damaged.
    pub fn read<I: Bundle, O: Bundle>(
        mut from: impl Read,
        sim: &Simulation<I, O>,
    ) -> Result<Checkpoint, CheckpointError> {
        let mut bytes = Vec::new();
        from.read_to_end(&mut bytes)?;
        let rest = bytes.strip_prefix(MAGIC.as_bytes()).ok_or(CheckpointError::NoCheckpoint)?;
        let (format, rest) = line(rest)?;
        if format != FORMAT.to_string() {
            return Err(CheckpointError::OtherFormat { found: format.to_owned(), expected: FORMAT });
        }
        let (design, rest) = line(rest)?;
        let program = &sim.circuit.program;
        let expected = format!("{} {:016x}", program.hierarchy.scopes[0].name, fingerprint(program));
        if design != expected {
            let top = |line: &str| line.split(' ').next().unwrap_or_default().to_owned();
            return Err(CheckpointError::OtherDesign { found: top(design), expected: top(&expected) });
        }
        let (numbers, []) = rest.as_chunks::<8>() else { return Err(CheckpointError::Damaged) };
        let numbers: Vec<u64> = numbers.iter().map(|bytes| u64::from_le_bytes(*bytes)).collect();
        let (&sum, packed) = numbers.split_last().ok_or(CheckpointError::Damaged)?;
        if check(packed) != sum {
            return Err(CheckpointError::Damaged);
        }
        let numbers = unpack(packed, sim.circuit.count_numbers()).ok_or(CheckpointError::Damaged)?;
        sim.circuit.checkpoint_of(&numbers)
    }

    /// All that it has, as numbers; for a design, there are always as many.
    fn numbers(&self) -> Vec<u64> {
        let mut numbers = self.timeline.cycles_of_all();
        numbers.extend(self.resets.iter().flat_map(|(is_active, since)| [u64::from(*is_active), *since]));
        numbers.extend(self.covers.iter().flatten().flatten());
        numbers.extend(self.saved.limbs());
        numbers
    }
}

impl Running {
    /// How many numbers a checkpoint has.
    fn count_numbers(&self) -> usize {
        let covers = self.in_reset.iter().map(Vec::len).sum::<usize>();
        self.timeline.cycles_of_all().len() + 2 * self.resets.len() + 2 * covers + state_limbs(&self.program)
    }

    /// A checkpoint of these numbers.
    fn checkpoint_of(&self, numbers: &[u64]) -> Result<Checkpoint, CheckpointError> {
        let mut left = numbers;
        let mut take = |count: usize| left.split_off(..count).ok_or(CheckpointError::Damaged);
        let timeline = self.timeline.with_cycles(take(self.timeline.cycles_of_all().len())?);
        let timeline = timeline.ok_or(CheckpointError::Damaged)?;
        let resets = take(2 * self.resets.len())?.as_chunks::<2>().0.iter();
        let resets = resets.map(|[is_active, since]| (*is_active != 0, *since)).collect();
        let lanes = self.in_reset.iter().map(|lanes| lanes.len());
        let covers = lanes.map(|lanes| Ok([take(lanes)?.to_vec(), take(lanes)?.to_vec()]));
        let covers = covers.collect::<Result<_, CheckpointError>>()?;
        let limbs = take(state_limbs(&self.program))?;
        let (mut all, mut fits) = (limbs.iter(), true);
        for_each_width(&self.program, |width| fits &= all.next().is_some_and(|limb| width == 64 || limb >> width == 0));
        match fits {
            true => Ok(Checkpoint {
                saved: Saved::from_limbs(&self.program, limbs),
                program: self.program.clone(),
                timeline,
                resets,
                covers,
            }),
            false => Err(CheckpointError::Damaged),
        }
    }
}

/// The first line and the rest.
fn line(bytes: &[u8]) -> Result<(&str, &[u8]), CheckpointError> {
    let end = bytes.iter().position(|&byte| byte == b'\n').ok_or(CheckpointError::Damaged)?;
    let text = std::str::from_utf8(&bytes[..end]).map_err(|_| CheckpointError::Damaged)?;
    Ok((text, &bytes[end + 1..]))
}

/// Numbers where zeros are counted: a count of zeros and a count of others, which follow, again and again.
fn pack(numbers: &[u64]) -> Vec<u64> {
    let (mut packed, mut rest) = (Vec::new(), numbers);
    while !rest.is_empty() {
        let zeros = rest.iter().take_while(|number| **number == 0).count();
        let others = rest[zeros..].iter().take_while(|number| **number != 0).count();
        packed.push((zeros as u64) << 32 | others as u64);
        packed.extend(&rest[zeros..zeros + others]);
        rest = &rest[zeros + others..];
    }
    packed
}

/// The numbers again, if they are so many.
fn unpack(mut packed: &[u64], count: usize) -> Option<Vec<u64>> {
    let mut numbers = Vec::new();
    while let Some(counts) = packed.split_off_first() {
        let zeros = numbers.len() + (counts >> 32) as usize;
        numbers.resize(Some(zeros).filter(|&zeros| zeros <= count)?, 0);
        numbers.extend(packed.split_off(..(counts & u64::from(u32::MAX)) as usize)?);
    }
    (numbers.len() == count).then_some(numbers)
}

/// The FNV-1a hash of numbers.
fn check(numbers: &[u64]) -> u64 {
    numbers.iter().fold(0xcbf2_9ce4_8422_2325, |hash, number| (hash ^ number).wrapping_mul(0x0000_0100_0000_01b3))
}
