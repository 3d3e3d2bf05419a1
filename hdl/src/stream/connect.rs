//! The way back of a stream's `ready`: a net that the receiver of the stream drives.

use crate::draft::{Draft, DraftWire, UNDRIVEN};
use crate::elaboration::{self, Elaboration};
use crate::fields::{Fields, Leaf, Visited};
use crate::module::Module;
use crate::names::port_name;
use crate::signal::Signal;
use crate::wire::is_here;
use tilewright_circuit::ir::{Input, InstanceId, Kind, NodeId, Op, Shape};
use tilewright_circuit::{Clock, Loc, Mistake, Problem};

/// A stream that can be taken in the module under construction.
pub(crate) struct DraftStream {
    pub origin: Origin,
    /// The index of its `ready` among the wires.
    pub wire: usize,
    /// The sender's clock.
    pub clock: Option<Clock>,
    pub loc: Loc,
}

/// A stream that the module sends to its parent.
pub(crate) struct Sent {
    /// The path of its `valid` among the outputs.
    pub valid: String,
    /// The index of its `ready` among the inputs.
    pub ready: u32,
    pub loc: Loc,
}

/// The origin of a stream.
#[derive(Clone)]
pub(crate) enum Origin {
    /// An input with this path.
    Input(String),
    /// An output of an instance.
    Instance { instance: String, port: String },
    /// The module itself offers it.
    Offered,
}

impl DraftStream {
    /// Whether it is an input of the module.
    pub fn comes_in(&self) -> bool {
        matches!(self.origin, Origin::Input(_))
    }

    /// The stream's description for messages, and the verb for how it begins.
    pub fn text(&self) -> (String, &'static str) {
        match &self.origin {
            Origin::Input(path) => (format!("stream `{}`", port_name("", path)), "is declared"),
            Origin::Instance { instance, port } => (format!("stream `{port}` of `{instance}`"), "is made"),
            Origin::Offered => ("a stream that is offered".to_owned(), "is offered"),
        }
    }
}

/// For each leaf, whether it runs backwards, as the `ready` of a stream does.
pub(crate) fn backwards<T: Leaf>(bundle: &impl Fields<T>) -> Vec<bool> {
    let mut backwards = Vec::new();
    bundle.visit(&mut |part| match part {
        Visited::Leaf(_) => backwards.push(false),
        Visited::Back(_) => backwards.push(true),
        Visited::List(_) => {}
    });
    backwards
}

/// The `ready` of a stream that nobody takes yet.
pub(crate) fn untaken(e: &mut Elaboration, origin: Origin, shape: Shape, clock: Option<Clock>, loc: Loc) -> Signal {
    let draft = e.draft();
    let node = draft.add(Op::Wire(UNDRIVEN), 1, shape, loc);
    if let Origin::Input(path) = &origin {
        let name = draft.port(&format!("{path}.ready"));
        draft.node_mut(node).name = Some(name);
    }
    let wire = draft.wires.len();
    draft.wires.push(DraftWire { node, driver: None });
    draft.streams.insert(node, DraftStream { origin, wire, clock, loc });
    Signal::at(e, node)
}

impl Module {
    /// The `ready`, at this path, of a stream that an instance sends, with the instance's lanes.
    pub(crate) fn unanswered(self, e: &mut Elaboration, id: InstanceId, path: &str, shape: Shape, loc: Loc) -> Signal {
        let draft = e.drafts.last().expect("a module is being built");
        let instance = &draft.instances[id.0 as usize];
        let port = e.done[instance.module.0 as usize].inputs.iter().rfind(|input| input.path == path);
        let clock = port.and_then(|port| port.clock).map(|clock| instance.clocks[clock.0 as usize]);
        let clock = clock.map_or(self.clock, |clock| draft.clocks[clock.0 as usize]);
        let shape = instance.shape.beside(shape).unwrap_or(instance.shape);
        let port = port_name("", path.strip_suffix(".ready").unwrap_or(path));
        let origin = Origin::Instance { instance: instance.name.clone(), port };
        untaken(e, origin, shape, clock, loc)
    }
}

