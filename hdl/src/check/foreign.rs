//! Foreign modules: names are legal, and what the model needs is among the ports.

use crate::attribute;
use crate::draft::Draft;
use crate::elaboration::Elaboration;
use crate::names::illegal;
use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::{ClockId, Foreign, Instance, Module, NodeId, Op, Parameter};
use tilewright_circuit::{Loc, Mistake, Problem};

/// Begins the module with the clocks of the foreign one, if it is one.
pub(crate) fn begin(e: &mut Elaboration, foreign: Option<Foreign>) {
    let Some(foreign) = foreign else { return };
    names(&foreign, &mut e.problems);
    for (clock, _) in foreign.clocks.iter().chain(&foreign.resets) {
        clock.iter().for_each(|clock| e.meet_clock(*clock, foreign.loc));
        e.draft().use_clock(*clock);
    }
    foreign.makes.iter().for_each(|(clock, _)| e.meet_clock(*clock, foreign.loc));
    e.draft().foreign = Some(foreign);
}

fn names(foreign: &Foreign, problems: &mut Vec<Problem>) {
    let (module, loc) = (&foreign.module, foreign.loc);
    problems.extend(illegal("a foreign module", module, loc));
    for (i, (name, value)) in foreign.parameters.iter().enumerate() {
        problems.extend(illegal("a parameter", name, loc));
        if foreign.parameters[..i].iter().any(|(known, _)| known == name) {
            let message = format!("parameter `{name}` of `{module}` is given twice");
            problems.push(Problem::new(Mistake::GivenTwice, loc, message).help("give it once"));
        }
        if let Parameter::Real(number) = value
            && !number.is_finite()
        {
            let message = format!("parameter `{name}` of `{module}` is {number}, which is no number of Verilog");
            problems.push(Problem::new(Mistake::NoValue, loc, message).help("give it a finite number"));
        }
    }
    foreign.makes.iter().for_each(|(_, port)| problems.extend(illegal("a clock", port, loc)));
    for (i, attribute) in foreign.attributes.iter().enumerate() {
        let before = &foreign.attributes[..i];
        problems.extend(attribute::wrong(before, &attribute.name, &attribute.value, loc));
    }
}

/// Reports what the description of a foreign module and its model disagree about.
pub(crate) fn check(draft: &Draft, done: &[Module], outputs: &[(String, NodeId)], problems: &mut Vec<Problem>) {
    match (&draft.foreign, draft.unmodelled) {
        (Some(foreign), _) => {
            ports(draft, foreign, outputs, problems);
            clocks(draft, done, foreign, outputs, problems);
            if !draft.enables.is_empty() {
                let message = format!("`{}` is in an enabled part, but is a module of somebody else", foreign.module);
                let help =
                    "it has no input for that enable: instantiate it outside, and enable it by a port of its own";
                problems.push(Problem::new(Mistake::EnabledForeign, draft.loc, message).help(help));
            }
        }
        (None, Some(loc)) => {
            let message = format!("`{}` is described as unmodelled, but is no foreign module", draft.block);
            let help =
                "name the module in `block!`, as in `foreign = Foreign::module(\"EHXPLLL\");`, or describe a circuit";
            problems.push(Problem::new(Mistake::NoForeignModule, loc, message).help(help));
        }
        (None, None) => {}
    }
}

/// A clock that a foreign module makes is made by one instance, in the top.
pub(crate) fn made_clocks(done: &[Module]) -> Vec<Problem> {
    let mut problems = Vec::new();
    let mut made: BTreeMap<&str, &Instance> = BTreeMap::new();
    for (i, module) in done.iter().enumerate() {
        for instance in &module.instances {
            let foreign = done[instance.module.0 as usize].foreign.as_ref();
            for (clock, _) in foreign.iter().flat_map(|foreign| &foreign.makes) {
                let (clock, name) = (clock.name, &instance.name);
                let what = format!("`{name}` makes the clock `{clock}`");
                let (message, help) = if i + 1 < done.len() {
                    (format!("{what} in `{}`, which is not the top", module.name), "instantiate it in the top")
                } else if !instance.shape.is_plain() {
                    (format!("{what} in {} lanes", instance.shape.lanes()), "one instance makes a clock")
                } else if let Some(first) = made.insert(clock, instance) {
                    (format!("{what}, which `{}` makes", first.name), "one instance makes a clock")
                } else {
                    continue;
                };
                problems.push(Problem::new(Mistake::MadeClock, instance.loc, message).help(help));
            }
        }
    }
    problems
}

