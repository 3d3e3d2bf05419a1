//! Which item feeds which: every path through logic between two items.

use super::items::{Items, What};
use super::ports::Role;
use std::collections::BTreeSet;
use tilewright_circuit::ir::{Module, NodeId, Op};

/// A path from one item to another, through any amount of logic.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Wire {
    pub from: usize,
    pub to: usize,
    /// The bundle of the instance that it leaves, and of the one that it enters.
    pub leaves: Option<usize>,
    pub enters: Option<usize>,
    /// It carries a value. A path of control only selects among values or enables a change.
    pub is_data: bool,
    /// One of its ends is the payload of a stream.
    pub is_stream: bool,
    /// One of its ends is the `ready` of a stream.
    pub is_ready: bool,
}

/// A node of a scope.
type Place = (usize, NodeId);

/// Where a path begins.
struct Source {
    item: usize,
    bundle: Option<usize>,
    /// It is the payload of a stream.
    is_stream: bool,
    is_data: bool,
    is_ready: bool,
}

/// The end of a path.
struct Sink {
    item: usize,
    bundle: Option<usize>,
    is_stream: bool,
    is_ready: bool,
}

/// All wires between items. A stream's arrow stands for its handshake too, so a wire from or to `ready` stays only where an item has no other.
pub(super) fn wires(items: &Items) -> Vec<Wire> {
    let mut tracer = Tracer { items, found: BTreeSet::new() };
    (0..items.list.len()).for_each(|item| tracer.trace(item));
    let others = || tracer.found.iter().filter(|wire| !wire.is_ready);
    let ports = |comes_in: bool| {
        let is_one =
            move |what: What| matches!(what, What::Port(it) if items.top_ports().bundles[it].comes_in == comes_in);
        (0..items.list.len()).filter(move |item| is_one(items.list[*item].1))
    };
    let left: BTreeSet<usize> = others().map(|wire| wire.from).chain(ports(false)).collect();
    let entered: BTreeSet<usize> = others().map(|wire| wire.to).chain(ports(true)).collect();
    let kept = |wire: &&Wire| !wire.is_ready || !left.contains(&wire.from) || !entered.contains(&wire.to);
    tracer.found.iter().filter(kept).cloned().collect()
}

/// Whether a port or an instance depends on each item. The others feed assertions alone.
pub(super) fn live(items: &Items, wires: &[Wire]) -> Vec<bool> {
    let is_end = |item: &(usize, What)| !matches!(item.1, What::Register(_) | What::Memory(_));
    let mut live: Vec<bool> = items.list.iter().map(is_end).collect();
    let mut before: Vec<Vec<usize>> = vec![Vec::new(); live.len()];
    wires.iter().for_each(|wire| before[wire.to].push(wire.from));
    let mut next: Vec<usize> = (0..live.len()).filter(|item| live[*item]).collect();
    while let Some(item) = next.pop() {
        for from in std::mem::take(&mut before[item]) {
            if !std::mem::replace(&mut live[from], true) {
                next.push(from);
            }
        }
    }
    live
}

struct Tracer<'a> {
    items: &'a Items<'a>,
    found: BTreeSet<Wire>,
}

