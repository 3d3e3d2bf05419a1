//! Pipelines of records: identical stages, each followed by a register for each field. Values of different stages do
//! not mix, because they belong to different records.

use crate::bundle::Bundle;
use crate::data::Data;
use crate::elaboration::draft;
use crate::fields::Fields;
use crate::integers::Integer;
use crate::limits::sound_stages;
use crate::module::Module;
use crate::names::port_name;
use crate::record::from_leaves;
use crate::register::Reg;
use crate::select::condition;
use crate::signal::Signal;
use crate::width::Width;
use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::{NodeId, Op};
use tilewright_circuit::{Bits, Loc};

/// The input of a pipeline: a record, and the fields that a reset clears in each stage. A plain record is a start
/// without cleared fields: see [`Module::stages`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// bundle! { struct Sum<T> { valid: T, value: T } }
///
/// let start = Sum { valid: lit(1, 1), value: lit(8, 40) };
/// let start: Start<Sum> = start.cleared(|sum| sum.valid);
/// def!(twice = m.stages(2, None, start, |_, sum| Sum { value: sum.value + 1, ..sum }));
/// # m.ignore(&twice);
/// # });
/// assert_eq!(example.values("twice_valid2"), [0, 0, 1, 1]);
/// assert_eq!(example.values("twice_value2"), [0, 1, 42, 42]); // not cleared: its first values are not valid
/// ```
#[derive(Debug, Clone)]
pub struct Start<B> {
    pub(crate) record: B,
    /// For each field, in the sequence of declaration.
    cleared: Vec<bool>,
}

impl<B: Bundle> From<B> for Start<B> {
    fn from(record: B) -> Start<B> {
        Start { cleared: vec![false; record.leaves().len()], record }
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
    /// A pipeline of `count` stages. Each stage applies `stage` to the record of the previous one and stores each
    /// field in a register. The registers are named by field and stage, from `left1` on; `stage` gets this number.
    /// `def!(near = m.stages(..))` names them `near_left1`. The pipeline advances where `enable` is high, or always if `enable` is `None`.
    ///
    /// The registers have no reset, except for the fields that the start clears: `start.cleared(|race| race.valid)`,
    /// or `|race| [race.valid, race.last]`. These are 0 in all stages after a reset.
    ///
    /// ```
    /// # use tilewright_hdl::{Block, Module, Width, bit, bits, bundle, elaborate};
    /// bundle! {
    ///     /// The sum so far, and the numbers that remain.
    ///     pub struct Sum<T> { pub valid: T, pub sum: T, pub rest: T }
    /// }
    /// # bundle! {
    /// #     /// The numbers to add.
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
    ///
    /// The inputs belong to stage 0, the registers of stage `k` to stage `k`, and a value computed from them to the
    /// same stage. Values of different stages of a pipeline do not mix: not in an operator, and not in an update of a
    /// register or a memory, unless they say [`.any_stage()`](Signal::any_stage). Values outside of the pipeline mix
    /// with all stages: constants, other inputs, registers made by [`Module::reg`], and outputs that come from
    /// registers of an instance. [`Module::pipe`] and synchronous reads, if they have the pipeline's own enable, add
    /// one stage.
    #[track_caller]
    pub fn stages<B: Bundle>(
        self,
        count: impl Integer,
        enable: impl Into<Option<Signal>>,
        start: impl Into<Start<B>>,
        stage: impl Fn(u32, B) -> B,
    ) -> B {
        let loc = Loc::caller();
        let mut enable = enable.into();
        // No closure: the message would name it as the caller.
        if let Some(enable) = &mut enable {
            *enable = condition(*enable, "stages");
        }
        let Start { mut record, cleared } = start.into();
        let stages = sound_stages(count, loc);
        let pipeline = Pipeline::begin(enable, &record, loc);
        for number in 1..=stages {
            let next = stage(number, record);
            let registers = self.stage_registers(pipeline, number, &next, loc);
            for (field, register) in registers.iter().enumerate() {
                // A list may have become longer.
                if cleared.get(field) == Some(&true) {
                    let _ = register.reset(Bits::zero(register.width));
                }
                if let Some(enable) = enable {
                    let _ = register.enable(enable);
                }
            }
            record = from_leaves(&next, registers.into_iter().map(|register| register.signal));
        }
        record
    }

    /// The registers of a stage, one for each field of its result.
    pub(crate) fn stage_registers<V: Data>(self, pipeline: Pipeline, number: u32, next: &V, loc: Loc) -> Vec<Reg> {
        let mut registers = Vec::new();
        next.map_fields("", &mut |path, signal| {
            // A payload that is one signal has no field name.
            let field = port_name("", if path.is_empty() { "payload" } else { path });
            let register = self.register(&format!("{field}{number}"), Width::like(*signal), loc);
            register.give(signal.id_at(loc), loc);
            pipeline.holds(register.signal, number);
            registers.push(register);
            register.signal
        });
        registers
    }
}

/// A stage of one of a module's pipelines; inputs are of stage 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stage {
    pub pipeline: u32,
    pub number: u32,
}

