//! The accumulation buffer with its merging unit, MUACC: adds up the pictures of several passes and shows their average
//! (VC1-ACB).
//!
//! ```text
//!                   merge clock                  |     CRT clock
//!                                                |
//! start -->[ address ]--+--> address, to the GFB |         .--- read_address
//!                       v                        |         |
//!           old .---------------.                |         |
//!       .-------|     sums:     |<---------------|---------'
//!       v       |  even pixels, |                |
//! word ( + )--->|  odd pixels   |----------------|---> ( (sum + n / 2) / n )--> colour
//!       ^       '---------------'                |                ^
//! first '                                passes -|----------------'
//! ```
//!
//! A pixel is three sums of 12 bits, for red, green and blue. A pass goes through the picture in raster order, a
//! pixel in each clock of the merger. It puts out the address, and gets the pixel's word and sum one clock later. At
//! the end of that clock it stores the new sum. So a pass is `busy` for one clock more than there are pixels. The
//! `first` pass stores the colours themselves, whatever was there before.
//!
//! In each clock a pass reads one pixel and writes the previous one. One of the two has an even address and the other
//! an odd one. Even and odd pixels have a memory each. So each memory needs only two ports, one for the pass and one
//! for the display.
//!
//! The display gets a colour one of its clocks after the address. Red, green and blue are each
//! `floor((sum + n / 2) / n)` for `n` passes. The display may read at any time. During a pass, some pixels have their
//! new sum and others the old one. A read of the pixel being stored at that instant may return anything.
//!
//! # Protocol
//!
//! | party | action | when |
//! |---|---|---|
//! | multipass control | starts the `first` pass | not busy |
//! | multipass control | starts another pass | not busy, and at most 15 times after a `first` one |
//! | global frame buffer | reads at `address`, and does not swap its banks | busy |
//! | multipass control | sets the number of passes in the average | before the average is shown |
//!
//! If more passes are added than `passes` says, each component of the average is correct only modulo 256. If fewer are
//! added, the picture is too dark.

use crate::prelude::*;

/// The bits of a colour component: in a picture, and in the sum of 16 passes.
const COMPONENT: u32 = 8;
const SUM: u32 = 12;
/// The components of a colour, from the most significant: red, green, blue.
const COMPONENTS: u32 = 3;

codes! {
    /// The number of passes in an average.
    pub enum Passes {
        /// 2 passes.
        Two,
        /// 4 passes.
        Four,
        /// 8 passes.
        Eight,
        /// 16 passes, the most that the buffer adds up.
        Sixteen,
    }
}

impl Passes {
    /// The variant for that count, if there is one.
    pub fn of_count(count: u32) -> Option<Passes> {
        Passes::ALL.iter().copied().find(|passes| passes.count() == count)
    }

    /// The number of passes.
    pub fn count(self) -> u32 {
        1 << self.shift()
    }

    /// The binary logarithm of the number of passes.
    fn shift(self) -> u32 {
        self.code() as u32 + 1
    }
}

block! {
    /// Adds up the pictures of several passes and shows their average.
    pub struct Accumulation {
        /// The screen.
        pub screen: Screen,
        /// The clock of the display.
        pub crt: Clock,
    }
    latency(self) = format!("a pass of {} clocks of the merger; 1 clock of the display to read", self.pass_clocks());
    source = "VC-1, section 3.3, accumulation buffer and MUACC (VC1-ACB)";
    in(self) AccumulationIn {
        /// High for one clock to begin a pass; only while not busy.
        start: bit().on(MERGE),
        /// The pass that begins with `start` is the first: its colours are stored. Those of later passes are added.
        first: bit().on(MERGE),
        /// The word at the address of the previous clock: a depth, which is ignored, above a colour.
        word: bits(WORD).on(MERGE),
        /// The number of passes in the average.
        passes: one_of::<Passes>().on(MERGE),
        /// The number of the pixel to show, in raster order.
        read_address: below(self.screen.pixels()).on(self.crt),
    }
    out(self) AccumulationOut {
        /// A pass is under way.
        busy: bit(),
        /// The number of the pixel that the pass reads, in raster order.
        address: below(self.screen.pixels()),
        /// The average at the read address of the previous clock: red above green above blue.
        colour: bits(COMPONENTS * COMPONENT),
    }
}

