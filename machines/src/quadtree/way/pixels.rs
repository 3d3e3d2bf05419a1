//! The pixel processor: fragments from windows of one sample.

use std::rc::Rc;

use tilewright_scenes::Polygon;
use tilewright_scenes::packet::FRACTION_BITS;

use super::nets::Windows;
use super::{Followed, Seen, nothing};
use crate::looks::Looks;
use crate::told::{At, Edge, Told, compared, hex};
use crate::way::Primitive;

/// A fragment: its sample and its word, whether it is the followed one, and its packet.
#[derive(Clone, Copy)]
pub(super) struct Fragment {
    pub x: u32,
    pub y: u32,
    pub word: u64,
    pub packet: Option<usize>,
    pub is_followed: bool,
}

/// The model of the pixel processor.
pub(super) struct Pixels {
    followed: Followed,
    polygons: Rc<[Polygon]>,
    pixel: [u32; 2],
    leaves: Windows,
    /// The name of the unit, and the place of the nets of a fragment: whether there is one, its sample, and its word.
    unit: String,
    place: usize,
    /// The next packet with a leaf at the sample.
    next: usize,
    /// The leaf that was taken at the last edge.
    taken: Option<Leaf>,
}

/// A window of one sample.
struct Leaf {
    x: u32,
    y: u32,
    word: u64,
    packet: Option<usize>,
}

impl Pixels {
    pub fn new(looks: &mut Looks, followed: &Followed, polygons: Rc<[Polygon]>, pixel: [u32; 2]) -> Pixels {
        let unit = format!("u_processor[{}].u_pixel", followed.processor);
        let mut pixels = Pixels {
            followed: followed.clone(),
            polygons,
            pixel,
            leaves: Windows::of(looks, &format!("{unit}.leaves"), &followed.format),
            place: looks.add(&unit, [".fragment_valid", ".fragment_x", ".fragment_y", ".fragment_word"]),
            unit,
            next: 0,
            taken: None,
        };
        pixels.seek();
        pixels
    }

    /// Goes on to the next packet that has a leaf at the sample.
    fn seek(&mut self) {
        let levels = self.followed.format.levels();
        let comes =
            |packet: &Polygon| (0..levels).all(|size| self.followed.may_cover(packet, self.followed.square(size)));
        while self.polygons.get(self.next).is_some_and(|packet| !comes(packet)) {
            self.next += 1;
        }
    }

    fn at(&self, edge: Edge) -> At {
        At { unit: "pixel processor".to_owned(), block: "quadtree-pixel", edge }
    }

    /// Looks before an edge. Returns the fragment that is drawn at it.
    pub fn look(
        &mut self,
        seen: &mut Seen,
        edge: Edge,
        (primitives, told): (&mut [Primitive], &mut Told),
    ) -> Option<Fragment> {
        let valid = seen.nets.at(self.place) == 1;
        let taken = self.taken.take();
        let fragment = self.sees(seen.nets, edge, (valid, taken), (primitives, told));
        if self.leaves.is_valid(seen.nets) {
            self.takes(seen, edge, told);
        }
        fragment
    }

    /// The fragment of the leaf that was taken.
    fn sees(
        &mut self,
        nets: &Looks,
        edge: Edge,
        (valid, taken): (bool, Option<Leaf>),
        (primitives, told): (&mut [Primitive], &mut Told),
    ) -> Option<Fragment> {
        if !valid && taken.is_none() {
            return None;
        }
        let [x, y, word] = nets.from(self.place + 1);
        let shown = |it: Option<(u64, u64, u64)>| {
            it.map_or("nothing".to_owned(), |it| format!("{} at {},{}", hex(it.2), it.0, it.1))
        };
        let [px, py] = self.pixel;
        let packet = taken.as_ref().and_then(|leaf| leaf.packet);
        // Without an aperture a leaf is a pixel that the polygon covers.
        let covers = packet.is_none_or(|packet| {
            let packet = &self.polygons[packet];
            packet.bounds.contains(px, py) && packet.covers(px, py)
        });
        let is_exact = self.followed.format.aperture() == 0;
        let golden = taken
            .as_ref()
            .filter(|_| is_exact || packet.is_none() || covers)
            .map(|leaf| (leaf.x.into(), leaf.y.into(), leaf.word));
        let seen = valid.then_some((x, y, word));
        let is_followed = (x, y) == (self.followed.x.into(), self.followed.y.into()) && valid;
        // With an aperture, leaves of other samples may have no fragment.
        let is_wrong = seen != golden && (seen.is_some() || is_exact || packet.is_some());
        if is_followed || packet.is_some() || is_wrong {
            let is_told = is_followed || packet.is_some();
            told.check("fragment", 0, is_told, || {
                let values = vec![compared("fragment", shown(seen), shown(golden))];
                self.at(edge).step("makes a fragment", values).of(packet).on(format!("{}.fragment_word", self.unit))
            });
        }
        if is_followed {
            let primitive = primitives.iter_mut().find(|it| Some(it.number) == packet);
            primitive.into_iter().for_each(|it| it.hardware = Some(word));
        }
        valid.then_some(Fragment { x: x as u32, y: y as u32, word, packet, is_followed })
    }

    /// It takes a window of one sample.
    fn takes(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) {
        let square = self.leaves.square(seen.nets);
        let is_followed = square.size == 0 && self.followed.is_in(square);
        let precision = self.followed.format.precision();
        let planes = self.leaves.planes(seen.sim);
        let part = |plane: u64, from: u32, width: u32| plane >> from & ((1 << width) - 1);
        let colour = |plane: u64| part(plane, FRACTION_BITS, precision.colour);
        let word = planes[1..].iter().fold(part(planes[0], FRACTION_BITS, precision.depth), |word, plane| {
            word << precision.colour | colour(*plane)
        });
        let mut packet = None;
        if is_followed {
            let expected = self.polygons.get(self.next);
            packet = expected.map(|_| self.next);
            let golden = expected.map(|it| self.followed.fields(it, self.followed.square(0)));
            let beside = self.leaves.compare(seen, golden.as_ref());
            if beside.differs() {
                told.check("leaf", 0, false, || {
                    let at = At { unit: "wire to the pixel processor".to_owned(), block: "video-processor", edge };
                    at.step("passes a window of one sample on", beside.values).of(packet).on(beside.net)
                });
            }
            self.next += 1;
            self.seek();
        }
        self.taken = Some(Leaf { x: square.x, y: square.y, word, packet });
    }

    /// Drawing ends. Returns whether all windows have come.
    pub fn ends(&self, edge: Edge, told: &mut Told) -> bool {
        if self.next < self.polygons.len() {
            let does = "passes a window of one sample on".to_owned();
            let step = nothing("raster processor".to_owned(), "raster-processor", edge, does, "a window");
            told.tell(step.of(Some(self.next)).on(&self.leaves.valid));
        }
        self.next >= self.polygons.len()
    }
}