/// The pipelines of a module under construction.
#[derive(Default)]
pub(crate) struct Pipelines {
    /// The enable of each.
    pub enables: Vec<Option<NodeId>>,
    /// The inputs of a pipeline and the registers of its stages.
    pub held: BTreeMap<NodeId, Vec<Stage>>,
    /// Registers that [`Module::pipe`] made.
    pub delays: BTreeSet<NodeId>,
    /// Values that mix with any stage.
    pub any_stage: BTreeSet<NodeId>,
}

/// A pipeline of the module under construction.
#[derive(Clone, Copy)]
pub(crate) struct Pipeline(u32);

impl Pipeline {
    pub fn begin<V: Data>(enable: Option<Signal>, start: &V, loc: Loc) -> Pipeline {
        let enable = enable.map(|enable| enable.id_at(loc));
        let pipeline = draft(|draft| {
            draft.pipelines.enables.push(enable);
            Pipeline(draft.pipelines.enables.len() as u32 - 1)
        });
        for (_, signal) in start.leaves() {
            let id = signal.id_at(loc);
            let is_constant = draft(|draft| matches!(draft.node(id).op, Op::Const(_)));
            if !is_constant {
                pipeline.holds(Signal { node: id, ..signal }, 0);
            }
        }
        pipeline
    }

    fn holds(self, signal: Signal, number: u32) {
        let stage = Stage { pipeline: self.0, number };
        draft(|draft| draft.pipelines.held.entry(signal.node).or_default().push(stage));
    }
}

impl Signal {
    /// The same value, freed from the pipeline check: it may meet values of any stage (see [`Module::stages`]). Use
    /// it where one record needs another that entered the pipeline earlier or later, as in forwarding.
    ///
    /// ```
    /// # use tilewright_hdl::{Block, Module, Width, bits, bundle, elaborate};
    /// # bundle! {
    /// #     /// A sample.
    /// #     pub struct Sample<T> { pub x: T }
    /// #     /// The difference to the previous sample.
    /// #     pub struct Change<T> { pub rise: T }
    /// # }
    /// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    /// # struct Slope;
    /// # impl Block for Slope {
    /// #     type In = Sample;
    /// #     type Out = Change;
    /// #     fn inputs(&self) -> Sample<Width> { Sample { x: bits(8) } }
    /// #     fn build(&self, m: Module, i: Sample) -> Change {
    /// let before = m.stages(1, None, i, |_, sample| sample);
    /// let rise = i.x - before.x.any_stage();
    /// #         Change { rise }
    /// #     }
    /// # }
    /// # elaborate(&Slope).unwrap();
    /// ```
    #[track_caller]
    pub fn any_stage(self) -> Signal {
        let same = Signal::make(Op::Wire(self.id()), self.width, self.shape).kept_as(self.kind);
        draft(|draft| draft.pipelines.any_stage.insert(same.node));
        same
    }
}

#[doc(hidden)]
#[track_caller]
pub fn any_stage<B: Bundle>(record: &B) -> B {
    let mut same = Vec::new();
    for (_, signal) in record.leaves() {
        same.push(signal.any_stage());
    }
    from_leaves(record, same)
}
