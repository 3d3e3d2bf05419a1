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
        let clocks = m.reg("clocks", 8).reset(0);
        net!(
            over = clocks.ge(light.pick(|light| match light {
                Light::Green => lit(8, self.green - 1),
                Light::Amber => lit(8, self.amber - 1),
                Light::Red => lit(8, self.red - 1),
            }))
        );
        light.next(|light| match light {
            Light::Green => when(i.button & over, Light::Amber),
            Light::Amber => when(over, Light::Red),
            Light::Red => when(over, Light::Green),
        });
        net!(changes = over & (i.button | !light.is(Light::Green)));
        clocks.next(select([(changes, lit(8, 0)), (over, clocks.value())], clocks + 1));
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
