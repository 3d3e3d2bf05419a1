//! A strip program in lines.

use std::fmt::Write;

use rustc_hash::FxHashMap;

use super::names::{BINARIES, COMPARISONS, LOADS, STORES, UNARIES, name};
use super::operation::{Binary, Operation};
use super::program::{Loop, Program, Statement};
use super::value::{Bytes, Type, Value};

/// What is at places that a program accesses; it ends the line of a load or a store.
pub(in crate::engine) struct Notes<'n> {
    /// At an offset in the state.
    pub state: &'n dyn Fn(usize) -> Option<String>,
    /// At a known address.
    pub address: &'n dyn Fn(usize) -> Option<String>,
}

impl Notes<'_> {
    /// None.
    pub const NONE: Notes<'static> = Notes { state: &|_| None, address: &|_| None };
}

impl Program {
    /// The program, a line for each statement. Constants stand where they are used; values are numbered in the sequence of their lines.
    pub fn text(&self, notes: &Notes) -> String {
        self.text_and_addresses(notes).0
    }

    /// The same, and the address behind each number.
    pub fn text_and_addresses(&self, notes: &Notes) -> (String, Vec<usize>) {
        let mut text = Text {
            program: self,
            notes,
            out: String::new(),
            depth: 0,
            values: FxHashMap::default(),
            addresses: Vec::new(),
        };
        for (value, name) in Program::PARAMETERS.into_iter().zip(["state", "argument", "scratch"]) {
            text.values.insert(value, name.to_owned());
        }
        if self.scratch > 0 {
            text.line(&format!("scratch {}", self.scratch), None);
        }
        if self.stack_of_called > 0 {
            text.line(&format!("stack {}", self.stack_of_called), None);
        }
        text.region(&self.body);
        (text.out, text.addresses)
    }
}

/// A program that is being written.
struct Text<'p> {
    program: &'p Program,
    notes: &'p Notes<'p>,
    out: String,
    depth: usize,
    /// The names of values.
    values: FxHashMap<Value, String>,
    /// Known addresses, by number: what is there is another one in each run.
    addresses: Vec<usize>,
}

