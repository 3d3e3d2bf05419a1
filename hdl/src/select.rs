//! Choices and concatenations: `mux`, `select`, `case`, `cat!`, literals.

use crate::data::{Data, Fits, Given};
use crate::elaboration;
use crate::fields::Fields;
use crate::integers::Integer;
use crate::limits::sound_width;
use crate::names::bits_text;
use crate::operand::{IntoSignal, Literal, Value};
use crate::record::from_leaves;
use crate::shaping::{level, level_all};
use crate::signal::Signal;
use crate::width::{IntoWidth, Width};
use std::collections::{HashMap, HashSet};
use tilewright_circuit::ir::{Kind, Names, NodeId, Op, Shape};
use tilewright_circuit::{Bits, Loc, Mistake, Problem, Radix};

/// A constant of this width: a number of bits, or the result of [`below`](crate::below) or [`up_to`](crate::up_to).
/// It is signed if the width is.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let byte = lit(8, 5);
/// let page = lit(below(12), 5);
/// m.assert(byte.eq(page.zext(8)), "12 pages are numbered by 4 bits");
/// m.assert(lit(bits(8).signed(), -5).lt(0), "a number below 0 needs a signed width");
/// // Beside a signal, a plain number is enough: it takes the width of the signal.
/// m.assert((byte + 1).eq(6), "no width is repeated");
/// # });
/// ```
#[track_caller]
pub fn lit(width: impl IntoWidth, value: impl Integer) -> Signal {
    constants(width.into_width(), [value.integer()])[0]
}

/// Constants of this width, which are signed if it is; an invalid width is one problem for all of them.
#[track_caller]
pub(crate) fn constants(width: Width, values: impl IntoIterator<Item = i128>) -> Vec<Signal> {
    let loc = Loc::caller();
    let sound = elaboration::with(|e| sound_width(e, &[], "a constant", width.bits.into(), loc));
    let kind = if width.kind == Kind::Signed { Kind::Signed } else { Kind::Number };
    // A loop: in a closure, the message would name the closure as the caller.
    let mut signals = Vec::new();
    for value in values {
        signals.push(match sound == width.bits {
            true => Literal::Integer(value, Radix::Any).sized(sound, kind),
            false => elaboration::with(|e| Signal::zero_in(e, sound, Shape::Plain, kind, loc)),
        });
    }
    signals
}

/// The concatenation of the signals, the first most significant. [`cat!`](crate::cat!) reads better.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let digits = [lit(4, 1), lit(4, 2), lit(4, 3)];
/// m.assert(concat(&digits).eq(0x123), "one part for each element of a list");
/// # });
/// ```
#[track_caller]
pub fn concat(parts: &[Signal]) -> Signal {
    match parts {
        [] => elaboration::mistake(
            Mistake::EmptyConcatenation,
            "a concatenation of nothing".to_owned(),
            "give it at least one signal",
        ),
        [one] => one.bits(),
        _ => {
            let loc = Loc::caller();
            let mut parts = parts.to_vec();
            let shape = level_all(&mut parts, "cat!");
            let ids: Vec<_> = parts.iter().map(|part| part.id_at(loc)).collect();
            let width: u64 = parts.iter().map(|part| u64::from(part.width)).sum();
            elaboration::with(|e| {
                let sound = sound_width(e, &ids, "a concatenation", width, loc);
                match width == sound.into() {
                    true => Signal::make_in(e, Op::Concat(ids), sound, shape, loc),
                    false => Signal::zero_in(e, sound, shape, Kind::Number, loc),
                }
            })
        }
    }
}

/// The concatenation of signals, the first most significant, as Verilog's `{a, b}`.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let (sign, exponent) = (lit(1, 1), lit(8, 0x7f));
/// m.assert(cat![sign, exponent, lit(23, 0)].eq(0xbf80_0000u32), "-1.0, in 32 bits");
/// # });
/// ```
#[macro_export]
macro_rules! cat {
    ($($part:expr),+ $(,)?) => {
        $crate::concat(&[$($crate::Signal::from($part)),+])
    };
}

