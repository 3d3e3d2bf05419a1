//! Both modules side by side, with the same inputs.

use super::circuit::Circuit;
use super::theirs;
use crate::Error;
use crate::edges::Edges;
use crate::model::{TO_BITS, YOSYS, run_yosys, unwritable, verilog_in};
use crate::prepare::Prepared;
use crate::solver::{Halt, Patience};
use std::fmt::Write;
use std::path::Path;
use tilewright_gen::tools::{WITH_MODELS, sources};
use tilewright_hdl::Design;

/// The design's name among the modules that are compared.
const OURS: &str = "tilewright_ours";
const MITER: &str = "tilewright_miter";
/// What the names of the design's outputs and of the module's begin with. A port of a design has no `$`.
pub const OF_OURS: &str = "ours$";
pub const OF_THEIRS: &str = "theirs$";
/// Neither the reset is active nor have the inputs the values with which a run begins.
pub const QUIET: &str = "is$quiet";
/// The outputs differ in a clock in which they are compared.
pub const DIFFERENT: &str = "is$different";

/// The circuit of both modules, in bits.
///
/// # Errors
///
/// Yosys fails.
pub fn circuit(
    prepared: &Prepared,
    begin: &[(String, u64)],
    folder: &Path,
    patience: &Patience,
) -> Result<Circuit, Halt> {
    let files = verilog_in(folder, prepared, Edges::One)?;
    let design = &prepared.design;
    std::fs::write(folder.join("miter.v"), text(design, begin)).map_err(unwritable)?;
    let (sources, top, netlist) = (sources(&files).join(" "), &design.top().name, theirs::NETLIST);
    // What starts without a value is zero: that comes last, as it would also make zeros of what is undefined.
    let script = format!(
        "read_verilog -formal {WITH_MODELS} {sources}; hierarchy -check -top {top}; proc; flatten; opt_clean; \
         rename -top {OURS}; design -stash ours; read_rtlil {netlist}; \
         design -copy-from ours -as {OURS} {OURS}; read_verilog miter.v; hierarchy -check -top {MITER}; \
         proc; flatten; opt_expr -keepdc; opt_clean; {TO_BITS}; setundef -zero -init; \
         techmap; opt_expr -keepdc; opt_clean; setundef -undriven -anyseq; setundef -zero -init; opt_clean; aigmap; opt_clean; \
         write_aiger -symbols -zinit -I both.aig"
    );
    run_yosys(folder, &script, patience)?;
    let bytes = std::fs::read(folder.join("both.aig")).map_err(unwritable)?;
    let unread = || Error::tool(YOSYS.program, "its circuit of both modules cannot be read");
    Circuit::read(&bytes).ok_or_else(|| unread().into())
}

/// A module with both.
fn text(design: &Design, begin: &[(String, u64)]) -> String {
    let top = design.top();
    let clock = top.clocks.first();
    let clocks = clock.iter().flat_map(|clock| [Some(&clock.port), clock.reset.as_ref()]).flatten();
    let clocks: Vec<(&str, u32)> = clocks.map(|name| (name.as_str(), 1)).collect();
    let inputs = top.inputs.iter().map(|it| (it.name.as_str(), theirs::width(top, it.node)));
    let inputs: Vec<(&str, u32)> = clocks.into_iter().chain(inputs).collect();
    let outputs: Vec<(&str, u32)> =
        top.outputs.iter().map(|it| (it.name.as_str(), theirs::width(top, it.node))).collect();
    let mut text = format!("module {MITER} (\n");
    if clock.is_none() {
        text += "    input is$end,\n";
    }
    for (name, width) in &inputs {
        let _ = writeln!(text, "    input [{}:0] {name},", width - 1);
    }
    for (name, width) in &outputs {
        let high = width - 1;
        let _ = writeln!(text, "    output [{high}:0] {OF_OURS}{name},\n    output [{high}:0] {OF_THEIRS}{name},");
    }
    let _ = writeln!(
        text,
        "    output {QUIET},
    output {DIFFERENT}
);"
    );
    for (module, prefix) in [(OURS, OF_OURS), (theirs::NAME, OF_THEIRS)] {
        let inputs = inputs.iter().map(|(name, _)| format!(".{name}({name})"));
        let outputs = outputs.iter().map(|(name, _)| format!(".{name}({prefix}{name})"));
        let pins: Vec<String> = inputs.chain(outputs).collect();
        let _ = writeln!(text, "    {module} {module}_instance ({});", pins.join(", "));
    }
    let reset = clock.and_then(|clock| Some((clock.reset.as_ref()?, clock.kind.is_active_low())));
    let in_reset =
        reset.map_or("1'b0".to_owned(), |(name, is_low)| if is_low { format!("!{name}") } else { name.clone() });
    let _ = writeln!(text, "    wire is$in_reset = {in_reset};");
    // ABC searches runs of circuits with a register alone.
    text += match clock {
        Some(_) => "    wire is$over = 1'b0;\n",
        None => "    reg is$over = 1'b0;\n    always @(posedge is$end) is$over <= is$end;\n",
    };
    let pair = |(name, _): &(&str, u32)| format!("({OF_OURS}{name} != {OF_THEIRS}{name})");
    let pairs: Vec<String> = outputs.iter().map(pair).collect();
    let again = begin.iter().map(|(name, value)| format!(" & {name} == {value}")).collect::<String>();
    let again = if begin.is_empty() { "1'b0".to_owned() } else { format!("1'b1{again}") };
    let _ = writeln!(text, "    assign {QUIET} = !is$in_reset & !({again});");
    let differ = pairs.join(" | ");
    let _ = writeln!(text, "    assign {DIFFERENT} = !is$over & !is$in_reset & ({differ});\nendmodule");
    text
}
