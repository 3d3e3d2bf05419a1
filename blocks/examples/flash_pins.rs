//! A reader of a serial flash memory with its pins, which a programmer drives, too. The memory is a program.
//! `cargo run -p tilewright-blocks --example flash_pins`

#[path = "devices/flash.rs"]
pub mod devices;

use devices::Flash;
use tilewright_blocks::{FlashRead, PacketByte, SpiFlashReader, SpiFlashReaderIn};
use tilewright_hdl::*;
use tilewright_sim::{Pauses, Simulation, monitor};

block! {
    /// A reader of a flash memory whose lines a programmer on the board drives, too.
    ///
    /// ```text
    ///           .--------.              .------.
    /// reads ===>| flash  |------------->| pads |<--> cs_n, sck, mosi
    /// bytes <===| reader |   programs ->|      |
    ///           |        |<-- miso      '------'
    ///           '--------'
    /// ```
    pub struct FlashPins {
        /// The reader.
        pub reader: SpiFlashReader,
    }
    name = "flash_pins";
    latency = "as many clocks as the reader";
    in(self) FlashPinsIn {
        /// What to read.
        reads: stream(FlashRead { address: bits(24), length: bits(self.reader.length) }),
        /// High while the programmer has the lines. Nothing may be read then.
        programs: bit(),
        /// The line from the memory.
        miso: bit(),
        /// The programmer on CS.
        cs_n: Outside::widths(1),
        /// The programmer on SCK.
        sck: Outside::widths(1),
        /// The programmer on MOSI.
        mosi: Outside::widths(1),
    }
    out FlashPinsOut {
        /// The bytes, with `last` at the end of each read.
        bytes: stream(PacketByte),
        /// What CS shows; on the chip, that is the pin.
        cs_n_line: bit(),
        /// What SCK shows.
        sck_line: bit(),
        /// What MOSI shows.
        mosi_line: bit(),
    }
}

impl FlashPins {
    fn build(&self, m: Module, i: FlashPinsIn) -> FlashPinsOut {
        def!(reader = m.instance(&self.reader, SpiFlashReaderIn { reads: i.reads, miso: i.miso }));
        m.assert(i.programs.implies(reader.cs_n), "nothing is read while the programmer has the lines");
        let drives = |out: Signal, outside: Outside| PadIn { out, enable: !i.programs, outside };
        def!(cs_n = m.instance(&Pad::new(1).pull_up(), drives(reader.cs_n, i.cs_n)));
        def!(sck = m.instance(&Pad::new(1), drives(reader.sck, i.sck)));
        def!(mosi = m.instance(&Pad::new(1), drives(reader.mosi, i.mosi)));
        FlashPinsOut { bytes: reader.bytes, cs_n_line: cs_n.line, sck_line: sck.line, mosi_line: mosi.line }
    }
}

/// Runs it; a test does so too, and runs its Verilog against it.
pub fn run() -> Result<(Design, Recording), Box<dyn std::error::Error>> {
    let pins = FlashPins { reader: SpiFlashReader { half_period: 2, fast: true, length: 8 } };
    let mut sim = Simulation::of(&pins)?.seeded(1);
    let recording = sim.recording();
    sim.reset();
    let (i, o) = (sim.i, sim.o);

    // The programmer reads the byte at address 5 itself.
    let mut flash = Flash::new((0..32).map(|byte| byte ^ 0x5a).collect(), true);
    let lines = [i.cs_n.value, i.sck.value, i.mosi.value];
    sim.set(i.programs, 1);
    [i.cs_n.drives, i.sck.drives, i.mosi.drives].into_iter().for_each(|drives| sim.set(drives, 1));
    sim.set(i.cs_n.value, 1);
    let t = &sim.testbench();
    let programmer = async {
        let mut byte = 0;
        t.set(lines[0], 0);
        for bit in (0..48).rev() {
            t.set(lines[2], 0x0b00_0005_0000u64 >> bit & 1);
            t.wait(4).await;
            byte = byte << 1 & 0xff | t.get_u64(i.miso);
            t.set(lines[1], 1);
            t.wait(4).await;
            t.set(lines[1], 0);
        }
        t.wait(4).await;
        t.set(lines[0], 1);
        t.wait(4).await;
        byte
    };
    let seen = [o.cs_n_line, o.sck_line, o.mosi_line, i.miso];
    let (byte, _) = t.run((programmer, monitor(flash.runs(t, seen, 2, 1))));
    assert_eq!(byte, 5 ^ 0x5a);

    // Then it leaves the lines to the reader.
    [i.cs_n.drives, i.sck.drives, i.mosi.drives, i.programs].into_iter().for_each(|drives| t.set(drives, 0));
    let reads = [FlashRead { address: 30, length: 3 }, FlashRead { address: 7, length: 1 }];
    let expected = [(30, 0), (31, 0), (0, 1), (7, 1)];
    let expected = expected.map(|(byte, last)| PacketByte { byte: byte ^ 0x5a, last });
    t.run((
        t.send_all(i.reads, reads, Pauses::NONE),
        t.expect_all(o.bytes, expected, Pauses::percent(50, 1)),
        monitor(flash.runs(t, seen, 2, 1)),
    ));
    Ok((elaborate(&pins)?, recording.take()))
}

/// Runs it, and prints its Verilog.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files = tilewright_gen::verilog(&run()?.0);
    files.iter().for_each(|file| print!("{}", file.text));
    Ok(())
}
