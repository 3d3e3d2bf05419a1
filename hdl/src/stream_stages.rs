//! Pipelines between streams: each stage holds what it has while the next one is full.

use crate::data::Data;
use crate::integers::Integer;
use crate::limits::sound_stages;
use crate::loc::Loc;
use crate::module::{Module, port_name};
use crate::record::from_leaves;
use crate::stages::{Pipeline, Start};
use crate::stream::Stream;
use crate::width::bit;

impl<P: Data> From<Stream<P>> for Start<Stream<P>> {
    fn from(stream: Stream<P>) -> Start<Stream<P>> {
        Start::plain(stream)
    }
}

impl Module {
    /// A pipeline between streams: `count` times `stage` of the payload that comes out of the stage before, and then a register for each
    /// field of it, beside one that says whether the stage is full. As in [`Module::stages`], registers are named by the field and the
    /// stage, as `full1` and `left1`, with what [`Start::called`] says before that, and payloads of different stages do not meet. (`valid` may: by
    /// it stages agree with each other, and a description sees whether anything is under way.)
    ///
    /// ```text
    /// stream ===> stage 1 ==>[ 1 ]===> stage 2 ==>[ 2 ]===> ..
    ///   ready <-- !full1 | <---------- !full2 | <---------- ready
    /// ```
    ///
    /// Latency `count` clocks, a payload a clock. A stage moves on where the next one is empty or moves on itself, so that bubbles close while the
    /// receiver waits, and all stages fill. `valid` and the payload come from registers; `ready` passes through all stages within the clock,
    /// which a register slice in front cuts.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! {
    ///     /// A sum of squares.
    ///     pub struct Sum<T> { pub x: T, pub y: T, pub sum: T }
    /// }
    /// # bundle! {
    /// #     /// What comes in.
    /// #     pub struct NormIn<T> { pub points: Stream<Sum<T>, T> }
    /// #     /// What goes out.
    /// #     pub struct NormOut<T> { pub norms: Stream<T, T> }
    /// # }
    /// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    /// # struct Norm;
    /// # impl Block for Norm {
    /// #     type In = NormIn;
    /// #     type Out = NormOut;
    /// #     fn inputs(&self) -> NormIn<Width> { NormIn { points: stream(Sum { x: bits(8), y: bits(8), sum: bits(16) }) } }
    /// #     fn build(&self, m: Module, i: NormIn) -> NormOut {
    /// let sums = m.stream_stages(2, i.points, |stage, point| {
    ///     let side = if stage == 1 { point.x } else { point.y };
    ///     Sum { sum: point.sum + side.times(side), ..point }
    /// });
    /// #         m.ignore(&sums.payload);
    /// #         NormOut { norms: sums.with(sums.sum) }
    /// #     }
    /// # }
    /// # let design = elaborate(&Norm).unwrap();
    /// # assert_eq!(design.top().register_name(&design.top().registers[0]), "full1");
    /// ```
    #[track_caller]
    pub fn stream_stages<P: Data>(
        self,
        count: impl Integer,
        start: impl Into<Start<Stream<P>>>,
        stage: impl Fn(u32, P) -> P,
    ) -> Stream<P> {
        let loc = Loc::caller();
        let stages = sound_stages(count, loc);
        let Start { record: mut stream, name, .. } = start.into();
        let pipeline = Pipeline::begin(None, &stream.payload, loc);
        for number in 1..=stages {
            let full = self.register(&port_name(&name, &format!("full{number}")), bit(), loc).reset(0);
            let next = stage(number, stream.payload.clone());
            let registers = self.stage_registers(pipeline, number, &name, &next, loc);
            let held = from_leaves(&next, registers.iter().map(|register| register.signal));
            let (out, sent) = self.offer(full, held);
            let taken = stream.take_when(!full | out.ready).taken;
            full.when(taken, 1).when(sent, 0);
            for register in registers {
                let _ = register.enable(taken);
            }
            stream = out;
        }
        stream
    }
}
