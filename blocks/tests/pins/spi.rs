//! A master of SPI, against a slave that is a program.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_hdl::Stream;
use tilewright_sim::{Pauses, Port, Simulation, Testbench, monitor};

type Master = Simulation<SpiMasterIn, SpiMasterOut>;

/// What a slave saw: the words of each time that it was selected.
type Frames = Vec<Vec<u64>>;

/// A slave, as the four modes define it. It answers a clock after what it sees.
struct Slave {
    block: SpiMaster,
    sck: Port,
    mosi: Port,
    miso: Port,
    cs_n: Port,
}

impl Slave {
    fn of(sim: &Master, block: &SpiMaster) -> Slave {
        Slave { block: block.clone(), sck: sim.o.sck, mosi: sim.o.mosi, miso: sim.i.miso, cs_n: sim.o.cs_n }
    }

    /// Sends the replies, and adds what it sees to `frames`.
    ///
    /// # Panics
    ///
    /// An edge comes less than half a period after another, `sck` does not rest at its level, or a word is cut off.
    async fn runs(&self, t: &Testbench<'_>, replies: &[u64], frames: &mut Frames) {
        let SpiMaster { width, half_period, mode } = self.block;
        let (rest, samples_late) = (u64::from(mode >> 1), mode & 1 == 1);
        let (mut sck_was, mut deselected, mut since, mut bits, mut word) = (rest, 1, half_period, 0, 0);
        let reply = |bits: u32| {
            let word = replies.get((bits / width) as usize).copied().unwrap_or(0);
            t.set(self.miso, word >> (width - 1 - bits % width) & 1);
        };
        loop {
            t.step().await;
            let [sck, mosi, cs_n] = [self.sck, self.mosi, self.cs_n].map(|pin| t.get_u64(pin));
            since += 1;
            if cs_n != deselected {
                assert!(since >= half_period && sck == rest && sck_was == rest, "at {} ps", t.time());
                (deselected, since) = (cs_n, 0);
                match cs_n {
                    0 => frames.push(Vec::new()),
                    _ => assert_eq!(bits % width, 0, "a word is cut off at {} ps", t.time()),
                }
                if cs_n == 0 && !samples_late {
                    reply(bits);
                }
            } else if sck != sck_was {
                assert!(cs_n == 0 && since >= half_period, "an edge of `sck` at {} ps", t.time());
                since = 0;
                if (sck == rest) != samples_late {
                    reply(bits);
                } else {
                    word = word << 1 | mosi;
                    bits += 1;
                    if bits % width == 0 {
                        frames.last_mut().expect("it is selected").push(word);
                        word = 0;
                    }
                }
            }
            sck_was = sck;
        }
    }
}

#[test]
fn two_words_in_mode_0() {
    let block = SpiMaster { width: 2, half_period: 1, mode: 0 };
    let mut sim = Simulation::of(&block).unwrap();
    sim.reset();
    let names =
        ["send_valid", "send_word", "send_ready", "cs_n", "sck", "mosi", "miso", "received_valid", "received_payload"];
    let wave = sim.record(names);
    sim.set(sim.o.received.ready, 1);
    let word = |valid, word, last| Stream::of(valid, SpiWord { word, last });
    for clock in 0..15 {
        let send = match clock {
            0 => word(1, 0b10, 0),
            1..6 => word(1, 0b01, 1),
            _ => word(0, 0, 0),
        };
        // `sck` rises after clocks 1, 3, 6 and 8.
        sim.drive(SpiMasterIn { send, miso: [3, 6, 8].contains(&clock).into() });
        sim.step();
    }
    wave.expect(
        r"
        clk              |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        send_valid       |~~~~~~~~~~~~~~~~~~~~~~~\____________________________________
        send_word        | 2 | 1                 | 0                                 |
        send_ready       |~~~\_______________/~~~\_______________________/~~~~~~~~~~~~
        cs_n             |~~~\_______________________________________/~~~~~~~~~~~~~~~~
        sck              |_______/~~~\___/~~~\_______/~~~\___/~~~\____________________
        mosi             |___/~~~~~~~\___________________/~~~~~~~\____________________
        miso             |___________/~~~\_______/~~~\___/~~~\________________________
        received_valid   |___________________/~~~\_______________/~~~\________________
        received_payload | 0             | 1         | 3                             |",
    );
}

