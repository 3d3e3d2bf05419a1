//! Blocks: parameters in a plain struct, and a function from an input bundle to an output bundle.

use crate::bundle::{Bundle, Fields};
use crate::check;
use crate::clock::Period;
use crate::draft::Draft;
use crate::elaboration;
use crate::finish;
use crate::ir::{About, Design, Input, ModuleId, Op};
use crate::limits::DEEPEST;
use crate::loc::Loc;
use crate::module::{Module, declare, port_name};
use crate::module_name::module_name;
use crate::names;
use crate::problem::Problems;
use crate::shaping::sound_shape;
use crate::signal::Signal;
use crate::stream::{Origin, backwards, leave, untaken};
use crate::width::Width;
use std::any::Any;
use std::fmt::Debug;
use std::hash::Hash;
use std::rc::Rc;

/// A hardware block: the struct holds its parameters, [`build`](Block::build) describes it. Instances of one type with
/// equal parameters are one module; what `Debug` prints of them goes into its name and into messages.
///
/// [`block!`](crate::block!) makes all of it but `build` of one declaration. Without it,
/// write `#[derive(Debug, Clone, PartialEq, Eq, Hash)]` before the struct. Floating-point parameters have no `Eq`: state
/// them as integers.
pub trait Block: Debug + Clone + Eq + Hash + 'static {
    /// The input bundle.
    type In: Bundle;
    /// The output bundle; its widths follow from the description, and can be stated in [`outputs`](Block::outputs).
    type Out: Bundle;

    /// The widths of the inputs.
    fn inputs(&self) -> <Self::In as Bundle>::Of<Width>;

    /// Describes the block.
    fn build(&self, m: Module, i: Self::In) -> Self::Out;

    /// The widths that its outputs are to have, each with the port's path; those that are not said follow from the description.
    fn outputs(&self) -> Vec<(String, Width)> {
        Vec::new()
    }

    /// What the block is, for people: the header of its Verilog and its documentation.
    fn about(&self) -> About {
        About::default()
    }

    /// The name of its module in Verilog: by default the type's name in snake case with its type arguments and parameters behind
    /// it, as `counter_width8`. Blocks that differ have names that differ, and where they would not that is a problem.
    fn name(&self) -> String {
        module_name(std::any::type_name::<Self>(), &format!("{self:?}"))
    }
}

/// The period of the default clock of [`elaborate`].
pub const DEFAULT_PERIOD: Period = Period::ns(10);

/// Builds the circuit of `block` and checks it. The default clock has a period of [`DEFAULT_PERIOD`].
///
/// # Errors
///
/// Every mistake found in the description, each with the places in the user's source.
#[track_caller]
pub fn elaborate<B: Block>(block: &B) -> Result<Design, Problems> {
    elaborate_at(block, DEFAULT_PERIOD)
}

/// As [`elaborate`], with another period of the default clock.
#[track_caller]
pub fn elaborate_at<B: Block>(block: &B, period: Period) -> Result<Design, Problems> {
    elaborate_typed(block, period).map(|(design, ..)| design)
}

/// The circuit, and its ports as bundles of their numbers: the design's inputs from 0, then its outputs.
pub type Typed<B> = (Design, <<B as Block>::In as Bundle>::Of<usize>, <<B as Block>::Out as Bundle>::Of<usize>);

/// As [`elaborate_at`], with the ports as bundles: what a typed testbench needs.
#[track_caller]
pub fn elaborate_typed<B: Block>(block: &B, period: Period) -> Result<Typed<B>, Problems> {
    let loc = Loc::caller();
    let mut ports = None;
    let ended = elaboration::run(|| {
        let child = elaborate_module(block, loc);
        ports = Some(port_numbers(block, &child));
        elaboration::with(names::check_module_names);
    })?;
    let mut modules = ended.done;
    let top = modules.last_mut().expect("the top was elaborated");
    top.clocks.iter_mut().filter(|clock| clock.period.is_none()).for_each(|clock| clock.period = Some(period));
    let (inputs, outputs) = ports.expect("the description ran");
    Ok((Design::new(modules)?, inputs, outputs))
}

