//! Values of a scene file that the TOML library's own types take too lightly: it ignores what is too much in an array.

use serde::de::value::SeqAccessDeserializer;
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

/// A list of tables; a single one is a likely slip and gets a sentence of its own.
pub(super) fn lights<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Option<Vec<T>>, D::Error> {
    from.deserialize_any(Lights(PhantomData)).map(Some)
}

struct Lights<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Lights<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("`[[light]]` above each light")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, tables: A) -> Result<Vec<T>, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(tables))
    }

    fn visit_map<A: MapAccess<'de>>(self, _: A) -> Result<Vec<T>, A::Error> {
        Err(A::Error::custom("`light` is one table, expected `[[light]]` above each light"))
    }
}
