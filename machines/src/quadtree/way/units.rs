//! The units that divide windows, level by level.

use std::rc::Rc;

use tilewright_rtl::quadtree::raster::{Form, Part};
use tilewright_scenes::Polygon;

use super::nets::Windows;
use super::numbers::Square;
use super::{Followed, Sim, net, nothing};
use crate::told::{At, Edge, Told, compared, yes};

/// A unit that divides windows which may contain the sample.
pub(super) struct Unit {
    followed: Followed,
    polygons: Rc<[Polygon]>,
    number: u32,
    name: String,
    /// What brings windows to it, with its block.
    before: (String, &'static str),
    /// The greatest and the least size of its windows.
    sizes: [u32; 2],
    /// The next window of the sample: the number of its packet, and its size.
    next: (usize, u32),
    works: Windows,
    parts: Windows,
    ends_quarter: String,
    fails: String,
    quarter: String,
    /// The window that it divides, if that has the sample, and whether the sample's quarter has been tested.
    divides: Option<Divided>,
}

/// A window under way.
struct Divided {
    packet: usize,
    square: Square,
    is_tested: bool,
}

/// The units of the followed sample, in the sequence in which its windows pass them.
pub(super) fn of(followed: &Followed, form: &Form, polygons: &Rc<[Polygon]>) -> Vec<Unit> {
    let raster = format!("u_processor[{}].u_raster", followed.processor);
    let mut from = followed.format.levels();
    let mut units: Vec<Unit> = Vec::new();
    let mut add = |path: String, sizes: [u32; 2], before: &'static str| {
        let level = followed.format.levels() - sizes[0] + 1;
        let levels = if sizes[0] == sizes[1] {
            format!("level {level}")
        } else {
            format!("levels {level} to {}", followed.format.levels() - sizes[1] + 1)
        };
        let number = units.len() as u32;
        units.push(Unit {
            followed: followed.clone(),
            polygons: polygons.clone(),
            number,
            before: (format!("queue before {levels}"), before),
            name: format!("coverage test of {levels}"),
            sizes,
            next: (0, sizes[0]),
            works: Windows::of(&format!("{path}.works"), &followed.format),
            parts: Windows::of(&format!("{path}.parts"), &followed.format),
            ends_quarter: format!("{path}.ends_quarter"),
            fails: format!("{path}.fails"),
            quarter: format!("{path}.number"),
            divides: None,
        });
    };
    for (number, part) in form.parts().iter().enumerate() {
        match *part {
            Part::Stack(levels) => {
                add(format!("{raster}.u_stack{number}.u_test"), [from, from - levels + 1], "quadtree-stack");
            }
            Part::Pipe(levels) => (0..levels).for_each(|level| {
                let size = from - level;
                add(format!("{raster}.u_pipe{number}.u_test{level}"), [size; 2], "fifo");
            }),
            Part::Tree(levels) => {
                let mut path = format!("{raster}.u_tree{number}");
                for level in 0..levels {
                    let size = from - level;
                    add(format!("{path}.u_test"), [size; 2], if level == 0 { "fifo" } else { "quadtree-tree" });
                    path += &format!(".u_branch[{}]", followed.quarter(size));
                }
            }
        }
        from -= part.levels();
    }
    let mut units = units;
    units.iter_mut().for_each(Unit::seek);
    units
}

impl Followed {
    /// The number of the quarter, of a window of that size, that has the sample.
    pub fn quarter(&self, size: u32) -> u32 {
        (self.y >> (size - 1) & 1) << 1 | self.x >> (size - 1) & 1
    }
}

impl Unit {
    /// Whether the window of that size comes to it: all larger ones passed their tests.
    fn comes(&self, packet: usize, size: u32) -> bool {
        let passes = |size: u32| self.followed.may_cover(&self.polygons[packet], self.followed.square(size));
        (size..self.followed.format.levels()).all(passes)
    }

    /// Goes on to the next window that comes to it, from the current one on.
    fn seek(&mut self) {
        while self.next.0 < self.polygons.len() && !self.comes(self.next.0, self.next.1) {
            self.next = (self.next.0 + 1, self.sizes[0]);
        }
    }

