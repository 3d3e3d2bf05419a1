//! The border of a chip, with models: a foreign module, a clock that it makes, and pads.

use tilewright_cosim::check::check_design;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

const FAST: Clock = Clock::new("fast", Period::ns(7));

block! {
    /// Makes a clock. Its model locks after some clocks, and has an assertion.
    struct Pll { clocks: u32 }
    foreign(self) = Foreign::module("PLL")
        .parameter("RATIO", 10.0 / 7.0)
        .clock("CKI")
        .reset("RST")
        .makes(FAST, "CKO")
        .capitals();
    out PllOut { lock: bit() }
}

impl Pll {
    fn build(&self, m: Module, (): ()) -> PllOut {
        def!(count = m.reg(up_to(self.clocks)).reset(0));
        def!(lock = count.eq(self.clocks));
        count.when(!lock, count + 1);
        m.assert(m.past(lock).implies(lock), "it stays locked");
        PllOut { lock }
    }
}

block! {
    /// Keeps what it sees on a bus, and shows it there.
    struct Chip;
    in ChipIn { show: bit().on(FAST), call: bit(), bus: Outside { value: bits(8), drives: bit() }.on(FAST), irq: Outside::widths(1) }
    out ChipOut { bus_line: bits(8), irq_line: bit(), lock: bit() }
}

impl Chip {
    fn build(&self, m: Module, i: ChipIn) -> ChipOut {
        def!(pll = m.instance(&Pll { clocks: 5 }, ()));
        let fast = m.on(FAST);
        def!(seen = fast.reg(8).reset(0));
        def!(bus = fast.instance(&Pad::new(8), PadIn { out: *seen, enable: i.show, outside: i.bus }));
        def!(irq = m.instance(&Pad::new(1).pull_up(), PadIn::open_drain(i.call & pll.lock, i.irq)));
        seen.when(!i.show, bus.line + 1);
        ChipOut { bus_line: bus.line, irq_line: irq.line, lock: pll.lock }
    }
}

#[test]
fn others_agree_on_the_border_of_a_chip() {
    let stimulus = |sim: &mut Simulation| {
        let names = ["show", "call", "bus_value", "bus_drives", "irq_drives"];
        let ports = names.map(|name| sim.port(name).unwrap());
        for step in 0..60u64 {
            // Two sides never drive the bus at once; those of the open drain may.
            let show = step / 3 % 2;
            let values = [show, step / 5 % 2, step * 37 % 256, (1 - show) * (step % 2), step / 7 % 2];
            ports.into_iter().zip(values).for_each(|(port, value)| sim.set(port, value));
            sim.try_step()?;
        }
        Ok(())
    };
    check_design(&elaborate(&Chip).unwrap(), stimulus).unwrap();
}
