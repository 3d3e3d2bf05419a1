//! Enabled parts of a module: clocked elements in such a part keep their state where its enable is low.

use crate::draft::Draft;
use crate::elaboration::{self, Elaboration};
use crate::module::Module;
use crate::names::port_name;
use crate::operand::IntoSignal;
use crate::select::condition;
use crate::signal::Signal;
use std::collections::BTreeSet;
use tilewright_circuit::ir::{About, ClockId, Input, Kind, NodeId, Op, Shape};
use tilewright_circuit::{Loc, Mistake, Problem};

mod gates;

pub(crate) use gates::apply;

/// The index of an [`EnabledPart`] in its draft.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct PartId(u32);

/// A part of a module that runs only where an enable is high.
pub(crate) struct EnabledPart {
    pub outer: Option<PartId>,
    pub clock: ClockId,
    pub enable: NodeId,
    pub loc: Loc,
    /// Whether something in the part runs on its clock. Known when the description has ended.
    pub reaches: bool,
}

impl Module {
    /// Everything on this handle's clock that `describe` declares keeps its state where `enable`, 1 bit, is low. This
    /// means registers, the data of synchronous reads, memories, and all of these within instances. They run as if
    /// their clock rose only where `enable` is high. So assertions, covers and [past values](Module::past) also count
    /// only these edges. A reset does not wait for the enable. Parts nest: then both enables must be high.
    ///
    /// A block within the part is a module of its own, `counter_enabled`, with the enable as its last input, `clk_en`.
    /// Logic on other clocks is not affected. For those clocks, use `m.on(clock).enabled(..)`.
    ///
    /// An enable with lanes enables registers, memories and arrays of its shape, lane by lane.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// block! {
    ///     /// Counts the clocks.
    ///     struct Counter;
    ///     out CounterOut { count: bits(4) }
    /// }
    ///
    /// impl Counter {
    ///     fn build(&self, m: Module, _: ()) -> CounterOut {
    ///         def!(count = m.reg(4).reset(0));
    ///         count.next(count + 1);
    ///         CounterOut { count: *count }
    ///     }
    /// }
    ///
    /// def!(half = m.reg(1).reset(0));
    /// half.next(!half);
    /// def!(slow = m.enabled(half, || m.instance("u_slow", &Counter, ()).count));
    /// # });
    /// assert_eq!(example.values("half"), [0, 1, 0, 1, 0, 1]);
    /// assert_eq!(example.values("slow"), [0, 0, 1, 1, 2, 2]);
    /// ```
    #[track_caller]
    pub fn enabled<R>(self, enable: impl IntoSignal, describe: impl FnOnce() -> R) -> R {
        let loc = Loc::caller();
        let enable = condition(enable.into(), "enabled").id();
        let outer = elaboration::draft(|draft| {
            let (outer, clock) = (draft.part, draft.clock(self.clock));
            draft.parts.push(EnabledPart { outer, clock, enable, loc, reaches: false });
            draft.part.replace(PartId(draft.parts.len() as u32 - 1))
        });
        let result = describe();
        elaboration::draft(|draft| draft.part = outer);
        result
    }

    /// The clocks of a child on which an instance here would be in an enabled part: `None` for the child's own.
    pub(crate) fn gated(self) -> Vec<Option<&'static str>> {
        elaboration::draft(|draft| {
            let parts = draft.parts_from(draft.part).filter_map(|part| draft.clocks[part.clock.0 as usize]);
            let parts = parts.map(|clock| clock.name);
            let renamed = draft.renamed.iter().map(|renamed| renamed.inner.name);
            let named: BTreeSet<_> = parts.chain(renamed).chain(draft.gated.iter().flatten().copied()).collect();
            let is_gated = |name: &&'static str| {
                let renamed = draft.renamed.iter().rev().find(|renamed| renamed.inner.name == *name);
                draft.is_gated(renamed.map_or(Some(*name), |renamed| renamed.outer.map(|clock| clock.name)))
            };
            let own = draft.is_gated(self.clock.map(|clock| clock.name)).then_some(None);
            own.into_iter().chain(named.iter().copied().filter(is_gated).map(Some)).collect()
        })
    }
}

impl Draft {
    /// A part and the parts around it, from the inside out.
    fn parts_from(&self, part: Option<PartId>) -> impl Iterator<Item = &EnabledPart> {
        let at = |id: PartId| &self.parts[id.0 as usize];
        std::iter::successors(part.map(at), move |part| part.outer.map(at))
    }

    /// Whether what is declared now on this clock is enabled by a signal, here or from outside.
    fn is_gated(&self, clock: Option<&'static str>) -> bool {
        let of = |part: &EnabledPart| self.clocks[part.clock.0 as usize].map(|clock| clock.name);
        self.gated.contains(&clock) || self.parts_from(self.part).any(|part| of(part) == clock)
    }
}

