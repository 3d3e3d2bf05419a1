//! The banks of a node's registers, which the network reads and writes.

use std::collections::VecDeque;

use super::Node;
use crate::pixelflow::costs::Ticks;
use crate::pixelflow::hardware::Words;

/// An access of the network to a bank, from some tick on: a byte of each chip a tick.
#[derive(Debug)]
pub(in crate::pixelflow) struct Access {
    pub from: Ticks,
    pub bank: usize,
    /// Bytes of a word.
    pub bytes: u64,
    /// The words that arrive; `None` if the bank's words are sent.
    pub comes: Option<Words>,
    /// A pixel of these words is followed.
    pub is_followed: bool,
}

/// The accesses of the network to a bank, one after another.
#[derive(Default)]
pub(super) struct Bank {
    pub accesses: VecDeque<Access>,
    /// The ticks of the first access that are done, and the words sent in it.
    pub done: Ticks,
    pub went: Option<Words>,
    /// Words that were sent before.
    pub sent: VecDeque<Words>,
}

impl Node {
    /// Tells the array of an ended access in the next clock.
    pub(super) fn tell_what_ended(&mut self) {
        let mut banks = 0;
        while let Some((_, bank)) = self.ended.pop_front_if(|(time, _)| *time <= self.time) {
            banks |= 1_u64 << bank;
            self.claimed[bank] = false;
        }
        self.sim.set(self.sim.i.bank_done, banks);
    }

    /// Transfers the next byte of each chip of a bank, if an access is active. Returns whether it is the last.
    pub(super) fn transfer(&mut self, number: usize) -> bool {
        let bank = &mut self.banks[number];
        let Some(access) = bank.accesses.front().filter(|access| access.from <= self.time) else { return false };
        let (byte, pixel) = (bank.done / self.pixels, bank.done % self.pixels);
        let port = self.sim.i.network[number];
        if pixel == 0 {
            self.sim.set(port.address, access.bytes - 1 - byte);
        }
        self.sim.set(port.pixel, pixel);
        match &access.comes {
            None => {
                let all = access.bytes * self.pixels;
                let went = bank.went.get_or_insert_with(|| Words::new(self.chips, all as usize));
                went.push(self.sim.limbs(self.sim.o.network_seen[number]));
                if let Some(observer) = &mut self.observer
                    && let Some(chip) = observer.chip_of(pixel)
                {
                    observer.read(
                        self.time,
                        number,
                        access.bytes - 1 - byte,
                        went.byte(went.len() - 1, chip),
                        "is read by the network",
                    );
                }
            }
            Some(words) => {
                self.sim.set(port.writes, true);
                self.sim.set(port.bytes, words.get(bank.done as usize).expect("they are whole"));
            }
        }
        bank.done += 1;
        bank.done == access.bytes * self.pixels
    }
}
