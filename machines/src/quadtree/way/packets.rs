//! The packets on their way to the video processor's set-up, and the windows that it makes.

use std::rc::Rc;

use tilewright_scenes::{Plane, Polygon};

use super::nets::{Beside, Windows};
use super::{Followed, Seen, Sim, nothing};
use crate::looks::Looks;
use crate::told::{At, Edge, Told, compared};
use crate::way::Compared;

/// The ends of a box.
const ENDS: [&str; 4] = ["left", "top", "right", "bottom"];

/// A place where packets pass one after another.
struct Place {
    unit: String,
    block: &'static str,
    does: &'static str,
    valid: String,
    /// The place of the nets that say whether a packet comes, and is taken.
    place: usize,
    /// The fields, and their names.
    fields: Looks,
    names: Vec<String>,
    /// The number of packets that have passed.
    passed: usize,
}

/// The model of the packets' way.
pub(super) struct Packets {
    followed: Followed,
    polygons: Rc<[Polygon]>,
    places: [Place; 2],
    roots: Windows,
    made: usize,
    /// The ends of the samples' places, at the video processor and at its set-up.
    ends: [Looks; 2],
}

impl Packets {
    pub fn new(looks: &mut Looks, followed: &Followed, polygons: Rc<[Polygon]>) -> Packets {
        let processor = format!("u_processor[{}]", followed.processor);
        let room = followed.format.edges();
        let mut place = |unit: String, block, does, port: String| {
            let lanes =
                |name: &str, count: u32| (0..count).map(|lane| format!("{port}_{name}[{lane}]")).collect::<Vec<_>>();
            let mut names = vec![format!("{port}_last_edge")];
            ["a", "b", "c"].iter().for_each(|it| names.extend(lanes(&format!("edges_{it}"), room)));
            ["x", "y", "origin"].iter().for_each(|it| names.extend(lanes(&format!("planes_{it}"), 4)));
            names.extend(ENDS.map(|it| format!("{port}_bounds_{it}")));
            let mut fields = Looks::default();
            fields.add("", names.iter().map(|it| &**it));
            Place {
                unit,
                block,
                does,
                valid: format!("{port}_valid"),
                place: looks.add(&port, ["_valid", "_ready"]),
                fields,
                names,
                passed: 0,
            }
        };
        let number = followed.processor;
        let places = [
            place(
                "broadcast".to_owned(),
                "quadtree-generator",
                "brings the packet to the video processor",
                format!("{processor}.packets"),
            ),
            place(
                format!("wire to the set-up of video processor {number}"),
                "video-processor",
                "passes the packet to the set-up",
                format!("{processor}.u_set_up.packets"),
            ),
        ];
        let ends = ["", ".u_set_up"].map(|path| {
            let mut ends = Looks::default();
            ends.add(&format!("{processor}{path}.place_"), ENDS);
            ends
        });
        let roots = Windows::of(looks, &format!("{processor}.u_set_up.roots"), &followed.format);
        Packets { followed: followed.clone(), polygons, places, roots, made: 0, ends }
    }

    /// Looks before an edge. Returns whether a packet passes.
    pub fn look(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) -> bool {
        let mut any = false;
        for number in 0..self.places.len() {
            if seen.nets.from(self.places[number].place) == [1, 1] {
                any = true;
                self.passes(seen.sim, edge, number, told);
            }
        }
        if self.roots.passes(seen.nets) {
            self.makes(seen, edge, told);
        }
        any
    }

    /// A packet passes a place.
    fn passes(&mut self, sim: &mut Sim, edge: Edge, number: usize, told: &mut Told) {
        let place = &mut self.places[number];
        let packet = self.polygons.get(place.passed);
        place.passed += 1;
        place.fields.look(sim);
        let place = &self.places[number];
        let fields = place.fields.values();
        let golden = packet.map(|packet| expected(packet, self.followed.format.edges() as usize));
        let wrong = match &golden {
            None => Some(("packet", "another one".to_owned(), "nothing".to_owned(), &place.valid)),
            Some(golden) => {
                (0..).zip(fields).zip(golden).zip(&place.names).find_map(|(((at, value), golden), name)| {
                    let width = place.fields.width(at);
                    let golden = *golden as u64 & if width < 64 { (1 << width) - 1 } else { u64::MAX };
                    let value = *value;
                    let field = name.rsplit('.').next().unwrap_or(name);
                    (value != golden)
                        .then(|| ("field", format!("{field} {value:x}"), format!("{field} {golden:x}"), name))
                })
            }
        };
        let is_told = number == 0 && packet.is_some_and(|it| self.followed.is_told(it));
        if is_told || wrong.is_some() {
            let primitive = packet.map(|_| place.passed - 1);
            let check = if number == 0 { "broadcast" } else { "packets" };
            told.check(check, 0, is_told, || {
                let number = (place.passed - 1).to_string();
                let (values, net) = match wrong {
                    Some((what, value, golden, net)) => (vec![compared(what, value, golden)], net),
                    None => (vec![compared("packet", &number, &number)], &place.valid),
                };
                let at = At { unit: place.unit.clone(), block: place.block, edge };
                at.step(place.does, values).of(primitive).on(net)
            });
        }
    }

