//! The text of a replay testbench.

use super::start::Start;
use super::table::{Column, Inside, Table, numbers, tables};
use crate::verilog::{Names, connect, packed_width, range, stop};
use std::collections::BTreeMap;
use std::fmt::Write;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Design, Module};
use tilewright_circuit::{Edge, Recording, Reset};

/// Further mismatches are counted but not shown.
const MOST_SHOWN: u32 = 10;

/// Verilator's warning about a delay that may be 0.
const ZERO_DELAY: &str = "ZERODLY";

/// The testbench's own names, besides those of its tables.
const OWN: [&str; 9] = ["dut", "stimulus", "expected", "gap", "rising", "cycle", "errors", "run", "fill"];

/// A port of the top: its name and width.
type Port<'a> = (&'a str, u32);

pub fn print(design: &Design, recording: &Recording, name: &str) -> String {
    let (bench, mut names) = Bench::new(design.top(), recording);
    let start = Start::new(design, bench.own("dut"), recording, &mut names);
    let inside = Inside::new(&mut names);
    let tables = tables(&bench.columns(), recording.steps.len(), &mut names);
    let mut body = bench.declarations(&tables);
    body.extend(bench.device(design.top()));
    body.extend(generate_start(&start, &mut names));
    body.extend(bench.run(&start.special, &tables));
    body.extend(bench.fill(&tables));
    body.extend(tables.iter().flat_map(|table| table.task(&inside)));
    let mut text = format!(
        "// {name}\n//\n// Replays {} recorded steps of {} and compares every output before every edge.\n\
         `default_nettype none\n\nmodule {name};\n",
        recording.steps.len(),
        design.top().name
    );
    for line in body {
        let _ = if line.is_empty() { writeln!(text) } else { writeln!(text, "    {line}") };
    }
    text + "endmodule\n`default_nettype wire\n"
}

/// The name of the design's instance in its testbench.
pub fn instance(design: &Design) -> String {
    Bench::new(design.top(), &Recording::default()).0.own("dut").to_owned()
}

struct Bench<'a> {
    recording: &'a Recording,
    clocks: Vec<&'a str>,
    /// For each clock, whether its edges are where it falls.
    falls: Vec<bool>,
    /// The driven ports: resets, then inputs.
    driven: Vec<Port<'a>>,
    /// For each clock, the kind of reset if it has a port.
    resets: Vec<Option<Reset>>,
    outputs: Vec<Port<'a>>,
    /// The names that it uses for its own declarations, and for the expected value of each output.
    own: BTreeMap<&'static str, String>,
    wants: Vec<String>,
    /// The gap between steps, if it is always the same.
    period: Option<u64>,
}

impl<'a> Bench<'a> {
    /// The testbench, and the names in use in it.
    fn new(top: &'a Module, recording: &'a Recording) -> (Bench<'a>, Names) {
        let resets = top.clocks.iter().filter_map(|clock| Some((clock.reset.as_deref()?, 1)));
        let inputs = top.inputs.iter().map(|input| (input.name.as_str(), packed_width(top, input.node)));
        let outputs = top.outputs.iter().map(|output| (output.name.as_str(), packed_width(top, output.node)));
        let mut bench = Bench {
            recording,
            clocks: top.clocks.iter().map(|clock| clock.port.as_str()).collect(),
            falls: top.clocks.iter().map(|clock| clock.edge == Edge::Falling).collect(),
            driven: resets.chain(inputs).collect(),
            resets: top.clocks.iter().map(|clock| clock.reset.as_ref().map(|_| clock.kind)).collect(),
            outputs: outputs.collect(),
            own: BTreeMap::new(),
            wants: Vec::new(),
            period: None,
        };
        let mut names = Names::default();
        bench.clocks.iter().for_each(|clock| names.take(clock));
        bench.driven.iter().chain(&bench.outputs).for_each(|(port, _)| names.take(port));
        bench.own = OWN.into_iter().map(|name| (name, names.fresh(name))).collect();
        bench.wants = bench.outputs.iter().map(|(name, _)| names.fresh(&format!("want_{name}"))).collect();
        let gaps = bench.gaps();
        bench.period = gaps.first().copied().filter(|first| gaps.iter().all(|gap| gap == first));
        (bench, names)
    }

