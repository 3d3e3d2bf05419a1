//! The instructions of the processors.

use tilewright_hdl::{Width, bits, bundle};

bundle! {
    /// An instruction, in its two clocks.
    pub struct Instruction<T> {
        /// The operand's address, a clock ahead of the rest.
        pub read_address: T,
        /// The operation: an [`Opcode`].
        pub opcode: T,
        /// The address of a result.
        pub write_address: T,
        /// A constant.
        pub constant: T,
    }
}

impl Instruction<Width> {
    /// The widths of its fields.
    pub fn widths() -> Instruction<Width> {
        Instruction { read_address: bits(8), opcode: bits(4), write_address: bits(8), constant: bits(8) }
    }
}

/// The operations on the accumulator A, the operand M, the constant K and the plane's value P. Only active processors
/// change their accumulator.
#[derive(Debug, Clone, Copy)]
pub enum Opcode {
    /// Nothing.
    Nothing,
    /// A = M
    Load,
    /// M = A, at the result's address
    Store,
    /// A = A + M
    Add,
    /// A = A - M
    Subtract,
    /// Stays active if A < M
    IfLess,
    /// All are active
    Everybody,
    /// A = P
    Plane,
    /// A = A + K
    AddConstant,
    /// A = A & M
    And,
    /// A = A ^ M
    Xor,
    /// A = A / 2
    Halve,
    /// Stays active if A >= K
    IfAtLeast,
    /// A = A + P
    AddPlane,
    /// A = A ^ K
    XorConstant,
    /// The others become active
    Else,
}
