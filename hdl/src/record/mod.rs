//! Records of signals, made by [`bundle!`](crate::bundle!) and [`record!`](crate::record!), as values: packed into
//! words, named, laid out in lanes, and stored in registers, wires and memories.

mod along;
mod declaration;
mod lanes;
mod memory;
mod register;
mod wire;
mod zero;

pub use declaration::{Record, rules};
pub use lanes::Lanes;
pub use register::RecordUpdates;
use tilewright_circuit::{Loc, Mistake, Problem};
pub use zero::{Numbers, Zero};

use crate::bundle::Bundle;
use crate::data::Data;
use crate::elaboration;
use crate::fields::{Fields, Leaf};
use crate::limits::{WIDEST, sound_width};
use crate::names::{bits_text, is_legal, port_name, short};
use crate::select::{concat, lit};
use crate::signal::Signal;
use crate::width::{Width, bits};
use std::any::type_name;
use tilewright_circuit::ir::{self, Field, Kind, NodeId, Op, Shape};

#[doc(hidden)]
#[track_caller]
pub fn pack<B: Bundle>(record: &B) -> Signal {
    let fields = record.leaves();
    note_record::<B>(fields.iter().map(|(path, signal)| (path, signal.width, signal.kind)));
    let fields: Vec<Signal> = fields.into_iter().map(|(_, signal)| signal).collect();
    concat(&fields)
}

/// Notes the record of that type as one that is packed into words. Lists and tuples have no name to show them by.
fn note_record<F>(fields: impl Iterator<Item = (impl AsRef<str>, u32, Kind)>) {
    let of = short(type_name::<F>());
    if !is_legal(of) {
        return;
    }
    let field = |(path, width, kind): (_, u32, Kind)| Field { name: port_name("", AsRef::as_ref(&path)), width, kind };
    let record = ir::Record { of, fields: fields.map(field).collect() };
    elaboration::draft(|draft| {
        if !draft.records.contains(&record) {
            draft.records.push(record);
        }
    });
}

#[doc(hidden)]
#[track_caller]
pub fn named<B: Bundle>(record: &B, name: &str) -> B {
    let fields = record.leaves();
    let mut ids = Vec::new();
    for (_, signal) in &fields {
        ids.push(signal.id());
    }
    name_word(&ids, name);
    let mut nets = Vec::new();
    for (path, signal) in fields {
        nets.push(signal.named(&port_name(name, &path)));
    }
    from_leaves(record, nets)
}

/// Like [`pack`], for any payload of a stream; the word of no fields is a zero. A field with lanes that the word does
/// not have is packed itself.
#[track_caller]
pub(crate) fn pack_any<V: Data>(value: &V, word: Shape) -> Signal {
    // A loop: in a closure, the message would name the closure as the caller.
    let mut fields = Vec::new();
    for (_, signal) in value.leaves() {
        fields.push(match signal.shape {
            Shape::Row(_) if word.is_plain() => signal.pack(),
            Shape::Grid(..) if word.is_plain() => signal.columns().pack().pack(),
            _ => signal,
        });
    }
    if fields.is_empty() { lit(1, 0) } else { concat(&fields).bits() }
}

/// Undoes [`pack_any`] for a word whose record was like `like`.
#[track_caller]
pub(crate) fn unpack_any<V: Data>(like: &V, word: Signal) -> V {
    if like.leaves().is_empty() {
        return like.clone();
    }
    let is_packed = |field: &Signal| word.shape.is_plain() && !field.shape.is_plain();
    let width = |field: &Signal| {
        if is_packed(field) {
            bits(u64::from(field.width) * u64::from(field.shape.lanes()))
        } else {
            Width::like(*field)
        }
    };
    let parts = unpack(&like.map(width), word).leaves();
    let mut fields = Vec::new();
    for ((_, part), (_, field)) in parts.into_iter().zip(like.leaves()) {
        fields.push(if is_packed(&field) { part.unpack(field.shape).kept_as(field.kind) } else { part });
    }
    let mut fields = fields.into_iter();
    like.map(|_| fields.next().expect("a part for each field"))
}

/// Names the word that all fields are parts of, such as the data of a memory read, after the record, unless it has a
/// name.
fn name_word(fields: &[NodeId], name: &str) {
    elaboration::draft(|draft| {
        let slice = |id: &NodeId| if let Op::Slice { of, .. } = draft.node(*id).op { Some(of) } else { None };
        let Some(word) = fields.first().and_then(slice) else { return };
        let name = draft.prefixed(name);
        let width: u32 = fields.iter().filter(|id| slice(id) == Some(word)).map(|id| draft.node(*id).width).sum();
        let node = draft.node_mut(word);
        let is_plain = node.name.is_none() && !matches!(node.op, Op::Input(_) | Op::Const(_));
        if is_plain && width == node.width {
            node.name = Some(name);
        }
    });
}

