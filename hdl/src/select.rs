//! Choices and concatenations: `mux`, `select`, `case`, `cat!`, literals.

use crate::bits::Bits;
use crate::bundle::Fields;
use crate::elaboration;
use crate::ir::{Kind, Op, Shape};
use crate::limits::sound_width;
use crate::loc::Loc;
use crate::operand::{Literal, Operand, Value};
use crate::problem::Problem;
use crate::shaping::{level, level_all};
use crate::signal::{Signal, bits_text};
use crate::uneven::{Uneven, uneven};
use crate::width::{IntoWidth, index_width};

/// A constant of that width: a number of bits, or what [`below`](crate::below) and [`up_to`](crate::up_to) give.
#[track_caller]
pub fn lit(width: impl IntoWidth, value: u64) -> Signal {
    constants(width.into_width().bits, [value])[0]
}

/// Constants of `width` bits; what is wrong with the width is one problem for all of them.
#[track_caller]
pub(crate) fn constants(width: u32, values: impl IntoIterator<Item = u64>) -> Vec<Signal> {
    let loc = Loc::caller();
    let sound = elaboration::with(|e| sound_width(e, &[], "a constant", width.into(), loc));
    // A loop, as a closure would be the caller that messages name.
    let mut signals = Vec::new();
    for value in values {
        let value = if sound == width { value } else { 0 };
        signals.push(Literal::Integer(value.into()).sized(sound, Kind::Number));
    }
    signals
}

/// The signals side by side, the first most significant. [`cat!`](crate::cat!) reads better.
#[track_caller]
pub fn concat(parts: &[Signal]) -> Signal {
    match parts {
        [] => panic!("a concatenation of nothing, at {}: give it at least one signal", Loc::caller()),
        [one] => *one,
        _ => {
            let loc = Loc::caller();
            let mut parts = parts.to_vec();
            let shape = level_all(&mut parts, "cat!");
            let ids: Vec<_> = parts.iter().map(|part| part.id_at(loc)).collect();
            let width: u64 = parts.iter().map(|part| u64::from(part.width)).sum();
            elaboration::with(|e| {
                let sound = sound_width(e, &ids, "a concatenation", width, loc);
                let op = if width == sound.into() { Op::Concat(ids) } else { Op::Const(Bits::zero(sound)) };
                Signal::make_in(e, op, sound, shape, loc)
            })
        }
    }
}

/// Signals side by side, the first most significant, as Verilog's `{a, b}`.
#[macro_export]
macro_rules! cat {
    ($($part:expr),+ $(,)?) => {
        $crate::concat(&[$($crate::Signal::from($part)),+])
    };
}

/// `let NAME = EXPRESSION;` that also names the net: `net!(at_end = count.eq(limit - 1));`
#[macro_export]
macro_rules! net {
    ($name:ident = $value:expr) => {
        let $name = $value.named(stringify!($name));
    };
}

/// A select must have one bit.
#[track_caller]
pub(crate) fn condition(signal: Signal, of: &str) -> Signal {
    let (loc, id) = (Loc::caller(), signal.id());
    if signal.width != 1 {
        elaboration::with(|e| {
            let draft = e.draft();
            let (text, place) = (draft.describe(id), draft.node(id).loc);
            let message = format!("the condition of `{of}` is 1 bit, but `{text}` has {}", bits_text(signal.width));
            let help = "compare it, as in `.ne(0)`, or take one `.bit(i)`";
            e.report_instead_of(&[id], Problem::new(loc, message).note(format!("`{text}` is made"), place).help(help));
            Signal::zero_in(e, 1, signal.shape, loc)
        })
    } else {
        signal
    }
}

/// The operands as signals of one width: that of the first that has one, signals before constants; a problem if there
/// are only integers.
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
            Signal::make_in(e, Op::Const(bits.resize(sound)), sound, Shape::Plain, loc)
        }),
        Value::Literal(code @ Literal::Code { names, .. }) => {
            code.clone().sized(index_width(names.codes.len() as u64), Kind::Code(*names))
        }
        Value::Literal(literal) => {
            elaboration::with(|e| {
                let message = format!("`{of}` has only integers to choose from, which leaves its width open");
                e.report(Problem::new(loc, message).help(format!("give one a width, as in `lit(8, {literal})`")));
            });
            return values.iter().map(|_| lit(1, 0)).collect();
        }
    };
    values[first] = Value::Signal(signal);
    // A loop, as a closure would be the caller that messages name.
    let mut signals = Vec::with_capacity(values.len());
    for value in values {
        signals.push(value.with_width_of(signal, of));
    }
    signals
}

