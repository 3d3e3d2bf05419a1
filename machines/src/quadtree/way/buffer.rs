//! The video buffer: what is drawn into a bank, and what stays.

use std::collections::{HashMap, VecDeque};

use super::pixels::Fragment;
use super::{Followed, Sim, net};
use crate::looks::Words;
use crate::told::{At, Edge, Told, compared, hex};

/// Clocks from a fragment until its word is stored.
const STORED: u64 = 2;

/// The model of the banks.
pub(super) struct Buffer {
    followed: Followed,
    strict: bool,
    empty: u64,
    /// The bank that is drawn into, before the frame's swap.
    back: Option<u64>,
    /// The words of the bank that is drawn into, by sample; the others are empty.
    words: HashMap<(u32, u32), u64>,
    under_way: VecDeque<(Fragment, u64)>,
    banks: [Words; 2],
}

impl Buffer {
    pub fn new(followed: &Followed, strict: bool) -> Buffer {
        let unit = format!("u_processor[{}].u_buffer", followed.processor);
        let empty = (1 << followed.format.word()) - 1;
        let (words, under_way) = (HashMap::new(), VecDeque::new());
        let banks = [0, 1].map(|number| Words::of(format!("{unit}.bank{number}")));
        Buffer { followed: followed.clone(), strict, empty, back: None, words, under_way, banks }
    }

    fn at(&self, edge: Edge) -> At {
        At { unit: format!("video buffer of processor {}", self.followed.processor), block: "video-buffer", edge }
    }

    /// A fragment comes at that edge.
    pub fn draws(&mut self, fragment: Fragment, clock: u64) {
        self.under_way.push_back((fragment, clock));
    }

    /// The followed sample's word in the model.
    pub fn word(&self) -> u64 {
        self.words.get(&(self.followed.x, self.followed.y)).copied().unwrap_or(self.empty)
    }

    /// The name of a bank.
    pub fn bank(&self, number: u64) -> &str {
        &self.banks[number as usize].name
    }

    /// The word of the followed sample in a bank.
    pub fn stored(&mut self, sim: &Sim, bank: u64) -> u64 {
        let at = self.followed.format.address(self.followed.x, self.followed.y);
        self.banks[bank as usize].word(sim, at)
    }

    /// Looks before an edge.
    pub fn look(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        let back = *self.back.get_or_insert_with(|| net(sim, "back"));
        while let Some((fragment, _)) = self.under_way.pop_front_if(|(_, came)| edge.number - *came >= STORED) {
            self.stays(sim, edge, (fragment, back), told);
        }
    }

    fn stays(&mut self, sim: &mut Sim, edge: Edge, (fragment, back): (Fragment, u64), told: &mut Told) {
        let Fragment { x, y, word: new, packet, is_followed } = fragment;
        let old = self.words.get(&(x, y)).copied().unwrap_or(self.empty);
        let colour = 3 * self.followed.format.precision().colour;
        let is_nearer = if self.strict { new >> colour < old >> colour } else { new < old };
        let expected = if is_nearer { new } else { old };
        let at = self.followed.format.address(x, y);
        // A fragment may be outside of the screen, after a unit before this one has failed.
        let is_inside = x < self.followed.format.columns() && y < self.followed.format.rows();
        let stays = if is_inside { self.banks[back as usize].word(sim, at) } else { expected };
        if is_followed || stays != expected {
            told.check("stays", 0, is_followed, || {
                let values = vec![
                    compared("old word", hex(old), hex(old)),
                    compared("new word", hex(new), hex(new)),
                    compared("word that stays", hex(stays), hex(expected)),
                ];
                let step = self.at(edge).step(format!("draws the fragment into bank {back}"), values);
                step.of(packet).on(format!("{}[{at}]", self.bank(back)))
            });
        }
        self.words.insert((x, y), stays);
    }

    /// The banks are exchanged after that edge.
    pub fn swaps(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        let before = self.back.unwrap_or_default();
        let stored = self.stored(sim, before);
        if stored != self.word() {
            let values = vec![compared("word", hex(stored), hex(self.word()))];
            told.tell(self.at(edge).step(format!("keeps the word in bank {before}"), values).on(self.bank(before)));
        }
        let back = net(sim, "back");
        let at = At { unit: "generator".to_owned(), block: "quadtree-generator", edge };
        told.tell(at.step("exchanges the banks", vec![compared("bank being drawn", back, before ^ 1)]).on("back"));
    }
}
