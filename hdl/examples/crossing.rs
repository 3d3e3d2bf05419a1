//! A pedestrian crossing: a small state machine over an enum, whose state shows by name in waves and Verilog.
//!
//! `cargo run -p tilewright-hdl --example crossing`

use tilewright_hdl::*;
use tilewright_sim::Simulation;

states! { enum Light { Green, Amber, Red } }

bundle! {
    struct CrossingIn<T> { button: T }
    struct CrossingOut<T> { cars_stop: T, walk: T }
}

/// Cars have green until somebody presses the button, and then at least for `green` clocks since the last time.
#[derive(Debug)]
struct Crossing {
    green: u64,
    amber: u64,
    red: u64,
}

impl Block for Crossing {
    type In = CrossingIn;
    type Out = CrossingOut;

    fn inputs(&self) -> CrossingIn<Width> {
        CrossingIn { button: bit() }
    }

    fn build(&self, m: Module, i: CrossingIn) -> CrossingOut {
        let light = m.fsm("light", Light::Green);
        let clocks = m.reg("clocks", 4).reset(1);
        net!(
            over = clocks.eq(light.constants(4, |light| match light {
                Light::Green => self.green,
                Light::Amber => self.amber,
                Light::Red => self.red,
            }))
        );
        net!(changes = over & (i.button | !light.is(Light::Green)));
        clocks.enable(changes | !over).next(mux(changes, 1, clocks + 1));
        light.next(|light| match light {
            Light::Green => when(changes, Light::Amber),
            Light::Amber => when(changes, Light::Red),
            Light::Red => when(changes, Light::Green),
        });
        CrossingOut { cars_stop: !light.is(Light::Green), walk: light.is(Light::Red) }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut sim = Simulation::of(&Crossing { green: 3, amber: 1, red: 2 })?;
    let wave = sim.record(["button", "light", "clocks", "walk"]);
    for button in [0, 0, 1, 1, 0, 0, 0, 0] {
        sim.drive(CrossingIn { button });
        sim.step();
    }
    println!("{wave}");
    Ok(())
}
