//! The operations of the processors.

use tilewright_hdl::codes;

codes! {
    /// The operations on the accumulator A, the operand M, the constant K and the plane's value P. Only active
    /// processors change their accumulator.
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
}