    fn gaps(&self) -> Vec<u64> {
        let mut before = 0;
        self.recording.steps.iter().map(|step| step.time_ps - std::mem::replace(&mut before, step.time_ps)).collect()
    }

    fn own(&self, name: &str) -> &str {
        &self.own[name]
    }

    fn width(ports: &[Port]) -> u32 {
        ports.iter().map(|port| port.1).sum()
    }

    fn declarations(&self, tables: &[Table]) -> Vec<String> {
        let mut out = vec![String::new()];
        out.extend(self.clocks.iter().map(|clock| format!("reg {clock};")));
        out.extend(self.driven.iter().map(|&(name, width)| format!("reg {}{name};", range(width))));
        out.extend(self.outputs.iter().map(|&(name, width)| format!("wire {}{name};", range(width))));
        let wants = self.outputs.iter().zip(&self.wants);
        out.extend(wants.map(|(&(_, width), want)| format!("reg {}{want};", range(width))));
        out.push(String::new());
        out.extend(tables.iter().flat_map(Table::declarations));
        out.extend([format!("integer {};", self.own("cycle")), format!("integer {};", self.own("errors"))]);
        out
    }

    /// What each step does.
    fn columns(&self) -> Vec<Column> {
        let steps = &self.recording.steps;
        let mut columns = Vec::new();
        if self.period.is_none() {
            columns.push(numbers(self.own("gap").to_owned(), &self.gaps()));
        }
        if self.clocks.len() > 1 {
            let width = self.clocks.len() as u32;
            let mask = |clocks: &[usize]| clocks.iter().fold(0u64, |mask, &clock| mask | 1 << clock);
            let values = steps.iter().map(|step| Bits::new(width, mask(&step.rising))).collect();
            columns.push(Column { register: self.own("rising").to_owned(), width, values });
        }
        if !self.driven.is_empty() {
            let values = steps.iter().map(|step| {
                let resets = self.resets.iter().enumerate().filter_map(|(clock, kind)| Some((clock, (*kind)?)));
                let resets = resets.map(|(clock, kind)| kind.is_active_low() != step.resets.contains(&clock));
                let resets = resets.map(Bits::from);
                joined(resets.chain(step.inputs.iter().cloned()))
            });
            let register = self.own("stimulus").to_owned();
            columns.push(Column { register, width: Self::width(&self.driven), values: values.collect() });
        }
        if !self.outputs.is_empty() {
            let values = steps.iter().map(|step| joined(step.outputs.iter().cloned())).collect();
            columns.push(Column {
                register: self.own("expected").to_owned(),
                width: Self::width(&self.outputs),
                values,
            });
        }
        columns
    }

    fn device(&self, top: &Module) -> Vec<String> {
        let names = self.clocks.iter().copied().chain(self.driven.iter().chain(&self.outputs).map(|port| port.0));
        let connections: Vec<(String, String)> = names.map(|name| (name.to_string(), name.to_string())).collect();
        let mut out = vec![String::new()];
        out.extend(connect(&top.name, self.own("dut"), &connections));
        out
    }

