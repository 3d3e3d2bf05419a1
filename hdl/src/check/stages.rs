//! Values from different stages of one pipeline that meet, although they belong to different records.

use crate::draft::Draft;
use crate::stages::Stage;
use crate::summary::{self, Summary};
use std::collections::BTreeSet;
use tilewright_circuit::graph::Graph;
use tilewright_circuit::ir::{NodeId, Op};
use tilewright_circuit::{Loc, Mistake, Problem};

/// The stage of a value, and the stage register that it comes from.
#[derive(Clone, Copy)]
struct Of {
    stage: Stage,
    from: NodeId,
}

pub(crate) fn check(draft: &Draft, summaries: &[Summary], problems: &mut Vec<Problem>) {
    if draft.pipelines.enables.is_empty() {
        return;
    }
    let flow = Flow::new(draft, summaries);
    let mut stages: Vec<Vec<Of>> = vec![Vec::new(); draft.nodes.len()];
    for node in flow.graph.targets_first() {
        let id = NodeId(node);
        let own = draft.pipelines.held.get(&id).map_or(&[][..], Vec::as_slice);
        let mut met = Met::default();
        for &operand in flow.graph.of(node) {
            let of = stages[operand as usize].iter().copied();
            met.add(of.filter_map(|of| flow.after(id, of)));
        }
        let (mut of, mixed) = (met.of, met.mixed);
        problems.extend(mixed.map(|pair| mix(draft, &format!("`{}`", draft.describe(id)), draft.node(id).loc, pair)));
        of.retain(|other| own.iter().all(|stage| stage.pipeline != other.stage.pipeline));
        of.extend(own.iter().map(|stage| Of { stage: *stage, from: id }));
        stages[node as usize] = of;
    }
    check_registers(draft, &stages, problems);
    check_writes(draft, &stages, problems);
}

/// The sources of values: in the same clock, or through a delay of one stage.
struct Flow<'a> {
    draft: &'a Draft,
    graph: Graph,
}

impl Flow<'_> {
    fn new<'a>(draft: &'a Draft, summaries: &[Summary]) -> Flow<'a> {
        let graph = |looped: &BTreeSet<u32>| {
            Graph::new(draft.nodes.len(), |node, push| {
                if draft.pipelines.any_stage.contains(&NodeId(node)) {
                    return;
                }
                summary::operands(draft, summaries, NodeId(node), &mut |id| push(id.0));
                if !looped.contains(&node) {
                    delay(draft, NodeId(node)).into_iter().for_each(|delay| push(delay.of.0));
                }
            })
        };
        // A value that depends on itself is stored state, not a stage.
        let looped = graph(&BTreeSet::new()).cyclic_components().into_iter().flatten().collect();
        Flow { draft, graph: graph(&looped) }
    }

    /// The stage of a value after `node`; `None` if the node delays it differently than the pipeline does.
    fn after(&self, node: NodeId, of: Of) -> Option<Of> {
        let Some(delay) = delay(self.draft, node) else { return Some(of) };
        let own = self.draft.pipelines.enables[of.stage.pipeline as usize];
        let is_own = delay.enable == own.map(|enable| plain(self.draft, enable));
        is_own.then(|| Of { stage: Stage { number: of.stage.number + 1, ..of.stage }, from: node })
    }
}

/// A register made by `pipe`, or a synchronous read: a delay of one clock, with an enable.
struct Delay {
    of: NodeId,
    enable: Option<NodeId>,
}

fn delay(draft: &Draft, node: NodeId) -> Option<Delay> {
    let (of, enable) = match draft.node(node).op {
        Op::Register(register) if draft.pipelines.delays.contains(&node) => {
            let register = &draft.registers[register.0 as usize];
            (register.next?.0, register.enable.map(|(enable, _)| enable))
        }
        Op::Read(memory, port) => {
            let read = &draft.memories[memory.0 as usize].memory.reads[port as usize];
            let _ = read.clock?;
            (read.address, read.enable)
        }
        _ => return None,
    };
    Some(Delay { of, enable: enable.map(|enable| plain(draft, enable)) })
}

/// The plain node that all lanes of a node repeat, or the node itself.
fn plain(draft: &Draft, mut node: NodeId) -> NodeId {
    while let Op::Broadcast { of, .. } = draft.node(node).op {
        node = of;
    }
    node
}

