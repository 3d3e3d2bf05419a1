//! The broadcast bus: what each processing element receives is what the bus took, word by word.

use std::collections::VecDeque;
use std::sync::Arc;

use tilewright_scenes::ScreenVertex;

use super::{Sim, net, pe};
use crate::told::{At, Told, compared};
use crate::vc1::job::View;
use crate::vc1::words::{Message, POLYGON_WORDS, Word};
use crate::way::Primitive;

/// The words that some processing element has not received.
pub(super) struct Bus {
    words: VecDeque<Word>,
    /// The number of words that all have received.
    gone: u64,
    /// By processing element, the number of words that it has received.
    received: Vec<u64>,
    /// By processing element, the words of the packet so far, as they were taken and as they came.
    packets: Vec<[Vec<u32>; 2]>,
    /// The sender of a packet that is not complete.
    open: Option<u32>,
    view: Option<Arc<View>>,
}

impl Bus {
    pub fn new(processors: u32) -> Bus {
        let count = processors as usize;
        Bus {
            words: VecDeque::new(),
            gone: 0,
            received: vec![0; count],
            packets: vec![Default::default(); count],
            open: None,
            view: None,
        }
    }

    pub fn command(&mut self, view: &Arc<View>) {
        self.view = Some(view.clone());
    }

    /// Whether all have received all words.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    fn sender(&self, number: u32) -> String {
        if number as usize == self.received.len() { "the host".to_owned() } else { format!("PE {number}") }
    }

    /// The bus took a word of that sender; the host's number is after those of the processing elements.
    pub fn carries(&mut self, clock: u64, sender: u32, word: Word, told: &mut Told) {
        if let Some(open) = self.open.filter(|open| *open != sender) {
            told.check("packet", 0, false, || {
                let values = vec![compared("sender", self.sender(sender), self.sender(open))];
                at(clock).step("takes the next word of a packet", values).on("u_bus.sender")
            });
        }
        self.open = (!word.last).then_some(sender);
        self.words.push_back(word);
    }

    /// A processing element received a word.
    pub fn receives(
        &mut self,
        sim: &mut Sim,
        clock: u64,
        (number, word): (u32, Word),
        (primitives, told): (&[Primitive], &mut Told),
    ) {
        let at_word = (self.received[number as usize] - self.gone) as usize;
        let expected = self.words.get(at_word).copied();
        self.received[number as usize] += 1;
        if Some(word) != expected {
            let shown = |word: Option<Word>| match word {
                Some(Word { word, last }) => format!("{word:08x}{}", if last { ", the last" } else { "" }),
                None => "nothing".to_owned(),
            };
            // The port is a wire from the bus.
            let port = sim.o.processors[number as usize].received;
            let last = sim.get_u64(port.last) != net(sim, &format!("u_bus.received_{number}_last"));
            let is_wire = last || sim.get_u64(port.word) != net(sim, &format!("u_bus.received_{number}_word"));
            told.check("word", number, false, || {
                let values = vec![compared("word", shown(Some(word)), shown(expected))];
                let at = At { block: if is_wire { "vc1" } else { "broadcast-bus" }, ..at(clock) };
                at.step(format!("brings a word to PE {number}"), values).on(format!("u_bus.received_{number}_word"))
            });
        }
        let packet = &mut self.packets[number as usize];
        packet[0].extend(expected.map(|it| it.word));
        packet[1].push(word.word);
        if expected.is_some_and(|it| it.last) {
            let packets = std::mem::take(packet);
            self.brings(clock, number, packets, (primitives, told));
        }
        let least = self.received.iter().copied().min().unwrap_or_default();
        while self.gone < least && self.words.pop_front().is_some() {
            self.gone += 1;
        }
        self.gone = self.gone.max(least.min(self.gone));
    }

    /// A packet is complete. A polygon of the pixel is told of that processing element that has the pixel's row.
    fn brings(&self, clock: u64, number: u32, packets: [Vec<u32>; 2], (primitives, told): (&[Primitive], &mut Told)) {
        let Some(view) = &self.view else { return };
        let vertices = |words: &[u32]| match Message::of_words(words).filter(|_| words.len() == POLYGON_WORDS) {
            Some(Message::Polygon { vertices, .. }) => Some(vertices),
            _ => None,
        };
        let Some(taken) = vertices(&packets[0]) else { return };
        let is_it = |it: &&Primitive| view.projection.vertices.get(it.number) == Some(&taken);
        let Some(primitive) = primitives.iter().find(is_it) else { return };
        let came = if packets[1].is_empty() { None } else { vertices(&packets[1]) };
        let shown = |vertices: Option<[ScreenVertex; 3]>| {
            let corner = |it: &ScreenVertex| {
                let [r, g, b] = it.rgb;
                format!("({},{},{:06x},{r:02x}{g:02x}{b:02x})", it.x, it.y, it.z)
            };
            vertices.map_or("nothing".to_owned(), |all| all.iter().map(corner).collect::<Vec<_>>().join(" "))
        };
        let values = vec![compared("corners", shown(came), shown(Some(taken)))];
        let step = at(clock).step(format!("brings a polygon to PE {number}"), values);
        told.tell(step.of(Some(primitive.number)).on(format!("u_bus.received_{number}_word")));
    }
}

fn at(clock: u64) -> At {
    At { unit: "broadcast bus".to_owned(), block: "broadcast-bus", edge: pe(clock) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packet_of_two_senders_names_both() {
        let (mut bus, mut told) = (Bus::new(2), Told::default());
        bus.carries(1, 1, Word { word: 7, last: false }, &mut told);
        // The host's number is after those of the processing elements.
        bus.carries(2, 2, Word { word: 8, last: true }, &mut told);
        let [step] = &told.take()[..] else { panic!("one packet is one step") };
        assert_eq!(step.values, [compared("sender", "the host", "PE 1")]);
    }
}
