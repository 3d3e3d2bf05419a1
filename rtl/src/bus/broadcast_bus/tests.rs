//! The broadcast bus clock by clock: by example, and in [`model`] against a plain software model.

mod model;

use tilewright_sim::{Pauses, Simulation};

use super::*;

type Sim = Simulation<BroadcastBusIn, BroadcastBusOut>;
type Words = Vec<BusWord<u64>>;

fn bus(processors: u32, queue: u32, word_clocks: u32) -> Sim {
    let mut sim = Simulation::at(&BroadcastBus { processors, queue, word_clocks }, PE.period).unwrap().seeded(7);
    sim.reset();
    sim
}

/// A packet of these words.
fn packet(words: &[u64]) -> Words {
    let last = words.len() - 1;
    (0..).zip(words).map(|(place, word)| BusWord { word: *word, last: u64::from(place == last) }).collect()
}

/// Sends each sender's packets while all processors receive, until each has received `words` words; returns what each
/// received.
fn broadcast(sim: &mut Sim, packets: Vec<Vec<Words>>, pauses: impl Fn(usize) -> Pauses) -> Vec<Words> {
    let (senders, received) = (sim.i.senders.clone(), sim.o.received.clone());
    let count = packets.iter().flatten().map(Vec::len).sum();
    let t = sim.testbench();
    t.limit(10_000);
    let sends =
        senders.iter().zip(packets).map(|(stream, packets)| t.send_all(*stream, packets.concat(), Pauses::NONE));
    let receives = received.iter().enumerate().map(|(number, stream)| t.receive_all(*stream, count, pauses(number)));
    let (_, words) = t.run((t.all(sends), t.all(receives)));
    words
}

#[test]
fn packets_clock_by_clock() {
    let mut sim = bus(2, 2, 3);
    let wave = sim.record([
        "senders_0_valid",
        "senders_0_ready",
        "senders_1_valid",
        "senders_1_ready",
        "senders_2_valid",
        "senders_2_ready",
        "open",
        "sender",
        "on_bus",
        "clocks_left",
        "word_word",
        "idle",
        "received_1_valid",
        "received_1_word",
        "received_1_last",
        "empty[1]",
    ]);
    let packets = vec![vec![packet(&[0xa0, 0xa1])], vec![packet(&[0xb0])], vec![packet(&[0xc0])]];
    broadcast(&mut sim, packets, |_| Pauses::NONE);
    wave.expect(
        r"
        clk              |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        senders_0_valid  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\____________________________________________
        senders_0_ready  |~~~~~~~~~~\_____________________/~~~~~~~~~~\____________________________________________
        senders_1_valid  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\___________
        senders_1_ready  |_________________________________________________________________/~~~~~~~~~~\___________
        senders_2_valid  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        senders_2_ready  |________________________________________________________________________________________
        open             |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\____________________________________________
        sender           | 2        | 0                                                               | 1        |
        on_bus           |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        clocks_left      | 1        | 2        | 1        | 0        | 2        | 1        | 0        | 2        |
        word_word        | 9aab79dd | a0                             | a1                             | b0       |
        idle             |~~~~~~~~~~\_____________________________________________________________________________
        received_1_valid |___________________________________________/~~~~~~~~~~\_____________________/~~~~~~~~~~~
        received_1_word  | f5c6f844                                  | a0       | 3d26c1              | a1       |
        received_1_last  |____________________________________________________________________________/~~~~~~~~~~~
        empty[1]         |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\__________/~~~~~~~~~~~~~~~~~~~~~\___________

        clk              |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        senders_0_valid  |__________________________________________________________________
        senders_0_ready  |__________________________________________________________________
        senders_1_valid  |__________________________________________________________________
        senders_1_ready  |__________________________________________________________________
        senders_2_valid  |~~~~~~~~~~~~~~~~~~~~~\____________________________________________
        senders_2_ready  |__________/~~~~~~~~~~\____________________________________________
        open             |__________________________________________________________________
        sender           | 1                   | 2                                         |
        on_bus           |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\___________
        clocks_left      | 1        | 0        | 2        | 1        | 0                   |
        word_word        | b0                  | c0                                        |
        idle             |______________________________________________________/~~~~~~~~~~~
        received_1_valid |_____________________/~~~~~~~~~~\_____________________/~~~~~~~~~~~
        received_1_word  | 3d26c1              | b0       | 3d26c1              | c0       |
        received_1_last  |_____________________/~~~~~~~~~~\_____________________/~~~~~~~~~~~
        empty[1]         |~~~~~~~~~~~~~~~~~~~~~\__________/~~~~~~~~~~~~~~~~~~~~~\___________
        ",
    );
}