/// The arms of [`select`] or [`case`], if some are signals and others numbers, registers or records of numbers.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let (a, b) = (lit(8, 40), lit(8, 2));
/// def!(op = m.reg(2).reset(0));
/// op.next(op + 1);
/// let result = case(op, arms![0 => 0, 1 => a + b, 2 => a - b], a);
/// m.assert(op.eq(1).implies(result.eq(42)), "an arm that is a signal");
/// m.assert(op.eq(0).implies(result.eq(0)), "an arm that is a number");
/// # });
/// ```
#[macro_export]
macro_rules! arms {
    ($($key:expr => $value:expr),* $(,)?) => {
        [$(($key, $crate::Fits::given($value))),*]
    };
}

/// The select signal, which must have one bit.
#[track_caller]
pub(crate) fn condition(signal: Signal, of: &str) -> Signal {
    let (loc, id) = (Loc::caller(), signal.id());
    if signal.width != 1 {
        elaboration::with(|e| {
            let draft = e.draft();
            let (text, place) = (draft.describe(id), draft.node(id).loc);
            let message = format!("the condition of `{of}` is 1 bit, but `{text}` has {}", bits_text(signal.width));
            let help = "compare it, as in `.ne(0)`, or take one `.bit(i)`";
            e.report_instead_of(
                &[id],
                Problem::new(Mistake::WideCondition, loc, message).note(format!("`{text}` is made"), place).help(help),
            );
            Signal::zero_in(e, 1, signal.shape, Kind::Number, loc)
        })
    } else {
        signal
    }
}

/// The operands as signals of one width: the width of the first signal, or else of the first constant with a width.
/// Integers alone are a problem.
#[track_caller]
fn sized(mut values: Vec<Value>, of: &str) -> Vec<Signal> {
    let loc = Loc::caller();
    let is_signal = |value: &Value| matches!(value, Value::Signal(_));
    let has_width = |value: &Value| matches!(value, Value::Literal(Literal::Exact(_) | Literal::Code { .. }));
    let first = values.iter().position(is_signal).or_else(|| values.iter().position(has_width)).unwrap_or(0);
    let signal = match &values[first] {
        Value::Signal(signal) => *signal,
        Value::Literal(Literal::Exact(bits)) => elaboration::with(|e| {
            let sound = sound_width(e, &[], "a constant", bits.width().into(), loc);
            match sound == bits.width() {
                true => Signal::make_in(e, Op::Const(bits.clone()), sound, Shape::Plain, loc),
                false => Signal::zero_in(e, sound, Shape::Plain, Kind::Number, loc),
            }
        }),
        Value::Literal(code @ Literal::Code { names, .. }) => code.clone().sized(names.width(), Kind::Code(*names)),
        open => {
            let (only, help) = match open {
                Value::Literal(literal) => ("integers", format!("give one a width, as in `lit(8, {literal})`")),
                _ => ("low bits", "give one a width, as in `.trunc(8)`".to_owned()),
            };
            let message = format!("`{of}` has only {only} to choose from, which leaves its width unknown");
            let low = |value: &Value| if let Value::Low(signal) = value { Some(signal.id_at(loc)) } else { None };
            let operands: Vec<NodeId> = values.iter().filter_map(low).collect();
            let zero = elaboration::with(|e| {
                e.report_instead_of(&operands, Problem::new(Mistake::UnknownWidth, loc, message).help(help));
                Signal::zero_in(e, 1, Shape::Plain, Kind::Number, loc)
            });
            return vec![zero; values.len()];
        }
    };
    values[first] = Value::Signal(signal);
    // A loop: in a closure, the message would name the closure as the caller.
    let mut signals = Vec::with_capacity(values.len());
    for value in values {
        signals.push(value.with_width_of(signal, of));
    }
    signals
}

/// `on_true` where `select` is 1, else `on_false`: signals, numbers or records. Records are chosen field by field.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let (a, b) = (lit(8, 7), lit(8, 9));
/// let larger = mux(a.lt(b), b, a);
/// m.assert(larger.eq(9), "a choice of signals");
/// m.assert(mux(larger.gt(8), 8, larger).eq(8), "a number takes the width of the other side");
/// # });
/// ```
#[track_caller]
pub fn mux<V: Data>(
    select: impl IntoSignal,
    on_true: impl Fits<V>, // Numbers alone have no width: write one as `lit(8, 0)`.
    on_false: impl Fits<V>,
) -> V {
    let select = condition(select.into(), "mux");
    let (shape, fields) = fields(vec![on_true.given(), on_false.given()], "mux");
    let mut chosen = Vec::with_capacity(fields.len());
    for values in fields {
        let values = sized(values, "mux");
        let [select, on_true, on_false] = level([select, values[0], values[1]], "mux");
        let op = Op::Mux { select: select.id(), on_true: on_true.id(), on_false: on_false.id() };
        chosen.push(Signal::make(op, on_true.width, on_true.shape).kept_as(on_true.kind));
    }
    from_leaves(&shape, chosen)
}

