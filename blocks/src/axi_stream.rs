//! Packets of bytes to and from AXI4-Stream.

use crate::encode::first;
use crate::ports::state_that_it_stays;
use tilewright_hdl::{Module, below, bit, bits, block, concat, def, lit, mux, record};

record! {
    /// A byte of a packet.
    ///
    /// ```
    /// # use tilewright_blocks::PacketByte;
    /// let greeting = b"hi".map(|byte| PacketByte { byte: byte.into(), last: u64::from(byte == b'i') });
    /// assert_eq!(greeting[1], PacketByte { byte: 0x69, last: 1 });
    /// ```
    pub struct PacketByte {
        /// The byte.
        byte: bits(8),
        /// The packet ends with this byte.
        last: bit(),
    }

    /// A beat of AXI4-Stream: several bytes side by side, the first in the lowest bits.
    ///
    /// ```
    /// # use tilewright_blocks::AxiBeat;
    /// let hi = AxiBeat { data: 0x6968, keep: 0b0011, last: 1 };
    /// assert_eq!(AxiBeat::widths(4).data.bits(), 32);
    /// # assert_eq!(hi.keep, 3);
    /// ```
    pub struct AxiBeat(lanes: u32) {
        /// The bytes (TDATA).
        data: bits(8 * lanes),
        /// A bit for each byte: whether it belongs to the packet (TKEEP).
        keep: bits(lanes),
        /// The packet ends with this beat (TLAST).
        last: bit(),
    }
}

block! {
    /// Joins the bytes of packets into beats of AXI4-Stream.
    ///
    /// ```text
    /// bytes ===>[ 3 ][ 2 ][ 1 ][ 0 ]==.
    ///           [ keep ]              +==> beats
    ///           [ last ]  [ full ]===='
    /// ```
    ///
    /// Latency 1 clock from the last byte of a beat, a byte a clock. A packet begins with a beat of its own. The last
    /// beat of a packet keeps its lowest bytes, and the others have no meaning. No `valid` waits for `ready`, and
    /// `beats.ready` passes to `bytes.ready`. In Verilog the beats are the interface `m_axis`, with `m_axis_tdata`.
    ///
    /// ```
    /// # use tilewright_blocks::{AxiBeat, PacketByte, ToAxiStream};
    /// # use tilewright_sim::{Pauses, Simulation};
    /// let mut sim = Simulation::of(&ToAxiStream { lanes: 2 })?;
    /// sim.reset();
    /// let (bytes, beats) = (sim.i.bytes, sim.o.beats);
    /// let packet = *b"abc";
    /// let packet = packet.map(|byte| PacketByte { byte: byte.into(), last: u64::from(byte == b'c') });
    /// let t = sim.testbench();
    /// let (_, beats) = t.run((t.send_all(bytes, packet, Pauses::NONE), t.receive_all(beats, 2, Pauses::NONE)));
    /// assert_eq!(beats[0], AxiBeat { data: 0x6261, keep: 0b11, last: 0 });
    /// assert_eq!((beats[1].data & 0xff, beats[1].keep, beats[1].last), (0x63, 0b01, 1));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct ToAxiStream {
        /// The bytes of a beat.
        pub lanes: u32,
    }
    ranges { lanes: 1..=128 }
    port_names { beats: "m_axis_t" }
    latency = "1 clock";
    in ToAxiStreamIn {
        /// The bytes of packets.
        bytes: stream(PacketByte),
    }
    out(self) ToAxiStreamOut {
        /// The beats of packets.
        beats: stream(AxiBeat::widths(self.lanes)),
    }
}

impl ToAxiStream {
    fn build(&self, m: Module, i: ToAxiStreamIn) -> ToAxiStreamOut {
        def!(full = m.reg(bit()).reset(0));
        def!(place = m.reg(below(self.lanes)).reset(0));
        let held: Vec<_> = (0..self.lanes).map(|place| m.reg(&format!("held{place}"), 8)).collect();
        def!(keep = m.reg(self.lanes));
        def!(last = m.reg(bit()));
        let data = concat(&held.iter().rev().map(|byte| **byte).collect::<Vec<_>>());
        let (beats, sent) = m.offer(full, AxiBeat { data, keep: *keep, last: *last });
        let bytes = i.bytes.take_when(!full | sent);
        for (place_of, held) in (0u64..).zip(held) {
            held.when(bytes.taken & place.eq(place_of), bytes.byte);
        }
        let is_first = place.eq(0);
        let kept_before = mux(is_first, 0, *keep);
        keep.when(bytes.taken, kept_before << 1 | lit(self.lanes, 1));
        last.when(bytes.taken, bytes.last);
        let ends = bytes.last | place.eq(self.lanes - 1);
        place.when(bytes.taken, mux(ends, 0, place + 1));
        full.when(bytes.taken & ends, 1).when(sent, 0);
        state_that_it_stays(m, &beats.packed());
        ToAxiStreamOut { beats }
    }
}

