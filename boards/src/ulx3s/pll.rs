//! PLLs of an ECP5.

use super::{CORE, PIXEL, SERIAL, SLOW};
use tilewright_hdl::{Foreign, Module, Signal, bit, block, def, lit, record, up_to};
use tilewright_rtl::clocks::{MERGE, PE};

record! {
    /// The inputs of an ECP5's PLL beside its clocks. Its phase can be moved while it runs, which no PLL here does.
    pub struct PllIn {
        /// Resets the PLL.
        rst: bit(),
        /// Stops the PLL.
        stdby: bit(),
        /// The output whose phase moves.
        phasesel0: bit(),
        /// The output whose phase moves.
        phasesel1: bit(),
        /// The direction of the move.
        phasedir: bit(),
        /// Moves the phase by a step.
        phasestep: bit(),
        /// Loads the phase.
        phaseloadreg: bit(),
        /// Locks again after a stop.
        pllwakesync: bit(),
        /// Keeps the output.
        enclkop: bit(),
    }

    /// The output of an ECP5's PLL beside its clocks.
    pub struct PllOut {
        /// The clocks are stable.
        lock: bit(),
    }
}

/// The inputs of a PLL, at rest.
pub fn at_rest() -> PllIn {
    let [low, high] = [lit(1, 0), lit(1, 1)];
    PllIn {
        rst: low,
        stdby: low,
        phasesel0: low,
        phasesel1: low,
        phasedir: high,
        phasestep: high,
        phaseloadreg: high,
        pllwakesync: low,
        enclkop: low,
    }
}

/// The settings of the loop that all PLLs share.
fn pll() -> Foreign {
    Foreign::module("EHXPLLL")
        .parameter("FEEDBK_PATH", "CLKOP")
        .attribute("ICP_CURRENT", "12")
        .attribute("LPF_RESISTOR", "8")
        .attribute("MFG_ENABLE_FILTEROPAMP", "1")
        .attribute("MFG_GMCREF_SEL", "2")
        .clock_of(PIXEL, "CLKI")
        .capitals()
}

/// The model: it locks after some clocks.
fn locks(m: Module) -> Signal {
    let m = m.on(PIXEL);
    def!(clocks = m.reg(up_to(7)).initial(0));
    clocks.when(clocks.ne(7), clocks + 1);
    def!(locked = m.reg(bit()).initial(0));
    locked.next(clocks.eq(7));
    *locked
}

block! {
    /// The PLL of an ECP5 as it makes 125 MHz of 25 MHz. Its oscillator runs at 625 MHz.
    pub struct SerialPll;
    foreign = pll()
        .parameter("CLKI_DIV", 1)
        .parameter("CLKFB_DIV", 5)
        .parameter("CLKOP_DIV", 5)
        .parameter("CLKOP_CPHASE", 2)
        .clock_of(SERIAL, "CLKFB")
        .makes(SERIAL, "CLKOP");
    in = PllIn;
    out = PllOut;
}

impl SerialPll {
    fn build(&self, m: Module, i: PllIn) -> PllOut {
        m.ignore(&i);
        PllOut { lock: locks(m) }
    }
}

block! {
    /// The PLL of an ECP5 as it makes the clocks of the VC-1 of 25 MHz: 40 MHz for the processing elements, and
    /// 12.5 MHz for the merger. Its oscillator runs at 600 MHz.
    pub struct MachinePll;
    foreign = pll()
        .parameter("CLKI_DIV", 5)
        .parameter("CLKFB_DIV", 8)
        .parameter("CLKOP_DIV", 15)
        .parameter("CLKOP_CPHASE", 7)
        .parameter("CLKOS_ENABLE", "ENABLED")
        .parameter("CLKOS_DIV", 48)
        .parameter("CLKOS_CPHASE", 7)
        .clock_of(PE, "CLKFB")
        .makes(PE, "CLKOP")
        .makes(MERGE, "CLKOS");
    in = PllIn;
    out = PllOut;
}

impl MachinePll {
    fn build(&self, m: Module, i: PllIn) -> PllOut {
        m.ignore(&i);
        PllOut { lock: locks(m) }
    }
}

block! {
    /// The PLL of an ECP5 as it makes 16.7 MHz of 25 MHz. Its oscillator runs at 600 MHz.
    pub struct SlowPll;
    foreign = pll()
        .parameter("CLKI_DIV", 3)
        .parameter("CLKFB_DIV", 2)
        .parameter("CLKOP_DIV", 36)
        .parameter("CLKOP_CPHASE", 17)
        .clock_of(SLOW, "CLKFB")
        .makes(SLOW, "CLKOP");
    in = PllIn;
    out = PllOut;
}

impl SlowPll {
    fn build(&self, m: Module, i: PllIn) -> PllOut {
        m.ignore(&i);
        PllOut { lock: locks(m) }
    }
}

block! {
    /// The PLL of an ECP5 as it makes 80 MHz of 25 MHz. Its oscillator runs at 560 MHz.
    pub struct CorePll;
    foreign = pll()
        .parameter("CLKI_DIV", 5)
        .parameter("CLKFB_DIV", 16)
        .parameter("CLKOP_DIV", 7)
        .parameter("CLKOP_CPHASE", 3)
        .clock_of(CORE, "CLKFB")
        .makes(CORE, "CLKOP");
    in = PllIn;
    out = PllOut;
}

impl CorePll {
    fn build(&self, m: Module, i: PllIn) -> PllOut {
        m.ignore(&i);
        PllOut { lock: locks(m) }
    }
}
