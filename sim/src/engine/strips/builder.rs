//! Records a strip program.

use std::any::Any;
use std::sync::Arc;

use super::operation::{Binary, Comparison, Load, Operation, Unary};
use super::program::{Loop, Program, Region, Statement};
use super::value::{Bytes, Type, Value};

/// Objects that programs refer to by address.
pub(in crate::engine) type Kept = Vec<Arc<dyn Any + Send + Sync>>;

/// A strip program that is being written. Statements go to the end of the innermost open region.
pub(in crate::engine) struct Builder {
    program: Program,
    /// Bits of a vector.
    vector: u32,
    /// The regions around the innermost one.
    outer: Vec<Region>,
    /// The limbs of scratch memory in use.
    taken: usize,
    /// The objects that the program refers to by address.
    kept: Kept,
}

impl Builder {
    /// An empty program for a target with vectors of so many bits.
    pub fn new(vector: u32) -> Self {
        let values = Program::PARAMETERS.map(|_| (Operation::Parameter, Type::I64)).to_vec();
        let program = Program { values, body: Region::new(), scratch: 0, stack_of_called: 0 };
        Builder { program, vector, outer: Vec::new(), taken: 0, kept: Kept::new() }
    }

    /// The program, without what it does not use, and the objects that it refers to.
    pub fn finish(self) -> (Program, Kept) {
        debug_assert!(self.outer.is_empty(), "a region is open");
        (self.program.without_unused(), self.kept)
    }

    /// Bits of a vector.
    pub fn vector_bits(&self) -> u32 {
        self.vector
    }

    /// The type of vectors of integers that have `element` bits each.
    pub fn vector(&self, element: u32) -> Type {
        Type::vector(element, self.vector)
    }

    /// The type of a value.
    pub fn type_of(&self, value: Value) -> Type {
        self.program.type_of(value)
    }

    /// The definition of a value.
    pub(super) fn operation(&self, value: Value) -> &Operation {
        &self.program.values[value.index()].0
    }

    /// The program as it was recorded.
    pub(super) fn whole(self) -> Program {
        self.program
    }

    /// Adds a step.
    pub(super) fn push(&mut self, statement: Statement) {
        self.program.body.push(statement);
    }

    /// A value without a statement: what a region gets or gives.
    pub fn parameter(&mut self, ty: Type) -> Value {
        self.defined(Operation::Parameter, ty)
    }

    fn defined(&mut self, operation: Operation, ty: Type) -> Value {
        self.program.values.push((operation, ty));
        Value(self.program.values.len() as u32 - 1)
    }

    /// Computes a value.
    pub(super) fn value(&mut self, operation: Operation, ty: Type) -> Value {
        let value = self.defined(operation, ty);
        self.push(Statement::Let(value));
        value
    }

    /// An integer.
    pub fn constant(&mut self, ty: Type, number: i64) -> Value {
        self.value(Operation::Constant(number), ty)
    }

    /// An address that is known now.
    pub fn address(&mut self, address: usize) -> Value {
        self.value(Operation::Address(address), Type::ADDRESS)
    }

    /// A vector whose lanes have these numbers.
    pub fn numbers(&mut self, ty: Type, lane: impl Fn(u32) -> u64) -> Value {
        let size = ty.element() as usize / 8;
        let byte = |i: usize| lane((i / size) as u32).to_le_bytes()[i % size];
        self.value(Operation::Bytes(bytes(ty, byte)), ty)
    }

    /// An operation on one value, with a result of another type.
    pub(super) fn to(&mut self, unary: Unary, ty: Type, of: Value) -> Value {
        self.value(Operation::Unary(unary, of), ty)
    }

    /// An operation on two values, with a result of the first one's type.
    pub(super) fn both(&mut self, binary: Binary, x: Value, y: Value) -> Value {
        let ty = self.type_of(x);
        self.value(Operation::Binary(binary, x, y), ty)
    }

    /// An operation on a value and a constant of its type.
    pub(super) fn with_constant(&mut self, binary: Binary, x: Value, y: i64) -> Value {
        let ty = self.type_of(x);
        let y = self.constant(ty, y);
        self.both(binary, x, y)
    }

    /// Whether integers are in a relation.
    pub fn compare(&mut self, comparison: Comparison, x: Value, y: Value) -> Value {
        let of = self.type_of(x);
        let ty = if of.is_vector() { of } else { Type::I8 };
        self.value(Operation::Compare(comparison, x, y), ty)
    }

    /// `x` if a flag is 1, else `y`.
    pub fn select(&mut self, flag: Value, x: Value, y: Value) -> Value {
        let ty = self.type_of(x);
        self.value(Operation::Select(flag, x, y), ty)
    }

    /// Each bit of `x` where the mask is 1, else of `y`.
    pub fn blend(&mut self, mask: Value, x: Value, y: Value) -> Value {
        let ty = self.type_of(mask);
        self.value(Operation::Blend(mask, x, y), ty)
    }

    /// Bytes chosen of two vectors, one after the other; `byte` gives the number of each.
    pub fn shuffle(&mut self, x: Value, y: Value, byte: impl Fn(usize) -> usize) -> Value {
        let ty = self.type_of(x);
        self.value(Operation::Shuffle(x, y, bytes(ty, |i| byte(i) as u8)), ty)
    }

    /// A number of a vector.
    pub fn lane(&mut self, of: Value, lane: u8) -> Value {
        let ty = self.type_of(of).of_lane();
        self.value(Operation::Lane(of, lane), ty)
    }

    /// A vector with another number in a lane.
    pub fn with_lane(&mut self, vector: Value, number: Value, lane: u8) -> Value {
        let ty = self.type_of(vector);
        self.value(Operation::WithLane(vector, number, lane), ty)
    }

