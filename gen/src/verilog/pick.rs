//! A lane selected by a signal. No scope can be selected at run time, so the lanes are copied into an array of nets,
//! which is indexed.
//!
//! A part of a vector, `lanes[index * 40 +: 40]`, is used if the width is a power of two and the vector exists, or if
//! there are many lanes. Otherwise Yosys makes a multiplier and a shifter to any bit of it, with three to ten times
//! the cells of a multiplexer.

use super::fold::lower::WIDEST_VECTOR;
use super::layout::range;
use super::literal::{Style, literal};
use super::part::Index;
use super::plan::Form;
use super::printer::Printer;
use tilewright_circuit::ir::{NodeId, Op};
use tilewright_circuit::{Bits, index_width};

/// Larger arrays of nets are avoided: Yosys takes time quadratic in their number.
const LONGEST_ARRAY: u32 = 256;

impl Printer<'_> {
    /// The lane of `of` selected by `index`, zero if out of range; `target` is the net that takes it.
    pub fn pick(&mut self, id: NodeId, target: &str, of: NodeId, axis: u32, index: NodeId) -> Vec<String> {
        let (lanes, width) = (self.module.shape(of).extent(axis), self.module.width(of));
        let (mut out, lane) = if lanes == 1 {
            // A vector of one bit is not indexed.
            let only = self.at_with(axis, Index::one(0));
            (Vec::new(), self.at(only, |printer| printer.value(of)))
        } else if let Some(vector) = self.vector_of(of, axis) {
            (Vec::new(), self.lane_of(&vector, width, index, lanes))
        } else if lanes <= LONGEST_ARRAY {
            let (out, array) = self.copied(id, of, axis, lanes);
            (out, format!("{array}[{}]", self.fitting(index, index_width(lanes.into()))))
        } else if width.is_power_of_two() && u64::from(lanes) * u64::from(width) <= WIDEST_VECTOR {
            let (out, vector) = self.side_by_side(id, of, axis);
            (out, self.lane_of(&vector, width, index, lanes))
        } else {
            self.choose(id, of, axis, index)
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

    /// The vector with the lanes side by side, if there is one from which a part of their width can be taken.
    fn vector_of(&mut self, of: NodeId, axis: u32) -> Option<String> {
        let Op::Unpack { of: vector, axis: same } = self.module.node(of).op else { return None };
        let is_there = matches!(self.plan.form(vector), Form::Declared | Form::Net | Form::Block);
        let is_whole = (same, self.plan.form(of)) == (axis, Form::Inline);
        let width = self.module.width(vector);
        (is_there && is_whole && self.module.width(of).is_power_of_two()).then(|| self.part(vector, 0, width))
    }

    /// The lane of a vector with a given index.
    fn lane_of(&mut self, vector: &str, width: u32, index: NodeId, lanes: u32) -> String {
        let index = self.fitting(index, index_width(lanes.into()));
        if width == 1 { format!("{vector}[{index}]") } else { format!("{vector}[{index} * {width} +: {width}]") }
    }

    /// An array of nets, one a lane, and the text that declares it.
    fn copied(&mut self, id: NodeId, of: NodeId, axis: u32, lanes: u32) -> (Vec<String>, String) {
        let width = self.module.width(of);
        let array = self.label(&format!("{}_lanes", self.name(id)));
        let declared = match width {
            1 => format!("wire {}{array};", range(lanes)),
            _ => format!("wire {}{array} [0:{}];", range(width), lanes - 1),
        };
        let out = self.each_lane(id, of, axis, declared, |i| format!("{array}[{i}]"));
        (out, array)
    }

    /// A vector of the lanes side by side, and the text that declares it.
    fn side_by_side(&mut self, id: NodeId, of: NodeId, axis: u32) -> (Vec<String>, String) {
        let (lanes, width) = (self.module.shape(of).extent(axis), self.module.width(of));
        let vector = self.label(&format!("{}_lanes", self.name(id)));
        let declared = format!("wire {}{vector};", range(lanes * width));
        let out = self.each_lane(id, of, axis, declared, |i| match width {
            1 => format!("{vector}[{i}]"),
            _ => format!("{vector}[{i} * {width} +: {width}]"),
        });
        (out, vector)
    }

    /// A declaration, with an assignment of each lane to its place.
    fn each_lane(
        &mut self,
        id: NodeId,
        of: NodeId,
        axis: u32,
        declared: String,
        place: impl Fn(&str) -> String,
    ) -> Vec<String> {
        let (depth, lanes) = (self.at.len(), self.module.shape(of).extent(axis));
        let i = self.loop_variable(depth);
        let value = self.at(self.at_with(axis, Index::all(&i)), |printer| printer.value(of));
        let scope = self.label(&format!("{}_of", self.name(id)));
        let head = format!("{} begin : {scope}", self.for_lanes(depth, lanes));
        let mut out = vec![declared];
        out.extend(self.generated(head, vec![format!("assign {} = {value};", place(&i))]));
        out
    }

    /// The lowest bits of an index, as many as the lanes need.
    fn fitting(&mut self, index: NodeId, bits: u32) -> String {
        match self.module.width(index) {
            width if width > bits => self.part(index, 0, bits),
            width if width < bits => format!("{{{}'d0, {}}}", bits - width, self.value(index)),
            _ => self.value(index),
        }
    }

    /// A tree of multiplexers: each level halves the lanes by a bit of the index. Lanes out of range are zero.
    fn choose(&mut self, id: NodeId, of: NodeId, axis: u32, index: NodeId) -> (Vec<String>, String) {
        let (name, depth) = (self.name(id).to_string(), self.at.len());
        let (i, width) = (self.loop_variable(depth), self.module.width(of));
        let zero = literal(&Bits::zero(width), Style::Count);
        let [value, pair, last] = self.local("level", ["value", "pair", "last"]);
        let mut count = self.module.shape(of).extent(axis);
        let (mut out, mut before) = (Vec::new(), None::<String>);
        for bit in 0..index_width(count.into()) {
            let level = self.loop_label(&format!("{name}_by_bit{bit}"));
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
