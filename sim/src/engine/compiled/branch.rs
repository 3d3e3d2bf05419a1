//! Branches around whole arrays: where all lanes choose by one value, a kernel is made for each number that it may
//! be, with only what is computed then.

use std::collections::BTreeMap;

use rustc_hash::{FxHashMap, FxHashSet};
use tilewright_hdl::Bits;

use super::graph::{Graph, Sink};
use super::layout::Strips;
use super::plan::{Kernel, Plan, Switch};
use super::simplify;
use crate::engine::program::rules::{Cells, alias, fold, shorter};
use crate::engine::program::{Kind, ValueId};

/// The widest value that is branched on.
const WIDEST: u32 = 6;
/// The part of a kernel's work that its variants may leave on average; if they leave more, it is not split.
const REMAINING: f64 = 0.7;
/// Operations on strips that a branch must save to be worth its own cost.
const WORTH: usize = 24;
/// Cells that the variants of a kernel may have together.
const MOST: usize = 1500;

/// Gives kernels branches where it pays.
pub(super) fn branch(graph: &mut Graph, plan: &mut Plan, strips: &Strips) {
    let order = graph.needed();
    let mut stages = std::mem::take(&mut plan.stages);
    for (&lanes, kernel) in stages.iter_mut().flat_map(|stage| &mut stage.kernels) {
        let times = lanes.div_ceil(strips.strip(lanes)) as usize;
        split(graph, plan, &order, kernel, times, MOST, 2);
    }
    plan.stages = stages;
}

/// Splits a kernel by the value that most of its choices depend on, and the parts again; gives the cells in the end.
fn split(
    graph: &mut Graph,
    plan: &mut Plan,
    order: &[ValueId],
    kernel: &mut Kernel,
    times: usize,
    most: usize,
    depth: usize,
) -> usize {
    let whole = kernel.cells.len() + kernel.sinks.len();
    let Some(subject) = (depth > 0).then(|| dominant(graph, kernel)).flatten() else { return whole };
    let width = graph.cell(subject).width;
    let (cells, sinks) = (graph.cells.len(), graph.sinks.len());
    let mut kernels: Vec<Kernel> = Vec::new();
    let mut moved = Vec::new();
    let mut table = Vec::new();
    let mut remaining = 0;
    let mut shared = Shared::default();
    for number in 0..1u64 << width {
        let mut known = Known::new(graph, order, &mut shared, subject, number);
        let variant = known.kernel(plan, kernel, &mut moved);
        remaining += variant.cells.len() + variant.sinks.len();
        let index = kernels.iter().position(|other| same(graph, other, &variant));
        table.push(index.unwrap_or(kernels.len()));
        if index.is_none() {
            kernels.push(variant);
        }
    }
    let average = remaining as f64 / table.len() as f64;
    let total: usize = kernels.iter().map(|kernel| kernel.cells.len() + kernel.sinks.len()).sum();
    let saved = (whole as f64 - average) * times as f64;
    if average > whole as f64 * REMAINING || saved < WORTH as f64 || total > most {
        graph.cells.truncate(cells);
        graph.sinks.truncate(sinks);
        return whole;
    }
    for (new, of) in moved {
        plan.stored.insert(new);
        plan.moved.insert(new, of);
    }
    let mut left = most - total;
    for variant in &mut kernels {
        let before = variant.cells.len() + variant.sinks.len();
        left = left.saturating_sub(split(graph, plan, order, variant, times, left, depth - 1).saturating_sub(before));
    }
    kernel.switch = Some(Box::new(Switch { subject, kernels, table }));
    most - left
}

/// Whether two kernels do the same.
fn same(graph: &Graph, a: &Kernel, b: &Kernel) -> bool {
    let sinks = |kernel: &Kernel| -> Vec<Sink> { kernel.sinks.iter().map(|&sink| graph.sinks[sink].clone()).collect() };
    a.cells == b.cells && sinks(a) == sinks(b)
}

