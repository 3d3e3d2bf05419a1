//! The other sides of pads: most often they leave a line alone that the chip drives, since an assertion ends the run
//! where both drive it and differ.

use super::Numbers;
use tilewright_hdl::ir::{Design, Instance};
use tilewright_sim::{Port, Simulation};

/// A pad's other side, and the paths of what the chip does.
pub struct Outside {
    value: Port,
    drives: Port,
    enable: String,
    out: String,
}

/// Those of a design that is simulated.
pub fn outsides(design: &Design, sim: &Simulation) -> Vec<Outside> {
    let top = design.top();
    let outside = |pad: &Instance| {
        let [value, drives] = pad.outside()?;
        let port = |node| sim.port(top.node(node).name.as_deref()?).ok();
        let path = |port: &str| format!("{}.{port}", pad.name);
        Some(Outside { value: port(value)?, drives: port(drives)?, enable: path("enable"), out: path("out") })
    };
    top.instances.iter().filter(|pad| design.module(pad.module).is_pad).filter_map(outside).collect()
}

impl Outside {
    /// Gives way to the chip, in most steps; in some it drives what the chip does.
    pub fn give_way(&self, sim: &mut Simulation, numbers: &mut Numbers) {
        let drawn = numbers.draw() % 16;
        let Ok(enable) = sim.peek(&self.enable) else { return };
        match drawn {
            _ if enable.is_zero() => {}
            0 => {} // Both may drive.
            1 | 2 => {
                if let Ok(out) = sim.peek(&self.out) {
                    sim.set(self.value, out);
                }
            }
            _ => sim.set(self.drives, 0),
        }
    }
}
