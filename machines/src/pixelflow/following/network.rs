//! A direction of the network in each tick, as far as it is about one pixel.

use tilewright_hdl::Codes;
use tilewright_rtl::pixelflow::TRANSFER;
use tilewright_rtl::pixelflow::compositor::Mode;
use tilewright_rtl::pixelflow::network::{NetworkIn, NetworkOut};
use tilewright_sim::Simulation;

use super::array::Place;
use crate::error::Error;
use crate::looks::Looks;
use crate::told::{Checks, Told, Unit, compared, value, violated};

const CLOCK: (&str, u64) = ("network", 5000);
/// The nets of a port; then those of the compositor of the pixel's chip; then those of the network's own ports.
const PORT: [&str; 9] =
    ["mode", "sends", "first", "upstream_valid", "upstream_first", "pixel", "advances", "unloaded", "downstream_valid"];
const COMPOSITOR: [&str; 7] = ["mode", "advances", "first", "pixel", "upstream", "own", "downstream"];

/// The ports of a node, and their models.
struct Port {
    units: [Unit; 2],
    nets: usize,
    compositor: usize,
    outside: usize,
    /// The pixel that comes next, and what has to be at the output.
    pixel: u64,
    valid: bool,
    first: u64,
    byte: Option<u64>,
    /// Whether the words of the pixel are equal so far, or the own one is the lesser.
    equal: bool,
    own: bool,
    /// The words that met, and what went on.
    words: [Vec<u8>; 3],
}

/// A direction of the network.
pub(in crate::pixelflow) struct NetworkObserver {
    pub told: Told,
    place: Place,
    pixels: u64,
    unit: Unit,
    ports: Vec<Port>,
    looks: Looks,
    /// The tick in which the composition began.
    from: u64,
}

impl NetworkObserver {
    /// Of a simulation of that number, of a network of so many nodes.
    pub fn new(number: usize, nodes: usize, pixels: usize, place: Place) -> NetworkObserver {
        let (mut looks, chip) = (Looks::default(), format!("[{}]", place.chip));
        let port = |number: usize| {
            let path = format!("u_port{number}.");
            let compositor = format!("{path}u_compositor{chip}.");
            let nets = looks.add(&path, PORT);
            looks.add(&path, ["downstream_first"]);
            let bytes = ["upstream_bytes", "own", "downstream_bytes"].map(|net| format!("{net}{chip}"));
            looks.add(&path, bytes.iter().map(|it| &**it));
            let of_compositor = looks.add(&compositor, COMPOSITOR);
            let outside =
                looks.add(&format!("nodes_{number}_"), ["mode", "sends", "first", "pixel", "advances", "unloaded"]);
            let bytes = ["own", "bytes"].map(|net| format!("{net}{chip}"));
            looks.add(&format!("nodes_{number}_"), bytes.iter().map(|it| &**it));
            Port {
                units: [
                    Unit::new(format!("network port {number}"), "network-port", CLOCK, &path),
                    Unit::new(format!("compositor {number}"), "compositor", CLOCK, &compositor),
                ],
                nets,
                compositor: of_compositor,
                outside,
                pixel: 0,
                valid: false,
                first: 0,
                byte: None,
                equal: true,
                own: false,
                words: Default::default(),
            }
        };
        let ports = (0..nodes).map(port).collect();
        let unit = Unit::new("network", "network", CLOCK, "");
        NetworkObserver {
            told: Told::of(super::network(number)),
            place,
            pixels: pixels as u64,
            unit,
            ports,
            looks,
            from: 0,
        }
    }

    /// A composition begins in that tick.
    pub fn begin(&mut self, from: u64) {
        self.from = from;
        for port in &mut self.ports {
            (port.pixel, port.valid, port.byte) = (0, false, None);
            port.words = Default::default();
        }
    }

    /// Looks at all ports before the edge that ends a tick, counted from the begin.
    pub fn look(&mut self, sim: &mut Simulation<NetworkIn, NetworkOut>, tick: u64) {
        self.looks.look(sim);
        self.told.at(sim.time() + TRANSFER.picoseconds());
        let tick = self.from + tick;
        let looks = &self.looks;
        let mut checks = Checks::default();
        for number in 0..self.ports.len() {
            let port = &self.ports[number];
            let [mode, sends, first, pixel, advances, unloaded, own, bytes] = looks.from(port.outside);
            let at = |place: usize| looks.at(port.nets + place);
            for (what, to, from) in
                [("mode", at(0), mode), ("sends", at(1), sends), ("first", at(2), first), ("own", at(11), own)]
            {
                checks.same(what, to, from);
            }
            for (what, to, from) in
                [("pixel", pixel, at(5)), ("advances", advances, at(6)), ("unloaded", unloaded, at(7))]
            {
                checks.same(what, to, from);
            }
            let before = number.checked_sub(1).map(|before| self.ports[before].nets);
            let from = before.map_or([0; 3], |before| [8, 9, 12].map(|net| looks.at(before + net)));
            for (what, to, from) in [
                ("upstream_valid", at(3), from[0]),
                ("upstream_first", at(4), from[1]),
                ("upstream_bytes", at(10), from[2]),
            ] {
                checks.same(what, to, from);
            }
            checks.same("bytes", bytes, from[2]);
        }
        self.told.extend(self.unit.differing(tick, "connects its ports", &mut checks));
        for port in &mut self.ports {
            port.look(looks, tick, self.pixels, self.place.pixel.into(), &mut self.told);
        }
    }

