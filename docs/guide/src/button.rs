//! Chapter 11: a cell of the chip.

use tilewright_hdl::*;

block! {
    /// A pin of an iCE40 with a pull-up, and with a register in the pin itself.
    pub struct InputPin;
    foreign = Foreign::module("SB_IO")
        .parameter("PIN_TYPE", Bits::new(6, 0))
        .parameter("PULLUP", 1)
        .clock("INPUT_CLK")
        .capitals();
    in InputPinIn { package_pin: bit() }
    out InputPinOut { d_in_0: bit() }
}

impl InputPin {
    fn build(&self, m: Module, i: InputPinIn) -> InputPinOut {
        InputPinOut { d_in_0: m.pipe("sampled", i.package_pin) }
    }
}

block! {
    /// A lamp that is on while a button connects its pin to ground.
    pub struct Button;
    in ButtonIn { pin: bit() }
    out ButtonOut { led: bit() }
}

impl Button {
    fn build(&self, m: Module, i: ButtonIn) -> ButtonOut {
        def!(pin = m.instance(&InputPin, InputPinIn { package_pin: i.pin }));
        ButtonOut { led: !pin.d_in_0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn the_lamp_follows_the_button() {
        let mut sim = Simulation::of(&Button).unwrap();
        for (pin, led) in [(1, 1), (0, 0), (0, 1), (1, 1), (1, 0)] {
            sim.set(sim.i.pin, pin);
            assert_eq!(sim.get(sim.o.led), led);
            sim.step();
        }
    }
}
