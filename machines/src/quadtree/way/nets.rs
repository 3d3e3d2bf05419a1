//! The nets of a window on its way from unit to unit.

use super::numbers::{Fields, Square};
use super::{Seen, Sim};
use crate::looks::Looks;
use crate::told::compared;
use crate::way::Compared;
use tilewright_rtl::quadtree::format::Format;

/// A stream of windows.
pub(super) struct Windows {
    /// The name of the net that says that there is one.
    pub valid: String,
    /// The place of that net, and of those for whether it is taken, its size, and its first sample.
    place: usize,
    /// The other fields: four bounds and planes, and lanes for edges.
    fields: Looks,
    room: usize,
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
        Windows { valid: format!("{port}_valid"), place, fields, room: room as usize }
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

    /// All of it beside what a model has.
    pub fn compare(&mut self, seen: &mut Seen, golden: &Fields) -> Vec<Compared> {
        self.fields.look(seen.sim);
        let place = |Square { size, x, y }: Square| format!("{0}x{0} at {x},{y}", 1_u64 << size.min(32));
        let list = |places: &mut dyn Iterator<Item = usize>, golden: &[i64], signed: bool| {
            let (mut here, mut there) = (Vec::new(), Vec::new());
            for (place, golden) in places.zip(golden) {
                let width = self.fields.width(place);
                let shown = |number: u64| {
                    let number = if width < 64 { number & ((1 << width) - 1) } else { number };
                    match signed && number >> (width - 1) & 1 == 1 {
                        true => format!("-{}", (1_u128 << width) - u128::from(number)),
                        false => number.to_string(),
                    }
                };
                here.push(shown(self.fields.at(place)));
                there.push(shown(*golden as u64));
            }
            [here.join(" "), there.join(" ")]
        };
        let golden_planes: Vec<i64> = golden.planes.iter().map(|plane| *plane as i64).collect();
        let [planes, steps, last, bounds] = self.places();
        let [edges, bounds, planes, steps] = [
            list(&mut (0..), &golden.edges, true),
            list(&mut (bounds..), &golden.bounds, true),
            list(&mut (planes..), &golden_planes, false),
            list(&mut std::iter::once(last).chain(steps..), &golden.steps, false),
        ];
        let window = [place(self.square(seen.nets)), place(golden.square)];
        let pair = |what, [hardware, golden]: [String; 2]| compared(what, hardware, golden);
        let mut values = vec![pair("window", window), pair("edges", edges), pair("bounds", bounds)];
        values.push(pair("planes", planes));
        let steps = pair("steps", steps);
        // They are the same in all windows of a polygon.
        values.extend(Some(steps).filter(Compared::differs));
        values
    }
}
