//! Whether a strip program stays in its memory: each access must be shown to be in one allocation.
//!
//! A pass over the program finds the range of each number. Constants, masks, minima, shifts, counts of loops and
//! numbers that are stored in fewer bits have one. An address is an allocation's, and a range of bytes from there.
//! So a program whose indices have lost a mask or a minimum is refused.

mod fact;
mod possible;

use std::cell::RefCell;

use super::commits::Touched;
use super::operation::{Binary, Comparison, Load, Operation, Unary};
use super::program::{Loop, Program, Statement};
use super::value::{Bytes, Type, Value};
pub(in crate::engine) use fact::Fact;
use fact::ones;
use possible::Possible;

/// Where an address begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::engine) enum Base {
    /// The state, and that of the unit to which the argument leads.
    State,
    Unit,
    Scratch,
    /// A known address.
    Known(usize),
    /// The address that is stored at an offset in the state, or in that of the unit.
    Stored(i64),
}

/// An allocation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::engine) struct Extent {
    /// Its first byte, and the one after its last, from the base.
    pub start: i64,
    pub end: i64,
    /// Bits of the integers in it, and the greatest of them.
    pub integer: u32,
    pub most: u64,
    /// It is changed by the edge of a clock.
    pub is_state: bool,
}

/// The memory in which a program runs.
pub(in crate::engine) trait Surroundings {
    /// The allocation of a byte.
    fn extent(&self, base: Base, at: i64) -> Option<Extent>;

    /// Whether the argument leads to the state of a unit.
    fn has_units(&self) -> bool {
        false
    }

    /// What functions for other pieces of the same edge have changed.
    fn committed(&self) -> Option<&RefCell<Vec<Touched>>> {
        None
    }

    /// Whether the address of an allocation is stored at an offset in the state.
    fn is_address(&self, _offset: i64) -> bool {
        false
    }
}

/// A state of so many bytes, and nothing else.
pub(in crate::engine) struct Only(pub i64);

impl Surroundings for Only {
    fn extent(&self, base: Base, _at: i64) -> Option<Extent> {
        let all = Extent { start: 0, end: self.0, integer: 0, most: u64::MAX, is_state: false };
        (base == Base::State).then_some(all)
    }
}

/// An access that stays in its allocation.
#[derive(Debug, Clone, Copy)]
pub(in crate::engine) struct Access {
    /// The address and its constant.
    pub address: Value,
    pub offset: i64,
    pub size: i64,
    pub base: Base,
    pub extent: Extent,
}

impl Program {
    /// Shows that each access is in one allocation; what is known of each value for that.
    ///
    /// # Errors
    /// The first access that may be elsewhere, or a switch or division whose operand it has no case for.
    pub fn bounds(&self, surroundings: &dyn Surroundings) -> Result<Bounds, String> {
        let facts = self.values.iter().map(|(_, ty)| Fact::any(*ty)).collect();
        let mut walk = Walk { program: self, surroundings, found: Bounds { facts, accesses: Vec::new() } };
        walk.found.facts[Program::PARAMETERS[0].index()] = Fact::Address(Base::State, 0, 0);
        walk.found.facts[Program::PARAMETERS[2].index()] = Fact::Address(Base::Scratch, 0, 0);
        walk.region(&self.body)?;
        Ok(walk.found)
    }
}

/// What is known of a program.
pub(in crate::engine) struct Bounds {
    /// For each value.
    pub facts: Vec<Fact>,
    /// In the sequence of the program.
    pub accesses: Vec<Access>,
}

impl Bounds {
    /// The sentence about a value of the program that is not what is known of it; `base` has the address of a base, if
    /// that is known.
    pub fn refute(
        &self,
        program: &Program,
        value: Value,
        bytes: &Bytes,
        base: impl Fn(Base) -> Option<u64>,
    ) -> Option<String> {
        let ((operation, ty), fact) = (&program.values[value.index()], self.facts[value.index()]);
        let sentence = || format!("{operation:?} is {bytes:x?}, and the bounds have {fact:?}");
        (!fact.admits(*ty, bytes, base)).then(sentence)
    }
}

struct Walk<'p> {
    program: &'p Program,
    surroundings: &'p dyn Surroundings,
    found: Bounds,
}

