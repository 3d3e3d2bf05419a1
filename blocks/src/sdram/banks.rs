//! The rows that are open, and since when.

use super::{Place, SdramController};
use crate::encode::one_hot;
use tilewright_hdl::{Module, ReadUnderWrite, Signal, Wire, bit, def, row, up_to};

/// The banks of a chip.
const BANKS: u32 = 4;

/// What the bank of a request is to do, or all banks: at most one of these is high.
#[derive(Clone, Copy)]
pub(super) struct Access {
    /// The row is open.
    pub hits: Signal,
    /// Opens the row.
    pub opens: Signal,
    /// Closes another row.
    pub closes: Signal,
    /// Closes the rows of all banks.
    pub closes_all: Signal,
}

impl SdramController {
    /// Serves the request at `head` if `serves` is high, or closes all rows as soon as possible while `ends` is.
    /// `writes` is high with the command WRITE. Where `arrives` is high, the request at `next` becomes the head.
    ///
    /// A request's row is compared where it arrives, so no comparison delays a command: no row is opened or closed at
    /// that edge, except that all may be closed.
    pub(super) fn access(
        &self,
        m: Module,
        (head, next, arrives): (Place, Place, Signal),
        (serves, ends): (Signal, Signal),
        writes: Wire,
    ) -> Access {
        let banks = row(BANKS);
        def!(chosen = one_hot(head.bank, BANKS).unpack(banks));
        def!(is_open = m.reg(bit().of(banks)).reset(0));
        def!(rows = m.memory(BANKS, self.row_bits, ReadUnderWrite::Any));
        // Clocks until a row may be closed.
        def!(keeps = m.reg(up_to(self.keeps_opened().max(self.wr) - 1).of(banks)).reset(0));
        let keeps_open = keeps.ne(0);

        // Of the head's bank: whether a row is open, and whether it is the head's.
        def!(opened = m.reg(bit()));
        def!(same = m.reg(bit()));
        def!(hits = serves & opened & same);
        def!(opens = serves & !opened);
        def!(closes = serves & opened & !same & !keeps_open.pick(head.bank));
        def!(closes_all = ends & !keeps_open.or_all());
        opened.when(arrives, is_open.pick(next.bank) & !closes_all).when(opens, 1).when(closes | closes_all, 0);
        same.when(arrives, rows.read_async(next.bank).eq(next.row)).when(opens, 1);
        m.assert(arrives.implies(!opens & !closes), "a request arrives where no single row is opened or closed");

        // A row that is closed for another one is opened by the same request.
        is_open.when(chosen & opens, 1).when(closes_all, 0);
        rows.write(opens, head.bank, head.row);
        keeps
            .when(chosen & opens, self.keeps_opened() - 1)
            .when(chosen & *writes & keeps.le(self.wr - 1), self.wr - 1)
            .when(keeps_open, keeps - 1);
        m.cover("a row is closed for another one", closes);
        Access { hits, opens, closes, closes_all }
    }

    /// Clocks from ACTIVE to PRECHARGE. The row is closed late enough to be opened again at once.
    pub(super) fn keeps_opened(&self) -> u32 {
        self.ras.max(self.rc.saturating_sub(self.rp))
    }

    /// Clocks from ACTIVE to PRECHARGE, at least, of a row that is written once.
    pub(super) fn row_cycle(&self) -> u32 {
        self.keeps_opened().max(self.rcd + self.wr)
    }
}
