//! When something is done: at power-on, and for refreshes.

use super::{Decided, FIRST_REFRESHES, Phase, SdramController};
use tilewright_hdl::{Module, Period, Reg, Signal, StateReg, bit, def, up_to, when};

impl SdramController {
    /// For a chip of 32 megabytes, with words of 16 bits, at this period of its clock. The times are those of Micron's
    /// MT48LC16M16A2-75. They are long enough for faster grades, and for ISSI's IS42S16160G-7.
    ///
    /// ```
    /// use tilewright_blocks::SdramController;
    /// use tilewright_hdl::Period;
    ///
    /// let at_100_mhz = SdramController::of_32_megabytes(Period::ns(10));
    /// let SdramController { cas_latency, rcd, rp, ras, rfc, refresh, .. } = at_100_mhz;
    /// assert_eq!((cas_latency, rcd, rp, ras, rfc, refresh), (2, 2, 2, 5, 7, 781));
    /// ```
    ///
    /// # Panics
    ///
    /// The period is below 7.5 ns, with which the chip does not work.
    #[track_caller]
    pub const fn of_32_megabytes(period: Period) -> SdramController {
        let period = period.picoseconds();
        assert!(period >= 7_500, "the memory runs at 133 MHz or less: a period is 7.5 ns or more");
        let clocks = Clocks { period };
        SdramController {
            row_bits: 13,
            column_bits: 9,
            bytes: 2,
            cas_latency: if period >= 10_000 { 2 } else { 3 },
            late: 0,
            rcd: clocks.in_ns(20),
            rp: clocks.in_ns(20),
            ras: clocks.in_ns(44),
            rc: clocks.in_ns(66),
            rfc: clocks.in_ns(66),
            wr: clocks.in_ns(15),
            mrd: 2,
            // 8192 refreshes in 64 ms, the last of which may be late by 4 us.
            refresh: (7_812_000 / period) as u32,
            power_up: clocks.in_ns(100_000),
        }
    }

    /// High in one clock after the time at power-on, and in one clock of each `refresh` after that.
    pub(super) fn elapsed(&self, m: Module) -> Signal {
        def!(clock = m.reg(up_to(self.power_up.max(self.refresh) - 1)).reset(self.power_up - 1));
        def!(elapsed = clock.eq(0));
        clock.when(elapsed, self.refresh - 1).otherwise(clock - 1);
        elapsed
    }

    /// The phases. `due` becomes high where a refresh is to begin.
    pub(super) fn sequence(&self, m: Module, phase: StateReg<Phase>, decided: Decided, due: Reg) {
        let Decided { access, refreshes, sets_mode, .. } = decided;
        let elapsed = self.elapsed(m);
        def!(initialized = m.reg(bit()).reset(0));
        initialized.when(sets_mode, 1);
        def!(more = m.reg(up_to(FIRST_REFRESHES - 1)).reset(FIRST_REFRESHES - 1));
        more.when(refreshes & more.ne(0), more - 1);
        let moves = phase.next(|phase| match phase {
            Phase::PowerUp => when(elapsed, Phase::Close),
            Phase::Close => when(access.closes_all, Phase::Refresh),
            Phase::Refresh => when(refreshes & initialized, Phase::Serve).or_when(refreshes & more.eq(0), Phase::Mode),
            Phase::Mode => when(sets_mode, Phase::Serve),
            Phase::Serve => when(due, Phase::Close),
        });
        due.when(elapsed & initialized, 1).when(moves.goes(Phase::Refresh, Phase::Serve), 0);
        m.assert((elapsed & initialized).implies(!due), "a refresh is done before the next one is due");
    }
}

/// Counts in clocks of `period` picoseconds.
struct Clocks {
    period: u64,
}

impl Clocks {
    /// The clocks of a time, rounded up.
    const fn in_ns(&self, nanoseconds: u64) -> u32 {
        (nanoseconds * 1000).div_ceil(self.period) as u32
    }
}
