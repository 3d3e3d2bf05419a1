//! Drops what nobody uses: the emitter computes several forms of a value, because it does not know yet which ones are needed.

use super::operation::Operation;
use super::program::{Loop, Program, Region, Statement};
use super::value::Value;

impl Program {
    /// The program without values that are not used, even if they are loaded.
    pub fn without_unused(mut self) -> Program {
        let mut body = std::mem::take(&mut self.body);
        Uses { program: &self, used: vec![false; self.values.len()] }.drop_unused(&mut body);
        Program { body, ..self }
    }
}

/// What is used by the statements after the present one.
struct Uses<'p> {
    program: &'p Program,
    used: Vec<bool>,
}

impl Uses<'_> {
    fn all<'v>(&mut self, values: impl IntoIterator<Item = &'v Value>) {
        values.into_iter().for_each(|value| self.used[value.index()] = true);
    }

    /// Goes through a region from its end.
    fn drop_unused(&mut self, region: &mut Region) {
        let mut kept: Region = std::mem::take(region).into_iter().rev().filter_map(|it| self.kept(it)).collect();
        kept.reverse();
        *region = kept;
    }

    /// The statement, if it is needed, without what it does not need.
    fn kept(&mut self, mut statement: Statement) -> Option<Statement> {
        match &mut statement {
            Statement::Let(value) => {
                let program = self.program;
                let (operation, _) = &program.values[value.index()];
                if !self.used[value.index()] && !matches!(operation, Operation::Call(..)) {
                    return None;
                }
                operation.for_each_operand(|operand| self.used[operand.index()] = true);
            }
            Statement::Call { function, arguments } => self.all(arguments.iter().chain([&*function])),
            Statement::Store { value, address, .. } => self.all([&*value, &*address]),
            Statement::If { flag, then, otherwise } => {
                self.drop_unused(then);
                self.drop_unused(otherwise);
                self.all([&*flag]);
            }
            Statement::Switch { subject, regions, .. } => {
                regions.iter_mut().for_each(|region| self.drop_unused(region));
                self.all([&*subject]);
            }
            Statement::Loop(all) => {
                let Loop { start, body, again, end, .. } = &mut **all;
                let again = again.iter().flat_map(|(flag, next)| next.iter().chain([flag]));
                self.all(again.chain(end.iter()));
                self.drop_unused(body);
                self.all(start.iter());
            }
            Statement::LeaveUnless { flag, results } => self.all(results.iter().chain([&*flag])),
            Statement::Then => {}
            Statement::Return(value) => self.all([&*value]),
        }
        Some(statement)
    }
}

#[cfg(test)]
mod tests {
    use super::super::builder::Builder;
    use super::super::operation::Comparison;
    use super::super::text::Notes;
    use super::super::value::Type;
    use super::*;

    #[test]
    fn only_what_is_used_remains() {
        let mut b = Builder::new(128);
        let [state, argument, _] = Program::PARAMETERS;
        let (unused, start) = (b.load(Type::I64, state, 0), b.load(Type::I64, state, 8));
        let _ = b.not(unused);
        let at = b.parameter(Type::I64);
        b.open();
        let _ = b.load(Type::I32X4, state, 16);
        let (next, carried) = (b.add(at, argument), b.load(Type::I64, state, 32));
        let more = b.compare(Comparison::UnsignedLessThan, next, carried);
        let body = b.close();
        let again = Some((more, vec![next]));
        b.repeat(Loop { parameters: vec![at], start: vec![start], body, again, end: vec![], results: vec![] });
        let _ = b.call(4096, &[argument]);
        b.give(next);
        let program = b.finish().0;
        assert_eq!(program.verify(), Ok(()));
        let lines = [
            "v0: i64 = load [state + 8]",
            "loop v1: i64 = v0",
            "  v2: i64 = add v1 argument",
            "  v3: i64 = load [state + 32]",
            "  v4: i8 = ult i64 v2 v3",
            "again if v4 with v2",
            "v5: i64 = call @0 argument",
            "return v2",
        ];
        assert_eq!(program.text(&Notes::NONE).lines().collect::<Vec<_>>(), lines);
    }
}