impl Walk<'_> {
    fn ty(&self, value: Value) -> Type {
        self.program.type_of(value)
    }

    fn of(&self, value: Value) -> Fact {
        self.found.facts[value.index()]
    }

    fn both(&self, value: Value) -> (Type, Fact) {
        (self.ty(value), self.of(value))
    }

    fn range(&self, value: Value) -> (u64, u64) {
        self.of(value).range(self.ty(value))
    }

    fn operation_of(&self, value: Value) -> &Operation {
        &self.program.values[value.index()].0
    }

    fn constant(&self, value: Value) -> Option<u64> {
        if let Operation::Constant(number) = self.operation_of(value) { Some(*number as u64) } else { None }
    }

    fn region(&mut self, region: &[Statement]) -> Result<(), String> {
        region.iter().try_for_each(|statement| self.statement(statement))
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), String> {
        match statement {
            Statement::Let(value) => {
                let fact = self.operation(*value)?;
                self.found.facts[value.index()] = fact;
                Ok(())
            }
            Statement::Store { value, address, offset, .. } => {
                let (ty, fact) = self.both(*value);
                let extent = self.access(*address, *offset, ty.bytes())?;
                if self.address_at(*address, *offset).is_some() && !matches!(fact, Fact::Address(Base::Stored(_), ..)) {
                    return Err(format!("value {} is no address, and it is stored in the place of one", value.0));
                }
                if !fact.fits(ty, extent) {
                    let Extent { start, end, most, .. } = extent;
                    return Err(format!(
                        "value {} may be more than {most}, and it is stored in the allocation of {start} to {end}, whose \
                         numbers are at most that",
                        value.0
                    ));
                }
                Ok(())
            }
            Statement::If { then, otherwise, .. } => {
                self.region(then)?;
                self.region(otherwise)
            }
            Statement::Switch { subject, table, regions } => {
                let most = self.range(*subject).1;
                if most >= table.len() as u64 {
                    return Err(format!("value {} may be {most}, and a switch has {} cases", subject.0, table.len()));
                }
                regions.iter().try_for_each(|region| self.region(region))
            }
            Statement::Loop(all) => {
                if let Some((index, fact)) = self.counter(all) {
                    self.found.facts[all.parameters[index].index()] = fact;
                }
                self.region(&all.body)
            }
            Statement::Call { .. } | Statement::LeaveUnless { .. } | Statement::Then | Statement::Return(_) => Ok(()),
        }
    }

    /// The parameter of a loop that counts, and its range.
    fn counter(&self, all: &Loop) -> Option<(usize, Fact)> {
        let (flag, next) = all.again.as_ref()?;
        let (index, step) = (0..next.len()).find_map(|index| Some((index, step(self.program, all, index)?)))?;
        let (first, at) = (self.range(all.start[index]), all.parameters[index]);
        // Down to zero: it is not zero when it goes on, so as a multiple of the step it is at least that.
        if *flag == at && step < 0 && first.0 == first.1 && first.0.is_multiple_of(step.unsigned_abs()) {
            return Some((index, Fact::Number(0, first.1)));
        }
        let Operation::Compare(Comparison::UnsignedLessThan, x, limit) = *self.operation_of(*flag) else { return None };
        let limit = self.constant(limit)?;
        let furthest = limit.max(first.1).checked_add(step.unsigned_abs());
        let is_up = x == next[index] && step > 0 && furthest.is_some();
        // The greatest number of the count that is below the limit.
        let steps = limit.checked_sub(1)?.saturating_sub(first.0) / step.unsigned_abs();
        let most = if first.0 == first.1 { first.0 + steps * step.unsigned_abs() } else { limit - 1 };
        is_up.then_some((index, Fact::Number(first.0, most.max(first.1))))
    }

    /// Notes an access, if it is in one allocation.
    fn access(&mut self, address: Value, offset: i32, size: i64) -> Result<Extent, String> {
        let Fact::Address(base, least, most) = self.of(address) else {
            return Err(format!("value {} is an address of no allocation", address.0));
        };
        let (offset, limbs) = (i64::from(offset), self.program.scratch as i64);
        let first = least.saturating_add(offset);
        let extent = match base {
            Base::Scratch => Some(Extent { start: 0, end: 8 * limbs, integer: 0, most: u64::MAX, is_state: false }),
            Base::Unit if !self.surroundings.has_units() => None,
            _ => self.surroundings.extent(base, first),
        };
        let end = most.saturating_add(offset).saturating_add(size);
        match extent {
            Some(extent) if extent.start <= first && end <= extent.end => {
                self.found.accesses.push(Access { address, offset, size, base, extent });
                Ok(extent)
            }
            Some(Extent { start, end: last, .. }) => Err(format!(
                "value {} leads to bytes {first} to {end} of {base:?}, and the allocation there has {start} to {last}",
                address.0
            )),
            None => Err(format!("value {} leads to byte {first} of {base:?}, where no allocation is", address.0)),
        }
    }

    /// The place in the state, if the address of an allocation is stored there.
    fn address_at(&self, address: Value, offset: i32) -> Option<i64> {
        let Fact::Address(Base::State | Base::Unit, at, same) = self.of(address) else { return None };
        let place = at.saturating_add(offset.into());
        (at == same && self.surroundings.is_address(place)).then_some(place)
    }

    fn operation(&mut self, value: Value) -> Result<Fact, String> {
        let (operation, ty) = &self.program.values[value.index()];
        let ty = *ty;
        Ok(match operation {
            Operation::Parameter | Operation::Call(..) => Fact::any(ty),
            Operation::Constant(number) => Fact::constant(ty, *number),
            Operation::Address(address) => Fact::Address(Base::Known(*address), 0, 0),
            Operation::Bytes(bytes) => Fact::Vector(Possible::of_bytes(bytes)),
            Operation::Unary(Unary::Truncate, of) => {
                let fact = Fact::unary(Unary::Truncate, ty, self.ty(*of), self.of(*of));
                Fact::Number(fact.range(ty).0, fact.range(ty).1.min(self.bits(*of) & ones(ty.element())))
            }
            Operation::Unary(unary, of) => Fact::unary(*unary, ty, self.ty(*of), self.of(*of)),
            Operation::Binary(binary, x, y) => {
                if *binary == Binary::Div && self.range(*y).0 == 0 {
                    return Err(format!("value {} may divide by zero", value.0));
                }
                let [state, argument, _] = Program::PARAMETERS;
                let remainder = if *binary == Binary::Sub { self.remainder(*x, *y) } else { None };
                match (binary, remainder) {
                    (Binary::Add, _) if (*x, *y) == (state, argument) => Fact::Address(Base::Unit, 0, 0),
                    (_, Some(most)) => Fact::Number(0, most),
                    (Binary::And, _) if !ty.is_vector() => {
                        Fact::Number(0, (self.bits(*x) & self.bits(*y)).min(self.range(*x).1).min(self.range(*y).1))
                    }
                    _ => Fact::binary(*binary, ty, self.both(*x), self.both(*y)),
                }
            }
            Operation::Compare(..) if !ty.is_vector() => Fact::Number(0, 1),
            Operation::Compare(..) => Fact::any(ty),
            Operation::Select(_, x, y) => self.of(*x).or(self.of(*y), ty),
            Operation::Blend(mask, x, y) => Fact::blend(self.of(*mask), self.of(*x), self.of(*y)),
            Operation::Shuffle(x, y, bytes) => Fact::shuffle(ty, self.of(*x), self.of(*y), bytes),
            Operation::Lane(of, lane) => self.of(*of).lane(self.ty(*of), *lane),
            Operation::WithLane(vector, number, lane) => self.of(*vector).with_lane(ty, self.of(*number), *lane),
            Operation::Load { load, address, offset, .. } => {
                let size = if *load == Load::Whole { ty.bytes() } else { ty.bytes() / 2 };
                let extent = self.access(*address, *offset, size)?;
                match self.address_at(*address, *offset) {
                    Some(at) => Fact::Address(Base::Stored(at), 0, 0),
                    None => Fact::loaded(*load, ty, extent.integer, extent.most),
                }
            }
        })
    }

    /// The bits that may be 1 in a number: more than a range shows of numbers side by side, as a lane has them.
    fn bits(&self, value: Value) -> u64 {
        match *self.operation_of(value) {
            Operation::Lane(of, lane) => self.of(of).lane(self.ty(of), lane).range(self.ty(value)).1,
            Operation::Binary(Binary::Shr, x, by) => match self.constant(by) {
                Some(by) if by < 64 => self.bits(x) >> by,
                _ => u64::MAX,
            },
            _ => self.of(value).bits(self.ty(value)).number(),
        }
    }

    /// The greatest remainder, if a number is subtracted from `x` that is a quotient of `x` times the divisor.
    fn remainder(&self, x: Value, y: Value) -> Option<u64> {
        let Operation::Binary(Binary::Mul, quotient, group) = *self.operation_of(y) else { return None };
        let group = self.constant(group)?;
        let Operation::Binary(binary, of, by) = *self.operation_of(quotient) else { return None };
        let by = self.constant(by)?;
        let is_quotient = match binary {
            Binary::Shr if of == x => 1u64.checked_shl(by as u32) == Some(group),
            Binary::Div => of == x && by == group,
            // By a reciprocal: what it is too large by must not show in a quotient of `x`.
            Binary::Shr => match *self.operation_of(of) {
                Operation::Binary(Binary::Mul, scaled, reciprocal) if scaled == x => {
                    let (most, reciprocal) = (u128::from(self.range(x).1), u128::from(self.constant(reciprocal)?));
                    let whole = 1u128.checked_shl(by as u32)?;
                    let above = (reciprocal * u128::from(group)).checked_sub(whole)?;
                    most * above < whole && most * reciprocal <= u64::MAX.into()
                }
                _ => false,
            },
            _ => false,
        };
        if is_quotient { group.checked_sub(1) } else { None }
    }
}

/// What a loop adds to a parameter each time.
pub(super) fn step(program: &Program, all: &Loop, index: usize) -> Option<i64> {
    let (_, next) = all.again.as_ref()?;
    let Operation::Binary(Binary::Add, of, by) = program.values[next[index].index()].0 else { return None };
    let Operation::Constant(by) = program.values[by.index()].0 else { return None };
    (of == all.parameters[index] && by != 0 && program.type_of(of) == Type::I64).then_some(by)
}