block! {
    /// Takes the bytes of packets from beats of AXI4-Stream.
    ///
    /// ```text
    ///           .--------------.    .-------.
    /// beats ===>| data, keep,  |===>| first |===>[ byte ]===> bytes
    ///           | last  [full] |    | kept  |    [full]
    ///           '--------------'    '-------'
    /// ```
    ///
    /// Bytes that are not kept (null bytes) are left out, wherever they are. A byte is shown once it is known whether
    /// the packet ends with that byte. Within a beat this is at once, otherwise with the next beat. A packet without a
    /// byte gives nothing.
    ///
    /// Latency 2 clocks, a byte a clock. A beat without a byte takes a clock. No `valid` waits for `ready`, and
    /// `bytes.ready` passes to `beats.ready`. In Verilog the beats are the interface `s_axis`, with `s_axis_tdata`.
    ///
    /// ```
    /// # use tilewright_blocks::{AxiBeat, FromAxiStream, PacketByte};
    /// # use tilewright_sim::{Pauses, Simulation};
    /// let mut sim = Simulation::of(&FromAxiStream { lanes: 4 })?;
    /// sim.reset();
    /// let (beats, bytes) = (sim.i.beats, sim.o.bytes);
    /// let t = sim.testbench();
    /// let packet = [AxiBeat { data: 0x6463_6261, keep: 0b1011, last: 0 }, AxiBeat { data: 0, keep: 0, last: 1 }];
    /// let expected = [(b'a', 0), (b'b', 0), (b'd', 1)].map(|(byte, last)| PacketByte { byte: byte.into(), last });
    /// t.run((t.send_all(beats, packet, Pauses::NONE), t.expect_all(bytes, expected, Pauses::NONE)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct FromAxiStream {
        /// The bytes of a beat.
        pub lanes: u32,
    }
    ranges { lanes: 1..=128 }
    port_names { beats: "s_axis_t" }
    latency = "2 clocks";
    in(self) FromAxiStreamIn {
        /// The beats of packets.
        beats: stream(AxiBeat::widths(self.lanes)),
    }
    out FromAxiStreamOut {
        /// The bytes of packets.
        bytes: stream(PacketByte),
    }
}

impl FromAxiStream {
    fn build(&self, m: Module, i: FromAxiStreamIn) -> FromAxiStreamOut {
        def!(full = m.reg(bit()).reset(0));
        def!(data = m.reg(8 * self.lanes));
        def!(keep = m.reg(self.lanes));
        def!(last = m.reg(bit()));
        def!(has_byte = full & keep.any_one());
        def!(chosen = first(*keep));
        def!(rest = keep & !chosen);
        def!(next_byte = (data.unpack(self.lanes) & chosen.unpack(self.lanes).repeat(8)).or_all());
        def!(ends_empty = full & !has_byte & last);

        // The byte that is shown, or waits until it is known whether the packet ends with it.
        def!(waits = m.reg(bit()).reset(0));
        def!(waiting = m.reg(PacketByte::widths()));
        def!(known = waiting.last | has_byte | ends_empty);
        let (bytes, sent) = m.offer(waits & known, PacketByte { byte: waiting.byte, last: waiting.last | !has_byte });
        def!(moves = has_byte & (!waits | sent));
        waiting.when(moves, PacketByte { byte: next_byte, last: last & !rest.any_one() });
        waits.when(moves, 1).when(sent, 0);

        // An empty beat stays as long as the byte before it waits to hear that the packet ends.
        def!(empty_goes = full & !has_byte & (!last | !waits | waiting.last | sent));
        def!(goes = empty_goes | (moves & !rest.any_one()));
        let beats = i.beats.take_when(!full | goes);
        full.when(beats.taken, 1).when(goes, 0);
        data.when(beats.taken, beats.data);
        keep.when(beats.taken, beats.keep).when(moves, rest);
        last.when(beats.taken, beats.last);
        state_that_it_stays(m, &bytes.packed());
        FromAxiStreamOut { bytes }
    }
}