    /// Tells what the ports did with the words of the pixel.
    pub fn end(&mut self, tick: u64) {
        for (number, port) in self.ports.iter().enumerate() {
            let [upstream, own, _] = &port.words;
            let hex = |bytes: &[u8]| bytes.iter().map(|byte| format!("{byte:02x}")).collect::<String>();
            // A compositor takes only the words that its mode needs.
            let mode = match (upstream.is_empty(), own.is_empty()) {
                (true, true) => continue,
                (true, false) => Mode::Load,
                (false, false) => Mode::Composite,
                (false, true) if self.looks.at(port.nets) == Mode::Unload as u64 => Mode::Unload,
                (false, true) => Mode::Forward,
            };
            let mut values = vec![value("mode", mode.name())];
            let mut of = |what: &'static str, word: &[u8]| {
                if !word.is_empty() {
                    values.push(value(what, hex(word)));
                }
            };
            of("upstream", upstream);
            of("own", own);
            let (does, right) = match mode {
                Mode::Composite => ("passes on the lesser of two words", upstream.min(own)),
                Mode::Load => ("passes a word on", own),
                Mode::Forward | Mode::Unload => ("passes a word on", upstream),
            };
            if mode != Mode::Unload {
                values.push(compared("downstream", hex(&port.words[2]), hex(right)));
            }
            let step = port.units[1].step_at("downstream", self.from + tick + number as u64, None, does, values);
            self.told.tell(step);
        }
    }

    /// The step of an error that nothing told before.
    pub fn fail(&mut self, tick: u64, error: &Error) {
        if self.told.differs() {
            return;
        }
        let (instance, what) =
            violated(error).map_or((String::new(), error.to_string()), |(at, what)| (at.to_owned(), what.to_owned()));
        let units = self.ports.iter().flat_map(|port| &port.units);
        let unit = units.into_iter().find(|unit| unit.is(&instance)).unwrap_or(&self.unit);
        self.told.tell(unit.fails(self.from + tick, &what));
    }
}

impl Port {
    fn look(&mut self, looks: &Looks, tick: u64, pixels: u64, here: u64, told: &mut Told) {
        let mut checks = Checks::default();
        let [mode, sends, first, up_valid, up_first, pixel, advances, unloaded, valid, down_first, up_byte, own, byte] =
            looks.from(self.nets);
        let loads = mode == Mode::Load as u64;
        let goes = if loads { sends } else { up_valid };
        let is_first = if loads { first } else { up_first };
        checks.same("advances", advances, goes);
        checks.bit("unloaded", unloaded, mode == Mode::Unload as u64 && up_valid == 1);
        checks.same("pixel", pixel, self.pixel);
        checks.bit("downstream_valid", valid, self.valid);
        if self.valid {
            checks.same("downstream_first", down_first, self.first);
        }
        let [to_mode, to_advances, to_first, to_pixel, to_upstream, to_own, downstream] = looks.from(self.compositor);
        for (what, to, from) in [
            ("a compositor's mode", to_mode, mode),
            ("a compositor's advances", to_advances, advances),
            ("a compositor's first", to_first, is_first),
            ("a compositor's pixel", to_pixel, pixel),
            ("a compositor's upstream", to_upstream, up_byte),
            ("a compositor's own", to_own, own),
            ("downstream_bytes", byte, downstream),
        ] {
            checks.same(what, to, from);
        }
        told.extend(self.units[0].differing(tick, "counts pixels and passes bytes", &mut checks));
        if let Some(right) = self.byte {
            checks.same("downstream", downstream, right);
        }
        told.extend(self.units[1].differing(tick, "compares bytes", &mut checks));

        if advances == 1 {
            self.pixel = (pixel + 1) % pixels;
        }
        (self.valid, self.first) = (advances == 1, is_first);
        if to_advances == 1 {
            self.byte = self.composed(to_mode, to_first, (to_pixel == here, here), to_upstream, to_own);
        }
    }

    /// The byte that goes on.
    fn composed(&mut self, mode: u64, first: u64, (is_here, _): (bool, u64), upstream: u64, own: u64) -> Option<u64> {
        let is_composed = mode == Mode::Composite as u64;
        if is_here {
            if first == 1 {
                (self.equal, self.own) = (true, false);
                self.words = Default::default();
            }
            if self.equal && own != upstream {
                (self.equal, self.own) = (false, own < upstream);
            }
            let takes_own = mode == Mode::Load as u64 || is_composed && self.own;
            let byte = if takes_own { own } else { upstream };
            if mode != Mode::Load as u64 {
                self.words[0].push(upstream as u8);
            }
            if mode == Mode::Load as u64 || is_composed {
                self.words[1].push(own as u8);
            }
            self.words[2].push(byte as u8);
            return Some(byte);
        }
        match () {
            () if is_composed => None,
            () if mode == Mode::Load as u64 => Some(own),
            () => Some(upstream),
        }
    }
}
