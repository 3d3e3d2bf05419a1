//! The formulas of a design, which Yosys makes of its Verilog.

use crate::Error;
use crate::edges::{Edges, INSTANTS};
use crate::formulas::Formulas;
use crate::places::{Places, places};
use crate::prepare::Prepared;
use crate::process::{run, temporary};
use crate::solver::{Halt, Patience};
use std::collections::BTreeMap;
use std::path::Path;
use tilewright_gen::tools::{Missing, WITH_MODELS, sources};
use tilewright_gen::{VerilogFile, verilog};

/// What to do where Yosys is missing.
pub const YOSYS: Missing = Missing { program: "yosys", remedy: "install it (Debian: apt-get install yosys)" };
/// The file of the formulas.
const FORMULAS: &str = "model.smt2";

/// The formulas of a design: functions of its state, in which inputs and outputs are included.
pub struct Model {
    pub formulas: Formulas,
    /// The top module, with which all functions begin.
    pub top: String,
    /// The width of each wire, by its name.
    pub wires: BTreeMap<String, u32>,
    /// The statements whose condition is not constant, each in one instance and lane.
    pub goals: Vec<Goal>,
}

/// A statement in one instance and lane.
pub struct Goal {
    /// The statement's number.
    pub number: usize,
    /// The function of the state.
    pub function: String,
    pub kind: GoalKind,
}

/// What a goal is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GoalKind {
    /// It holds, or a run shows that it does not.
    Assertion,
    /// Its condition is false, or a run shows that it is not.
    Cover,
    /// The condition of an assertion also while the reset is active. Where it holds, induction knows more.
    Helper,
}

/// Makes the formulas of a design whose clocks have these edges.
///
/// # Errors
///
/// Yosys is missing, or it fails.
pub fn model(prepared: &Prepared, edges: Edges, patience: &Patience) -> Result<Model, Halt> {
    let folder = temporary()?;
    let mut files = verilog(&prepared.design);
    let places = places(&files);
    edges.state(&prepared.design, &mut files);
    let ends = add_helpers(&mut files, &places);
    write(folder.path(), &files)?;
    let read_all = read_and_flatten(&files, &prepared.design.top().name, edges);
    run_yosys(folder.path(), &format!("{read_all}; write_smt2 -stbv -wires {FORMULAS}"), patience)?;
    let text = std::fs::read_to_string(folder.path().join(FORMULAS)).map_err(unwritable)?;
    Ok(read(text, &places, &ends)?)
}

/// The files of a design, written into a folder.
///
/// # Errors
///
/// They cannot be written.
pub fn verilog_in(folder: &Path, prepared: &Prepared, edges: Edges) -> Result<Vec<VerilogFile>, Error> {
    let mut files = verilog(&prepared.design);
    edges.state(&prepared.design, &mut files);
    write(folder, &files)?;
    Ok(files)
}

fn write(folder: &Path, files: &[VerilogFile]) -> Result<(), Error> {
    let files = files.iter().map(|file| (&*file.name, &*file.text)).chain([INSTANTS]);
    files.into_iter().try_for_each(|(name, text)| std::fs::write(folder.join(name), text)).map_err(unwritable)
}

pub fn unwritable(error: std::io::Error) -> Error {
    Error::Refused(format!("a temporary file cannot be written: {error}"))
}

/// The commands that leave one flat module without memories. Passes that could choose a value for something undefined are
/// left out, and what is undefined has any value.
pub const TO_BITS: &str = "memory_collect; memory_map; opt_expr -keepdc; opt_clean; chformal -early; async2sync; \
                           dffunmap; setundef -undriven -anyseq; opt_clean";

/// The commands that make one module of the files, without memories. Passes that could choose a value for something
/// undefined are left out, and what is undefined has any value.
pub fn read_and_flatten(files: &[VerilogFile], top: &str, edges: Edges) -> String {
    let sources = sources(files).join(" ");
    let (memories, registers) = (edges.of_memories(), edges.of_registers());
    format!(
        "read_verilog -formal {WITH_MODELS} {sources}; hierarchy -check -top {top}; proc; flatten; \
         opt_expr -keepdc; opt_clean; memory_collect; {memories} memory_map; opt_expr -keepdc; opt_clean; \
         chformal -early; {registers}; setundef -undriven -anyseq; opt_clean"
    )
}