#[test]
fn a_full_queue_holds_the_bus_for_all() {
    let mut sim = bus(2, 2, 1);
    let wave = sim.record([
        "senders_2_valid",
        "senders_2_word",
        "senders_2_ready",
        "on_bus",
        "word_word",
        "room",
        "received_0_valid",
        "received_0_word",
        "received_1_ready",
        "received_1_word",
    ]);
    let (senders, received) = (sim.i.senders.clone(), sim.o.received.clone());
    let t = sim.testbench();
    t.limit(100);
    let sends = t.send_all(senders[2], packet(&[1, 2, 3, 4]), Pauses::NONE);
    let at_once = t.receive_all(received[0], 4, Pauses::NONE);
    let late = async {
        t.wait(5).await;
        t.receive_all(received[1], 4, Pauses::NONE).await
    };
    let ((), at_once, late) = t.run((sends, at_once, late));
    assert_eq!((&at_once, &late), (&packet(&[1, 2, 3, 4]), &packet(&[1, 2, 3, 4])));
    wave.expect(
        r"
        clk              |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        senders_2_valid  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\___________
        senders_2_word   | 1        | 2        | 3        | 4                                         | 0        |
        senders_2_ready  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\________________________________/~~~~~~~~~~\___________
        on_bus           |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        word_word        | 9aab79dd | 1        | 2        | 3                                         | 4        |
        room             |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\________________________________/~~~~~~~~~~~~~~~~~~~~~~
        received_0_valid |_____________________/~~~~~~~~~~~~~~~~~~~~~\________________________________/~~~~~~~~~~~
        received_0_word  | 4091816c            | 1        | 2        | 4276117c                       | 3        |
        received_1_ready |______________________________________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        received_1_word  | f5c6f844            | 1                                         | 2        | 3        |

        clk              |~~~~~\____/
        senders_2_valid  |___________
        senders_2_word   | 0        |
        senders_2_ready  |___________
        on_bus           |___________
        word_word        | 4        |
        room             |~~~~~~~~~~~
        received_0_valid |~~~~~~~~~~~
        received_0_word  | 4        |
        received_1_ready |~~~~~~~~~~~
        received_1_word  | 4        |
        ",
    );
}

/// 26.7 Mbyte/s (VC1-NET), from a processor and from the host.
#[test]
fn a_word_takes_6_clocks() {
    for sender in [3, 16] {
        let mut sim = Simulation::at(&BroadcastBus::vc1(16), PE.period).unwrap();
        sim.reset();
        let (start, words) = (sim.time(), 1000);
        let mut packets = vec![Vec::new(); 17];
        packets[sender] = vec![packet(&(0..words).collect::<Vec<_>>())];
        let received = broadcast(&mut sim, packets.clone(), |_| Pauses::NONE);
        assert!(received.iter().all(|words| *words == packets[sender][0]));
        // The last word is also on the bus for 6 clocks; the clock after them shows it and receives it.
        let clocks = (sim.time() - start) / PE.period.picoseconds();
        assert_eq!(clocks, 1 + 6 * words + 1);
        let megabytes_a_second = (4_000_000 * words) as f64 / ((clocks - 2) * PE.period.picoseconds()) as f64;
        assert_eq!(format!("{megabytes_a_second:.1}"), "26.7");
    }
}

/// All senders send at once. The queues are so small that every word stalls the bus, and one processor is slow.
#[test]
fn all_get_the_packets_of_all_by_turns() {
    let mut sim = bus(3, 2, 1);
    let packets_of = |sender: u64| (0..9).map(|number| packet(&[sender, number])).collect::<Vec<_>>();
    let received = broadcast(&mut sim, (0..4).map(packets_of).collect(), |processor| match processor {
        1 => Pauses::percent(80, 1),
        _ => Pauses::NONE,
    });
    let turns: Words = (0..9).flat_map(|number| (0..4).flat_map(move |sender| packet(&[sender, number]))).collect();
    assert!(received.iter().all(|words| *words == turns));
    assert!(sim.covered("a full queue stalls the bus").unwrap() > 30);
    assert!(sim.covered("all senders wait").unwrap() > 30);
    assert_eq!(sim.covered("a packet follows another without a pause").unwrap(), 35);
}

#[test]
fn what_is_out_of_range_is_refused_in_a_sentence() {
    let bus = BroadcastBus { processors: 2, queue: 2, word_clocks: 1 };
    let problem = |bus: BroadcastBus| bus.checked().unwrap_err().to_string();
    let sentence = "`processors` of `BroadcastBus` is 0: it has to be from 1 to 256";
    assert_eq!(problem(BroadcastBus { processors: 0, ..bus.clone() }), sentence);
    let sentence = "`processors` of `BroadcastBus` is 257: it has to be from 1 to 256";
    assert_eq!(problem(BroadcastBus { processors: 257, ..bus.clone() }), sentence);
    let sentence = "`queue` of `BroadcastBus` is 1: it has to be at least 2";
    assert_eq!(problem(BroadcastBus { queue: 1, ..bus.clone() }), sentence);
    let sentence = "`word_clocks` of `BroadcastBus` is 0: it has to be at least 1";
    assert_eq!(problem(BroadcastBus { word_clocks: 0, ..bus }), sentence);
}
