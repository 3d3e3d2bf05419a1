//! Wires of records: one wire for each field.

use crate::bundle::Bundle;
use crate::data::{Fits, value_of_field};
use crate::wire::Wire;

/// A wire of a record is one wire for each field, named `sent_page` for the field `page` of `sent`.
impl<B: Bundle> Wire<B> {
    /// Drives the wires.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// def!(nearest = m.wire(Pixel { z: bits(16), rgb: bits(24) }));
    /// nearest.drive(0);
    /// m.assert(nearest.z.eq(nearest.rgb.trunc(16)), "0 means a record of zeros");
    /// # });
    /// ```
    #[track_caller]
    pub fn drive(&self, record: impl Fits<B>) {
        let fields = self.signal.leaves();
        let values = record.given().for_fields(&fields, "drive");
        for (i, ((_, signal), value)) in fields.into_iter().zip(values).enumerate() {
            Wire { signal, index: self.index + i }.drive(value_of_field(value, signal));
        }
    }
}
