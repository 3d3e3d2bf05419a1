//! The controller with the pads of its data bus.

use super::{SdramController, SdramControllerIn, SdramPins, SdramRequest};
use tilewright_hdl::{Module, Outside, Pad, PadIn, bits, block, def};

block! {
    /// An [`SdramController`] with its data bus on [pads](Pad): a whole chip, or what to copy from for one that has
    /// more to do. In Verilog `dq` is an `inout` port.
    ///
    /// ```text
    ///              .----------------.====> pins
    /// request ====>| SdramController|      .-----.
    /// words   <====|                |<====>| Pad |<====> dq
    ///              '----------------'      '-----'
    /// ```
    ///
    /// Latency and throughput are those of the controller. An assertion of the pad fails if the chip and the memory
    /// drive `dq` at once and differ.
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_hdl::{Period, elaborate};
    /// let controller = SdramController::of_32_megabytes(Period::ns(10));
    /// let files = tilewright_gen::verilog(&elaborate(&SdramOnPads { controller })?);
    /// assert!(files.last().unwrap().text.contains("inout  wire [15:0] dq"));
    /// # Ok::<(), tilewright_hdl::Problems>(())
    /// ```
    pub struct SdramOnPads {
        /// What is on the pads.
        pub controller: SdramController,
    }
    name = "sdram_on_pads";
    latency(self) = self.controller.clocks_on_an_open_row();
    in(self) SdramOnPadsIn {
        /// What is to be read or written.
        request: stream(SdramRequest::widths(self.controller.address_bits(), self.controller.bytes)),
        /// What the memory does on the data bus.
        dq: Outside::widths(8 * self.controller.bytes),
    }
    out(self) SdramOnPadsOut {
        /// The words that were read, in the sequence of their requests.
        words: stream(bits(8 * self.controller.bytes)),
        /// The memory's pins, apart from the data bus.
        pins: SdramPins::widths(self.controller.row_bits, self.controller.bytes),
    }
}

impl SdramOnPads {
    fn build(&self, m: Module, i: SdramOnPadsIn) -> SdramOnPadsOut {
        let width = bits(8 * self.controller.bytes);
        def!(line = m.wire(width));
        let into = SdramControllerIn { request: i.request, dq: *line };
        def!(controller = m.instance(&self.controller, into));
        let driven = PadIn { out: controller.dq_out, enable: controller.dq_enable, outside: i.dq };
        def!(dq = m.instance(&Pad::new(8 * self.controller.bytes), driven));
        line.drive(dq.line);
        SdramOnPadsOut { words: controller.words, pins: controller.pins }
    }
}
