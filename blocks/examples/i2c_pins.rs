//! A master of I2C with its two pins. A program that behaves like an EEPROM is its slave, and stretches the clock.
//! `cargo run -p tilewright-blocks --example i2c_pins`

#[path = "devices/i2c.rs"]
pub mod devices;

use devices::{Bus, Eeprom, Stretching};
use tilewright_blocks::{I2cAnswer, I2cCommand, I2cMaster, I2cMasterIn, I2cResult};
use tilewright_hdl::*;
use tilewright_sim::{Pauses, Simulation, monitor};

block! {
    /// A master of I2C at two pins with pull-ups.
    ///
    /// ```text
    ///              .--------.  scl_low, sda_low  .------.
    /// commands ===>| I2C    |------------------->| open |<--> scl
    /// answers <====| master |<-------------------| drain|<--> sda
    ///              '--------'    scl, sda        '------'
    /// ```
    pub struct I2cPins {
        /// Its clocks.
        pub master: I2cMaster,
    }
    name = "i2c_pins";
    latency = "as many clocks as the master";
    in I2cPinsIn {
        /// What to do.
        commands: stream(I2cCommand),
        /// The others on SCL.
        scl: Outside::widths(1),
        /// The others on SDA.
        sda: Outside::widths(1),
    }
    out I2cPinsOut {
        /// What became of each command.
        answers: stream(I2cAnswer),
        /// High from a START of any master to a STOP.
        busy: bit(),
        /// What SCL shows; on the chip, that is the pin.
        scl_line: bit(),
        /// What SDA shows.
        sda_line: bit(),
    }
}

impl I2cPins {
    fn build(&self, m: Module, i: I2cPinsIn) -> I2cPinsOut {
        // The pins need the master, and the master the lines.
        def!(scl_line = m.wire(bit()));
        def!(sda_line = m.wire(bit()));
        let into = I2cMasterIn { commands: i.commands, scl: *scl_line, sda: *sda_line };
        def!(master = m.instance(&self.master, into));
        let pad = Pad::new(1).pull_up();
        def!(scl = m.instance(&pad, PadIn::open_drain(master.scl_low, i.scl)));
        def!(sda = m.instance(&pad, PadIn::open_drain(master.sda_low, i.sda)));
        scl_line.drive(scl.line);
        sda_line.drive(sda.line);
        I2cPinsOut { answers: master.answers, busy: master.busy, scl_line: *scl_line, sda_line: *sda_line }
    }
}

/// Runs it; a test does so too, and runs its Verilog against it.
pub fn run() -> Result<(Design, Recording), Box<dyn std::error::Error>> {
    let pins = I2cPins { master: I2cMaster { low: 6, high: 4, filter: 1 } };
    let mut sim = Simulation::of(&pins)?.seeded(1);
    let recording = sim.recording();
    sim.reset();
    let (i, o) = (sim.i, sim.o);
    let lines = [i.scl.drives, i.sda.drives, o.scl_line, o.sda_line];
    let mut eeprom = Eeprom::new(0x50, (0..16).collect());
    let t = &sim.testbench();

    // Two bytes are written from address 14 on, and three are read from there: the last is that at address 0.
    use I2cCommand as Do;
    let write = [Do::START, Do::write(0xa0), Do::write(14), Do::write(0x12), Do::write(0x34), Do::STOP];
    let seek = [Do::START, Do::write(0xa0), Do::write(14)];
    let read = [Do::START, Do::write(0xa1), Do::READ, Do::READ, Do::LAST_READ, Do::STOP];
    let program = [&write[..], &seek, &read].concat();
    let count = program.len();
    let bus = &Bus::new(t, lines);
    let ((), answers, ..) = t.run((
        t.send_all(i.commands, program, Pauses::percent(30, 1)),
        t.receive_all(o.answers, count, Pauses::percent(30, 2)),
        bus.scl(),
        bus.sda(),
        monitor(eeprom.runs(bus, Stretching::new(40, 20, 3))),
    ));
    assert!(answers.iter().all(|answer| answer.result == I2cResult::Done.code()));
    let bytes: Vec<u64> = answers[count - 4..count - 1].iter().map(|answer| answer.byte).collect();
    assert_eq!(bytes, [0x12, 0x34, 0]);

    // Nobody has another address.
    let nobody = [Do::START, Do::write(0xa2), Do::STOP];
    let ((), answers, ..) = t.run((
        t.send_all(i.commands, nobody, Pauses::NONE),
        t.receive_all(o.answers, 3, Pauses::NONE),
        bus.scl(),
        bus.sda(),
        monitor(eeprom.runs(bus, Stretching::NONE)),
    ));
    assert_eq!(answers[1].result, I2cResult::Nack.code());
    Ok((elaborate(&pins)?, recording.take()))
}

/// Runs it, and prints its Verilog.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files = tilewright_gen::verilog(&run()?.0);
    files.iter().for_each(|file| print!("{}", file.text));
    Ok(())
}
