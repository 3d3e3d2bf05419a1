//! Pads are in the top, and each has its outside among the top's inputs.

use crate::names::{is_reserved, is_reserved_in_cpp, port_name};
use tilewright_circuit::ir::{Clock, Input, Instance, Module};
use tilewright_circuit::{Mistake, Problem};

/// Reports pads that cannot become ports. The top is the last module.
pub(crate) fn check(done: &[Module]) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (i, module) in done.iter().enumerate() {
        let is_pad = |instance: &&Instance| done[instance.module.0 as usize].is_pad;
        for pad in module.instances.iter().filter(is_pad) {
            problems.extend(wrong(module, pad, i + 1 == done.len()));
        }
    }
    problems
}

fn wrong(module: &Module, pad: &Instance, is_top: bool) -> Option<Problem> {
    let name = &pad.name;
    if !is_top || !pad.shape.is_plain() {
        let (message, help) = match is_top {
            false => {
                let message = format!("pad `{name}` is in `{}`, which is not the top", module.name);
                (message, "instantiate it in the top, and connect the block by ports `out`, `enable` and `line`")
            }
            true => {
                let message = format!("pad `{name}` is an array of {}", pad.shape);
                (message, "a pad may have several bits, `Pad::new(16)`; pads of their own are instances of their own")
            }
        };
        return Some(Problem::new(Mistake::PadElsewhere, pad.loc, message).help(help));
    }
    let Some(port) = module.pad_port(pad) else {
        let message =
            format!("the outside of pad `{name}` is not an input of `{}` that is used for it alone", module.name);
        let help = "declare the input, as in `sda: Outside::widths(1)`, give it to one pad, and read the pad's `line`";
        return Some(Problem::new(Mistake::PadOutside, pad.loc, message).help(help));
    };
    if is_reserved(&port) || is_reserved_in_cpp(&port) {
        let message = format!("pad `{port}` has a reserved word for a name");
        let problem = Problem::new(Mistake::ReservedName, pad.loc, message);
        return Some(problem.help(format!("call its input `{port}_` or something else")));
    }
    let (kind, loc) = named(module, &port)?;
    let message = format!("pad `{port}` has the name of {kind}");
    let problem = Problem::new(Mistake::TakenName, pad.loc, message).note(format!("`{port}` is declared"), loc);
    Some(problem.help("the outside of a pad gives its name to a port of the chip: rename one of them"))
}

/// The names that pads give to ports of the chip, if each outside among the inputs has a pad.
pub(super) fn ports(inputs: &[Input]) -> impl Iterator<Item = String> {
    inputs.iter().filter_map(|input| Some(port_name("", input.path.strip_suffix(".drives")?)))
}

/// What else has the name of a pad's port.
fn named(module: &Module, port: &str) -> Option<(&'static str, tilewright_circuit::Loc)> {
    let output = module.outputs.iter().find(|output| output.name == port);
    let output = output.map(|output| ("an output", module.node(output.node).loc));
    let net = module.nodes.iter().find(|node| node.name.as_deref() == Some(port));
    let net = || net.map(|node| ("a net", node.loc));
    let memory = || module.memories.iter().find(|memory| memory.name == port).map(|memory| ("a memory", memory.loc));
    let instance = || module.instances.iter().find(|it| it.name == port).map(|it| ("an instance", it.loc));
    let clock = || module.clocks.iter().find(|clock| clock.port == port).map(|_| ("a clock", module.loc));
    let is_reset = |clock: &&Clock| clock.reset.as_deref() == Some(port);
    let reset = || module.clocks.iter().find(is_reset).map(|_| ("a reset", module.loc));
    output.or_else(net).or_else(memory).or_else(instance).or_else(clock).or_else(reset)
}
