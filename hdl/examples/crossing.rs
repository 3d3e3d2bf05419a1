//! A pedestrian crossing: a small state machine over an enum. Waves and Verilog show its states by name.
//! `cargo run -p tilewright-hdl --example crossing`

use tilewright_hdl::*;
use tilewright_sim::{Simulation, Vcd};

codes! { enum Light { Green, Amber, Red } }

block! {
    /// Cars have green until somebody presses the button, but for at least `clocks[0]` clocks; then amber and red
    /// last for the other two numbers.
    struct Crossing {
        clocks: [u64; 3],
    }
    in CrossingIn { button: bit() }
    out CrossingOut { cars_stop: bit(), walk: bit() }
}

impl Crossing {
    fn build(&self, m: Module, i: CrossingIn) -> CrossingOut {
        def!(light = m.fsm(Light::Green));
        def!(clocks = m.reg(4).reset(1));
        def!(over = clocks.eq(light.constants(4, |light| self.clocks[light as usize])));
        def!(changes = over & (i.button | !light.is(Light::Green)));
        clocks.when(changes | !over, mux(changes, 1, clocks + 1));
        light.next(|light| match light {
            Light::Green => when(changes, Light::Amber),
            Light::Amber => when(changes, Light::Red),
            Light::Red => when(changes, Light::Green),
        });
        CrossingOut { cars_stop: !light.is(Light::Green), walk: light.is(Light::Red) }
    }
}

/// Runs it; a test does so too.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let crossing = Crossing { clocks: [3, 1, 2] };
    let mut sim = Simulation::of(&crossing)?;
    let vcd = std::env::temp_dir().join("crossing.vcd");
    sim.trace(Vcd::to(&vcd))?;
    let wave = sim.record(["button", "light", "clocks", "walk"]);
    for (button, walk) in [(0, 0), (0, 0), (1, 0), (1, 0), (0, 1), (0, 1), (0, 0)] {
        sim.drive(CrossingIn { button });
        assert_eq!(sim.get(sim.o.walk), walk);
        sim.step();
    }
    sim.finish()?;
    println!("{} holds this wave:\n{wave}", vcd.display());
    print!("{}", tilewright_gen::verilog(&elaborate(&crossing)?)[0].text);
    Ok(())
}
