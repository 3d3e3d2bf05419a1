//! Chapter 3: a decimal stopwatch.

use tilewright_hdl::*;

block! {
    /// Counts tenths of a second up to 59.9 in decimal digits, and compares with a record.
    pub struct Stopwatch;
    in StopwatchIn {
        /// A tenth of a second has passed.
        tick: bit(),
        /// Starts again at zero.
        clear: bit(),
        /// The time to beat, in tenths.
        record: up_to(599),
    }
    out StopwatchOut {
        /// The digits side by side: 0x123 is 12.3 seconds.
        digits: bits(12),
        /// Tenths that are left until the record; negative beyond it.
        left: bits(11).signed(),
    }
}

impl Stopwatch {
    fn build(&self, m: Module, i: StopwatchIn) -> StopwatchOut {
        def!(tenths = m.reg(below(10)).reset(0));
        def!(ones = m.reg(below(10)).reset(0));
        def!(tens = m.reg(below(6)).reset(0));
        let mut tick = i.tick;
        for (digit, last) in [(tenths, 9), (ones, 9), (tens, 5)] {
            let carry = tick & digit.eq(last);
            digit.when(i.clear | carry, 0).when(tick, digit + 1);
            tick = carry;
        }
        def!(passed = tens * 100 + (ones * 10).zext(10) + tenths.zext(10));
        let left = i.record.zext(11).signed() - passed.zext(11).signed();
        StopwatchOut { digits: cat![tens.zext(4), ones, tenths], left }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::{Simulation, WaveRadix};

    #[test]
    fn digits_carry() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Stopwatch)?;
        sim.drive(StopwatchIn { tick: 1, clear: 0, record: 100 });
        sim.run(97);
        let wave =
            sim.record(["tenths", "ones", "tens", "digits", "passed", "left"]).radix("passed", WaveRadix::Decimal);
        sim.run(5);
        wave.expect(
            r"
            clk    |~~\__/~~\__/~~\__/~~\__/~~\__/
            tenths | 7   | 8   | 9   | 0   | 1   |
            ones   | 9               | 0         |
            tens   | 0               | 1         |
            digits | 97  | 98  | 99  | 100 | 101 |
            passed | 97  | 98  | 99  | 100 | 101 |
            left   | 3   | 2   | 1   | 0   | -1  |",
        );
        Ok(())
    }

    #[test]
    fn it_counts_in_decimal() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Stopwatch)?;
        sim.drive(StopwatchIn { tick: 1, clear: 0, record: 0 });
        for tenths in 0..1300 {
            let shown = format!("{:x}", sim.get_u64(sim.o.digits));
            assert_eq!(shown, (tenths % 600).to_string());
            sim.step();
        }
        Ok(())
    }
}
