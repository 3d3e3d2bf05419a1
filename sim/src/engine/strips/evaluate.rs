//! Runs a strip program without making code of it: what code has to do.

use super::operation::{Binary, Comparison, Load, Operation, Unary};
use super::program::{Loop, Program, Region, Statement};
use super::value::{Bytes, Type, Value};

/// A memory that a program may access: its address, and its bytes.
pub(in crate::engine) struct Memory<'m> {
    pub address: u64,
    pub bytes: &'m mut [u8],
}

/// The memories that a program may access.
pub(in crate::engine) trait Places {
    /// So many bytes at an address.
    ///
    /// # Errors
    /// They are not in one of the memories.
    fn place(&mut self, at: u64, size: usize) -> Result<&mut [u8], Wild>;
}

impl Places for [Memory<'_>] {
    fn place(&mut self, at: u64, size: usize) -> Result<&mut [u8], Wild> {
        let within = |memory: &mut Memory| {
            let first = usize::try_from(at.checked_sub(memory.address)?).ok()?;
            (first.checked_add(size)? <= memory.bytes.len()).then_some(first)
        };
        let found = self.iter_mut().enumerate().find_map(|(index, memory)| Some((index, within(memory)?)));
        let (index, first) = found.ok_or(Wild(at))?;
        Ok(&mut self[index].bytes[first..first + size])
    }
}

/// The functions that a program may call.
pub(in crate::engine) trait Calls {
    /// Calls the function at an address with these numbers; what it returns is only used if `returns`.
    fn call(&mut self, function: u64, arguments: &[u64], returns: bool) -> u64;
}

impl<F: FnMut(u64, &[u64]) -> u64> Calls for F {
    fn call(&mut self, function: u64, arguments: &[u64], _returns: bool) -> u64 {
        self(function, arguments)
    }
}

impl Program {
    /// Runs it with these parameters; returns its result.
    ///
    /// # Errors
    /// It accesses what is in none of the memories: the address.
    pub fn evaluate(
        &self,
        parameters: [u64; 3],
        memories: &mut (impl Places + ?Sized),
        called: &mut impl Calls,
    ) -> Result<u64, Wild> {
        self.evaluate_watched(parameters, memories, called, &mut |_, _| {})
    }

    /// The same; `watch` is called with each value each time that it is defined.
    ///
    /// # Errors
    /// As [`Program::evaluate`].
    pub fn evaluate_watched(
        &self,
        parameters: [u64; 3],
        memories: &mut (impl Places + ?Sized),
        called: &mut impl Calls,
        watch: &mut impl FnMut(Value, &Bytes),
    ) -> Result<u64, Wild> {
        let mut run = Run { program: self, values: vec![Bytes::default(); self.values.len()], memories, called, watch };
        for (value, number) in Program::PARAMETERS.into_iter().zip(parameters) {
            run.values[value.index()] = of_number(number);
        }
        match run.region(&self.body)? {
            Next::Returned(number) => Ok(number),
            Next::Statement | Next::Left(_) => unreachable!("a program ends with a return"),
        }
    }
}

/// An access outside of all memories.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::engine) struct Wild(pub u64);

/// What follows a statement.
enum Next {
    Statement,
    Left(Vec<Bytes>),
    Returned(u64),
}

struct Run<'p, P: ?Sized, C, W> {
    program: &'p Program,
    values: Vec<Bytes>,
    memories: &'p mut P,
    called: &'p mut C,
    watch: &'p mut W,
}

