//! The windows of the sample that come to a place, in their sequence.

use std::rc::Rc;

use tilewright_scenes::Polygon;

use super::Followed;
use super::Seen;
use super::nets::Windows;
use super::numbers::{Fields, Square};
use crate::looks::Looks;
use crate::told::{At, Edge, Told};

/// Which windows come, and which of them is next.
pub(super) struct Sequence {
    pub followed: Followed,
    pub polygons: Rc<[Polygon]>,
    /// The greatest and the least size of the windows.
    sizes: [u32; 2],
    /// The number of the next one's packet, and its size.
    next: (usize, u32),
}

impl Sequence {
    pub fn new(followed: &Followed, polygons: &Rc<[Polygon]>, sizes: [u32; 2]) -> Sequence {
        let (followed, polygons, next) = (followed.clone(), polygons.clone(), (0, sizes[0]));
        let mut sequence = Sequence { followed, polygons, sizes, next };
        sequence.seek();
        sequence
    }

    /// Whether the window of that size comes: all larger ones passed their tests.
    fn comes(&self, packet: usize, size: u32) -> bool {
        let passes = |size: u32| self.followed.may_cover(&self.polygons[packet], self.followed.square(size));
        (size..self.followed.format.levels()).all(passes)
    }

    /// Goes on to the next window that comes, from the current one on.
    fn seek(&mut self) {
        while self.next.0 < self.polygons.len() && !self.comes(self.next.0, self.next.1) {
            self.next = (self.next.0 + 1, self.sizes[0]);
        }
    }

    /// The number of the next window's packet, if one comes.
    pub fn packet(&self) -> Option<usize> {
        Some(self.next.0).filter(|packet| *packet < self.polygons.len())
    }

    /// The next window.
    pub fn square(&self) -> Square {
        self.followed.square(self.next.1)
    }

    /// The fields of the next window of a packet.
    pub fn fields(&self, packet: usize) -> Fields {
        self.followed.fields(&self.polygons[packet], self.square())
    }

    /// The next window has come.
    pub fn advance(&mut self) {
        let (packet, size) = self.next;
        self.next = if size > self.sizes[1] { (packet, size - 1) } else { (packet + 1, self.sizes[0]) };
        self.seek();
    }
}

/// A place between units where windows pass.
pub(super) struct Passage {
    number: u32,
    sequence: Sequence,
    windows: Windows,
    unit: String,
    block: &'static str,
}

impl Passage {
    /// That port, to which a block connects another one, for windows of that size.
    pub fn new(
        looks: &mut Looks,
        (number, port): (u32, &str),
        (unit, block): (&str, &'static str),
        size: u32,
        (followed, polygons): (&Followed, &Rc<[Polygon]>),
    ) -> Passage {
        let sequence = Sequence::new(followed, polygons, [size; 2]);
        Passage { number, sequence, windows: Windows::of(looks, port, &followed.format), unit: unit.to_owned(), block }
    }

    /// Looks before an edge.
    pub fn look(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) {
        let nets = seen.nets;
        if !self.windows.passes(nets) || !self.sequence.followed.is_in(self.windows.square(nets)) {
            return;
        }
        let packet = self.sequence.packet();
        let golden = packet.map(|packet| self.sequence.fields(packet));
        let beside = self.windows.compare(seen, golden.as_ref());
        if beside.differs() {
            told.check("passage", self.number, false, || {
                let at = At { unit: self.unit.clone(), block: self.block, edge };
                at.step("passes a window on", beside.values).of(packet).on(beside.net)
            });
        }
        if packet.is_some() {
            self.sequence.advance();
        }
    }
}
