//! From a draft to a finished module: every check, then the final form.

use crate::check;
use crate::chosen;
use crate::clock::OwnClock;
use crate::draft::Draft;
use crate::elaboration::{DependsOn, Elaboration};
use crate::enabled;
use crate::in_bounds;
use crate::past;
use crate::port_names;
use crate::signal::Signal;
use crate::stream::DraftStream;
use crate::summary;
use crate::transparent;
use tilewright_circuit::ir::*;
use tilewright_circuit::loops;
use tilewright_circuit::{Loc, Reset};

/// Takes the innermost draft, checks it, and adds it to the finished modules. Even with problems, the added module is
/// sound enough for checking its parents.
pub(crate) fn finish(
    e: &mut Elaboration,
    outputs: Vec<(String, Signal)>,
    name: String,
    about: About,
    parameters: String,
) {
    let kinds: Vec<Kind> = outputs.iter().map(|(_, signal)| signal.kind).collect();
    let outputs: Vec<_> = outputs.into_iter().map(|(path, signal)| (path, signal.node)).collect();
    let mut draft = e.drafts.pop().expect("a module is being built");
    let problems = &mut e.problems;
    check::drives::check(&mut draft, problems);
    chosen::assert_codes(&mut draft);
    in_bounds::assert_addresses(&mut draft);
    past::wait_for_pasts(&mut draft, &e.summaries, &outputs);
    let renumber = place_clocks(&mut draft);
    let resets = find_resets(&draft, &e.done, &e.depends_on);
    // A block that does not depend on the reset or the edge has one module for all kinds.
    let depends = DependsOn { reset: resets[0].is_some(), edge: draft.clock_used[0] };
    let name = named_after(name, depends, draft.own, e.unnamed);
    let reset_ports: Vec<_> = resets.iter().map(|reset| reset.as_ref().and_then(|(_, port)| port.clone())).collect();
    let name = check::naming::check(&mut draft, &e.done, &outputs, &reset_ports, name, problems);
    port_names::check(&draft, &outputs, problems);
    check::unused::check(&draft, &outputs, problems);
    check::foreign::check(&draft, &e.done, &outputs, problems);
    let sound = loops::check(&draft, &e.summaries, problems).is_some();
    let mixed = check::domains::check(&draft, &e.done, &e.summaries, &outputs, problems);
    if sound {
        check::stages::check(&draft, &e.summaries, problems);
    }
    enabled::apply(&mut draft, &e.done, &e.enables, problems);
    transparent::apply(&mut draft);
    let nodes: Vec<_> = outputs.iter().map(|(_, node)| *node).collect();
    let mut summary = match sound {
        true => summary::summarize(&draft, &e.summaries, &nodes, &renumber),
        false => summary::Summary::unknown(nodes.len()),
    };
    check::streams::check(&draft, &outputs, &summary, problems);
    // A problem reported here is not reported again for every parent.
    mixed.into_iter().for_each(|output| summary.outputs[output].hide_clocks());
    summary.is_pad = draft.is_pad;
    summary.synchronized = check::synchronizers::check(&draft, &e.summaries, problems);
    let ports = draft.inputs.iter().map(|input| input.node).chain(nodes);
    summary.faulty = ports.filter(|node| draft.stand_ins.contains(node)).collect();
    e.summaries.push(summary);
    e.instantiated.push(draft.loc);
    e.own_periods.push(draft.own_periods.clone());
    e.enables
        .push(draft.enables.iter().map(|(clock, _)| draft.clocks[clock.0 as usize].map(|clock| clock.name)).collect());
    e.depends_on.push(depends);
    let block = (draft.block, !draft.enables.is_empty());
    let module = module(draft, outputs.into_iter().zip(kinds), &renumber, &resets, name, about, parameters);
    e.done.push(module);
    if e.problems.is_empty() {
        check::latency::check(block, &e.done, &mut e.delays, &mut e.problems);
    }
}

/// The module's name, with what of its own clock matters here and is not as names leave it out.
fn named_after(mut name: String, depends: DependsOn, own: OwnClock, unnamed: OwnClock) -> String {
    if depends.reset && own.reset != unnamed.reset {
        name = format!("{name}_{}", own.reset.suffix());
    }
    if depends.edge && own.edge != unnamed.edge {
        name = format!("{name}_{}", own.edge.suffix());
    }
    name
}

/// Finds the clock of each input, and the position of each clock of the draft among the used ones.
fn place_clocks(draft: &mut Draft) -> Vec<Option<u32>> {
    for i in 0..draft.inputs.len() {
        if let Some(clock) = draft.input_clocks[i] {
            let id = draft.clock(Some(clock));
            draft.inputs[i].clock = Some(id);
        }
    }
    // An input that names no clock is synchronous to the block's own, or to the only one in use.
    let used: Vec<_> = (0..draft.clocks.len() as u32).filter(|id| draft.clock_used[*id as usize]).collect();
    let own = if draft.clock_used[0] { Some(0) } else { used.first().copied().filter(|_| used.len() == 1) };
    draft.inputs.iter_mut().for_each(|input| input.clock = input.clock.or(own.map(ClockId)));
    let mut place = 0..;
    draft.clock_used.iter().map(|used| used.then(|| place.next().expect("endless"))).collect()
}