    /// Loads from a place that is a multiple of the type's size.
    pub fn load(&mut self, ty: Type, address: Value, offset: i32) -> Value {
        self.load_as(Load::Whole, ty, true, address, offset)
    }

    /// Loads in one of the ways.
    pub fn load_as(&mut self, load: Load, ty: Type, aligned: bool, address: Value, offset: i32) -> Value {
        self.value(Operation::Load { load, aligned, address, offset }, ty)
    }

    /// Stores at a place that is a multiple of the type's size.
    pub fn store(&mut self, value: Value, address: Value, offset: i32) {
        self.store_as(true, value, address, offset);
    }

    /// Stores at a place that is such a multiple if `aligned`.
    pub fn store_as(&mut self, aligned: bool, value: Value, address: Value, offset: i32) {
        self.push(Statement::Store { value, aligned, address, offset });
    }

    /// Calls the function at an address, in the C convention of this machine; returns its result.
    pub fn call(&mut self, address: usize, arguments: &[Value]) -> Value {
        let function = self.address(address);
        self.value(Operation::Call(function, arguments.to_vec()), Type::I64)
    }

    /// Calls a function without a result.
    pub fn call_only(&mut self, address: usize, arguments: &[Value]) {
        let function = self.address(address);
        self.push(Statement::Call { function, arguments: arguments.to_vec() });
    }

    /// Calls generated code that takes at most this much stack.
    pub fn call_code(&mut self, code: Value, arguments: &[Value], stack: usize) {
        self.value(Operation::Call(code, arguments.to_vec()), Type::I64);
        self.calls_code(stack);
    }

    /// Notes a call of generated code that takes at most this much stack.
    pub fn calls_code(&mut self, stack: usize) {
        self.program.stack_of_called = self.program.stack_of_called.max(stack);
    }

    /// Keeps an object as long as the program; returns its address.
    pub fn keep<T: Any + Send + Sync>(&mut self, object: Arc<T>) -> Value {
        let address = self.address(Arc::as_ptr(&object) as usize);
        self.kept.push(object);
        address
    }

    /// Opens a region: what follows goes there.
    pub fn open(&mut self) {
        self.outer.push(std::mem::take(&mut self.program.body));
    }

    /// Closes the innermost region, for a statement that runs it.
    pub fn close(&mut self) -> Region {
        let outer = self.outer.pop().expect("a region is open");
        std::mem::replace(&mut self.program.body, outer)
    }

    /// Runs a region if a flag is not zero, else the other one.
    pub fn branch(&mut self, flag: Value, then: Region, otherwise: Region) {
        match self.operation(flag) {
            Operation::Constant(0) => self.program.body.extend(otherwise),
            Operation::Constant(_) => self.program.body.extend(then),
            _ => self.push(Statement::If { flag, then, otherwise }),
        }
    }

    /// Runs the region whose number the table has for an integer.
    pub fn switch(&mut self, subject: Value, table: Vec<usize>, regions: Vec<Region>) {
        self.push(Statement::Switch { subject, table, regions });
    }

    /// Runs the body of a loop.
    pub fn repeat(&mut self, all: Loop) {
        self.push(Statement::Loop(Box::new(all)));
    }

    /// Leaves the loop in whose body this is if a flag is zero.
    pub fn leave_unless(&mut self, flag: Value, results: &[Value]) {
        self.push(Statement::LeaveUnless { flag, results: results.to_vec() });
    }

    /// What follows reads what has been changed so far.
    pub fn then(&mut self) {
        self.push(Statement::Then);
    }

    /// Ends the function.
    pub fn give(&mut self, number: Value) {
        self.push(Statement::Return(number));
    }

    /// The address of the scratch memory.
    pub fn scratch(&self) -> Value {
        Program::PARAMETERS[2]
    }

    /// Allocates limbs of the scratch memory; returns the first.
    pub fn take(&mut self, limbs: usize) -> usize {
        let first = self.taken;
        self.taken += limbs;
        self.program.scratch = self.program.scratch.max(self.taken);
        first
    }

    /// The limbs of scratch memory in use.
    pub fn taken(&self) -> usize {
        self.taken
    }

    /// Frees everything allocated since `taken` limbs were in use.
    pub fn give_back(&mut self, taken: usize) {
        self.taken = taken;
    }
}

/// As many bytes as a type has.
fn bytes(ty: Type, byte: impl Fn(usize) -> u8) -> Bytes {
    std::array::from_fn(|i| if i < ty.bytes() as usize { byte(i) } else { 0 })
}

#[cfg(test)]
mod tests {
    use super::super::text::Notes;
    use super::*;

    #[test]
    fn what_is_known_costs_nothing() {
        let mut b = Builder::new(128);
        let [state, argument, _] = Program::PARAMETERS;
        let byte = b.load(Type::I8, state, 8);
        let wide = b.zero_extend(Type::I64, byte);
        let (narrow, other) = (b.truncate(Type::I8, wide), b.truncate(Type::I32, wide));
        assert_eq!((narrow, other == wide), (byte, false));
        for (number, stored) in [(0x1ff, "store i8 [state + 24] 255"), (0x200, "store i8 [state + 16] 0")] {
            let mut b = Builder::new(128);
            let known = b.constant(Type::I64, number);
            let flag = b.truncate(Type::I8, known);
            let regions = [24, 16].map(|offset| {
                b.open();
                b.store(flag, state, offset);
                b.close()
            });
            let [then, otherwise] = regions;
            b.branch(flag, then, otherwise);
            b.give(argument);
            assert_eq!(b.finish().0.text(&Notes::NONE), format!("{stored}\nreturn argument\n"));
        }
    }
}
