//! Registers of records: one register for each field.

use crate::bundle::Bundle;
use crate::data::{Fits, value_of_field};
use crate::operand::{IntoSignal, Value};
use crate::register::{Reg, Updates};
use crate::select::condition;

/// A register of a record is one register for each field, named `entry_page` for the field `page` of `entry`. All of them are
/// enabled and updated together.
///
/// ```
/// # use tilewright_hdl::{Block, Module, Width, below, bit, bundle, elaborate};
/// bundle! {
///     /// An entry of a table.
///     pub struct Entry<T> { pub resident: T, pub page: T }
/// }
/// # bundle! {
/// #     /// What comes and goes.
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
/// let entry = m.reg("entry", Entry { resident: bit(), page: below(12) }).reset(Entry { resident: 0, page: 11 });
/// entry.when(i.clear, 0).when(i.take & !entry.resident, i.found);
/// #         entry.value()
/// #     }
/// # }
/// # let design = elaborate(&Keeper).unwrap();
/// # let names: Vec<_> = design.top().nodes.iter().filter_map(|node| node.name.as_deref()).collect();
/// # assert!(names.contains(&"entry_resident") && names.contains(&"entry_page"));
/// ```
impl<B: Bundle> Reg<B> {
    /// The present values.
    pub fn value(&self) -> B {
        self.signal.clone()
    }

    /// The values after a reset: a record of numbers, or 0 for all.
    #[track_caller]
    pub fn reset(self, values: impl Fits<B>) -> Reg<B> {
        for (register, value) in self.fields().into_iter().zip(self.values(values, "reset")) {
            let _ = register.reset(value);
        }
        self
    }

    /// The values at power-on: a record of numbers, or 0 for all.
    #[track_caller]
    pub fn initial(self, values: impl Fits<B>) -> Reg<B> {
        for (register, value) in self.fields().into_iter().zip(self.values(values, "initial")) {
            let _ = register.initial(value);
        }
        self
    }

    /// Takes its next values only where `condition`, 1 bit, is high.
    #[track_caller]
    pub fn enable(self, enable: impl IntoSignal) -> Reg<B> {
        let enable = condition(enable.into(), "enable");
        for register in self.fields() {
            let _ = register.enable(enable);
        }
        self
    }

    /// The values that the register takes at the next edge.
    #[track_caller]
    pub fn next(&self, record: impl Fits<B>) {
        for (register, value) in self.fields().into_iter().zip(self.values(record, "next")) {
            register.next(value);
        }
    }

    /// Takes `record` where `condition`, 1 bit, is high; else what a further [`when`](RecordUpdates::when) of the same chain
    /// says; else it keeps what it holds. The first condition that holds wins.
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

    /// What each field is given.
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

/// What a register of a record takes, and when: made by its [`when`](Reg::when).
#[derive(Debug, Clone)]
pub struct RecordUpdates<B> {
    register: Reg<B>,
    fields: Vec<Updates>,
}

impl<B: Bundle> RecordUpdates<B> {
    /// Takes `record` where `condition`, 1 bit, is high and no condition before it is.
    #[track_caller]
    pub fn when(self, condition: impl IntoSignal, record: impl Fits<B>) -> RecordUpdates<B> {
        let condition = crate::select::condition(condition.into(), "when");
        for (updates, value) in self.fields.iter().zip(self.register.values(record, "when")) {
            updates.when(condition, value);
        }
        self
    }

    /// Takes `record` where no condition holds, instead of keeping what it holds.
    #[track_caller]
    pub fn otherwise(self, record: impl Fits<B>) {
        for (updates, value) in self.fields.iter().zip(self.register.values(record, "otherwise")) {
            updates.otherwise(value);
        }
    }
}
