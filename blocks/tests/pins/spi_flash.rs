//! A reader of flash memories, against a memory that is a program.

#[path = "../../examples/flash_pins.rs"]
pub mod flash_pins;

use flash_pins::devices::{Flash, Pins};
use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_sim::{Pauses, Simulation, monitor};

const SIZE: usize = 48;

type Byte = PacketByte<u64>;

fn memory() -> Vec<u8> {
    (0..SIZE as u8).map(|place| place.wrapping_mul(151) ^ 0x2d).collect()
}

fn bytes(reads: &[FlashRead<u64>]) -> Vec<Byte> {
    let byte = |read: &FlashRead<u64>, place: u64| PacketByte {
        byte: memory()[((read.address + place) % SIZE as u64) as usize].into(),
        last: u64::from(place + 1 == read.length),
    };
    reads.iter().flat_map(|read| (0..read.length).map(move |place| byte(read, place))).collect()
}

/// The clocks in which reads and bytes are taken, if each read waits to be taken, and the receiver is ready as
/// `is_ready` says of a clock.
fn clocks(block: &SpiFlashReader, reads: &[FlashRead<u64>], is_ready: impl Fn(u64) -> bool) -> (Vec<u64>, Vec<u64>) {
    let half = u64::from(block.half_period);
    let (word, header) = (16 * half + 1, if block.fast { 5 } else { 4 });
    let (mut reads_taken, mut bytes_taken) = (Vec::new(), Vec::new());
    // When the reader is idle, and when a word may be sent.
    let (mut idle, mut may_send) = (0, 0);
    for read in reads {
        reads_taken.push(idle);
        if read.length == 0 {
            idle += 1;
            continue;
        }
        let mut sent = may_send.max(idle + 1);
        for number in 0..header + read.length {
            if number + 1 == header + read.length {
                idle = sent + 1;
            }
            let came = sent + word;
            let mut taken = came;
            if number >= header {
                while !is_ready(taken) {
                    taken += 1;
                }
                bytes_taken.push(taken);
            }
            // After the last word the memory stays selected for a half period, and is deselected for another.
            may_send = taken.max(came + 2 * half);
            sent = taken;
        }
    }
    (reads_taken, bytes_taken)
}

fn readers() -> impl Strategy<Value = SpiFlashReader> {
    (1u32..4, any::<bool>()).prop_map(|(half_period, fast)| SpiFlashReader { half_period, fast, length: 5 })
}

fn reads() -> impl Strategy<Value = Vec<FlashRead<u64>>> {
    let near_the_end = SIZE as u64 - 3..SIZE as u64 + 3;
    let address = prop_oneof![near_the_end, 0u64..1 << 24];
    prop::collection::vec((address, 0u64..6).prop_map(|(address, length)| FlashRead { address, length }), 1..5)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn each_byte_comes_in_its_clock(
        block in readers(), reads in reads(), ready in prop::collection::vec(any::<bool>(), 1..40), is_slow: bool, seed in any::<u64>(),
    ) {
        // A slow receiver keeps its mind for more than a word.
        let stretch = if is_slow { 40 } else { 1 };
        let is_ready = |clock: u64| ready[(clock / stretch) as usize % ready.len()] || clock.is_multiple_of(501);
        let (reads_taken, bytes_taken) = clocks(&block, &reads, is_ready);
        let mut sim = Simulation::of(&block).unwrap().seeded(seed);
        sim.reset();
        let mut flash = Flash::new(memory(), block.fast);
        let (i, o) = (sim.i, sim.o);
        let (mut left, mut taken, mut seen) = (reads.iter(), Vec::new(), Vec::new());
        let mut next = left.next();
        let end = bytes_taken.iter().chain(&reads_taken).max().unwrap() + 100;
        for clock in 0..end {
            sim.set(i.reads.valid, next.is_some());
            // What is not valid means nothing.
            sim.set_record(i.reads.payload, *next.unwrap_or(&FlashRead { address: 5, length: 3 }));
            sim.set(o.bytes.ready, is_ready(clock));
            let [cs_n, sck, mosi] = [o.cs_n, o.sck, o.mosi].map(|pin| sim.get_u64(pin) == 1);
            sim.set(i.miso, flash.shows(Pins { cs_n, sck, mosi }));
            if next.is_some() && sim.get_u64(i.reads.ready) == 1 {
                taken.push(clock);
                next = left.next();
            }
            if sim.get_u64(o.bytes.valid) == 1 && is_ready(clock) {
                let [byte, last] = [o.bytes.byte, o.bytes.last].map(|port| sim.get_u64(port));
                seen.push((clock, PacketByte { byte, last }));
            }
            sim.step();
        }
        prop_assert_eq!(taken, reads_taken);
        let expected: Vec<(u64, Byte)> = bytes_taken.into_iter().zip(bytes(&reads)).collect();
        prop_assert_eq!(seen, expected);
        prop_assert_eq!(sim.get_u64(o.cs_n), 1);
    }

    /// The memory is as slow as it may be, and shows wrong bits before.
    #[test]
    fn a_slow_memory_is_read(
        block in readers(), reads in reads(), pauses in (0u64..99, 0u64..99), delay in 1u32..4, seed in any::<u64>(),
    ) {
        let block = SpiFlashReader { half_period: block.half_period + 1, ..block };
        let mut sim = Simulation::of(&block).unwrap().seeded(seed);
        sim.reset();
        let mut flash = Flash::new(memory(), block.fast);
        let expected = bytes(&reads);
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        let receiver = async {
            t.expect_all(o.bytes, expected, Pauses::percent(pauses.1, !seed)).await;
            t.expect_silence(o.bytes, 50).await;
        };
        let delay = delay.min(block.half_period - 1);
        t.run((
            t.send_all(i.reads, reads, Pauses::percent(pauses.0, seed)),
            receiver,
            monitor(t.holds(o.bytes)),
            monitor(flash.runs(t, [o.cs_n, o.sck, o.mosi, i.miso], block.half_period, delay)),
        ));
    }
}

/// The memory refuses what it does not know.
#[test]
#[should_panic(expected = "command 0x3")]
fn a_fast_memory_does_not_know_the_slow_command() {
    let mut sim = Simulation::of(&SpiFlashReader { half_period: 2, fast: false, length: 4 }).unwrap();
    sim.reset();
    let (i, o) = (sim.i, sim.o);
    let mut flash = Flash::new(memory(), true);
    let t = &sim.testbench();
    t.run((
        t.send(i.reads, FlashRead { address: 0, length: 1 }),
        t.receive(o.bytes),
        monitor(flash.runs(t, [o.cs_n, o.sck, o.mosi, i.miso], 2, 1)),
    ));
}
