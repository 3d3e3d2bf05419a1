//! The VC-1's local frame buffers: the patch table, and the swap control, on two clocks.

use crate::{Claim, claim, design};
use tilewright_hdl::*;
use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::lfb::{PatchTable, PatchTableIn, ScanLookUp, Wanted};
use tilewright_rtl::swap::{LfbSwap, LfbSwapIn};

const PATCHES: u64 = 3;

block! {
    /// The patch table, whose entries a program clears after each swap, and one page that is watched.
    struct Paged { wrong: bool }
    in PagedIn {
        offers: bit().on(PE), patch: below(PATCHES).on(PE), swap: bit().on(PE), resume: bit().on(PE),
        seek: bit().on(MERGE), sought: below(PATCHES).on(MERGE),
    }
    out PagedOut { page: bits(1) }
}

impl Paged {
    fn build(&self, m: Module, i: PagedIn) -> PagedOut {
        let pe = m.on(PE);
        def!(front = pe.toggle(i.swap));
        // The entries up to this one are cleared. At power-on all of them are.
        def!(cleared = pe.reg(up_to(PATCHES)).reset(0).initial(PATCHES));
        def!(is_clear = cleared.eq(PATCHES));
        let (look_up, sent) = pe.offer(i.offers, Wanted { patch: i.patch });
        let (clear, clears) = pe.offer(!is_clear, Wanted { patch: cleared.trunc(2) });
        cleared.when(i.swap, 0).when(clears, cleared + 1);
        let seek = ScanLookUp { enable: i.seek, patch: i.sought, buffer: lit(1, 0) };
        let input =
            PatchTableIn { look_up, clear, front, settled: lit(1, 1), restart: i.swap, resume: i.resume, scan: seek };
        let found = m.instance("u_table", &PatchTable { patches: PATCHES as u32, pages: 2 }, input);
        m.ignore(&[found.pages_used, found.scan_entry.resident, found.scan_entry.page]);
        pe.assume(i.offers.implies(is_clear & !i.swap & i.patch.lt(PATCHES)), "the program clears all entries first");
        pe.assume(i.swap.implies(is_clear & (found.idle | found.overflow)), "the program swaps between look-ups");
        pe.assume(i.resume.implies(is_clear & !i.swap), "a look-up is resumed after all entries are cleared");

        def!(asked = pe.reg(below(PATCHES)));
        asked.when(sent, i.patch);
        def!(watched = pe.reg(bit()));
        watched.next(*watched);
        def!(gets_it = found.found & found.page.eq(*watched));
        def!(owner = pe.reg(below(PATCHES)).when(gets_it, *asked));
        def!(owned = pe.reg(bit()).reset(0));
        owned.when(i.swap, 0).when(gets_it, 1);
        let is_owner = if self.wrong { owner.ne(*asked) } else { owner.eq(*asked) };
        pe.assert((gets_it & *owned).implies(is_owner), "no two patches share a page");
        PagedOut { page: found.page }
    }
}

block! {
    /// The swap control of a local frame buffer beside two pixels of its back buffer, which the merger takes one by one.
    struct Swapped { wrong: bool }
    in SwappedIn {
        done: bit().on(PE), idle: bit().on(PE), overflow: bit().on(PE), draws: bit().on(PE), clears: bit().on(PE),
        patch: bits(1).on(PE), line: bit().on(PE), shown: bit().on(MERGE), enable: bit().on(MERGE),
    }
    out SwappedOut { swap: bit() }
}

impl Swapped {
    fn build(&self, m: Module, i: SwappedIn) -> SwappedOut {
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        def!(swaps = pe.wire(bit()));
        def!(front = pe.toggle(*swaps));
        // As in `LfbUnit`.
        def!(merge_front = merge.synchronize(front));
        def!(was_front = merge.reg(bit()).reset(0));
        was_front.next(merge_front);
        def!(swapped = was_front.ne(merge_front));
        def!(left = merge.reg(up_to(2)).reset(0));
        left.when(swapped, 2).when(i.enable & left.ne(0), left - 1);
        def!(sending = merge.reg(bit()).reset(0));
        sending.next(left.ne(0) | swapped);
        let merge_clocks = if self.wrong { 1 } else { 15 };
        let control = LfbSwap { patches: 2, merge_clocks, sent_clocks: 1, overflow_clocks: 1 };
        let SwappedIn { done, idle, overflow, draws, clears, patch, line, shown, .. } = i;
        let sending = *sending;
        let input = LfbSwapIn { done, idle, overflow, draws, clears, patch, line, shown, sending };
        let found = m.instance("u_swap", &control, input);
        swaps.drive(found.swap);
        m.ignore(&[found.ready, found.resume, found.state, found.frame]);
        let seen = |signal: Signal| signal.quasi_static("a statement looks at both clocks");
        let is_sent = seen(left.eq(0)) & seen(merge_front).eq(front) & seen(*was_front).eq(front);
        pe.assert(found.swap.implies(is_sent), "all pixels of the back buffer are sent before it is swapped");
        SwappedOut { swap: found.swap }
    }
}

/// The harness of the swap control, without what the block states of an environment that answers in time.
fn swapped(wrong: bool) -> Design {
    let mut modules = design(&Swapped { wrong }).into_modules();
    let in_time = |message: &str| message.contains("within");
    modules.iter_mut().for_each(|module| module.properties.retain(|it| !in_time(&it.message)));
    Design::new(modules).unwrap_or_else(|problems| panic!("{problems}"))
}

/// What is proved of local frame buffers.
pub fn claims() -> Vec<Claim> {
    vec![
        claim(
            &["patch-table"],
            "VC-1: patch table, 3 patches, 2 pages",
            "no two patches share a page",
            [2, 13],
            |wrong| design(&Paged { wrong }),
        ),
        claim(
            &["vc1-swap", "lfb-swap", "gfb-swap"],
            "VC-1: swap control",
            "no pixel is lost: all are sent before a buffer is swapped",
            [2, 16],
            swapped,
        ),
    ]
}
