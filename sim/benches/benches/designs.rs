//! The speed of the simulator: `cargo bench -p tilewright-benches`, or `.. -- pim64 qt1` for some designs.

use std::ops::ControlFlow;
use std::process::ExitCode;
use std::time::Duration;
use tilewright_benches::{Effort, FORMAT, Report, Rivals, Subject, USUAL, measure};

fn main() -> ExitCode {
    match table() {
        Ok(report) => {
            print!("{report}");
            ExitCode::SUCCESS
        }
        Err(sentence) => {
            eprintln!("error: {sentence}");
            ExitCode::FAILURE
        }
    }
}

fn table() -> Result<Report, String> {
    // Cargo itself adds `--bench`.
    let asked: Vec<Subject> =
        std::env::args().skip(1).filter(|it| !it.starts_with("--")).map(|it| it.parse()).collect::<Result<_, _>>()?;
    let subjects = if asked.is_empty() { USUAL.to_vec() } else { asked };
    let effort = Effort { rounds: 5, time: Duration::from_secs(1) };
    let measured =
        subjects.into_iter().map(|it| measure(it, Rivals::default(), effort, &mut |_, _| ControlFlow::Continue(())));
    let designs = measured.collect::<Result<_, _>>().map_err(|error| error.to_string())?;
    Ok(Report { format: FORMAT, verilator: None, rounds: effort.rounds, designs })
}
