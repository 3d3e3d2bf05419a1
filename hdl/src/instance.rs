//! Instances and instance arrays.

use crate::bits::Bits;
use crate::block::{Block, elaborate_module};
use crate::bundle::{Bundle, Fields};
use crate::clock::Clock;
use crate::elaboration::{self, Elaboration};
use crate::ir::{self, ClockId, Instance, InstanceId, ModuleId, NodeId, Op, Shape};
use crate::lanes::{Array, Lanes};
use crate::loc::Loc;
use crate::module::Module;
use crate::problem::Problem;
use crate::signal::{Signal, bits_text};
use crate::uneven::{Uneven, uneven};

impl Module {
    /// An instance of `block`. Its own clock is this handle's; its named clocks are this module's of the same names.
    #[track_caller]
    pub fn instance<B: Block>(self, name: &str, block: &B, inputs: B::In) -> B::Out {
        let loc = Loc::caller();
        let child = elaborate_module(block, loc);
        let drivers = inputs.leaves().into_iter().map(|(path, signal)| (path, signal.id_at(loc))).collect();
        let instance = self.declare(name, child.id, Shape::Plain, loc);
        self.feed(instance.id, child.id, drivers, loc);
        let mut outputs = instance.outputs.into_iter();
        let next = &mut |_: &str, _: &Signal| {
            let node = outputs.next().expect("as many outputs as the bundle has leaves");
            elaboration::with(|e| Signal::at(e, node))
        };
        B::Out::signals(&child.outputs::<B>().of(&mut |_, signal| *signal), next)
    }

    /// An array of `lanes` instances of `block`, kept as an array in the simulator, in Verilog and in waves. `feed`
    /// says what the inputs of every lane are; it may look at the array's outputs, which is how neighbours are linked.
    #[track_caller]
    pub fn array<B: Block>(
        self,
        name: &str,
        lanes: u32,
        block: &B,
        feed: impl FnOnce(Array<<B::Out as Bundle>::Of<Lanes>>) -> <B::In as Bundle>::Of<Lanes>,
    ) -> <B::Out as Bundle>::Of<Lanes>
    where
        <B::Out as Bundle>::Of<Lanes>: Clone,
    {
        let loc = Loc::caller();
        let child = elaborate_module(block, loc);
        if lanes == 0 {
            let problem = Problem::new(loc, format!("the array `{name}` has no lanes"));
            elaboration::with(|e| e.report(problem.help("an array has at least 1 lane")));
        }
        let lanes = lanes.max(1);
        let instance = self.declare(name, child.id, Shape::Row(lanes), loc);
        let mut outputs = instance.outputs.iter();
        let out = child.outputs::<B>().of(&mut |_, _| {
            let node = *outputs.next().expect("as many outputs as the bundle has leaves");
            elaboration::with(|e| {
                let (stamp, draft) = (e.stamp, e.draft());
                Lanes { stamp, module: draft.serial, node, width: draft.node(node).width, count: lanes }
            })
        });
        let fed = feed(Array { out: out.clone(), lanes });
        let drivers = fed.leaves().into_iter().map(|(path, lanes)| (path, lanes.id_at(loc))).collect();
        self.feed(instance.id, child.id, drivers, loc);
        out
    }

    /// Declares an instance whose inputs come later, with its output nodes.
    fn declare(self, name: &str, child: ModuleId, shape: Shape, loc: Loc) -> Declared {
        elaboration::with(|e| {
            let module = &e.done[child.0 as usize];
            let child_clocks = module.clocks.clone();
            let ports: Vec<_> = module.outputs.iter().map(|o| (o.name.clone(), module.width(o.node))).collect();
            let clocks = child_clocks.iter().map(|clock| self.bind(e, clock)).collect();
            let draft = e.draft();
            let id = InstanceId(draft.instances.len() as u32);
            let output = |(port, (_, width)): (usize, &(String, u32))| {
                draft.add(Op::Output(id, port as u32), *width, shape, loc)
            };
            let outputs: Vec<_> = ports.iter().enumerate().map(output).collect();
            let name = name.to_owned();
            let instance =
                Instance { name, module: child, shape, inputs: Vec::new(), outputs: outputs.clone(), clocks, loc };
            draft.instances.push(instance);
            draft.instance_outputs.push(ports.into_iter().map(|(name, _)| name).collect());
            Declared { id, outputs }
        })
    }