/// The value of the first arm whose condition is true, else `default`: signals, numbers or records. Records are
/// chosen field by field. If the arms mix signals and numbers, put them in [`arms!`](crate::arms!).
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// def!(level = m.reg(8).reset(0));
/// level.next(level + 25);
/// let warning = select([(level.gt(200), lit(2, 3)), (level.gt(100), lit(2, 1))], 0);
/// m.assert(level.gt(200).implies(warning.eq(3)), "above 200 both are true, and the first wins");
/// m.assert(level.le(100).implies(warning.eq(0)), "the default, where none is true");
/// # });
/// ```
#[track_caller]
pub fn select<V: Data, A: Fits<V>>(
    arms: impl IntoIterator<Item = (Signal, A)>,
    default: impl Fits<V>, // Numbers alone have no width: write one as `lit(8, 0)`.
) -> V {
    let loc = Loc::caller();
    let (signals, values): (Vec<_>, Vec<_>) = arms.into_iter().unzip();
    let count = signals.len();
    let mut conditions = Vec::with_capacity(count);
    for signal in signals {
        conditions.push(condition(signal, "select"));
    }
    let values = given(values, default);
    let (shape, fields) = fields(values, "select");
    let mut chosen = Vec::with_capacity(fields.len());
    for values in fields {
        let mut values = sized(values, "select");
        let Signal { width, kind, .. } = values[0];
        values.extend(&conditions);
        let lanes = level_all(&mut values, "select");
        let mut nodes = values.into_iter().map(|value| value.id_at(loc));
        let values: Vec<_> = nodes.by_ref().take(conditions.len()).collect();
        let default = nodes.next().expect("a select has a default");
        let arms = nodes.zip(values).collect();
        chosen.push(Signal::make(Op::Select { arms, default }, width, lanes).kept_as(kind));
    }
    from_leaves(&shape, chosen)
}

/// The value of the arm whose key equals `subject`, else `default`: signals, numbers or records. Records are chosen
/// field by field. A key is a value of the subject and may be negative if the subject is signed; no two keys are
/// equal. If the arms mix signals and numbers, put them in [`arms!`](crate::arms!).
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// def!(digit = m.reg(2).reset(0));
/// digit.next(digit + 1);
/// let square = case(digit, [(2, lit(4, 4)), (3, lit(4, 9))], digit.zext(4));
/// m.assert(square.eq(digit * *digit), "0 and 1 are their own squares");
/// # });
/// ```
#[track_caller]
pub fn case<V: Data, K: Integer, A: Fits<V>>(
    subject: impl IntoSignal,
    arms: impl IntoIterator<Item = (K, A)>,
    default: impl Fits<V>, // Numbers alone have no width: write one as `lit(8, 0)`.
) -> V {
    let (loc, subject) = (Loc::caller(), subject.into());
    let (numbers, values): (Vec<_>, Vec<_>) = arms.into_iter().unzip();
    let (mut keys, mut known) = (Vec::with_capacity(numbers.len()), HashSet::with_capacity(numbers.len()));
    for number in numbers {
        let (key, fits) = Literal::Integer(number.integer(), Radix::Any).bits(subject.width, subject.kind);
        let problem = if !fits {
            let message = format!("the key {number} of `case` does not fit in {}", bits_text(subject.width));
            Some((Mistake::ImpossibleKey, message))
        } else {
            (!known.insert(key.clone()))
                .then(|| (Mistake::RepeatedKey, format!("the key {number} of `case` occurs twice")))
        };
        keys.push(key);
        if let Some((mistake, message)) = problem {
            let (id, problem) = (subject.id_at(loc), Problem::new(mistake, loc, message));
            elaboration::with(|e| {
                e.report_instead_of(&[id], problem.help("each key is a value of the subject and occurs once"));
            });
        }
    }
    by_value(subject, &keys, given(values, default), "case")
}

