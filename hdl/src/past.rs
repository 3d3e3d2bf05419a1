//! Past values, for properties.

use crate::draft::{Draft, DraftRegister};
use crate::elaboration;
use crate::enabled::PartId;
use crate::fields::Fields;
use crate::module::Module;
use crate::operand::IntoSignal;
use crate::record::from_leaves;
use crate::select::condition;
use crate::signal::Signal;
use crate::summary::{self, Summary};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::RangeFrom;
use tilewright_circuit::graph::Graph;
use tilewright_circuit::ir::{Binary, ClockId, Directive, Init, NodeId, Op, RegisterId, Shape, Unary};
use tilewright_circuit::{Bits, Loc};

/// Past values are for properties: `m.assert(m.past(i.restart).implies(count.eq(0)), ..)`. A property that looks at a
/// past value, directly or through nets and instances, is not checked until that value exists. It is not checked at
/// the first edge after power-on or a reset; if it looks at the past of a past value, not at the first two. Anywhere
/// else (behind a register, in a property of another module, in the circuit itself) a past value is a register
/// without a reset, as made by [`Module::pipe`].
impl Module {
    /// The value, at the previous edge of this module's clock, of a signal or of each field of a record. Equal
    /// signals share their register.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(count = m.reg(8).reset(0));
    /// count.next(count + 3);
    /// m.assert(count.eq(m.past(*count) + 3), "not checked at the first edge, which has no past");
    /// # });
    /// ```
    #[track_caller]
    pub fn past<B: Fields<Signal>>(self, value: B) -> B::With<Signal> {
        let loc = Loc::caller();
        // A loop: in a closure, the message would name the closure as the caller.
        let mut pasts = Vec::new();
        for (_, signal) in value.leaves() {
            pasts.push(self.past_of(signal, loc));
        }
        from_leaves(&value, pasts)
    }

    /// 1 bit: `signal`, 1 bit, is high and was low at the previous edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// count.next(count + 1);
    /// m.assert(m.rose(count.msb()).eq(count.eq(8)), "once, where the top bit comes");
    /// # });
    /// ```
    #[track_caller]
    pub fn rose(self, signal: impl IntoSignal) -> Signal {
        let signal = condition(signal.into(), "rose");
        signal & !self.past_of(signal, Loc::caller())
    }

    /// 1 bit: `signal`, 1 bit, is low and was high at the previous edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// count.next(count + 1);
    /// m.assert(m.fell(count.msb()).eq(count.eq(0)), "where it wraps");
    /// # });
    /// ```
    #[track_caller]
    pub fn fell(self, signal: impl IntoSignal) -> Signal {
        let signal = condition(signal.into(), "fell");
        !signal & self.past_of(signal, Loc::caller())
    }

    /// 1 bit: `signal` has the same value as at the previous edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(half = m.reg(1).reset(0));
    /// half.next(!half);
    /// def!(count = m.reg(8).reset(0));
    /// count.when(*half, count + 1);
    /// m.assert(m.stable(count).eq(!m.past(*half)), "it changes where it was enabled, and nowhere else");
    /// # });
    /// ```
    #[track_caller]
    pub fn stable(self, signal: impl IntoSignal) -> Signal {
        let signal = signal.into();
        signal.eq(self.past_of(signal, Loc::caller()))
    }

    fn past_of(self, signal: Signal, loc: Loc) -> Signal {
        let of = signal.id_at(loc);
        elaboration::with(|e| {
            let draft = e.draft();
            let clock = draft.use_clock(self.clock);
            let part = draft.part;
            let past = draft.pasts.get(&(of, clock, part)).copied().unwrap_or_else(|| {
                let past = add_register(draft, (clock, part), (signal.width, signal.shape), loc);
                draft.node_mut(past).kind = signal.kind;
                let register = draft.registers.last_mut().expect("just added");
                register.next = Some((of, loc));
                draft.pasts.insert((of, clock, part), past);
                past
            });
            // The operand's own kind: the register may have been made for a signal of another kind.
            Signal { kind: signal.kind, ..Signal::at(e, past) }
        })
    }
}

/// When a register can take a value: the edges of a clock, where the part that it is in is enabled.
type Time = (ClockId, Option<PartId>);

fn add_register(draft: &mut Draft, (clock, part): Time, (width, shape): (u32, Shape), loc: Loc) -> NodeId {
    let node = draft.add(Op::Register(RegisterId(draft.registers.len() as u32)), width, shape, loc);
    draft.registers.push(DraftRegister::new(node, clock, part));
    node
}