    /// The clock of this module that drives a clock of a child: this handle's for the child's own, otherwise the one of
    /// that name.
    fn bind(self, e: &mut Elaboration, clock: &ir::Clock) -> ClockId {
        let named = clock.name.zip(clock.period).map(|(name, period)| Clock { name, period });
        e.draft().use_clock(named.or(self.clock))
    }

    /// Says what drives the inputs of a declared instance: nodes, by their paths in its input bundle.
    fn feed(self, id: InstanceId, child: ModuleId, drivers: Vec<(String, NodeId)>, loc: Loc) {
        elaboration::with(|e| {
            let module = &e.done[child.0 as usize];
            let ports: Vec<_> =
                module.inputs.iter().map(|i| (i.path.clone(), Port::of(i.name.clone(), module.node(i.node)))).collect();
            let inputs = match uneven(&drivers, &ports) {
                None => ports.iter().zip(&drivers).map(|((_, port), (_, node))| fit(e, id, port, *node, loc)).collect(),
                Some(uneven) => {
                    report_uneven(e, id, &uneven, &ports, &drivers, loc);
                    ports.iter().map(|(_, port)| zero(e, id, port, loc)).collect()
                }
            };
            e.draft().instances[id.0 as usize].inputs = inputs;
        });
    }
}

/// A list in the input bundle of an instance is longer or shorter than the block's.
fn report_uneven(
    e: &mut Elaboration,
    id: InstanceId,
    uneven: &Uneven,
    ports: &[(String, Port)],
    drivers: &[(String, NodeId)],
    loc: Loc,
) {
    let instance = &e.draft().instances[id.0 as usize].name;
    let Uneven { has, needs, .. } = uneven;
    let message = format!("input{uneven} of `{instance}` is a list of {needs}, but is fed a list of {has}");
    let mut problem = Problem::new(loc, message);
    if let Some((_, port)) = ports.iter().find(|(path, _)| path.starts_with(&format!("{}.", uneven.list))) {
        problem = problem.note(format!("`{}` is declared", uneven.list), port.declared);
    }
    let nodes: Vec<_> = drivers.iter().map(|(_, node)| *node).collect();
    e.report_instead_of(&nodes, problem.help("feed as many as the block's `fn inputs` declares"));
}

/// An input port of a child.
struct Port {
    name: String,
    width: u32,
    declared: Loc,
}

impl Port {
    fn of(name: String, node: &ir::Node) -> Port {
        Port { name, width: node.width, declared: node.loc }
    }
}

/// The driver of a port, which must have the port's width and the instance's lanes; if not, that is reported, and a
/// zero stands in.
fn fit(e: &mut Elaboration, id: InstanceId, port: &Port, driver: NodeId, loc: Loc) -> NodeId {
    let draft = e.draft();
    let (instance, node) = (&draft.instances[id.0 as usize], draft.node(driver));
    let (name, text) = (&instance.name, draft.describe(driver));
    let (message, help) = if node.width != port.width {
        let (needs, has) = (bits_text(port.width), bits_text(node.width));
        let message = format!("input `{}` of `{name}` has {needs}, but `{text}` has {has}", port.name);
        (message, "spell the change of width where the instance is fed")
    } else if instance.shape != node.shape {
        let (needs, has) = (instance.shape.lanes(), node.shape.lanes());
        let message = format!("input `{}` of `{name}` has {needs} lanes, but `{text}` has {has}", port.name);
        (message, "an array is fed one value for each of its lanes: list them with `each`, as in `a.each(x.to_vec())`")
    } else {
        return driver;
    };
    let problem = Problem::new(loc, message)
        .note(format!("`{}` is declared", port.name), port.declared)
        .note(format!("`{text}` is made"), node.loc);
    e.report_instead_of(&[driver], problem.help(help));
    zero(e, id, port, loc)
}

/// A zero for a port, in every lane of an array.
fn zero(e: &mut Elaboration, id: InstanceId, port: &Port, loc: Loc) -> NodeId {
    let draft = e.draft();
    let shape = draft.instances[id.0 as usize].shape;
    let zero = draft.add(Op::Const(Bits::zero(port.width)), port.width, Shape::Plain, loc);
    if shape.is_plain() { zero } else { draft.add(Op::Broadcast { of: zero, axis: 0 }, port.width, shape, loc) }
}

/// An instance whose inputs are not known yet.
struct Declared {
    id: InstanceId,
    outputs: Vec<NodeId>,
}
