//! The registers of the pins.

use super::{Decided, Phase, Place, SdramController};
use tilewright_hdl::{Module, Signal, StateReg, bit, bits, codes, def, lit, one_of, record, select};

codes! {
    /// A command, as the pins `cs_n`, `ras_n`, `cas_n` and `we_n` show it.
    enum Command {
        /// Sets the mode.
        LoadMode = 0b0000,
        /// Refreshes the next row of each bank.
        Refresh = 0b0001,
        /// Closes a row, or all.
        Precharge = 0b0010,
        /// Opens a row.
        Active = 0b0011,
        /// Writes a column of the open row.
        Write = 0b0100,
        /// Reads one.
        Read = 0b0101,
        /// No command.
        Deselect = 0b1111,
    }
}

record! {
    /// What goes from an [`SdramController`] to the chip, apart from the data bus.
    ///
    /// ```
    /// # use tilewright_blocks::SdramPins;
    /// let pins = SdramPins::widths(13, 2);
    /// assert_eq!((pins.a.bits(), pins.ba.bits(), pins.dqm.bits()), (13, 2, 2));
    /// ```
    pub struct SdramPins(row_bits: u32, bytes: u32) {
        /// High from the first clock after a reset.
        cke: bit(),
        /// Low with a command.
        cs_n: bit(),
        /// A bit of the command.
        ras_n: bit(),
        /// A bit of the command.
        cas_n: bit(),
        /// A bit of the command.
        we_n: bit(),
        /// The bank.
        ba: bits(2),
        /// A row, a column, or the mode.
        a: bits(row_bits),
        /// The bytes of the data bus that are not written, one bit each.
        dqm: bits(bytes),
    }
}

/// A10: with a PRECHARGE, all banks are meant.
const ALL_BANKS: u32 = 1 << 10;

impl SdramController {
    /// The pins, a clock after a decision about the request at `place`.
    pub(super) fn pins(
        &self,
        m: Module,
        phase: StateReg<Phase>,
        decided: Decided,
        place: Place,
        strobe: Signal,
    ) -> SdramPins {
        let Decided { access, reads, writes, refreshes, sets_mode } = decided;
        def!(cke = m.reg(bit()).reset(0));
        cke.next(1);
        def!(command = m.reg(one_of::<Command>()).reset(Command::Deselect));
        command
            .when(reads, Command::Read)
            .when(writes, Command::Write)
            .when(access.opens, Command::Active)
            .when(access.closes | access.closes_all, Command::Precharge)
            .when(refreshes, Command::Refresh)
            .when(sets_mode, Command::LoadMode)
            .otherwise(Command::Deselect);
        // A10 is low with a column, so its row stays open, and with the PRECHARGE of one bank.
        let mode = lit(self.row_bits, self.cas_latency << 4);
        let others = [(access.opens, place.row), (access.closes_all, lit(self.row_bits, ALL_BANKS)), (sets_mode, mode)];
        def!(a = m.reg(self.row_bits));
        a.next(select(others, place.column.zext(self.row_bits)));
        def!(ba = m.reg(2));
        ba.next(select([(sets_mode, lit(2, 0))], place.bank));
        def!(dqm = m.reg(self.bytes).reset((1 << self.bytes) - 1));
        dqm.when(writes, !strobe).when(phase.is(Phase::Serve), 0);
        let bits = command.bits();
        let [cs_n, ras_n, cas_n, we_n] = [3, 2, 1, 0].map(|place| bits.bit(place));
        SdramPins { cke: *cke, cs_n, ras_n, cas_n, we_n, ba: *ba, a: *a, dqm: *dqm }
    }
}
