//! Several masters on a bus.

use super::i2c_pins::devices::{Bus, Eeprom, Stretching};
use super::rules::Rules;
use super::*;
use I2cCommand as Do;
use tilewright_hdl::*;
use tilewright_sim::{Pauses, Testbench, monitor};

/// Another master: device 1 of a bus, with clocks of its own.
struct Other {
    low: u64,
    high: u64,
}

impl Other {
    /// Sends a START at once, bytes, and a STOP; the bit at which it has lost the bus.
    async fn sends(&self, bus: &Bus<'_, '_>, bytes: &[u64]) -> Option<usize> {
        bus.pull_sda(1, true);
        self.is_high(bus).await;
        bus.pull_scl(1, true);
        let bits = bytes.iter().flat_map(|byte| (0..9).rev().map(move |place| (byte << 1 | 1) >> place & 1 == 1));
        for (number, bit) in bits.enumerate() {
            let seen = self.exchanges(bus, bit).await;
            if number % 9 != 8 && bit && !seen {
                return Some(number);
            }
            bus.pull_scl(1, true);
        }
        self.exchanges(bus, false).await;
        bus.pull_sda(1, false);
        None
    }

    /// The low and the high period of a bit; what SDA was before SCL fell.
    async fn exchanges(&self, bus: &Bus<'_, '_>, bit: bool) -> bool {
        bus.t.wait(self.low / 2).await;
        bus.pull_sda(1, !bit);
        bus.t.wait(self.low - self.low / 2).await;
        bus.pull_scl(1, false);
        bus.t.step().await;
        while !bus.levels().0 {
            bus.t.step().await;
        }
        self.is_high(bus).await
    }

    /// The high period, which another master may end; what SDA was in it.
    async fn is_high(&self, bus: &Bus<'_, '_>) -> bool {
        let mut seen = bus.levels().1;
        for _ in 0..self.high {
            bus.t.step().await;
            let (scl, sda) = bus.levels();
            if !scl {
                break;
            }
            seen = sda;
        }
        seen
    }

    /// Until the bus was free for `low` clocks.
    async fn waits(&self, bus: &Bus<'_, '_>) {
        let (mut clocks, mut was, mut is_free) = (0, bus.levels(), false);
        while !is_free || clocks < self.low {
            bus.t.step().await;
            let now = bus.levels();
            is_free = (is_free || was == (true, false)) && now == (true, true);
            clocks = if is_free { clocks + 1 } else { 0 };
            was = now;
        }
    }
}

/// Sends a program until it was not lost, a command after each answer; how often it was lost.
async fn until_done(
    t: &Testbench<'_>,
    i: Stream<Do<Port>, Port>,
    o: Stream<I2cAnswer<Port>, Port>,
    program: &[Do<u64>],
) -> u32 {
    for lost in 0.. {
        let mut results = Vec::new();
        for command in program {
            t.send(i, *command).await;
            results.push(t.receive(o).await.result);
        }
        assert!(!results.contains(&NACK), "{results:?}");
        if !results.contains(&LOST) {
            return lost;
        }
    }
    unreachable!("it is sent for ever")
}

const MASTER: I2cMaster = I2cMaster { low: 8, high: 6, filter: 1 };

/// A bit as it differs in two transfers: its number, and whether the first has it high.
fn difference(ours: &[u64], others: &[u64]) -> Option<(usize, bool)> {
    let place = ours.iter().zip(others).position(|(our, other)| our != other)?;
    let bit = (ours[place] ^ others[place]).leading_zeros() as usize - 56;
    Some((9 * place + bit, ours[place] >> (7 - bit) & 1 == 1))
}

