//! A controller of a synchronous dynamic memory.

mod banks;
mod on_pads;
mod pins;
mod times;

use crate::streams::StreamBlocks;
use banks::Access;
use tilewright_hdl::{Module, Signal, Stream, Wire, any_of, bit, bits, block, cat, codes, def, record, up_to};

pub use on_pads::{SdramOnPads, SdramOnPadsIn, SdramOnPadsOut};
pub use pins::SdramPins;

/// Refreshes between power-on and the first access. Some chips need two, others eight.
const FIRST_REFRESHES: u32 = 8;

codes! {
    /// What an [`SdramController`] does.
    enum Phase {
        /// The chip's supply and clock settle.
        PowerUp,
        /// All rows are to be closed.
        Close,
        /// A refresh is to begin.
        Refresh,
        /// The mode register is to be written.
        Mode,
        /// Requests are served.
        Serve,
    }
}

record! {
    /// A request to an [`SdramController`].
    ///
    /// ```
    /// # use tilewright_blocks::SdramRequest;
    /// let low_byte = SdramRequest { write: 1, address: 5, data: 0x12, strobe: 0b01 };
    /// let read = SdramRequest { write: 0, ..low_byte };
    /// assert_eq!(SdramRequest::widths(24, 2).data.bits(), 16);
    /// # assert_eq!((low_byte.data, read.write), (0x12, 0));
    /// ```
    pub struct SdramRequest(address: u32, bytes: u32) {
        /// High to write, low to read.
        write: bit(),
        /// The address of a word: from the top the row, the bank and the column.
        address: bits(address),
        /// The word to write.
        data: bits(8 * bytes),
        /// The bytes that are written, one bit each.
        strobe: bits(bytes),
    }
}

