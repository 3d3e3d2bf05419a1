//! Random packets, pauses and sizes, checked clock by clock against a software model with queues and round robin.

use std::collections::VecDeque;

use proptest::prelude::*;

use super::*;

/// The bus by its rules.
struct Plain {
    bus: BroadcastBus,
    on_bus: Option<(BusWord<u64>, u32)>,
    /// The sender of the last word.
    sender: usize,
    open: bool,
    queues: Vec<VecDeque<BusWord<u64>>>,
    covers: [u64; COVERS.len()],
}

/// The covers of the bus.
const COVERS: [&str; 5] = [
    "a full queue stalls the bus",
    "a sender pauses within its packet",
    "a sender waits for the packet of another",
    "all senders wait",
    "a packet follows another without a pause",
];

impl Plain {
    fn new(bus: &BroadcastBus) -> Plain {
        let processors = bus.processors as usize;
        let queues = vec![VecDeque::new(); processors];
        Plain { bus: bus.clone(), on_bus: None, sender: processors, open: false, queues, covers: [0; COVERS.len()] }
    }

    fn idle(&self) -> bool {
        self.on_bus.is_none() && !self.open
    }

    /// One edge: picks the sender whose word is taken, among those that offer one.
    fn clock(&mut self, offered: &[Option<BusWord<u64>>], ready: &[bool]) -> Option<usize> {
        let room = self.queues.iter().all(|queue| queue.len() < self.bus.queue as usize);
        let arrived = self.on_bus.filter(|(_, clocks_left)| *clocks_left == 0);
        let delivered = arrived.filter(|_| room);
        for (queue, ready) in self.queues.iter_mut().zip(ready) {
            queue.pop_front().filter(|_| !ready).into_iter().for_each(|word| queue.push_front(word));
            queue.extend(delivered.map(|(word, _)| word));
        }
        self.on_bus = match self.on_bus {
            Some(_) if delivered.is_some() => None,
            still => still.map(|(word, clocks_left)| (word, clocks_left.saturating_sub(1))),
        };
        let turns: Vec<usize> = match self.open {
            true => vec![self.sender],
            false => (1..=offered.len()).map(|behind| (self.sender + behind) % offered.len()).collect(),
        };
        let taken = turns.into_iter().filter(|_| self.on_bus.is_none()).find(|sender| offered[*sender].is_some());
        let others = (0..).zip(offered).filter(|(sender, _)| *sender != self.sender);
        let happens = [
            arrived.is_some() && !room,
            self.open && self.on_bus.is_none() && taken.is_none(),
            self.open && others.into_iter().any(|(_, word)| word.is_some()),
            !self.open && self.on_bus.is_some() && offered.iter().all(Option::is_some),
            !self.open && delivered.is_some() && taken.is_some(),
        ];
        for (count, happens) in self.covers.iter_mut().zip(happens) {
            *count += u64::from(happens);
        }
        if let Some(sender) = taken {
            let word = offered[sender].expect("it has one");
            (self.on_bus, self.sender, self.open) = (Some((word, self.bus.word_clocks - 1)), sender, word.last == 0);
        }
        taken
    }
}

/// How often each sender and each processor pauses, in percent.
fn pauses(count: usize) -> impl Strategy<Value = Vec<u64>> {
    prop::collection::vec(prop_oneof![Just(0), 0..50u64, Just(90)], count)
}

/// The packet lengths of each sender.
fn lengths(senders: usize) -> impl Strategy<Value = Vec<Vec<usize>>> {
    prop::collection::vec(prop::collection::vec(1..5_usize, 0..6), senders)
}

fn case() -> impl Strategy<Value = (BroadcastBus, Vec<Vec<usize>>, Vec<u64>, u64)> {
    let sizes = (1..5u32, 2..6u32, 1..5u32);
    let bus = sizes.prop_map(|(processors, queue, word_clocks)| BroadcastBus { processors, queue, word_clocks });
    bus.prop_flat_map(|bus| {
        let processors = bus.processors as usize;
        (Just(bus), lengths(processors + 1), pauses(2 * processors + 1), any::<u64>())
    })
}

