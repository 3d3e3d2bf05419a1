//! Pipelines between streams, whose stages wait while the next one is full.

use crate::data::Data;
use crate::integers::Integer;
use crate::limits::sound_stages;
use crate::module::Module;
use crate::record::from_leaves;
use crate::stages::Pipeline;
use crate::stream::Stream;
use crate::width::bit;
use tilewright_circuit::Loc;

impl Module {
    /// A pipeline of `count` stages between streams. Each stage applies `stage` to the payload of the previous one
    /// and stores each field in a register, beside a register that says whether the stage is full. As in
    /// [`Module::stages`], registers are named by field and stage, as `full1` and `left1`, and [`def!`](crate::def!) puts
    /// the name of the variable in front. Payloads of different stages do not mix. (`valid` signals may: the stages use them to agree
    /// with each other, and a description can read whether anything is under way.)
    ///
    /// ```text
    /// stream ===> stage 1 ==>[ 1 ]===> stage 2 ==>[ 2 ]===> ..
    ///   ready <-- !full1 | <---------- !full2 | <---------- ready
    /// ```
    ///
    /// The latency is `count` clocks at one payload a clock. A stage advances where the next one is empty or advances
    /// too. So bubbles close while the receiver waits, and all stages can fill. `valid` and the payload come from
    /// registers. `ready` passes through all stages within the clock; a register slice in front cuts that path.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! {
    ///     /// A sum of squares.
    ///     pub struct Sum<T> { pub x: T, pub y: T, pub sum: T }
    /// }
    /// # bundle! {
    /// #     /// The stream that comes in.
    /// #     pub struct NormIn<T> { pub points: Stream<Sum<T>, T> }
    /// #     /// The stream that goes out.
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
        start: Stream<P>,
        stage: impl Fn(u32, P) -> P,
    ) -> Stream<P> {
        let loc = Loc::caller();
        let stages = sound_stages(count, loc);
        let mut stream = start;
        let pipeline = Pipeline::begin(None, &stream.payload, loc);
        for number in 1..=stages {
            let full = self.register(&format!("full{number}"), bit(), loc).reset(0);
            let next = stage(number, stream.payload.clone());
            let registers = self.stage_registers(pipeline, number, &next, loc);
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