/// The ports of a block as its bundles. A module has the inputs of its input bundle first, then those of its output bundle, and
/// its outputs the other way round.
fn port_numbers<B: Block>(
    block: &B,
    child: &Elaborated,
) -> (<B::In as Bundle>::Of<usize>, <B::Out as Bundle>::Of<usize>) {
    let (widths, outputs) = (block.inputs(), child.outputs::<B>());
    let (from, to) = (backwards(&widths), backwards(outputs));
    let count = |directions: &[bool], back| directions.iter().filter(|direction| **direction == back).count();
    let sent_back = count(&from, false);
    let sent = sent_back + count(&to, true);
    let number =
        |directions: Vec<bool>, mut forward: std::ops::RangeFrom<usize>, mut back: std::ops::RangeFrom<usize>| {
            let mut directions = directions.into_iter();
            move || if directions.next() == Some(true) { back.next() } else { forward.next() }.expect("endless")
        };
    let mut input = number(from, 0.., sent + count(&to, false)..);
    let mut output = number(to, sent.., sent_back..);
    (B::In::convert(&widths, &mut |_, _: &Width| input()), outputs.of(&mut |_, _| output()))
}

/// A module that has been elaborated, with the output bundle that its `build` returned.
pub(crate) struct Elaborated {
    pub id: ModuleId,
    outputs: Rc<dyn Any>,
}

impl Elaborated {
    /// The output bundle, in the child's own signals: good for its shape.
    pub fn outputs<B: Block>(&self) -> &B::Out {
        self.outputs.downcast_ref().expect("the shape was stored under its block's type")
    }
}

/// The module of `block`: the one made before for the same type and parameters, or a new one.
pub(crate) fn elaborate_module<B: Block>(block: &B, loc: Loc) -> Elaborated {
    let cached = elaboration::with(|e| e.known.get(block).map(|id| (id, e.shapes[id.0 as usize].clone())));
    if let Some((id, outputs)) = cached {
        return Elaborated { id, outputs };
    }
    let parameters = format!("{block:?}");
    elaboration::with(|e| {
        assert!(
            e.drafts.len() < DEEPEST,
            "`{parameters}`, at {loc}, is nested more than {DEEPEST} deep: does it instantiate itself?"
        );
        e.drafts_begun += 1;
        let serial = e.drafts_begun;
        e.drafts.push(Draft::new(serial, names::short(std::any::type_name::<B>()), loc));
    });
    let widths = block.inputs();
    let (mut directions, mut answers) = (backwards(&widths).into_iter(), Vec::new());
    let inputs = B::In::signals(&widths, &mut |path, width| {
        if directions.next() != Some(true) {
            return declare_input(path, *width);
        }
        let ready = declare_ready(path, *width);
        answers.push((path.to_owned(), ready));
        ready
    });
    let out = block.build(Module { clock: None }, inputs);
    let mut outputs = Vec::new();
    for ((path, signal), back) in out.leaves().into_iter().zip(backwards(&out)) {
        match back {
            false => outputs.push((path, signal.here(loc))),
            true => leave(&path, signal, loc),
        }
    }
    let widths = block.outputs();
    elaboration::with(|e| check::outputs::check(e, &outputs, &widths));
    outputs.extend(answers);
    elaboration::with(|e| {
        finish::finish(e, outputs, block.name(), block.about(), parameters);
        let id = ModuleId(e.done.len() as u32 - 1);
        e.known.insert(block.clone(), id);
        let outputs: Rc<dyn Any> = Rc::new(out);
        e.shapes.push(outputs.clone());
        Elaborated { id, outputs }
    })
}

/// What says that this module takes from the stream that comes in.
fn declare_ready(path: &str, width: Width) -> Signal {
    let stream = path.strip_suffix(".ready").unwrap_or(path);
    elaboration::with(|e| {
        let shape = sound_shape(e, &format!("input `{}`", port_name("", path)), width.shape, width.loc);
        untaken(e, Origin::Input(port_name("", stream)), shape, width.clock, width.loc)
    })
}

fn declare_input(path: &str, width: Width) -> Signal {
    elaboration::with(|e| {
        let name = port_name("", path);
        width.clock.into_iter().for_each(|clock| e.meet_clock(clock, width.loc));
        let index = e.draft().inputs.len() as u32;
        let node = declare(e, Op::Input(index), ("input", &name), width, width.loc);
        let draft = e.draft();
        draft.inputs.push(Input { name, path: path.to_owned(), node, clock: None });
        draft.input_clocks.push(width.clock);
        Signal::at(e, node)
    })
}