impl<P: Places + ?Sized, C: Calls, W: FnMut(Value, &Bytes)> Run<'_, P, C, W> {
    fn ty(&self, value: Value) -> Type {
        self.program.type_of(value)
    }

    fn of(&self, value: Value) -> Bytes {
        self.values[value.index()]
    }

    fn all(&self, values: &[Value]) -> Vec<Bytes> {
        values.iter().map(|value| self.of(*value)).collect()
    }

    fn define(&mut self, values: &[Value], bytes: Vec<Bytes>) {
        values.iter().zip(bytes).for_each(|(value, bytes)| self.set(*value, bytes));
    }

    fn set(&mut self, value: Value, bytes: Bytes) {
        (self.watch)(value, &bytes);
        self.values[value.index()] = bytes;
    }

    fn number(&self, value: Value) -> u64 {
        number(self.of(value))
    }

    fn region(&mut self, region: &Region) -> Result<Next, Wild> {
        for statement in region {
            match self.statement(statement)? {
                Next::Statement => {}
                other => return Ok(other),
            }
        }
        Ok(Next::Statement)
    }

    fn statement(&mut self, statement: &Statement) -> Result<Next, Wild> {
        match statement {
            Statement::Let(value) => {
                let (operation, ty) = &self.program.values[value.index()];
                let bytes = self.operation(operation, *ty)?;
                self.set(*value, bytes);
            }
            Statement::Call { function, arguments } => _ = self.call(*function, arguments, false),
            Statement::Store { value, address, offset, .. } => {
                let (bytes, size) = (self.of(*value), size(self.ty(*value)));
                self.place(*address, *offset, size)?.copy_from_slice(&bytes[..size]);
            }
            Statement::If { flag, then, otherwise } => {
                return self.region(if self.number(*flag) == 0 { otherwise } else { then });
            }
            Statement::Switch { subject, table, regions } => {
                return self.region(&regions[table[self.number(*subject) as usize]]);
            }
            Statement::Loop(all) => return self.repeat(all),
            Statement::LeaveUnless { flag, results } => {
                if self.number(*flag) == 0 {
                    return Ok(Next::Left(self.all(results)));
                }
            }
            Statement::Then => {}
            Statement::Return(value) => return Ok(Next::Returned(self.number(*value))),
        }
        Ok(Next::Statement)
    }

    fn repeat(&mut self, all: &Loop) -> Result<Next, Wild> {
        let mut given = self.all(&all.start);
        loop {
            self.define(&all.parameters, given);
            let results = match self.region(&all.body)? {
                Next::Returned(number) => return Ok(Next::Returned(number)),
                Next::Left(results) => results,
                Next::Statement => match &all.again {
                    Some((flag, next)) if self.number(*flag) != 0 => {
                        given = self.all(next);
                        continue;
                    }
                    _ => self.all(&all.end),
                },
            };
            self.define(&all.results, results);
            return Ok(Next::Statement);
        }
    }

    fn call(&mut self, function: Value, arguments: &[Value], returns: bool) -> u64 {
        let arguments: Vec<u64> = arguments.iter().map(|value| self.number(*value)).collect();
        let function = self.number(function);
        self.called.call(function, &arguments, returns)
    }

    /// The bytes at an address and offset.
    fn place(&mut self, address: Value, offset: i32, size: usize) -> Result<&mut [u8], Wild> {
        let at = self.number(address).wrapping_add_signed(offset.into());
        self.memories.place(at, size)
    }

    fn operation(&mut self, operation: &Operation, ty: Type) -> Result<Bytes, Wild> {
        Ok(match operation {
            Operation::Parameter => unreachable!("a parameter is not computed"),
            Operation::Constant(number) => lanes(ty, |_| *number as u64),
            Operation::Address(address) => of_number(*address as u64),
            Operation::Bytes(bytes) => *bytes,
            Operation::Unary(unary, of) => self.unary(*unary, *of, ty),
            Operation::Binary(binary, x, y) => {
                binary_of(*binary, ty, (self.ty(*x), self.of(*x)), (self.ty(*y), self.of(*y)))
            }
            Operation::Compare(comparison, x, y) => {
                let (of, x, y) = (self.ty(*x), self.of(*x), self.of(*y));
                let ones = if of.is_vector() { u64::MAX } else { 1 };
                lanes(ty, |i| if holds(*comparison, of.element(), lane(of, x, i), lane(of, y, i)) { ones } else { 0 })
            }
            Operation::Select(flag, x, y) => self.of(if self.number(*flag) == 0 { *y } else { *x }),
            Operation::Blend(mask, x, y) => {
                let [mask, x, y] = [mask, x, y].map(|value| self.of(*value));
                std::array::from_fn(|i| x[i] & mask[i] | y[i] & !mask[i])
            }
            Operation::Shuffle(x, y, bytes) => {
                let [x, y] = [x, y].map(|value| self.of(*value));
                let both = [&x[..size(ty)], &y[..size(ty)]].concat();
                lanes(ty, |i| both[usize::from(bytes[i as usize])].into())
            }
            Operation::Lane(of, index) => of_number(lane(self.ty(*of), self.of(*of), u32::from(*index))),
            Operation::WithLane(vector, number, index) => {
                let (vector, number) = (self.of(*vector), self.number(*number));
                lanes(ty, |i| if i == u32::from(*index) { number } else { lane(ty, vector, i) })
            }
            Operation::Load { load: Load::Whole, address, offset, .. } => {
                let (mut bytes, size) = (Bytes::default(), size(ty));
                bytes[..size].copy_from_slice(self.place(*address, *offset, size)?);
                bytes
            }
            Operation::Load { load, address, offset, .. } => {
                let (mut bytes, half) = (Bytes::default(), size(ty) / 2);
                bytes[..half].copy_from_slice(self.place(*address, *offset, half)?);
                let narrow = ty.narrowed();
                lanes(ty, |i| extended(*load == Load::SignExtended, narrow.element(), lane(narrow, bytes, i)))
            }
            Operation::Call(function, arguments) => of_number(self.call(*function, arguments, true)),
        })
    }

    fn unary(&self, unary: Unary, of: Value, ty: Type) -> Bytes {
        let (from, bytes) = (self.ty(of), self.of(of));
        let each = |change: &dyn Fn(u64) -> u64| lanes(ty, |i| change(lane(from, bytes, i)));
        let widened =
            |signed: bool, first: u32| lanes(ty, |i| extended(signed, from.element(), lane(from, bytes, first + i)));
        match unary {
            Unary::Not => each(&|number| !number),
            Unary::Neg => each(&u64::wrapping_neg),
            Unary::CountOnes => each(&|number| number.count_ones().into()),
            Unary::ZeroExtend | Unary::Truncate => of_number(number(lanes(ty, |_| number(bytes)))),
            Unary::SignExtend => each(&|number| extended(true, from.element(), number)),
            Unary::Cast => lanes(ty, |i| lane(ty, bytes, i)),
            Unary::Splat => lanes(ty, |_| number(bytes)),
            Unary::Lowest => lanes(ty, |i| if i == 0 { number(bytes) } else { 0 }),
            Unary::WidenLow { signed } => widened(signed, 0),
            Unary::WidenHigh { signed } => widened(signed, ty.lanes()),
            Unary::HighBits => {
                let bit = |i: u32| lane(from, bytes, i) >> (from.element() - 1) << i;
                of_number((0..from.lanes()).map(bit).sum())
            }
            Unary::AnyBit => of_number(u64::from(bytes != Bytes::default())),
            Unary::ToFloat => each(&|number| (number as i32 as f32).to_bits().into()),
            Unary::ToInteger => each(&|number| (f32::from_bits(number as u32) as u32).into()),
        }
    }
}