/// With half a period of a clock there is no time for a program: the slave is a wire.
#[test]
fn every_mode_samples_what_is_stable() {
    for mode in 0..4 {
        let mut sim = Simulation::of(&SpiMaster { width: 5, half_period: 1, mode }).unwrap().seeded(mode.into());
        sim.reset();
        sim.set(sim.o.received.ready, 1);
        sim.set(sim.i.send.valid, 1);
        sim.set(sim.i.send.last, 0);
        let mut received = Vec::new();
        for word in [0b10110, 0b01001, 0b11111, 0b00000, 0b10101] {
            sim.set(sim.i.send.word, word);
            // 10 edges, and a clock between two words.
            for clock in 0..11 {
                let is_first = clock == 0;
                assert_eq!(
                    sim.get_u64(sim.i.send.ready),
                    u64::from(is_first),
                    "mode {mode}, clock {clock} of {word:b}"
                );
                if sim.get_u64(sim.o.received.valid) == 1 {
                    received.push(sim.get_u64(sim.o.received.payload));
                }
                let mosi = sim.get_u64(sim.o.mosi);
                sim.set(sim.i.miso, mosi);
                sim.step();
            }
        }
        assert_eq!(received, [0b10110, 0b01001, 0b11111, 0b00000], "mode {mode}");
    }
}

#[test]
fn a_word_waits_until_the_one_received_before_it_is_taken() {
    let mut sim = Simulation::of(&SpiMaster { width: 4, half_period: 1, mode: 0 }).unwrap();
    sim.reset();
    sim.set(sim.i.send.valid, 1);
    sim.set(sim.i.miso, 1);
    sim.run(9);
    sim.set(sim.i.miso, 0);
    for clock in 0..20 {
        let seen = [sim.i.send.ready, sim.o.received.valid, sim.o.received.payload].map(|port| sim.get_u64(port));
        assert_eq!(seen, [0, 1, 0b1111], "clock {clock}");
        sim.step();
    }
    sim.set(sim.o.received.ready, 1);
    assert_eq!(sim.get_u64(sim.i.send.ready), 1);
}

/// A block, the words of each frame, and as many replies.
fn exchanges() -> impl Strategy<Value = (SpiMaster, Frames, Vec<u64>)> {
    (2u32..17, 2u32..5, 0u32..4).prop_flat_map(|(width, half_period, mode)| {
        let frame = prop::collection::vec(0..1u64 << width, 1..4);
        let replies = prop::collection::vec(0..1u64 << width, 12);
        (Just(SpiMaster { width, half_period, mode }), prop::collection::vec(frame, 1..4), replies)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_slave_and_its_master_exchange_words(
        (block, frames, mut replies) in exchanges(), pauses in (0u64..95, 0u64..95), seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&block).unwrap().seeded(seed);
        sim.reset();
        replies.truncate(frames.iter().map(Vec::len).sum());
        let words = frames.iter().flat_map(|frame| {
            frame.iter().enumerate().map(|(place, &word)| SpiWord { word, last: u64::from(place + 1 == frame.len()) })
        });
        let (slave, mut seen) = (Slave::of(&sim, &block), Frames::new());
        let (send, received) = (sim.i.send, sim.o.received);
        let t = &sim.testbench();
        t.limit(40_000);
        let receiver = async {
            t.expect_all(received, replies.clone(), Pauses::percent(pauses.1, seed)).await;
            t.expect_silence(received, 20).await;
        };
        t.run((
            t.send_all(send, words.collect::<Vec<_>>(), Pauses::percent(pauses.0, !seed)),
            receiver,
            monitor(t.holds(received)),
            monitor(slave.runs(t, &replies, &mut seen)),
        ));
        prop_assert_eq!(seen, frames);
    }
}

#[test]
fn a_mode_that_is_none() {
    let problem = tilewright_hdl::elaborate(&SpiMaster { width: 8, half_period: 1, mode: 4 }).unwrap_err().to_string();
    assert!(problem.starts_with("`mode` of `SpiMaster` is 4: it has to be from 0 to 3"), "{problem}");
}