    fn advance(&mut self) {
        let (packet, size) = self.next;
        self.next = if size > self.sizes[1] { (packet, size - 1) } else { (packet + 1, self.sizes[0]) };
        self.seek();
    }

    fn at(&self, edge: Edge) -> At {
        At { unit: self.name.clone(), block: "coverage-test", edge }
    }

    /// Looks before an edge.
    pub fn look(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        if net(sim, &self.ends_quarter) == 1 {
            self.ends_quarter(sim, edge, told);
        }
        if self.works.passes(sim) {
            if let Some(lost) = self.divides.take().filter(|it| !it.is_tested) {
                self.never_tests(edge, &lost, told);
            }
            let square = self.works.square(sim);
            if self.followed.is_in(square) {
                self.takes(sim, edge, told);
            }
        }
    }

    fn never_tests(&self, edge: Edge, lost: &Divided, told: &mut Told) {
        let step = nothing(self.name.clone(), "coverage-test", edge, "tests the quarter".to_owned(), "a test");
        told.check("never tests", self.number, false, || step.of(Some(lost.packet)).on(&self.quarter));
    }

    /// It takes a window with the sample.
    fn takes(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        let (packet, size) = self.next;
        let (unit, block) = self.before.clone();
        let at = || At { unit, block, edge };
        let Some(polygon) = self.polygons.get(packet) else {
            told.check("works", self.number, false, || {
                at().step("brings a window", vec![compared("window", "another one", "nothing")]).on(&self.works.valid)
            });
            return;
        };
        let square = self.followed.square(size);
        let values = self.works.compare(sim, &self.followed.fields(polygon, square));
        if values.iter().any(|it| it.differs()) {
            told.check("works", self.number, false, || {
                at().step("brings a window", values).of(Some(packet)).on(&self.works.valid)
            });
        }
        self.divides = Some(Divided { packet, square, is_tested: false });
        self.advance();
    }

    /// A quarter has failed, or is put out.
    fn ends_quarter(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        let (number, fails) = (net(sim, &self.quarter) as u32, net(sim, &self.fails) == 1);
        let out = if fails { None } else { Some(self.parts.square(sim)) };
        let is_followed = |it: &Divided| !it.is_tested && self.followed.quarter(it.square.size) == number;
        let Some(divided) = self.divides.as_mut().filter(|it| is_followed(it)) else {
            if out.is_some_and(|square| self.followed.is_in(square)) {
                told.check("strange", self.number, false, || {
                    let values = vec![compared("window", "one with the pixel", "another one")];
                    self.at(edge).step("puts out a quarter", values).on(&self.parts.valid)
                });
            }
            return;
        };
        divided.is_tested = true;
        let (packet, size) = (divided.packet, divided.square.size - 1);
        let (square, polygon) = (self.followed.square(size), &self.polygons[packet]);
        let expected = self.followed.may_cover(polygon, square);
        let mut values = vec![compared("passes", yes(!fails), yes(expected))];
        if !fails && expected {
            values.extend(self.parts.compare(sim, &self.followed.fields(polygon, square)));
        }
        let step = self.at(edge).step(format!("tests the quarter of {0}x{0} samples", 1 << size), values);
        told.tell(step.of(Some(packet)).on(&self.fails));
    }

    /// Drawing ends. Returns whether all windows have come and been tested.
    pub fn ends(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) -> bool {
        if let Some(lost) = self.divides.take_if(|it| !it.is_tested) {
            self.never_tests(edge, &lost, told);
            return false;
        }
        let (packet, _) = self.next;
        if packet >= self.polygons.len() {
            return true;
        }
        let waits = net(sim, &self.works.valid) == 1;
        // A window that waits is not taken; else it was lost on the way.
        let (unit, block) = if waits { (self.name.clone(), "coverage-test") } else { self.before.clone() };
        let step = nothing(unit, block, edge, "brings a window".to_owned(), "a window");
        told.tell(step.of(Some(packet)).on(&self.works.valid));
        false
    }
}
