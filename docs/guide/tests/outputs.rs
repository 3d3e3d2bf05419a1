//! What the chapters show as printed is what their code prints.

use tilewright_boards::{Top, ulx3s};
use tilewright_gen::{Dialect, Pins, VerilogFile, constraints};
use tilewright_guide::blink::Blink;
use tilewright_guide::book::{Fence, fences, stands_in};
use tilewright_guide::button::{Button, Line};
use tilewright_guide::grammar::{Everything, Free};
use tilewright_guide::mistakes::{crossing::Crossing, stages::Stages, undriven::Undriven, widths::Widths};
use tilewright_guide::nearer::Lesser;
use tilewright_guide::simd::Simd;
use tilewright_guide::uart::{
    proved::QueueCounts, ticks::BitTicks, transmitter::Transmitter, two_clocks::ShoutingEcho,
};
use tilewright_hdl::{Block, elaborate};

/// What is printed, by the name that stands behind the language of a block.
fn printed(name: &str) -> String {
    match name {
        "blink.v" => verilog(&Blink { clocks: 6_000_000 }),
        "button.v" => verilog(&Button),
        "test_picture.lpf" => on_a_board("test-picture").pop().unwrap().text,
        "ulx3s.pins" => ulx3s::PINS.to_owned(),
        "two_clocks.sdc" => sdc(&ShoutingEcho { clocks_per_bit: 13 }),
        "line.v" => verilog(&Line),
        "bit_ticks.v" => verilog(&BitTicks { clocks_per_bit: 4 }),
        "range" => BitTicks { clocks_per_bit: 1 }.checked().unwrap_err().to_string(),
        "undriven" => problems(&Undriven),
        "widths" => problems(&Widths),
        "transmitter.v" => verilog(&Transmitter { clocks_per_bit: 2 }),
        "stages" => problems(&Stages),
        "crossing" => problems(&Crossing),
        "two_clocks.v" => verilog(&ShoutingEcho { clocks_per_bit: 13 }),
        "queue_counts.v" => verilog(&QueueCounts { depth: 4 }),
        "lesser.v" => verilog(&Lesser),
        "simd.v" => verilog(&Simd { edge: 64 }),
        "simd_lines" => simd_lines(),
        "grammar_ports" => input_names(&Everything { columns: 640, rows: 480 }),
        _ => panic!("nothing prints `{name}`"),
    }
}

/// The Verilog of the block itself, without that of its instances.
fn verilog<B: Block>(block: &B) -> String {
    let design = elaborate(block).unwrap();
    tilewright_gen::verilog(&design).pop().unwrap().text
}

fn sdc<B: Block>(block: &B) -> String {
    constraints(&elaborate(block).unwrap(), Dialect::Sdc, &Pins::none()).unwrap().text
}

/// Verilog and constraints of a top for a ULX3S.
pub fn on_a_board(top: &str) -> Vec<VerilogFile> {
    let top = Top::find(top, "ulx3s").unwrap();
    top.files(&(top.design)().unwrap()).unwrap()
}

/// How long the Verilog of small and large squares is.
fn simd_lines() -> String {
    let lines = |edge: u32| {
        format!("{edge} x {edge}: {} processors, {} lines", edge * edge, verilog(&Simd { edge }).lines().count())
    };
    [4, 16, 64].map(lines).join("\n")
}

#[test]
fn what_is_shown_is_printed() {
    let mut count = 0;
    let mut wrong = String::new();
    for Fence { place, language, source, text } in fences() {
        if ["text", "verilog"].contains(&&*language) && !source.contains('/') {
            let printed = printed(&source);
            if !stands_in(&text, &printed) {
                wrong += &format!("{place}: {source} prints\n{printed}\n");
            }
            count += 1;
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(count > 0, "none is found");
}

/// What is wrong with the block.
fn problems<B: Block>(block: &B) -> String {
    elaborate(block).expect_err("the description is wrong").to_string()
}

/// The names of the input ports, on lines that are not long.
fn input_names<B: Block>(block: &B) -> String {
    let design = elaborate(block).unwrap();
    let mut lines = vec![String::new()];
    for port in &design.top().inputs {
        if lines.last().unwrap().len() + port.name.len() > 90 {
            lines.push(String::new());
        }
        let line = lines.last_mut().unwrap();
        *line += &format!("{}{}", if line.is_empty() { "" } else { " " }, port.name);
    }
    lines.join("\n")
}

#[test]
fn a_block_without_inputs_is_one() {
    elaborate(&Free).unwrap();
}