/// One of `values` for each code of an enum, in the sequence of its codes.
#[track_caller]
pub(crate) fn by_code<V: Data>(subject: Signal, names: Names, values: Vec<Given<V>>) -> V {
    let keys: Vec<_> = names.values.iter().map(|code| Bits::new(subject.width, *code)).collect();
    by_value(subject, &keys, values, "choose")
}

/// A value for each key, and then a default. Without a default, the value that most keys share becomes the default.
#[track_caller]
fn by_value<V: Data>(subject: Signal, keys: &[Bits], values: Vec<Given<V>>, of: &str) -> V {
    let (loc, has_default) = (Loc::caller(), values.len() > keys.len());
    let (shape, fields) = fields(values, of);
    let mut chosen = Vec::with_capacity(fields.len());
    for values in fields {
        let mut values = sized(values, of);
        let Signal { width, kind, .. } = values[0];
        values.push(subject);
        let lanes = level_all(&mut values, of);
        let mut nodes: Vec<NodeId> = values.into_iter().map(|value| value.id_at(loc)).collect();
        let subject = nodes.pop().expect("the subject is the last");
        let op = if has_default {
            let default = nodes.pop().expect("the default is the last but one");
            Op::Case { subject, arms: keys.iter().cloned().zip(nodes).collect(), default }
        } else {
            let classes = classes(&nodes);
            let most = most_often(&classes);
            let (default, shared) = (nodes[most], classes[most]);
            let arms = keys.iter().cloned().zip(nodes).zip(classes);
            let arms: Vec<_> = arms.filter(|(_, class)| *class != shared).map(|(arm, _)| arm).collect();
            if arms.is_empty() {
                chosen.push(Signal { kind, ..elaboration::with(|e| Signal::at(e, default)) });
                continue;
            }
            Op::Case { subject, arms, default }
        };
        chosen.push(Signal::make(op, width, lanes).kept_as(kind));
    }
    from_leaves(&shape, chosen)
}

/// A number for each node, equal for equal nodes and equal constants.
fn classes(nodes: &[NodeId]) -> Vec<usize> {
    elaboration::draft(|draft| {
        let (mut constants, mut others) = (HashMap::new(), HashMap::new());
        let mut numbers = 0..;
        let mut new = || numbers.next().expect("endless");
        let class = |id: &NodeId| match &draft.node(*id).op {
            Op::Const(bits) => *constants.entry(bits).or_insert_with(&mut new),
            _ => *others.entry(*id).or_insert_with(&mut new),
        };
        nodes.iter().map(class).collect()
    })
}

/// The most frequent class; in a tie, that of the last.
fn most_often(classes: &[usize]) -> usize {
    let mut often = vec![0; classes.len()];
    classes.iter().for_each(|class| often[*class] += 1);
    (0..classes.len()).max_by_key(|at| often[classes[*at]]).expect("an enum has a code")
}

/// The values of the arms, and then that of the default.
#[track_caller]
fn given<V: Data>(arms: Vec<impl Fits<V>>, default: impl Fits<V>) -> Vec<Given<V>> {
    // A loop: in a closure, the message would name the closure as the caller.
    let mut given = Vec::with_capacity(arms.len() + 1);
    for arm in arms {
        given.push(arm.given());
    }
    given.push(default.given());
    given
}

/// For each field its value in each arm, and one arm that serves as the layout.
#[track_caller]
fn fields<V: Data>(arms: Vec<Given<V>>, of: &str) -> (V::Like<Value>, Vec<Vec<Value>>) {
    let shape = arms.iter().find_map(|arm| if let Given::Each(fields) = arm { Some(fields.clone()) } else { None });
    let Some(shape) = shape else {
        let message = format!("`{of}` has only numbers to choose a record from");
        elaboration::mistake(Mistake::NumberForRecord, message, "write one of them as a record");
    };
    let paths = shape.leaves();
    let mut fields = vec![Vec::with_capacity(arms.len()); paths.len()];
    for arm in arms {
        for (field, value) in fields.iter_mut().zip(arm.for_fields(&paths, of)) {
            field.push(value);
        }
    }
    (shape, fields)
}
