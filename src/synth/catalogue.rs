//! All blocks on a device, as rows of a table.

use super::flow::{Measured, Outcome, Task, Workspace};
use super::report::Resource;
use super::sizes::sizes;
use crate::block::entries;
use crate::shell::{Exit, Failure, Progress, terminal};
use tilewright_gen::verilog;
use tilewright_hdl::catalog::Entry;

/// Measures every block, or those from one on, and prints a row as soon as it is known. `task` begins a block.
///
/// # Errors
/// As for one block.
pub fn measure_all<'a>(from: Option<&Entry>, task: impl Fn() -> Task<'a>) -> Result<(), Failure> {
    let first = task();
    let is_before = |entry: &&Entry| from.is_some_and(|from| from.name != entry.name);
    let all: Vec<&'static Entry> = entries().skip_while(is_before).collect();
    let [yosys, nextpnr] = [&first.programs.yosys, &first.programs.nextpnr].map(|it| &it.version);
    terminal::print(&format!(
        "{}, {yosys}, {nextpnr}, seed {}\n\n{}",
        first.device.chip().part(),
        first.seed,
        head(&first)
    ))?;
    let progress = Progress::new();
    for (done, entry) in all.iter().enumerate() {
        progress.show(entry.name, done as f64 / all.len() as f64);
        for settings in sizes(entry.name) {
            let values = entry.values(settings.iter().copied())?;
            let design = entry.design(&values)?;
            let (files, space) = (verilog(&design), Workspace::new()?);
            let outcome = task().measure(&design, &files, &space);
            let is_done = matches!(&outcome, Ok(Outcome::Measured(it)) if it.lacking.is_empty());
            terminal::print(&row(entry.name, settings, outcome, &first)?)?;
            if is_done {
                break;
            }
        }
    }
    Ok(())
}

fn head(task: &Task) -> String {
    let counted: Vec<&str> = task.device.counted().iter().map(|it| it.name).collect();
    let rule = "|---".repeat(counted.len() + 4);
    format!("| block | at | {} | MHz | slowest path |\n{rule}|\n", counted.join(" | "))
}

fn row(
    name: &str,
    settings: &[(&str, u64)],
    outcome: Result<Outcome, Failure>,
    task: &Task,
) -> Result<String, Failure> {
    let at: Vec<String> = settings.iter().map(|(name, value)| format!("{name} {value}")).collect();
    let blank = " |".repeat(task.device.counted().len());
    let rest = match outcome {
        Ok(Outcome::Measured(measured)) => cells(&measured),
        Ok(Outcome::Late) => format!("{blank} | not done in time"),
        Err(failure) if failure.exit == Exit::NoTool => format!("{blank} | {}", failure.sentence.replace('|', " ")),
        Err(failure) => return Err(failure),
    };
    Ok(format!("| {name} | {} | {rest} |\n", at.join(", ")))
}

fn cells(measured: &Measured) -> String {
    let counts: Vec<String> = measured.resources.iter().map(|it| it.used.to_string()).collect();
    let (mhz, path) = if measured.lacking.is_empty() {
        let speeds: Vec<String> = measured.clocks.iter().map(|it| format!("{:.0}", it.mhz)).collect();
        let slowest = measured.clocks.iter().min_by(|a, b| a.mhz.total_cmp(&b.mhz));
        let ends = slowest.and_then(|it| Some((it.path.first()?, it.path.last()?)));
        let path = ends.map(|(from, to)| format!("`{}` to `{}`", from.signal, to.signal)).unwrap_or_default();
        (speeds.join(", "), path.replace('|', "\\|"))
    } else {
        let short = |it: &Resource| format!("{} {} too many", it.used - it.available, it.name);
        let short: Vec<String> = measured.lacking.iter().map(short).collect();
        (String::new(), format!("does not fit: {}", short.join(", ")))
    };
    format!("{} | {mhz} | {path}", counts.join(" | "))
}
