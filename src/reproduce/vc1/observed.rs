//! The values of signals of the running circuit: its waveform, read while it is written.

use std::fs::File;
use std::io::{BufReader, PipeReader, Read, pipe};
use std::os::fd::OwnedFd;
use std::thread;
use tilewright_machines::Error;
use tilewright_machines::vc1::Machine;
use tilewright_sim::Vcd;
use vcd::{Command, IdCode, Parser, ScopeItem, Value};

/// Runs a machine. Whenever one of the signals changes, `seen` gets the time and the values of all of them before the change.
///
/// # Errors
/// The errors of the run.
pub fn observed<T>(
    mut machine: Machine,
    signals: &[String],
    seen: impl FnMut(u64, &[u64]) + Send,
    run: impl FnOnce(Machine) -> Result<T, Error>,
) -> Result<T, Error> {
    let failed = |source| tilewright_sim::Error::Trace { path: "the signals that are looked at".into(), source };
    let (reader, writer) = pipe().map_err(failed)?;
    thread::scope(|scope| {
        let read = scope.spawn(|| read(reader, signals, seen));
        let waves = Vcd::into("the signals that are looked at", File::from(OwnedFd::from(writer)));
        let waves = signals.iter().fold(waves, |waves, signal| waves.only(signal));
        // If tracing fails, drop the machine and its end of the pipe before waiting for the reader.
        let ran = match machine.simulation().trace(waves) {
            Ok(()) => run(machine),
            Err(error) => {
                drop(machine);
                Err(error.into())
            }
        };
        let read = read.join().expect("the reader ends with the pipe");
        ran.and_then(|ran| Ok(read.map(|()| ran).map_err(failed)?))
    })
}

/// Reads to the end in any case, as the writer would otherwise wait for ever.
fn read(reader: PipeReader, signals: &[String], mut seen: impl FnMut(u64, &[u64])) -> Result<(), std::io::Error> {
    let mut reader = BufReader::new(reader);
    let read = changes(&mut reader, signals, &mut seen);
    std::io::copy(&mut reader, &mut std::io::sink())?;
    read
}

fn changes(
    reader: &mut BufReader<impl Read>,
    signals: &[String],
    seen: &mut impl FnMut(u64, &[u64]),
) -> Result<(), std::io::Error> {
    let mut parser = Parser::new(reader);
    let header = parser.parse_header()?;
    let mut places: Vec<(IdCode, usize)> = Vec::new();
    for item in header
        .items
        .iter()
        .filter_map(|it| if let ScopeItem::Scope(top) = it { Some(&top.items) } else { None })
        .flatten()
    {
        let ScopeItem::Var(variable) = item else { continue };
        if let Some(place) = signals.iter().position(|signal| *signal == variable.reference) {
            places.push((variable.code, place));
        }
    }
    assert_eq!(places.len(), signals.len(), "the machine has these signals: {signals:?}");
    places.sort_unstable();
    let place = |code: IdCode| places.binary_search_by_key(&code, |(code, _)| *code).ok().map(|at| places[at].1);
    let mut values = vec![0; signals.len()];
    for command in parser {
        match command? {
            Command::Timestamp(time) => seen(time, &values),
            Command::ChangeScalar(code, value) => {
                if let Some(place) = place(code) {
                    values[place] = u64::from(value == Value::V1);
                }
            }
            Command::ChangeVector(code, vector) => {
                if let Some(place) = place(code) {
                    values[place] = vector.iter().fold(0, |sum, bit| sum << 1 | u64::from(bit == Value::V1));
                }
            }
            _ => {}
        }
    }
    Ok(())
}
