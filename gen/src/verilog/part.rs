//! A value that has a place, by the name of the place: a net of the same scope, a net in the scope of another lane,
//! or bits of a vector with lanes side by side.

use super::lane_values::{LaneConstants, lane_constants};
use super::plan::Form;
use super::printer::Printer;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Affine, NodeId, Op, Shape};

/// The lane along one axis at which the current text is printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Index {
    /// Its Verilog text.
    pub text: String,
    /// The base expression of the text, and the rule applied to it.
    base: String,
    rule: Affine,
    /// The lanes that it takes on; `None` means all of them.
    pub from: Option<Vec<u32>>,
}

impl Index {
    /// An expression that takes on every lane, such as a loop variable.
    pub fn all(text: &str) -> Index {
        Index { text: text.to_string(), base: text.to_string(), rule: Affine::shift(0), from: None }
    }

    pub fn one(lane: u32) -> Index {
        Index { from: Some(vec![lane]), ..Index::all(&lane.to_string()) }
    }

    /// The same expression, taking on these lanes.
    pub fn only(self, lanes: Vec<u32>) -> Index {
        Index { from: Some(lanes), ..self }
    }

    /// The lanes, out of `extent`.
    fn lanes(&self, extent: u32) -> Vec<u32> {
        self.from.clone().unwrap_or_else(|| (0..extent).collect())
    }

    /// The source lane of `rule` for this one, if it is in range. This one takes on `extent` lanes; the operand has
    /// `inner`.
    pub fn mapped(&self, rule: Affine, extent: u32, inner: u32) -> Index {
        let from: Vec<u32> = self.lanes(extent).into_iter().filter_map(|lane| rule.source(lane, inner)).collect();
        if let Ok(lane) = self.text.parse() {
            return Index::all(&rule.at(lane).to_string()).only(from);
        }
        let (base, rule) = match self.after(rule) {
            Some(rule) => (self.base.clone(), rule),
            None => (self.text.clone(), rule),
        };
        Index { text: formula(&base, rule), base, rule, from: Some(from) }
    }

    /// The composition of this rule and `rule`, if a single rule can express it.
    fn after(&self, rule: Affine) -> Option<Affine> {
        let mul = self.rule.mul.checked_mul(rule.mul)?;
        let add = self.rule.add.checked_mul(rule.mul)?.checked_add(rule.add)?;
        (self.rule.div == 1).then_some(Affine { mul, add, div: rule.div })
    }

    /// The lane, within its part, of this lane of `k` interleaved parts.
    pub fn shared(&self, k: u32) -> Index {
        Index::all(&formula(&self.text, Affine { mul: 1, add: 0, div: k }))
    }
}

/// `(mul * i + add) / div` without redundant terms.
fn formula(i: &str, Affine { mul, add, div }: Affine) -> String {
    let i = if i.contains(' ') { format!("({i})") } else { i.to_string() };
    let product = match mul.unsigned_abs() {
        1 => i,
        mul => format!("{mul} * {i}"),
    };
    let sum = match (mul, add) {
        (0, add) => return (add.div_euclid(div as i32)).to_string(),
        (mul, 0) if mul > 0 => product,
        (mul, add) if mul > 0 && add > 0 => format!("{product} + {add}"),
        (mul, add) if mul > 0 => format!("{product} - {}", add.unsigned_abs()),
        (_, add) => format!("{add} - {product}"),
    };
    match div {
        1 => sum,
        div if sum.contains(' ') => format!("({sum}) / {div}"),
        div => format!("{sum} / {div}"),
    }
}

