//! The entries of blocks that speak AXI.

use crate::{AxiLiteAddress, AxiLiteData, AxiLiteRegisters, AxiLiteRegistersIn};
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
