//! The video controller: reads the video buffers as one picture, interleaving them along both axes (MPG-ARCH, MPG-SPR).
//!
//! ```text
//!            .---------------.   x div p, y div q    .----------------.   p words
//! show ----->| column, line, |---------------------->| video buffers  |==========> pixels
//!            | matrix row    |--- y mod q: row ----->| of a row       |
//!            '---------------'                       '----------------'
//! ```
//!
//! Pixel (x, y) is in the buffer of video processor (x mod p, y mod q), at (x div p, y div q). So p neighbouring pixels
//! are at the same address of p buffers, and are read at once. A line ends with the group that contains its last pixel.
//!
//! Latency and throughput: 2 clocks from `start` to the first group, then one a clock while the receiver is ready.

use super::format::Format;
use super::video_buffer::Scan;
use crate::prelude::*;

block! {
    /// Reads the picture from the video buffers, line by line.
    pub struct VideoController {
        /// The generator's format.
        pub format: Format,
    }
    latency = "2 clocks from `start` to the first pixels, then p pixels a clock";
    source = "sparse-raster quadtree generator, figure 1 (MPG-ARCH, MPG-SPR)";
    in(self) VideoControllerIn {
        /// The settings of the read-out.
        show: Show::widths(self.format),
        /// The words sent by the video buffers, row by row of the matrix.
        words: bits(self.format.word()).of(row(self.format.matrix().processors())),
    }
    out(self) VideoControllerOut {
        /// The pixel that each video buffer is to send.
        scan: Scan = Scan::widths(self.format).of(row(self.format.matrix().processors())),
        /// Groups of p neighbouring pixels; the last group of a line may extend beyond the line's end.
        pixels: stream(bits(self.format.word()).of(row(self.format.matrix().columns()))),
        /// A picture is being read.
        busy: bit(),
    }
}

record! {
    /// The settings of the read-out.
    pub struct Show(format: Format) {
        /// High for one clock to read a picture; only while no picture is being read.
        start: bit(),
        /// Each pixel is cleared when it is read; constant while a picture is being read.
        clear: bit(),
        /// The colour of pixels where nothing was drawn.
        background: bits(3 * format.precision().colour),
    }
}

impl VideoController {
    fn build(&self, m: Module, i: VideoControllerIn) -> VideoControllerOut {
        let (matrix, screen) = (self.format.matrix(), self.format.screen());
        let (p, q, each) = (matrix.columns(), matrix.rows(), row(matrix.processors()));
        def!(reading = m.reg(bit()).reset(0));
        def!(column = m.reg(below(self.format.columns())).reset(0));
        def!(line = m.reg(below(screen.height.max(q))).reset(0));
        def!(arrived = m.reg(bit()).reset(0));

        // A group is requested in each clock in which its predecessor can leave.
        let words = i.words.pack().unpack(grid(q, p));
        let matrix_row = if q == 1 { lit(1, 0) } else { line.trunc(below(q)) };
        def!(arrived_row = m.wire(matrix_row.width()));
        let depth = self.format.precision().depth;
        let blank = cat![lit(depth, (1_u64 << depth) - 1), i.show.background];
        let group = words.rows().pick(*arrived_row);
        let (pixels, sent) = m.offer(*arrived, mux(group.all_ones(), blank, group));
        def!(asks = reading & (!arrived | sent));
        def!(line_ends = asks & column.eq(self.format.columns() - 1));
        def!(ends = line_ends & line.eq(screen.height - 1));
        arrived_row.drive(m.pipe_when(asks, "asked_row", matrix_row));
        reading.when(i.show.start, 1).when(ends, 0);
        column.when(i.show.start | line_ends, 0).when(asks, column + 1);
        line.when(i.show.start, 0).when(line_ends, line + 1);
        arrived.when(asks, 1).when(sent, 0);
        m.assume(i.show.start.implies(!reading & !arrived), "a picture is requested only while none is being read");

        let row_of = constants(bits(matrix_row.width()).of(each), |lane| lane / p);
        let scan = Scan {
            enable: asks & row_of.eq(matrix_row),
            x: column.of(each),
            y: (line >> q.trailing_zeros()).trunc(below(self.format.rows())).of(each),
            clear: i.show.clear.of(each),
        };
        VideoControllerOut { scan, pixels, busy: reading | arrived }
    }
}

#[cfg(test)]
mod tests;
