//! The wires between units: what goes in at one end comes out at the other.

use tilewright_rtl::vc1::Vc1;

use super::{Sim, pe};
use crate::looks::Looks;
use crate::told::{At, Told, compared};

/// Clocks between two looks at wires, after the first ones. A wire that is wrong is wrong most of the time.
const EVERY: u64 = 32;
/// Clocks from the beginning in each of which wires are looked at.
const FIRST: u64 = 256;

/// A wire: the block that it is in, its end, and where it comes from.
type Wire = (&'static str, String, String);

/// Wires that are looked at together.
struct Bundle {
    wires: Vec<Wire>,
    /// The end and the beginning of each.
    looks: Looks,
}

/// The wires of a machine: those of each processing element, and all others.
pub(super) struct Wires {
    of_each: Vec<Bundle>,
    others: Bundle,
}

impl Bundle {
    fn of(wires: Vec<Wire>) -> Bundle {
        let mut looks = Looks::default();
        looks.add("", wires.iter().flat_map(|(_, end, begin)| [end.as_str(), begin]));
        Bundle { wires, looks }
    }

    fn look(&mut self, sim: &mut Sim, clock: u64, told: &mut Told) {
        self.looks.look(sim);
        for ((block, end, begin), values) in self.wires.iter().zip(self.looks.values().chunks_exact(2)) {
            let [came, went] = [values[0], values[1]];
            if came != went {
                told.check("wire", 0, false, || {
                    let at = At { unit: format!("wire to `{end}`"), block, edge: pe(clock) };
                    at.step(format!("brings `{begin}`"), vec![compared("value", came, went)]).on(end)
                });
            }
        }
    }
}

impl Wires {
    pub fn new(machine: &Vc1) -> Wires {
        let of_each = (0..machine.processors).map(|number| Bundle::of(of_processor(number))).collect();
        Wires { of_each, others: Bundle::of(others()) }
    }

    /// Looks at the wires of a processing element, each time of another one.
    pub fn look(&mut self, sim: &mut Sim, clock: u64, told: &mut Told) {
        if clock > FIRST && !clock.is_multiple_of(EVERY) {
            return;
        }
        let count = self.of_each.len() as u64;
        let number = (if clock > FIRST { clock / EVERY } else { clock }) % count;
        self.of_each[number as usize].look(sim, clock, told);
        self.others.look(sim, clock, told);
    }

    /// The names of all nets at the ends of wires.
    #[cfg(test)]
    fn names(&self) -> impl Iterator<Item = &String> {
        let wires = self.of_each.iter().chain([&self.others]).flat_map(|it| &it.wires);
        wires.flat_map(|(_, end, begin)| [end, begin])
    }
}

fn of_processor(number: u32) -> Vec<Wire> {
    let lfb = |name: &str| format!("u_lfb[{number}].{name}");
    let swap = |name: &str| format!("u_swap.{name}[{number}]");
    let local = |name: &str| format!("u_swap.u_lfb_swap[{number}].{name}");
    let port = |name: &str| format!("processors_{number}_{name}");
    let mut wires = vec![
        ("vc1", swap("done"), port("done")),
        ("vc1", swap("patch"), port("clear_patch")),
        ("vc1", lfb("swap"), swap("swap")),
        ("vc1", lfb("resume"), swap("resume")),
        ("vc1", lfb("clear_valid"), port("clear_valid")),
        ("vc1", lfb("clear_patch"), port("clear_patch")),
        ("vc1", lfb("request_valid"), port("request_valid")),
        ("vc1", port("request_ready"), lfb("request_ready")),
        ("vc1", port("clear_ready"), lfb("clear_ready")),
        ("vc1", port("state"), swap("state")),
        ("vc1", port("pages_used"), lfb("pages_used")),
        ("vc1", port("idle"), lfb("idle")),
        ("vc1-swap", format!("u_swap.u_sync_line.ready_{number}"), local("ready")),
        ("vc1-swap", format!("u_swap.u_gfb_swap.frames_{number}"), local("frame")),
        ("vc1-swap", format!("u_swap.u_gfb_swap.sending_{number}"), swap("sending")),
        ("vc1-swap", local("line"), "u_swap.u_sync_line.line".to_owned()),
        ("vc1-swap", local("shown"), "u_swap.u_gfb_swap.shown".to_owned()),
        ("lfb-unit", lfb("overflow"), lfb("u_patch_table.overflow")),
        ("lfb-unit", lfb("pages_used"), lfb("u_patch_table.pages_used")),
        ("lfb-unit", lfb("draws"), lfb("accept")),
        ("lfb-unit", lfb("word"), lfb("u_image_memory.sent")),
        ("lfb-unit", lfb("request_ready"), lfb("u_patch_table.look_up_ready")),
        ("lfb-unit", lfb("clear_ready"), lfb("u_patch_table.clear_ready")),
        ("lfb-unit", lfb("u_patch_table.look_up_valid"), lfb("request_valid")),
        ("lfb-unit", lfb("u_patch_table.clear_valid"), lfb("clear_valid")),
        ("lfb-unit", lfb("u_patch_table.clear_patch"), lfb("clear_patch")),
        ("lfb-unit", lfb("u_patch_table.front"), lfb("front")),
        ("lfb-unit", lfb("u_patch_table.settled"), lfb("settled")),
        ("lfb-unit", lfb("u_patch_table.restart"), lfb("swap")),
        ("lfb-unit", lfb("u_patch_table.resume"), lfb("resume")),
        ("lfb-unit", lfb("u_patch_table.scan_buffer"), lfb("back")),
        ("lfb-unit", lfb("u_image_memory.front"), lfb("front")),
        ("lfb-unit", lfb("u_image_memory.draw_valid"), lfb("u_patch_table.found")),
        ("lfb-unit", lfb("u_image_memory.send_buffer"), lfb("back")),
        ("patch-table", lfb("u_patch_table.u_page_id_generator.restart"), lfb("u_patch_table.restart")),
    ];
    for name in ["overflow", "draws", "clears", "sending"] {
        wires.push(("vc1", swap(name), lfb(name)));
    }
    for name in ["done", "idle", "overflow", "draws", "clears", "patch", "sending"] {
        wires.push(("vc1-swap", local(name), swap(name)));
    }
    for name in ["swap", "resume", "state"] {
        wires.push(("vc1-swap", swap(name), local(name)));
    }
    wires
}

fn others() -> Vec<Wire> {
    let wires = [
        ("vc1", "u_swap.bus", "u_bus.idle"),
        ("vc1", "u_swap.host", "ready"),
        ("vc1", "u_swap.enable", "u_gfb.scan_enable"),
        ("vc1", "u_swap.blanking", "u_gfb.blanking"),
        ("vc1", "u_gfb.swap", "u_swap.gfb_swap"),
        ("vc1", "u_gfb.merged", "u_merger.merged"),
        ("vc1", "u_gfb.host_background", "host_background"),
        ("vc1", "u_merger.left", "u_gfb.left"),
        ("vc1", "line", "u_swap.line"),
        ("vc1", "is_merged", "u_swap.merged"),
        ("vc1", "shown", "u_swap.shown"),
        ("vc1", "pixel_valid", "u_gfb.pixel_valid"),
        ("vc1", "pixel_rgb", "u_gfb.pixel_rgb"),
        ("vc1-swap", "u_swap.u_sync_line.bus", "u_swap.bus"),
        ("vc1-swap", "u_swap.u_sync_line.host", "u_swap.host"),
        ("vc1-swap", "u_swap.u_gfb_swap.enable", "u_swap.enable"),
        ("vc1-swap", "u_swap.u_gfb_swap.blanking", "u_swap.blanking"),
        ("vc1-swap", "u_swap.line", "u_swap.u_sync_line.line"),
        ("vc1-swap", "u_swap.gfb_swap", "u_swap.u_gfb_swap.swap"),
        ("vc1-swap", "u_swap.merged", "u_swap.u_gfb_swap.merged"),
        ("vc1-swap", "u_swap.shown", "u_swap.u_gfb_swap.shown"),
        ("gfb-unit", "u_gfb.u_sequencer.restart", "u_gfb.swap"),
        ("gfb-unit", "u_gfb.scan_enable", "u_gfb.u_sequencer.scan_enable"),
        ("gfb-unit", "u_gfb.scan_restart", "u_gfb.u_sequencer.scan_restart"),
        ("gfb-unit", "u_gfb.pixel_valid", "u_gfb.u_crt.pixel_valid"),
        ("gfb-unit", "u_gfb.pixel_rgb", "u_gfb.u_crt.pixel_rgb"),
    ];
    wires.into_iter().map(|(block, end, begin)| (block, end.to_owned(), begin.to_owned())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vc1::Config;
    use tilewright_rtl::clocks::PE;
    use tilewright_scenes::Size;
    use tilewright_sim::Simulation;

    #[test]
    fn a_machine_has_all_of_them_and_none_is_wrong() {
        let config = Config { processors: 2, ..Config::new(Size::new(16, 12).unwrap()) };
        let machine = config.hardware().unwrap();
        let (mut sim, mut wires) = (Simulation::of(&machine).unwrap(), Wires::new(&machine));
        sim.reset();
        let unknown: Vec<String> =
            wires.names().filter_map(|name| sim.peek(name).err()).map(|it| it.to_string()).collect();
        assert_eq!(unknown, Vec::<String>::new());
        let mut told = Told::default();
        for clock in 1..40 {
            sim.step_clock(PE.name, 1);
            wires.look(&mut sim, clock, &mut told);
        }
        assert_eq!(told.take(), []);
    }
}