/// Runs commands of Yosys in a folder.
///
/// # Errors
///
/// Yosys is missing, or it fails.
pub fn run_yosys(folder: &Path, script: &str, patience: &Patience) -> Result<(), Halt> {
    match run(YOSYS.program, &["-q", "-p", script], folder, patience)? {
        Some((true, _)) => Ok(()),
        Some((false, output)) => Err(Error::tool(YOSYS.program, output).into()),
        None => Err(Error::from(YOSYS).into()),
    }
}

/// For each line with a helper, the end of its first statement.
type Ends = BTreeMap<(String, u32), u32>;

/// Repeats assertions, without their condition that the reset is not active, in the same lines.
fn add_helpers(files: &mut [VerilogFile], places: &Places) -> Ends {
    let mut ends = Ends::new();
    for file in files {
        let with_helper = |(number, line): (u32, &str)| {
            let place = (file.name.clone(), number);
            let helped = places.contains_key(&place).then(|| with_helper(line)).flatten();
            helped.map_or_else(
                || line.to_owned(),
                |(line, end)| {
                    ends.insert(place, end);
                    line
                },
            )
        };
        file.text = (1..).zip(file.text.lines()).map(with_helper).collect::<Vec<_>>().join("\n") + "\n";
    }
    ends
}

/// A line `if (..) assert (..);` with the assertion once more, and the end of the first one.
fn with_helper(line: &str) -> Option<(String, u32)> {
    let (code, place) = line.rsplit_once(" // ")?;
    let code = code.trim_end();
    let (_, statement) = code.split_once(") assert (").filter(|_| code.ends_with(");"))?;
    Some((format!("{code} assert ({statement} // {place}"), code.len() as u32))
}

/// Reads what the comments of the formulas tell.
fn read(text: String, places: &Places, ends: &Ends) -> Result<Model, Error> {
    let (mut top, mut wires, mut goals) = (None, BTreeMap::new(), Vec::new());
    for line in text.lines().filter_map(|line| line.strip_prefix("; yosys-smt2-")) {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["topmod", name] => top = Some(name.to_owned()),
            ["wire" | "input" | "output" | "register", name, width] => {
                wires.insert(name.to_owned(), width.parse().map_err(|_| unknown(line))?);
            }
            [kind @ ("assert" | "cover"), id, .., origin] => {
                // Of a statement in an instance, the places of the instances around it may be there, too.
                let mut origins = origin.split('|').filter_map(place_of);
                let is_known =
                    |(file, row, column)| Some(((file, row), column)).filter(|it| places.contains_key(&it.0));
                let (place, column) = origins.find_map(is_known).ok_or_else(|| unknown(line))?;
                let number = places[&place];
                let (letter, kind) = match kind {
                    "cover" => ("c", GoalKind::Cover),
                    _ if ends.get(&place).is_some_and(|end| column > *end) => ("a", GoalKind::Helper),
                    _ => ("a", GoalKind::Assertion),
                };
                goals.push(Goal { number, function: format!("{letter} {id}"), kind });
            }
            _ => {}
        }
    }
    let top = top.ok_or_else(|| unknown("no top module"))?;
    Ok(Model { formulas: Formulas::read(&text), top, wires, goals })
}

fn unknown(line: &str) -> Error {
    Error::tool(YOSYS.program, format!("its formulas cannot be read: {line}"))
}

/// The file, the first line and the first column of a place such as `queue.v:97.18-97.59`.
fn place_of(text: &str) -> Option<(String, u32, u32)> {
    let (file, place) = text.rsplit_once(':')?;
    let (line, column) = place.split('-').next()?.split_once('.')?;
    Some((file.to_owned(), line.parse().ok()?, column.parse().ok()?))
}
