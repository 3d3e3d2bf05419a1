//! Streams with lanes, as an array of instances sends them, one by one.

use crate::data::Data;
use crate::elaboration::{self, Elaboration};
use crate::lanes::stack;
use crate::record::from_leaves;
use crate::signal::Signal;
use crate::stream::{Origin, Stream, take, untaken};
use tilewright_circuit::Loc;
use tilewright_circuit::ir::Shape;

impl<P: Data> Stream<P> {
    /// The streams of a row, each for a receiver of its own: for example, from an array of instances to an arbiter.
    /// [`stack`](crate::stack()) makes a row of streams for an array.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     /// Passes a stream on.
    /// #     struct Stage;
    /// #     in StageIn { into: stream(8) }
    /// #     out StageOut { out: stream(8) }
    /// # }
    /// # impl Stage {
    /// #     fn build(&self, _: Module, i: StageIn) -> StageOut { StageOut { out: i.into } }
    /// # }
    /// # block! {
    /// #     /// Two stages side by side.
    /// #     struct Pair;
    /// #     in PairIn { left: stream(8), right: stream(8) }
    /// #     out PairOut { first: stream(8), second: stream(8) }
    /// # }
    /// # impl Pair {
    /// #     fn build(&self, m: Module, i: PairIn) -> PairOut {
    /// let stages = m.array("u_stage", 2, &Stage, |_| StageIn { into: stack([i.left, i.right]) });
    /// let [left, right] = stages.out.lanes().try_into().expect("two lanes");
    /// #         PairOut { first: left, second: right }
    /// #     }
    /// # }
    /// # elaborate(&Pair)?;
    /// # Ok::<(), Problems>(())
    /// ```
    ///
    /// A stream without lanes, or with those of a grid, is a mistake.
    #[track_caller]
    pub fn lanes(&self) -> Vec<Stream<P>> {
        let loc = Loc::caller();
        let valid = self.valid.along("lanes").to_vec();
        if !matches!(self.valid.shape, Shape::Row(_)) {
            // That is reported; the result is the stream itself.
            return vec![self.clone()];
        }
        let mut streams = Vec::with_capacity(valid.len());
        for (lane, valid) in (0..).zip(valid) {
            let ready = elaboration::with(|e| part(e, self.ready, Some(lane), Shape::Plain, loc));
            // A loop: in a closure, the message would name the closure as the caller.
            let mut fields = Vec::new();
            for (_, signal) in self.payload.leaves() {
                let is_grid = matches!(signal.shape, Shape::Grid(..));
                fields.push(if is_grid { signal.rows().lane(lane) } else { signal.lane(lane) });
            }
            streams.push(Stream { valid, ready, payload: from_leaves(&self.payload, fields) });
        }
        take(self.ready, stack(streams.iter().map(|stream| stream.ready)), loc);
        streams
    }
}

/// The `ready` of a stream derived from the stream of that `ready`: one of its lanes, or a row that has it as a lane.
fn part(e: &mut Elaboration, of: Signal, lane: Option<u32>, shape: Shape, loc: Loc) -> Signal {
    let stream = e.draft().streams.get(&of.node);
    let clock = stream.and_then(|stream| stream.clock);
    let origin = match (stream.map(|stream| &stream.origin), lane) {
        (Some(Origin::Instance { instance, port }), Some(lane)) => {
            Origin::Instance { instance: instance.clone(), port: format!("{port}[{lane}]") }
        }
        _ => Origin::Offered,
    };
    untaken(e, origin, shape, clock, loc)
}

/// The `ready` of a row of streams.
#[track_caller]
pub(crate) fn stack_ready(lanes: &[Signal]) -> Signal {
    let loc = Loc::caller();
    let shape = lanes[0].shape.with(0, lanes.len() as u32).unwrap_or(lanes[0].shape);
    let ready = elaboration::with(|e| part(e, lanes[0], None, shape, loc));
    for (number, lane) in (0..).zip(lanes) {
        let answer = if lane.shape.is_plain() { ready.lane(number) } else { ready.rows().lane(number) };
        take(*lane, answer, loc);
    }
    ready
}
