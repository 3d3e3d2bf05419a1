//! The top: a PLL, a serial line for each design, and the pads of those that have some.

use super::served::Served;
use super::services::*;
use super::uart::{Receiver, ReceiverIn, Transmitter, TransmitterIn};
use tilewright_blocks::StreamIn;
use tilewright_boards::ulx3s::{CORE, CorePll, at_rest};
use tilewright_hdl::*;

block! {
    /// Designs on a ULX3S, each behind a serial line of its own. They run once the PLL has locked.
    ///
    /// ```text
    ///                 .----------.       .---------.       .-------------.
    /// rx (of each) -->| receiver |======>| service |======>| transmitter |--> tx (of each)
    ///                 '----------' bytes '---------' bytes '-------------'
    ///                                         ^   .------.
    /// 25 MHz --> PLL --> 80 MHz, locked       '-->| pads |<--> scl, sda, cs_n, sck, mosi
    ///                                             '------'
    /// ```
    pub struct OnUlx3s {
        /// Each of them once.
        pub designs: Vec<Served>,
        /// The clocks of a bit on the serial lines.
        pub clocks_per_bit: u32,
    }
    name(self) = format!("{}_on_ulx3s", self.designs.iter().map(|it| it.name()).collect::<Vec<_>>().join("_"));
    in(self) OnUlx3sIn {
        /// The serial lines to the designs.
        rx: [bit().on(CORE); self.designs.len()],
        buttons: [bits(7).on(CORE); self.count(Served::AxiLite)],
        miso: [bit().on(CORE); self.count(Served::Flash)],
        cs_n: [Outside::widths(1).on(CORE); self.count(Served::Flash)],
        sck: [Outside::widths(1).on(CORE); self.count(Served::Flash)],
        mosi: [Outside::widths(1).on(CORE); self.count(Served::Flash)],
        scl: [Outside::widths(1).on(CORE); self.count(Served::I2c)],
        sda: [Outside::widths(1).on(CORE); self.count(Served::I2c)],
    }
    out(self) OnUlx3sOut {
        /// The serial lines from the designs.
        tx: [bit(); self.designs.len()],
        leds: [bits(8); self.count(Served::AxiLite)],
        /// What CS, SCK and MOSI show; on the chip, those are the pins.
        flash_lines: [bit(); 3 * self.count(Served::Flash)],
        /// What SCL and SDA show.
        i2c_lines: [bit(); 2 * self.count(Served::I2c)],
        /// The PLL has locked.
        locked: bit(),
    }
}

impl OnUlx3s {
    /// These designs, with the usual rate of serial lines.
    pub fn at_115200_baud(designs: &[Served]) -> OnUlx3s {
        OnUlx3s { designs: designs.to_vec(), clocks_per_bit: 694 }
    }

    fn count(&self, design: Served) -> usize {
        self.designs.iter().filter(|it| **it == design).count()
    }

    fn build(&self, m: Module, i: OnUlx3sIn) -> OnUlx3sOut {
        let core = m.on(CORE);
        def!(pll = m.instance(&CorePll, at_rest()));
        def!(locked = core.synchronize(pll.lock));
        let mut pads = Pads::default();
        let lines = self.designs.iter().zip(&i.rx);
        let tx = lines.map(|(design, rx)| {
            let serves = || core.enabled(locked, || self.serves(core, *design, *rx, &i, &mut pads));
            core.within(design.name(), serves)
        });
        let tx = tx.collect();

        let drives = |out: Signal, outside: &Outside| PadIn { out, enable: locked, outside: *outside };
        let flash_lines =
            pads.flash.iter().zip(&i.cs_n).zip(i.sck.iter().zip(&i.mosi)).map(|((flash, cs_n), (sck, mosi))| {
                def!(cs_n = core.instance(&Pad::new(1).pull_up(), drives(flash.cs_n, cs_n)));
                def!(sck = core.instance(&Pad::new(1), drives(flash.sck, sck)));
                def!(mosi = core.instance(&Pad::new(1), drives(flash.mosi, mosi)));
                [cs_n.line, sck.line, mosi.line]
            });
        let flash_lines = flash_lines.flatten().collect();
        let i2c_lines = pads.i2c.iter().zip(i.scl.iter().zip(&i.sda)).map(|(i2c, (scl, sda))| {
            let pad = Pad::new(1).pull_up();
            def!(scl = core.instance(&pad, PadIn::open_drain(i2c.scl_low & locked, *scl)));
            def!(sda = core.instance(&pad, PadIn::open_drain(i2c.sda_low & locked, *sda)));
            i2c.scl.drive(scl.line);
            i2c.sda.drive(sda.line);
            [scl.line, sda.line]
        });
        let i2c_lines = i2c_lines.flatten().collect();
        OnUlx3sOut { tx, leds: pads.leds, flash_lines, i2c_lines, locked }
    }

    /// A design between its two serial lines; returns the line from it.
    fn serves(&self, core: Module, design: Served, rx: Signal, i: &OnUlx3sIn, pads: &mut Pads) -> Signal {
        let clocks_per_bit = self.clocks_per_bit;
        def!(receiver = core.instance(&Receiver { clocks_per_bit }, ReceiverIn { rx }));
        let (name, into) = ("u_service", receiver.bytes);
        let bytes = match design {
            Served::AxiLite => {
                let buttons = i.buttons[0];
                let served = core.instance(name, &AxiLiteService, AxiLiteServiceIn { into, buttons });
                pads.leds.push(served.leds);
                served.out
            }
            Served::Flash => {
                let served = core.instance(name, &FlashService, FlashServiceIn { into, miso: i.miso[0] });
                pads.flash.push(FlashPads { cs_n: served.cs_n, sck: served.sck, mosi: served.mosi });
                served.out
            }
            Served::I2c => {
                // The pads need the master, and the master the lines.
                def!(scl = core.wire(bit()));
                def!(sda = core.wire(bit()));
                let served = core.instance(name, &I2cService, I2cServiceIn { into, scl: *scl, sda: *sda });
                pads.i2c.push(I2cPads { scl, sda, scl_low: served.scl_low, sda_low: served.sda_low });
                served.out
            }
            Served::Transform => core.instance(name, &TransformService, StreamIn { into }).out,
            Served::SineCosine => core.instance(name, &SineCosineService, StreamIn { into }).out,
            Served::Cache => core.instance(name, &CacheService, StreamIn { into }).out,
        };
        def!(transmitter = core.instance(&Transmitter { clocks_per_bit }, TransmitterIn { bytes }));
        transmitter.tx
    }
}

/// What the designs do at pads of their own.
#[derive(Default)]
struct Pads {
    leds: Vec<Signal>,
    flash: Vec<FlashPads>,
    i2c: Vec<I2cPads>,
}

struct FlashPads {
    cs_n: Signal,
    sck: Signal,
    mosi: Signal,
}

struct I2cPads {
    scl: Wire,
    sda: Wire,
    scl_low: Signal,
    sda_low: Signal,
}
