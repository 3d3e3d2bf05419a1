//! The nets of a window on its way from unit to unit.

use super::numbers::{Fields, Square};
use super::{Sim, net};
use crate::told::compared;
use crate::way::Compared;
use tilewright_rtl::quadtree::format::Format;

/// The names of a stream of windows.
pub(super) struct Windows {
    pub valid: String,
    pub ready: String,
    place: [String; 3],
    edges: Vec<String>,
    bounds: [String; 4],
    planes: Vec<String>,
    steps: Vec<String>,
}

impl Windows {
    /// Those of a port, such as `u_processor[0].u_set_up.roots`.
    pub fn of(port: &str, format: &Format) -> Windows {
        let room = format.edges();
        let lanes =
            |name: &str, lanes: u32| (0..lanes).map(|lane| format!("{port}_{name}[{lane}]")).collect::<Vec<_>>();
        let mut steps = vec![format!("{port}_polygon_last_edge")];
        for (name, count) in
            [("step_x", room), ("step_y", room), ("right", room), ("lower", room), ("plane_x", 4), ("plane_y", 4)]
        {
            steps.extend(lanes(&format!("polygon_{name}"), count));
        }
        Windows {
            valid: format!("{port}_valid"),
            ready: format!("{port}_ready"),
            place: ["size", "x", "y"].map(|it| format!("{port}_window_{it}")),
            edges: lanes("window_edges", room),
            bounds: ["left", "top", "right", "bottom"].map(|it| format!("{port}_window_bounds_{it}")),
            planes: lanes("window_planes", 4),
            steps,
        }
    }

    /// Whether a window is passed on at the coming edge.
    pub fn passes(&self, sim: &mut Sim) -> bool {
        net(sim, &self.valid) == 1 && net(sim, &self.ready) == 1
    }

    /// The window at the port.
    pub fn square(&self, sim: &mut Sim) -> Square {
        let [size, x, y] = [0, 1, 2].map(|i| net(sim, &self.place[i]) as u32);
        Square { size, x, y }
    }

    /// All of it beside what a model has.
    pub fn compare(&self, sim: &mut Sim, golden: &Fields) -> Vec<Compared> {
        let place = |Square { size, x, y }: Square| format!("{0}x{0} at {x},{y}", 1_u64 << size.min(32));
        let mut list = |names: &[String], golden: &[i64], signed: bool| {
            let (mut here, mut there) = (Vec::new(), Vec::new());
            for (name, golden) in names.iter().zip(golden) {
                let value = sim.peek(name).unwrap_or_else(|unknown| panic!("{unknown}"));
                let width = value.width();
                let number = value.to_u64().expect("it has at most 64 bits");
                let shown = |number: u64| {
                    let number = if width < 64 { number & ((1 << width) - 1) } else { number };
                    match signed && number >> (width - 1) & 1 == 1 {
                        true => format!("-{}", (1_u128 << width) - u128::from(number)),
                        false => number.to_string(),
                    }
                };
                here.push(shown(number));
                there.push(shown(*golden as u64));
            }
            [here.join(" "), there.join(" ")]
        };
        let planes: Vec<i64> = golden.planes.iter().map(|plane| *plane as i64).collect();
        let [edges, bounds, planes, steps] = [
            list(&self.edges, &golden.edges, true),
            list(&self.bounds, &golden.bounds, true),
            list(&self.planes, &planes, false),
            list(&self.steps, &golden.steps, false),
        ];
        let window = [place(self.square(sim)), place(golden.square)];
        let pair = |what, [hardware, golden]: [String; 2]| compared(what, hardware, golden);
        let mut values = vec![pair("window", window), pair("edges", edges), pair("bounds", bounds)];
        values.push(pair("planes", planes));
        let steps = pair("steps", steps);
        // They are the same in all windows of a polygon.
        values.extend(Some(steps).filter(Compared::differs));
        values
    }
}