impl Accumulation {
    /// The merger clocks for which a pass is busy.
    pub fn pass_clocks(&self) -> u64 {
        u64::from(self.screen.pixels()) + 1
    }

    fn build(&self, m: Module, i: AccumulationIn) -> AccumulationOut {
        let (merge, crt) = (m.on(MERGE), m.on(self.crt));
        let pixels = self.screen.pixels();

        // The pass: the pixel being read and the previous one, being stored.
        def!(reads = merge.reg(bit()).reset(0));
        def!(address = merge.reg(below(pixels)).reset(0));
        def!(ends = address.eq(pixels - 1));
        reads.when(i.start, 1).when(ends, 0);
        address.when(ends, 0).when(*reads, address + 1);
        def!(stores = merge.reg(bit()).reset(0));
        stores.next(*reads);
        def!(stored = merge.pipe(*address));
        def!(busy = reads | stores);
        merge.assume(i.start.implies(!busy), "a pass begins only while none is under way");

        // Even and odd pixels: while one memory is read, the other is written.
        let sum = bits(COMPONENTS * SUM);
        def!(sums = m.memory(pixels.div_ceil(2), sum.of(row(2)), ReadUnderWrite::Any));
        def!(parity = constants(bit().of(row(2)), |parity| parity));
        def!(reads_here = reads & parity.eq(address.bit(0)));
        def!(stores_here = stores & parity.eq(stored.bit(0)));
        def!(pixel = mux(stores_here, stored, *address));
        let place = |pixel: Signal| match pixel.width() {
            1 => lit(1, 0),
            width => pixel.slice(1..width),
        };
        merge.assert(!(reads_here & stores_here), "no memory is read and written in the same clock");
        def!(old = sums.on(MERGE).read_when(reads_here, place(pixel)));

        // One sum per component.
        def!(replaces = merge.pipe_when(i.start, i.first));
        def!(so_far = mux(replaces, 0, old.pick(stored.bit(0))));
        let colour = i.word.trunc(COMPONENTS * COMPONENT).unpack(row(COMPONENTS));
        def!(added = so_far.unpack(row(COMPONENTS)) + colour.zext(SUM));
        sums.on(MERGE).write(stores_here, place(pixel), added.pack().of(row(2)));

        let most = Passes::Sixteen.count();
        def!(may_follow = merge.reg(below(most)).reset(0));
        may_follow.when(i.start, mux(i.first, most - 1, may_follow - 1));
        let follows = i.start & !i.first;
        merge.assume(follows.implies(may_follow.ne(0)), "a pass is the first, or one of at most 15 that follow it");
        let passes_so_far = lit(up_to(most), most) - may_follow.zext(up_to(most));
        let greatest = (passes_so_far * ((1 << COMPONENT) - 1)).trunc(SUM);
        merge.assert(stores.implies(added.le(greatest)), "no sum exceeds the greatest that the passes so far can give");
        merge.cover("a pixel is the sum of 16 passes", stores & may_follow.eq(0));

        // The display.
        let passes = i.passes.quasi_static("the number of passes is constant while the average is shown");
        def!(read_odd = crt.pipe(i.read_address.bit(0)));
        def!(read = sums.on(self.crt).read(place(i.read_address)));
        let shown = read.pick(read_odd).unpack(row(COMPONENTS));
        // The bit below the quotient has the weight 1/2; adding it rounds.
        let quotient: Signal = passes.choose(|passes: Passes| shown.part(passes.shift() - 1, COMPONENT + 1));
        let average = quotient.part(1, COMPONENT) + quotient.part(0, 1).zext(COMPONENT);
        AccumulationOut { busy, address: *address, colour: average.pack() }
    }
}

#[cfg(test)]
mod tests;
