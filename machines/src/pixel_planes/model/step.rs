//! What an instruction takes.

use tilewright_rtl::pixel_planes::instruction::Instruction;

/// An instruction without what it computes: which parts of a renderer it takes, and for how long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// It takes the tree, or changes `enable`.
    pub on_tree: bool,
    /// It takes memory or flags.
    pub on_memory: bool,
    /// It saves the region.
    pub saves: bool,
    /// Bits of an expression before the word, which take the tree alone.
    pub skip: u8,
    /// Bits of the word.
    pub length: u8,
}

impl Step {
    /// Those of a program.
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::model::Step;
    /// use tilewright_rtl::pixel_planes::programs::clear;
    ///
    /// let clocks: Vec<u64> = Step::of(&clear(0xff)).iter().map(Step::clocks).collect();
    /// assert_eq!(clocks, [24, 24]);
    /// ```
    pub fn of(program: &[Instruction<u64>]) -> Vec<Step> {
        program.iter().map(Step::from).collect()
    }

    /// One that takes the tree alone for so many clocks, 1 to 64, as a test of an edge does.
    ///
    /// # Panics
    /// No instruction takes as long.
    pub fn on_tree(clocks: u64) -> Step {
        assert!((1..=64).contains(&clocks), "a test takes 1 to 64 clocks");
        Step { on_tree: true, on_memory: false, saves: false, skip: clocks as u8 - 1, length: 1 }
    }

    /// Clocks from its first bit to the one behind its last.
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