block! {
    /// A controller of a synchronous dynamic memory (SDRAM) with single data rate and four banks.
    ///
    /// ```text
    ///              .------.     .----------------.    .-----------.
    /// request ====>| head |====>| phase, pause,  |===>| registers |====> pins, dq_out, dq_enable
    ///              '------'     | rows of 4 banks|    '-----------'
    ///                           '----------------'
    ///                               ^  room    | reads
    ///              .-------.        |      .---v-------.
    /// words <======| queue |<==============| registers |<=============== dq
    ///              '-------'               '-----------'
    /// ```
    ///
    /// A request reads a word, or writes some of its bytes. Requests are served in sequence. The answer to a read is
    /// its word, and a write has no answer. A row stays open until another row of its bank is needed, or a refresh is
    /// due. The bank is below the row in an address, so successive words fill a row of each bank in turn.
    ///
    /// No path within a clock leads from one port to another. All pins come from registers, and `dq` goes into one.
    /// Each column has a command of its own (bursts of 1). `dq` is driven in the clock of a WRITE.
    ///
    /// Latency of a read, in clocks from `request` to `words`, with CL for `cas_latency`:
    ///
    /// | the row is | clocks | at 100 MHz |
    /// |---|---|---|
    /// | open | CL + `late` + 4 | 6 |
    /// | closed | `rcd` more | 8 |
    /// | closed, and another one of its bank is open | `rp` + `rcd` more | 10 |
    /// | open, at a refresh | `rp` + `rfc` + 1 + `rcd` more | 18 |
    ///
    /// Another row of the bank is closed first. It stays open for `ras` clocks, for `rc` - `rp` clocks, and for `wr`
    /// clocks after it was written. A request waits until all of these are over, and so does a refresh.
    ///
    /// Throughput on an open row is a read or a write a clock. A read may follow a write at once. A write follows a
    /// read after CL + `late` + 2 clocks, so `dq` is idle for a clock between them. Reads wait if CL + `late` + 4 words
    /// are on their way or not taken. A row is opened for the oldest request alone, so each change of rows costs its
    /// clocks.
    ///
    /// A refresh is due each `refresh` clocks, whatever the load. From then on no request is served. All rows are
    /// closed a clock later, or as soon as they may be. The refresh begins `rp` clocks after that. Requests are served
    /// again `rfc` clocks later, with all rows closed.
    ///
    /// After a reset, `power_up` clocks pass. Then the controller closes all rows, refreshes eight times, and sets the
    /// mode. `dqm` is high until then.
    ///
    /// Two rules of a chip have no parameter. Rows of two banks are opened `rcd` + 1 clocks apart or more (tRRD). A row
    /// is open from one refresh to the next at most, so the longest tRAS has to be longer than that.
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_hdl::Period;
    /// # use tilewright_sim::Simulation;
    /// let block = SdramController { power_up: 5, ..SdramController::of_32_megabytes(Period::ns(10)) };
    /// let mut sim = Simulation::of(&block)?;
    /// sim.reset();
    /// sim.set(sim.i.dq, 0xcafe); // a memory that knows one word
    /// let (request, words) = (sim.i.request, sim.o.words);
    /// let t = sim.testbench();
    /// let read = SdramRequest { write: 0, address: 0x12_3456, data: 0, strobe: 0 };
    /// let (_, word) = t.run((t.send(request, read), t.receive(words)));
    /// assert_eq!(word, 0xcafe);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct SdramController {
        /// The bits of a row's number.
        pub row_bits: u32,
        /// The bits of a column's number.
        pub column_bits: u32,
        /// The bytes of a word.
        pub bytes: u32,
        /// Clocks from a read to its word on the data bus (CL).
        pub cas_latency: u32,
        /// Clocks by which words come later than at `cas_latency`, for instance because the chip's clock is inverted.
        pub late: u32,
        /// Clocks from ACTIVE to READ or WRITE (tRCD).
        pub rcd: u32,
        /// Clocks from PRECHARGE to ACTIVE or REFRESH (tRP).
        pub rp: u32,
        /// Clocks from ACTIVE to PRECHARGE, at least (tRAS).
        pub ras: u32,
        /// Clocks from ACTIVE to the next ACTIVE of the bank (tRC).
        pub rc: u32,
        /// Clocks from REFRESH to any command (tRFC).
        pub rfc: u32,
        /// Clocks from WRITE to PRECHARGE (tWR, or tDPL).
        pub wr: u32,
        /// Clocks from LOAD MODE to any command (tMRD).
        pub mrd: u32,
        /// Clocks from one refresh to the next. One may be late by as many clocks as a row has to stay open, and the
        /// first one by `rp` + 2 after the mode is set.
        pub refresh: u32,
        /// Clocks from a reset to the first command.
        pub power_up: u32,
    }
    ranges(self) {
        /// A10 says whether all banks are closed.
        row_bits: 11..=16,
        /// A10 is no bit of a column.
        column_bits: 1..=10,
        bytes: any_of([1, 2, 4]),
        cas_latency: 2..=3,
        late: ..=3,
        rcd: 1..=255,
        rp: 1..=255,
        ras: 1..=255,
        rc: 1..=511,
        rfc: 1..=255,
        wr: 1..=255,
        mrd: 1..=255,
        /// A request has to be served between two refreshes.
        refresh: self.row_cycle() + self.rfc + self.rp + self.rcd + 4..,
        power_up: 1..,
    }
    latency(self) = self.clocks_on_an_open_row();
    in(self) SdramControllerIn {
        /// What is to be read or written.
        request: stream(SdramRequest::widths(self.address_bits(), self.bytes)),
        /// What the data bus shows.
        dq: bits(8 * self.bytes),
    }
    out(self) SdramControllerOut {
        /// The words that were read, in the sequence of their requests.
        words: stream(bits(8 * self.bytes)),
        /// The chip's pins, apart from the data bus.
        pins: SdramPins::widths(self.row_bits, self.bytes),
        /// What the data bus is driven to.
        dq_out: bits(8 * self.bytes),
        /// High while the data bus is driven.
        dq_enable: bit(),
    }
}

/// The parts of an address.
#[derive(Clone, Copy)]
struct Place {
    row: Signal,
    bank: Signal,
    column: Signal,
}

/// What is decided in a clock: at most one command is high.
#[derive(Clone, Copy)]
struct Decided {
    access: Access,
    reads: Signal,
    writes: Signal,
    refreshes: Signal,
    sets_mode: Signal,
}

