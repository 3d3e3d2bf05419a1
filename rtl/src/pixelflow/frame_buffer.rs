//! The frame buffer: reads the colours of a region from the registers of its node, and scans frames out line by line
//! (PFL-LOAD, facts E4).
//!
//! ```text
//!              3 bytes of each chip       two chips a clock
//! registers ==>[ + ]==>[ colours or sums ]--->[ stored ]--->[ memory of even chips ]---.
//!                ^             |                       '--->[ memory of odd chips  ]--+v
//!                '-------------' of eight samples                                   [ offered ]==> pixels
//!                                             x, y: the pixel of the scan ----------------'
//! ```
//!
//! The frame buffer is connected where a shader has its texture unit, and starts at the array's command. It then takes
//! the next region; regions come row by row from the upper left. Colours are in registers 0 to 2: blue, green, red. The
//! port reads a byte of one pixel of each chip per clock, and a round reads one pixel of each chip. It takes 3 clocks,
//! or half as many as there are chips if that is more:
//!
//! | clock of a round | port | memory |
//! |---|---|---|
//! | 0 to 2 | reads the colour of pixel p | writes pixel p - 1 of two chips per clock, |
//! | from 3 on | | from clock 0 on |
//!
//! With eight samples, 2 x 2 processors have the samples of one screen pixel. Each processor has two colours, the
//! second one in registers 3 to 5. The four processors are in one chip, so the port reads them one after another in 24
//! clocks. Meanwhile three sums of 11 bits add up for each chip. An eighth of each sum is stored, rounded to nearest
//! (facts E0: `floor((sum + 4) / 8)`).
//!
//! | clock of a round | reads |
//! |---|---|
//! | 0 to 5 | both colours of the upper left sample |
//! | 6 to 11 | both colours of the upper right sample |
//! | 12 to 23 | both colours of the two lower samples |
//!
//! There is memory for two frames: one is scanned while the other is loaded. When the last region has arrived, the two
//! are exchanged at the beginning of the next scan. Until then the first region of the next frame waits. The output is
//! a stream of pixels, with flags for the first pixel of a frame and the last pixel of a line.
//!
//! Latency: a round for each pixel that a chip stores, and one more. That is 4112 clocks with 128 x 64 pixels (41.1 us;
//! the paper takes 52), and 1560 with 64 x 32 of eight samples. The scan reads a pixel per clock, and pauses for one
//! clock between different frames.

use super::SIDES;
use super::registers::PortAccess;
use super::texture_memory::fitting;
use crate::prelude::*;

block! {
    /// Stores frames of a screen region by region, and scans them out.
    pub struct FrameBuffer {
        /// The number of processors in a line of the node's array.
        pub columns: u32,
        /// The number of lines of the node's array.
        pub rows: u32,
        /// The number of samples of a pixel. Eight are two in each of 2 x 2 processors.
        pub samples: u32,
        /// The screen.
        pub screen: Screen,
    }
    ranges(self) {
        samples: any_of([1, FrameBuffer::EIGHT]),
        columns: powers_of_two(if self.samples == 1 { 2 } else { 8 }..=*SIDES.end()),
        /// There is a memory for even chips and one for odd ones, of two lines each; eight samples of a pixel take twice as many lines.
        rows: powers_of_two(if self.samples == 1 { 4 } else { 8 }..=*SIDES.end()),
    }
    latency(self) = format!("{} clocks for a region", self.clocks());
    source = "Reducing Latency on PixelFlow, section 4 (PFL-LOAD)";
    in(self) FrameBufferIn {
        /// For one clock: take the next region.
        start: bit(),
        /// The byte of each chip that the port addresses.
        seen: bits(8).of(row(self.chips())),
    }
    out(self) FrameBufferOut {
        /// The access to the node's registers.
        port: PortAccess = PortAccess {
            pixel: below(self.processors()),
            address: bits(6),
            writes: bit(),
            bytes: bits(8).of(row(self.chips())),
        },
        /// For one clock: the frame buffer has the region.
        done: bit(),
        /// The pixels of the displayed frame.
        pixels: stream(Shown),
    }
}

record! {
    /// A displayed pixel.
    pub struct Shown {
        /// The red of the pixel.
        red: bits(CHANNEL),
        /// The green of the pixel.
        green: bits(CHANNEL),
        /// The blue of the pixel.
        blue: bits(CHANNEL),
        /// The pixel is the first of a frame.
        first: bit(),
        /// The pixel is the last of a line.
        last: bit(),
    }
}

