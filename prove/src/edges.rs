//! Designs of several clocks: a state of the formulas is an instant at which one or more of them have an edge.
//!
//! A clock's port does not have its level there, but says whether the clock has an edge. What acts on the clock acts at
//! such instants alone. Two sets of runs are searched:
//!
//! - *any edges*: the clocks have edges in any sequence, one or several at once. A proof so is one for all periods and
//!   phases, and also for clocks that drift. What fails so may be impossible with the clocks at hand.
//! - *exact edges*: those of the simulator. For each clock a register counts the time to its next edge, in units of the
//!   greatest common divisor of all periods. So the hyperperiod may have any length.
//!
//! All resets become active together, and stay so until each clock has had an edge, as in `Simulation::reset`.

use tilewright_gen::VerilogFile;
use tilewright_hdl::ir::Clock;
use tilewright_hdl::{DEFAULT_PERIOD, Design};

/// The edges that clocks have in the runs of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edges {
    /// Those of one clock, or of none.
    One,
    /// One or more of several clocks at a time, in any sequence.
    Any,
    /// Those of the periods, as in the simulator.
    Exact,
}

/// What makes a register of each clock one of instants.
pub const INSTANTS: (&str, &str) = ("instants.map", include_str!("instants.v"));

impl Edges {
    /// The commands of Yosys for memories, which are not yet registers.
    pub fn of_memories(self) -> &'static str {
        match self {
            Edges::One => "",
            _ => "techmap -autoproc -map instants.map t:$mem_v2 r:WR_PORTS>0 %i; opt_clean;",
        }
    }

    /// The commands of Yosys for registers, which then act without a clock.
    pub fn of_registers(self) -> &'static str {
        match self {
            Edges::One => "async2sync; dffunmap",
            _ => "dffunmap; techmap -autoproc -map instants.map; opt_expr -keepdc; opt_clean",
        }
    }

    /// Makes statements count at the edges of their clock alone, and states which edges there are.
    pub fn state(self, design: &Design, files: &mut [VerilogFile]) {
        if self == Edges::One {
            return;
        }
        for file in &mut *files {
            file.text = gated(&file.text);
        }
        let top = format!("{}.v", design.top().name);
        let file = files.iter_mut().find(|file| file.name == top).expect("the top module has a file");
        let (before, after) = file.text.rsplit_once("\nendmodule").expect("a file has a module");
        file.text = format!("{before}\n{}endmodule{after}", self.schedule(&design.top().clocks));
    }

    /// Which edges and resets there are, in Verilog.
    fn schedule(self, clocks: &[Clock]) -> String {
        let any: Vec<&str> = clocks.iter().map(|clock| &*clock.port).collect();
        let mut text = format!("    always @* assume ({});\n", any.join(" | "));
        if self == Edges::Exact {
            text += &exact(clocks);
        }
        text + &resets(clocks)
    }
}

/// The period in picoseconds.
fn period(clock: &Clock) -> u64 {
    clock.period.unwrap_or(DEFAULT_PERIOD).picoseconds()
}