/// Ends the description of the innermost draft. Declares an input for each clock that is gated from outside and in use,
/// and returns the names of these clocks.
pub(crate) fn declare_inputs(e: &mut Elaboration, outputs: &[(String, Signal)]) -> Vec<Option<&'static str>> {
    find_reach(e);
    let draft = e.draft();
    let mut used = Vec::new();
    for name in draft.gated.clone() {
        let clock = draft.clocks.iter().position(|clock| clock.map(|clock| clock.name) == name);
        let Some(clock) = clock.filter(|clock| draft.clock_used[*clock]) else { continue };
        let port = free_name(draft, name, outputs);
        let node = draft.add(Op::Input(draft.inputs.len() as u32), 1, Shape::Plain, draft.loc);
        (draft.node_mut(node).name, draft.node_mut(node).kind) = (Some(port.clone()), Kind::Number);
        draft.inputs.push(Input { name: port.clone(), path: port, node, clock: None });
        draft.input_clocks.push(draft.clocks[clock]);
        draft.enables.push((ClockId(clock as u32), node));
        used.push(name);
    }
    used
}

/// The name of an enable, `clk_en` or `video_clk_en`, with a number if something in the module has that name.
fn free_name(draft: &Draft, clock: Option<&str>, outputs: &[(String, Signal)]) -> String {
    let name = clock.map_or("clk_en".to_owned(), |clock| format!("{clock}_clk_en"));
    let mut taken: BTreeSet<&str> = draft.nodes.iter().filter_map(|node| node.name.as_deref()).collect();
    taken.extend(draft.memories.iter().map(|draft| draft.memory.name.as_str()));
    taken.extend(draft.instances.iter().map(|instance| instance.name.as_str()));
    let ports: Vec<_> = outputs.iter().map(|(path, _)| port_name("", path)).collect();
    let is_free = |name: &String| !taken.contains(name.as_str()) && !ports.contains(name);
    let mut names = std::iter::once(name.clone()).chain((1..).map(|number| format!("{name}_{number}")));
    names.find(is_free).expect("there are names without end")
}

/// Finds the parts with something on their clock. A part with something only on other clocks is a problem.
fn find_reach(e: &mut Elaboration) {
    let Some(draft) = e.drafts.last() else { return };
    let clocked = clocked(draft, &e.done);
    let mut problems = Vec::new();
    let mut reaches = vec![false; draft.parts.len()];
    for (at, part) in draft.parts.iter().enumerate() {
        let is_within = |inner: &Option<PartId>| draft.parts_from(*inner).any(|around| std::ptr::eq(around, part));
        let within: Vec<_> = clocked.iter().filter(|(inner, _)| is_within(inner)).map(|(_, clock)| *clock).collect();
        reaches[at] = within.contains(&part.clock);
        if let (false, Some(other)) = (reaches[at], within.first()) {
            problems.push(elsewhere(draft.clock_name(part.clock), draft.clock_name(*other), part.loc));
        }
    }
    let draft = e.draft();
    draft.parts.iter_mut().zip(reaches).for_each(|(part, reaches)| part.reaches = reaches);
    problems.into_iter().for_each(|problem| e.report(problem));
}

fn elsewhere(own: &str, other: &str, loc: Loc) -> Problem {
    let message = format!("`enabled` is for what runs on clock `{own}`, but what is within runs on clock `{other}`");
    let help = "enable it on its own clock: `m.on(clock).enabled(..)`, or a handle that `m.on(clock)` gave";
    Problem::new(Mistake::EnabledElsewhere, loc, message).help(help)
}

/// The parts and clocks of everything that is clocked.
fn clocked(draft: &Draft, done: &[tilewright_circuit::ir::Module]) -> BTreeSet<(Option<PartId>, ClockId)> {
    let mut clocked: BTreeSet<_> = draft.registers.iter().map(|register| (register.part, register.clock)).collect();
    clocked.extend(draft.properties.iter().map(|draft| (draft.part, draft.property.clock)));
    for memory in &draft.memories {
        let reads = memory.memory.reads.iter().zip(&memory.read_parts);
        clocked.extend(reads.filter_map(|(read, part)| Some((*part, read.clock?))));
        clocked.extend(memory.memory.writes.iter().zip(&memory.write_parts).map(|(write, part)| (*part, write.clock)));
    }
    for (instance, part) in draft.instances.iter().zip(&draft.instance_parts) {
        debug_assert_eq!(done[instance.module.0 as usize].clocks.len(), instance.clocks.len());
        clocked.extend(instance.clocks.iter().map(|clock| (*part, *clock)));
    }
    clocked
}

/// The name of the module whose instances are in enabled parts on these clocks.
pub(crate) fn module_name(name: String, clocks: &[Option<&'static str>]) -> String {
    match clocks {
        [] => name,
        [None] => format!("{name}_enabled"),
        clocks => {
            let clocks: Vec<_> = clocks.iter().map(|clock| clock.unwrap_or("clk")).collect();
            format!("{name}_enabled_{}", clocks.join("_"))
        }
    }
}

/// Describes the inputs that are enables of clocks.
pub(crate) fn document(draft: &Draft, about: &mut About) {
    for (_, input) in &draft.enables {
        let name = draft.describe(*input);
        about
            .inputs
            .insert(name, "All on this clock keeps its state where this is low; a reset does not wait.".to_owned());
    }
}
