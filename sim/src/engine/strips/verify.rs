//! Whether a strip program keeps the rules: a value is computed once and before its uses, and operands have the types of their operations.

use super::bounds::{Bounds, Surroundings};
use super::operation::{Binary, Load, Operation, Unary};
use super::program::{Loop, Program, Statement};
use super::value::{Type, Value};

impl Program {
    /// Checks everything: the rules, that each access is in one allocation of the memory, and that nothing is read
    /// after it was changed.
    ///
    /// # Errors
    /// What is wrong first.
    pub fn check(&self, memory: &dyn Surroundings) -> Result<Bounds, String> {
        self.verify()?;
        let bounds = self.bounds(memory)?;
        match memory.committed() {
            Some(before) => self.commits(&bounds, &mut before.borrow_mut())?,
            None => self.commits(&bounds, &mut Vec::new())?,
        }
        Ok(bounds)
    }

    /// Checks the rules.
    ///
    /// # Errors
    /// The first rule that is broken, with the number of the value.
    pub fn verify(&self) -> Result<(), String> {
        let mut check = Check { program: self, visible: vec![false; self.values.len()], defined: Vec::new(), loops: 0 };
        check.define_all(&Program::PARAMETERS)?;
        let Some((Statement::Return(result), body)) = self.body.split_last() else {
            return Err("the program does not end with a return".to_owned());
        };
        check.region(body)?;
        check.is(*result, Type::I64)
    }
}

/// A check in progress.
struct Check<'p> {
    program: &'p Program,
    /// Whether each value may be used here.
    visible: Vec<bool>,
    /// What is defined so far, for the end of a region.
    defined: Vec<Value>,
    /// The loops around.
    loops: usize,
}

