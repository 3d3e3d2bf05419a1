//! Instances and instance arrays.

use crate::block::Block;
use crate::bundle::Bundle;
use crate::clock::OwnClock;
use crate::elaborating::{Elaborated, elaborate_module};
use crate::elaboration::{self, Elaboration};
use crate::fields::Fields;
use crate::module::Module;
use crate::names::bits_text;
use crate::shaping::{IntoShape, sound_shape};
use crate::signal::Signal;
use crate::signed::READ_AS;
use crate::stream::{backwards, take};
use crate::uneven::{Uneven, uneven};
use tilewright_circuit::ir::{self, Instance, InstanceId, Kind, ModuleId, NodeId, Op, Shape};
use tilewright_circuit::{Loc, Mistake, Problem};

impl Module {
    /// Instantiates `block`. [`def!`](crate::def!) names the instance after the variable: `u_first`. Where the name is
    /// computed, it is the first argument: `m.instance(&format!("u_node{number}"), ..)`. The instance's own clock is this handle's; its named clocks are this module's clocks of
    /// the same names, or those [in their place](Module::in_place_of).
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// block! {
    ///     /// The sum of two numbers.
    ///     struct Adder { width: u32 }
    ///     in(self) AdderIn { a: bits(self.width), b: bits(self.width) }
    ///     out AdderOut { sum: _ }
    /// }
    ///
    /// impl Adder {
    ///     fn build(&self, _: Module, i: AdderIn) -> AdderOut {
    ///         AdderOut { sum: i.a.add_carry(i.b) }
    ///     }
    /// }
    ///
    /// def!(first = m.instance(&Adder { width: 8 }, AdderIn { a: lit(8, 200), b: lit(8, 100) }));
    /// def!(second = m.instance(&Adder { width: 9 }, AdderIn { a: first.sum, b: lit(9, 212) }));
    /// m.assert(second.sum.eq(512), "two modules, because the parameters differ");
    /// # });
    /// ```
    #[track_caller]
    pub fn instance<B: Block>(self, name: &str, block: &B, inputs: B::In) -> B::Out {
        let loc = Loc::caller();
        let child = elaborate_module(block, self.gated(), self.own_clock(), loc);
        let fed = Fed::of(&inputs, loc);
        let instance = self.declare(name, child.id, Shape::Plain, loc);
        let (out, answers) = self.read::<B>(&instance, &child, loc);
        self.feed(&instance, child.id, fed, answers, loc);
        out
    }

    /// Instantiates `block` as an array, which stays an array in the simulator, in Verilog and in waves. Its size is
    /// a number of lanes or a [`grid`](crate::grid). `feed` gets the array's outputs, with these lanes, and returns
    /// its inputs; this is how neighbours are connected. A plain signal feeds all lanes alike. If a port has lanes of
    /// its own, they come after those of the array: a row of blocks with a port of four lanes is fed a grid of four
    /// columns.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// block! {
    ///     /// A stage of a shift register.
    ///     struct Cell;
    ///     in CellIn { left: bits(4) }
    ///     out CellOut { held: bits(4) }
    /// }
    ///
    /// impl Cell {
    ///     fn build(&self, m: Module, i: CellIn) -> CellOut {
    ///         CellOut { held: m.pipe("held", i.left) }
    ///     }
    /// }
    ///
    /// def!(cell = m.array(3, &Cell, |cells| CellIn { left: cells.held.previous(7) }));
    /// def!(all = cell.held.pack());
    /// # });
    /// assert_eq!(example.values("u_cell[1].held"), [0, 0, 7, 7]);
    /// assert_eq!(example.values("all"), [0x000, 0x007, 0x077, 0x777]);
    /// ```
    #[track_caller]
    pub fn array<B: Block>(
        self,
        name: &str,
        shape: impl IntoShape,
        block: &B,
        feed: impl FnOnce(B::Out) -> B::In,
    ) -> B::Out
    where
        B::Out: Clone,
    {
        let (loc, shape) = (Loc::caller(), shape.into_shape());
        let child = elaborate_module(block, self.gated(), self.own_clock(), loc);
        let shape = elaboration::with(|e| sound_shape(e, format_args!("the array `{name}`"), shape, loc));
        let instance = self.declare(name, child.id, shape, loc);
        let (out, answers) = self.read::<B>(&instance, &child, loc);
        let fed = Fed::of(&feed(out.clone()), loc);
        self.feed(&instance, child.id, fed, answers, loc);
        out
    }

