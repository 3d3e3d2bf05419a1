//! Blocks of the machines, against what their papers say of them.

use crate::{Claim, claim, design};
use tilewright_hdl::*;
use tilewright_rtl::lfb::{PageIdGenerator, PageIdGeneratorIn, ScanCounter, ScanCounterIn};
use tilewright_rtl::merger::{MergingUnit, MergingUnitIn};
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::pixel_planes::linear_tree::{Coefficients, LinearTree, LinearTreeIn};
use tilewright_rtl::pixelflow::compositor::{Compositor, CompositorIn, Mode};
use tilewright_rtl::scan::{Position, ScanControl};

block! {
    /// The VC-1's merging unit beside a plain comparison.
    struct Merged { wrong: bool }
    in MergedIn { left: bits(48), right: bits(48), enable: bit() }
    out MergedOut { nearer: bits(48) }
}

impl Merged {
    fn build(&self, m: Module, MergedIn { left, right, enable }: MergedIn) -> MergedOut {
        let nearer = m.instance("u_unit", &MergingUnit, MergingUnitIn { left, right, enable }).nearer;
        let least = mux(left.lt(right), left, right) ^ lit(48, u64::from(self.wrong));
        let entered = [(); 4].iter().fold(lit(1, 1), |all, ()| m.past(all & enable));
        let late = [(); 4].iter().fold(least, |word, ()| m.past(word));
        m.assert(entered.implies(nearer.eq(late)), "four clocks later the lesser word comes out");
        m.assert(m.past(!enable).implies(m.stable(nearer)), "without enable the output stays");
        MergedOut { nearer }
    }
}

block! {
    /// The page ID generator, and one page that is watched.
    struct Paged { wrong: bool }
    in PagedIn { restart: bit(), take: bit() }
    out PagedOut { page: bits(3) }
}

impl Paged {
    fn build(&self, m: Module, PagedIn { restart, take }: PagedIn) -> PagedOut {
        let pages = m.instance("u_pages", &PageIdGenerator { pages: 6 }, PageIdGeneratorIn { restart, take });
        m.ignore(&[pages.used, pages.exhausted]);
        // It starts with any value, and keeps it.
        def!(watched = m.reg(3));
        watched.next(*watched);
        def!(takes_it = take & !restart & pages.page.eq(*watched));
        def!(taken = m.reg(1).reset(0));
        let frees = if self.wrong { lit(1, 0) } else { restart };
        taken.when(frees, 0).when(takes_it, 1);
        m.assert(takes_it.implies(!taken), "no page is given twice before a restart");
        PagedOut { page: pages.page }
    }
}

block! {
    /// A pixel of the compositor beside a comparison of whole words, of three parts of two bits.
    struct Composited { wrong: bool }
    in CompositedIn { advances: bit(), pixel: bits(1), own: bits(2), upstream: bits(2) }
    out CompositedOut { downstream: bits(2) }
}

impl Composited {
    fn build(&self, m: Module, CompositedIn { advances, pixel, own, upstream }: CompositedIn) -> CompositedOut {
        // The parts of pixel 1 that have come, and what they are.
        def!(parts = m.reg(2).reset(0));
        def!(mine = advances & pixel.eq(1));
        def!(first = parts.eq(0));
        let input = CompositorIn { mode: Signal::of_code(Mode::Composite), advances, first, pixel, upstream, own };
        let downstream = m.instance("u_compositor", &Compositor { pixels: 2, width: 2 }, input).downstream;
        parts.when(mine & parts.eq(2), 0).when(mine, parts + 1);
        let word = |name: &str, part: Signal| {
            let word = m.reg(name, 6).reset(0);
            word.when(mine & first, part.zext(6)).when(mine, cat![word.part(0, 4), part]);
            *word
        };
        let (owns, upstreams) = (word("owns", own), word("upstreams", upstream));
        let sent = m.reg("sent", 6).reset(0);
        let arrives = m.past(mine);
        let all = cat![sent.part(0, 4), downstream];
        sent.when(arrives, all);
        let is_whole = m.past(mine & parts.eq(2));
        let least = mux(owns.lt(upstreams), owns, upstreams) ^ lit(6, u64::from(self.wrong));
        m.assert(is_whole.implies(all.eq(least)), "the lesser word is sent");
        CompositedOut { downstream }
    }
}

