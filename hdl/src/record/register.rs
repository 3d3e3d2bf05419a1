//! Registers of records: one register for each field.

use std::ops::Deref;

use crate::bundle::Bundle;
use crate::data::{Fits, value_of_field};
use crate::operand::{IntoSignal, Value};
use crate::register::{Reg, Updates};
use crate::select::condition;

/// A register of a record is one register for each field, named `entry_page` for the field `page` of `entry`. All of
/// them are updated together.
///
/// ```
/// # use tilewright_hdl::{Block, Module, Width, below, bit, bundle, def, elaborate};
/// bundle! {
///     /// An entry of a table.
///     pub struct Entry<T> { pub resident: T, pub page: T }
/// }
/// # bundle! {
/// #     /// The enable and the value.
/// #     pub struct KeeperIn<T> { pub clear: T, pub take: T, pub found: Entry<T> }
/// # }
/// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// # struct Keeper;
/// # impl Block for Keeper {
/// #     type In = KeeperIn;
/// #     type Out = Entry;
/// #     fn inputs(&self) -> KeeperIn<Width> {
/// #         KeeperIn { clear: bit(), take: bit(), found: Entry { resident: bit(), page: below(12) } }
/// #     }
/// #     fn build(&self, m: Module, i: KeeperIn) -> Entry {
/// def!(entry = m.reg(Entry { resident: bit(), page: below(12) }).reset(Entry { resident: 0, page: 11 }));
/// entry.when(i.clear, 0).when(i.take & !entry.resident, i.found);
/// #         *entry
/// #     }
/// # }
/// # let design = elaborate(&Keeper).unwrap();
/// # let names: Vec<_> = design.top().nodes.iter().filter_map(|node| node.name.as_deref()).collect();
/// # assert!(names.contains(&"entry_resident") && names.contains(&"entry_page"));
/// ```
impl<B: Bundle> Reg<B> {
    /// The values after a reset: a record of numbers, or 0 for all.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Pixel<T> { z: T, rgb: T } }
    ///
    /// def!(nearest = m.reg(Pixel { z: bits(4), rgb: bits(8) }).reset(Pixel { z: 15, rgb: 0 }));
    /// nearest.next(Pixel { z: nearest.z - 1, rgb: nearest.rgb + 9 });
    /// # });
    /// assert_eq!(example.values("nearest_z"), [15, 14, 13]);
    /// assert_eq!(example.values("nearest_rgb"), [0, 9, 18]);
    /// ```
    #[track_caller]
    pub fn reset(self, values: impl Fits<B>) -> Reg<B> {
        for (register, value) in self.fields().into_iter().zip(self.values(values, "reset")) {
            let _ = register.reset(value);
        }
        self
    }

    /// The values at power-on: a record of numbers, or 0 for all.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Point<T> { x: T, y: T } }
    ///
    /// def!(point = m.reg(Point { x: bits(4), y: bits(4) }).initial(Point { x: 3, y: 9 }));
    /// point.next(Point { x: point.x + 1, y: point.y });
    /// # });
    /// assert_eq!(example.values("point_x"), [3, 4, 5]);
    /// assert_eq!(example.values("point_y"), [9, 9, 9]);
    /// ```
    #[track_caller]
    pub fn initial(self, values: impl Fits<B>) -> Reg<B> {
        for (register, value) in self.fields().into_iter().zip(self.values(values, "initial")) {
            let _ = register.initial(value);
        }
        self
    }

    /// Takes its next values only where `enable`, 1 bit, is high.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Point<T> { x: T, y: T } }
    ///
    /// def!(half = m.reg(1).reset(0));
    /// half.next(!half);
    /// def!(point = m.reg(Point { x: bits(4), y: bits(4) }).reset(0));
    /// point.enable(*half).next(Point { x: point.x + 1, y: point.y - 1 });
    /// # });
    /// assert_eq!(example.values("point_x"), [0, 0, 1, 1, 2]);
    /// assert_eq!(example.values("point_y"), [0, 0, 15, 15, 14]);
    /// ```
    #[track_caller]
    pub fn enable(self, enable: impl IntoSignal) -> Reg<B> {
        let enable = condition(enable.into(), "enable");
        for register in self.fields() {
            let _ = register.enable(enable);
        }
        self
    }

    /// The values that the register takes at the next edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Point<T> { x: T, y: T } }
    ///
    /// def!(point = m.reg(Point { x: bits(4), y: bits(4) }).reset(Point { x: 1, y: 2 }));
    /// point.next(Point { x: point.y, y: point.x }); // both sample at once
    /// # });
    /// assert_eq!(example.values("point_x"), [1, 2, 1, 2]);
    /// ```
    #[track_caller]
    pub fn next(&self, record: impl Fits<B>) {
        for (register, value) in self.fields().into_iter().zip(self.values(record, "next")) {
            register.next(value);
        }
    }

