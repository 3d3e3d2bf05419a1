//! A video processor that computes each function where its window is.
//!
//! ```text
//!          .-------.  edge a, b, c  .----------------.  negative: fails  .------.
//! words -->| queue |--------------->| a x + b y + c  |------------------>| walk |--> x, y
//!          '-------'  bounds        '----------------'                   '------'
//!              |      plane         .----------------.  depth, colour  .--------------.
//!              '------------------->| x X + y Y + o  |---------------->| video buffer |--> word
//!                                   '----------------'                 '--------------'
//! ```

use tilewright_hdl::{Module, ReadUnderWrite, Signal, below, bit, bits, block, cat, def, lit, mux, up_to};
use tilewright_rtl::quadtree::format::{Bounds, Format};
use tilewright_rtl::quadtree::pixel::Fragment;
use tilewright_rtl::quadtree::video_buffer::{Scan, VideoBuffer, VideoBufferIn};

use super::lanes::{Lane, WORDS};
use super::walk::{Walk, WalkIn, WalkOut};
use crate::quadtree::store::EDGES;

/// The packets that the queue holds.
const PACKETS: u32 = 4;

block! {
    /// Draws triangles in a raster of its own: every p-th pixel of every q-th line.
    ///
    /// A window takes a clock for its bounds and one for each edge, up to the first that it fails. The way to the next
    /// one takes the clocks of [`Walk`].
    pub struct CompactProcessor {
        /// The generator's format, without an aperture.
        pub format: Format,
    }
    in(self) CompactProcessorIn {
        /// A word arrives; only while there is room.
        write: bit(),
        /// The word.
        word: Lane = Lane::widths(self.format),
        /// The video processor's column in the matrix; a constant.
        column: below(self.format.matrix().columns()),
        /// The video processor's row in the matrix; a constant.
        row: below(self.format.matrix().rows()),
        /// The number of the bank to draw in.
        back: bit(),
        /// The pixel of the other bank to send.
        scan: Scan = Scan::widths(self.format),
    }
    out(self) CompactProcessorOut {
        /// The word sent to the video controller.
        word: bits(self.format.word()),
        /// There is room for a word.
        has_room: bit(),
        /// No triangle is under way.
        idle: bit(),
    }
}

impl CompactProcessor {
    fn build(&self, m: Module, i: CompactProcessorIn) -> CompactProcessorOut {
        let format = self.format;

        // The queue: the words of a packet are read as often as there are windows.
        let queue = m.memory("queue", PACKETS * WORDS, Lane::widths(format), ReadUnderWrite::Any);
        def!(to = m.reg(below(PACKETS * WORDS)).reset(0));
        def!(first = m.reg(below(PACKETS)).reset(0));
        def!(held = m.reg(up_to(PACKETS)).reset(0));
        def!(has_room = held.ne(PACKETS));
        m.assert(i.write.implies(has_room), "a word arrives only while there is room");
        queue.write(i.write, *to, i.word);
        to.when(i.write, to + 1);
        def!(arrives = i.write & to.part(0, below(WORDS).bits()).all_ones());

        // The bounds come first: a window beyond them takes one clock alone.
        def!(step = m.reg(below(WORDS)).reset(EDGES));
        let lane = queue.read_async(cat![first, step]);
        def!(window_passes = m.wire(bit()));
        def!(window_fails = m.wire(bit()));
        let walk = WalkIn { passes: *window_passes, fails: *window_fails };
        let window = m.instance("u_walk", &Walk { levels: format.levels() }, walk);
        let place = self.place(i.column, i.row);
        def!(tests = held.ne(0) & window.visits);
        def!(
            is_outside = mux(
                step.eq(EDGES),
                place.is_beyond(&lane.bounds(&format), &window),
                place.is_negative(&format, &lane, &window)
            )
        );
        def!(fails = tests & is_outside);
        def!(passes = tests & !is_outside & step.eq(EDGES - 1));
        window_passes.drive(passes);
        window_fails.drive(fails);
        step.when(fails | passes, EDGES).when(tests, step + 1);
        first.when(window.ends, first + 1);
        held.when(arrives & !window.ends, held + 1).when(window.ends & !arrives, held - 1);

        let word = self.word(m, tests, *step, &lane, [place.column(window.left), place.line(window.top)]);
        def!(drawing = m.reg(bit()).reset(0));
        drawing.next(passes & window.is_leaf);
        let draw = Fragment {
            valid: *drawing,
            x: m.pipe_when(passes, "drawn_x", window.left.trunc(below(format.columns()))),
            y: m.pipe_when(passes, "drawn_y", window.top.trunc(below(format.rows()))),
            word,
        };
        let buffer = VideoBufferIn { draw, strict: lit(1, 0), back: i.back, scan: i.scan };
        def!(buffer = m.instance(&VideoBuffer { format }, buffer));
        def!(drawn = m.reg(bit()).reset(0));
        drawn.next(drawing);
        CompactProcessorOut { word: buffer.word, has_room, idle: held.eq(0) & !drawing & !drawn }
    }