/// The single value that most choices of a kernel depend on.
fn dominant(graph: &Graph, kernel: &Kernel) -> Option<ValueId> {
    let mut scores: BTreeMap<ValueId, usize> = BTreeMap::new();
    let mut score = |id: ValueId, weight: usize| {
        if let Kind::Broadcast(of, _) = graph.cell(id).kind
            && let Some(root) = root(graph, of)
        {
            *scores.entry(root).or_default() += weight;
        }
    };
    for &id in &kernel.cells {
        match &graph.cell(id).kind {
            Kind::Case { subject, arms, .. } => score(*subject, arms.len()),
            Kind::Mux { select, .. } => score(*select, 1),
            Kind::Select { arms, .. } => arms.iter().for_each(|(condition, _)| score(*condition, 1)),
            Kind::Binary(_, a, b) if graph.cell(id).width == 1 => [a, b].into_iter().for_each(|&id| score(id, 1)),
            _ => {}
        }
    }
    for &sink in &kernel.sinks {
        match graph.sinks[sink] {
            Sink::Write { enable, .. } | Sink::Register { enable: Some(enable), .. } => score(enable, 1),
            _ => {}
        }
    }
    scores.into_iter().max_by_key(|&(id, score)| (score, std::cmp::Reverse(id))).map(|(id, _)| id)
}

/// The one value that a single value is computed from, if it is small enough; else the value itself, if that is.
fn root(graph: &Graph, id: ValueId) -> Option<ValueId> {
    if graph.cell(id).lanes > 1 {
        return None;
    }
    let small = |id: ValueId| graph.cell(id).width <= WIDEST;
    let (mut open, mut leaves, mut seen) = (vec![id], Vec::new(), FxHashSet::default());
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        match &graph.cell(id).kind {
            Kind::Const(_) => {}
            kind if kind.is_elementwise() && seen.len() < 32 => kind.for_each_operand(|operand| open.push(operand)),
            _ => leaves.push(id),
        }
    }
    match leaves.as_slice() {
        &[leaf] if small(leaf) && graph.cell(leaf).lanes == 1 => Some(leaf),
        _ => small(id).then_some(id),
    }
}

/// A graph in which some single values are known.
struct View<'a> {
    graph: &'a Graph,
    singles: &'a FxHashMap<ValueId, Kind>,
}

impl Cells for View<'_> {
    fn kind(&self, id: ValueId) -> &Kind {
        self.singles.get(&id).unwrap_or(&self.graph.cell(id).kind)
    }

    fn width(&self, id: ValueId) -> u32 {
        self.graph.cell(id).width
    }
}

/// What is known when the subject is a certain number.
struct Known<'a> {
    graph: &'a mut Graph,
    /// Single values that are known then, as constants.
    singles: FxHashMap<ValueId, Kind>,
    /// What cells of the kernel have become.
    became: FxHashMap<ValueId, ValueId>,
    /// Cells made for this or another number.
    shared: &'a mut Shared,
}

type Shared = FxHashMap<(Kind, u32, u32), ValueId>;