/// A word that encodes its sender, its packet and its position in the packet.
fn words(sender: usize, lengths: &[usize]) -> Vec<BusWord<u64>> {
    let packet = |(number, length): (usize, &usize)| {
        let words: Vec<u64> = (0..*length).map(|place| (sender << 24 | number << 12 | place) as u64).collect();
        super::packet(&words)
    };
    lengths.iter().enumerate().flat_map(packet).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Every output in every clock equals the model's, and so does the coverage. Each processor receives every packet,
    /// and each packet whole.
    #[test]
    fn packets_go_to_all_as_in_the_model((bus, lengths, pauses, seed) in case()) {
        let (processors, senders) = (bus.processors as usize, bus.processors as usize + 1);
        let mut sim = Simulation::at(&bus, PE.period).unwrap().seeded(seed);
        sim.reset();
        let mut plain = Plain::new(&bus);
        let mut pauses: Vec<Pauses> =
            (seed..).zip(&pauses).map(|(seed, percent)| Pauses::percent(*percent, seed)).collect();
        let mut left: Vec<VecDeque<BusWord<u64>>> =
            lengths.iter().enumerate().map(|(sender, lengths)| words(sender, lengths).into()).collect();
        let total: usize = left.iter().map(VecDeque::len).sum();
        let mut until_shown: Vec<u32> = pauses[..senders].iter_mut().map(Pauses::next_length).collect();
        let mut received = vec![Vec::new(); processors];
        for clock in 0.. {
            prop_assert!(clock < 20_000, "the packets have no end");
            let offered: Vec<Option<BusWord<u64>>> =
                left.iter().zip(&until_shown).map(|(words, pause)| words.front().copied().filter(|_| *pause == 0)).collect();
            let ready: Vec<bool> = pauses[senders..].iter_mut().map(|pauses| pauses.next_length() == 0).collect();

            let none = BusWord { word: 0, last: 0 };
            let stream = |word: &Option<BusWord<u64>>| Stream::of(word.is_some().into(), word.unwrap_or(none));
            sim.drive(BroadcastBusIn { senders: offered.iter().map(stream).collect() });
            for (number, ready) in ready.iter().enumerate() {
                sim.set(sim.o.received[number].ready, *ready);
            }
            let out = sim.read_u64();
            let shown: Vec<Option<BusWord<u64>>> =
                out.received.iter().map(|stream| (stream.valid == 1).then_some(stream.payload)).collect();
            let fronts: Vec<Option<BusWord<u64>>> = plain.queues.iter().map(|queue| queue.front().copied()).collect();
            prop_assert_eq!(&shown, &fronts);
            let empty: Vec<bool> = (0..processors).map(|number| out.empty >> number & 1 == 1).collect();
            prop_assert_eq!(&empty, &fronts.iter().map(Option::is_none).collect::<Vec<_>>());
            prop_assert_eq!(out.idle == 1, plain.idle());

            for (words, shown) in received.iter_mut().zip(&shown).zip(&ready).filter_map(|(it, ready)| ready.then_some(it)) {
                words.extend(*shown);
            }
            let taken = plain.clock(&offered, &ready);
            let answers: Vec<bool> = (0..senders).map(|number| sim.get_u64(sim.i.senders[number].ready) == 1).collect();
            prop_assert_eq!(answers, (0..senders).map(|number| taken == Some(number)).collect::<Vec<_>>());
            sim.step();
            for (sender, pause) in until_shown.iter_mut().enumerate() {
                if taken == Some(sender) {
                    left[sender].pop_front();
                    *pause = pauses[sender].next_length();
                } else {
                    *pause = pause.saturating_sub(1);
                }
            }
            if received.iter().all(|words| words.len() == total) && plain.idle() {
                break;
            }
        }
        prop_assert_eq!(COVERS.map(|name| sim.covered(name).unwrap()), plain.covers);
        for words in &received {
            prop_assert_eq!(words, &received[0]);
        }
        let packets: Vec<&[BusWord<u64>]> = received[0].split_inclusive(|word| word.last == 1).collect();
        for (sender, lengths) in lengths.iter().enumerate() {
            let own: Vec<BusWord<u64>> =
                packets.iter().filter(|packet| packet[0].word >> 24 == sender as u64).copied().flatten().copied().collect();
            prop_assert_eq!(own, self::words(sender, lengths));
        }
    }
}
