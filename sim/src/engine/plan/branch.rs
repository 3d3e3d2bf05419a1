//! Branches around whole arrays: if one value selects for all lanes, each of its numbers gets a kernel with only the
//! operations computed then.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::{FxHashMap, FxHashSet};
use tilewright_circuit::Bits;

use super::versioned::Versioned;
use super::{Kernel, Plan, Switch};
use crate::engine::Passes;
use crate::engine::function::{Function, Sink, happening};
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Cell, Kind, ValueId};

/// The widest value that is branched on.
const WIDEST: u32 = 6;
/// The average share of a kernel's work that may remain in its variants; if more remains, the kernel is not split.
const REMAINING: f64 = 0.93;
/// Operations on strips that a branch must save to be worth its own cost.
const WORTH: usize = 24;
/// The cells that the variants of a kernel may have together.
const MOST: usize = 8000;

/// The same for kernels that may get versions, which cover the frequent cases.
const MOST_BESIDE_VERSIONS: usize = 3000;

/// Gives kernels branches if that pays.
pub(super) fn branch(function: &mut Function, plan: &mut Plan, strips: &StripSizes, passes: &Passes) {
    if plan.stages.iter().all(|stage| stage.kernels.is_empty()) {
        return;
    }
    let dependents = Dependents::of(function);
    let mut stages = std::mem::take(&mut plan.stages);
    for (&lanes, kernel) in stages.iter_mut().flat_map(|stage| &mut stage.kernels) {
        let times = lanes.div_ceil(strips.strip(lanes)) as usize;
        kernel.for_each_leaf(&mut |kernel| {
            let versioned = Versioned::new(function, kernel, lanes, times, passes);
            let most = if versioned.is_some() { MOST_BESIDE_VERSIONS } else { MOST };
            split(function, plan, &dependents, kernel, times, most, 4);
            if let Some(versioned) = versioned.filter(|_| has_choices(function, kernel)) {
                kernel.versioned = Some(plan.versioned.len());
                versioned.store_what_it_takes(function, plan);
                plan.versioned.push(versioned);
            }
        });
    }
    plan.stages = stages;
}

/// Splits a kernel by the value that most of its choices depend on, and then the parts; returns the number of cells
/// at the end.
fn split(
    function: &mut Function,
    plan: &mut Plan,
    dependents: &Dependents,
    kernel: &mut Kernel,
    times: usize,
    most: usize,
    depth: usize,
) -> usize {
    let whole = kernel.operations();
    let Some(subject) = (depth > 0).then(|| dominant(function, kernel)).flatten() else { return whole };
    let width = function.cell(subject).width;
    let (cells, sinks) = (function.circuit().len(), function.sinks.len());
    let cone = dependents.cone(&[subject]);
    function.rewriter.vary();
    let mut kernels: Vec<Kernel> = Vec::new();
    let mut moved = Vec::new();
    let mut table = Vec::new();
    let mut remaining = 0;
    for number in 0..1u64 << width {
        let mut known = Known::new(function, &cone, &[(subject, number)]);
        let variant = known.kernel(plan, kernel, &mut moved);
        remaining += variant.operations();
        let index = kernels.iter().position(|other| same(function, other, &variant));
        table.push(index.unwrap_or(kernels.len()));
        if index.is_none() {
            kernels.push(variant);
        }
    }
    let average = remaining as f64 / table.len() as f64;
    let total: usize = kernels.iter().map(Kernel::operations).sum();
    let saved = (whole as f64 - average) * times as f64;
    if average > whole as f64 * REMAINING || saved < WORTH as f64 || total > most {
        function.rewriter.truncate(cells);
        function.sinks.truncate(sinks);
        return whole;
    }
    for (new, of) in moved {
        plan.live_out.insert(new);
        plan.homes.insert(new, of);
    }
    let mut left = most - total;
    for variant in &mut kernels {
        let before = variant.operations();
        left = left
            .saturating_sub(split(function, plan, dependents, variant, times, left, depth - 1).saturating_sub(before));
    }
    kernel.switch = Some(Box::new(Switch { subject, kernels, table }));
    most - left
}

/// Whether scalars still select in the kernels that replace this one.
fn has_choices(function: &Function, kernel: &mut Kernel) -> bool {
    let mut has = false;
    kernel.for_each_leaf(&mut |kernel| has |= !choosing(function, kernel).is_empty());
    has
}