/// The bytes of a colour.
const COLOUR: u32 = 3;
/// The number of frames in memory.
const FRAMES: u32 = 2;
/// The bits of a channel.
const CHANNEL: u32 = 8;
/// For eight samples: the number of processors along each side of a pixel, and the number of renderings. A processor
/// has a colour of each rendering.
const SIDE: u32 = 2;
const RENDERINGS: u32 = 2;
/// The bits of a channel's sum over eight samples.
const SUM: u32 = CHANNEL + FrameBuffer::EIGHT.ilog2();

impl FrameBuffer {
    /// The samples of a pixel that is drawn with several: two in each of 2 x 2 processors.
    pub const EIGHT: u32 = SIDE * SIDE * RENDERINGS;

    /// The number of chips of the node.
    pub fn chips(&self) -> u32 {
        self.rows / 2
    }

    /// The number of processors of a chip.
    pub fn processors(&self) -> u32 {
        2 * self.columns
    }

    /// The number of processors along a side of a pixel.
    fn side(&self) -> u32 {
        if self.samples == 1 { 1 } else { SIDE }
    }

    /// The width and the height of a region in pixels.
    fn region(&self) -> [u32; 2] {
        [self.columns, self.rows].map(|processors| processors / self.side())
    }

    /// The number of pixels stored for each chip.
    fn pixels(&self) -> u32 {
        self.processors() / (self.side() * self.side())
    }

    /// The number of regions across and down the screen.
    pub fn regions(&self) -> [u32; 2] {
        let ([width, height], screen) = (self.region(), self.screen);
        [screen.width.div_ceil(width), screen.height.div_ceil(height)]
    }

    /// The clocks of a round, in which a pixel of each chip is read.
    pub fn turn(&self) -> u32 {
        self.bytes().max(self.chips() / 2)
    }

    /// The number of bytes read for a pixel.
    fn bytes(&self) -> u32 {
        COLOUR * self.samples
    }

    /// The clocks for a region.
    pub fn clocks(&self) -> u64 {
        u64::from(self.turn()) * u64::from(self.pixels() + 1)
    }

    /// The number of words of each of the two memories.
    fn words(&self) -> u32 {
        FRAMES * self.count() * self.chips() / 2 * self.pixels()
    }

    /// The number of regions of a frame.
    fn count(&self) -> u32 {
        let [across, down] = self.regions();
        across * down
    }

    /// The address of a pixel in the memory of its chip. The lowest bits of `pair` are half of the chip's number.
    fn address(&self, slot: Signal, pair: Signal, pixel: Signal) -> Signal {
        match self.chips() / 2 {
            // A single pair needs no number.
            1 => cat![slot, pixel],
            pairs => cat![slot, pair.trunc(below(pairs)), pixel],
        }
    }

