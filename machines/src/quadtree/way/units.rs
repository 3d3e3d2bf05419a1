//! The units that divide windows, level by level.

use std::rc::Rc;

use tilewright_rtl::quadtree::raster::{Form, Part};
use tilewright_scenes::Polygon;

use super::nets::Windows;
use super::numbers::Square;
use super::queue::Queue;
use super::sequence::{Passage, Sequence};
use super::{Followed, Seen, Sim, net, nothing};
use crate::looks::Looks;
use crate::told::{At, Edge, Told, compared, yes};

/// A part of the windows' way.
pub(super) enum Link {
    Passage(Box<Passage>),
    Queue(Queue),
    Unit(Box<Unit>),
}

impl Link {
    /// Whether it is a queue.
    pub fn is_queue(&self) -> bool {
        matches!(self, Link::Queue(_))
    }

    /// Looks before an edge.
    pub fn look(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) {
        match self {
            Link::Passage(it) => it.look(seen, edge, told),
            Link::Queue(it) => it.look(seen, edge, told),
            Link::Unit(it) => it.look(seen, edge, told),
        }
    }

    /// Drawing ends. Returns whether everything has come and gone.
    pub fn ends(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) -> bool {
        match self {
            Link::Passage(_) => true,
            Link::Queue(it) => it.ends(sim, edge, told),
            Link::Unit(it) => it.ends(sim, edge, told),
        }
    }
}

/// A unit that divides windows which may contain the sample.
pub(super) struct Unit {
    followed: Followed,
    polygons: Rc<[Polygon]>,
    number: u32,
    name: String,
    /// The block that brings windows to it.
    before: &'static str,
    /// The windows of the sample that come.
    sequence: Sequence,
    works: Windows,
    parts: Windows,
    /// The name of its instance, and the place of its nets: whether a quarter ends, whether it fails, and its number.
    path: String,
    place: usize,
    /// The window that it divides, if that has the sample, and whether the sample's quarter has been tested.
    divides: Option<Divided>,
}

/// A window under way.
struct Divided {
    packet: usize,
    square: Square,
    is_tested: bool,
}

/// What makes links: the followed sample, and the polygons.
type Of<'a> = (&'a Followed, &'a Rc<[Polygon]>);

/// The way of the followed sample's windows from the set-up to the pixel processor.
pub(super) fn of(looks: &mut Looks, followed: &Followed, form: &Form, polygons: &Rc<[Polygon]>) -> Vec<Link> {
    let processor = format!("u_processor[{}]", followed.processor);
    let raster = format!("{processor}.u_raster");
    let mut from = followed.format.levels();
    let mut links: Vec<Link> =
        vec![Queue::new(looks, 0, "u_queue").copied(), Queue::new(looks, 1, &format!("{processor}.u_queue"))]
            .into_iter()
            .map(Link::Queue)
            .collect();
    let passage = |looks: &mut Looks, links: &mut Vec<Link>, port: String, block: &'static str, size: u32| {
        let unit = format!("wire to `{port}`");
        let passage = Passage::new(looks, (links.len() as u32, &port), (&unit, block), size, (followed, polygons));
        links.push(Link::Passage(Box::new(passage)));
    };
    passage(looks, &mut links, format!("{raster}.works"), "video-processor", from);
    for (number, part) in form.parts().iter().enumerate() {
        let (name, block) = match part {
            Part::Stack(_) => ("stack", "quadtree-stack"),
            Part::Pipe(_) => ("pipe", "quadtree-pipe"),
            Part::Tree(_) => ("tree", "quadtree-tree"),
        };
        let path = format!("{raster}.u_{name}{number}");
        passage(looks, &mut links, format!("{path}.works"), "raster-processor", from);
        let inner = units(looks, &path, (*part, block), from, (followed, polygons), links.len() as u32);
        links.extend(inner);
        from -= part.levels();
        passage(looks, &mut links, format!("{path}.parts"), block, from);
    }
    passage(looks, &mut links, format!("{raster}.parts"), "raster-processor", 0);
    links
}