impl<'a> Known<'a> {
    fn new(
        graph: &'a mut Graph,
        order: &[ValueId],
        shared: &'a mut Shared,
        subject: ValueId,
        number: u64,
    ) -> Known<'a> {
        let bits = Bits::from_limbs(graph.cell(subject).width, &[number]);
        let mut singles = FxHashMap::from_iter([(subject, Kind::Const(bits))]);
        for &id in order {
            let cell = graph.cell(id);
            if cell.lanes == 1
                && id != subject
                && let Some(bits) = fold(&View { graph, singles: &singles }, &cell.kind, cell.width)
            {
                singles.insert(id, Kind::Const(bits));
            }
        }
        Known { graph, singles, became: FxHashMap::default(), shared }
    }

    fn add(&mut self, kind: Kind, lanes: u32, width: u32) -> ValueId {
        let graph = &mut *self.graph;
        *self.shared.entry((kind.clone(), lanes, width)).or_insert_with(|| graph.add(kind, lanes, width))
    }

    /// What an operand of the kernel has become.
    fn operand(&mut self, id: ValueId) -> ValueId {
        if let Some(&became) = self.became.get(&id) {
            return became;
        }
        let cell = self.graph.cell(id).clone();
        let became = match &cell.kind {
            Kind::Broadcast(of, _) => match self.singles.get(of).cloned() {
                Some(constant) => self.add(constant, cell.lanes, cell.width),
                None => id,
            },
            _ => id,
        };
        self.became.insert(id, became);
        became
    }

    /// The kernel as it is then. Cells that others read from memory get new ids, to be stored at the place of the old.
    fn kernel(&mut self, plan: &Plan, kernel: &Kernel, moved: &mut Vec<(ValueId, ValueId)>) -> Kernel {
        let mut cells = Vec::new();
        let (mut wanted, mut seen) = (FxHashSet::default(), FxHashSet::default());
        for &id in &kernel.cells {
            let cell = self.graph.cell(id).clone();
            let mut kind = cell.kind.clone();
            kind.rewrite(|operand| *operand = self.operand(*operand));
            kind = shorter(self.graph, &kind).unwrap_or(kind);
            kind = fold(self.graph, &kind, cell.width).map_or(kind, Kind::Const);
            let alias = alias(self.graph, &kind, cell.width);
            let is_read = plan.stored.contains(&id) || matches!(kind, Kind::Reduce { .. });
            if is_read && matches!(kind, Kind::Const(_)) {
                // Others read it from memory, so it has to be brought there.
                let constant = self.add(kind, cell.lanes, cell.width);
                let stored = self.graph.add(Kind::Alias(constant), cell.lanes, cell.width);
                wanted.insert(stored);
                moved.push((stored, plan.home(id)));
                cells.push(stored);
                self.became.insert(id, constant);
                continue;
            }
            let became = match alias {
                _ if kind == cell.kind => id,
                Some(of) if !is_read => of,
                Some(of) => self.graph.add(Kind::Alias(of), cell.lanes, cell.width),
                None if is_read => self.graph.add(kind, cell.lanes, cell.width),
                None => self.add(kind, cell.lanes, cell.width),
            };
            if is_read {
                wanted.insert(became);
                if became != id {
                    moved.push((became, plan.home(id)));
                }
            }
            self.became.insert(id, became);
            // If it is an alias, what it stands for is computed before, or elsewhere.
            if (became == id || alias.is_none() || is_read) && seen.insert(became) {
                cells.push(became);
            }
        }
        let sinks: Vec<usize> = kernel.sinks.iter().filter_map(|&sink| self.sink(plan, sink)).collect();
        sinks.iter().for_each(|&sink| {
            self.graph.sinks[sink].for_each_operand(|operand| {
                wanted.insert(operand);
            })
        });
        for &id in cells.iter().rev() {
            if wanted.contains(&id) {
                self.graph.cell(id).kind.for_each_operand(|operand| {
                    wanted.insert(operand);
                });
            }
        }
        let computed = |id: &ValueId| wanted.contains(id) && !matches!(self.graph.cell(*id).kind, Kind::Const(_));
        cells.retain(computed);
        Kernel { cells, sinks, switch: None }
    }

    /// A sink as it is then; none if nothing happens.
    fn sink(&mut self, plan: &Plan, index: usize) -> Option<usize> {
        let mut sink = self.graph.sinks[index].clone();
        sink.rewrite(|operand| *operand = self.operand(*operand));
        let is_late = matches!(sink, Sink::Register { state, .. } if plan.late.contains(&state));
        // What is late waits elsewhere: it has to be brought there.
        if !is_late {
            sink = simplify::happening(self.graph, sink)?;
        }
        if sink == self.graph.sinks[index] {
            return Some(index);
        }
        self.graph.sinks.push(sink);
        Some(self.graph.sinks.len() - 1)
    }
}
