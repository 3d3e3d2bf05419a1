//! Wires of records: one wire for each field.

use crate::bundle::Bundle;
use crate::data::{Fits, value_of_field};
use crate::wire::Wire;

/// A wire of a record is one wire for each field, named `sent_page` for the field `page` of `sent`.
impl<B: Bundle> Wire<B> {
    /// What drives it, as a record of signals.
    pub fn value(&self) -> B {
        self.signal.clone()
    }

    /// Says what drives the wires.
    #[track_caller]
    pub fn drive(&self, record: impl Fits<B>) {
        let fields = self.signal.leaves();
        let values = record.given().for_fields(&fields, "drive");
        for (i, ((_, signal), value)) in fields.into_iter().zip(values).enumerate() {
            Wire { signal, index: self.index + i }.drive(value_of_field(value, signal));
        }
    }
}
