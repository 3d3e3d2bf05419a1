//! The entry of the broadcast bus.

use tilewright_hdl::{Scenario, Script, Stream, elaborate_at};

use super::shared::{PROCESSORS, RECEIVE_QUEUE, WORD_CLOCKS};
use super::{Entry, Values};
use crate::bus::{BroadcastBus, BroadcastBusIn, BusWord};
use crate::clocks::PE;

pub(super) const BROADCAST_BUS: Entry = Entry {
    name: "broadcast-bus",
    summary: "carries packets from the host or any processor to all processors",
    parameters: &[PROCESSORS, RECEIVE_QUEUE, WORD_CLOCKS],
    design: |values| Ok(elaborate_at(&broadcast_bus(values), PE.period)?),
    scenario: |values| Ok(two_packets(&broadcast_bus(values))),
};

fn broadcast_bus(values: &Values) -> BroadcastBus {
    BroadcastBus {
        processors: values.get_u32("processors"),
        queue: values.get_u32("queue"),
        word_clocks: values.get_u32("clocks"),
    }
}

fn two_packets(bus: &BroadcastBus) -> Scenario {
    let (processors, clocks) = (bus.processors as usize, bus.word_clocks);
    let none = Stream::of(0, BusWord { word: 0, last: 0 });
    let word = |word, last| Stream::of(1, BusWord { word, last });
    let offer = |first, host| {
        let mut senders = vec![none; processors + 1];
        (senders[0], senders[processors]) = (first, host);
        BroadcastBusIn { senders }
    };
    let mut script = Script::new(bus, PE.period);
    (1..processors).for_each(|processor| script.ready(&format!("received_{processor}"), true));
    script.clock(&offer(word(0xa0, 0), word(0xc0, 1)));
    script.hold(&offer(none, word(0xc0, 1)), clocks + 2);
    script.clock(&offer(word(0xa1, 1), word(0xc0, 1)));
    script.hold(&offer(none, word(0xc0, 1)), clocks);
    script.hold(&offer(none, none), 2 * clocks);
    script.ready("received_0", true);
    script.wait(6u32);
    script.finish(
        "the first processor begins a packet, pauses, and ends it; then the host sends one. The first processor takes both when the bus is idle",
    )
}
