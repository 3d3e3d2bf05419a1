//! A strip program from its lines: what [`Program::text`] prints.

mod line;

use rustc_hash::FxHashMap;

use super::builder::Builder;
use super::names::{BINARIES, COMPARISONS, LOADS, STORES, UNARIES, named};
use super::operation::{Binary, Operation};
use super::program::{Loop, Program, Region, Statement};
use super::value::{Type, Value};
use line::Line;

impl Program {
    /// The program of these lines. `@0` is the first of the addresses. What follows `;` in a line is a note.
    ///
    /// # Errors
    /// A sentence with the number of the first line that is wrong, and with what it should have.
    pub fn parse(text: &str, addresses: &[usize]) -> Result<Program, String> {
        let lines = text.lines().enumerate().map(|(index, line)| Line::new(index + 1, line));
        let mut lines: Vec<Line> = lines.filter(|line| !line.words.is_empty()).collect();
        let (mut scratch, mut stack) = (0, 0);
        for (name, number) in [("scratch", &mut scratch), ("stack", &mut stack)] {
            if let Some(line) = lines.first_mut().filter(|line| line.words[0] == name) {
                line.skip(name)?;
                *number = line.number()?;
                line.end()?;
                lines.remove(0);
            }
        }
        let names = ["state", "argument", "scratch"].map(str::to_owned).into_iter().zip(Program::PARAMETERS).collect();
        let mut parser = Parser { b: Builder::new(128), lines, at: 0, names, addresses };
        parser.region(0)?;
        match parser.lines.get(parser.at) {
            Some(line) => Err(line.wrong(
                "does not belong here: indent what a loop, a branch or a case contains by two spaces, and nothing else",
            )),
            None => Ok(Program { scratch, stack_of_called: stack, ..parser.b.whole() }),
        }
    }
}

/// A program that is being read.
struct Parser<'a> {
    b: Builder,
    lines: Vec<Line>,
    /// The next line.
    at: usize,
    names: FxHashMap<String, Value>,
    addresses: &'a [usize],
}

