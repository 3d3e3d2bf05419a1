//! Packets of bytes, to AXI4-Stream and from it.

use crate::streams::property::FORWARD;
use crate::streams::stalls::{passed, stalls};
use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_hdl::{Block, Module, Width, bits, lit, stream};
use tilewright_sim::Simulation;

/// A block of records as one of words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Words {
    To(u32),
    From(u32),
}

impl Block for Words {
    type In = StreamIn;
    type Out = StreamOut;

    fn inputs(&self) -> StreamIn<Width> {
        StreamIn {
            into: match self {
                Words::To(_) => stream(bits(9)),
                Words::From(lanes) => stream(bits(9 * lanes + 1)),
            },
        }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        let out = match *self {
            Words::To(lanes) => {
                let bytes = i.into.unpacked(&PacketByte { byte: lit(8, 0), last: lit(1, 0) });
                m.instance("u_to", &ToAxiStream { lanes }, ToAxiStreamIn { bytes }).beats.packed()
            }
            Words::From(lanes) => {
                let like = AxiBeat { data: lit(8 * lanes, 0), keep: lit(lanes, 0), last: lit(1, 0) };
                let beats = i.into.unpacked(&like);
                m.instance("u_from", &FromAxiStream { lanes }, FromAxiStreamIn { beats }).bytes.packed()
            }
        };
        StreamOut { out }
    }
}

/// A byte and whether its packet ends, as a word.
fn byte_word(byte: u64, ends: bool) -> u64 {
    byte << 1 | u64::from(ends)
}

/// Bytes side by side, those that are kept, and whether the packet ends, as a word; a byte that is not kept is 0.
fn beat_word(lanes: u32, bytes: &[Option<u64>], ends: bool) -> u64 {
    let lane = |(place, byte): (usize, &Option<u64>)| byte.unwrap_or(0) << (8 * place + lanes as usize);
    let keep = bytes.iter().enumerate().map(|(place, byte)| u64::from(byte.is_some()) << place).sum::<u64>();
    (bytes.iter().enumerate().map(lane).sum::<u64>() | keep) << 1 | u64::from(ends)
}

/// The word of a beat, with 0 for the bytes that are not kept.
fn without_others(lanes: u32, word: u64) -> u64 {
    let (data, keep, ends) = (word >> (lanes + 1), word >> 1, word & 1 == 1);
    let bytes = (0..lanes).map(|place| (keep >> place & 1 == 1).then_some(data >> (8 * place) & 0xff));
    beat_word(lanes, &bytes.collect::<Vec<_>>(), ends)
}

/// A packet that is cut off has no end.
fn packets() -> impl Strategy<Value = Vec<Vec<u64>>> {
    prop::collection::vec(prop::collection::vec(0u64..256, 1..12), 0..8)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bytes_to_beats(lanes in 1u32..7, packets in packets(), stalls in stalls()) {
        let bytes = packets.iter().flat_map(|packet| {
            packet.iter().enumerate().map(|(place, byte)| byte_word(*byte, place + 1 == packet.len()))
        });
        let expected: Vec<u64> = packets.iter().flat_map(|packet| {
            let beats = packet.chunks(lanes as usize);
            let count = beats.len();
            beats.enumerate().map(move |(place, beat)| {
                beat_word(lanes, &beat.iter().map(|byte| Some(*byte)).collect::<Vec<_>>(), place + 1 == count)
            })
        }).collect();
        let beats = passed(&Words::To(lanes), &bytes.collect::<Vec<_>>(), expected.len(), stalls, FORWARD);
        let beats: Vec<u64> = beats.into_iter().map(|word| without_others(lanes, word)).collect();
        prop_assert_eq!(beats, expected);
    }

    /// Any bytes of any beat may be null, also all of the last one.
    #[test]
    fn beats_to_bytes(
        lanes in 1u32..7, packets in prop::collection::vec(prop::collection::vec(prop::collection::vec(prop::option::of(0u64..256), 6), 1..5), 0..8),
        empties in any::<u64>(), stalls in stalls(),
    ) {
        let (mut beats, mut expected) = (Vec::new(), Vec::new());
        for packet in &packets {
            let first = expected.len();
            for (place, beat) in packet.iter().enumerate() {
                let is_empty = empties >> (beats.len() % 64) & 1 == 1;
                let beat: Vec<_> = beat[..lanes as usize].iter().map(|byte| byte.filter(|_| !is_empty)).collect();
                beats.push(beat_word(lanes, &beat, place + 1 == packet.len()));
                expected.extend(beat.into_iter().flatten().map(|byte| byte_word(byte, false)));
            }
            if let Some(last) = expected[first..].last_mut() {
                *last |= 1;
            }
        }
        prop_assert_eq!(passed(&Words::From(lanes), &beats, expected.len(), stalls, FORWARD), expected);
    }
}