impl Check<'_> {
    fn ty(&self, value: Value) -> Type {
        self.program.type_of(value)
    }

    fn demand(&self, holds: bool, of: Value, rule: &str) -> Result<(), String> {
        if holds { Ok(()) } else { Err(format!("value {} {rule}", of.0)) }
    }

    fn define(&mut self, value: Value) -> Result<(), String> {
        let known = self.visible.get(value.index()).copied();
        self.demand(known.is_some(), value, "is not in the list of values")?;
        self.demand(known == Some(false), value, "is defined twice")?;
        self.visible[value.index()] = true;
        self.defined.push(value);
        Ok(())
    }

    fn define_all(&mut self, parameters: &[Value]) -> Result<(), String> {
        for value in parameters {
            self.define(*value)?;
            self.demand(self.program.values[value.index()].0 == Operation::Parameter, *value, "is no parameter")?;
        }
        Ok(())
    }

    /// Whether a value may be used here.
    fn usable(&self, value: Value) -> Result<(), String> {
        self.demand(self.visible.get(value.index()) == Some(&true), value, "is used where it is not defined")
    }

    /// Whether a value may be used here as one of that type.
    fn is(&self, value: Value, ty: Type) -> Result<(), String> {
        self.usable(value)?;
        self.demand(self.ty(value) == ty, value, &format!("is {} in place of {ty}", self.ty(value)))
    }

    /// Whether a value may be used here as an integer.
    fn is_integer(&self, value: Value) -> Result<(), String> {
        self.usable(value)?;
        let ty = self.ty(value);
        self.demand(ty.is_integer(), value, &format!("is {ty} in place of an integer"))
    }

    fn alike(&self, values: &[Value], types: &[Value]) -> Result<(), String> {
        if values.len() != types.len() {
            return Err(format!("{} values are given for {} parameters", values.len(), types.len()));
        }
        values.iter().zip(types).try_for_each(|(value, of)| self.is(*value, self.ty(*of)))
    }

    fn all_integers(&self, values: &[Value]) -> Result<(), String> {
        values.iter().try_for_each(|value| self.is(*value, Type::I64))
    }

    fn region(&mut self, region: &[Statement]) -> Result<(), String> {
        region.iter().try_for_each(|statement| self.statement(statement))
    }

    /// A region whose values are not visible after it.
    fn inner(&mut self, region: &[Statement]) -> Result<(), String> {
        let before = self.defined.len();
        self.region(region)?;
        self.forget(before);
        Ok(())
    }

    fn forget(&mut self, before: usize) {
        self.defined.drain(before..).for_each(|value| self.visible[value.index()] = false);
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), String> {
        match statement {
            Statement::Let(value) => {
                let Some((operation, ty)) = self.program.values.get(value.index()) else {
                    return self.demand(false, *value, "is not in the list of values");
                };
                self.operation(operation, *ty, *value)?;
                self.define(*value)
            }
            Statement::Call { function, arguments } => {
                self.is(*function, Type::ADDRESS)?;
                self.all_integers(arguments)
            }
            Statement::Store { value, address, .. } => {
                self.usable(*value)?;
                self.is(*address, Type::ADDRESS)
            }
            Statement::If { flag, then, otherwise } => {
                self.is_integer(*flag)?;
                self.inner(then)?;
                self.inner(otherwise)
            }
            Statement::Switch { subject, table, regions } => {
                self.is_integer(*subject)?;
                let has_all = table.iter().all(|region| *region < regions.len());
                self.demand(has_all && !table.is_empty(), *subject, "chooses a region that does not exist")?;
                regions.iter().try_for_each(|region| self.inner(region))
            }
            Statement::Loop(all) => self.repeat(all),
            Statement::LeaveUnless { flag, results } => {
                self.demand(self.loops > 0, *flag, "leaves a loop outside of any")?;
                self.is_integer(*flag)?;
                results.iter().try_for_each(|value| self.usable(*value))
            }
            Statement::Then => Ok(()),
            Statement::Return(value) => self.demand(false, *value, "is returned before the end"),
        }
    }

    fn repeat(&mut self, all: &Loop) -> Result<(), String> {
        let Loop { parameters, start, body, again, end, results } = all;
        self.alike(start, parameters)?;
        self.define_all(parameters)?;
        self.loops += 1;
        self.region(body)?;
        self.loops -= 1;
        if let Some((flag, next)) = again {
            self.is_integer(*flag)?;
            self.alike(next, parameters)?;
        }
        for leave in body
            .iter()
            .filter_map(|it| if let Statement::LeaveUnless { results, .. } = it { Some(results) } else { None })
        {
            self.alike_types(leave, results)?;
        }
        self.alike(end, results)?;
        self.define_all(results)
    }

    /// The same without a look at where they are defined.
    fn alike_types(&self, values: &[Value], types: &[Value]) -> Result<(), String> {
        let all = |of: &[Value]| of.iter().map(|value| self.ty(*value)).collect::<Vec<_>>();
        if all(values) == all(types) { Ok(()) } else { Err("a loop is left with other results than it has".to_owned()) }
    }

    fn operation(&self, operation: &Operation, ty: Type, value: Value) -> Result<(), String> {
        match operation {
            Operation::Parameter => self.demand(false, value, "is a parameter and not computed"),
            Operation::Constant(_) => self.demand(ty.is_integer(), value, "is a constant and no integer"),
            Operation::Address(_) => self.demand(ty == Type::ADDRESS, value, "is an address of another type"),
            Operation::Bytes(bytes) => {
                let are_its = ty.is_vector() && bytes[ty.bytes() as usize..].iter().all(|byte| *byte == 0);
                self.demand(are_its, value, "has the bytes of a vector and is none")
            }
            Operation::Unary(unary, of) => self.unary(*unary, *of, ty, value),
            Operation::Binary(binary, x, y) => self.binary(*binary, *x, *y, ty, value),
            Operation::Compare(_, x, y) => {
                self.usable(*x)?;
                self.is(*y, self.ty(*x))?;
                let of = self.ty(*x);
                let result = if of.is_vector() { of } else { Type::I8 };
                self.demand(ty == result && !of.is_float(), value, "compares what it cannot")
            }
            Operation::Select(flag, x, y) => {
                self.is(*flag, Type::I8)?;
                self.is(*x, ty)?;
                self.is(*y, ty)
            }
            Operation::Blend(mask, x, y) => {
                [mask, x, y].into_iter().try_for_each(|it| self.is(*it, ty))?;
                self.demand(ty.is_vector(), value, "chooses in lanes and is no vector")
            }
            Operation::Shuffle(x, y, bytes) => {
                self.is(*x, ty)?;
                self.is(*y, ty)?;
                let (own, above) = bytes.split_at(ty.bytes() as usize);
                let exist =
                    own.iter().all(|byte| i64::from(*byte) < 2 * ty.bytes()) && above.iter().all(|byte| *byte == 0);
                self.demand(ty.is_vector() && ty.element() == 8 && exist, value, "chooses no byte of two vectors")
            }
            Operation::Lane(of, lane) => {
                self.usable(*of)?;
                let from = self.ty(*of);
                let is_its = from.is_vector() && u32::from(*lane) < from.lanes() && ty == from.of_lane();
                self.demand(is_its, value, "is no lane of its vector")
            }
            Operation::WithLane(vector, number, lane) => {
                self.is(*vector, ty)?;
                self.is(*number, ty.of_lane())?;
                self.demand(ty.is_vector() && u32::from(*lane) < ty.lanes(), value, "sets no lane of its vector")
            }
            Operation::Load { load, address, .. } => {
                self.is(*address, Type::ADDRESS)?;
                let is_extended = ty.is_integers() && matches!(ty.element(), 16 | 32);
                self.demand(*load == Load::Whole || is_extended, value, "is loaded in a way that its type has not")
            }
            Operation::Call(function, arguments) => {
                self.is(*function, Type::ADDRESS)?;
                self.demand(ty == Type::I64, value, "is the result of a call and no number")?;
                self.all_integers(arguments)
            }
        }
    }

    fn unary(&self, unary: Unary, of: Value, ty: Type, value: Value) -> Result<(), String> {
        self.usable(of)?;
        let from = self.ty(of);
        let are_integers =
            |wide: Type, narrow: Type| wide.is_integer() && narrow.is_integer() && wide.element() > narrow.element();
        let holds = match unary {
            Unary::Not | Unary::Neg => ty == from && !ty.is_float(),
            Unary::CountOnes => ty == from && ty.is_integer(),
            Unary::ZeroExtend | Unary::SignExtend => are_integers(ty, from),
            Unary::Truncate => are_integers(from, ty),
            Unary::Cast => ty.is_vector() && from.is_vector() && ty.bits() <= from.bits(),
            Unary::Splat | Unary::Lowest => ty.is_vector() && from == ty.of_lane(),
            Unary::WidenLow { .. } | Unary::WidenHigh { .. } => from.is_integers() && ty == from.widened(),
            Unary::HighBits => from.is_vector() && ty == Type::I32,
            Unary::AnyBit => from.is_vector() && ty == Type::I8,
            Unary::ToFloat => from.is_integers() && from.element() == 32 && ty == from.floats(),
            Unary::ToInteger => ty.is_integers() && ty.element() == 32 && from == ty.floats(),
        };
        self.demand(holds, value, &format!("is {ty} of {from}, which {unary:?} does not give"))
    }

    fn binary(&self, binary: Binary, x: Value, y: Value, ty: Type, value: Value) -> Result<(), String> {
        self.usable(x)?;
        self.usable(y)?;
        let (left, right) = (self.ty(x), self.ty(y));
        let holds = match binary {
            Binary::Add | Binary::Sub | Binary::Mul | Binary::And | Binary::Or | Binary::Xor | Binary::Min => {
                ty == left && ty == right && !ty.is_float()
            }
            Binary::Div | Binary::RotateLeft => ty == left && ty == right && ty.is_integer(),
            Binary::Shl | Binary::Shr | Binary::Sar => ty == left && !ty.is_float() && right.is_integer(),
            Binary::Narrow { .. } => left == right && left.is_integers() && ty == left.narrowed(),
            Binary::Swizzle | Binary::LookUp => {
                left == Type::TABLE && ty == right && ty.is_integers() && ty.element() == 8
            }
            Binary::MulFloat => ty == left && ty == right && ty.is_vector() && ty.is_float() && ty.element() == 32,
        };
        self.demand(holds, value, &format!("is {ty} of {left} and {right}, which {binary:?} does not give"))
    }
}

