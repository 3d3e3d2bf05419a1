//! A queue: what leaves it is what came first.

use std::collections::VecDeque;

use super::{Seen, Sim, net, nothing};
use crate::looks::Looks;
use crate::told::{At, Edge, Told, compared};

/// The model of a queue.
pub(super) struct Queue {
    number: u32,
    path: String,
    /// The place of the nets that say whether words come, and go.
    place: usize,
    /// The words that come, and that go.
    into: Looks,
    out: Looks,
    /// The words in it, in limbs.
    words: VecDeque<Vec<u64>>,
    /// Several units take the oldest word before it goes, each in a clock of its own.
    is_copied: bool,
}

impl Queue {
    /// One of that instance.
    pub fn new(looks: &mut Looks, number: u32, path: &str) -> Queue {
        let place = looks.add(path, [".into_valid", ".into_ready", ".out_valid", ".out_ready"]);
        let payload = |net| {
            let mut looks = Looks::default();
            looks.add(path, [net]);
            looks
        };
        let (into, out) = (payload(".into_payload"), payload(".out_payload"));
        Queue { number, path: path.to_owned(), place, into, out, words: VecDeque::new(), is_copied: false }
    }

    /// One whose oldest word several units take, each in a clock of its own.
    pub fn copied(self) -> Queue {
        Queue { is_copied: true, ..self }
    }

    /// The name of a net of its output.
    fn out(&self, net: &str) -> String {
        format!("{}.out_{net}", self.path)
    }

    fn at(&self, edge: Edge) -> At {
        At { unit: format!("queue `{}`", self.path), block: "fifo", edge }
    }

    /// Looks before an edge.
    pub fn look(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) {
        let [comes, is_taken, offers, goes] = seen.nets.from(self.place).map(|bit| bit == 1);
        let goes = offers && goes;
        if goes || offers && self.is_copied {
            self.out.look(seen.sim);
            let (came, golden) = (self.out.values(), self.words.front().map(Vec::as_slice));
            if golden != Some(came) {
                let shown = |word: Option<&[u64]>| {
                    let digits = |word: &[u64]| word.iter().rev().map(|limb| format!("{limb:016x}")).collect();
                    word.map_or("nothing".to_owned(), digits)
                };
                told.check("queue", self.number, false, || {
                    let values = vec![compared("word", shown(Some(came)), shown(golden))];
                    self.at(edge).step("puts out the oldest word", values).on(self.out("payload"))
                });
            }
        }
        if goes {
            self.words.pop_front();
        }
        if comes && is_taken {
            self.into.look(seen.sim);
            self.words.push_back(self.into.values().to_vec());
        }
    }

    /// Drawing ends. Returns whether it offers what it has.
    pub fn ends(&self, sim: &mut Sim, edge: Edge, told: &mut Told) -> bool {
        let is_right = self.words.is_empty() || net(sim, &self.out("valid")) == 1;
        if !is_right {
            let At { unit, block, edge } = self.at(edge);
            let step = nothing(unit, block, edge, "offers the oldest word".to_owned(), "a word");
            told.tell(step.on(self.out("valid")));
        }
        is_right
    }
}
