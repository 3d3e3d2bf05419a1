//! An operation in a line.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Affine, Binary, Reduction, Relation, Shift, Unary};

use crate::engine::program::{Axis, Kind, Lowered, ValueId};

/// The operation of a value; `name` names values, `memory` memories.
pub(crate) fn operation(
    kind: &Kind,
    width: u32,
    name: &dyn Fn(ValueId) -> String,
    memory: &dyn Fn(u32) -> String,
) -> String {
    let list = |ids: &[ValueId]| ids.iter().map(|id| name(*id)).collect::<Vec<_>>().join(", ");
    match kind {
        Kind::State => "state".to_owned(),
        Kind::Const(bits) => constant(bits),
        Kind::Alias(of) => name(*of),
        Kind::Unary(op, a) => format!("{} {}", unary(*op), name(*a)),
        Kind::Binary(op, a, b) => format!("{} {} {}", name(*a), binary(*op), name(*b)),
        Kind::Compare(relation, signed, a, b) => {
            format!("{} {}{} {}", name(*a), symbol(*relation), if *signed { " signed" } else { "" }, name(*b))
        }
        Kind::Shift(op, a, by) => format!("{} {} {}", name(*a), shift(*op), name(*by)),
        Kind::Mux { select, on_true, on_false } => {
            format!("{} ? {} : {}", name(*select), name(*on_true), name(*on_false))
        }
        Kind::Select { arms, default } => {
            let arms = arms.iter().map(|(when, value)| format!("{} ? {} : ", name(*when), name(*value)));
            arms.chain([name(*default)]).collect()
        }
        Kind::Case { subject, arms, default } => {
            let arms = arms.iter().map(|(key, value)| format!("{}: {}, ", constant(key), name(*value)));
            format!("case {} {{ {}else {} }}", name(*subject), arms.collect::<String>(), name(*default))
        }
        Kind::Slice(of, low) if width == 1 => format!("{}[{low}]", name(*of)),
        Kind::Slice(of, low) => format!("{}[{}:{low}]", name(*of), low + width - 1),
        Kind::Concat(parts) => format!("{{{}}}", list(parts)),
        Kind::Repeat(of, times) => format!("{{{times} times {}}}", name(*of)),
        Kind::Extend(of, signed) => format!("{} {}", if *signed { "sext" } else { "zext" }, name(*of)),
        Kind::Lowered(Lowered::Assemble { of, pieces }) => format!("{} pieces of {}", pieces.len(), list(of)),
        Kind::Lowered(Lowered::Rotate { of, left }) => format!("{} rotated left by {left}", name(*of)),
        Kind::Read { memory: of, address } => format!("{}[{}]", memory(*of), name(*address)),
        Kind::Lowered(Lowered::Word { memory: of, address }) => {
            format!("{}[{}] as stored", memory(*of), name(*address))
        }
        Kind::Lowered(Lowered::WordOf { memory: of, address, at }) => {
            format!("lane {} of {}[{}] as stored", name(*at), memory(*of), name(*address))
        }
        Kind::Broadcast { of, axis } => format!("{} times {}{}", axis.count, name(*of), apart(*axis)),
        Kind::Stack { parts, inner: 1 } => format!("lanes {}", runs(parts, name)),
        Kind::Stack { parts, inner } => format!("groups of {inner} lanes {}", runs(parts, name)),
        Kind::Map { of, axis, count, index, edge } => {
            let edge = edge.map(|edge| format!(" else {}", name(edge))).unwrap_or_default();
            format!(
                "lane {} of {} of {}{edge}, for i to {}{}",
                affine(*index),
                axis.count,
                name(*of),
                count - 1,
                apart(*axis)
            )
        }
        Kind::Interleave { parts, axis } => format!("interleaved lanes of {}{}", list(parts), apart(*axis)),
        Kind::Lane { of, axis, index } => format!("lane {index} of {} of {}{}", axis.count, name(*of), apart(*axis)),
        Kind::Pick { of, axis, index } => {
            format!("lane {} of {} of {}{}", name(*index), axis.count, name(*of), apart(*axis))
        }
        Kind::Reduce { by, of, axis } => {
            format!("{} of {} lanes of {}{}", reduction(*by), axis.count, name(*of), apart(*axis))
        }
        Kind::Pack { of, axis } => format!("{} lanes of {} side by side{}", axis.count, name(*of), apart(*axis)),
        Kind::Unpack { of, axis } => format!("{} parts of {}{}", axis.count, name(*of), apart(*axis)),
        Kind::Lowered(Lowered::Gather { of, at }) => format!("lane {} of {}", name(*at), name(*of)),
        Kind::Lowered(Lowered::Slide { of, by }) => {
            format!("lane i {} {} of {}", if *by < 0 { '+' } else { '-' }, by.abs(), name(*of))
        }
    }
}

/// A value as Verilog writes it, in decimal where it is small.
pub(super) fn constant(bits: &Bits) -> String {
    match bits.to_u64() {
        Some(number) if number < 10 => number.to_string(),
        _ => format!("{bits:?}"),
    }
}

/// Parts, with successive slices of one value joined.
fn runs(parts: &[ValueId], name: &dyn Fn(ValueId) -> String) -> String {
    let runs = parts.chunk_by(|a, b| name(*a) == name(*b)).map(|run| match run.len() {
        1 => name(run[0]),
        times => format!("{times} times {}", name(run[0])),
    });
    runs.collect::<Vec<_>>().join(", ")
}

/// The distance of lanes along an axis, unless they are adjacent.
fn apart(axis: Axis) -> String {
    if axis.inner == 1 { String::new() } else { format!(", {} lanes apart", axis.inner) }
}

fn affine(index: Affine) -> String {
    let Affine { mul, add, div } = index;
    let mut text = match mul {
        1 => "i".to_owned(),
        -1 => "-i".to_owned(),
        mul => format!("{mul} i"),
    };
    if add != 0 {
        text = format!("{text} {} {}", if add < 0 { '-' } else { '+' }, add.unsigned_abs());
    }
    if div > 1 { format!("({text}) / {div}") } else { text }
}

fn unary(op: Unary) -> &'static str {
    match op {
        Unary::Not => "not",
        Unary::AllOnes => "all ones of",
        Unary::AnyOne => "any one of",
        Unary::Parity => "parity of",
    }
}

fn binary(op: Binary) -> &'static str {
    match op {
        Binary::MulSigned => "* signed",
        op => op.symbol(),
    }
}

fn symbol(relation: Relation) -> &'static str {
    match relation {
        Relation::Eq => "==",
        Relation::Ne => "!=",
        Relation::Lt => "<",
        Relation::Le => "<=",
        Relation::Gt => ">",
        Relation::Ge => ">=",
    }
}

fn shift(op: Shift) -> &'static str {
    match op {
        Shift::Left => "<<",
        Shift::Right => ">>",
        Shift::RightSigned => ">>>",
    }
}

fn reduction(by: Reduction) -> &'static str {
    match by {
        Reduction::And => "and",
        Reduction::Or => "or",
        Reduction::Xor => "xor",
        Reduction::Add => "sum",
        Reduction::Min => "least",
        Reduction::Max => "greatest",
    }
}