#[cfg(test)]
mod tests {
    use super::super::builder::Builder;
    use super::super::operation::Comparison;
    use super::*;

    /// A program with a loop, a branch and vectors.
    fn program() -> Program {
        let mut b = Builder::new(128);
        let [state, argument, _] = Program::PARAMETERS;
        let (at, result) = (b.parameter(Type::I64), b.parameter(Type::I64));
        b.open();
        let vector = b.load(Type::I32X4, state, 16);
        let lane = b.lane(vector, 3);
        let number = b.zero_extend(Type::I64, lane);
        let flag = b.compare(Comparison::Equal, number, at);
        b.leave_unless(flag, &[number]);
        b.open();
        b.store(vector, state, 32);
        let then = b.close();
        b.branch(flag, then, Vec::new());
        let next = b.add_constant(at, -1);
        let body = b.close();
        let again = Some((next, vec![next]));
        b.repeat(Loop {
            parameters: vec![at],
            start: vec![argument],
            body,
            again,
            end: vec![next],
            results: vec![result],
        });
        b.give(result);
        b.finish().0
    }

    #[test]
    fn a_program_that_keeps_the_rules_passes() {
        assert_eq!(program().verify(), Ok(()));
    }

    /// The sentence about a program with a change.
    fn refused(change: impl FnOnce(&mut Program)) -> String {
        let mut program = program();
        change(&mut program);
        program.verify().expect_err("a rule is broken")
    }

