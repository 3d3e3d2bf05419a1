//! A design with pads as it stands on a board: without models of its pads, with the other sides as drivers of its
//! `inout` ports. Verilog's own strengths say what a line shows: the chip is strong, the outside pulls, and what is
//! left alone is weakly high or low.

use crate::batch::Printed;
use std::collections::BTreeSet;
use tilewright_gen::VerilogFile;
use tilewright_hdl::ir::{Design, Instance, Module, NodeId};

/// A pad, seen from the board.
struct Line {
    port: String,
    width: u32,
    is_pulled_up: bool,
    /// The inputs that the top has with models only.
    value: String,
    drives: String,
}

/// The same run on a board, if the design has pads and no assertion fails: a pad has its assertion in its model. Not
/// if the top instantiates a foreign module, of which it would have no model.
pub fn on_a_board(design: &Design, printed: &Printed) -> Option<Printed> {
    let lines = lines(design);
    let is_foreign = |instance: &Instance| design.module(instance.module).foreign.is_some();
    if lines.is_empty() || printed.fails || design.top().instances.iter().any(is_foreign) {
        return None;
    }
    let mut printed = printed.clone();
    let top = printed.files.iter_mut().rfind(|file| file.name.ends_with(".v"))?;
    let with_models = ports_with_models(&top.text);
    let without_models = format!("`undef TILEWRIGHT_MODELS\n{}`define TILEWRIGHT_MODELS\n", top.text);
    let text = bench(&printed.bench.text, design.top(), &lines, &with_models);
    printed.bench = VerilogFile { text, ..printed.bench };
    top.text = without_models;
    Some(printed)
}

fn lines(design: &Design) -> Vec<Line> {
    let top = design.top();
    let line = |pad: &Instance| {
        let child = design.module(pad.module);
        let port = child.is_pad.then(|| top.pad_port(pad)).flatten()?;
        let [value, drives] = pad.outside()?;
        let name = |node: NodeId| top.node(node).name.clone().expect("an input has a name");
        Some(Line {
            port,
            width: top.width(pad.outputs[0]),
            is_pulled_up: child.name.contains("pull_up"),
            value: name(value),
            drives: name(drives),
        })
    };
    top.instances.iter().filter_map(line).collect()
}

/// The ports of the printed top that it has with models only. Of an output that is a line it has a net else.
fn ports_with_models(text: &str) -> BTreeSet<&str> {
    let (_, ports) = text.split_once("\n`ifdef TILEWRIGHT_MODELS\n").expect("the top has pads");
    let (ports, _) = ports.split_once("\n`else\n").expect("the top has other ports without models");
    ports.lines().filter_map(|port| port.trim_end_matches(',').rsplit(' ').next()).collect()
}

/// The testbench with lines between the pads and what it drives.
fn bench(text: &str, top: &Module, lines: &[Line], with_models: &BTreeSet<&str>) -> String {
    let start = text.find(&format!("\n    {} ", top.name)).expect("the bench instantiates the top") + 1;
    let (before, rest) = text.split_at(start);
    let (connections, after) = rest.split_once("\n    );\n").expect("an instance has an end");
    let (head, connections) = connections.split_once('\n').expect("a top has ports");
    let kept = connections.lines().map(|line| line.trim().trim_end_matches(',').to_owned());
    let port = |connection: &str| connection[1..].split(' ').next().unwrap_or_default().to_owned();
    let kept = kept.filter(|connection| !with_models.contains(port(connection).as_str()));
    let dut = head.trim().split(' ').nth(1).expect("the instance has a name");
    let shown = top.outputs.iter().map(|output| &output.name).filter(|name| with_models.contains(name.as_str()));
    let shown: String = shown.map(|name| format!("    assign {name} = {dut}.{name};\n")).collect();
    let pads = lines.iter().enumerate().map(|(number, line)| format!(".{} (board_line_{number})", line.port));
    let connections: Vec<String> = kept.chain(pads).map(|connection| format!("        {connection}")).collect();
    let drivers: String = lines.iter().enumerate().map(|(number, line)| line.drivers(number)).collect();
    format!("{before}{drivers}{shown}{head}\n{}\n    );\n{after}", connections.join(",\n"))
}

impl Line {
    /// The net of a line, with what drives it besides the chip.
    fn drivers(&self, number: usize) -> String {
        let Line { width, value, drives, .. } = self;
        let level = u32::from(self.is_pulled_up);
        format!(
            "    wire [{}:0] board_line_{number};\n    \
             assign (pull1, pull0) board_line_{number} = {drives} ? {value} : {width}'bz;\n    \
             assign (weak1, weak0) board_line_{number} = {{{width}{{1'b{level}}}}};\n",
            width - 1
        )
    }
}
