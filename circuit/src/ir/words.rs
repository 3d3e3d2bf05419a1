//! Operations in the words of a description: the operators and methods that it writes.

use super::{Binary, Reduction, Relation, Shift};

impl Binary {
    /// The operator as Rust writes it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!([ir::Binary::Add, ir::Binary::MulSigned].map(ir::Binary::symbol), ["+", "*"]);
    /// ```
    pub fn symbol(self) -> &'static str {
        match self {
            Binary::And => "&",
            Binary::Or => "|",
            Binary::Xor => "^",
            Binary::Add => "+",
            Binary::Sub => "-",
            Binary::Mul | Binary::MulSigned => "*",
        }
    }
}

impl Shift {
    /// The operator as Rust writes it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // The operand decides whether `>>` is signed, so both right shifts have one operator.
    /// assert_eq!([ir::Shift::Right, ir::Shift::RightSigned].map(ir::Shift::symbol), [">>", ">>"]);
    /// ```
    pub fn symbol(self) -> &'static str {
        match self {
            Shift::Left => "<<",
            Shift::Right | Shift::RightSigned => ">>",
        }
    }
}

impl Reduction {
    /// The method's name.
    #[doc(hidden)]
    pub fn method(self) -> &'static str {
        match self {
            Reduction::And => "and_all",
            Reduction::Or => "or_all",
            Reduction::Xor => "xor_all",
            Reduction::Add => "sum",
            Reduction::Min => "minimum",
            Reduction::Max => "maximum",
        }
    }
}

impl Relation {
    /// The method's name.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!([ir::Relation::Lt, ir::Relation::Ge].map(ir::Relation::method), ["lt", "ge"]);
    /// ```
    pub fn method(self) -> &'static str {
        match self {
            Relation::Eq => "eq",
            Relation::Ne => "ne",
            Relation::Lt => "lt",
            Relation::Le => "le",
            Relation::Gt => "gt",
            Relation::Ge => "ge",
        }
    }
}
