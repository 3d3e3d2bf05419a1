//! The entries of blocks that speak AXI.

use crate::{
    AxiBeat, AxiLiteAddress, AxiLiteData, AxiLiteRegisters, AxiLiteRegistersIn, FromAxiStream, FromAxiStreamIn,
    PacketByte, ToAxiStream, ToAxiStreamIn,
};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{DEFAULT_PERIOD, Scenario, Script, Stream, elaborate};

pub(super) const AXI_LITE_REGISTERS: Entry = Entry {
    name: "axi-lite-registers",
    summary: "registers for a processor, behind AXI4-Lite",
    parameters: &[
        Parameter { name: "registers", default: 2, min: 1, max: 512, meaning: "words that are read and written" },
        Parameter { name: "status", default: 1, min: 0, max: 512, meaning: "words that are only read" },
    ],
    design: |values| Ok(elaborate(&registers(values))?),
    scenario: |values| Ok(writes_and_reads(&registers(values))),
};

const LANES: Parameter = Parameter { name: "lanes", default: 2, min: 1, max: 7, meaning: "bytes of a beat" };

pub(super) const TO_AXI_STREAM: Entry = Entry {
    name: "to-axi-stream",
    summary: "joins the bytes of packets into beats of AXI4-Stream",
    parameters: &[LANES],
    design: |values| Ok(elaborate(&to_axi_stream(values))?),
    scenario: |values| Ok(bytes_of_two_packets(&to_axi_stream(values))),
};

pub(super) const FROM_AXI_STREAM: Entry = Entry {
    name: "from-axi-stream",
    summary: "takes the bytes of packets from beats of AXI4-Stream",
    parameters: &[LANES],
    design: |values| Ok(elaborate(&from_axi_stream(values))?),
    scenario: |values| Ok(beats_of_two_packets(&from_axi_stream(values))),
};

fn registers(values: &Values) -> AxiLiteRegisters {
    let [registers, status] = ["registers", "status"].map(|name| values.get_u32(name));
    AxiLiteRegisters { address: 12, width: 32, registers, status }
}

fn writes_and_reads(block: &AxiLiteRegisters) -> Scenario {
    let mut script = Script::new(block, DEFAULT_PERIOD);
    let first_of_status = 4 * u64::from(block.registers);
    let beyond = first_of_status + 4 * u64::from(block.status);
    script.ready("b", true);
    script.ready("r", true);
    script.clock(&row(block, Some(0), Some((0x1234_5678, 0b1111)), None));
    script.clock(&row(block, Some(0), None, Some(0)));
    script.clock(&row(block, None, Some((0xaabb_ccdd, 0b0110)), Some(first_of_status)));
    script.clock(&row(block, Some(first_of_status), Some((1, 0b1111)), Some(beyond)));
    script.ready("r", false);
    script.clock(&row(block, None, None, Some(0)));
    script.hold(&row(block, None, None, Some(beyond)), 3);
    script.ready("r", true);
    script.hold(&row(block, None, None, Some(beyond)), 2);
    script.hold(&row(block, None, None, None), 3);
    script.finish(
        "a register is written, and two bytes of it, whose address comes first; then a word that is only read. \
         Reads give the register, status, and nothing; the last ones wait for the master",
    )
}

/// What the master shows in a clock: an address to write at, a word and its bytes, an address to read at.
fn row(
    block: &AxiLiteRegisters,
    write: Option<u64>,
    word: Option<(u64, u64)>,
    read: Option<u64>,
) -> AxiLiteRegistersIn<u64> {
    let at = |addr: Option<u64>| Stream::of(addr.is_some().into(), AxiLiteAddress { addr: addr.unwrap_or(0), prot: 0 });
    let (data, strb) = word.unwrap_or((0, 0));
    let w = Stream::of(word.is_some().into(), AxiLiteData { data, strb });
    AxiLiteRegistersIn { aw: at(write), w, ar: at(read), status: vec![0xbeef; block.status as usize] }
}

fn to_axi_stream(values: &Values) -> ToAxiStream {
    ToAxiStream { lanes: values.get_u32("lanes") }
}

fn bytes_of_two_packets(block: &ToAxiStream) -> Scenario {
    let mut script = Script::new(block, DEFAULT_PERIOD);
    let show =
        |valid, byte: u8, last| ToAxiStreamIn { bytes: Stream::of(valid, PacketByte { byte: byte.into(), last }) };
    script.ready("beats", true);
    for (byte, last) in [(b'a', 0), (b'b', 0), (b'c', 1)] {
        script.clock(&show(1, byte, last));
    }
    script.ready("beats", false);
    script.hold(&show(1, b'd', 1), 2);
    script.ready("beats", true);
    script.clock(&show(1, b'd', 1));
    script.hold(&show(0, 0, 0), 2);
    script.finish("a packet of three bytes, whose last beat waits for the receiver, and one of a byte")
}

fn from_axi_stream(values: &Values) -> FromAxiStream {
    FromAxiStream { lanes: values.get_u32("lanes") }
}

fn beats_of_two_packets(block: &FromAxiStream) -> Scenario {
    let mut script = Script::new(block, DEFAULT_PERIOD);
    let lanes = u64::from(block.lanes);
    let all = (1 << lanes) - 1;
    let show = |valid, first: u64, keep, last| {
        let data = (0..lanes).map(|lane| (first + lane) << (8 * lane)).sum();
        FromAxiStreamIn { beats: Stream::of(valid, AxiBeat { data, keep, last }) }
    };
    script.ready("bytes", true);
    script.clock(&show(1, 0x61, all, 0));
    script.hold(&show(1, 0x61 + lanes, all & 1, 0), lanes);
    script.clock(&show(1, 0, 0, 1));
    script.hold(&show(0, 0, 0, 0), 3);
    script.ready("bytes", false);
    script.clock(&show(1, 0x61 + lanes + 1, all & 1, 1));
    script.hold(&show(0, 0, 0, 0), 3);
    script.ready("bytes", true);
    script.hold(&show(0, 0, 0, 0), 2);
    script.finish("a packet that ends with a beat without a byte, and one of a byte, which waits for the receiver")
}
