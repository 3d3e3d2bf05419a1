//! The patch table, with the first stage of the access pipeline (VC1-PT, VC1-ACC).
//!
//! ```text
//! look_up --> patch --.   .-------------.     resident?  yes -------------> page
//!                     +-->| patch table |--->                  page ID -->
//! clear --------------'   | front, back |     no: write the entry <- generator
//!                         '-------------'
//! scan -----------------------^    '--------> scan_entry
//! ```
//!
//! Latency and throughput: a look-up takes 3 clocks if the patch has a page, else 4; the next one is accepted in the
//! last of them. A clear takes 3 clocks. The scan looks up a patch for every clock of the merger.
//!
//! An entry is a page existence flag and a page ID. A look-up that finds the flag clear takes the next free page from the
//! page ID generator and writes it into the entry, with the flag set, which costs the fourth clock. The processor clears
//! the table by software, entry by entry, after each swap (VC1-CLR2).
//!
//! A miss when all pages are taken is an overflow: the look-up is held until the processor has swapped the buffers and
//! cleared the table, and says `resume`.
//!
//! Both tables are one memory, whose lowest address bit tells the buffers apart: a port for the processor, a port
//! for the scan.

use tilewright_hdl::ir::About;
use tilewright_hdl::{
    Block, Module, ReadUnderWrite, Stream, Width, below, bit, bundle, cat, codes, goto, mux, net, on, stream, when,
};

use super::page_id_generator::{PageIdGenerator, PageIdGeneratorIn};
use crate::clocks::{MERGE, PE};

/// The clocks that a clear takes.
const CLEAR_CLOCKS: u64 = 3;

bundle! {
    /// A patch whose page the processor wants.
    pub struct LookUp<T> {
        /// There is one.
        pub valid: T,
        /// Its number.
        pub patch: T,
    }

    /// A patch whose entry the processor wants cleared.
    pub struct Cleared<T> {
        /// Its number.
        pub patch: T,
    }

    /// A patch of which the scan wants the page.
    pub struct ScanLookUp<T> {
        /// The scan advances; where it is low the entry stays.
        pub enable: T,
        /// Its number.
        pub patch: T,
        /// The buffer to look into.
        pub buffer: T,
    }

    /// An entry of the table.
    pub struct Entry<T> {
        /// The page existence flag.
        pub resident: T,
        /// The page ID.
        pub page: T,
    }

    /// The inputs of [`PatchTable`].
    pub struct PatchTableIn<T> {
        /// A request for the page of a patch.
        pub look_up: LookUp<T>,
        /// Entries to clear. Of a clear and a look-up that are accepted at one edge the clear comes first.
        pub clear: Stream<Cleared<T>, T>,
        /// The front buffer, 0 or 1.
        pub front: T,
        /// The scan has left the front buffer.
        pub settled: T,
        /// All pages are free again.
        pub restart: T,
        /// The held look-up is tried again.
        pub resume: T,
        /// The scan's look-up.
        pub scan: ScanLookUp<T>,
    }

    /// The outputs of [`PatchTable`].
    pub struct PatchTableOut<T> {
        /// A look-up is accepted at this edge.
        pub ready: T,
        /// A look-up is held, because all pages are taken.
        pub overflow: T,
        /// No look-up is under way.
        pub idle: T,
        /// How many pages are taken.
        pub pages_used: T,
        /// The look-up ends with this clock.
        pub found: T,
        /// The page it found.
        pub page: T,
        /// What the scan asked for one clock before.
        pub scan_entry: Entry<T>,
    }
}

codes! {
    /// The clocks of a look-up.
    enum Stage1 { Idle, Read, Examine, Allocate, Found, Overflow }
}

/// Two tables that give each patch of the screen its page of image memory.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct PatchTable {
    /// The number of patches.
    pub patches: u32,
    /// The number of pages.
    pub pages: u32,
}

impl Block for PatchTable {
    type In = PatchTableIn;
    type Out = PatchTableOut;

    fn inputs(&self) -> PatchTableIn<Width> {
        let patch = below(self.patches);
        PatchTableIn {
            look_up: on(PE, LookUp { valid: bit(), patch }),
            clear: on(PE, stream(Cleared { patch })),
            front: bit().on(PE),
            settled: bit().on(PE),
            restart: bit().on(PE),
            resume: bit().on(PE),
            scan: on(MERGE, ScanLookUp { enable: bit(), patch, buffer: bit() }),
        }
    }

    fn build(&self, m: Module, i: PatchTableIn) -> PatchTableOut {
        let m = m.on(PE);
        let stage = m.fsm("stage1", Stage1::Idle);
        let clearing = m.reg("clearing", 2).reset(0);

        net!(table_free = clearing.eq(0) & i.settled);
        net!(can_accept = stage.is(Stage1::Idle) | stage.is(Stage1::Found));
        net!(accept = i.look_up.valid & can_accept);
        let clear = i.clear.take_when(table_free & (can_accept | stage.is(Stage1::Overflow)));
        clearing.when(clear.taken, CLEAR_CLOCKS - 1).when(clearing.ne(0), clearing - 1);

        let patch = m.reg("patch", i.look_up.patch.width());
        patch.enable(accept).next(i.look_up.patch);

        // The two ports are never in the same buffer.
        let layout = Entry { resident: bit(), page: below(self.pages) };
        let table = m.memory("entries", 2 * self.patches, layout, ReadUnderWrite::Any).fill(0);
        net!(address = cat!(mux(clear.taken, clear.patch, patch), i.front));
        net!(read = stage.is(Stage1::Read) & table_free);
        net!(entry = table.on(PE).read_when(read, address));

        net!(allocate = stage.is(Stage1::Allocate));
        let free = m.instance(
            "u_page_id_generator",
            &PageIdGenerator { pages: self.pages },
            PageIdGeneratorIn { restart: i.restart, take: allocate },
        );
        stage.next(|state| match state {
            Stage1::Idle => when(accept, Stage1::Read),
            Stage1::Read => when(read, Stage1::Examine),
            Stage1::Examine => {
                when(entry.resident, Stage1::Found).or_when(free.exhausted, Stage1::Overflow).or_else(Stage1::Allocate)
            }
            Stage1::Allocate => goto(Stage1::Found),
            Stage1::Found => when(accept, Stage1::Read).or_else(Stage1::Idle),
            Stage1::Overflow => when(i.resume, Stage1::Read),
        });

        let page = m.reg("page", below(self.pages));
        page.enable(stage.is(Stage1::Examine)).next(mux(entry.resident, entry.page, free.page));
        table.on(PE).write(allocate | clear.taken, address, Entry { resident: allocate, page: *page });
        net!(scan_entry = table.on(MERGE).read_when(i.scan.enable, cat!(i.scan.patch, i.scan.buffer)));
        PatchTableOut {
            ready: can_accept,
            overflow: stage.is(Stage1::Overflow),
            idle: stage.is(Stage1::Idle),
            pages_used: free.used,
            found: stage.is(Stage1::Found),
            page: page.value(),
            scan_entry,
        }
    }

    fn about(&self) -> About {
        About {
            summary: format!(
                "Gives each of {} patches one of {} pages of image memory on its first access, for the buffer in front \
                 and for the one behind.",
                self.patches, self.pages
            ),
            latency: "3 clocks for a patch that has a page, else 4".to_owned(),
            source: "VC-1, section 3.3, patch table (VC1-PT, VC1-ACC)".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests;