impl Printer<'_> {
    /// The result of `print` at other lanes.
    pub fn at<R>(&mut self, at: Vec<Index>, print: impl FnOnce(&mut Self) -> R) -> R {
        let before = std::mem::replace(&mut self.at, at);
        let text = print(self);
        self.at = before;
        text
    }

    /// The current lanes without those along an axis.
    pub fn at_without(&self, axis: u32) -> Vec<Index> {
        let mut at = self.at.clone();
        at.remove(axis as usize);
        at
    }

    /// The current lanes with another axis.
    pub fn at_with(&self, axis: u32, index: Index) -> Vec<Index> {
        let mut at = self.at.clone();
        at.insert(axis as usize, index);
        at
    }

    /// The current lanes with others along an axis.
    pub fn at_instead(&self, axis: u32, index: Index) -> Vec<Index> {
        let mut at = self.at.clone();
        at[axis as usize] = index;
        at
    }

    /// The operand of an operator that only names a place, and its lanes.
    pub fn operand_place(&self, id: NodeId) -> Option<(NodeId, Vec<Index>)> {
        let module = self.module;
        match module.node(id).op {
            Op::Wire(of) | Op::QuasiStatic(of, _) => Some((of, self.at.clone())),
            Op::Broadcast { of, axis } => Some((of, self.at_without(axis))),
            Op::Lane { of, axis, index } => Some((of, self.at_with(axis, Index::one(index)))),
            Op::Map { of, axis, index, edge: None } => {
                let (extent, inner) = (module.shape(id).extent(axis), module.shape(of).extent(axis));
                let index = self.at[axis as usize].mapped(index, extent, inner);
                Some((of, self.at_instead(axis, index)))
            }
            _ => None,
        }
    }

    /// Bits `low .. low + width` of a node that has a place.
    pub fn part(&mut self, id: NodeId, low: u32, width: u32) -> String {
        match self.plan.form(id) {
            Form::Declared | Form::Net | Form::Block => {
                self.mark(id, low, width);
                let name = self.place_name(id);
                if width == self.module.width(id) { name } else { format!("{name}{}", bits(low, width)) }
            }
            Form::Constants => self.constant_lane(id),
            _ => match self.module.node(id).op {
                Op::Unpack { .. } => self.vector_part(id, low, width),
                _ => {
                    let (of, at) = self.operand_place(id).expect("what is cut has a place");
                    self.at(at, |printer| printer.part(of, low, width))
                }
            },
        }
    }

    /// Bits of a vector with lanes side by side.
    pub fn vector_part(&mut self, id: NodeId, low: u32, width: u32) -> String {
        // Each lane's index and the distance of lanes in bits, the innermost first.
        let (mut of, mut at, mut steps) = (id, self.at.clone(), Vec::new());
        loop {
            let step = self.module.width(of);
            match self.module.node(of).op {
                // The vector's own name cannot be used here, even if these lanes have one.
                Op::Unpack { of: inner, axis } if of == id || self.plan.form(of) == Form::Inline => {
                    let extent = self.module.shape(of).extent(axis);
                    steps.push((at.remove(axis as usize), step, extent));
                    of = inner;
                }
                _ if self.plan.form(of) == Form::Inline => {
                    let place = self.at(at.clone(), |printer| printer.operand_place(of));
                    (of, at) = place.expect("what is cut has a place");
                }
                _ => break,
            }
        }
        let name = self.at(at, |printer| {
            printer.mark_steps(of, &steps, low, width);
            printer.place_name(of)
        });
        if let Some(first) =
            steps.iter().map(|(index, step, _)| Some(index.text.parse::<u32>().ok()? * step)).sum::<Option<u32>>()
        {
            return format!("{name}{}", bits(first + low, width));
        }
        let first = offset(&steps, low);
        if width == 1 { format!("{name}[{first}]") } else { format!("{name}[{first} +: {width}]") }
    }

    /// Records which bits of the vector are read.
    fn mark_steps(&mut self, of: NodeId, steps: &[(Index, u32, u32)], low: u32, width: u32) {
        let mut firsts = vec![low];
        for (index, step, extent) in steps {
            let lanes = index.lanes(*extent);
            firsts = firsts.iter().flat_map(|first| lanes.iter().map(move |lane| first + lane * step)).collect();
        }
        if self.module.shape(of).is_plain() {
            firsts.into_iter().for_each(|first| self.mark(of, first, width));
        } else if firsts.len() as u32 * width >= self.module.width(of) {
            self.mark(of, 0, self.module.width(of));
        }
    }

    /// Records that bits of a node are read at the current lanes.
    fn mark(&mut self, id: NodeId, low: u32, width: u32) {
        let shape = self.module.shape(id);
        if self.at.iter().all(|index| index.from.is_none()) {
            return self.usage.mark(id, low, width);
        }
        if width < self.module.width(id) {
            return;
        }
        let mut lanes = vec![0];
        for (axis, index) in (0..).zip(&self.at) {
            let extent = shape.extent(axis);
            let along = index.lanes(extent);
            lanes = lanes.iter().flat_map(|lane| along.iter().map(move |next| lane * extent + next)).collect();
        }
        self.usage.mark_lanes(id, shape.lanes(), &lanes);
    }

    /// The name of a node at the current lanes, as seen from the current scope.
    pub fn place_name(&self, id: NodeId) -> String {
        let name = self.name(id);
        let Some(home) = self.groups.home(id) else { return name.to_string() };
        let (scope, is_ahead) = (&self.lanes.groups[home], self.groups.groups[home].ahead.contains(&id));
        let is_own = self.at.iter().zip(&self.lanes.genvars).all(|(index, genvar)| index.text == *genvar);
        if self.here == Some(home) && is_own && !is_ahead {
            return name.to_string();
        }
        let label = if is_ahead { scope.ahead.as_ref().expect("a label of its own") } else { &scope.label };
        match &self.at[..] {
            [lane] => format!("{label}[{}].{name}", lane.text),
            [row, column] => format!("{label}[{}].{}[{}].{name}", row.text, self.lanes.column, column.text),
            _ => unreachable!("a group is a row or a grid"),
        }
    }

    /// The constant of the current lane.
    pub fn constant_lane(&self, id: NodeId) -> String {
        let (shape, width) = (self.module.shape(id), self.module.width(id));
        let home = self.groups.home(id).expect("constants are in a group");
        if let Some(table) = self.lanes.groups[home].tables.get(&id) {
            let first = self.lane_number(shape);
            return match width {
                1 => format!("{table}[{first}]"),
                _ if first.contains(' ') => format!("{table}[({first}) * {width} +: {width}]"),
                _ => format!("{table}[{first} * {width} +: {width}]"),
            };
        }
        formula_value(&self.place_name(id), width)
    }

    /// The number of the current lane, in row-major order.
    pub fn lane_number(&self, shape: Shape) -> String {
        match (&self.at[..], shape) {
            ([row, column], Shape::Grid(_, columns)) => {
                offset(&[(column.clone(), 1, columns), (row.clone(), columns, 0)], 0)
            }
            ([lane], _) => lane.text.clone(),
            _ => unreachable!("a group is a row or a grid"),
        }
    }

    /// The formula of constants, with the loop variables of their group.
    pub fn formula(&self, id: NodeId) -> Option<String> {
        Some(match lane_constants(self.module, id)? {
            LaneConstants::Along(axis, pattern) => pattern.text(&self.lanes.genvars[axis as usize]),
            LaneConstants::Lane(pattern) => pattern.text(&format!("({})", self.lane_number(self.module.shape(id)))),
            LaneConstants::Table(_) => return None,
        })
    }

    /// The words of a table, for constants without a rule.
    pub fn table(&self, id: NodeId) -> Option<Vec<Bits>> {
        match lane_constants(self.module, id)? {
            LaneConstants::Table(words) => Some(words),
            _ => None,
        }
    }
}

