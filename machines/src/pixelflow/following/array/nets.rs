//! The units of a node's array, and where their nets are.

use std::collections::{BTreeMap, VecDeque};

use tilewright_rtl::pixelflow::array::PixelArray;

use super::super::commands::{CONTROL, Commands, FIELDS, NETS};
use super::{ArrayObserver, Place, Registers};
use crate::looks::Looks;
use crate::told::{Told, Unit};

/// A clock of the array takes two ticks of the network, of 5 ns each.
const CLOCK: (&str, u64) = ("array", 10_000);
/// The banks of registers and their instances: two of the network, and the texture unit's.
const BANKS: [(&str, usize, usize); 3] = [("u_bank0", 256, 32), ("u_bank1", 288, 32), ("u_texture", 320, 64)];
const OF_BANK: [&str; 5] = ["read", "write", "port_pixel", "port_address", "port_writes"];
const OF_PIXEL: [&str; 8] =
    ["expression", "register_byte", "result", "writes_register", "accumulator", "carry", "flag", "enable"];

impl ArrayObserver {
    /// Of a node of that name.
    pub fn new(name: &str, array: &PixelArray, side_by_side: bool, place: Place) -> ArrayObserver {
        let lane = format!("[{}][{}]", place.chip, place.pixel);
        let chip = format!("[{}]", place.chip);
        let unit = |what: &str, block, path: &str| Unit::new(format!("{what} of {name}"), block, CLOCK, path);
        let pixel = format!("u_pixel{lane}.");
        let [x, y] = place.at;
        let units = [
            unit("controller", "array-controller", "u_controller."),
            unit("evaluator", "linear-evaluator", "u_evaluator."),
            unit(&format!("pixel ({x}, {y})"), "pixelflow-pixel", &pixel),
            unit("array", "pixel-array", ""),
        ];
        let (mut looks, mut ports) = (Looks::default(), Looks::default());
        let of_control = || CONTROL.iter().map(String::as_str);
        let controller = looks.add("u_controller.", FIELDS.iter().map(String::as_str).chain(NETS));
        let control = looks.add("u_controller.", of_control());
        let lanes = looks.add(&pixel, of_control());
        let of_pixel = looks.add(&pixel, OF_PIXEL);
        let evaluator =
            looks.add("u_evaluator.", ["coefficients_a", "coefficients_b", "coefficients_c", "first", "sends"]);
        looks.add("", [format!("u_evaluator.value{lane}").as_str()]);
        let mut pairs = Vec::new();
        let mut banks = Vec::new();
        for ((instance, first, bytes), number) in BANKS.into_iter().zip(0..) {
            let path = format!("{instance}.");
            let of_pixel = ["writes", "result", "word"].map(|net| format!("{net}{lane}"));
            let of_chip = ["port_bytes", "seen"].map(|net| format!("{net}{chip}"));
            let names = || OF_BANK.into_iter().chain(of_pixel.iter().chain(&of_chip).map(String::as_str));
            let (nets, port) = (looks.add(&path, names()), ports.add(&path, names()));
            let unit = unit(&format!("registers {instance}"), "communication-registers", &path);
            let top = if number < 2 { format!("network_{number}_") } else { "texture_".to_owned() };
            let seen = if number < 2 { format!("network_seen_{number}{chip}") } else { format!("texture_seen{chip}") };
            let names = ["pixel", "address", "writes"].map(|it| format!("{top}{it}"));
            let outside = looks.add("", names.iter().map(|it| &**it));
            looks.add("", [format!("{top}bytes{chip}"), seen].iter().map(|it| &**it));
            for (what, inside, out) in
                [("port_pixel", 2, 0), ("port_address", 3, 1), ("port_writes", 4, 2), ("port_bytes", 8, 3)]
            {
                pairs.push((what, [nets + inside, outside + out]));
            }
            pairs.push(("seen", [outside + 4, nets + 9]));
            banks.push(Registers { unit, first, bytes: vec![0; bytes], memories: None, written: [0; 2], nets, port });
        }
        let outside =
            looks.add("", ["instructions_valid", "bank_done", "texture_done", "side_by_side", "instructions_ready"]);
        looks.add("", ["given_banks", "given_texture", "idle"]);
        looks.add("u_controller.", ["side_by_side"]);
        let first = controller + FIELDS.len();
        for (what, inside, out) in [("instructions_valid", 0, 0), ("bank_done", 2, 1), ("texture_done", 3, 2)] {
            pairs.push((what, [first + inside, outside + out]));
        }
        pairs.push(("side_by_side", [outside + 8, outside + 3]));
        for (what, out, inside) in
            [("instructions_ready", 4, 1), ("given_banks", 5, 9), ("given_texture", 6, 10), ("idle", 7, 11)]
        {
            pairs.push((what, [outside + out, first + inside]));
        }
        for (what, to, from) in [
            ("coefficients_a", 0, 4),
            ("coefficients_b", 1, 5),
            ("coefficients_c", 2, 6),
            ("first", 3, 7),
            ("sends", 4, 8),
        ] {
            pairs.push((what, [evaluator + to, first + from]));
        }
        for (number, what) in CONTROL.iter().enumerate() {
            pairs.push((what.as_str(), [lanes + number, control + number]));
        }
        pairs.push(("expression", [of_pixel, evaluator + 5]));
        let lag = array.latency() as usize;
        ArrayObserver {
            told: Told::of(name),
            place,
            drawn: BTreeMap::new(),
            lag,
            units,
            banks,
            commands: Commands::new(array.latency(), side_by_side),
            sums: [0; 3],
            count: 0,
            to_come: (0..lag).map(|_| None).collect(),
            seen: VecDeque::new(),
            pixel: None,
            memory: None,
            written: 0,
            looks,
            ports,
            places: [controller, control, lanes, of_pixel, evaluator, outside],
            pairs,
            programs: VecDeque::new(),
            shown: None,
        }
    }
}
