//! The patch table, the first stage of the access pipeline (VC1-PT, VC1-ACC).
//!
//! ```text
//! look_up --> patch --.   .-------------.     resident?  yes -------------> page
//!                     +-->| patch table |--->                  page ID -->
//! clear --------------'   | front, back |     no: write the entry <- generator
//!                         '-------------'
//! scan -----------------------^    '--------> scan_entry
//! ```
//!
//! Latency and throughput: a look-up takes 3 clocks if the patch has a page, and otherwise 4. The next one is accepted
//! in its last clock. A clear takes 3 clocks. The scan looks up a patch in every clock of the merger.
//!
//! An entry is a page existence flag and a page ID. A look-up that finds the flag clear takes the next free page from
//! the page ID generator. It writes the page into the entry and sets the flag, which costs the fourth clock. The
//! processor's software clears the table, entry by entry, after each swap (VC1-CLR2).
//!
//! A miss when all pages are taken is an overflow. The look-up then waits until the processor has swapped the buffers,
//! cleared the table and asserted `resume`.
//!
//! Both tables share one memory; the lowest address bit selects the buffer. One port serves the processor, the other
//! the scan.

use super::page_id_generator::{PageIdGenerator, PageIdGeneratorIn};
use crate::prelude::*;

/// The clocks that a clear takes.
const CLEAR_CLOCKS: u64 = 3;

// The states of a look-up.
codes! { enum Stage1 { Idle, Read, Examine, Allocate, Found, Overflow } }

block! {
    /// Gives each patch of the screen a page of image memory on its first access, separately for the front buffer and
    /// the back buffer.
    pub struct PatchTable {
        /// The number of patches.
        pub patches: u32,
        /// The number of pages.
        pub pages: u32,
    }
    ranges { patches: 2.., pages: 2.. }
    latency = "3 clocks for a patch with a page, otherwise 4";
    source = "VC-1, section 3.3, patch table (VC1-PT, VC1-ACC)";
    in(self) PatchTableIn {
        /// A request for the page of a patch.
        look_up: stream(pub struct Wanted {
            /// The number of the patch.
            patch: below(self.patches),
        }).on(PE),
        /// A request to clear an entry. If a look-up is accepted at the same edge, the clear comes first.
        clear: stream(Wanted { patch: below(self.patches) }).on(PE),
        /// The front buffer, 0 or 1.
        front: bit().on(PE),
        /// The scan has left the front buffer.
        settled: bit().on(PE),
        /// Frees all pages.
        restart: bit().on(PE),
        /// Retries the waiting look-up.
        resume: bit().on(PE),
        /// A patch whose page the scan needs.
        scan: pub struct ScanLookUp {
            /// The scan advances; while it is low, the entry does not change.
            enable: bit(),
            /// The number of the patch.
            patch: below(self.patches),
            /// The buffer to look into.
            buffer: bit(),
        }.on(MERGE),
    }
    out(self) PatchTableOut {
        /// A look-up waits, because all pages are taken.
        overflow: bit(),
        /// No look-up is under way.
        idle: bit(),
        /// The number of pages taken.
        pages_used: up_to(self.pages),
        /// The look-up ends in this clock.
        found: bit(),
        /// The page that the look-up found.
        page: below(self.pages),
        /// The entry that the scan looked up one clock earlier.
        scan_entry: pub struct Entry {
            /// The page existence flag: the patch has a page.
            resident: bit(),
            /// The page ID: the page of the patch.
            page: below(self.pages),
        },
    }
}

impl PatchTable {
    fn build(&self, m: Module, i: PatchTableIn) -> PatchTableOut {
        use Stage1::*;
        let m = m.on(PE);
        def!(stage1 = m.fsm(Idle));
        let [idle, found, overflow] = [Idle, Found, Overflow].map(|state| stage1.is(state));
        def!(clearing = m.reg(below(CLEAR_CLOCKS)).reset(0));
        def!(cleared = clearing.eq(0));

        def!(table_free = cleared & i.settled);
        def!(can_accept = idle | found);
        let look_up = i.look_up.take_when(can_accept);
        let clear = i.clear.take_when(table_free & (can_accept | overflow));
        clearing.when(clear.taken, CLEAR_CLOCKS - 1).when(!cleared, clearing - 1);
        def!(patch = m.pipe_when(look_up.taken, look_up.patch));

        // The two ports never access the same buffer.
        let layout = Entry { resident: bit(), page: below(self.pages) };
        def!(entries = m.memory(2 * self.patches, layout, ReadUnderWrite::Any).fill(0));
        def!(address = cat![mux(clear.taken, clear.patch, patch), i.front]);
        def!(read = stage1.is(Read) & table_free);
        def!(entry = entries.on(PE).read_when(read, address));

        def!(allocate = stage1.is(Allocate));
        let taking = PageIdGeneratorIn { restart: i.restart, take: allocate };
        def!(page_id_generator = m.instance(&PageIdGenerator { pages: self.pages }, taking));
        let moves = stage1.next(|state| match state {
            Idle => when(look_up.taken, Read),
            Read => when(table_free, Examine),
            Examine => when(entry.resident, Found).or_when(page_id_generator.exhausted, Overflow).or_else(Allocate),
            Allocate => goto(Found),
            Found => when(look_up.taken, Read).or_else(Idle),
            Overflow => when(i.resume, Read),
        });
        m.cover("a look-up finds no free page", moves.enters(Overflow));

        def!(page = m.pipe_when(stage1.is(Examine), mux(entry.resident, entry.page, page_id_generator.page)));
        entries.on(PE).write(allocate | clear.taken, address, Entry { resident: allocate, page });
        def!(scan_entry = entries.on(MERGE).read_when(i.scan.enable, cat![i.scan.patch, i.scan.buffer]));
        PatchTableOut { overflow, idle, pages_used: page_id_generator.used, found, page, scan_entry }
    }
}

#[cfg(test)]
mod tests;
