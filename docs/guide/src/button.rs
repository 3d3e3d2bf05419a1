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
    in InputPinIn {
        /// The pin.
        package_pin: bit(),
    }
    out InputPinOut {
        /// The pin at the last edge.
        d_in_0: bit(),
    }
}

impl InputPin {
    fn build(&self, m: Module, i: InputPinIn) -> InputPinOut {
        InputPinOut { d_in_0: m.pipe("sampled", i.package_pin) }
    }
}

block! {
    /// A lamp that is on while a button connects its pin to ground.
    pub struct Button;
    in ButtonIn {
        /// The button, high unless it is pressed.
        pin: bit(),
    }
    out ButtonOut {
        /// The lamp.
        led: bit(),
    }
}

impl Button {
    fn build(&self, m: Module, i: ButtonIn) -> ButtonOut {
        def!(pin = m.instance(&InputPin, InputPinIn { package_pin: i.pin }));
        ButtonOut { led: !pin.d_in_0 }
    }
}

block! {
    /// A wire that this chip and others pull low.
    pub struct Line;
    in LineIn {
        /// The chip pulls it low.
        low: bit(),
        /// The others.
        sda: Outside::widths(1),
    }
    out LineOut {
        /// It is low.
        is_low: bit(),
    }
}

impl Line {
    fn build(&self, m: Module, i: LineIn) -> LineOut {
        def!(sda = m.instance(&Pad::new(1).pull_up(), PadIn::open_drain(i.low, i.sda)));
        LineOut { is_low: !sda.line }
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

    #[test]
    fn a_line_is_low_if_one_side_pulls_it() {
        let mut sim = Simulation::of(&Line).unwrap();
        for (low, drives, is_low) in [(0, 0, 0), (1, 0, 1), (0, 1, 1), (1, 1, 1)] {
            sim.drive(LineIn { low, sda: Outside { value: 0, drives } });
            assert_eq!(sim.get(sim.o.is_low), is_low);
            sim.step();
        }
    }
}
