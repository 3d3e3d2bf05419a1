//! Values of a scene file that the TOML library's own types check too loosely: it ignores surplus elements of an array.

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// Exactly `N` numbers.
pub(super) struct Vector<T, const N: usize>(pub(super) [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Vector<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Numbers(PhantomData))
    }
}

struct Numbers<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Numbers<T, N> {
    type Value = Vector<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of length {N}")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Self::Value, A::Error> {
        let mut all = Vec::with_capacity(N);
        while let Some(number) = numbers.next_element()? {
            all.push(number);
        }
        let length = all.len();
        all.try_into().map(Vector).map_err(|_| A::Error::invalid_length(length, &self))
    }
}

/// A table, but not a list of values or a list of tables, which the library would accept for one.
#[derive(Default)]
pub(super) struct Table<T>(pub(super) T);

/// Keys in a table.
pub(super) trait Keys {
    /// The name of the table.
    const NAME: &str;
    /// Whether it is one of a list.
    const IS_LISTED: bool;

    /// The remedy when there is no such table.
    fn expected(f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = Self::NAME;
        if Self::IS_LISTED {
            write!(f, "`[[{name}]]` above each {name}")
        } else {
            write!(f, "`[{name}]` above its keys")
        }
    }
}

impl<'de, T: Deserialize<'de> + Keys> Deserialize<'de> for Table<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneTable(PhantomData))
    }
}

struct OneTable<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de> + Keys> Visitor<'de> for OneTable<T> {
    type Value = Table<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        T::expected(f)
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<Self::Value, A::Error> {
        T::deserialize(MapAccessDeserializer::new(table)).map(Table)
    }
}

/// A list of tables; a single one is a likely slip and gets a message of its own.
pub(super) fn tables<'de, D, T>(from: D) -> Result<Option<Vec<Table<T>>>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de> + Keys,
{
    from.deserialize_any(Tables(PhantomData)).map(Some)
}

struct Tables<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de> + Keys> Visitor<'de> for Tables<T> {
    type Value = Vec<Table<T>>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        T::expected(f)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, tables: A) -> Result<Self::Value, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(tables))
    }

    fn visit_map<A: MapAccess<'de>>(self, _: A) -> Result<Self::Value, A::Error> {
        Err(A::Error::custom(format_args!("`{}` is one table, expected {}", T::NAME, fmt::from_fn(T::expected))))
    }
}
