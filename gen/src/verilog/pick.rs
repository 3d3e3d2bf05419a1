//! A lane that a signal says: the lanes are copied into a vector, as no scope can be chosen at run time.

use super::fold::lower::WIDEST_VECTOR;
use super::layout::range;
use super::literal::{Style, literal};
use super::part::Index;
use super::plan::Form;
use super::printer::Printer;
use super::scope::Scope;
use tilewright_hdl::ir::{NodeId, Op};
use tilewright_hdl::{Bits, index_width};

impl Printer<'_> {
    /// The lane of `of` that `index` says, zero beyond the last; `target` is the net that takes it.
    pub fn pick(&mut self, id: NodeId, target: &str, of: NodeId, axis: u32, index: NodeId) -> Vec<String> {
        let (lanes, width) = (self.module.shape(of).extent(axis), self.module.width(of));
        let (mut out, lane) = if lanes == 1 {
            // A vector of one bit is none.
            let only = self.at_with(axis, Index::one(0));
            (Vec::new(), self.at(only, |printer| printer.value(of)))
        } else if u64::from(lanes) * u64::from(width) > WIDEST_VECTOR {
            self.choose(id, of, axis, index)
        } else {
            let (out, vector) = self.vector_of(id, of, axis);
            let lane = match width {
                1 => format!("{vector}[{}]", self.fitting(index, index_width(lanes.into()))),
                _ => format!("{vector}[{} * {width} +: {width}]", self.fitting(index, index_width(lanes.into()))),
            };
            (out, lane)
        };
        let index_bits = self.module.width(index);
        let value = if index_bits < 32 && 1u64 << index_bits <= u64::from(lanes) {
            lane
        } else {
            let (count, zero) = (Bits::new(index_bits, lanes.into()), Bits::zero(width));
            let inside = self.below(index, &literal(&count, Style::Count));
            format!("({inside}) ? {lane} : {}", literal(&zero, Style::Count))
        };
        out.push(self.placed(format!("assign {target} = {value};"), id));
        out
    }

    /// The lanes side by side, and the text that makes them so, if they are not.
    fn vector_of(&mut self, id: NodeId, of: NodeId, axis: u32) -> (Vec<String>, String) {
        if let Op::Unpack { of: vector, axis: same } = self.module.node(of).op
            && (same, self.plan.form(of)) == (axis, Form::Inline)
            && matches!(self.plan.form(vector), Form::Declared | Form::Net | Form::Block)
        {
            let width = self.module.width(vector);
            return (Vec::new(), self.part(vector, 0, width));
        }
        let (name, depth) = (self.name(id).to_string(), self.at.len());
        let (lanes, width) = (self.module.shape(of).extent(axis), self.module.width(of));
        let (vector, i) = (self.label(&format!("{name}_lanes")), self.loop_variable(depth));
        let value = self.at(self.at_with(axis, Index::all(&i)), |printer| printer.value(of));
        let scope = self.label(&format!("{name}_of"));
        let head = format!("{} begin : {scope}", self.for_lanes(depth, lanes));
        let to = match width {
            1 => format!("{vector}[{i}]"),
            _ => format!("{vector}[{i} * {width} +: {width}]"),
        };
        let mut out = vec![format!("wire {}{vector};", range(lanes * width))];
        out.extend(self.generated(head, vec![format!("assign {to} = {value};")]));
        (out, vector)
    }

    /// The lowest bits of an index, as many as count the lanes.
    fn fitting(&mut self, index: NodeId, bits: u32) -> String {
        match self.module.width(index) {
            width if width > bits => self.part(index, 0, bits),
            width if width < bits => format!("{{{}'d0, {}}}", bits - width, self.value(index)),
            _ => self.value(index),
        }
    }

    /// A tree of multiplexers: each level halves the lanes by a bit of the index. What is beyond the last lane is zero.
    fn choose(&mut self, id: NodeId, of: NodeId, axis: u32, index: NodeId) -> (Vec<String>, String) {
        let (name, depth) = (self.name(id).to_string(), self.at.len());
        let (i, width) = (self.loop_variable(depth), self.module.width(of));
        let zero = literal(&Bits::zero(width), Style::Count);
        let mut scope = Scope::default();
        let mut local = |wanted| self.taken.fresh_in(&mut scope, "level", wanted);
        let (value, pair, last) = (local("value"), local("pair"), local("last"));
        let mut count = self.module.shape(of).extent(axis);
        let (mut out, mut before) = (Vec::new(), None::<String>);
        for bit in 0..index_width(count.into()) {
            let level = self.label(&format!("{name}_by_bit{bit}"));
            let (select, halves) = (self.bit_or_zero(index, bit), count.div_ceil(2));
            let lane = |printer: &mut Self, lane: String| match &before {
                Some(before) => format!("{before}[{lane}].{value}"),
                None => {
                    let at = printer.at_with(axis, Index::all(&lane));
                    printer.at(at, |printer| printer.value(of))
                }
            };
            let (low, high) = (lane(self, format!("2 * {i}")), lane(self, format!("2 * {i} + 1")));
            let whole = format!("assign {value} = {select} ? {high} : {low};");
            let mut body = vec![format!("wire {}{value};", range(width))];
            match count % 2 {
                0 => body.push(whole),
                _ => body.extend([
                    format!("if ({i} < {}) begin : {pair}", count / 2),
                    format!("    {whole}"),
                    format!("end else begin : {last}"),
                    format!("    assign {value} = {select} ? {zero} : {low};"),
                    "end".to_string(),
                ]),
            }
            let head = format!("{} begin : {level}", self.for_lanes(depth, halves));
            out.extend(self.generated(head, body));
            (before, count) = (Some(level), halves);
        }
        (out, format!("{}[0].{value}", before.expect("more than one lane")))
    }

    fn bit_or_zero(&mut self, index: NodeId, bit: u32) -> String {
        if bit < self.module.width(index) { self.part(index, bit, 1) } else { "1'b0".to_string() }
    }
}
