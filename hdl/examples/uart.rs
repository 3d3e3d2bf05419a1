//! A UART: bytes of a stream as bits of a line, and back; its test is four processes side by side.
//! `cargo run -p tilewright-hdl --example uart`

use tilewright_hdl::*;
use tilewright_sim::{Pauses, Port, Simulation, Testbench, monitor};

block! {
    /// Sends bytes: a start bit, which is low, eight bits from the least significant on, and a stop bit, which is high.
    pub struct Transmitter {
        /// At least 4.
        pub clocks_per_bit: u32,
    }
    latency = "1 clock to the start bit";
    in TransmitterIn {
        /// What is to be sent.
        bytes: stream(bits(8)),
    }
    out TransmitterOut {
        /// The line.
        tx: bit(),
    }
}

impl Transmitter {
    fn build(&self, m: Module, i: TransmitterIn) -> TransmitterOut {
        def!(clock = m.reg(below(self.clocks_per_bit)).reset(0));
        def!(left = m.reg(up_to(10)).reset(0));
        def!(line = m.reg(9).reset(0x1ff)); // what is to be sent; the stop bit follows by itself
        def!(bit_ends = clock.eq(self.clocks_per_bit - 1));
        def!(byte_ends = bit_ends & left.eq(1));
        let byte = i.bytes.take_when(left.eq(0) | byte_ends);
        clock.when(byte.taken | bit_ends, 0).otherwise(clock + 1);
        left.when(byte.taken, 10).when(bit_ends & left.ne(0), left - 1);
        line.when(byte.taken, cat![*byte, lit(1, 0)]).when(bit_ends, cat![lit(1, 1), line.part(1, 8)]);
        TransmitterOut { tx: line.bit(0) }
    }
}

block! {
    /// Receives bytes. It samples the line in the middle of each bit, counted from the falling edge of the start bit.
    pub struct Receiver {
        /// At least 4.
        pub clocks_per_bit: u32,
    }
    latency = "3 clocks from the middle of the stop bit";
    in ReceiverIn {
        /// Asynchronous.
        rx: bit(),
    }
    out ReceiverOut {
        /// What was received.
        bytes: stream(bits(8)),
        /// The stop bit is low: the byte is invalid.
        framing_error: bit(),
        /// A byte is lost, because the previous one has not been taken.
        overrun: bit(),
    }
}

impl Receiver {
    fn build(&self, m: Module, i: ReceiverIn) -> ReceiverOut {
        def!(line = m.synchronize_from(true, i.rx));
        def!(was_high = m.pipe(line));
        def!(clock = m.reg(below(self.clocks_per_bit)).reset(0));
        def!(left = m.reg(up_to(10)).reset(0));
        def!(bits = m.reg(8));
        def!(starts = left.eq(0) & was_high & !line);
        def!(samples = left.ne(0) & clock.eq(0));
        def!(glitch = left.eq(10) & line); // no start bit: its middle is high
        def!(ends = samples & left.eq(1));
        clock.when(starts, self.clocks_per_bit / 2 - 1).when(samples, self.clocks_per_bit - 1).otherwise(clock - 1);
        left.when(starts, 10).when(samples & glitch, 0).when(samples, left - 1);
        bits.when(samples, cat![line, bits.part(1, 7)]);

        def!(full = m.reg(bit()).reset(0));
        def!(held = m.reg(8));
        let (bytes, sent) = m.offer(full, *held);
        def!(keeps = ends & line & !full);
        held.when(keeps, *bits);
        full.when(keeps, 1).when(sent, 0);
        ReceiverOut { bytes, framing_error: ends & !line, overrun: ends & line & full }
    }
}

block! {
    /// The two ends of a line: bytes to send, and bytes received.
    struct Uart {
        /// At least 4.
        clocks_per_bit: u32,
    }
    in UartIn { send: stream(bits(8)), rx: bit() }
    out UartOut { tx: bit(), received: stream(bits(8)), framing_error: bit(), overrun: bit() }
}

