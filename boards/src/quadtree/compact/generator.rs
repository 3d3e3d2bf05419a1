//! The matrix of compact video processors, with the machine's video controller.

use tilewright_hdl::{Layout, Module, below, bit, bits, block, constants, def, row};
use tilewright_rtl::quadtree::controller::{Show, VideoController, VideoControllerIn};
use tilewright_rtl::quadtree::format::Format;
use tilewright_rtl::quadtree::video_buffer::Scan;

use super::lanes::Lane;
use super::processor::{CompactProcessor, CompactProcessorIn};

block! {
    /// A sparse-raster quadtree generator of compact video processors.
    ///
    /// A word goes to all video processors in the clock after the one in which all have room.
    pub struct CompactGenerator {
        /// The generator's format.
        pub format: Format,
    }
    in(self) CompactGeneratorIn {
        /// The words of packets, each at least two clocks after the previous one.
        words: stream(Lane::widths(self.format)),
        /// High for one clock to swap the banks; only when idle and while no picture is being read.
        swap: bit(),
        /// The settings of the read-out.
        show: Show::widths(self.format),
    }
    out(self) CompactGeneratorOut {
        /// Groups of p neighbouring pixels, line by line; pixels beyond the end of a line are to be ignored.
        pixels: stream(bits(self.format.word()).of(row(self.format.matrix().columns()))),
        /// No triangle is under way.
        idle: bit(),
        /// A picture is being read.
        showing: bit(),
    }
}

impl CompactGenerator {
    fn build(&self, m: Module, i: CompactGeneratorIn) -> CompactGeneratorOut {
        let format = self.format;
        let (matrix, p) = (format.matrix(), format.matrix().columns());
        let each = row(matrix.processors());
        def!(back = m.toggle(i.swap));
        def!(have_room = m.wire(bit()));
        let word = i.words.take_when(*have_room);
        // A register of its own, because the word has a long way to go.
        def!(write = m.reg(bit()).reset(0));
        write.next(word.taken);
        let sent = m.pipe_when(word.taken, "sent", *word);

        def!(scan = m.wire(Scan::widths(format).of(each)));
        let place = |side: u32, of: fn(u32, u32) -> u32| constants(below(side).of(each), move |lane| of(lane, p));
        let (column, line) = (place(p, |lane, p| lane % p), place(matrix.rows(), |lane, p| lane / p));
        def!(
            processor = m.array(matrix.processors(), &CompactProcessor { format }, |_| CompactProcessorIn {
                write: *write,
                word: sent,
                column,
                row: line,
                back,
                scan: *scan,
            })
        );
        have_room.drive(processor.has_room.and_all());
        let control = VideoControllerIn { show: i.show, words: processor.word };
        def!(controller = m.instance(&VideoController { format }, control));
        scan.drive(controller.scan);
        def!(idle = !i.words.valid & !write & processor.idle.and_all());
        m.assume(i.swap.implies(idle & !controller.busy), "the banks are swapped only while nothing is drawn or read");
        CompactGeneratorOut { pixels: controller.pixels, idle, showing: controller.busy }
    }
}
