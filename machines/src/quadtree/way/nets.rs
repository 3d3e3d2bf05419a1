//! The nets of a window on its way from unit to unit.

use super::numbers::{Fields, Square};
use super::{Seen, Sim};
use crate::looks::Looks;
use crate::told::compared;
use crate::way::Compared;
use tilewright_rtl::quadtree::format::Format;

/// A stream of windows.
pub(super) struct Windows {
    port: String,
    /// The name of the net that says that there is one.
    pub valid: String,
    /// The place of that net, and of those for whether it is taken, its size, and its first sample.
    place: usize,
    /// The other fields: four bounds and planes, and lanes for edges.
    fields: Looks,
    room: usize,
}

/// A window beside what a model has.
pub(super) struct Beside {
    pub values: Vec<Compared>,
    /// The net to ask about: the first field that differs, or else whether there is a window.
    pub net: String,
}

impl Beside {
    /// Whether a value differs.
    pub fn differs(&self) -> bool {
        self.values.iter().any(Compared::differs)
    }
}

/// Fields beside what a model has, as they are shown.
#[derive(Default)]
struct Pair {
    hardware: Vec<String>,
    golden: Vec<String>,
    /// The places among the fields, and in these lists, of those that differ.
    differing: Vec<(usize, usize)>,
}

impl Windows {
    /// Those of a port, such as `u_processor[0].u_set_up.roots`.
    pub fn of(looks: &mut Looks, port: &str, format: &Format) -> Windows {
        let room = format.edges();
        let place = looks.add(port, ["_valid", "_ready", "_window_size", "_window_x", "_window_y"]);
        let mut fields = Looks::default();
        let mut lanes = |name: &str, lanes: u32| {
            let names: Vec<String> = (0..lanes).map(|lane| format!("_{name}[{lane}]")).collect();
            fields.add(port, names.iter().map(|it| &**it));
        };
        lanes("window_edges", room);
        lanes("window_planes", 4);
        for (name, count) in
            [("step_x", room), ("step_y", room), ("right", room), ("lower", room), ("plane_x", 4), ("plane_y", 4)]
        {
            lanes(&format!("polygon_{name}"), count);
        }
        fields.add(port, ["_polygon_last_edge"]);
        fields.add(
            port,
            ["left", "top", "right", "bottom"].map(|it| format!("_window_bounds_{it}")).iter().map(|it| &**it),
        );
        let (port, valid) = (port.to_owned(), format!("{port}_valid"));
        Windows { port, valid, place, fields, room: room as usize }
    }

    /// Whether there is a window.
    pub fn is_valid(&self, nets: &Looks) -> bool {
        nets.at(self.place) == 1
    }

    /// Whether a window is passed on at the coming edge.
    pub fn passes(&self, nets: &Looks) -> bool {
        self.is_valid(nets) && nets.at(self.place + 1) == 1
    }

    /// The window at the port.
    pub fn square(&self, nets: &Looks) -> Square {
        let [size, x, y] = nets.from(self.place + 2).map(|number| number as u32);
        Square { size, x, y }
    }

    /// The places of the planes, of the polygon's steps without its last edge, of that, and of the bounds, among the fields.
    fn places(&self) -> [usize; 4] {
        [self.room, self.room + 4, 5 * self.room + 12, 5 * self.room + 13]
    }

    /// The planes.
    pub fn planes(&mut self, sim: &mut Sim) -> [u64; 4] {
        self.fields.look(sim);
        self.fields.from(self.places()[0])
    }

    /// All of it beside what a model has, or `None` if no window comes there.
    pub fn compare(&mut self, seen: &mut Seen, golden: Option<&Fields>) -> Beside {
        let Some(golden) = golden else {
            return Beside { values: vec![compared("window", "another one", "nothing")], net: self.valid.clone() };
        };
        self.fields.look(seen.sim);
        let golden_planes: Vec<i64> = golden.planes.iter().map(|plane| *plane as i64).collect();
        let [planes, steps, last, bounds] = self.places();
        let [edges, bounds, planes, steps] = [
            self.pair(0.., &golden.edges, true),
            self.pair(bounds.., &golden.bounds, true),
            self.pair(planes.., &golden_planes, false),
            self.pair(std::iter::once(last).chain(steps..), &golden.steps, false),
        ];
        let square = self.square(seen.nets);
        let place = [&edges, &bounds, &planes, &steps].iter().find_map(|pair| pair.differing.first());
        let net = match (square.differs_in(golden.square), place) {
            (Some(field), _) => format!("{}_window_{field}", self.port),
            (None, Some((place, _))) => self.fields.path(*place).to_owned(),
            (None, None) => self.valid.clone(),
        };
        let shown = |Square { size, x, y }: Square| format!("{0}x{0} at {x},{y}", 1_u64 << size.min(32));
        let mut values = vec![compared("window", shown(square), shown(golden.square))];
        values.extend([("edges", edges), ("bounds", bounds), ("planes", planes)].map(|(what, pair)| pair.whole(what)));
        // They are the same in all windows of a polygon.
        values.extend(self.named(&steps));
        Beside { values, net }
    }