    /// Declares an instance before its inputs are known, with its output nodes.
    fn declare(self, name: &str, child: ModuleId, array: Shape, loc: Loc) -> Declared {
        elaboration::with(|e| {
            let module = &e.done[child.0 as usize];
            let child_clocks = module.clocks.clone();
            let faulty = &e.summaries[child.0 as usize].faulty;
            let port = |port: &ir::Output| {
                let of = Port::of(port.name.clone(), module.node(port.node), faulty.contains(&port.node));
                (port.name.clone(), Port { kind: port.kind, ..of })
            };
            let ports: Vec<_> = module.outputs.iter().map(port).collect();
            let shapes: Vec<_> = ports.iter().map(|(_, port)| beside(e, name, array, port, loc)).collect();
            let clocks = child_clocks.iter().map(|clock| self.bind(e, clock)).collect();
            self.check_own_periods(e, child, loc);
            let draft = e.draft();
            let id = InstanceId(draft.instances.len() as u32);
            let output = |(index, ((_, port), shape)): (usize, (&(String, Port), Shape))| {
                let node = draft.add(Op::Output(id, index as u32), port.width, shape, loc);
                draft.node_mut(node).kind = port.kind;
                if port.is_faulty || Some(shape) != array.beside(port.shape) {
                    draft.stand_ins.insert(node);
                }
                node
            };
            let outputs: Vec<_> = ports.iter().zip(shapes).enumerate().map(output).collect();
            // The `u_` that tells an instance stays in front.
            let prefixed = name.strip_prefix("u_").map(|rest| format!("u_{}", draft.prefixed(rest)));
            let name = prefixed.unwrap_or_else(|| draft.prefixed(name));
            let (shape, inputs) = (array, Vec::new());
            let instance = Instance { name, module: child, shape, inputs, outputs: outputs.clone(), clocks, loc };
            draft.instances.push(instance);
            draft.instance_parts.push(draft.part);
            draft.instance_outputs.push(ports.into_iter().map(|(name, _)| name).collect());
            Declared { id, outputs }
        })
    }

    /// How this handle's clock acts.
    fn own_clock(self) -> OwnClock {
        self.clock.map_or_else(|| elaboration::draft(|draft| draft.own), OwnClock::from)
    }

    /// Connects the inputs of a declared instance: nodes by their paths in its input bundle, and then the answers to
    /// its output streams.
    fn feed(self, instance: &Declared, child: ModuleId, fed: Fed, answers: Vec<NodeId>, loc: Loc) {
        let (id, Fed { drivers, streams }) = (instance.id, fed);
        let mut even = true;
        elaboration::with(|e| {
            let module = &e.done[child.0 as usize];
            // The last ones enable what is clocked, and get their drivers when this module is finished.
            let own = module.inputs.len() - answers.len() - e.enables[child.0 as usize].len();
            let faulty = &e.summaries[child.0 as usize].faulty;
            let port = |input: &ir::Input| {
                let is_faulty = faulty.contains(&input.node);
                (input.path.clone(), Port::of(input.name.clone(), module.node(input.node), is_faulty))
            };
            let ports: Vec<_> = module.inputs[..own].iter().map(port).collect();
            let mut inputs: Vec<_> = match uneven(&drivers, &ports) {
                None => {
                    ports.iter().zip(&drivers).map(|((_, port), (_, signal))| fit(e, id, port, *signal, loc)).collect()
                }
                Some(uneven) => {
                    even = false;
                    report_uneven(e, id, &uneven, &ports, &drivers, loc);
                    ports.iter().map(|(_, port)| zero(e, id, port, loc)).collect()
                }
            };
            inputs.extend(answers);
            e.draft().instances[id.0 as usize].inputs = inputs;
        });
        // The child's answers to its incoming streams are its last outputs.
        let first = instance.outputs.len().saturating_sub(streams.len());
        for (i, stream) in streams.into_iter().enumerate() {
            let ready = elaboration::with(|e| match even {
                true => Signal::at(e, instance.outputs[first + i]),
                false => Signal::zero_in(e, 1, stream.shape(), Kind::Number, loc),
            });
            take(stream, ready, loc);
        }
    }

    /// The outputs of an instance as the block's bundle, and the nodes that answer its output streams.
    fn read<B: Block>(self, instance: &Declared, child: &Elaborated, loc: Loc) -> (B::Out, Vec<NodeId>) {
        let bundle = child.outputs::<B>();
        let (mut outputs, mut directions) = (instance.outputs.iter(), backwards(bundle).into_iter());
        let mut answers = Vec::new();
        let next = &mut |path: &str, inner: &Signal| {
            if directions.next() == Some(true) {
                let ready = elaboration::with(|e| self.unanswered(e, instance.id, path, inner.shape(), loc));
                answers.push(ready.node);
                return ready;
            }
            let node = *outputs.next().expect("as many outputs as the bundle has leaves");
            elaboration::with(|e| Signal::at(e, node))
        };
        let out = B::Out::signals(&bundle.of(&mut |_, signal| *signal), next);
        (out, answers)
    }
}

/// The inputs of an instance.
struct Fed {
    /// The drivers, by their paths in its input bundle.
    drivers: Vec<(String, Signal)>,
    /// The `ready` of each stream that it takes.
    streams: Vec<Signal>,
}