/// Drives the `ready` of a stream, which its receiver does once.
pub(crate) fn take(ready: Signal, driver: Signal, loc: Loc) {
    if !is_here(ready, driver.node, loc) {
        return;
    }
    elaboration::with(|e| {
        let Some(stream) = e.draft().streams.get(&ready.node) else {
            return report_no_stream(e, ready, driver.node, loc);
        };
        let (wire, (text, begins), began, is_port) = (stream.wire, stream.text(), stream.loc, stream.comes_in());
        let driver = match (driver.shape == ready.shape, driver.shape.is_plain()) {
            (true, _) => driver,
            (false, true) => driver.spread_in(e, ready.shape, loc),
            (false, false) => {
                let message = format!("{text} has {}, but is taken by {}", ready.shape, driver.shape);
                let problem = Problem::new(Mistake::StreamLanes, loc, message).note(format!("{text} {begins}"), began);
                e.report_instead_of(
                    &[driver.node],
                    problem.help("a stream has one receiver: give each lane a stream of its own"),
                );
                Signal::zero_in(e, 1, ready.shape, Kind::Number, loc)
            }
        };
        let draft = e.draft();
        if is_port {
            // The port's driver gets the line that takes the stream.
            draft.node_mut(ready.node).loc = loc;
        }
        let before = draft.wires[wire].driver.replace((driver.node, loc));
        if let Some((lost, first)) = before {
            let mut problem = Problem::new(Mistake::TakenTwice, loc, format!("{text} is taken twice"));
            // A returned stream has no line other than that of its origin.
            for (note, place) in [("the first time is".to_owned(), first), (format!("{text} {begins}"), began)] {
                problem = if place == loc { problem } else { problem.note(note, place) };
            }
            e.report_instead_of(&[lost], problem.help("a stream has one receiver: a fork makes two of it"));
        }
    });
}

fn report_no_stream(e: &mut Elaboration, ready: Signal, driver: NodeId, loc: Loc) {
    let draft = e.draft();
    let (text, place) = (draft.describe(ready.node), draft.node(ready.node).loc);
    let mut problem =
        Problem::new(Mistake::NoStream, loc, format!("`{text}` is used as the `ready` of a stream, but is not one"));
    if place != loc {
        problem = problem.note(format!("`{text}` is made"), place);
    }
    let problem = problem.help(
        "a stream is an input, an output of an instance, or made by `m.offer`; registers and memories store its payload",
    );
    e.report_instead_of(&[ready.node, driver], problem);
}

/// The stream of this `ready` leaves the module: its receiver's answer is the input port with this path.
pub(crate) fn leave(path: &str, ready: Signal, loc: Loc) {
    let (port, loc) = elaboration::with(|e| {
        let draft = e.draft();
        // A mistake is reported at the stream's origin, because the return value has no line.
        let is_own = draft.serial == ready.module;
        let stream = draft.streams.get(&ready.node).filter(|_| is_own);
        let clock = stream.and_then(|stream| stream.clock);
        let is_offered = stream.is_some_and(|stream| matches!(stream.origin, Origin::Offered));
        let loc = match stream {
            Some(stream) => stream.loc,
            None if is_own => draft.node(ready.node).loc,
            None => loc,
        };
        let name = draft.port(path);
        let index = draft.inputs.len() as u32;
        let node = draft.add(Op::Input(index), 1, ready.shape, loc);
        draft.node_mut(node).name = Some(name.clone());
        draft.inputs.push(Input { name, path: path.to_owned(), node, clock: None });
        draft.input_clocks.push(clock);
        if is_offered {
            let valid = format!("{}valid", path.strip_suffix("ready").unwrap_or(path));
            draft.sent.push(Sent { valid, ready: index, loc });
        }
        (Signal::at(e, node), loc)
    });
    take(ready, port, loc);
}

/// The inputs that belong to the stream of this `ready`, if the stream is an input.
pub(crate) fn inputs_of_stream(draft: &Draft, ready: NodeId) -> Vec<NodeId> {
    let Some(Origin::Input(stream)) = draft.streams.get(&ready).map(|stream| &stream.origin) else { return Vec::new() };
    let is_in_it = |path: &str| path.strip_prefix(stream.as_str()).is_some_and(|rest| rest.starts_with('.'));
    draft.inputs.iter().filter(|input| is_in_it(&input.path)).map(|input| input.node).collect()
}

/// The problem of a stream that nobody takes.
pub(crate) fn say_untaken(draft: &Draft, node: NodeId) -> Option<Problem> {
    let stream = draft.streams.get(&node)?;
    let (text, help) = match &stream.origin {
        Origin::Offered => (stream.text().0, "return it among the outputs, or feed an instance with it"),
        _ => (
            stream.text().0,
            "take it with `.take_when(condition)`, feed an instance with it, or return it among the outputs",
        ),
    };
    Some(
        Problem::new(Mistake::UntakenStream, stream.loc, format!("{text} in `{}` is never taken", draft.block))
            .help(help),
    )
}
