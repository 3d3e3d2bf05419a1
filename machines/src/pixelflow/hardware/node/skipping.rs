//! Ticks of a node in which nothing in its array changes, which are left out.

use super::{Bank, Node};
use crate::error::Error;

impl Node {
    /// Advances to the next event, if the array is idle. Network and frame buffer then read constant registers, without a clock of the array.
    pub(super) fn leave_out(&mut self) -> Result<(), Error> {
        if self.rest <= self.latency || self.beside.is_writing() {
            return Ok(());
        }
        let was_there = self.is_there();
        while self.is_read_alone() && self.is_there() == was_there && self.time <= self.limit {
            self.pass()?;
        }
        let is_at_rest = self.banks.iter().all(|bank| bank.done == 0) && !self.beside.is_busy();
        let next = self.banks.iter().filter_map(|bank| Some(bank.accesses.front()?.from));
        let next = next.chain(self.ended.front().map(|(time, _)| *time));
        let next = next.chain(Some(self.there).filter(|_| !self.is_there())).min();
        if let Some(next) = next.filter(|_| is_at_rest) {
            // An even number of ticks, so that the clocks stay in step.
            self.time += next.saturating_sub(self.time) / 2 * 2;
        }
        Ok(())
    }

    /// Whether network or frame buffer reads, nothing is written, and the array will be told nothing for two more ticks.
    fn is_read_alone(&mut self) -> bool {
        let (time, pixels) = (self.time, self.pixels);
        let is_under_way = |bank: &&Bank| bank.accesses.front().is_some_and(|access| access.from <= time + 1);
        let is_read = |bank: &Bank| {
            let access = bank.accesses.front().expect("it is under way");
            access.from <= time && access.comes.is_none() && bank.done + 2 < access.bytes * pixels
        };
        let mut under_way = self.banks.iter().filter(is_under_way).peekable();
        let some = under_way.peek().is_some() || self.beside.is_busy();
        let is_told = self.ended.front().is_some_and(|(told, _)| *told <= time + 2);
        some && under_way.all(is_read) && !is_told && !self.beside.is_ending()
    }

    /// Skips two ticks of the network and a clock of the frame buffer, and reads their registers.
    fn pass(&mut self) -> Result<(), Error> {
        for _ in 0..2 {
            for bank in 0..2 {
                self.transfer(bank);
            }
            self.time += 1;
        }
        self.beside.clock(&mut self.sim)?;
        // The array waits for it.
        self.works(self.beside.is_busy(), self.time - 3);
        Ok(())
    }
}