/// The stages that meet at a place: one of each pipeline, and both stages of the first pipeline that has two.
#[derive(Default)]
struct Met {
    of: Vec<Of>,
    mixed: Option<[Of; 2]>,
    /// Pipelines that have been reported.
    spoilt: BTreeSet<u32>,
}

impl Met {
    fn add(&mut self, of: impl Iterator<Item = Of>) {
        for new in of.filter(|new| !self.spoilt.contains(&new.stage.pipeline)).collect::<Vec<_>>() {
            match self.of.iter().position(|old| old.stage.pipeline == new.stage.pipeline) {
                None => self.of.push(new),
                Some(at) if self.of[at].stage == new.stage => {}
                Some(at) => {
                    self.spoilt.insert(new.stage.pipeline);
                    let old = self.of.remove(at);
                    self.mixed.get_or_insert([old, new]);
                }
            }
        }
    }
}

/// The input of a stage register is of the stage before. The input and the enable of another register are of one
/// stage.
fn check_registers(draft: &Draft, stages: &[Vec<Of>], problems: &mut Vec<Problem>) {
    for register in &draft.registers {
        let Some((next, loc)) = register.next else { continue };
        let own = draft.pipelines.held.get(&register.node);
        let Some(own) = own.into_iter().flatten().find(|stage| stage.number > 0) else {
            let what = format!("the update of `{}`", draft.describe(register.node));
            let enable = register.enable.map(|(enable, _)| enable);
            let given: Vec<_> = [Some(next), enable].into_iter().flatten().collect();
            meet(draft, &what, &given, stages, loc, problems);
            continue;
        };
        let next_of = stages[next.0 as usize].iter().find(|of| of.stage.pipeline == own.pipeline);
        let Some(of) = next_of.filter(|of| of.stage.number + 1 != own.number) else { continue };
        let (name, text) = (draft.describe(register.node), draft.describe(of.from));
        let message = format!(
            "`{name}` of stage {} of a pipeline takes a value of stage {}: `{text}`",
            own.number, of.stage.number
        );
        let is_held = matches!(draft.node(next).op, Op::Register(_));
        let loc = if is_held { draft.node(register.node).loc } else { draft.node(next).loc };
        let problem = Problem::new(Mistake::SkippedStage, loc, message)
            .note(format!("`{name}` is made"), draft.node(register.node).loc)
            .note(format!("`{text}` is made"), draft.node(of.from).loc);
        let help = format!(
            "a stage takes what the one before it gave, stage {}: a register or a read between the two is a stage more; \
             `.any_stage()` says that another one is meant",
            own.number - 1
        );
        problems.push(problem.help(help));
    }
}

fn check_writes(draft: &Draft, stages: &[Vec<Of>], problems: &mut Vec<Problem>) {
    for memory in &draft.memories {
        let what = format!("a write to memory `{}`", memory.memory.name);
        for (write, loc) in memory.memory.writes.iter().zip(&memory.written) {
            meet(draft, &what, &[write.enable, write.address, write.data], stages, *loc, problems);
        }
    }
}

fn meet(draft: &Draft, what: &str, ids: &[NodeId], stages: &[Vec<Of>], loc: Loc, problems: &mut Vec<Problem>) {
    let mut met = Met::default();
    ids.iter().for_each(|id| met.add(stages[id.0 as usize].iter().copied()));
    problems.extend(met.mixed.map(|pair| mix(draft, what, loc, pair)));
}

fn mix(draft: &Draft, what: &str, loc: Loc, [first, second]: [Of; 2]) -> Problem {
    let text = |of: &Of| draft.describe(of.from);
    let message = format!(
        "{what} mixes stages of a pipeline: `{}` is of stage {}, `{}` of stage {}",
        text(&first),
        first.stage.number,
        text(&second),
        second.stage.number
    );
    let mut problem = Problem::new(Mistake::MixedStages, loc, message);
    for of in [&first, &second] {
        problem = problem.note(format!("`{}` is made", text(of)), draft.node(of.from).loc);
    }
    problem.help(
        "bring the earlier one along as a field of the pipeline's record; `.any_stage()` allows values of two records to meet",
    )
}