impl Tracer<'_> {
    /// Finds every wire that enters an item.
    fn trace(&mut self, item: usize) {
        let (scope, what) = self.items.list[item];
        let module = self.items.scopes[scope].module;
        let plain = Sink { item, bundle: None, is_stream: false, is_ready: false };
        match what {
            What::Port(bundle) => self.trace_port(item, bundle),
            What::Register(id) => {
                let register = &module.registers[id.0 as usize];
                self.add(&plain, (scope, register.next), true);
                register.enable.iter().for_each(|enable| {
                    self.add(&plain, (scope, *enable), false);
                });
            }
            What::Memory(id) => {
                let memory = &module.memories[id.0 as usize];
                let writes = memory.writes.iter().map(|it| ([Some(it.data), Some(it.address)], Some(it.enable)));
                let reads = memory.reads.iter().map(|it| ([Some(it.address), None], it.enable));
                for (data, enable) in writes.chain(reads) {
                    data.iter().flatten().for_each(|node| {
                        self.add(&plain, (scope, *node), true);
                    });
                    enable.iter().for_each(|enable| {
                        self.add(&plain, (scope, *enable), false);
                    });
                }
            }
            What::Instance(id) => {
                let instance = self.items.instance(scope, id);
                let roles = &self.items.ports_of(instance).inputs;
                let fed: Vec<_> = roles.iter().zip(&instance.inputs).map(|((b, role), id)| (*b, *role, *id)).collect();
                self.trace_ports(item, scope, &fed);
            }
            What::Net(id) => {
                self.add(&plain, (scope, id), true);
            }
        }
    }

    fn trace_port(&mut self, item: usize, bundle: usize) {
        let roles = self.items.top_ports().outputs.iter().zip(&self.items.scopes[0].module.outputs);
        let driven = roles.filter(|((of, _), _)| *of == bundle).map(|((_, role), port)| (bundle, *role, port.node));
        self.trace_ports(item, 0, &driven.collect::<Vec<_>>());
    }

    fn trace_ports(&mut self, item: usize, scope: usize, ports: &[(usize, Role, NodeId)]) {
        let is_stream = |bundle: usize| ports.iter().any(|(of, role, _)| *of == bundle && *role == Role::Valid);
        let mut carries = BTreeSet::new();
        for (bundle, _, node) in ports.iter().filter(|it| it.1 == Role::Payload) {
            let sink = Sink { item, bundle: Some(*bundle), is_stream: is_stream(*bundle), is_ready: false };
            if self.add(&sink, (scope, *node), true) {
                carries.insert(*bundle);
            }
        }
        for (bundle, role, node) in ports.iter().filter(|it| it.1 != Role::Payload) {
            let is_ready = *role == Role::Ready;
            // A stream of constants has no source but that of its `valid`.
            let is_all = !is_ready && !carries.contains(bundle);
            self.add(&Sink { item, bundle: Some(*bundle), is_stream: is_all, is_ready }, (scope, *node), is_all);
        }
    }

    /// Adds the wires from the sources of a node to a sink. Returns whether any carries a value.
    fn add(&mut self, sink: &Sink, node: Place, is_data: bool) -> bool {
        let sources = self.sources(node, is_data, sink.item);
        let any = sources.iter().any(|source| source.is_data);
        for source in sources.into_iter().filter(|source| source.item != sink.item) {
            self.found.insert(Wire {
                from: source.item,
                to: sink.item,
                leaves: source.bundle,
                enters: sink.bundle,
                is_data: source.is_data,
                is_stream: source.is_data && (source.is_stream || sink.is_stream),
                is_ready: source.is_ready || sink.is_ready,
            });
        }
        any
    }

    /// The sources of a node: those of its value first, then those of control. The sink itself is not one.
    fn sources(&self, node: Place, is_data: bool, sink: usize) -> Vec<Source> {
        let (mut seen, mut sources) = (BTreeSet::new(), Vec::new());
        let (mut data, mut control) = if is_data { (vec![node], vec![]) } else { (vec![], vec![node]) };
        while let Some((node, is_data)) =
            data.pop().map(|it| (it, true)).or_else(|| control.pop().map(|it| (it, false)))
        {
            if !seen.insert(node) {
                continue;
            }
            match self.step(node, is_data, sink) {
                Step::Source(source) => sources.push(source),
                Step::Through(node) => if is_data { &mut data } else { &mut control }.push(node),
                Step::Logic => {
                    let (scope, id) = node;
                    for (operand, carries) in operands(self.items.scopes[scope].module, id) {
                        if is_data && carries { &mut data } else { &mut control }.push((scope, operand));
                    }
                }
            }
        }
        sources
    }

    fn step(&self, (scope, id): Place, is_data: bool, sink: usize) -> Step {
        let items = self.items;
        let module = items.scopes[scope].module;
        let source = |what| {
            items.find(scope, what).map(|item| Source {
                item,
                bundle: None,
                is_stream: false,
                is_data,
                is_ready: false,
            })
        };
        if let Some(net) = source(What::Net(id)).filter(|net| net.item != sink) {
            return Step::Source(net);
        }
        match module.node(id).op {
            Op::Register(register) => source(What::Register(register)).map_or(Step::Logic, Step::Source),
            Op::Read(memory, _) => source(What::Memory(memory)).map_or(Step::Logic, Step::Source),
            Op::Input(port) => match items.scopes[scope].outside {
                Some((outside, id)) => Step::Through((outside, items.instance(outside, id).inputs[port as usize])),
                None => {
                    let (bundle, role) = items.top_ports().inputs[port as usize];
                    let is_stream = items.top_ports().bundles[bundle].is_stream;
                    Step::of_port(source(What::Port(bundle)), None, role, is_stream)
                }
            },
            Op::Output(id, port) => match items.scopes[scope].opened.get(&id) {
                Some(inside) => Step::Through((*inside, items.scopes[*inside].module.outputs[port as usize].node)),
                None => {
                    let ports = items.ports_of(items.instance(scope, id));
                    let (bundle, role) = ports.outputs[port as usize];
                    let is_stream = ports.bundles[bundle].is_stream;
                    Step::of_port(source(What::Instance(id)), Some(bundle), role, is_stream)
                }
            },
            _ => Step::Logic,
        }
    }
}

/// What lies behind a node.
enum Step {
    Source(Source),
    /// The same value in another scope.
    Through(Place),
    Logic,
}

impl Step {
    /// A source that is a port of the top or of an instance.
    fn of_port(source: Option<Source>, bundle: Option<usize>, role: Role, is_stream: bool) -> Step {
        let Some(source) = source else { return Step::Logic };
        let is_data = source.is_data && role == Role::Payload;
        Step::Source(Source {
            bundle,
            is_stream: is_stream && is_data,
            is_data,
            is_ready: role == Role::Ready,
            ..source
        })
    }
}

/// The operands of a node, each with whether it passes a value on. The others select.
fn operands(module: &Module, id: NodeId) -> Vec<(NodeId, bool)> {
    let op = &module.node(id).op;
    let chooses: Vec<NodeId> = match op {
        Op::Mux { select, .. } => vec![*select],
        Op::Select { arms, .. } => arms.iter().map(|(condition, _)| *condition).collect(),
        Op::Case { subject, .. } => vec![*subject],
        Op::Pick { index, .. } => vec![*index],
        _ => vec![],
    };
    let mut operands = Vec::new();
    op.for_each_operand(|operand| operands.push(operand));
    // An operand that selects and is selected appears as both.
    let mut left = chooses.clone();
    operands.retain(|operand| match left.iter().position(|it| it == operand) {
        Some(at) => {
            left.remove(at);
            false
        }
        None => true,
    });
    operands.into_iter().map(|operand| (operand, true)).chain(chooses.into_iter().map(|it| (it, false))).collect()
}
