//! The clocks of instructions: the controller's rules as a plain model, one instruction at a time.
//!
//! Source: PP5-UT. The [controller](super::controller) agrees with it in each clock of random programs.

use super::instruction::Instruction;

/// The timing of an instruction: the parts of a renderer that it uses, and for how long.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Whether the instruction uses the tree, or changes `enable`.
    pub on_tree: bool,
    /// Whether the instruction uses the memory or the flag.
    pub on_memory: bool,
    /// Whether the instruction saves the region.
    pub saves: bool,
    /// Bits of an expression before the word, which need the tree alone.
    pub skip: u8,
    /// Bits of the word.
    pub length: u8,
}

impl Step {
    /// The clocks of a program's instructions.
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::{programs::clear, schedule::Step};
    ///
    /// let clocks: Vec<u64> = Step::of(&clear(0xff)).iter().map(Step::clocks).collect();
    /// assert_eq!(clocks, [24, 24]);
    /// ```
    pub fn of(program: &[Instruction<u64>]) -> Vec<Step> {
        program.iter().map(Step::from).collect()
    }

    /// An instruction that uses the tree alone for 1 to 64 clocks, as a test of an edge does.
    ///
    /// # Panics
    /// `clocks` is not from 1 to 64.
    pub fn on_tree(clocks: u64) -> Step {
        assert!((1..=64).contains(&clocks), "a test takes 1 to 64 clocks");
        Step { on_tree: true, on_memory: false, saves: false, skip: clocks as u8 - 1, length: 1 }
    }

    /// Clocks from the first bit to the last, both included.
    pub fn clocks(&self) -> u64 {
        u64::from(self.skip) + u64::from(self.length)
    }
}

impl From<&Instruction<u64>> for Step {
    fn from(instruction: &Instruction<u64>) -> Step {
        let code = instruction.microcode();
        Step {
            on_tree: code.on_tree == 1,
            on_memory: code.on_memory == 1,
            saves: code.saves == 1,
            skip: instruction.skip as u8,
            length: instruction.length as u8,
        }
    }
}

/// When a controller takes instructions, and when it sends the first bit of each.
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::{Expression, flat};
/// use tilewright_rtl::pixel_planes::schedule::{Schedule, Step, Times};
///
/// let program = flat(8, &[Expression { a: 1, b: 0, c: -3 }], 0xff_80_00);
/// let mut schedule = Schedule::new(true);
/// let times: Vec<Times> = Step::of(&program).iter().map(|step| schedule.take(step)).collect();
/// // An edge of 4 bits, a clock in which the flags are set, and then the colour.
/// assert_eq!(times.iter().map(|it| it.taken).collect::<Vec<_>>(), [0, 4, 5]);
/// assert_eq!(times[2], Times { taken: 5, begins: 6, ends: 30 });
/// ```
#[derive(Debug, Clone)]
pub struct Schedule {
    side_by_side: bool,
    /// The clock after that in which the last instruction was taken.
    next: u64,
    /// The clock of the last bit on the tree.
    tree: u64,
    /// The clock of the last tree bit of an instruction that also needs the memory.
    word: u64,
    /// The clock of the last bit of an instruction on the memory alone.
    memory: u64,
    /// The clock in which the instruction that waits for the memory leaves its register.
    place: u64,
}

/// The clocks of an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Times {
    /// The clock in which the instruction is taken.
    pub taken: u64,
    /// The clock in which its first bit is sent.
    pub begins: u64,
    /// The clock after its last bit.
    pub ends: u64,
}

impl Schedule {
    /// The schedule of a controller at rest, at clock 0.
    pub fn new(side_by_side: bool) -> Schedule {
        Schedule { side_by_side, next: 0, tree: 0, word: 0, memory: 0, place: 0 }
    }

    /// The first clock in which the controller could take this instruction next; for a save, provided that the store is
    /// free.
    pub fn ready(&self, step: &Step) -> u64 {
        let in_turn = if self.side_by_side { self.next } else { self.next.max(self.tree).max(self.memory) };
        match (step.on_tree, step.on_memory) {
            (true, false) => in_turn.max(self.tree),
            // The memory has to finish its current instruction before the word comes.
            (true, true) => in_turn.max(self.tree).max(self.memory.saturating_sub(step.skip.into())),
            (false, _) => in_turn.max(self.place).max(self.word),
        }
    }

    /// Takes the next instruction as early as possible.
    pub fn take(&mut self, step: &Step) -> Times {
        self.take_at(step, self.ready(step))
    }

    /// Takes the next instruction in a clock in which the controller is ready for it.
    pub fn take_at(&mut self, step: &Step, taken: u64) -> Times {
        self.next = taken + 1;
        if step.on_tree {
            self.tree = taken + step.clocks();
            if step.on_memory {
                self.word = self.tree;
            }
            return Times { taken, begins: taken + 1, ends: self.tree + 1 };
        }
        self.place = taken.max(self.memory);
        self.memory = self.place + step.clocks();
        Times { taken, begins: self.place + 1, ends: self.memory + 1 }
    }

    /// The clock in which an instruction that needs the tree alone would now be taken; every primitive begins with one.
    pub fn tree_free(&self) -> u64 {
        self.ready(&Step::on_tree(1))
    }

    /// The first clock in which nothing is under way.
    pub fn idle(&self) -> u64 {
        self.tree.max(self.memory) + 1
    }
}
