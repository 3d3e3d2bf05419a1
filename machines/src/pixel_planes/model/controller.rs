//! The image generation controller: when it takes an instruction, and when that begins.

use super::step::Step;

/// Its two slots and the place of one that waits for the memory, each by the clock in which what was last in it ends.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Controller {
    side_by_side: bool,
    /// The clock behind that in which the last instruction was taken.
    next: u64,
    /// The last bit on the tree.
    tree: u64,
    /// The last bit on the tree of what needs the memory, too.
    word: u64,
    /// The last bit of what is on the memory alone.
    memory: u64,
    /// What waits for the memory leaves its place.
    place: u64,
}

impl Controller {
    pub fn new(side_by_side: bool) -> Controller {
        Controller { side_by_side, ..Controller::default() }
    }

    /// The first clock in which it would take the next instruction, if that is this one.
    pub fn ready(&self, step: &Step) -> u64 {
        let in_turn = if self.side_by_side { self.next } else { self.next.max(self.tree).max(self.memory) };
        match (step.on_tree, step.on_memory) {
            (true, false) => in_turn.max(self.tree),
            // The memory has to be done with what it has when the word comes.
            (true, true) => in_turn.max(self.tree).max(self.memory.saturating_sub(step.skip.into())),
            (false, _) => in_turn.max(self.place).max(self.word),
        }
    }

    /// Takes an instruction; gives the clocks of its first and of its last bit.
    pub fn take(&mut self, step: &Step, now: u64) -> [u64; 2] {
        self.next = now + 1;
        if step.on_tree {
            self.tree = now + step.clocks();
            if step.on_memory {
                self.word = self.tree;
            }
            return [now + 1, self.tree];
        }
        let begins = now.max(self.memory) + 1;
        self.place = begins - 1;
        self.memory = self.place + step.clocks();
        [begins, self.memory]
    }

    /// The first clock in which nothing is under way.
    pub fn idle(&self) -> u64 {
        self.tree.max(self.memory) + 1
    }
}