    fn run(&self, special: &[String], tables: &[Table]) -> Vec<String> {
        let (cycle, errors, steps) = (self.own("cycle"), self.own("errors"), self.recording.steps.len());
        let mut out = vec![String::new(), format!("initial begin : {}", self.own("run"))];
        let mut line = |indent: usize, text: String| out.push(format!("{}{text}", "    ".repeat(indent)));
        line(1, format!("{};", self.own("fill")));
        line(1, format!("{errors} = 0;"));
        tables.iter().flat_map(Table::start).for_each(|text| line(1, text));
        (0..self.clocks.len()).for_each(|clock| line(1, self.level(clock, false)));
        if !special.is_empty() {
            line(1, "#1;".to_string());
        }
        special.iter().for_each(|assign| line(1, assign.clone()));
        line(1, format!("for ({cycle} = 0; {cycle} < {steps}; {cycle} = {cycle} + 1) begin"));
        tables.iter().flat_map(|table| table.read(cycle)).for_each(|text| line(2, text));
        let (half, rest) = self.waits();
        let varies = self.period.is_none();
        if varies {
            line(2, format!("/* verilator lint_off {ZERO_DELAY} */ // a gap is 2 at least"));
        }
        line(2, half);
        (0..self.clocks.len()).for_each(|clock| line(2, self.level(clock, false)));
        if !self.driven.is_empty() {
            line(2, format!("{} = {};", names(&self.driven), self.own("stimulus")));
        }
        line(2, rest);
        if varies {
            line(2, format!("/* verilator lint_on {ZERO_DELAY} */"));
        }
        if !self.outputs.is_empty() {
            line(2, format!("{{{}}} = {};", self.wants.join(", "), self.own("expected")));
        }
        for ((name, _), want) in self.outputs.iter().zip(&self.wants) {
            line(2, format!("if ({name} !== {want}) begin"));
            line(3, format!("if ({errors} < {MOST_SHOWN})"));
            let message = format!("FAIL: cycle %0d: {name} is %h, expected %h");
            line(4, format!("$display(\"{message}\", {cycle}, {name}, {want});"));
            line(3, format!("{errors} = {errors} + 1;"));
            line(2, "end".to_string());
        }
        for clock in 0..self.clocks.len() {
            let edge = self.level(clock, true);
            match self.clocks.len() {
                1 => line(2, edge),
                _ => line(2, format!("if ({}[{clock}]) {edge}", self.own("rising"))),
            }
        }
        line(1, "end".to_string());
        // An assertion that fails at the last edge must report before the verdict.
        line(1, "#1;".to_string());
        line(1, format!("if ({errors} == 0) $display(\"PASS: {steps} cycles\");"));
        line(1, "else begin".to_string());
        line(2, format!("$display(\"FAIL: %0d mismatches in {steps} cycles\", {errors});"));
        for text in stop() {
            line(if text.starts_with('`') { 0 } else { 2 }, text);
        }
        line(1, "end".to_string());
        line(1, "$finish;".to_string());
        out.push("end".to_string());
        out
    }

    /// The task that fills the memories of all tables.
    fn fill(&self, tables: &[Table]) -> Vec<String> {
        let mut out = vec![String::new(), format!("task {};", self.own("fill")), "begin".to_string()];
        out.extend(tables.iter().flat_map(Table::calls));
        out.extend(["end".to_string(), "endtask".to_string()]);
        out
    }

    /// Sets a clock to its level after an edge at which its registers act, or after the other one.
    fn level(&self, clock: usize, is_past_edge: bool) -> String {
        format!("{} = 1'b{};", self.clocks[clock], u8::from(is_past_edge != self.falls[clock]))
    }

    /// The waits before and after the middle of a step.
    fn waits(&self) -> (String, String) {
        match self.period {
            Some(period) => {
                let wait = |ps: u64| if ps < 1 << 31 { format!("#{ps};") } else { format!("#(64'd{ps});") };
                (wait(period / 2), wait(period - period / 2))
            }
            None => {
                let gap = self.own("gap");
                (format!("#({gap} / 2);"), format!("#({gap} - {gap} / 2);"))
            }
        }
    }
}

/// The values side by side, the first the most significant.
fn joined(values: impl DoubleEndedIterator<Item = Bits>) -> Bits {
    Bits::join(&values.rev().collect::<Vec<_>>())
}

fn names(ports: &[Port]) -> String {
    let names: Vec<&str> = ports.iter().map(|port| port.0).collect();
    format!("{{{}}}", names.join(", "))
}

fn generate_start(start: &Start, names: &mut Names) -> Vec<String> {
    let lines = start.usual(names);
    if lines.is_empty() {
        return Vec::new();
    }
    let mut out = vec![String::new()];
    out.extend(start.genvars.iter().map(|genvar| format!("genvar {genvar};")));
    out.push("generate".to_string());
    out.extend(lines.into_iter().map(|line| format!("    {line}")));
    out.push("endgenerate".to_string());
    out
}
