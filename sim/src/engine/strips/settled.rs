//! A strip program in its settled form: what its text keeps of it.

use super::operation::Operation;
use super::program::{Loop, Program, Region, Statement};
use super::value::{Type, Value};

impl Program {
    /// The program with its values numbered in the sequence of their statements, and with constants where they are
    /// used: programs whose text is the same have the same settled form.
    pub fn settled(&self) -> Program {
        let (became, values) = (vec![None; self.values.len()], Vec::new());
        let mut settler = Settler { program: self, became, values, region: Region::new() };
        Program::PARAMETERS.into_iter().for_each(|value| _ = settler.define(value, Operation::Parameter));
        let body = settler.region(&self.body);
        Program { values: settler.values, body, ..*self }
    }
}

struct Settler<'p> {
    program: &'p Program,
    became: Vec<Option<Value>>,
    values: Vec<(Operation, Type)>,
    /// The open region.
    region: Region,
}

impl Settler<'_> {
    fn define(&mut self, value: Value, operation: Operation) -> Value {
        let new = Value(self.values.len() as u32);
        self.values.push((operation, self.program.type_of(value)));
        self.became[value.index()] = Some(new);
        new
    }

    fn of(&mut self, value: Value) -> Value {
        match &self.program.values[value.index()].0 {
            known @ (Operation::Constant(_) | Operation::Address(_) | Operation::Bytes(_)) => {
                let new = self.define(value, known.clone());
                self.region.push(Statement::Let(new));
                new
            }
            _ => self.became[value.index()].expect("a value is defined before its uses"),
        }
    }

    fn all(&mut self, values: &[Value]) -> Vec<Value> {
        values.iter().map(|value| self.of(*value)).collect()
    }

    fn parameters(&mut self, values: &[Value]) -> Vec<Value> {
        values.iter().map(|value| self.define(*value, Operation::Parameter)).collect()
    }

    /// The settled statements, without those that are still in the open region.
    fn region(&mut self, region: &[Statement]) -> Region {
        let outer = std::mem::take(&mut self.region);
        region.iter().for_each(|statement| self.statement(statement));
        std::mem::replace(&mut self.region, outer)
    }

    fn statement(&mut self, statement: &Statement) {
        let settled = match statement {
            Statement::Let(value) => {
                let mut operation = self.program.values[value.index()].0.clone();
                if matches!(operation, Operation::Constant(_) | Operation::Address(_) | Operation::Bytes(_)) {
                    return;
                }
                operation.rewrite(|operand| self.of(operand));
                Statement::Let(self.define(*value, operation))
            }
            Statement::Call { function, arguments } => {
                Statement::Call { function: self.of(*function), arguments: self.all(arguments) }
            }
            Statement::Store { value, aligned, address, offset } => {
                let (address, value) = (self.of(*address), self.of(*value));
                Statement::Store { value, aligned: *aligned, address, offset: *offset }
            }
            Statement::If { flag, then, otherwise } => {
                let flag = self.of(*flag);
                Statement::If { flag, then: self.region(then), otherwise: self.region(otherwise) }
            }
            Statement::Switch { subject, table, regions } => {
                let subject = self.of(*subject);
                let regions = regions.iter().map(|region| self.region(region)).collect();
                Statement::Switch { subject, table: table.clone(), regions }
            }
            Statement::Loop(all) => {
                let Loop { parameters, start, body, again, end, results } = &**all;
                let start = self.all(start);
                let parameters = self.parameters(parameters);
                let outer = std::mem::take(&mut self.region);
                body.iter().for_each(|statement| self.statement(statement));
                let again = again.as_ref().map(|(flag, next)| (self.of(*flag), self.all(next)));
                let end = self.all(end);
                let results = self.parameters(results);
                let body = std::mem::replace(&mut self.region, outer);
                Statement::Loop(Box::new(Loop { parameters, start, body, again, end, results }))
            }
            Statement::LeaveUnless { flag, results } => {
                let flag = self.of(*flag);
                Statement::LeaveUnless { flag, results: self.all(results) }
            }
            Statement::Then => Statement::Then,
            Statement::Return(value) => Statement::Return(self.of(*value)),
        };
        self.region.push(settled);
    }
}
