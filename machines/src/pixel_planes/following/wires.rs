//! What connects the units of a renderer.

use tilewright_rtl::pixel_planes::instruction::Instruction;

use super::observer::Sim;
use crate::looks::Looks;
use crate::told::Checks;

/// Pairs of nets of a renderer that have the same values in each clock.
pub(super) struct Wires {
    pairs: Vec<(&'static str, [usize; 2])>,
    wide: Wide,
    /// The places of the fields of the instruction at the controller, and of other nets.
    fields: usize,
    others: usize,
}

impl Wires {
    /// The wires of a pixel at that column and line of the region.
    pub fn new(looks: &mut Looks, [column, line]: [u32; 2], quadratic: bool) -> Wires {
        let pixel = format!("u_pixel[{line}][{column}]");
        let mut pairs = Vec::new();
        let mut join = |what, from: &str, to: String| pairs.push((what, [from, &to].map(|net| looks.add("", [net]))));
        join("u_queue.into_valid", "instructions_valid", "u_queue.into_valid".into());
        join("instructions_ready", "u_queue.into_ready", "instructions_ready".into());
        join("room", "u_queue.into_ready", "room".into());
        join("u_controller.instructions_valid", "u_queue.out_valid", "u_controller.instructions_valid".into());
        join("u_queue.out_ready", "u_controller.instructions_ready", "u_queue.out_ready".into());
        join("u_controller.side_by_side", "side_by_side", "u_controller.side_by_side".into());
        join("u_controller.store_free", "u_store.free", "u_controller.store_free".into());
        join("idle", "u_controller.idle", "idle".into());
        for (what, name) in [
            ("u_tree.coefficients_a", "coefficients_a"),
            ("u_tree.coefficients_b", "coefficients_b"),
            ("u_tree.coefficients_c", "coefficients_c"),
            ("u_tree.first", "first"),
        ] {
            join(what, &format!("u_controller.{name}"), format!("u_tree.{name}"));
        }
        if quadratic {
            for (what, name) in [("u_tree.curve_d", "d"), ("u_tree.curve_e", "e"), ("u_tree.curve_f", "f")] {
                join(what, &format!("u_controller.curve_0_{name}"), format!("u_tree.curve_{name}"));
            }
        }
        for (what, name) in [
            ("u_store.save_claim", "save_claim"),
            ("u_store.save_region", "save_region"),
            ("u_store.save_plane", "save_plane"),
        ] {
            join(what, &format!("u_controller.{name}"), format!("u_store.{name}"));
        }
        join("u_store.planes_ready", "planes_ready", "u_store.planes_ready".into());
        for name in ["planes_valid", "planes_region", "planes_line", "planes_plane"] {
            join(name, &format!("u_store.{name}"), name.into());
        }
        let wide = Wide::new(&pixel, [column, line]);
        let fields = looks.add("u_controller.", super::commands::NETS[2..10].iter().map(String::as_str));
        let others = looks.add("", OTHERS);
        Wires { pairs, wide, fields, others }
    }

    /// Compares both ends of all wires, and the instruction at the controller with that of the host.
    pub fn look(&self, looks: &Looks, next: Option<&Instruction<u64>>, checks: &mut Checks) {
        for (what, [from, to]) in &self.pairs {
            checks.same(what, looks.at(*to), looks.at(*from));
        }
        let [out_valid, ready, takes, write, number] = looks.from(self.others);
        checks.same("takes", takes, out_valid & ready);
        checks.same("u_store.number", number, write & 63);
        let Some(next) = next.filter(|_| out_valid & ready == 1) else { return };
        let of = next.coefficients;
        let fields = [next.operation, next.skip, next.length, next.read, next.write, of.a, of.b, of.c];
        for ((place, what), field) in (self.fields..).zip(&super::commands::NETS[2..10]).zip(fields) {
            checks.same(what, looks.at(place), field & ((1 << 40) - 1));
        }
    }
}

/// Wires that all pixels have. To look at one costs as much as the clock itself.
struct Wide {
    looks: Looks,
    first: usize,
    /// The pixel's bit of the plane that leaves the store, and leaves the renderer.
    planes: Looks,
}

impl Wide {
    fn new(pixel: &str, [column, line]: [u32; 2]) -> Wide {
        let mut looks = Looks::default();
        let first = looks.add(&format!("{pixel}."), super::units::CONTROL[..12].iter().map(String::as_str));
        looks.add("u_controller.", super::units::CONTROL[..11].iter().map(String::as_str));
        let words = ["u_tree.value", "u_store.word"].map(|net| format!("{net}[{line}][{column}]"));
        looks.add("", [words[0].as_str(), &format!("{pixel}.word"), &words[1]]);
        let mut planes = Looks::default();
        planes.add(
            "",
            ["u_store.planes_bits", "planes_bits"].map(|net| format!("{net}[{column}]")).iter().map(|it| it.as_str()),
        );
        Wide { looks, first, planes }
    }
}

impl Wires {
    /// Compares both ends of the wires to and from the pixel. Returns the bit that the pixel reads, and that at the store.
    pub fn look_at_pixel(&mut self, sim: &mut Sim, checks: &mut Checks) -> [u64; 2] {
        let Wide { looks, first, .. } = &mut self.wide;
        looks.look(sim);
        let [to, from]: [[u64; 12]; 2] = [*first, *first + 12].map(|place| looks.from(place));
        for ((name, to), from) in super::units::CONTROL.iter().zip(to).zip(from) {
            checks.same(name, to, from);
        }
        let [word, stored] = looks.from(*first + 24);
        checks.same("u_store.word", stored, word);
        [word, stored]
    }

    /// Compares both ends of the wire of a plane. Returns the pixel's bit.
    pub fn look_at_planes(&mut self, sim: &mut Sim, checks: &mut Checks) -> u64 {
        self.wide.planes.look(sim);
        let [stored, sent] = self.wide.planes.from(0);
        checks.same("planes_bits", sent, stored);
        stored
    }
}

/// Nets that are compared with more than another one.
const OTHERS: [&str; 5] =
    ["u_queue.out_valid", "u_controller.instructions_ready", "takes", "u_controller.control_write", "u_store.number"];
