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

/// The bytes of a value, those of its lowest lane first; those above its size are zero.
pub(in crate::engine) type Bytes = [u8; 32];

/// The widths of vectors that a target may have, in bits.
pub(super) const VECTORS: [u32; 3] = [64, 128, 256];

/// The type of a value: a number, or a vector of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::engine) struct Type {
    /// Bits of a number.
    element: u8,
    is_float: bool,
    /// The numbers of a vector; 0 for a number alone.
    lanes: u8,
}

impl Type {
    pub const I8: Type = Type::integers(8, 0);
    pub const I32: Type = Type::integers(32, 0);
    pub const I64: Type = Type::integers(64, 0);
    /// The type of addresses.
    pub const ADDRESS: Type = Type::I64;
    /// The type of tables, in which bytes are looked up by their numbers. It is the same for all targets.
    pub const TABLE: Type = Type::integers(8, 16);

    const fn integers(element: u8, lanes: u8) -> Type {
        Type { element, is_float: false, lanes }
    }

    /// All of them.
    pub fn all() -> impl Iterator<Item = Type> {
        let alone = [8, 16, 32, 64].map(Type::integer);
        let vectors = VECTORS.into_iter().flat_map(|bits| [8, 16, 32, 64].map(|element| Type::vector(element, bits)));
        alone.into_iter().chain(vectors).flat_map(|of| [of, of.floats()]).filter(|of| !of.is_float || of.element >= 32)
    }

    /// The integer with this number of bits: 8, 16, 32 or 64.
    pub fn integer(bits: u32) -> Type {
        debug_assert!(matches!(bits, 8 | 16 | 32 | 64), "an integer of {bits} bits");
        Type::integers(bits as u8, 0)
    }

    /// A vector of so many bits, of integers that have `element` bits each.
    pub fn vector(element: u32, bits: u32) -> Type {
        debug_assert!(VECTORS.contains(&bits), "a vector of {bits} bits");
        Type::integers(element as u8, (bits / element) as u8)
    }

    /// Floats of the same size in place of integers.
    pub fn floats(self) -> Type {
        Type { is_float: true, ..self }
    }

    /// Whether it is an integer, and no vector.
    pub fn is_integer(self) -> bool {
        !self.is_vector() && !self.is_float()
    }

    /// Whether it is a vector of integers.
    pub fn is_integers(self) -> bool {
        self.is_vector() && !self.is_float()
    }

    /// Bits of a number, or of each number of a vector.
    pub fn element(self) -> u32 {
        self.element.into()
    }

    /// The type of a number of a vector.
    pub fn of_lane(self) -> Type {
        Type { lanes: 0, ..self }
    }

    /// Vectors of half as many integers, each twice as wide.
    pub fn widened(self) -> Type {
        Type::integers(self.element * 2, self.lanes / 2)
    }

    /// Vectors of twice as many integers, each half as wide.
    pub fn narrowed(self) -> Type {
        Type::integers(self.element / 2, self.lanes * 2)
    }

    /// Whether it is a vector.
    pub fn is_vector(self) -> bool {
        self.lanes > 0
    }

    /// Whether its numbers are floats.
    pub fn is_float(self) -> bool {
        self.is_float
    }

    /// Bits of a value.
    pub fn bits(self) -> u32 {
        self.element() * self.lanes()
    }

    /// Bytes of a value.
    pub fn bytes(self) -> i64 {
        i64::from(self.bits() / 8)
    }

    /// The numbers of a vector; 1 for a number alone.
    pub fn lanes(self) -> u32 {
        self.lanes.max(1).into()
    }
}

/// Vectors of code.
#[cfg(test)]
impl Type {
    pub const I8X16: Type = Type::integers(8, 16);
    pub const I16X8: Type = Type::integers(16, 8);
    pub const I32X4: Type = Type::integers(32, 4);
    pub const I64X2: Type = Type::integers(64, 2);
}