/// The periods of clocks in units of their greatest common divisor.
fn periods(clocks: &[Clock]) -> Vec<u64> {
    let unit = clocks.iter().map(period).fold(0, gcd);
    clocks.iter().map(|clock| period(clock) / unit).collect()
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The time of each instant in picoseconds, and the clocks with an edge. Without clocks there is an instant each 10 ns.
pub fn instants(clocks: &[Clock]) -> impl Iterator<Item = (u64, Vec<usize>)> {
    let periods: Vec<u64> = clocks.iter().map(period).collect();
    let mut next = periods.clone();
    let mut idle = 0;
    std::iter::from_fn(move || {
        idle += DEFAULT_PERIOD.picoseconds();
        let now = next.iter().min().copied().unwrap_or(idle);
        let rising: Vec<usize> = (0..next.len()).filter(|&clock| next[clock] == now).collect();
        rising.iter().for_each(|&clock| next[clock] += periods[clock]);
        Some((now, rising))
    })
}

/// Edges at the times of the periods. Each clock has its first one after one period.
fn exact(clocks: &[Clock]) -> String {
    let periods = periods(clocks);
    let most = periods.iter().max().copied().unwrap_or(1);
    let width = u64::BITS - most.leading_zeros();
    let left = |index: usize| format!("\\edges.left{index} ");
    let mut text = String::new();
    let mut least = String::new();
    for (index, (clock, period)) in clocks.iter().zip(&periods).enumerate() {
        let (left, port, literal) = (left(index), &clock.port, format!("{width}'d{period}"));
        text += &format!(
            "    reg [{}:0] {left} = {literal};\n    always @($global_clock) {left} <= {port} ? {literal} : {left} - \\edges.least ;\n    \
             always @* assume ({port} == ({left} == \\edges.least ));\n    always @* assume ({left} != 0 && {left} <= {literal});\n",
            width - 1
        );
        least = if index == 0 { left } else { format!("({left} < {least} ? {left} : {least})") };
    }
    let just = clocks.iter().enumerate().map(|(index, _)| format!("{}== {width}'d{}", left(index), periods[index]));
    let just = just.collect::<Vec<_>>().join(" || ");
    format!(
        "    wire [{}:0] \\edges.least ;\n{text}    assign \\edges.least = {least};\n    always @* assume ({just});\n",
        width - 1
    )
}

/// Resets that are active together until each of their clocks has had an edge.
fn resets(clocks: &[Clock]) -> String {
    let active = |clock: &Clock| {
        let port = clock.reset.as_ref()?;
        Some(if clock.kind.is_active_low() { format!("!{port}") } else { port.clone() })
    };
    let with_reset: Vec<(&str, String)> =
        clocks.iter().filter_map(|clock| Some((&*clock.port, active(clock)?))).collect();
    let Some((_, first)) = with_reset.first().filter(|_| with_reset.len() > 1) else { return String::new() };
    let mut text = format!("    reg \\edges.reset = 1'b0;\n    always @($global_clock) \\edges.reset <= {first};\n");
    let mut all = Vec::new();
    for (index, (port, active)) in with_reset.iter().enumerate() {
        let seen = format!("\\edges.seen{index} ");
        text += &format!(
            "    reg {seen} = 1'b0;\n    always @($global_clock) {seen} <= {first} && ({port} || {seen});\n    \
             always @* assume (({first}) == ({active}));\n"
        );
        all.push(seen);
    }
    text + &format!("    always @* assume (!\\edges.reset || {first} || ({}));\n", all.join(" && "))
}

/// The text with the statements for formal tools at the edges of their clock.
fn gated(text: &str) -> String {
    let (mut is_formal, mut clock) = (false, None);
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        let code = line.trim();
        match code {
            "`ifdef FORMAL" => is_formal = true,
            "`else" | "`endif" => is_formal = false,
            _ => {}
        }
        if let Some(edge) = code.strip_prefix("always @(") {
            clock = edge.split_once(')').and_then(|(edge, _)| edge.split(' ').nth(1));
        }
        let gate = clock.filter(|_| is_formal).and_then(|clock| at_edge(line, clock));
        out += &gate.unwrap_or_else(|| line.to_owned());
        out.push('\n');
    }
    out
}

/// A statement that counts where its clock has an edge; `None` if the line is none.
fn at_edge(line: &str, clock: &str) -> Option<String> {
    let (indent, code) = line.split_at(line.len() - line.trim_start().len());
    if ["assert (", "assume (", "cover ("].iter().any(|word| code.starts_with(word)) {
        return Some(format!("{indent}if ({clock}) {code}"));
    }
    let rest = code.strip_prefix("if (")?;
    Some(format!("{indent}if ({clock} && {rest}"))
}