/// The result of an operation on two values with their types.
fn binary_of(binary: Binary, ty: Type, (left, p): (Type, Bytes), (right, q): (Type, Bytes)) -> Bytes {
    let each = |both: &dyn Fn(u64, u64) -> u64| lanes(ty, |i| both(lane(left, p, i), lane(right, q, i)));
    let element = ty.element();
    let by = (number(q) % u64::from(element)) as u32;
    match binary {
        Binary::Add => each(&u64::wrapping_add),
        Binary::Sub => each(&u64::wrapping_sub),
        Binary::Mul => each(&u64::wrapping_mul),
        Binary::Div => each(&|x, y| x / y),
        Binary::And => each(&|x, y| x & y),
        Binary::Or => each(&|x, y| x | y),
        Binary::Xor => each(&|x, y| x ^ y),
        Binary::Min => each(&u64::min),
        Binary::Shl => lanes(ty, |i| lane(left, p, i) << by),
        Binary::Shr => lanes(ty, |i| lane(left, p, i) >> by),
        Binary::Sar => lanes(ty, |i| (extended(true, element, lane(left, p, i)) as i64 >> by) as u64),
        Binary::RotateLeft => lanes(ty, |i| {
            let number = lane(left, p, i);
            if by == 0 { number } else { number << by | number >> (element - by) }
        }),
        Binary::Narrow { signed } => lanes(ty, |i| {
            let (bytes, at) = if i < left.lanes() { (p, i) } else { (q, i - left.lanes()) };
            let number = extended(true, left.element(), lane(left, bytes, at)) as i64;
            let limit = 1i64 << (element - u32::from(signed));
            number.clamp(if signed { -limit } else { 0 }, limit - 1) as u64
        }),
        Binary::Swizzle | Binary::LookUp => {
            lanes(ty, |i| if q[i as usize] < 16 { p[usize::from(q[i as usize])].into() } else { 0 })
        }
        Binary::MulFloat => each(&|x, y| (f32::from_bits(x as u32) * f32::from_bits(y as u32)).to_bits().into()),
    }
}

/// Whether integers of this many bits are in a relation.
fn holds(comparison: Comparison, bits: u32, x: u64, y: u64) -> bool {
    let [p, q] = [x, y].map(|number| extended(true, bits, number) as i64);
    match comparison {
        Comparison::Equal => x == y,
        Comparison::NotEqual => x != y,
        Comparison::SignedLessThan => p < q,
        Comparison::SignedLessThanOrEqual => p <= q,
        Comparison::SignedGreaterThan => p > q,
        Comparison::SignedGreaterThanOrEqual => p >= q,
        Comparison::UnsignedLessThan => x < y,
        Comparison::UnsignedLessThanOrEqual => x <= y,
        Comparison::UnsignedGreaterThan => x > y,
        Comparison::UnsignedGreaterThanOrEqual => x >= y,
    }
}

/// A number of this many bits, extended.
fn extended(signed: bool, bits: u32, number: u64) -> u64 {
    if signed { ((number << (64 - bits)) as i64 >> (64 - bits)) as u64 } else { number }
}

/// Bytes of a value.
fn size(ty: Type) -> usize {
    ty.bytes() as usize
}

/// The number in a lane.
fn lane(ty: Type, bytes: Bytes, index: u32) -> u64 {
    let size = ty.element() as usize / 8;
    let first = index as usize * size;
    bytes[first..first + size].iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
}

/// A value of these numbers, each cut to its size.
fn lanes(ty: Type, number: impl Fn(u32) -> u64) -> Bytes {
    let (mut bytes, size) = (Bytes::default(), ty.element() as usize / 8);
    for (index, bytes) in (0..ty.lanes()).zip(bytes.chunks_mut(size)) {
        bytes.copy_from_slice(&number(index).to_le_bytes()[..size]);
    }
    bytes
}

fn number(bytes: Bytes) -> u64 {
    lane(Type::I64, bytes, 0)
}

fn of_number(number: u64) -> Bytes {
    lanes(Type::I64, |_| number)
}
