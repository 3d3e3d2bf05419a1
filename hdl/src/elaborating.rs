//! Elaboration: from a block to the checked circuits of its modules.

use crate::block::Block;
use crate::bundle::Bundle;
use crate::check::{self, foreign};
use crate::clock::OwnClock;
use crate::draft::Draft;
use crate::elaboration;
use crate::enabled;
use crate::fields::Fields;
use crate::finish;
use crate::in_place_of;
use crate::limits::{DEEPEST, check_period};
use crate::module::{Module, declare};
use crate::names;
use crate::names::port_name;
use crate::shaping::sound_shape;
use crate::signal::Signal;
use crate::stream::{Origin, backwards, leave, untaken};
use crate::width::Width;
use std::any::Any;
use std::rc::Rc;
use tilewright_circuit::ir::{Design, Input, ModuleId, Op};
use tilewright_circuit::{DefaultClock, Loc, Mistake, Period, Problem, Problems};

/// The period of the default clock of [`elaborate`].
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!(DEFAULT_PERIOD.to_string(), "10 ns");
/// ```
pub const DEFAULT_PERIOD: Period = Period::ns(10);

/// Builds the circuit of `block` and checks it. The default clock has a period of [`DEFAULT_PERIOD`].
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     struct Sum;
///     in SumIn { a: bits(8), b: bits(7) }
///     out SumOut { sum: bits(8) }
/// }
///
/// impl Sum {
///     fn build(&self, _: Module, i: SumIn) -> SumOut {
///         SumOut { sum: i.a + i.b }
///     }
/// }
///
/// let problems = elaborate(&Sum).unwrap_err();
/// assert_eq!(problems.0[0].message, "`+` needs equal widths: `a` has 8 bits, `b` has 7 bits");
/// ```
///
/// # Errors
///
/// Every mistake found in the description, each with its places in the user's source.
#[track_caller]
pub fn elaborate<B: Block>(block: &B) -> Result<Design, Problems> {
    elaborate_at(block, DEFAULT_PERIOD)
}

/// Like [`elaborate`], with another period of the default clock, or with another [`DefaultClock`].
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Toggle;
/// #     out ToggleOut { high: bit() }
/// # }
/// # impl Toggle {
/// #     fn build(&self, m: Module, _: ()) -> ToggleOut {
/// #         def!(high = m.reg(1).reset(0));
/// #         high.next(!high);
/// #         ToggleOut { high: *high }
/// #     }
/// # }
/// let design = elaborate_at(&Toggle, Period::ns(4))?;
/// assert_eq!(design.top().clocks[0].period, Some(Period::ns(4)));
/// # Ok::<(), Problems>(())
/// ```
#[track_caller]
pub fn elaborate_at<B: Block>(block: &B, clock: impl Into<DefaultClock>) -> Result<Design, Problems> {
    elaborate_typed(block, clock).map(|(design, ..)| design)
}

/// The elaborated circuit, and the port numbers as bundles: the design's inputs count from 0, its outputs follow.
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Sum;
/// #     in SumIn { a: bits(8), b: bits(8) }
/// #     out SumOut { sum: bits(8) }
/// # }
/// # impl Sum {
/// #     fn build(&self, _: Module, i: SumIn) -> SumOut {
/// #         SumOut { sum: i.a + i.b }
/// #     }
/// # }
/// let typed: Typed<Sum> = elaborate_typed(&Sum, DEFAULT_PERIOD)?;
/// let (_, _, SumOut { sum }) = typed;
/// assert_eq!(sum, 2); // after the two inputs
/// # Ok::<(), Problems>(())
/// ```
pub type Typed<B> = (Design, <<B as Block>::In as Bundle>::Of<usize>, <<B as Block>::Out as Bundle>::Of<usize>);

/// Like [`elaborate_at`], with the ports as bundles, as a typed testbench needs them.
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Sum;
/// #     in SumIn { a: bits(8), b: bits(8) }
/// #     out SumOut { sum: bits(8) }
/// # }
/// # impl Sum {
/// #     fn build(&self, _: Module, i: SumIn) -> SumOut {
/// #         SumOut { sum: i.a + i.b }
/// #     }
/// # }
/// let (design, i, o) = elaborate_typed(&Sum, DEFAULT_PERIOD)?;
/// assert_eq!((i.a, i.b, o.sum), (0, 1, 2));
/// assert_eq!(design.top().inputs[i.b].name, "b");
/// # Ok::<(), Problems>(())
/// ```
#[track_caller]
pub fn elaborate_typed<B: Block>(block: &B, clock: impl Into<DefaultClock>) -> Result<Typed<B>, Problems> {
    let (loc, clock) = (Loc::caller(), clock.into());
    let clock = elaboration::given_reset().map_or(clock, |reset| clock.reset(reset));
    let (own, period) = (OwnClock::from(clock), clock.period);
    let mut ports = None;
    let ended = elaboration::run(own, || {
        elaboration::with(|e| check_period(e, "the default clock", period, loc));
        let child = elaborate_module(block, Vec::new(), own, loc);
        ports = Some(port_numbers(block, &child));
        elaboration::with(|e| {
            in_place_of::check_default(e, clock);
            names::check_module_names(e);
        });
    })?;
    let mut modules = ended.done;
    let top = modules.last_mut().expect("the top was elaborated");
    top.clocks.iter_mut().filter(|clock| clock.period.is_none()).for_each(|clock| clock.period = Some(period));
    let (inputs, outputs) = ports.expect("the description ran");
    Ok((Design::new(modules)?, inputs, outputs))
}