impl Fed {
    fn of(inputs: &impl Fields<Signal>, loc: Loc) -> Fed {
        let mut fed = Fed { drivers: Vec::new(), streams: Vec::new() };
        for ((path, signal), back) in inputs.leaves().into_iter().zip(backwards(inputs)) {
            match back {
                true => fed.streams.push(signal),
                false => fed.drivers.push((path, signal.here(loc))),
            }
        }
        fed
    }
}

/// Reports a list in an instance's input bundle that is longer or shorter than the block's.
fn report_uneven(
    e: &mut Elaboration,
    id: InstanceId,
    uneven: &Uneven,
    ports: &[(String, Port)],
    drivers: &[(String, Signal)],
    loc: Loc,
) {
    let instance = &e.draft().instances[id.0 as usize].name;
    let Uneven { has, needs, .. } = uneven;
    let message = format!("input{uneven} of `{instance}` is a list of {needs}, but is fed a list of {has}");
    let mut problem = Problem::new(Mistake::ListLength, loc, message);
    if let Some((_, port)) = ports.iter().find(|(path, _)| path.starts_with(&format!("{}.", uneven.list))) {
        problem = problem.note(format!("`{}` is declared", uneven.list), port.declared);
    }
    let nodes: Vec<_> = drivers.iter().map(|(_, signal)| signal.node).collect();
    e.report_instead_of(&nodes, problem.help("feed as many as the block declares"));
}

/// An input port of a child.
struct Port {
    name: String,
    width: u32,
    shape: Shape,
    kind: Kind,
    /// Its declaration or its driver has a problem.
    is_faulty: bool,
    declared: Loc,
}

impl Port {
    fn of(name: String, node: &ir::Node, is_faulty: bool) -> Port {
        Port { name, width: node.width, shape: node.shape, kind: node.kind, is_faulty, declared: node.loc }
    }
}

/// The lanes of an array's port, seen from outside. More than two axes are a problem.
fn beside(e: &mut Elaboration, instance: &str, array: Shape, port: &Port, loc: Loc) -> Shape {
    array.beside(port.shape).unwrap_or_else(|| {
        let (name, of) = (&port.name, port.shape);
        let message = format!("port `{name}` of `{instance}`, of {of}, would have three axes in an array of {array}");
        let problem =
            Problem::new(Mistake::ThreeAxes, loc, message).note(format!("`{name}` is declared"), port.declared);
        e.report(problem.help("shapes have two axes at most: rows and columns"));
        array
    })
}

/// The driver of a port. It must have the port's width, and either be plain or have the instance's lanes followed by
/// the port's; otherwise that is reported and a zero stands in.
fn fit(e: &mut Elaboration, id: InstanceId, port: &Port, signal: Signal, loc: Loc) -> NodeId {
    let driver = signal.node;
    let draft = e.draft();
    if port.is_faulty {
        draft.in_problems.insert(driver);
        return zero(e, id, port, loc);
    }
    let (instance, node) = (&draft.instances[id.0 as usize], draft.node(driver));
    let (name, text) = (&instance.name, draft.describe(driver));
    let Some(shape) = instance.shape.beside(port.shape) else {
        let (name, array) = (name.clone(), instance.shape);
        draft.in_problems.insert(driver);
        beside(e, &name, array, port, loc);
        return zero(e, id, port, loc);
    };
    let (message, help) = if node.width != port.width {
        let (needs, has) = (bits_text(port.width), bits_text(node.width));
        let message = format!("input `{}` of `{name}` has {needs}, but `{text}` has {has}", port.name);
        (message, "make the change of width explicit where the instance is fed")
    } else if signal.kind != port.kind {
        let message = format!("input `{}` of `{name}` is {}, but `{text}` is {}", port.name, port.kind, signal.kind);
        (message, READ_AS)
    } else if shape == node.shape {
        return driver;
    } else if node.shape.is_plain() {
        return signal.spread_in(e, shape, loc).node;
    } else {
        let message = format!("input `{}` of `{name}` has {shape}, but `{text}` has {}", port.name, node.shape);
        (message, "feed a plain signal, the same for all lanes, or one lane for each; `stack` makes a row of signals")
    };
    let problem = Problem::new(Mistake::InputDiffers, loc, message)
        .note(format!("`{}` is declared", port.name), port.declared)
        .note(format!("`{text}` is made"), node.loc);
    e.report_instead_of(&[driver], problem.help(help));
    zero(e, id, port, loc)
}

/// A zero for a port, in every lane.
fn zero(e: &mut Elaboration, id: InstanceId, port: &Port, loc: Loc) -> NodeId {
    let instance = e.draft().instances[id.0 as usize].shape;
    Signal::zero_in(e, port.width, instance.beside(port.shape).unwrap_or(instance), port.kind, loc).node
}

/// An instance whose inputs are not known yet.
struct Declared {
    id: InstanceId,
    outputs: Vec<NodeId>,
}