impl Parser<'_> {
    /// The lines of this depth, into the open region.
    fn region(&mut self, depth: usize) -> Result<(), String> {
        while let Some(line) = self.lines.get(self.at).filter(|line| line.depth == depth) {
            let mut line = line.clone();
            if matches!(line.words[0].as_str(), "again" | "once" | "else" | "case") {
                return Ok(());
            }
            self.at += 1;
            self.statement(&mut line)?;
            line.end()?;
        }
        Ok(())
    }

    /// The lines below one, as a region.
    fn inner(&mut self, depth: usize) -> Result<Region, String> {
        self.b.open();
        self.region(depth + 1)?;
        Ok(self.b.close())
    }

    /// The next line, if it has this depth and begins with a word.
    fn follows(&mut self, depth: usize, word: &str) -> Option<Line> {
        let line = self.lines.get(self.at).filter(|line| line.depth == depth && line.words[0] == word)?;
        let line = Line { at: 1, ..line.clone() };
        self.at += 1;
        Some(line)
    }

    fn statement(&mut self, line: &mut Line) -> Result<(), String> {
        let word = line.next("a statement")?;
        let statement = match word.as_str() {
            "call" => {
                let (function, arguments) = self.call(line)?;
                Statement::Call { function, arguments }
            }
            "if" => {
                let flag = self.value(line, Type::I8)?;
                let then = self.inner(line.depth)?;
                let otherwise = match self.follows(line.depth, "else") {
                    Some(other) => {
                        other.end()?;
                        self.inner(line.depth)?
                    }
                    None => Region::new(),
                };
                Statement::If { flag, then, otherwise }
            }
            "switch" => {
                let subject = self.value(line, Type::I64)?;
                line.skip("by")?;
                let table = line.numbers()?;
                let mut regions = Vec::new();
                while let Some(mut case) = self.follows(line.depth, "case") {
                    case.skip(&regions.len().to_string())?;
                    case.end()?;
                    regions.push(self.inner(line.depth)?);
                }
                Statement::Switch { subject, table, regions }
            }
            "loop" => return self.repeat(line),
            "leave" => {
                line.skip("unless")?;
                let flag = self.value(line, Type::I8)?;
                line.skip("with")?;
                let mut results = Vec::new();
                while line.peek().is_some() {
                    let ty = line.ty()?;
                    results.push(self.value(line, ty)?);
                }
                Statement::LeaveUnless { flag, results }
            }
            "then" => Statement::Then,
            "return" => Statement::Return(self.value(line, Type::I64)?),
            word => match named(STORES, word) {
                Some(aligned) => {
                    let ty = line.ty()?;
                    let (address, offset) = self.place(line)?;
                    let value = self.value(line, ty)?;
                    Statement::Store { value, aligned, address, offset }
                }
                None => return self.definition(line, word),
            },
        };
        self.b.push(statement);
        Ok(())
    }

    fn repeat(&mut self, line: &mut Line) -> Result<(), String> {
        let (mut parameters, mut start) = (Vec::new(), Vec::new());
        while line.peek().is_some() {
            let (name, ty) = self.typed(line)?;
            line.skip("=")?;
            start.push(self.value(line, ty)?);
            parameters.push((name, ty));
            let _ = line.takes(",");
        }
        let parameters = parameters.into_iter().map(|(name, ty)| self.parameter(line, name, ty));
        let parameters = parameters.collect::<Result<Vec<_>, _>>()?;
        self.b.open();
        self.region(line.depth + 1)?;
        let types: Vec<Type> = parameters.iter().map(|value| self.b.type_of(*value)).collect();
        let (mut last, again) = if let Some(mut last) = self.follows(line.depth, "again") {
            last.skip("if")?;
            let flag = self.value(&mut last, Type::I8)?;
            last.skip("with")?;
            let next = types.into_iter().map(|ty| self.value(&mut last, ty)).collect::<Result<_, _>>()?;
            (last, Some((flag, next)))
        } else if let Some(last) = self.follows(line.depth, "once") {
            (last, None)
        } else {
            return Err(
                line.wrong("begins a loop without an end: add `once`, or `again if` and a flag, below its body")
            );
        };
        let mut results = Vec::new();
        if last.takes(",") {
            last.skip("else")?;
            while results.is_empty() || last.takes(",") {
                results.push(self.typed(&mut last)?);
            }
            last.skip("=")?;
        }
        let end = results.iter().map(|(_, ty)| self.value(&mut last, *ty)).collect::<Result<_, _>>()?;
        last.end()?;
        let results =
            results.into_iter().map(|(name, ty)| self.parameter(&last, name, ty)).collect::<Result<_, _>>()?;
        let body = self.b.close();
        self.b.repeat(Loop { parameters, start, body, again, end, results });
        Ok(())
    }

    /// A name and its type.
    fn typed(&mut self, line: &mut Line) -> Result<(String, Type), String> {
        let name = line.next("a value and its type")?;
        line.skip(":")?;
        Ok((name, line.ty()?))
    }

    fn parameter(&mut self, line: &Line, name: String, ty: Type) -> Result<Value, String> {
        let value = self.b.parameter(ty);
        self.name(line, name, value)?;
        Ok(value)
    }

    fn name(&mut self, line: &Line, name: String, value: Value) -> Result<(), String> {
        match self.names.insert(name.clone(), value) {
            None => Ok(()),
            Some(_) => Err(line.wrong(format_args!("defines `{name}` again: give it a name of its own"))),
        }
    }

    fn definition(&mut self, line: &mut Line, name: &str) -> Result<(), String> {
        if line.peek() != Some(":") {
            return Err(
                line.wrong("is no statement: begin it with one such as `store`, or with a value as in `v0: i64 =`")
            );
        }
        line.skip(":")?;
        let ty = line.ty()?;
        line.skip("=")?;
        let word = line.next("an operation")?;
        let operation = self.operation(line, &word, ty)?;
        let value = self.b.value(operation, ty);
        self.name(line, name.to_owned(), value)
    }

    fn operation(&mut self, line: &mut Line, word: &str, ty: Type) -> Result<Operation, String> {
        if let Some((load, aligned)) = named(LOADS, word) {
            let (address, offset) = self.place(line)?;
            return Ok(Operation::Load { load, aligned, address, offset });
        }
        if let Some(unary) = named(UNARIES, word) {
            let from = line.ty()?;
            return Ok(Operation::Unary(unary, self.value(line, from)?));
        }
        if let Some(binary) = named(BINARIES, word) {
            let (left, right) = match binary {
                Binary::Shl | Binary::Shr | Binary::Sar => (ty, Type::I64),
                Binary::Narrow { .. } if ty.is_vector() => (ty.widened(), ty.widened()),
                Binary::Swizzle | Binary::LookUp => (Type::TABLE, ty),
                _ => (ty, ty),
            };
            return Ok(Operation::Binary(binary, self.value(line, left)?, self.value(line, right)?));
        }
        if let Some(comparison) = named(COMPARISONS, word) {
            let of = line.ty()?;
            return Ok(Operation::Compare(comparison, self.value(line, of)?, self.value(line, of)?));
        }
        Ok(match word {
            "select" => Operation::Select(self.value(line, Type::I8)?, self.value(line, ty)?, self.value(line, ty)?),
            "blend" => Operation::Blend(self.value(line, ty)?, self.value(line, ty)?, self.value(line, ty)?),
            "shuffle" => {
                let (x, y) = (self.value(line, ty)?, self.value(line, ty)?);
                line.skip("by")?;
                let (numbers, size) = (line.numbers::<u8>()?, ty.bytes() as usize);
                if numbers.len() != size {
                    return Err(line.wrong(format_args!("chooses other than {size} bytes: write {size}")));
                }
                let mut bytes = [0; _];
                bytes[..size].copy_from_slice(&numbers);
                Operation::Shuffle(x, y, bytes)
            }
            "lane" => {
                let lane = line.number()?;
                line.skip("of")?;
                let from = line.ty()?;
                Operation::Lane(self.value(line, from)?, lane)
            }
            "set" => {
                line.skip("lane")?;
                let lane = line.number()?;
                line.skip("of")?;
                let vector = self.value(line, ty)?;
                line.skip("to")?;
                Operation::WithLane(vector, self.value(line, ty.of_lane())?, lane)
            }
            "call" => {
                let (function, arguments) = self.call(line)?;
                Operation::Call(function, arguments)
            }
            _ => {
                return Err(
                    line.wrong(format_args!("has `{word}`, which is no operation: write one such as `add` or `load`"))
                );
            }
        })
    }

    fn call(&mut self, line: &mut Line) -> Result<(Value, Vec<Value>), String> {
        let function = self.value(line, Type::ADDRESS)?;
        let mut arguments = Vec::new();
        while line.peek().is_some() {
            arguments.push(self.value(line, Type::I64)?);
        }
        Ok((function, arguments))
    }

    fn place(&mut self, line: &mut Line) -> Result<(Value, i32), String> {
        line.skip("[")?;
        let address = self.value(line, Type::ADDRESS)?;
        let offset = if line.takes("+") { line.number()? } else { 0 };
        line.skip("]")?;
        Ok((address, offset))
    }

    /// A value by name, or a constant of this type.
    fn value(&mut self, line: &mut Line, ty: Type) -> Result<Value, String> {
        let word = line.next("a value")?;
        if let Some(value) = self.names.get(&word) {
            return Ok(*value);
        }
        if let Some(number) = word.strip_prefix('@') {
            let address = number.parse::<usize>().ok().and_then(|number| self.addresses.get(number));
            let address = address.ok_or_else(|| {
                line.wrong(format_args!(
                    "has `{word}`, and there are {} addresses: write one below",
                    self.addresses.len()
                ))
            })?;
            return Ok(self.b.address(*address));
        }
        if word == "(" || word.starts_with("0x") {
            return self.bytes(line, word, ty);
        }
        let number = word.parse().map_err(|_| {
            line.wrong(format_args!("uses `{word}` before it is defined: define it above, or write a number"))
        })?;
        Ok(self.b.constant(ty, number))
    }

    /// A vector of these integers, or of one integer in all lanes.
    fn bytes(&mut self, line: &mut Line, first: String, ty: Type) -> Result<Value, String> {
        let mut lanes = vec![first];
        if lanes[0] == "(" {
            lanes.clear();
            while !line.takes(")") {
                lanes.push(line.next("`)`")?);
            }
        }
        let number = |lane: &String| lane.strip_prefix("0x").and_then(|digits| u64::from_str_radix(digits, 16).ok());
        let size = ty.element() as usize / 8;
        let numbers = lanes.iter().map(number).collect::<Option<Vec<u64>>>();
        let fits = |numbers: &Vec<u64>| {
            ty.is_vector()
                && [1, ty.lanes() as usize].contains(&numbers.len())
                && lanes.iter().all(|lane| lane.len() == 2 + 2 * size)
        };
        let numbers = numbers.filter(fits).ok_or_else(|| {
            line.wrong(format_args!("has a constant that is no {ty}: write `0x` and {} digits for each lane", 2 * size))
        })?;
        Ok(self.b.numbers(ty, |lane| numbers[lane as usize % numbers.len()]))
    }
}