    fn build(&self, m: Module, i: FrameBufferIn) -> FrameBufferOut {
        let (chips, pixels, turn, count) = (self.chips(), self.pixels(), self.turn(), self.count());
        let word = CHANNEL * COLOUR;
        let [even, odd] = ["even", "odd"].map(|name| m.memory(name, self.words(), word, ReadUnderWrite::Any));
        def!(shown = m.reg(bit()).reset(0));
        def!(is_whole = m.reg(bit()).reset(0));
        let slot = |frame: Signal, region: Signal| {
            let region = region.zext(below(FRAMES * count));
            mux(frame, region + count, region)
        };

        // A region is loaded into the frame that is not shown.
        def!(busy = m.reg(bit()).reset(0));
        def!(clock = m.reg(up_to(turn.max(4))));
        let number = m.reg("pixel", up_to(pixels));
        def!(region = m.reg(below(count)).reset(0));
        m.assume(i.start.implies(!busy), "the frame buffer begins only when it is done");
        def!(runs = busy & !(*is_whole & region.eq(0)));
        def!(turn_ends = runs & clock.eq(turn - 1));
        def!(ends = turn_ends & number.eq(pixels));
        def!(is_last = region.eq(count - 1));
        busy.when(i.start, 1).when(ends, 0);
        clock.when(i.start | turn_ends, 0).when(runs, clock + 1);
        number.when(i.start, 0).when(turn_ends, number + 1);
        region.when(ends, mux(is_last, 0, region + 1));

        def!(reads = runs & clock.lt(self.bytes()) & number.lt(pixels));
        let gathered = self.gather(m, i.seen, *clock, reads);
        def!(stored = m.reg(bits(word).of(row(chips))));
        stored.when(turn_ends, gathered).otherwise(stored.shifted(-2, 0));
        def!(stores = runs & number.ne(0) & clock.lt(chips / 2));
        let before = (number - 1).trunc(below(pixels));
        def!(stores_at = self.address(slot(!shown, *region), *clock, before));
        even.write(stores, stores_at, stored.lane(0));
        odd.write(stores, stores_at, stored.lane(1));

        // The scan, line by line. Frames are exchanged where it begins, if the new frame is complete.
        let [across, _] = self.regions();
        let Screen { width: columns, height: lines } = self.screen;
        let [width, height] = self.region();
        def!(x = m.reg(below(columns.max(width))).reset(0));
        def!(y = m.reg(below(lines.max(height))).reset(0));
        def!(left = m.reg(up_to(count)).reset(0));
        def!(has_frame = m.reg(bit()).reset(0));
        def!(is_first = x.eq(0) & y.eq(0));
        def!(changes = is_first & *is_whole);
        shown.when(changes, !shown);
        has_frame.when(changes, 1);
        is_whole.when(ends & is_last, 1).when(changes, 0);

        def!(arrived = m.reg(bit()).reset(0));
        def!(scans = m.wire(bit()));
        def!(is_rightmost = x.eq(columns - 1));
        def!(line_ends = scans & is_rightmost);
        def!(frame_ends = line_ends & y.eq(lines - 1));
        def!(region_ends = line_ends & y.part(0, below(height)).eq(height - 1));
        x.when(line_ends, 0).when(*scans, x + 1);
        y.when(frame_ends, 0).when(line_ends, y + 1);
        left.when(frame_ends, 0).when(region_ends, left + across);

        let (inside, beside) = (x.part(0, below(width)), *x >> width.trailing_zeros());
        def!(scanned = slot(*shown, *left + fitting(beside, left.width())));
        // The two lines of processors of a chip have two lines of pixels, or one.
        let (chip, inside) = match self.side() {
            1 => (*y >> 1, cat![y.bit(0), inside]),
            _ => (*y, inside),
        };
        def!(scans_at = self.address(scanned, chip >> 1, inside));
        let [even, odd] = [even, odd].map(|memory| memory.read_when(*scans, scans_at));
        let [is_odd, first, last] = [("is_odd", chip.bit(0)), ("first", is_first), ("last", is_rightmost)]
            .map(|(name, mark)| m.pipe_when(*scans, name, mark));
        def!(colour = mux(is_odd, odd, even));
        let channel = |number: u32| colour.part(8 * number, 8);
        let pixel = Shown { red: channel(2), green: channel(1), blue: channel(0), first, last };
        let (pixels, sent) = m.offer(*arrived, pixel);
        scans.drive(has_frame & !changes & (!arrived | sent));
        arrived.when(*scans, 1).when(sent, 0);

        let number = number.trunc(below(self.pixels()));
        let (pixel, address) = match self.samples {
            1 => (number, clock.zext(8).trunc(6)),
            _ => FrameBuffer::place_of_sample(m, number, runs, i.start | turn_ends),
        };
        let port = PortAccess { pixel, address, writes: lit(1, 0), bytes: lit(8, 0).of(row(chips)) };
        FrameBufferOut { port, done: ends, pixels }
    }

    /// The colour stored for each chip when a round ends: that of the pixel, or the mean of its samples.
    fn gather(&self, m: Module, seen: Signal, clock: Signal, reads: Signal) -> Signal {
        let of_all = row(self.chips());
        if self.samples == 1 {
            def!(colours = m.reg(bits(CHANNEL * COLOUR).of(of_all)));
            def!(gathered = mux(reads, cat![seen, colours.slice(CHANNEL..CHANNEL * COLOUR)], *colours));
            colours.next(gathered);
            return gathered;
        }
        // The lowest sum is that of the current channel.
        def!(sums = m.reg(bits(SUM * COLOUR).of(of_all)));
        let half = lit(SUM, FrameBuffer::EIGHT / 2).of(of_all);
        def!(sum = mux(clock.lt(COLOUR), half, sums.part(0, SUM)) + seen.zext(SUM));
        def!(summed = mux(reads, cat![sum, sums.slice(SUM..SUM * COLOUR)], *sums));
        sums.next(summed);
        let mean = |channel: u32| summed.part(channel * SUM + FrameBuffer::EIGHT.ilog2(), CHANNEL);
        def!(gathered = cat![mean(2), mean(1), mean(0)]);
        gathered
    }

    /// The processor and the register that are read for a pixel of eight samples, from the clock after `begins` on. All
    /// registers of a processor are read before the next processor.
    fn place_of_sample(m: Module, number: Signal, runs: Signal, begins: Signal) -> (Signal, Signal) {
        def!(register = m.reg(below(COLOUR * RENDERINGS)));
        def!(sample = m.reg(below(SIDE * SIDE)));
        def!(sample_ends = runs & register.eq(COLOUR * RENDERINGS - 1));
        register.when(begins | sample_ends, 0).when(runs, register + 1);
        sample.when(begins, 0).when(sample_ends, sample + 1);
        (cat![sample.bit(1), number, sample.bit(0)], register.zext(6))
    }
}

#[cfg(test)]
mod tests;