#[test]
fn beats_clock_by_clock() {
    let mut sim = Simulation::of(&ToAxiStream { lanes: 2 }).unwrap();
    sim.reset();
    let names = ["bytes_valid", "bytes_byte", "bytes_last", "bytes_ready"];
    let wave = sim.record(names.into_iter().chain([
        "m_axis_tvalid",
        "m_axis_tdata",
        "m_axis_tkeep",
        "m_axis_tlast",
        "m_axis_tready",
    ]));
    for (byte, last, ready) in [
        (Some(1), 0, 1),
        (Some(2), 0, 1),
        (Some(3), 1, 1),
        (Some(4), 1, 0),
        (Some(4), 1, 1),
        (None, 0, 1),
        (None, 0, 1),
    ] {
        sim.set(sim.i.bytes.valid, byte.is_some());
        sim.set(sim.i.bytes.byte, byte.unwrap_or(0));
        sim.set(sim.i.bytes.last, last);
        sim.set(sim.o.beats.ready, ready);
        sim.step();
    }
    wave.expect(
        r"
        clk           |~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/
        bytes_valid   |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\____________
        bytes_byte    | 1   | 2   | 3   | 4         | 0         |
        bytes_last    |___________/~~~~~~~~~~~~~~~~~\____________
        bytes_ready   |~~~~~~~~~~~~~~~~~\_____/~~~~~~~~~~~~~~~~~~
        m_axis_tvalid |___________/~~~~~~~~~~~~~~~~~~~~~~~\______
        m_axis_tdata  | 0   | 1   | 201 | 203       | 204       |
        m_axis_tkeep  | 0   | 1   | 3   | 1                     |
        m_axis_tlast  |_________________/~~~~~~~~~~~~~~~~~~~~~~~~
        m_axis_tready |~~~~~~~~~~~~~~~~~\_____/~~~~~~~~~~~~~~~~~~",
    );
}

#[test]
fn bytes_clock_by_clock() {
    let mut sim = Simulation::of(&FromAxiStream { lanes: 2 }).unwrap();
    sim.reset();
    let names = ["s_axis_tvalid", "s_axis_tdata", "s_axis_tkeep", "s_axis_tlast", "s_axis_tready"];
    let wave = sim.record(names.into_iter().chain(["bytes_valid", "bytes_byte", "bytes_last", "bytes_ready"]));
    let rows = [
        (Some((0x0201, 0b11, 0)), 1),
        (Some((0x0304, 0b10, 0)), 1),
        (Some((0x0304, 0b10, 0)), 1),
        (None, 1), // 3 waits for its successor
        (Some((0, 0, 1)), 1),
        (Some((0x0005, 0b01, 1)), 0),
        (Some((0x0005, 0b01, 1)), 1),
        (None, 1),
        (None, 1),
    ];
    for (beat, ready) in rows {
        let (data, keep, last) = beat.unwrap_or((0, 0, 0));
        sim.set(sim.i.beats.valid, beat.is_some());
        sim.set_record(sim.i.beats.payload, AxiBeat { data, keep, last });
        sim.set(sim.o.bytes.ready, ready);
        sim.step();
    }
    wave.expect(
        r"
        clk           |~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/
        s_axis_tvalid |~~~~~~~~~~~~~~~~~\_____/~~~~~~~~~~~~~~~~~\____________
        s_axis_tdata  | 201 | 304       | 0         | 5         | 0         |
        s_axis_tkeep  | 3   | 2         | 0         | 1         | 0         |
        s_axis_tlast  |_______________________/~~~~~~~~~~~~~~~~~\____________
        s_axis_tready |~~~~~\_____/~~~~~~~~~~~~~~~~~\_____/~~~~~~~~~~~~~~~~~~
        bytes_valid   |___________/~~~~~~~~~~~\_____/~~~~~~~~~~~\_____/~~~~~~
        bytes_byte    | 0         | 1   | 2   | 3                     | 5   |
        bytes_last    |~~~~~\_________________/~~~~~~~~~~~~~~~~~\_____/~~~~~~
        bytes_ready   |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_____/~~~~~~~~~~~~~~~~~~",
    );
}