impl Text<'_> {
    fn line(&mut self, line: &str, note: Option<String>) {
        let (indent, line) = ("  ".repeat(self.depth), line.trim_end());
        let _ = match note {
            Some(note) => writeln!(self.out, "{indent}{line:<40} ; {note}"),
            None => writeln!(self.out, "{indent}{line}"),
        };
    }

    fn region(&mut self, region: &[Statement]) {
        region.iter().for_each(|statement| self.statement(statement));
    }

    fn inner(&mut self, region: &[Statement]) {
        self.depth += 1;
        self.region(region);
        self.depth -= 1;
    }

    /// Names a value that has none yet.
    fn define(&mut self, value: Value) -> String {
        let name = format!("v{}", self.values.len() - Program::PARAMETERS.len());
        self.values.insert(value, name.clone());
        name
    }

    /// The same, with its type.
    fn typed(&mut self, value: Value) -> String {
        format!("{}: {}", self.define(value), self.program.type_of(value))
    }

    /// A value where it is used.
    fn of(&mut self, value: Value) -> String {
        match &self.program.values[value.index()].0 {
            Operation::Constant(number) => number.to_string(),
            Operation::Address(address) => self.address(*address),
            Operation::Bytes(bytes) => bytes_text(bytes, self.program.type_of(value)),
            _ => self.values[&value].clone(),
        }
    }

    fn all(&mut self, values: &[Value]) -> String {
        values.iter().map(|value| self.of(*value)).collect::<Vec<_>>().join(" ")
    }

    fn address(&mut self, address: usize) -> String {
        let known = self.addresses.iter().position(|it| *it == address);
        let number = known.unwrap_or_else(|| {
            self.addresses.push(address);
            self.addresses.len() - 1
        });
        format!("@{number}")
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Let(value) => self.definition(*value),
            Statement::Call { function, arguments } => {
                let line = format!("call {} {}", self.of(*function), self.all(arguments));
                self.line(&line, None);
            }
            Statement::Store { value, aligned, address, offset } => {
                let ty = self.program.type_of(*value);
                let line =
                    format!("{} {ty} {} {}", name(STORES, *aligned), self.place(*address, *offset), self.of(*value));
                self.line(&line, self.note(*address, *offset));
            }
            Statement::If { flag, then, otherwise } => {
                let line = format!("if {}", self.of(*flag));
                self.line(&line, None);
                self.inner(then);
                if !otherwise.is_empty() {
                    self.line("else", None);
                    self.inner(otherwise);
                }
            }
            Statement::Switch { subject, table, regions } => {
                let table: Vec<String> = table.iter().map(ToString::to_string).collect();
                let line = format!("switch {} by {}", self.of(*subject), table.join(" "));
                self.line(&line, None);
                for (number, region) in regions.iter().enumerate() {
                    self.line(&format!("case {number}"), None);
                    self.inner(region);
                }
            }
            Statement::Loop(all) => self.repeat(all),
            Statement::LeaveUnless { flag, results } => {
                let program = self.program;
                let typed = |value: &Value| format!("{} {}", program.type_of(*value), self.of(*value));
                let results: Vec<String> = results.iter().map(typed).collect();
                let line = format!("leave unless {} with {}", self.of(*flag), results.join(" "));
                self.line(&line, None);
            }
            Statement::Then => self.line("then", None),
            Statement::Return(value) => {
                let line = format!("return {}", self.of(*value));
                self.line(&line, None);
            }
        }
    }

    fn definition(&mut self, value: Value) {
        let operation = &self.program.values[value.index()].0;
        let (right, note) = match operation {
            Operation::Constant(_) | Operation::Address(_) | Operation::Bytes(_) => return,
            Operation::Parameter => unreachable!("a parameter is not computed"),
            Operation::Unary(unary, of) => {
                let from = self.program.type_of(*of);
                (format!("{} {from} {}", name(UNARIES, *unary), self.of(*of)), None)
            }
            Operation::Binary(binary, x, y) => {
                (format!("{} {} {}", name(BINARIES, *binary), self.of(*x), self.of(*y)), None)
            }
            Operation::Compare(comparison, x, y) => {
                let of = self.program.type_of(*x);
                (format!("{} {of} {} {}", name(COMPARISONS, *comparison), self.of(*x), self.of(*y)), None)
            }
            Operation::Select(flag, x, y) => {
                (format!("select {} {} {}", self.of(*flag), self.of(*x), self.of(*y)), None)
            }
            Operation::Blend(mask, x, y) => (format!("blend {} {} {}", self.of(*mask), self.of(*x), self.of(*y)), None),
            Operation::Shuffle(x, y, bytes) => {
                let size = self.program.type_of(*x).bytes() as usize;
                let bytes: Vec<String> = bytes[..size].iter().map(ToString::to_string).collect();
                (format!("shuffle {} {} by {}", self.of(*x), self.of(*y), bytes.join(" ")), None)
            }
            Operation::Lane(of, lane) => {
                let from = self.program.type_of(*of);
                (format!("lane {lane} of {from} {}", self.of(*of)), None)
            }
            Operation::WithLane(vector, number, lane) => {
                (format!("set lane {lane} of {} to {}", self.of(*vector), self.of(*number)), None)
            }
            Operation::Load { load, aligned, address, offset } => {
                let line = format!("{} {}", name(LOADS, (*load, *aligned)), self.place(*address, *offset));
                (line, self.note(*address, *offset))
            }
            Operation::Call(function, arguments) => {
                (format!("call {} {}", self.of(*function), self.all(arguments)), None)
            }
        };
        let left = self.typed(value);
        self.line(&format!("{left} = {right}"), note);
    }

    fn repeat(&mut self, all: &Loop) {
        let Loop { parameters, start, body, again, end, results } = all;
        let start: Vec<String> = start.iter().map(|value| self.of(*value)).collect();
        let begins: Vec<String> =
            parameters.iter().zip(start).map(|(value, start)| format!("{} = {start}", self.typed(*value))).collect();
        self.line(&format!("loop {}", begins.join(", ")), None);
        self.inner(body);
        let mut line = match again {
            Some((flag, next)) => format!("again if {} with {}", self.of(*flag), self.all(next)),
            None => "once".to_owned(),
        };
        if !results.is_empty() {
            let end = self.all(end);
            let names: Vec<String> = results.iter().map(|value| self.typed(*value)).collect();
            let _ = write!(line, ", else {} = {end}", names.join(", "));
        }
        self.line(&line, None);
    }

    fn place(&mut self, address: Value, offset: i32) -> String {
        let address = self.of(address);
        match offset {
            0 => format!("[{address}]"),
            _ => format!("[{address} + {offset}]"),
        }
    }

    /// What is at an address and offset.
    fn note(&self, address: Value, offset: i32) -> Option<String> {
        match self.base(address)? {
            Base::State => (self.notes.state)(usize::try_from(offset).ok()?),
            Base::Known(address) => (self.notes.address)(address),
        }
    }

    /// The first one of the addresses that an address is a sum with.
    fn base(&self, address: Value) -> Option<Base> {
        match &self.program.values[address.index()].0 {
            Operation::Binary(Binary::Add, x, y) => self.base(*x).or_else(|| self.base(*y)),
            Operation::Address(address) => Some(Base::Known(*address)),
            _ => (address == Program::PARAMETERS[0]).then_some(Base::State),
        }
    }
}

/// Where an address begins.
enum Base {
    State,
    Known(usize),
}

/// The integers of a vector; one alone if all are equal.
fn bytes_text(bytes: &Bytes, ty: Type) -> String {
    let numbers: Vec<String> = bytes[..ty.bytes() as usize]
        .chunks(ty.element() as usize / 8)
        .map(|lane| lane.iter().rev().map(|byte| format!("{byte:02x}")).collect::<String>())
        .collect();
    match numbers.iter().all(|number| *number == numbers[0]) {
        true => format!("0x{}", numbers[0]),
        false => format!("(0x{})", numbers.join(" 0x")),
    }
}