impl Uart {
    fn build(&self, m: Module, i: UartIn) -> UartOut {
        let Uart { clocks_per_bit } = *self;
        def!(transmitter = m.instance(&Transmitter { clocks_per_bit }, TransmitterIn { bytes: i.send }));
        def!(receiver = m.instance(&Receiver { clocks_per_bit }, ReceiverIn { rx: i.rx }));
        UartOut {
            tx: transmitter.tx,
            received: receiver.bytes,
            framing_error: receiver.framing_error,
            overrun: receiver.overrun,
        }
    }
}

/// The far end sends a byte, with its own bit length.
pub async fn far_end_sends(t: &Testbench<'_>, rx: Port, byte: u64, stop: u64, clocks_per_bit: u64) {
    for bit in [0].into_iter().chain((0..8).map(|place| byte >> place & 1)).chain([stop, 1]) {
        t.set(rx, bit);
        t.wait(clocks_per_bit).await;
    }
}

/// The far end receives a byte.
pub async fn far_end_receives(t: &Testbench<'_>, tx: Port, clocks_per_bit: u64) -> u64 {
    t.until(tx.is(0)).await;
    t.wait(clocks_per_bit / 2).await;
    let mut byte = 0;
    for place in 0..8 {
        t.wait(clocks_per_bit).await;
        byte |= t.get_u64(tx) << place;
    }
    t.wait(clocks_per_bit).await;
    assert_eq!(t.get_u64(tx), 1, "the stop bit");
    byte
}

/// Runs it; a test does so too, and runs its Verilog against it.
pub fn run() -> Result<(Design, Recording), Box<dyn std::error::Error>> {
    let uart = Uart { clocks_per_bit: 32 };
    let mut sim = Simulation::of(&uart)?;
    let recording = sim.recording();
    sim.set(sim.i.rx, 1);
    sim.reset();
    let (i, o) = (sim.i, sim.o);
    let t = &sim.testbench();

    // Both directions at once, with pauses; the far end's bits are a clock shorter than ours, or longer.
    let bytes = [0x55, 0x00, 0xff, 0x80, 0x01, 0xa7];
    for far in [31, 32, 33] {
        let sends = t.send_all(i.send, bytes, Pauses::percent(99, far));
        let far_end_hears = async {
            for byte in bytes {
                assert_eq!(far_end_receives(t, o.tx, far).await, byte);
            }
        };
        let far_end_talks = async {
            for byte in bytes {
                far_end_sends(t, i.rx, byte, 1, far).await;
            }
        };
        let receives = t.expect_all(o.received, bytes, Pauses::percent(90, far));
        let has_no_errors = async {
            loop {
                t.step().await;
                assert_eq!([o.framing_error, o.overrun].map(|port| t.get_u64(port)), [0, 0], "at {} ps", t.time());
            }
        };
        t.run((sends, far_end_hears, far_end_talks, receives, monitor(has_no_errors)));
    }

    // A glitch is not a start bit, a byte without its stop bit is invalid, and of two bytes that nobody takes the
    // second is lost.
    let far_end_talks = async {
        t.set(i.rx, 0);
        t.wait(5).await;
        t.set(i.rx, 1);
        t.wait(50).await;
        far_end_sends(t, i.rx, 0x77, 0, 32).await;
        far_end_sends(t, i.rx, 0x33, 1, 32).await;
        far_end_sends(t, i.rx, 0x44, 1, 32).await;
        t.receive(o.received).await
    };
    let (mut framing_errors, mut overruns) = (0, 0);
    let counts = async {
        loop {
            t.step().await;
            framing_errors += t.get_u64(o.framing_error);
            overruns += t.get_u64(o.overrun);
        }
    };
    let (received, ()) = t.run((far_end_talks, monitor(counts)));
    assert_eq!((received, framing_errors, overruns), (0x33, 1, 1));

    Ok((elaborate(&uart)?, recording.take()))
}

/// Runs it, and prints its Verilog.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files = tilewright_gen::verilog(&run()?.0);
    files.iter().for_each(|file| print!("{}", file.text));
    Ok(())
}
