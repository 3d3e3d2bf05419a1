//! Search for an invariant: a condition that holds at the start, stays true, and implies every assertion (IC3, also
//! called property directed reachability). ABC finds it, bit by bit; it needs no number of clocks.

use crate::edges::Edges;
use crate::model::{read_and_flatten, run_yosys, verilog_in};
use crate::prepare::Prepared;
use crate::process::{run, temporary};
use crate::solver::{Halt, Patience};
use std::time::Instant;

/// ABC, as Yosys brings it along.
pub const ABC: &str = "yosys-abc";
/// The seconds that ABC may take, if nobody says otherwise.
const MOST_SECONDS: u64 = 60;

/// Whether an invariant is found that implies all assertions. Without ABC there is none.
///
/// # Errors
///
/// Yosys fails, the time is over, or the watcher asks to stop.
pub fn is_found(prepared: &Prepared, edges: Edges, patience: &Patience) -> Result<bool, Halt> {
    let folder = temporary()?;
    let files = verilog_in(folder.path(), prepared, edges)?;
    let script = format!(
        "{}; delete t:$cover; delete -output; techmap; opt_clean; aigmap; opt_clean; write_aiger -zinit -I -B model.aig",
        read_and_flatten(&files, &prepared.design.top().name, edges)
    );
    run_yosys(folder.path(), &script, patience)?;
    let left = patience.end.map(|end| end.saturating_duration_since(Instant::now()).as_secs());
    let seconds = left.unwrap_or(MOST_SECONDS).clamp(1, MOST_SECONDS);
    let commands = format!("read_aiger model.aig; fold; orpos; pdr -T {seconds}");
    let found = run(ABC, &["-c", &commands], folder.path(), patience)?;
    let said = found.map(|(_, output)| output).unwrap_or_default();
    if left.is_some_and(|left| left <= MOST_SECONDS) && said.contains("Reached timeout") {
        return Err(Halt::Late);
    }
    Ok(said.contains("Property proved"))
}