    /// Fields at these places beside what a model has.
    fn pair(&self, places: impl Iterator<Item = usize>, golden: &[i64], signed: bool) -> Pair {
        let mut pair = Pair::default();
        for (index, (place, golden)) in places.zip(golden).enumerate() {
            let width = self.fields.width(place);
            let shown = |number: u64| {
                let number = if width < 64 { number & ((1 << width) - 1) } else { number };
                match signed && number >> (width - 1) & 1 == 1 {
                    true => format!("-{}", (1_u128 << width) - u128::from(number)),
                    false => number.to_string(),
                }
            };
            let [hardware, golden] = [self.fields.at(place), *golden as u64].map(shown);
            if hardware != golden {
                pair.differing.push((place, index));
            }
            pair.hardware.push(hardware);
            pair.golden.push(golden);
        }
        pair
    }

    /// Those fields that differ, by name.
    fn named(&self, pair: &Pair) -> Option<Compared> {
        let beginning = format!("{}_polygon_", self.port);
        let list = |numbers: &[String]| {
            let named = pair.differing.iter().map(|&(place, index)| {
                let path = self.fields.path(place);
                format!("{} {}", path.strip_prefix(&beginning).unwrap_or(path), numbers[index])
            });
            named.collect::<Vec<_>>().join(", ")
        };
        let differs = !pair.differing.is_empty();
        differs.then(|| compared("fields", list(&pair.hardware), list(&pair.golden)))
    }
}

impl Pair {
    fn whole(&self, what: &'static str) -> Compared {
        compared(what, self.hardware.join(" "), self.golden.join(" "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadtree::config::Config;
    use crate::quadtree::hardware::Hardware;
    use crate::quadtree::way::Followed;
    use tilewright_scenes::{Scene, Size, project_polygons};

    #[test]
    fn a_field_that_differs_is_named_and_asked_about() {
        let (scene, size) = (Scene::builtin("star").unwrap(), Size::new(8, 6).unwrap());
        let packets = project_polygons(&scene, size).unwrap().polygons;
        let config = Config { matrix: (1, 1), ..Config::for_packets(size, &packets) };
        let mut hardware = Hardware::new(&config.generator().unwrap()).unwrap();
        hardware.reset(false).unwrap();
        let format = config.format().unwrap();
        let (levels, room) = (format.levels(), format.edges() as usize);
        let followed = Followed { format, pixel: 28, processor: 0, column: 0, row: 0, x: 4, y: 3 };
        let (mut nets, port) = (Looks::default(), "u_processor[0].u_set_up.roots");
        let mut windows = Windows::of(&mut nets, port, &followed.format);
        hardware.present(&packets[0]);
        nets.look(&mut hardware.sim);
        for _ in 0..50 {
            if !windows.is_valid(&nets) {
                hardware.step().unwrap();
                nets.look(&mut hardware.sim);
            }
        }
        let mut golden = followed.fields(&packets[0], followed.square(levels));
        let mut compare = |golden: &Fields| {
            let beside = windows.compare(&mut Seen { sim: &mut hardware.sim, nets: &nets }, Some(golden));
            let first = beside.values.into_iter().find(Compared::differs);
            (beside.net, first.map(|it| (it.what, it.hardware, it.golden.unwrap_or_default())))
        };
        assert_eq!(compare(&golden), (format!("{port}_valid"), None));
        // Behind the last edge are the steps along both axes, and then the two flags.
        let (was, right) = (golden.steps[1], 1 + 2 * room + 1);
        golden.steps[1] += 7;
        golden.steps[right] ^= 1;
        let shown = |step: i64, flag: i64| format!("step_x[0] {step}, right[1] {flag}");
        let differs = ("fields", shown(was, 1 - golden.steps[right]), shown(was + 7, golden.steps[right]));
        assert_eq!(compare(&golden), (format!("{port}_polygon_step_x[0]"), Some(differs)));
        golden.edges[2] += 1;
        assert_eq!(compare(&golden).0, format!("{port}_window_edges[2]"));
        golden.square.y += 1;
        assert_eq!(compare(&golden).0, format!("{port}_window_y"));
    }
}