    fn body(program: &mut Program) -> &mut Loop {
        let Statement::Loop(all) = &mut program.body[0] else { unreachable!("it begins with a loop") };
        all
    }

    #[test]
    fn each_broken_rule_is_found() {
        let sentences = [
            refused(|program| _ = program.body.pop()),
            refused(|program| program.body.insert(0, Statement::Return(Value(1)))),
            refused(|program| program.body.insert(0, Statement::Let(Value(5)))),
            refused(|program| body(program).body.push(Statement::Let(Value(5)))),
            refused(|program| body(program).body.swap(0, 1)),
            refused(|program| program.values[5].1 = Type::I64X2),
            refused(|program| program.values[7].1 = Type::I8),
            refused(|program| body(program).start.clear()),
            refused(|program| body(program).end = vec![Value(6)]),
            refused(|program| {
                body(program).body[4] = Statement::LeaveUnless { flag: Value(8), results: vec![Value(6)] }
            }),
            refused(|program| program.body.insert(0, Statement::LeaveUnless { flag: Value(1), results: vec![] })),
            refused(|program| {
                let body = &mut body(program).body;
                let constant = body.remove(body.len() - 2);
                let then = body.iter_mut().find_map(|it| match it {
                    Statement::If { then, .. } => Some(then),
                    _ => None,
                });
                then.expect("there is a branch").push(constant);
            }),
            refused(|program| {
                program.body.insert(0, Statement::Switch { subject: Value(1), table: vec![1], regions: vec![vec![]] })
            }),
        ];
        let expected = [
            "the program does not end with a return",
            "value 1 is returned before the end",
            "value 5 is defined twice",
            "value 5 is defined twice",
            "value 5 is used where it is not defined",
            "value 6 is no lane of its vector",
            "value 7 is i8 of i32, which ZeroExtend does not give",
            "0 values are given for 1 parameters",
            "value 6 is i32 in place of i64",
            "a loop is left with other results than it has",
            "value 1 leaves a loop outside of any",
            "value 9 is used where it is not defined",
            "value 1 chooses a region that does not exist",
        ];
        assert_eq!(sentences, expected);
    }
}