    fn place(&self, column: Signal, row: Signal) -> Place {
        let matrix = self.format.matrix();
        Place { first: [column, row], spacing: [matrix.columns(), matrix.rows()] }
    }

    /// The word of the window's upper left pixel, in the clock after the last edge: a plane a clock, while `tests` is high.
    fn word(&self, m: Module, tests: Signal, step: Signal, lane: &Lane, pixel: [Signal; 2]) -> Signal {
        let precision = self.format.precision();
        let at = |increase: Signal, place: Signal| increase.times(place).trunc(precision.plane);
        def!(plane = lane.origin + at(lane.x, pixel[0]) + at(lane.y, pixel[1]));
        let upper = |name: &str, number: u32, of: u32, bits: u32| {
            m.pipe_when(tests & step.eq(number), name, plane.part(of - bits, bits))
        };
        let of_colour = precision.plane.min(24);
        let depth = upper("depth", 0, precision.plane, precision.depth);
        let [red, green, blue] = [("red", 1), ("green", 2), ("blue", 3)]
            .map(|(name, number)| upper(name, number, of_colour, precision.colour));
        cat![depth, red, green, blue]
    }
}

/// Where a video processor's samples are on the screen.
#[derive(Clone, Copy)]
struct Place {
    /// The column and the line of the first sample.
    first: [Signal; 2],
    /// How far apart columns and lines are.
    spacing: [u32; 2],
}

impl Place {
    fn column(&self, sample: Signal) -> Signal {
        self.along(0, sample)
    }

    fn line(&self, sample: Signal) -> Signal {
        self.along(1, sample)
    }

    fn along(&self, axis: usize, sample: Signal) -> Signal {
        // The spacing is a power of two.
        if self.spacing[axis] == 1 { sample } else { cat![sample, self.first[axis]] }
    }

    /// Whether the window is beyond one of the bounds.
    fn is_beyond(&self, bounds: &Bounds, window: &WalkOut) -> Signal {
        let is_before = |left: Signal, right: Signal| {
            let width = left.width().max(right.width());
            left.zext(width).lt(right.zext(width))
        };
        is_before(self.column(window.right), bounds.left)
            | is_before(self.line(window.bottom), bounds.top)
            | is_before(bounds.right, self.column(window.left))
            | is_before(bounds.bottom, self.line(window.top))
    }

    /// Whether the edge function is negative at that corner of the window where it is greatest.
    fn is_negative(&self, format: &Format, lane: &Lane, window: &WalkOut) -> Signal {
        let [a, b, c] = lane.edge(format);
        let bits = format.edge_bits();
        let fitted = |number: Signal| if number.width() > bits { number.trunc(bits) } else { number.sext(bits) };
        let at = |slope: Signal, place: Signal| fitted(slope.times(place.zext(place.width() + 1).signed()));
        let greatest = |slope: Signal, near: Signal, far: Signal| mux(slope.is_negative(), near, far);
        let value = fitted(c)
            + at(a, self.column(greatest(a, window.left, window.right)))
            + at(b, self.line(greatest(b, window.top, window.bottom)));
        value.is_negative()
    }
}