    /// Compares the constants that say where the video processor's samples are.
    fn places(&mut self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        let Followed { format, column, row, processor, .. } = &self.followed;
        let place = format.place_of(*column, *row);
        let golden = [place.left, place.top, place.right, place.bottom];
        for ((path, block), ends) in
            [("", "quadtree-generator"), (".u_set_up", "video-processor")].into_iter().zip(&mut self.ends)
        {
            ends.look(sim);
            for (at, (end, golden)) in ENDS.iter().zip(golden).enumerate() {
                let (value, golden) = (ends.at(at), golden as u64 & ((1 << ends.width(at)) - 1));
                let name = format!("u_processor[{processor}]{path}.place_{end}");
                if value != golden {
                    told.check("place", 0, false, || {
                        let at = At { unit: format!("wire to `{name}`"), block, edge };
                        at.step("gives the place of the samples", vec![compared("value", value, golden)]).on(&name)
                    });
                    return;
                }
            }
        }
    }

    /// The set-up puts out the window of all samples.
    fn makes(&mut self, seen: &mut Seen, edge: Edge, told: &mut Told) {
        self.places(seen.sim, edge, told);
        let number = self.made;
        self.made += 1;
        let at = || At { unit: "set-up".to_owned(), block: "quadtree-set-up", edge };
        let Some(packet) = self.polygons.get(number) else {
            return told.check("root", 0, false, || {
                at().step("makes the window of all samples", vec![compared("window", "another one", "nothing")])
            });
        };
        let golden = self.followed.fields(packet, self.followed.square(self.followed.format.levels()));
        let Beside { values, net } = self.roots.compare(seen, Some(&golden));
        let is_told = self.followed.is_told(packet);
        if is_told || values.iter().any(Compared::differs) {
            told.check("root", 0, is_told, || {
                at().step("makes the window of all samples", values).of(Some(number)).on(net)
            });
        }
    }

    /// Drawing ends. Returns whether all packets have passed.
    pub fn ends(&self, edge: Edge, told: &mut Told) -> bool {
        let all = self.polygons.len();
        if let Some(place) = self.places.iter().find(|it| it.passed < all) {
            let step = nothing(place.unit.clone(), place.block, edge, place.does.to_owned(), "a packet");
            told.tell(step.of(Some(place.passed)).on(&place.valid));
            return false;
        }
        if self.made < all {
            let does = "makes the window of all samples".to_owned();
            let step = nothing("set-up".to_owned(), "quadtree-set-up", edge, does, "a window");
            told.tell(step.of(Some(self.made)).on(&self.roots.valid));
        }
        self.made >= all
    }
}

/// The fields of a packet as a port has them.
fn expected(packet: &Polygon, room: usize) -> Vec<i64> {
    let mut fields = vec![packet.edges.len() as i64 - 1];
    let rows: [fn(&tilewright_scenes::Edge) -> i32; 3] = [|it| it.a, |it| it.b, |it| it.c];
    for of in rows {
        fields.extend(packet.edges.iter().map(|edge| i64::from(of(edge))).chain(std::iter::repeat(0)).take(room));
    }
    let [red, green, blue] = &packet.rgb;
    let planes: [&Plane; 4] = [&packet.z, red, green, blue];
    fields.extend(planes.map(|plane| plane.x as i64));
    fields.extend(planes.map(|plane| plane.y as i64));
    fields.extend(planes.map(|plane| plane.origin as i64));
    let bounds = packet.bounds;
    fields.extend([bounds.left, bounds.top, bounds.right, bounds.bottom].map(i64::from));
    fields
}