/// `on_true` where `select` is 1, else `on_false`.
#[track_caller]
pub fn mux(select: impl Into<Signal>, on_true: impl Operand, on_false: impl Operand) -> Signal {
    let select = condition(select.into(), "mux");
    let values = sized(vec![on_true.operand(), on_false.operand()], "mux");
    let [select, on_true, on_false] = level([select, values[0], values[1]], "mux");
    let op = Op::Mux { select: select.id(), on_true: on_true.id(), on_false: on_false.id() };
    Signal::make(op, on_true.width, on_true.shape).kept_as(on_true.kind)
}

/// [`mux`] of each field of two bundles.
#[track_caller]
pub fn mux_bundle<B: Fields<Signal>>(select: impl Into<Signal>, on_true: &B, on_false: &B) -> B::With<Signal> {
    let (loc, select) = (Loc::caller(), select.into());
    let (leaves, mut others) = (on_true.leaves(), on_false.leaves());
    if let Some(uneven) = uneven(&others, &leaves) {
        let nodes: Vec<_> = leaves.iter().chain(&others).map(|(_, signal)| signal.id_at(loc)).collect();
        let Uneven { has, needs, .. } = uneven;
        let message = format!("`mux_bundle` chooses between lists{uneven} of {needs} and of {has}");
        let problem = Problem::new(loc, message).help("both bundles have lists of the same lengths");
        elaboration::with(|e| e.report_instead_of(&nodes, problem));
        others = leaves.clone();
    }
    let mut chosen = Vec::new();
    for ((_, on_true), (_, on_false)) in leaves.into_iter().zip(others) {
        chosen.push(mux(select, on_true, on_false));
    }
    let mut chosen = chosen.into_iter();
    on_true.map(|_| chosen.next().expect("a choice for each leaf"))
}

/// The value of the first arm whose condition holds, else `default`.
#[track_caller]
pub fn select<V: Operand>(arms: impl IntoIterator<Item = (Signal, V)>, default: impl Operand) -> Signal {
    let loc = Loc::caller();
    let (signals, values): (Vec<_>, Vec<_>) = arms.into_iter().unzip();
    let count = signals.len();
    let mut conditions = Vec::with_capacity(count);
    for signal in signals {
        conditions.push(condition(signal, "select"));
    }
    let values = values.into_iter().map(V::operand).chain([default.operand()]).collect();
    let mut values = sized(values, "select");
    let &Signal { width, kind, .. } = &values[0];
    values.extend(conditions);
    let shape = level_all(&mut values, "select");
    let mut nodes = values.into_iter().map(|value| value.id_at(loc));
    let values: Vec<_> = nodes.by_ref().take(count).collect();
    let default = nodes.next().expect("a select has a default");
    let arms = nodes.zip(values).collect();
    Signal::make(Op::Select { arms, default }, width, shape).kept_as(kind)
}

/// The value of the arm whose key equals `subject`, else `default`. Keys must differ.
#[track_caller]
pub fn case<V: Operand>(
    subject: impl Into<Signal>,
    arms: impl IntoIterator<Item = (u64, V)>,
    default: impl Operand,
) -> Signal {
    let (loc, subject) = (Loc::caller(), subject.into());
    let (keys, values): (Vec<_>, Vec<_>) = arms.into_iter().unzip();
    for (i, key) in keys.iter().enumerate() {
        let problem = if Bits::new(subject.width, *key) != *key {
            format!("the key {key} of `case` does not fit in {}", bits_text(subject.width))
        } else if keys[..i].contains(key) {
            format!("the key {key} of `case` stands twice")
        } else {
            continue;
        };
        elaboration::with(|e| e.report(Problem::new(loc, problem).help("each key is a value of the subject, once")));
    }
    let mut values = sized(values.into_iter().map(V::operand).chain([default.operand()]).collect(), "case");
    let &Signal { width, kind, .. } = &values[0];
    values.push(subject);
    let shape = level_all(&mut values, "case");
    let keys = keys.into_iter().map(|key| Bits::new(subject.width, key));
    let mut nodes = values.into_iter().map(|value| value.id_at(loc));
    let arms = keys.zip(nodes.by_ref()).collect();
    let [default, subject] = [nodes.next(), nodes.next()].map(|node| node.expect("a default and a subject"));
    Signal::make(Op::Case { subject, arms, default }, width, shape).kept_as(kind)
}
