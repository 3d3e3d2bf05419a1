//! Packets of all senders on a whole machine. The sync line is low until all of them have been received.

use super::*;

/// Whether the field of `bits` bits from bit `lowest` on is below a limit.
fn is_less(choice: u64, lowest: u32, bits: u32, than: u64) -> bool {
    choice >> lowest & ((1 << bits) - 1) < than
}

/// A word that encodes its sender, packet and position.
fn word(sender: usize, packet: u64, place: u64) -> u64 {
    (sender as u64) << 24 | packet << 8 | place
}

/// The number of words of a packet.
fn words(packet: u64) -> u64 {
    1 + packet % 3
}

/// What a processor has received: whole packets, and those of each sender in sequence.
#[derive(Default)]
struct Received {
    packets: [u64; 3],
    /// The sender of the incomplete packet, and the number of its words received so far.
    under_way: Option<(usize, u64)>,
}

impl Received {
    fn take(&mut self, value: u64, last: u64) {
        let (sender, place) = self.under_way.unwrap_or(((value >> 24) as usize, 0));
        let packet = self.packets[sender];
        assert_eq!(value, word(sender, packet, place));
        assert_eq!(last == 1, place + 1 == words(packet));
        self.under_way = Some((sender, place + 1)).filter(|_| last == 0);
        self.packets[sender] += last;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4, failure_persistence: None, ..ProptestConfig::default() })]

    /// Two processors draw, assert `done`, send and receive at any time, but never end the frame. The host sends, too
    /// (VC1-NET, VC1-SW1).
    #[test]
    fn packets_of_all_come_to_all_and_hold_the_line_low(choices in prop::collection::vec(any::<u64>(), 3000)) {
        let mut sim = running(&vc1(SMALL, 4, 8, 2), 7);
        let (ports, seen) = (sim.i.processors.clone(), sim.o.processors.clone());
        let senders = [ports[0].sends, ports[1].sends, sim.i.command];
        let t = sim.testbench();
        let pe = t.on(PE);
        t.run((t.all(ports.iter().map(|i| clear(&pe, *i, 8))),));
        drop(t);

        // For each sender, the packet and the position of its next word.
        let mut sent = [(0, 0); 3];
        let mut received: [Received; 2] = Default::default();
        let mut held_low = 0;
        for (clock, choice) in choices.into_iter().enumerate() {
            let is_calm = clock % 200 < 100;
            for ((sender, port), lowest) in senders.iter().enumerate().zip([0, 6, 12]) {
                let (packet, place) = sent[sender];
                sim.set(port.valid, is_less(choice, lowest, 6, if is_calm { 1 } else { 12 }));
                sim.set(port.word, word(sender, packet, place));
                sim.set(port.last, place + 1 == words(packet));
            }
            for ((i, o), lowest) in ports.iter().zip(&seen).zip([18, 36]) {
                sim.set(i.done, is_less(choice, lowest, 3, 6));
                sim.set(i.request.valid, is_less(choice, lowest + 3, 5, 1));
                sim.set(i.request.x, choice >> (lowest + 8) & 15);
                sim.set(o.received.ready, is_less(choice, lowest + 12, 2, 1));
            }
            // The frame never ends: the host keeps the line low when no other unit does.
            sim.set(sim.i.ready, is_less(choice, 54, 2, 3));
            if sim.get_u64(sim.o.line) == 1 {
                sim.set(sim.i.ready, 0);
            }
            let all_are_done = ports.iter().zip(&seen).all(|(i, o)| sim.get_u64(i.done) & sim.get_u64(o.idle) == 1);
            held_low += u64::from(all_are_done && sim.get_u64(sim.i.ready) == 1);
            for (port, (packet, place)) in senders.iter().zip(&mut sent) {
                if sim.get_u64(port.valid) & sim.get_u64(port.ready) == 1 {
                    (*packet, *place) = if *place + 1 == words(*packet) { (*packet + 1, 0) } else { (*packet, *place + 1) };
                }
            }
            for (received, o) in received.iter_mut().zip(&seen) {
                if sim.get_u64(o.received.valid) & sim.get_u64(o.received.ready) == 1 {
                    received.take(sim.get_u64(o.received.word), sim.get_u64(o.received.last));
                }
            }
            sim.step_clock(PE, 1);
        }
        // When all packets are complete and received, nothing pulls the line low.
        senders.iter().for_each(|sender| sim.set(sender.valid, 0));
        for (i, o) in ports.iter().zip(&seen) {
            sim.set(i.done, 0);
            sim.set(i.request.valid, 0);
            sim.set(o.received.ready, 1);
        }
        for (sender, (packet, place)) in senders.iter().zip(sent).filter(|(_, (_, place))| *place > 0) {
            for place in place..words(packet) {
                sim.set(sender.last, place + 1 == words(packet));
                sim.set(sender.valid, 1);
                while sim.get_u64(sender.ready) == 0 {
                    sim.step_clock(PE, 1);
                }
                sim.step_clock(PE, 1);
                sim.set(sender.valid, 0);
            }
        }
        sim.step_clock(PE, 100);
        ports.iter().for_each(|i| sim.set(i.done, 1));
        sim.set(sim.i.ready, 1);
        prop_assert_eq!(sim.get_u64(sim.o.line), 1);
        sim.step_clock(PE, 1);
        prop_assert_eq!(sim.covered("a word on the bus or in a queue keeps the line low").unwrap(), held_low);
        prop_assert!(held_low > 20);
        for received in received {
            // Words that have not arrived are in the queue, or wait for the bus.
            let pairs = received.packets.iter().zip(sent);
            prop_assert!(pairs.into_iter().all(|(received, (sent, _))| *received > 5 && received.abs_diff(sent) < 10));
        }
    }
}