/// A kind of reset, and its port if it has one.
type ResetPort = (Reset, Option<String>);

/// For each clock of the draft, its reset, if a register uses it or an assertion waits for it. `depends` says which of
/// the finished modules depend on the reset of their default clock.
fn find_resets(draft: &Draft, done: &[Module], depends: &[DependsOn]) -> Vec<Option<ResetPort>> {
    let kind = |clock: usize| draft.reset_of(ClockId(clock as u32));
    let given = |clock: usize| {
        let port = draft.foreign.as_ref()?.reset_port(draft.clocks[clock])?;
        kind(clock).has_port().then(|| (kind(clock), Some(port.to_owned())))
    };
    let mut resets: Vec<Option<ResetPort>> = (0..draft.clocks.len()).map(given).collect();
    let mut needs = |clock: ClockId| {
        resets[clock.0 as usize] = Some((draft.reset_of(clock), draft.reset_port(clock)));
    };
    draft.registers.iter().filter(|register| register.reset.is_some()).for_each(|register| needs(register.clock));
    draft.properties.iter().for_each(|draft| needs(draft.property.clock));
    for instance in &draft.instances {
        let (child, depends) = (&done[instance.module.0 as usize], depends[instance.module.0 as usize].reset);
        for (clock, driver) in child.clocks.iter().zip(&instance.clocks) {
            let is_reset = clock.reset.is_some() || clock.kind == Reset::PowerOn;
            if is_reset || depends && clock.name.is_none() {
                needs(*driver);
            }
        }
    }
    resets
}

/// The place of the block: its declaration or, if unknown, the first object that its `build` makes. (Its ports may be
/// those of another block.)
fn place(draft: &Draft) -> Loc {
    if let Some(declared) = draft.declared {
        return declared;
    }
    let is_port = |(i, node): &(usize, &Node)| {
        matches!(node.op, Op::Input(_)) || draft.streams.get(&NodeId(*i as u32)).is_some_and(DraftStream::comes_in)
    };
    let made = draft.nodes.iter().enumerate().find(|node| !is_port(node)).map(|(_, node)| node);
    let made = made.or(draft.nodes.first()).map_or(draft.loc, |node| node.loc);
    // A memory is not a node.
    let memory = draft.memories.first().map(|draft| draft.memory.loc);
    memory.filter(|memory| memory.file() == made.file() && memory.line() < made.line()).unwrap_or(made)
}

fn module(
    draft: Draft,
    outputs: impl Iterator<Item = ((String, NodeId), Kind)>,
    renumber: &[Option<u32>],
    resets: &[Option<ResetPort>],
    name: String,
    about: About,
    parameters: String,
) -> Module {
    let clock_id = |clock: ClockId| ClockId(renumber[clock.0 as usize].expect("a clock in use has a place"));
    let loc = place(&draft);
    let clocks = draft.clocks.iter().zip(resets).zip(renumber).filter(|(_, place)| place.is_some());
    let clocks = clocks.map(|((clock, reset), _)| Clock {
        port: draft.clock_port(*clock),
        reset: reset.as_ref().and_then(|(_, port)| port.clone()),
        kind: reset.as_ref().map_or(Reset::Synchronous, |(kind, _)| *kind),
        edge: clock.map_or(draft.own.edge, |clock| clock.edge),
        period: clock.map(|clock| clock.period),
        name: clock.map(|clock| clock.name),
    });
    let clocks = clocks.collect();
    let known = |clock: Option<ClockId>| clock.and_then(|clock| renumber[clock.0 as usize]).map(ClockId);
    let inputs = draft.inputs.iter().map(|input| Input { clock: known(input.clock), ..input.clone() }).collect();
    let output = |((path, node), kind): ((String, NodeId), Kind)| Output { name: draft.port(&path), path, node, kind };
    let outputs = outputs.map(output).collect();
    let registers = draft.registers.into_iter().map(|register| Register {
        node: register.node,
        clock: clock_id(register.clock),
        reset: register.reset.map(|(value, _)| value),
        enable: register.enable.map(|(node, _)| node),
        next: register.next.map_or(register.node, |(node, _)| node),
        initial: register.initial.map(|(value, _)| value),
        is_synchronizer: register.is_synchronizer,
        attributes: register.attributes,
    });
    let registers = registers.collect();
    let memories = draft.memories.into_iter().map(|draft| {
        let mut memory = draft.memory;
        memory.reads.iter_mut().for_each(|read| read.clock = read.clock.map(clock_id));
        memory.writes.iter_mut().for_each(|write| write.clock = clock_id(write.clock));
        memory
    });
    let memories = memories.collect();
    let instances = draft.instances.into_iter().map(|mut instance| {
        instance.clocks.iter_mut().for_each(|clock| *clock = clock_id(*clock));
        instance
    });
    let instances = instances.collect();
    let properties = draft.properties.into_iter().map(|draft| draft.property);
    let properties = properties.map(|property| Property { clock: clock_id(property.clock), ..property }).collect();
    Module {
        name,
        about,
        parameters,
        loc,
        clocks,
        inputs,
        outputs,
        nodes: draft.nodes,
        registers,
        memories,
        instances,
        properties,
        records: draft.records,
        foreign: draft.foreign,
        is_pad: draft.is_pad,
        unmodelled: draft.unmodelled.is_some(),
    }
}
