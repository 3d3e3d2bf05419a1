//! Registers with lanes that are read after they would change, and the sequence of loops and lanes that leaves few of
//! them.

use std::collections::{BTreeMap, BTreeSet};

use super::{Plan, Planner, Position, Role};
use crate::engine::function::Sink;
use crate::engine::program::{Kind, Lowered, ValueId};

/// The neighbours in a register that a loop reads and changes.
#[derive(Debug, Clone, Copy, Default)]
struct Neighbours {
    /// Some are before the lane; they have their old values if the loop descends.
    before: bool,
    /// Some are after it; they have their old values if the loop ascends.
    behind: bool,
}

/// The registers with lanes that other loops of the stage read.
#[derive(Debug, Clone, Default)]
struct Others {
    by_wider: BTreeSet<ValueId>,
    by_narrower: BTreeSet<ValueId>,
}

/// Finds the registers that cannot change where their kernel runs. It also chooses the sequence of a stage's kernels
/// and the direction of each. A register that another kernel of the stage reads can change if that kernel runs
/// before; one whose neighbours are read on one side only can change in one of both directions.
pub(super) fn find(planner: &Planner, plan: &mut Plan, needed: &[ValueId]) {
    let function = planner.function;
    let mut written: BTreeMap<ValueId, Position> = BTreeMap::new();
    for sink in &function.sinks {
        if let Sink::Register { state, .. } = sink
            && function.cell(*state).lanes > 1
        {
            written.insert(*state, planner.sink_position(sink));
        }
    }
    let mut shifted: BTreeMap<Position, BTreeMap<ValueId, Neighbours>> = BTreeMap::new();
    let mut of_stages: BTreeMap<usize, Others> = BTreeMap::new();
    let mut read = |operand: ValueId, reader: Position, kind: Option<&Kind>| {
        let Some(&writer) = written.get(&operand) else { return };
        let by_lane = kind.is_none_or(|kind| {
            let of_words = matches!(kind, Kind::Lowered(Lowered::Word { .. } | Lowered::WordOf { .. }));
            kind.is_elementwise() || of_words || matches!(kind, Kind::Reduce { .. })
        });
        match kind {
            Some(Kind::Lowered(Lowered::Slide { by, .. })) if reader == writer => {
                let seen = shifted.entry(writer).or_default().entry(operand).or_default();
                seen.before |= *by > 0;
                seen.behind |= *by < 0;
            }
            _ if reader.stage == writer.stage && reader.place.min(writer.place) > 1 && reader.place != writer.place => {
                let others = of_stages.entry(writer.stage).or_default();
                let seen = if reader.place > writer.place { &mut others.by_wider } else { &mut others.by_narrower };
                seen.insert(operand);
            }
            _ if reader > writer || (reader == writer && !by_lane) => {
                plan.hazards.insert(operand);
            }
            _ => {}
        }
    };
    for &id in needed {
        let reader = match planner.role(id) {
            // A row is read where it is used, at any later time.
            Role::Rematerialised => Position { stage: usize::MAX, place: 0 },
            _ => planner.positions[id.index()],
        };
        let kind = &function.cell(id).kind;
        kind.for_each_operand(|operand| read(operand, reader, Some(kind)));
    }
    for sink in &function.sinks {
        let reader = planner.sink_position(sink);
        sink.for_each_operand(|operand| read(operand, reader, None));
    }
    for (stage, Others { by_wider, by_narrower }) in of_stages {
        let widest_first = by_narrower.len() < by_wider.len();
        plan.at(stage).widest_first = widest_first;
        plan.hazards.extend(if widest_first { by_narrower } else { by_wider });
    }
    for (position, shifted) in shifted {
        let hazards = |descends: bool| -> BTreeSet<ValueId> {
            let remains = |seen: &Neighbours| if descends { seen.behind } else { seen.before };
            shifted.iter().filter(|(_, seen)| remains(seen)).map(|(id, _)| *id).collect()
        };
        let [ascending, descending] = [hazards(false), hazards(true)];
        let descends = descending.len() < ascending.len();
        plan.hazards.extend(if descends { descending } else { ascending });
        let kernel = plan.at(position.stage).kernels.get_mut(&position.place);
        kernel.expect("it changes registers").descends = descends;
    }
}