fn ports(draft: &Draft, foreign: &Foreign, outputs: &[(String, NodeId)], problems: &mut Vec<Problem>) {
    let inputs = draft.inputs.iter().map(|input| input.path.as_str());
    let paths: Vec<&str> = inputs.chain(outputs.iter().map(|(path, _)| path.as_str())).collect();
    for (port, name) in &foreign.ports {
        let is_it =
            |path: &&str| path.strip_prefix(port.as_str()).is_some_and(|rest| rest.is_empty() || is_number(rest));
        if !paths.iter().any(is_it) {
            let (block, module) = (draft.block, &foreign.module);
            let message = format!("port `{name}` of `{module}` is to be `{port}`, but `{block}` has no such port");
            let help = match paths.join("`, `") {
                paths if paths.is_empty() => "it has no ports".to_owned(),
                paths => format!("its ports are `{paths}`"),
            };
            problems.push(Problem::new(Mistake::NoSuchPort, foreign.loc, message).help(help));
        }
    }
}

/// Whether this is the end of the path of an element of a list.
fn is_number(rest: &str) -> bool {
    rest.strip_prefix('.').is_some_and(|number| number.bytes().all(|digit| digit.is_ascii_digit()))
}

/// State on which an output depends needs its clock from the foreign module's ports. For its assertions, the model
/// has ports of its own.
fn clocks(
    draft: &Draft,
    done: &[Module],
    foreign: &Foreign,
    outputs: &[(String, NodeId)],
    problems: &mut Vec<Problem>,
) {
    for (clock, (is_reset, loc)) in needed(draft, done, outputs) {
        let clock = draft.clocks[clock.0 as usize];
        let missing = match is_reset {
            _ if foreign.clock_port(clock).is_none() => "clock",
            true if foreign.reset_port(clock).is_none() => "reset",
            _ => continue,
        };
        let (block, module) = (draft.block, &foreign.module);
        let of = clock.map(|clock| format!(" `{}`", clock.name)).unwrap_or_default();
        let of = if missing == "reset" && clock.is_some() { format!(" of{of}") } else { of };
        let message = format!("the model `{block}` has state with a {missing}{of}, but `{module}` has no port for it");
        let call = match clock {
            None => format!("`.{missing}(\"..\")`"),
            Some(clock) => format!("`.{missing}_of({}, \"..\")`", clock.name.to_ascii_uppercase()),
        };
        let other = if missing == "reset" { ", or use `.initial(..)` in place of `.reset(..)`" } else { "" };
        let help = format!("name the port: {call} behind `Foreign::module(\"{module}\")`{other}");
        problems.push(Problem::new(Mistake::NoClockPort, loc, message).help(help));
    }
}

/// The clocks of state on which an output depends, each with whether its reset is needed, and the first place.
fn needed(draft: &Draft, done: &[Module], outputs: &[(String, NodeId)]) -> BTreeMap<ClockId, (bool, Loc)> {
    let mut needed: BTreeMap<ClockId, (bool, Loc)> = BTreeMap::new();
    let mut add = |clock: ClockId, is_reset: bool, loc: Loc| match needed.get_mut(&clock) {
        Some((reset, _)) if *reset || !is_reset => {}
        Some(known) => *known = (true, loc),
        None => drop(needed.insert(clock, (is_reset, loc))),
    };
    let mut seen = BTreeSet::new();
    let mut behind: Vec<NodeId> = outputs.iter().map(|(_, node)| *node).collect();
    while let Some(id) = behind.pop() {
        if !seen.insert(id) {
            continue;
        }
        match draft.node(id).op {
            Op::Register(register) => {
                let register = &draft.registers[register.0 as usize];
                add(register.clock, register.reset.is_some(), draft.node(id).loc);
                behind.extend(register.next.iter().chain(&register.enable).map(|(node, _)| *node));
            }
            Op::Read(memory, _) => {
                let memory = &draft.memories[memory.0 as usize].memory;
                let (reads, writes) = (&memory.reads, &memory.writes);
                let clocks = reads.iter().filter_map(|read| read.clock).chain(writes.iter().map(|write| write.clock));
                clocks.for_each(|clock| add(clock, false, memory.loc));
                behind.extend(reads.iter().flat_map(|read| read.enable.into_iter().chain([read.address])));
                behind.extend(writes.iter().flat_map(|write| [write.enable, write.address, write.data]));
            }
            Op::Output(instance, _) => {
                let instance = &draft.instances[instance.0 as usize];
                let clocks = done[instance.module.0 as usize].clocks.iter().zip(&instance.clocks);
                clocks.for_each(|(clock, driver)| add(*driver, clock.reset.is_some(), instance.loc));
                behind.extend(&instance.inputs);
            }
            ref op => op.for_each_operand(|operand| behind.push(operand)),
        }
    }
    needed
}
