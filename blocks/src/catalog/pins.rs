//! The entries of blocks at the pins of a chip.

use crate::{
    Debouncer, DebouncerIn, FlashRead, I2cCommand, I2cMaster, I2cMasterIn, SdramController, SdramControllerIn,
    SdramRequest, SpiFlashReader, SpiFlashReaderIn, SpiMaster, SpiMasterIn, SpiWord,
};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{DEFAULT_PERIOD, Period, Scenario, Script, Stream, elaborate};

pub(super) const DEBOUNCER: Entry = Entry {
    name: "debouncer",
    summary: "follows a switch without its bounces",
    parameters: &[
        Parameter { name: "clocks", default: 3, min: 1, max: 1 << 32, meaning: "how long a new level lasts" },
        Parameter { name: "idle", default: 0, min: 0, max: 1, meaning: "the level at rest" },
    ],
    design: |values| Ok(elaborate(&debouncer(values))?),
    scenario: |values| Ok(bounces(&debouncer(values))),
};

pub(super) const SPI_MASTER: Entry = Entry {
    name: "spi-master",
    summary: "exchanges words with a slave on four lines",
    parameters: &[
        Parameter { name: "width", default: 4, min: 4, max: 64, meaning: "bits of a word" },
        Parameter { name: "clocks", default: 2, min: 1, max: 1 << 31, meaning: "how long half a period of sck is" },
        Parameter { name: "mode", default: 0, min: 0, max: 3, meaning: "2 CPOL + CPHA" },
    ],
    design: |values| Ok(elaborate(&spi_master(values))?),
    scenario: |values| Ok(two_frames(&spi_master(values))),
};

pub(super) const SDRAM_CONTROLLER: Entry = Entry {
    name: "sdram-controller",
    summary: "reads and writes a memory of 32 megabytes",
    parameters: &[
        Parameter { name: "period", default: 10, min: 8, max: 100, meaning: "nanoseconds of a clock" },
        Parameter { name: "late", default: 0, min: 0, max: 3, meaning: "clocks by which words come late" },
        Parameter {
            name: "power_up",
            default: 3,
            min: 1,
            max: 1 << 20,
            meaning: "clocks of 100 us, or fewer to simulate",
        },
    ],
    design: |values| Ok(elaborate(&sdram_controller(values))?),
    scenario: |values| Ok(two_rows(&sdram_controller(values))),
};

pub(super) const SPI_FLASH_READER: Entry = Entry {
    name: "spi-flash-reader",
    summary: "reads bytes of a flash memory on SPI",
    parameters: &[
        Parameter { name: "clocks", default: 1, min: 1, max: 1 << 31, meaning: "how long half a period of sck is" },
        Parameter { name: "fast", default: 0, min: 0, max: 1, meaning: "whether the command is 0x0b" },
        Parameter { name: "length", default: 8, min: 2, max: 32, meaning: "bits of the number of bytes" },
    ],
    design: |values| Ok(elaborate(&spi_flash_reader(values))?),
    scenario: |values| Ok(two_reads(&spi_flash_reader(values))),
};

pub(super) const I2C_MASTER: Entry = Entry {
    name: "i2c-master",
    summary: "exchanges bytes with slaves on two lines, which other masters may use, too",
    parameters: &[
        Parameter { name: "low", default: 5, min: 5, max: 1 << 16, meaning: "clocks for which SCL is low" },
        Parameter { name: "high", default: 2, min: 2, max: 1 << 16, meaning: "clocks for which SCL is seen high" },
    ],
    design: |values| Ok(elaborate(&i2c_master(values))?),
    scenario: |values| Ok(a_byte_each_way(&i2c_master(values))),
};

fn debouncer(values: &Values) -> Debouncer {
    Debouncer { clocks: values.get("clocks"), idle: values.get("idle") == 1 }
}

fn bounces(debouncer: &Debouncer) -> Scenario {
    let mut script = Script::new(debouncer, DEFAULT_PERIOD);
    let idle = u64::from(debouncer.idle);
    script.hold(&DebouncerIn { line: idle }, 2);
    for (line, clocks) in [(1, 1), (0, 1), (1, 2), (0, 1), (1, 8), (0, 2), (1, 1), (0, 8)] {
        script.hold(&DebouncerIn { line: line ^ idle }, clocks);
    }
    script.finish("a switch is pressed and released, and bounces each time; the level changes once")
}

fn spi_master(values: &Values) -> SpiMaster {
    let [width, half_period, mode] = ["width", "clocks", "mode"].map(|name| values.get_u32(name));
    SpiMaster { width, half_period, mode }
}

fn two_frames(master: &SpiMaster) -> Scenario {
    let mut script = Script::new(master, DEFAULT_PERIOD);
    let wait = 2 * u64::from(master.half_period) + 2;
    let waits = SpiMasterIn { send: Stream::of(1, SpiWord { word: 5, last: 1 }), miso: 0 };
    script.ready("received", true);
    exchange(&mut script, master, SpiWord { word: 9, last: 0 });
    exchange(&mut script, master, SpiWord { word: 6, last: 1 });
    script.ready("received", false);
    script.hold(&waits, wait);
    script.ready("received", true);
    exchange(&mut script, master, SpiWord { word: 5, last: 1 });
    script.wait(wait);
    script.finish("two words with the slave selected, and one more after a pause; the slave sends back each bit")
}

