//! Pipelines of records: stages that are alike, with a register for each field after each of them.

use crate::bundle::{Bundle, Fields};
use crate::loc::Loc;
use crate::module::{Module, port_name};
use crate::record::from_leaves;
use crate::select::condition;
use crate::signal::Signal;
use crate::width::Width;

/// What enters a pipeline: a record, which fields of it a reset clears in each stage, and what is put before their names. A
/// record alone is a start of which no field is cleared: see [`Module::stages`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// bundle! { struct Sum<T> { valid: T, value: T } }
///
/// let start = Sum { valid: lit(1, 1), value: lit(8, 40) };
/// let start = start.cleared(|sum| sum.valid).called("twice");
/// let _ = m.stages(2, None, start, |_, sum| Sum { value: sum.value + 1, ..sum });
/// # });
/// assert_eq!(example.values("twice_valid2"), [0, 0, 1, 1]);
/// assert_eq!(example.values("twice_value2"), [0, 1, 42, 42]); // not cleared: what it is before is not valid
/// ```
#[derive(Debug, Clone)]
pub struct Start<B> {
    record: B,
    name: String,
    /// For each field, in order of declaration.
    cleared: Vec<bool>,
}

impl<B: Bundle> From<B> for Start<B> {
    fn from(record: B) -> Start<B> {
        let cleared = record.leaves().iter().map(|_| false).collect();
        Start { record, name: String::new(), cleared }
    }
}

impl<B> Start<B> {
    /// Puts a name before those of the registers, where a module has two pipelines with the same fields: `depth_left1`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Depth<T> { z: T } }
    ///
    /// let near = Start::from(Depth { z: lit(8, 3) }).called("near");
    /// let far = Start::from(Depth { z: lit(8, 9) }).called("far");
    /// for start in [near, far] {
    ///     let _ = m.stages(2, None, start, |_, depth| depth);
    /// }
    /// # });
    /// assert_eq!(example.values("near_z2"), [0, 0, 3, 3]);
    /// assert_eq!(example.values("far_z1"), [0, 9, 9, 9]);
    /// ```
    pub fn called(self, name: &str) -> Start<B> {
        Start { name: name.to_owned(), ..self }
    }
}

#[doc(hidden)]
pub fn cleared<B: Bundle, F: Fields<usize>>(record: B, which: impl FnOnce(B::Of<usize>) -> F) -> Start<B> {
    let mut number = 0..;
    let numbers = record.of(&mut |_, _| number.next().expect("endless"));
    let mut start = Start::from(record);
    which(numbers).leaves().into_iter().for_each(|(_, field)| start.cleared[field] = true);
    start
}

impl Module {
    /// A pipeline: `count` times `stage` of the record that comes out of the stage before, and then a register for each
    /// field. The registers are named by the field and the stage, from `left1` on; that number is what `stage` gets. The
    /// pipeline advances where `enable` is high; with `None` it always does.
    ///
    /// The registers have no reset, but for the fields that the start says: `start.cleared(|race| race.valid)`, or
    /// `|race| [race.valid, race.last]`, are 0 in all stages after a reset.
    ///
    /// ```
    /// # use tilewright_hdl::{Block, Module, Width, bit, bits, bundle, elaborate};
    /// bundle! {
    ///     /// The sum so far, and what is left to add up.
    ///     pub struct Sum<T> { pub valid: T, pub sum: T, pub rest: T }
    /// }
    /// # bundle! {
    /// #     /// What it adds up.
    /// #     pub struct AdderIn<T> { pub start: Sum<T> }
    /// # }
    /// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    /// # struct Adder;
    /// # impl Block for Adder {
    /// #     type In = AdderIn;
    /// #     type Out = Sum;
    /// #     fn inputs(&self) -> AdderIn<Width> { AdderIn { start: Sum { valid: bit(), sum: bits(8), rest: bits(32) } } }
    /// #     fn build(&self, m: Module, AdderIn { start }: AdderIn) -> Sum {
    /// let sums = m.stages(4, None, start.cleared(|sum| sum.valid), |_, sum| {
    ///     Sum { sum: sum.sum + sum.rest.trunc(8), rest: sum.rest >> 8, ..sum }
    /// });
    /// #         sums
    /// #     }
    /// # }
    /// # let design = elaborate(&Adder).unwrap();
    /// # let resets: Vec<_> = design.top().registers.iter().map(|register| register.reset.is_some()).collect();
    /// # assert_eq!(resets, [true, false, false].repeat(4));
    /// # assert_eq!(design.top().register_name(&design.top().registers[4]), "sum2");
    /// ```
    #[track_caller]
    pub fn stages<B: Bundle>(
        self,
        count: u32,
        enable: impl Into<Option<Signal>>,
        start: impl Into<Start<B>>,
        stage: impl Fn(u32, B) -> B,
    ) -> B {
        let loc = Loc::caller();
        let mut enable = enable.into();
        // No closure, as it would be the caller that messages name.
        if let Some(enable) = &mut enable {
            *enable = condition(*enable, "stages");
        }
        let Start { mut record, name, cleared } = start.into();
        for number in 1..=count {
            let next = stage(number, record);
            let mut held = Vec::with_capacity(cleared.len());
            for (field, (path, signal)) in next.leaves().into_iter().enumerate() {
                let name = format!("{}{number}", port_name(&name, &path));
                let mut register = self.register(&name, Width::like(signal), loc);
                // A list may have become longer.
                if cleared.get(field) == Some(&true) {
                    register = register.reset(0);
                }
                if let Some(enable) = enable {
                    register = register.enable(enable);
                }
                register.next(signal);
                held.push(register.value());
            }
            record = from_leaves(&next, held);
        }
        record
    }
}