/// Makes each property about past values wait until they exist, and names their registers.
pub(crate) fn wait_for_pasts(draft: &mut Draft, summaries: &[Summary], outputs: &[(String, NodeId)]) {
    if draft.pasts.is_empty() {
        return;
    }
    let looks_back = edges_back(draft, summaries);
    let mut passed: BTreeMap<Time, Vec<NodeId>> = BTreeMap::new();
    for index in 0..draft.properties.len() {
        let (property, part) = (draft.properties[index].property.clone(), draft.properties[index].part);
        let edges = property.nodes().map(|node| looks_back[node.0 as usize]).max().unwrap_or(0);
        if edges > 0 {
            let time = (property.clock, part);
            let passed = passed.entry(time).or_default();
            while passed.len() < edges {
                let next = add_passed(draft, time, passed.last().copied(), property.loc);
                passed.push(next);
            }
            let condition = (property.condition, passed[edges - 1]);
            let condition = only_where(draft, property.directive, condition, property.loc);
            draft.properties[index].property.condition = condition;
        }
    }
    name_registers(draft, passed.into_values().flatten(), outputs);
}

/// How many edges back each node looks.
fn edges_back(draft: &Draft, summaries: &[Summary]) -> Vec<usize> {
    let pasts: BTreeMap<NodeId, NodeId> = draft.pasts.iter().map(|((of, ..), past)| (*past, *of)).collect();
    let past_of = |node: u32| pasts.get(&NodeId(node)).map(|of| of.0);
    let graph = Graph::new(draft.nodes.len(), |node, push| {
        past_of(node).into_iter().for_each(&mut *push);
        summary::operands(draft, summaries, NodeId(node), &mut |id| push(id.0));
    });
    let mut back = vec![0; draft.nodes.len()];
    for component in graph.components() {
        // Past values that depend on each other look back without end.
        let has_no_end = graph.is_cyclic(component) && component.iter().any(|node| past_of(*node).is_some());
        let behind = |node: &u32| {
            let own = usize::from(past_of(*node).is_some());
            graph.of(*node).iter().map(move |of| (*of, own))
        };
        let most = component.iter().flat_map(behind).map(|(of, own)| back[of as usize] + own).max().unwrap_or(0);
        let most = if has_no_end { pasts.len() } else { most };
        component.iter().for_each(|node| back[*node as usize] = most);
    }
    back
}

/// A register that goes high one edge later than `before` does; without `before`, one edge after power-on or a reset.
fn add_passed(draft: &mut Draft, time: Time, before: Option<NodeId>, loc: Loc) -> NodeId {
    let next = before.unwrap_or_else(|| draft.add(Op::Const(Bits::new(1, 1)), 1, Shape::Plain, loc));
    let node = add_register(draft, time, (1, Shape::Plain), loc);
    let register = draft.registers.last_mut().expect("just added");
    register.reset = Some((Init::Same(Bits::zero(1)), loc));
    register.initial = Some((Bits::zero(1), loc));
    register.next = Some((next, loc));
    node
}

/// The condition where `guard`, plain or of its shape, is high; elsewhere, the value that makes the property vacuous.
pub(crate) fn only_where(
    draft: &mut Draft,
    directive: Directive,
    (condition, guard): (NodeId, NodeId),
    loc: Loc,
) -> NodeId {
    let shape = draft.node(condition).shape;
    let (op, guard) = match directive {
        Directive::Cover | Directive::Display => (Binary::And, guard),
        Directive::Assert | Directive::Assume => {
            (Binary::Or, draft.add(Op::Unary(Unary::Not, guard), 1, draft.node(guard).shape, loc))
        }
    };
    let guard = draft.in_shape(guard, shape, loc);
    draft.add(Op::Binary(op, guard, condition), 1, shape, loc)
}

/// Names the registers: `count_past`, `past` for an unnamed signal, and `has_past`. A number follows if the name is
/// taken.
fn name_registers(draft: &mut Draft, passed: impl Iterator<Item = NodeId>, outputs: &[(String, NodeId)]) {
    let mut taken: BTreeSet<String> = draft.nodes.iter().filter_map(|node| node.name.clone()).collect();
    taken.extend(draft.inputs.iter().map(|input| input.name.clone()));
    taken.extend(outputs.iter().map(|(path, _)| draft.port(path)));
    taken.extend(draft.memories.iter().map(|draft| draft.memory.name.clone()));
    taken.extend(draft.instances.iter().map(|instance| instance.name.clone()));
    let mut pasts: Vec<(NodeId, NodeId)> = draft.pasts.iter().map(|((of, ..), past)| (*past, *of)).collect();
    // In the sequence of declaration, so that the past of a past finds a name.
    pasts.sort_unstable();
    let mut numbers: HashMap<String, RangeFrom<u64>> = HashMap::new();
    let passed = passed.map(|node| (node, None));
    for (node, of) in pasts.into_iter().map(|(past, of)| (past, Some(of))).chain(passed) {
        let name = match of {
            None => "has_past".to_owned(),
            Some(of) => draft.node(of).name.as_ref().map_or("past".to_owned(), |name| format!("{name}_past")),
        };
        let free = if taken.contains(&name) {
            let numbers = numbers.entry(name.clone()).or_insert(2..);
            let mut numbered = numbers.map(|number| format!("{name}_{number}"));
            numbered.find(|name| !taken.contains(name)).expect("there are names without end")
        } else {
            name
        };
        taken.insert(free.clone());
        draft.node_mut(node).name = Some(free);
    }
}
