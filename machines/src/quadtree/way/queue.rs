//! A queue: what leaves it is what came first.

use std::collections::VecDeque;

use super::{Sim, net, nothing};
use crate::told::{At, Edge, Told, compared};

/// The model of a queue.
pub(super) struct Queue {
    number: u32,
    path: String,
    into: [String; 3],
    out: [String; 3],
    /// The words in it, in limbs.
    words: VecDeque<Vec<u64>>,
}

impl Queue {
    /// One of that instance.
    pub fn new(number: u32, path: &str) -> Queue {
        let nets = |port: &str| ["valid", "ready", "payload"].map(|it| format!("{path}.{port}_{it}"));
        Queue { number, path: path.to_owned(), into: nets("into"), out: nets("out"), words: VecDeque::new() }
    }

    fn at(&self, edge: Edge) -> At {
        At { unit: format!("queue `{}`", self.path), block: "fifo", edge }
    }

    /// Looks before an edge.
    pub fn look(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        let passes = |sim: &mut Sim, [valid, ready, _]: &[String; 3]| net(sim, valid) == 1 && net(sim, ready) == 1;
        let word = |sim: &mut Sim, [.., name]: &[String; 3]| {
            sim.peek(name).unwrap_or_else(|unknown| panic!("{unknown}")).limbs().to_vec()
        };
        if passes(sim, &self.out) {
            let (came, golden) = (word(sim, &self.out), self.words.pop_front());
            if golden.as_ref() != Some(&came) {
                let shown = |word: Option<&Vec<u64>>| {
                    let digits = |word: &Vec<u64>| word.iter().rev().map(|limb| format!("{limb:016x}")).collect();
                    word.map_or("nothing".to_owned(), digits)
                };
                told.check("queue", self.number, false, || {
                    let values = vec![compared("word", shown(Some(&came)), shown(golden.as_ref()))];
                    self.at(edge).step("puts out the oldest word", values).on(&self.out[2])
                });
            }
        }
        if passes(sim, &self.into) {
            let word = word(sim, &self.into);
            self.words.push_back(word);
        }
    }

    /// Drawing ends. Returns whether it offers what it has.
    pub fn ends(&self, sim: &mut Sim, edge: Edge, told: &mut Told) -> bool {
        let is_right = self.words.is_empty() || net(sim, &self.out[0]) == 1;
        if !is_right {
            let At { unit, block, edge } = self.at(edge);
            let step = nothing(unit, block, edge, "offers the oldest word".to_owned(), "a word");
            told.tell(step.on(&self.out[0]));
        }
        is_right
    }
}