/// A record like `like` with these values, one for each field, in the sequence of declaration.
pub(crate) fn from_leaves<T: Leaf, F: Fields<T>, U: Leaf>(like: &F, values: impl IntoIterator<Item = U>) -> F::With<U> {
    let mut values = values.into_iter();
    like.map(|_| values.next().expect("a value for each field"))
}

#[doc(hidden)]
#[track_caller]
pub fn unpack<F: Fields<Width>>(layout: &F, word: Signal) -> F::With<Signal> {
    let loc = Loc::caller();
    let widths = sound_widths(layout, "a record", loc);
    let width: u64 = widths.iter().map(|width| u64::from(*width)).sum();
    if width != word.width.into() {
        let id = word.id();
        elaboration::with(|e| {
            let draft = e.draft();
            let (text, place) = (draft.describe(id), draft.node(id).loc);
            let message =
                format!("a record of {width} bits is unpacked from `{text}`, which has {}", bits_text(word.width));
            let problem = Problem::new(Mistake::RecordWidth, loc, message).note(format!("`{text}` is made"), place);
            e.report_instead_of(
                &[id],
                problem.help("a word has exactly the bits of the record's fields, side by side"),
            );
        });
    }
    split(layout, word)
}

/// The fields of a layout, each with the nearest valid width.
pub(crate) fn sound_fields<F: Fields<Width>>(layout: &F) -> Vec<(String, Width)> {
    let sound = |(path, width): (String, Width)| (path, Width { bits: width.bits.clamp(1, WIDEST), ..width });
    layout.leaves().into_iter().map(sound).collect()
}

/// The parts of `word`; zeros if its width is not that of all fields together, which has been reported.
#[track_caller]
fn split<F: Fields<Width>>(layout: &F, word: Signal) -> F::With<Signal> {
    let loc = Loc::caller();
    let fields = sound_fields(layout);
    let widths: Vec<u32> = fields.iter().map(|(_, width)| width.bits).collect();
    let fits = widths.iter().map(|width| u64::from(*width)).sum::<u64>() == word.width.into();
    if fits && fields.iter().all(|(path, _)| !path.is_empty()) {
        note_record::<F>(fields.iter().map(|(path, width)| (path, width.bits, width.kind)));
    }
    let mut high = word.width;
    let mut fields = Vec::with_capacity(widths.len());
    for width in widths {
        if fits {
            fields.push(word.slice(high - width..high));
            high -= width;
        } else {
            fields.push(elaboration::with(|e| Signal::zero_in(e, width, word.shape, Kind::Number, loc)));
        }
    }
    for (field, (_, Width { kind, .. })) in fields.iter_mut().zip(layout.leaves()) {
        // A field that is the whole word needs no node of its own.
        *field = if field.node == word.node { Signal { kind, ..*field } } else { field.kept_as(kind) };
    }
    let mut fields = fields.into_iter();
    layout.map_fields("", &mut |_, _| fields.next().expect("a part for each field"))
}

/// The widths of the fields; an invalid width is a problem.
fn sound_widths<F: Fields<Width>>(layout: &F, of: &str, loc: Loc) -> Vec<u32> {
    let sound = |(path, width): (String, Width)| {
        elaboration::with(|e| sound_width(e, &[], format_args!("field `{path}` of {of}"), width.bits.into(), loc))
    };
    layout.leaves().into_iter().map(sound).collect()
}

/// The width and lanes of a word with these fields. The single field of a plain word has no path and is checked by
/// the memory.
pub(crate) fn word<F: Fields<Width>>(layout: &F, memory: &str, loc: Loc) -> Width {
    let fields = layout.leaves();
    let Some((path, first)) = fields.first() else { return crate::width::bits(0) };
    if path.is_empty() {
        return *first;
    }
    if let Some((other, width)) = fields.iter().find(|(_, width)| width.shape != first.shape) {
        let (has, shape) = (first.shape, width.shape);
        let message =
            format!("memory `{memory}` stores records, whose field `{path}` has {has}, but `{other}` {shape}");
        let problem = Problem::new(Mistake::UnequalFields, loc, message)
            .help("each lane of a memory has whole records: all fields have its lanes");
        elaboration::with(|e| e.report(problem));
    }
    let widths = sound_widths(layout, &format!("memory `{memory}`"), loc);
    Width { shape: first.shape, ..crate::width::bits(widths.into_iter().fold(0, u32::saturating_add)) }
}