/// Whether two kernels do the same.
fn same(function: &Function, a: &Kernel, b: &Kernel) -> bool {
    let sinks =
        |kernel: &Kernel| -> Vec<Sink> { kernel.sinks.iter().map(|&sink| function.sinks[sink].clone()).collect() };
    a.cells == b.cells && sinks(a) == sinks(b)
}

/// The scalar that most choices of a kernel depend on.
fn dominant(function: &Function, kernel: &Kernel) -> Option<ValueId> {
    let scores = choosing(function, kernel).into_iter();
    scores.max_by_key(|&(id, score)| (score, std::cmp::Reverse(id))).map(|(id, _)| id)
}

/// The scalars that choices of a kernel depend on, each with the number of its choices.
pub(super) fn choosing(function: &Function, kernel: &Kernel) -> BTreeMap<ValueId, usize> {
    let mut scores: BTreeMap<ValueId, usize> = BTreeMap::new();
    let mut score = |id: ValueId, weight: usize| {
        if let Kind::Broadcast { of, .. } = function.cell(id).kind
            && let Some(root) = root(function, of)
        {
            *scores.entry(root).or_default() += weight;
        }
    };
    for &id in &kernel.cells {
        match &function.cell(id).kind {
            Kind::Case { subject, arms, .. } => score(*subject, arms.len()),
            Kind::Mux { select, .. } => score(*select, 1),
            Kind::Select { arms, .. } => arms.iter().for_each(|(condition, _)| score(*condition, 1)),
            Kind::Binary(_, a, b) if function.cell(id).width == 1 => [a, b].into_iter().for_each(|&id| score(id, 1)),
            _ => {}
        }
    }
    for &sink in &kernel.sinks {
        match function.sinks[sink] {
            Sink::Write { enable, .. } | Sink::Register { enable: Some(enable), .. } => score(enable, 1),
            _ => {}
        }
    }
    scores
}

/// The one small value that a scalar is computed from, or else the scalar itself, if it is small.
fn root(function: &Function, id: ValueId) -> Option<ValueId> {
    if function.cell(id).lanes > 1 {
        return None;
    }
    let small = |id: ValueId| function.cell(id).width <= WIDEST;
    let (mut open, mut leaves, mut seen) = (vec![id], Vec::new(), FxHashSet::default());
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        match &function.cell(id).kind {
            Kind::Const(_) => {}
            kind if kind.is_elementwise() && seen.len() < 32 => kind.for_each_operand(|operand| open.push(operand)),
            _ => leaves.push(id),
        }
    }
    match leaves.as_slice() {
        &[leaf] if small(leaf) && function.cell(leaf).lanes == 1 => Some(leaf),
        _ => small(id).then_some(id),
    }
}

/// The scalars that depend on others.
pub(crate) struct Dependents {
    /// All scalars, each after its operands.
    scalars: Vec<ValueId>,
    /// For each value, the places of the scalars that have it as an operand.
    users: FxHashMap<ValueId, Vec<usize>>,
}

impl Dependents {
    pub fn of(function: &Function) -> Dependents {
        let scalars = function.needed().into_iter().filter(|id| function.cell(*id).lanes == 1);
        let scalars: Vec<ValueId> = scalars.collect();
        let mut users: FxHashMap<ValueId, Vec<usize>> = FxHashMap::default();
        for (place, &id) in scalars.iter().enumerate() {
            function.cell(id).kind.for_each_operand(|operand| users.entry(operand).or_default().push(place));
        }
        Dependents { scalars, users }
    }

    /// Those that depend on these subjects, each after its operands.
    pub fn cone(&self, subjects: &[ValueId]) -> Vec<ValueId> {
        let (mut open, mut cone) = (subjects.to_vec(), BTreeSet::new());
        while let Some(id) = open.pop() {
            for &place in self.users.get(&id).into_iter().flatten() {
                let user = self.scalars[place];
                if !subjects.contains(&user) && cone.insert(place) {
                    open.push(user);
                }
            }
        }
        cone.into_iter().map(|place| self.scalars[place]).collect()
    }
}

/// The known values if the subjects have certain numbers.
pub(crate) struct Known<'a> {
    function: &'a mut Function,
    /// Scalars that are known then, as constants.
    singles: FxHashMap<ValueId, ValueId>,
    /// The replacements of cells of the kernel.
    became: FxHashMap<ValueId, ValueId>,
}

