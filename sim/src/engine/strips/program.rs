//! A function as a strip program.

use super::operation::Operation;
use super::value::{Type, Value};

/// A function of three numbers: the address of the state, an argument, and the address of scratch memory. It returns a number.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(in crate::engine) struct Program {
    /// The definition of each value, and its type.
    pub values: Vec<(Operation, Type)>,
    pub body: Region,
    /// The limbs of scratch memory that it takes.
    pub scratch: usize,
    /// The largest stack of the generated code that it calls, in bytes.
    pub stack_of_called: usize,
}

impl Program {
    /// The address of the state, the argument, and the address of scratch memory.
    pub const PARAMETERS: [Value; 3] = [Value(0), Value(1), Value(2)];

    /// The type of a value.
    pub fn type_of(&self, value: Value) -> Type {
        self.values[value.index()].1
    }
}

/// Statements one after another. A value is visible in what follows its statement in the region, and in regions there.
pub(in crate::engine) type Region = Vec<Statement>;

/// A step of a region.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(in crate::engine) enum Statement {
    /// Computes a value by its definition.
    Let(Value),
    /// Calls a function of the C convention without a result.
    Call {
        function: Value,
        arguments: Vec<Value>,
    },
    /// Stores a value at an address and offset; `aligned` if the place is a multiple of its size.
    Store {
        value: Value,
        aligned: bool,
        address: Value,
        offset: i32,
    },
    /// One region if a flag is not zero, else the other one.
    If {
        flag: Value,
        then: Region,
        otherwise: Region,
    },
    /// The region whose number the table has for an integer, which is below its length. A table of two is for a flag.
    Switch {
        subject: Value,
        table: Vec<usize>,
        regions: Vec<Region>,
    },
    Loop(Box<Loop>),
    /// Leaves the loop whose body this is with these results if a flag is zero.
    LeaveUnless {
        flag: Value,
        results: Vec<Value>,
    },
    /// Ends a part: what follows reads what it has changed.
    Then,
    /// Ends the function.
    Return(Value),
}

/// A body that runs once or several times. What it defines before the first [`Statement::LeaveUnless`] is visible after the loop.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(in crate::engine) struct Loop {
    /// What the body gets, at first from `start`.
    pub parameters: Vec<Value>,
    pub start: Vec<Value>,
    pub body: Region,
    /// Whether the body runs again, by a flag, and what it then gets. Without it, it runs once.
    pub again: Option<(Value, Vec<Value>)>,
    /// What the results are if it does not.
    pub end: Vec<Value>,
    /// The results, from there or from [`Statement::LeaveUnless`].
    pub results: Vec<Value>,
}