block! {
    /// The scan counter of a screen of 3 x 2 pixels beside the number of the pixel.
    struct Scanned { wrong: bool }
    in ScannedIn { restart: bit(), enable: bit(), x: bits(2), y: bits(1) }
    out ScannedOut { armed: bit() }
}

impl Scanned {
    fn build(&self, m: Module, ScannedIn { restart, enable, x, y }: ScannedIn) -> ScannedOut {
        let counter = ScanCounter { screen: Screen { width: 3, height: 2 } };
        let input = ScanCounterIn { scan: ScanControl { restart, enable }, preset: Position { x, y } };
        let found = m.instance("u_counter", &counter, input);
        m.assume(x.ne(3), "a preset is on the screen");
        let number = |at: Position| at.x.zext(3) + mux(at.y.eq(1), lit(3, 3), 0);
        let (preset, now) = (number(Position { x, y }), number(found.pixel));
        def!(pixel = m.reg(3).reset(0));
        let last = if self.wrong { 4 } else { 5 };
        pixel.when(restart, preset).when(enable & pixel.eq(last), 0).when(enable, pixel + 1);
        m.assert(now.eq(pixel), "the pixels come in raster order");
        ScannedOut { armed: found.armed }
    }
}

block! {
    /// The linear tree of side 4, with coefficients that keep any value, bit by bit and modulo 16.
    struct Linear { wrong: bool }
    out LinearOut { value: bits(16) }
}

impl Linear {
    fn build(&self, m: Module, (): ()) -> LinearOut {
        let [a, b, c] = ["a", "b", "c"].map(|name| {
            let held = m.reg(name, 4);
            held.next(*held);
            *held
        });
        def!(bit = m.reg(2).reset(0));
        bit.next(bit + 1);
        let now = |word: Signal| (word >> *bit).bit(0);
        let coefficients = Coefficients { a: now(a), b: now(b), c: now(c) };
        let tree = LinearTree { side: 4 };
        let value = m.instance("u_tree", &tree, LinearTreeIn { coefficients, first: bit.eq(0) }).value.pack();
        // The latency of four clocks is that of a whole word.
        def!(age = m.reg(4).reset(0));
        age.when(age.ne(8), age + 1);
        let at = |pixel: u64| {
            let (x, y) = (pixel % 4, pixel / 4);
            let times = |word: Signal, factor: u64| (word * lit(2, factor)).trunc(4);
            now(times(a, x) + times(b, y) + c + lit(4, u64::from(self.wrong)))
        };
        let expected = concat(&(0..16).rev().map(at).collect::<Vec<_>>());
        m.assert(age.eq(8).implies(value.eq(expected)), "each pixel has A x + B y + C");
        LinearOut { value }
    }
}

/// What is proved of the machines.
pub fn claims() -> Vec<Claim> {
    vec![
        claim(
            &["scan-counter"],
            "VC-1: scan counter, 3 x 2 pixels",
            "the pixels come in raster order",
            [4; 2],
            |wrong| design(&Scanned { wrong }),
        ),
        claim(
            &["linear-tree"],
            "Pixel-planes 5: linear tree, side 4",
            "each pixel has A x + B y + C, for all coefficients of 4 bits",
            [12; 2],
            |wrong| design(&Linear { wrong }),
        ),
        claim(
            &["merging-unit"],
            "VC-1: merging unit, 48 bits",
            "four clocks later the lesser word comes out",
            [6; 2],
            |wrong| design(&Merged { wrong }),
        ),
        claim(
            &["page-id-generator"],
            "VC-1: page ID generator, 6 pages",
            "no page is given twice before a restart",
            [4; 2],
            |wrong| design(&Paged { wrong }),
        ),
        claim(
            &["compositor"],
            "PixelFlow: compositor, 2 pixels of 3 parts",
            "the lesser word is sent",
            [5; 2],
            |wrong| design(&Composited { wrong }),
        ),
    ]
}