    /// Takes `record` where `condition`, 1 bit, is high. Elsewhere, further [`when`](RecordUpdates::when)s of the
    /// same chain decide; if none applies, the register keeps its value. The first true condition wins.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Point<T> { x: T, y: T } }
    ///
    /// def!(point = m.reg(Point { x: bits(2), y: bits(2) }).reset(0));
    /// point
    ///     .when(point.x.eq(2), Point { x: lit(2, 0), y: point.y + 1 })
    ///     .otherwise(Point { x: point.x + 1, ..*point });
    /// # });
    /// assert_eq!(example.values("point_x"), [0, 1, 2, 0, 1]);
    /// assert_eq!(example.values("point_y"), [0, 0, 0, 1, 1]);
    /// ```
    #[track_caller]
    pub fn when(&self, condition: impl IntoSignal, record: impl Fits<B>) -> RecordUpdates<B> {
        let condition = crate::select::condition(condition.into(), "when");
        let mut fields = Vec::new();
        for (register, value) in self.fields().into_iter().zip(self.values(record, "when")) {
            fields.push(register.when(condition, value));
        }
        RecordUpdates { register: self.clone(), fields }
    }

    /// The registers of the fields, which were declared one after another.
    pub(crate) fn fields(&self) -> Vec<Reg> {
        let leaves = self.signal.leaves().into_iter().enumerate();
        leaves.map(|(i, (_, signal))| Reg { signal, index: self.index + i }).collect()
    }

    /// The value for each field.
    #[track_caller]
    fn values(&self, record: impl Fits<B>, of: &str) -> Vec<Value> {
        let fields = self.signal.leaves();
        let mut values = record.given().for_fields(&fields, of);
        for (value, (_, field)) in values.iter_mut().zip(&fields) {
            *value = value_of_field(value.clone(), *field);
        }
        values
    }
}

/// The update chain of a register of a record, made by its [`when`](Reg::when). Like [`Updates`], it reads as the
/// register.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// bundle! { struct Point<T> { x: T, y: T } }
///
/// def!(point = m.reg(Point { x: bits(4), y: bits(4) }).reset(0));
/// let updates = point.when(point.x.eq(1), Point { x: 8, y: 9 });
/// updates.when(point.x.eq(8), 0).otherwise(Point { x: point.x + 1, y: point.y });
/// # });
/// assert_eq!(example.values("point_x"), [0, 1, 8, 0, 1]);
/// ```
#[derive(Debug, Clone)]
pub struct RecordUpdates<B> {
    register: Reg<B>,
    fields: Vec<Updates>,
}

impl<B> Deref for RecordUpdates<B> {
    type Target = B;

    fn deref(&self) -> &B {
        &self.register
    }
}

impl<B: Bundle> RecordUpdates<B> {
    /// Takes `record` where `condition`, 1 bit, is high and no earlier condition is.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Point<T> { x: T, y: T } }
    ///
    /// def!(point = m.reg(Point { x: bits(4), y: bits(4) }).reset(0));
    /// point
    ///     .when(point.x.eq(3), 0)
    ///     .when(point.y.lt(4), Point { x: point.x + 1, y: point.y + 2 }); // else it keeps its value
    /// # });
    /// assert_eq!(example.values("point_y"), [0, 2, 4, 4, 4]);
    /// ```
    #[track_caller]
    pub fn when(self, condition: impl IntoSignal, record: impl Fits<B>) -> RecordUpdates<B> {
        let condition = crate::select::condition(condition.into(), "when");
        for (updates, value) in self.fields.iter().zip(self.register.values(record, "when")) {
            updates.when(condition, value);
        }
        self
    }

    /// Takes `record` where no condition is true, instead of keeping its value.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Point<T> { x: T, y: T } }
    ///
    /// def!(point = m.reg(Point { x: bits(4), y: bits(4) }).reset(Point { x: 3, y: 0 }));
    /// point.when(point.x.eq(3), 0).otherwise(Point { x: point.x + 1, y: point.y + 2 });
    /// # });
    /// assert_eq!(example.values("point_x"), [3, 0, 1, 2, 3, 0]);
    /// ```
    #[track_caller]
    pub fn otherwise(self, record: impl Fits<B>) {
        for (updates, value) in self.fields.iter().zip(self.register.values(record, "otherwise")) {
            updates.otherwise(value);
        }
    }
}