/// Both masters begin at nearly the same time, and one of them is slower.
#[test]
fn the_lower_bit_wins() {
    let cases = [
        ([0xa0, 3, 0x77], [0xa0, 5, 0x88]), // ours is lower at bit 2 of the second byte
        ([0xa0, 5, 0x77], [0xa0, 3, 0x88]),
        ([0xa0, 3, 0x81], [0xa0, 3, 0x80]), // the last bit decides
        ([0xa0, 3, 0x80], [0xa0, 3, 0x81]),
        ([0xa0, 3, 0x55], [0xa0, 3, 0x55]), // nobody notices
        ([0xa0, 4, 0x01], [0x20, 4, 0xff]), // the first bit decides, and nobody has the other address
    ];
    for (number, (ours, others)) in cases.into_iter().enumerate() {
        for ((low, high), later) in [(8, 6), (17, 4), (9, 11)].into_iter().zip([0, 2, 5]) {
            let mut sim = started(&MASTER, number as u64);
            let mut eeprom = Eeprom::new(0x50, vec![0; 16]);
            let (other, mut stops) = (Other { low, high }, 0);
            let (i, o, lines) = (sim.i, sim.o, lines(&sim));
            let t = &sim.testbench();
            t.limit(20_000);
            let bus = &Bus::new(t, lines);
            let program: Vec<_> = [Do::START].into_iter().chain(ours.map(Do::write)).chain([Do::STOP]).collect();
            let lost = difference(&ours, &others);
            let is_lost = lost.is_some_and(|(_, ours_is_high)| ours_is_high);
            // A program is sent ahead; it is sent again if it was lost.
            let sends = async {
                for _ in 0..=u32::from(is_lost) {
                    t.send_all(i.commands, program.clone(), Pauses::NONE).await;
                }
            };
            let rival = async {
                t.wait(later).await;
                let first = other.sends(bus, &others).await;
                if first.is_some() {
                    other.waits(bus).await;
                    assert_eq!(other.sends(bus, &others).await, None);
                }
                t.wait(1).await; // until its STOP is seen
                first
            };
            let rules = Rules { low: 8, high: high.min(6), setup: 3 };
            let (_, answers, rival_lost, ..) = t.run((
                sends,
                t.receive_all(o.answers, 5 * (1 + usize::from(is_lost)), Pauses::NONE),
                rival,
                bus.scl(),
                bus.sda(),
                monitor(eeprom.runs(bus, Stretching::new(30, 30, 1))),
                monitor(rules.watches(bus, &mut stops)),
            ));
            let case = format!("{ours:x?} and {others:x?}, low {low}, high {high}, {later} clocks later");
            let results: Vec<u64> = answers.iter().map(|answer| answer.result).collect();
            let done = [DONE; 5];
            match lost {
                Some((bit, true)) => {
                    let mut first = done;
                    first[1 + bit / 9..].fill(LOST);
                    assert_eq!((results, rival_lost), ([first, done].concat(), None), "{case}");
                }
                Some((bit, false)) => assert_eq!((results, rival_lost), (done.to_vec(), Some(bit)), "{case}"),
                None => assert_eq!((results, rival_lost), (done.to_vec(), None), "{case}"),
            }
            let mut memory = vec![0; 16];
            let (winner, loser) = if is_lost { (others, ours) } else { (ours, others) };
            for [address, pointer, byte] in [winner, loser] {
                if address == 0xa0 {
                    memory[pointer as usize] = byte;
                }
            }
            assert_eq!(eeprom.memory, memory, "{case}");
            assert_eq!(stops, if lost.is_some() { 2 } else { 1 }, "{case}");
        }
    }
}

block! {
    /// Two masters at the pins of a chip.
    struct Two { masters: [I2cMaster; 2] }
    name = "two_masters";
    in TwoIn { commands: [stream(I2cCommand); 2], scl: Outside::widths(1), sda: Outside::widths(1) }
    out TwoOut { answers: [stream(I2cAnswer); 2], scl_line: bit(), sda_line: bit() }
}

impl Two {
    fn build(&self, m: Module, i: TwoIn) -> TwoOut {
        def!(scl_line = m.wire(bit()));
        def!(sda_line = m.wire(bit()));
        let [first, second] = [0, 1].map(|number| {
            let into = I2cMasterIn { commands: i.commands[number], scl: *scl_line, sda: *sda_line };
            m.instance(&format!("u_master{number}"), &self.masters[number], into)
        });
        let pad = Pad::new(1).pull_up();
        def!(scl = m.instance(&pad, PadIn::open_drain(first.scl_low | second.scl_low, i.scl)));
        def!(sda = m.instance(&pad, PadIn::open_drain(first.sda_low | second.sda_low, i.sda)));
        scl_line.drive(scl.line);
        sda_line.drive(sda.line);
        m.ignore(&[first.busy, second.busy]);
        TwoOut { answers: vec![first.answers, second.answers], scl_line: *scl_line, sda_line: *sda_line }
    }
}

/// Both write to one memory, and repeat what they have lost.
#[test]
fn two_masters_share_a_bus() {
    let masters = [MASTER, I2cMaster { low: 11, high: 3, filter: 2 }];
    let mut sim = Simulation::of(&Two { masters }).unwrap().seeded(3);
    sim.reset();
    let mut eeprom = Eeprom::new(0x50, vec![0; 16]);
    let (i, o) = (sim.i.clone(), sim.o.clone());
    let lines = [i.scl.drives, i.sda.drives, o.scl_line, o.sda_line];
    let t = &sim.testbench();
    t.limit(200_000);
    let bus = &Bus::new(t, lines);
    let mut stops = 0;
    let writes = |number: usize| {
        let (commands, answers) = (i.commands[number], o.answers[number]);
        async move {
            let (mut lost, mut pauses) = (0, Pauses::percent(95, 5 + number as u64));
            for place in 0..8 {
                let place = 2 * place + number as u64;
                let program = [Do::START, Do::write(0xa0), Do::write(place), Do::write(0xf0 | place), Do::STOP];
                lost += until_done(t, commands, answers, &program).await;
                t.wait(u64::from(pauses.next_length())).await;
            }
            lost
        }
    };
    let (first, second, ..) = t.run((
        writes(0),
        writes(1),
        bus.scl(),
        bus.sda(),
        monitor(eeprom.runs(bus, Stretching::new(10, 20, 1))),
        monitor(Rules { low: 8, high: 3, setup: 3 }.watches(bus, &mut stops)),
    ));
    assert_eq!(eeprom.memory, (0xf0..=0xff).collect::<Vec<u64>>());
    assert_eq!(stops, 16);
    assert!(first > 0 && second > 0, "{first} and {second} were lost");
}