/// The ports of a block as its bundles. A module's inputs are those of its input bundle, then the backward leaves of
/// its output bundle. Its outputs are those of its output bundle, then the backward leaves of its input bundle.
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
    /// The output bundle, made of the child's own signals: only its shape is of use.
    pub fn outputs<B: Block>(&self) -> &B::Out {
        self.outputs.downcast_ref().expect("the shape was stored under its block's type")
    }
}

/// The module of `block` on a clock that acts in this way, whose instance is in an enabled part on these clocks: the existing
/// one for the same type and parameters, or a new one.
pub(crate) fn elaborate_module<B: Block>(
    block: &B,
    gated: Vec<Option<&'static str>>,
    own: OwnClock,
    loc: Loc,
) -> Elaborated {
    if let Some(known) = known(block, &gated, own) {
        return known;
    }
    if let Err(problem) = block.check() {
        elaboration::stop(Problem::new(Mistake::ParameterOutOfRange, loc, problem.to_string()));
    }
    let parameters = format!("{block:?}");
    let name = names::short(std::any::type_name::<B>());
    if let Some(problem) = elaboration::with(|e| nested_too_deep(&e.drafts, name, &parameters, loc)) {
        elaboration::stop(problem);
    }
    elaboration::with(|e| {
        e.drafts_begun += 1;
        let serial = e.drafts_begun;
        let declared = block.declared();
        e.drafts.push(Draft {
            declared,
            is_pad: block.is_pad(),
            port_names: block.port_names(),
            gated: gated.clone(),
            by_power_on: e.by_power_on.clone(),
            ..Draft::new(serial, name, own, loc)
        });
        foreign::begin(e, block.foreign());
    });
    let (before, again) = elaboration::with(|e| (e.problems.len(), e.known.has(block)));
    let (out, outputs) = describe(block, loc);
    let used = elaboration::with(|e| enabled::declare_inputs(e, &outputs));
    // Where nothing runs on a clock, its enable makes no other module.
    let elaborated = known(block, &used, own).inspect(|_| elaboration::with(|e| drop(e.drafts.pop())));
    let elaborated = elaborated.unwrap_or_else(|| {
        elaboration::with(|e| {
            let (mut about, name) = (block.about(), enabled::module_name(block.name(), &used));
            enabled::document(e.draft(), &mut about);
            finish::finish(e, outputs, name, about, parameters);
            let id = ModuleId(e.done.len() as u32 - 1);
            let outputs: Rc<dyn Any> = Rc::new(out);
            e.shapes.push(outputs.clone());
            Elaborated { id, outputs }
        })
    });
    elaboration::with(|e| {
        let needs = e.depends_on[elaborated.id.0 as usize].of(own);
        e.known.insert(block.clone(), used, needs, elaborated.id);
        e.known.insert(block.clone(), gated, needs, elaborated.id);
        if again {
            e.forget_repeated(before);
        }
    });
    elaborated
}

fn known<B: Block>(block: &B, gated: &[Option<&'static str>], own: OwnClock) -> Option<Elaborated> {
    elaboration::with(|e| {
        let id = e.known.get(block, gated, own)?;
        Some(Elaborated { id, outputs: e.shapes[id.0 as usize].clone() })
    })
}

/// Runs the block's `build` in the innermost draft: its output bundle, and the outputs by their paths.
fn describe<B: Block>(block: &B, loc: Loc) -> (B::Out, Vec<(String, Signal)>) {
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
    (out, outputs)
}

/// The problem of instances that nest without end, if they do.
fn nested_too_deep(drafts: &[Draft], name: &str, parameters: &str, loc: Loc) -> Option<Problem> {
    if drafts.len() < DEEPEST {
        return None;
    }
    let problem =
        Problem::new(Mistake::EndlessNesting, loc, format!("`{parameters}` is nested more than {DEEPEST} deep"));
    let outermost = drafts.iter().find(|draft| draft.block == name).or(drafts.first());
    let problem = match outermost {
        Some(draft) => problem.note(format!("the outermost `{}` is instantiated", draft.block), draft.loc),
        None => problem,
    };
    Some(problem.help("if it instantiates itself, a parameter must become smaller each time, and end the recursion"))
}

/// Declares the `ready` with which this module answers an incoming stream.
fn declare_ready(path: &str, width: Width) -> Signal {
    let stream = path.strip_suffix(".ready").unwrap_or(path);
    elaboration::with(|e| {
        let shape = sound_shape(e, format_args!("input `{}`", port_name("", path)), width.shape, width.loc);
        untaken(e, Origin::Input(stream.to_owned()), shape, width.clock, width.loc)
    })
}

fn declare_input(path: &str, width: Width) -> Signal {
    elaboration::with(|e| {
        let name = e.draft().port(path);
        width.clock.into_iter().for_each(|clock| e.meet_clock(clock, width.loc));
        let index = e.draft().inputs.len() as u32;
        let node = declare(e, Op::Input(index), ("input", &name), width, width.loc);
        let draft = e.draft();
        draft.inputs.push(Input { name, path: path.to_owned(), node, clock: None });
        draft.input_clocks.push(width.clock);
        Signal::at(e, node)
    })
}