/// The queues and the units of a part, whose windows have at most that size.
fn units(
    looks: &mut Looks,
    path: &str,
    (part, block): (Part, &'static str),
    from: u32,
    of: Of,
    first: u32,
) -> Vec<Link> {
    let mut links = Vec::new();
    let mut add = |queue: Option<String>, unit: String, sizes: [u32; 2]| {
        let number = first + links.len() as u32;
        links.extend(queue.map(|queue| Link::Queue(Queue::new(looks, number, &queue))));
        links.push(Link::Unit(Box::new(Unit::new(looks, (number, unit), block, sizes, of))));
    };
    match part {
        Part::Stack(levels) => add(None, format!("{path}.u_test"), [from, from - levels + 1]),
        Part::Pipe(levels) => {
            for level in 0..levels {
                let [queue, unit] = ["queue", "test"].map(|it| format!("{path}.u_{it}{level}"));
                add(Some(queue), unit, [from - level; 2]);
            }
        }
        Part::Tree(levels) => {
            let mut path = path.to_owned();
            for size in (from + 1 - levels..=from).rev() {
                add(Some(format!("{path}.u_queue")), format!("{path}.u_test"), [size; 2]);
                path += &format!(".u_branch[{}]", of.0.quarter(size));
            }
        }
    }
    links
}

impl Followed {
    /// The number of the quarter, of a window of that size, that has the sample.
    pub fn quarter(&self, size: u32) -> u32 {
        (self.y >> (size - 1) & 1) << 1 | self.x >> (size - 1) & 1
    }
}

impl Unit {
    fn new(looks: &mut Looks, (number, path): (u32, String), before: &'static str, sizes: [u32; 2], of: Of) -> Unit {
        let (followed, polygons) = of;
        let levels = followed.format.levels();
        let level = |size: u32| levels - size + 1;
        let name = match sizes {
            [most, least] if most == least => format!("level {}", level(most)),
            [most, least] => format!("levels {} to {}", level(most), level(least)),
        };
        Unit {
            followed: followed.clone(),
            polygons: polygons.clone(),
            number,
            before,
            name: format!("coverage test of {name}"),
            sequence: Sequence::new(followed, polygons, sizes),
            works: Windows::of(looks, &format!("{path}.works"), &followed.format),
            parts: Windows::of(looks, &format!("{path}.parts"), &followed.format),
            place: looks.add(&path, [".ends_quarter", ".fails", ".number"]),
            path,
            divides: None,
        }
    }

    fn at(&self, edge: Edge) -> At {
        At { unit: self.name.clone(), block: "coverage-test", edge }
    }

    /// Looks before an edge.
    pub fn look(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) {
        if seen.nets.at(self.place) == 1 {
            self.ends_quarter(seen, edge, told);
        }
        if self.works.passes(seen.nets) {
            if let Some(lost) = self.divides.take().filter(|it| !it.is_tested) {
                self.never_tests(edge, &lost, told);
            }
            let square = self.works.square(seen.nets);
            if self.followed.is_in(square) {
                self.takes(seen, edge, told);
            }
        }
    }

    fn never_tests(&self, edge: Edge, lost: &Divided, told: &mut Told) {
        let step = nothing(self.name.clone(), "coverage-test", edge, "tests the quarter".to_owned(), "a test");
        told.check("never tests", self.number, false, || {
            step.of(Some(lost.packet)).on(format!("{}.number", self.path))
        });
    }

    /// It takes a window with the sample.
    fn takes(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) {
        let packet = self.sequence.packet();
        let golden = packet.map(|packet| self.sequence.fields(packet));
        let beside = self.works.compare(seen, golden.as_ref());
        if beside.differs() {
            told.check("works", self.number, false, || {
                let at = At { unit: format!("way to the {}", self.name), block: self.before, edge };
                at.step("brings a window", beside.values).of(packet).on(beside.net)
            });
        }
        if let Some(packet) = packet {
            self.divides = Some(Divided { packet, square: self.sequence.square(), is_tested: false });
            self.sequence.advance();
        }
    }

    /// A quarter has failed, or is put out.
    fn ends_quarter(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) {
        let [fails, number] = seen.nets.from(self.place + 1);
        let (number, fails) = (number as u32, fails == 1);
        let out = if fails { None } else { Some(self.parts.square(seen.nets)) };
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
        let mut net = format!("{}.fails", self.path);
        if !fails && expected {
            let beside = self.parts.compare(seen, Some(&self.followed.fields(polygon, square)));
            if beside.differs() {
                net = beside.net;
            }
            values.extend(beside.values);
        }
        let step = self.at(edge).step(format!("tests the quarter of {0}x{0} samples", 1 << size), values);
        if step.differs() || self.followed.is_told(polygon) {
            told.tell(step.of(Some(packet)).on(net));
        }
    }

    /// Drawing ends. Returns whether all windows have come and been tested.
    pub fn ends(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) -> bool {
        if let Some(lost) = self.divides.take_if(|it| !it.is_tested) {
            self.never_tests(edge, &lost, told);
            return false;
        }
        let Some(packet) = self.sequence.packet() else { return true };
        // A window that waits is not taken; else it was lost on the way.
        let waits = net(sim, &self.works.valid) == 1;
        let way = (format!("way to the {}", self.name), self.before);
        let (unit, block) = if waits { (self.name.clone(), "coverage-test") } else { way };
        let step = nothing(unit, block, edge, "brings a window".to_owned(), "a window");
        told.tell(step.of(Some(packet)).on(&self.works.valid));
        false
    }
}