/// A word for a slave that sends it back, and changes its bits where the master does.
fn exchange(script: &mut Script<SpiMaster>, master: &SpiMaster, word: SpiWord<u64>) {
    script.clock(&SpiMasterIn { send: Stream::of(1, word), miso: 0 });
    for place in (0..master.width).rev() {
        let bit = SpiMasterIn { send: Stream::of(0, SpiWord { word: 0, last: 0 }), miso: word.word >> place & 1 };
        script.hold(&bit, 2 * master.half_period);
    }
}

fn sdram_controller(values: &Values) -> SdramController {
    let [late, power_up] = ["late", "power_up"].map(|name| values.get_u32(name));
    SdramController { late, power_up, ..SdramController::of_32_megabytes(Period::ns(values.get("period"))) }
}

fn two_rows(controller: &SdramController) -> Scenario {
    let SdramController { rcd, rp, ras, rfc, mrd, power_up, .. } = *controller;
    let mut script = Script::new(controller, DEFAULT_PERIOD);
    let [first, second, other] = [0x1200, 0x1201, 0x1a00];
    let request = |valid, write, address| {
        let data = if write == 1 { 0xcafe } else { 0 };
        Stream::of(valid, SdramRequest { write, address, data, strobe: 3 * write })
    };
    let idle = |dq| SdramControllerIn { request: request(0, 0, 0), dq };
    script.ready("words", true);
    script.hold(&idle(0), power_up + rp + 8 * rfc + mrd);
    let longest = controller.cas_latency + controller.late + 4 + rcd;
    for (write, address) in [(1, first), (0, second), (0, other)] {
        script.clock(&SdramControllerIn { request: request(1, write, address), dq: 0 });
        script.hold(&idle(address), longest + ras + rp);
    }
    script.finish(
        "after the start a word is written, the next one is read in the same row, and one in another row of the bank",
    )
}

fn spi_flash_reader(values: &Values) -> SpiFlashReader {
    let [half_period, length] = ["clocks", "length"].map(|name| values.get_u32(name));
    SpiFlashReader { half_period, fast: values.get("fast") == 1, length }
}

fn two_reads(reader: &SpiFlashReader) -> Scenario {
    let mut script = Script::new(reader, DEFAULT_PERIOD);
    let word = 16 * u64::from(reader.half_period) + 1;
    let header = if reader.fast { 5 } else { 4 };
    let show = |valid, address, length, miso| SpiFlashReaderIn {
        reads: Stream::of(valid, FlashRead { address, length }),
        miso,
    };
    script.ready("bytes", true);
    script.clock(&show(1, 0x12_3456, 2, 0));
    script.hold(&show(1, 0xab_cdef, 1, 0), header * word);
    script.hold(&show(1, 0xab_cdef, 1, 1), word);
    script.hold(&show(1, 0xab_cdef, 1, 0), 2);
    script.ready("bytes", false);
    script.hold(&show(0, 0, 0, 0), word + 3);
    script.ready("bytes", true);
    script.hold(&show(0, 0, 0, 1), (header + 2) * word);
    script.finish("two bytes are read, 0xff and 0, of which the second waits for the receiver; then one more, 0xff")
}

fn i2c_master(values: &Values) -> I2cMaster {
    let [low, high] = ["low", "high"].map(|name| values.get_u32(name));
    I2cMaster { low, high, filter: 1 }
}

/// A master, and the bus as it is if a slave does what is written.
struct Bus {
    script: Script<I2cMaster>,
    master: I2cMaster,
    sda: u64,
}

impl Bus {
    fn lines(&mut self, command: Option<I2cCommand<u64>>, scl: u64, sda: u64, clocks: u32) {
        let commands = Stream::of(command.is_some().into(), command.unwrap_or(I2cCommand::START));
        self.script.hold(&I2cMasterIn { commands, scl, sda }, clocks);
        self.sda = sda;
    }

    /// A bit whose low period a slave stretches by some clocks.
    fn bit(&mut self, sda: u64, stretched: u32) {
        let half = self.master.low / 2 + 1;
        self.lines(None, 0, self.sda, half);
        self.lines(None, 0, sda, self.master.low - half + stretched);
        self.lines(None, 1, sda, self.master.high + self.master.filter + 3);
    }

    /// The eight bits of a byte and its acknowledgement.
    fn byte(&mut self, command: I2cCommand<u64>, bits: u64, stretched: u32) {
        self.lines(Some(command), 0, self.sda, 1);
        for place in (0..9).rev() {
            self.bit(bits >> place & 1, if place == 8 { stretched } else { 0 });
        }
    }
}

fn a_byte_each_way(master: &I2cMaster) -> Scenario {
    let I2cMaster { low, high, .. } = *master;
    let mut bus = Bus { script: Script::new(master, DEFAULT_PERIOD), master: master.clone(), sda: 1 };
    bus.script.ready("answers", true);
    bus.lines(Some(I2cCommand::START), 1, 1, 1);
    bus.lines(None, 1, 1, low);
    bus.lines(None, 1, 0, high);
    bus.byte(I2cCommand::write(0xa5), 0xa5 << 1, 0);
    bus.byte(I2cCommand::LAST_READ, 0x3c << 1 | 1, 9);
    bus.lines(Some(I2cCommand::STOP), 0, bus.sda, 1);
    bus.bit(0, 0);
    bus.lines(None, 1, 1, low + 3);
    bus.script.finish(
        "START, a byte that a slave acknowledges, a byte from a slave, which stretches the clock before its first bit, \
         and STOP",
    )
}
