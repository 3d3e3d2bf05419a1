//! Values of a strip program and their types.

/// A value, by the number of its definition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(in crate::engine) struct Value(pub u32);

impl Value {
    /// Its place in lists that have something for each value.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The type of a value: a number, or a vector of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::engine) struct Type {
    /// Bits of a number.
    element: u8,
    is_float: bool,
    /// The numbers of a vector; 1 for a number alone.
    lanes: u8,
}

impl Type {
    pub const I8: Type = Type::integers(8, 1);
    pub const I32: Type = Type::integers(32, 1);
    pub const I64: Type = Type::integers(64, 1);
    pub const I8X16: Type = Type::integers(8, 16);
    pub const I16X8: Type = Type::integers(16, 8);
    pub const I32X4: Type = Type::integers(32, 4);
    pub const I64X2: Type = Type::integers(64, 2);
    pub const F32X4: Type = Type { element: 32, is_float: true, lanes: 4 };
    pub const F64X2: Type = Type { element: 64, is_float: true, lanes: 2 };
    /// All of them.
    pub(super) const ALL: [Type; 12] = [
        Type::I8,
        Type::integers(16, 1),
        Type::I32,
        Type::I64,
        Type { element: 32, is_float: true, lanes: 1 },
        Type { element: 64, is_float: true, lanes: 1 },
        Type::I8X16,
        Type::I16X8,
        Type::I32X4,
        Type::I64X2,
        Type::F32X4,
        Type::F64X2,
    ];
    /// The type of addresses.
    pub const ADDRESS: Type = Type::I64;

    const fn integers(element: u8, lanes: u8) -> Type {
        Type { element, is_float: false, lanes }
    }

    /// The integer with this number of bits: 8, 16, 32 or 64.
    pub fn integer(bits: u32) -> Type {
        debug_assert!(matches!(bits, 8 | 16 | 32 | 64), "an integer of {bits} bits");
        Type::integers(bits as u8, 1)
    }

    /// Bits of a number, or of each number of a vector.
    pub fn element(self) -> u32 {
        self.element.into()
    }

    /// The type of a number of a vector.
    pub fn of_lane(self) -> Type {
        Type { lanes: 1, ..self }
    }

    /// Vectors of half as many integers, each twice as wide.
    pub fn widened(self) -> Type {
        Type::integers(self.element * 2, self.lanes / 2)
    }

    /// Vectors of twice as many integers, each half as wide.
    pub fn narrowed(self) -> Type {
        Type::integers(self.element / 2, self.lanes * 2)
    }

    /// Whether it has several numbers.
    pub fn is_vector(self) -> bool {
        self.lanes > 1
    }

    /// Whether its numbers are floats.
    pub fn is_float(self) -> bool {
        self.is_float
    }

    /// Bytes of a value.
    pub fn bytes(self) -> i64 {
        i64::from(self.element) * i64::from(self.lanes) / 8
    }

    /// The numbers of a vector; 1 for a number alone.
    pub fn lanes(self) -> u32 {
        self.lanes.into()
    }
}