impl<'a> Known<'a> {
    /// `cone` contains the scalars that depend on the subjects, each after its operands.
    pub fn new(function: &'a mut Function, cone: &[ValueId], subjects: &[(ValueId, u64)]) -> Known<'a> {
        let constant = |&(subject, number): &(ValueId, u64)| {
            let bits = Bits::from_limbs(function.cell(subject).width, &[number]);
            (subject, function.rewriter.constant(bits, 1))
        };
        let mut singles: FxHashMap<ValueId, ValueId> = subjects.iter().map(constant).collect();
        for &id in cone {
            let mut cell = function.cell(id).clone();
            cell.kind.rewrite(|operand| *operand = singles.get(operand).copied().unwrap_or(*operand));
            if let Some(bits) = function.rewriter.known(cell) {
                singles.insert(id, function.rewriter.constant(bits, 1));
            }
        }
        Known { function, singles, became: FxHashMap::default() }
    }

    /// The replacement of an operand of the kernel.
    fn operand(&mut self, id: ValueId) -> ValueId {
        if let Some(&became) = self.became.get(&id) {
            return became;
        }
        let &Cell { ref kind, lanes, .. } = self.function.cell(id);
        let known = match kind {
            Kind::Broadcast { of, .. } => self.singles.get(of),
            _ => None,
        };
        let bits = known.map(|constant| self.function.circuit().constant(*constant).expect("it is known").clone());
        let became = bits.map_or(id, |bits| self.function.rewriter.constant(bits, lanes));
        self.became.insert(id, became);
        became
    }

    /// The kernel in this case. Cells that others read from memory get new ids, and are stored at the places of the
    /// old ones.
    pub fn kernel(&mut self, plan: &Plan, kernel: &Kernel, moved: &mut Vec<(ValueId, ValueId)>) -> Kernel {
        let mut cells = Vec::new();
        let (mut wanted, mut seen) = (FxHashSet::default(), FxHashSet::default());
        for &id in &kernel.cells {
            let was = self.function.cell(id).clone();
            let mut cell = was.clone();
            cell.kind.rewrite(|operand| *operand = self.operand(*operand));
            let is_sum = matches!(cell.kind, Kind::Reduce { .. });
            let rewriter = &mut self.function.rewriter;
            let (became, is_computed) = match () {
                () if cell == was => (id, true),
                () if is_sum => (rewriter.push(cell), true),
                () => rewriter.number_or_find(cell),
            };
            self.became.insert(id, became);
            if is_computed && seen.insert(became) {
                cells.push(became);
            }
            if is_sum || plan.live_out.contains(&id) {
                // Others read it from memory, so it must be stored there in any case.
                let stored = if became == id || is_sum { became } else { self.function.rewriter.copy(became) };
                if stored != id {
                    moved.push((stored, plan.home(id)));
                }
                if stored != became {
                    cells.push(stored);
                }
                wanted.insert(stored);
            }
        }
        let sinks: Vec<usize> = kernel.sinks.iter().filter_map(|&sink| self.sink(plan, sink)).collect();
        sinks.iter().for_each(|&sink| {
            self.function.sinks[sink].for_each_operand(|operand| {
                wanted.insert(operand);
            })
        });
        for &id in cells.iter().rev() {
            if wanted.contains(&id) {
                self.function.cell(id).kind.for_each_operand(|operand| {
                    wanted.insert(operand);
                });
            }
        }
        let is_live = |id: &ValueId| wanted.contains(id) && self.function.circuit().constant(*id).is_none();
        cells.retain(is_live);
        Kernel { cells, sinks, descends: kernel.descends, ..Kernel::default() }
    }

    /// A sink in this case; `None` if nothing happens.
    fn sink(&mut self, plan: &Plan, index: usize) -> Option<usize> {
        let mut sink = self.function.sinks[index].clone();
        sink.rewrite(|operand| *operand = self.operand(*operand));
        let is_late = matches!(sink, Sink::Register { state, .. } if plan.hazards.contains(&state));
        // A late change waits elsewhere and must be copied.
        if !is_late {
            sink = happening(self.function.circuit(), sink)?;
        }
        if sink == self.function.sinks[index] {
            return Some(index);
        }
        self.function.sinks.push(sink);
        Some(self.function.sinks.len() - 1)
    }
}
