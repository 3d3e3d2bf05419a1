//! The clocks of instructions: the controller's rules as a plain model, an instruction at a time.
//!
//! Source: PP5-UT. The [controller](super::controller) agrees with it in each clock of random programs.

use super::instruction::Instruction;

/// When a controller takes instructions that come in time, and when it sends the first bit of each; a region that is saved finds the store free.
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::{Expression, flat};
/// use tilewright_rtl::pixel_planes::schedule::{Schedule, Times};
///
/// let program = flat(8, &[Expression { a: 1, b: 0, c: -3 }], 0xff_80_00);
/// let mut schedule = Schedule::new(true);
/// let times: Vec<Times> = program.iter().map(|instruction| schedule.take(instruction)).collect();
/// // An edge of 4 bits, a clock in which the flags are set, and then the colour.
/// assert_eq!(times.iter().map(|it| it.taken).collect::<Vec<_>>(), [0, 4, 5]);
/// assert_eq!(times[2], Times { taken: 5, begins: 6, ends: 30 });
/// ```
#[derive(Debug, Clone)]
pub struct Schedule {
    side_by_side: bool,
    /// The first clock in which the next instruction may be taken.
    next: u64,
    /// The clock of the last bit on the tree.
    tree_last: u64,
    /// The clock of the last bit of what of that needs the memory.
    word_last: u64,
    /// The clock of the last bit on the memory alone.
    memory_last: u64,
    /// When what waits for the memory leaves its place.
    place_free: u64,
}

/// The clocks of an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Times {
    /// In which it is taken.
    pub taken: u64,
    /// In which its first bit is sent.
    pub begins: u64,
    /// The one after its last bit.
    pub ends: u64,
}

impl Schedule {
    /// Of a controller at rest, at clock 0.
    pub fn new(side_by_side: bool) -> Schedule {
        Schedule { side_by_side, next: 0, tree_last: 0, word_last: 0, memory_last: 0, place_free: 0 }
    }

    /// Takes the next instruction.
    pub fn take(&mut self, instruction: &Instruction<u64>) -> Times {
        let code = instruction.microcode();
        let clocks = instruction.skip + instruction.length;
        let mut taken = self.next;
        if !self.side_by_side {
            taken = taken.max(self.tree_last).max(self.memory_last);
        }
        let begins;
        if code.on_tree == 1 {
            taken = taken.max(self.tree_last);
            if code.on_memory == 1 {
                taken = taken.max(self.memory_last.saturating_sub(instruction.skip));
            }
            begins = taken + 1;
            self.tree_last = taken + clocks;
            if code.on_memory == 1 {
                self.word_last = self.tree_last;
            }
        } else {
            taken = taken.max(self.place_free).max(self.word_last);
            begins = (taken + 1).max(self.memory_last + 1);
            self.place_free = begins - 1;
            self.memory_last = begins + clocks - 1;
        }
        self.next = taken + 1;
        Times { taken, begins, ends: begins + clocks }
    }

    /// The clock in which an instruction that needs the tree alone would be taken now, as each primitive begins with one.
    pub fn tree_free(&self) -> u64 {
        let free = self.next.max(self.tree_last);
        if self.side_by_side { free } else { free.max(self.memory_last) }
    }
}