impl SdramController {
    fn build(&self, m: Module, i: SdramControllerIn) -> SdramControllerOut {
        def!(full = m.reg(bit()).reset(0));
        def!(served = m.wire(bit()));
        let request = i.request.take_when(!full | *served);
        full.when(request.taken, 1).when(*served, 0);
        def!(head = m.reg(SdramRequest::widths(self.address_bits(), self.bytes)).when(request.taken, *request));
        let place = self.place(head.address);
        let arrival = (place, self.place(request.address), request.taken);

        def!(phase = m.fsm(Phase::PowerUp));
        def!(pause = m.reg(up_to(self.rp.max(self.rcd).max(self.rfc).max(self.mrd) - 1)).reset(0));
        def!(may_go = pause.eq(0));
        def!(due = m.reg(bit()).reset(0));
        def!(serves = phase.is(Phase::Serve) & full & may_go & !due);
        def!(ends = phase.is(Phase::Close) & may_go);
        def!(writes = m.wire(bit()));
        let access = self.access(m, arrival, (serves, ends), writes);

        def!(has_room = m.wire(bit()));
        def!(reads = access.hits & !head.write & *has_room);
        def!(turn = m.reg(up_to(self.turn_around())).reset(0));
        turn.when(reads, self.turn_around()).when(turn.ne(0), turn - 1);
        writes.drive(access.hits & head.write & turn.eq(0));
        served.drive(reads | *writes);
        def!(refreshes = phase.is(Phase::Refresh) & may_go);
        def!(sets_mode = phase.is(Phase::Mode) & may_go);
        pause
            .when(access.closes | access.closes_all, self.rp - 1)
            .when(access.opens, self.rcd - 1)
            .when(refreshes, self.rfc - 1)
            .when(sets_mode, self.mrd - 1)
            .when(!may_go, pause - 1);

        let decided = Decided { access, reads, writes: *writes, refreshes, sets_mode };
        self.sequence(m, phase, decided, due);
        let pins = self.pins(m, phase, decided, place, head.strobe);
        def!(dq_out = m.reg(8 * self.bytes).when(*writes, head.data));
        def!(dq_enable = m.reg(bit()).reset(0));
        dq_enable.next(*writes);
        let words = self.words(m, reads, has_room, i.dq);
        SdramControllerOut { words, pins, dq_out: *dq_out, dq_enable: *dq_enable }
    }

    /// The words that are read. `has_room` is high if a word that is read now finds room in the queue.
    fn words(&self, m: Module, reads: Signal, has_room: Wire, dq: Signal) -> Stream {
        // The clocks from a decision to the word in the register behind `dq`.
        let clocks = self.cas_latency + self.late + 2;
        def!(on_the_way = m.reg(clocks).reset(0));
        on_the_way.next(cat![on_the_way.trunc(clocks - 1), reads]);
        def!(sampled = m.pipe(dq));
        let (arriving, arrives) = m.offer(on_the_way.msb(), sampled);
        m.assert(on_the_way.msb().implies(arrives), "a word that comes finds room");
        // A word is counted from its decision until two clocks after it has come, if it is taken at once.
        let depth = clocks + 2;
        let words = m.fifo("u_words", depth, arriving);
        def!(taken = words.valid & words.ready);
        def!(reserved = m.reg(up_to(depth)).reset(0));
        reserved.when(reads & !taken, reserved + 1).when(taken & !reads, reserved - 1);
        has_room.drive(reserved.ne(depth));
        words
    }

    /// Where the word of an address is.
    fn place(&self, address: Signal) -> Place {
        let (columns, all) = (self.column_bits, self.address_bits());
        let bank = address.slice(columns..columns + 2);
        Place { row: address.slice(columns + 2..all), bank, column: address.slice(0..columns) }
    }

    /// The bits of an address of a word.
    fn address_bits(&self) -> u32 {
        self.row_bits + 2 + self.column_bits
    }

    /// Clocks from a READ in which no WRITE begins: the word comes, and then the data bus is idle for a clock.
    fn turn_around(&self) -> u32 {
        self.cas_latency + self.late + 1
    }

    fn clocks_on_an_open_row(&self) -> String {
        format!("{} clocks on an open row", self.cas_latency + self.late + 4)
    }
}