/// `[7:0]`, or `[0]`.
fn bits(low: u32, width: u32) -> String {
    if width == 1 { format!("[{low}]") } else { format!("[{}:{low}]", low + width - 1) }
}

/// The first bit of a lane: each index with the distance of its lanes in bits, the innermost first.
fn offset(steps: &[(Index, u32, u32)], low: u32) -> String {
    let bracketed = |text: String| if text.contains(' ') { format!("({text})") } else { text };
    let mut text: Option<(String, u32)> = None;
    for (index, step, _) in steps.iter().rev() {
        let own = index.text.clone();
        text = Some(match text {
            None => (own, *step),
            Some(outer) if own == "0" => outer,
            Some((outer, apart)) => {
                let times = apart / step;
                let outer = if times == 1 { outer } else { format!("{} * {times}", bracketed(outer)) };
                (format!("{outer} + {}", bracketed(own)), *step)
            }
        });
    }
    let (lane, step) = text.expect("a vector of lanes");
    let first = if step == 1 { lane } else { format!("{} * {step}", bracketed(lane)) };
    if low == 0 { first } else { format!("{first} + {low}") }
}

/// The used bits of a formula's 32.
pub fn formula_value(name: &str, width: u32) -> String {
    match width {
        1 => format!("{name}[0]"),
        32 => name.to_string(),
        width if width < 32 => format!("{name}[{}:0]", width - 1),
        width => format!("{{{}'d0, {name}}}", width - 32),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_formulas() {
        let at = |i: &str, mul, add, div| formula(i, Affine { mul, add, div });
        assert_eq!(at("i", 1, -1, 1), "i - 1");
        assert_eq!(at("i", 1, 2, 1), "i + 2");
        assert_eq!(at("i", 2, 1, 1), "2 * i + 1");
        assert_eq!(at("i", -1, 3, 1), "3 - i");
        assert_eq!(at("i", -2, 6, 4), "(6 - 2 * i) / 4");
        assert_eq!(at("i", 1, 0, 2), "i / 2");
        assert_eq!(at("i - 1", 1, -1, 2), "((i - 1) - 1) / 2");
        assert_eq!(at("i", 0, 5, 2), "2");
    }

    #[test]
    fn rules_after_rules_are_one() {
        let i = Index::all("i");
        let second = i.mapped(Affine { mul: 2, add: 1, div: 1 }, 4, 8);
        assert_eq!(second.mapped(Affine { mul: -1, add: 7, div: 1 }, 8, 8).text, "6 - 2 * i");
        let half = i.shared(2);
        assert_eq!(half.mapped(Affine::shift(3), 2, 8).mapped(Affine::shift(-1), 8, 8).text, "(i / 2) + 2");
        assert_eq!(Index::one(3).mapped(Affine { mul: 1, add: -1, div: 2 }, 4, 4), Index::one(1));
        assert_eq!(second.from, Some(vec![1, 3, 5, 7]));
    }

    #[test]
    fn lanes_stand_side_by_side() {
        let (i, j) = (Index::all("i"), Index::all("j"));
        assert_eq!(offset(&[(i.clone(), 8, 4)], 0), "i * 8");
        assert_eq!(offset(&[(i.clone(), 1, 4)], 0), "i");
        assert_eq!(offset(&[(j.clone(), 8, 4), (i.clone(), 32, 3)], 0), "(i * 4 + j) * 8");
        assert_eq!(offset(&[(j.clone(), 1, 4), (i.clone(), 4, 3)], 0), "i * 4 + j");
        assert_eq!(offset(&[(Index::one(0), 8, 4), (i.clone(), 32, 3)], 0), "i * 32");
        assert_eq!(offset(&[(i, 8, 4)], 3), "i * 8 + 3");
        assert_eq!(offset(&[(Index::one(2), 4, 4), (j, 16, 3)], 0), "(j * 4 + 2) * 4");
    }
}
