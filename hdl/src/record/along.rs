//! Records in sequence along an axis.

use crate::along::Along;
use crate::bundle::Bundle;
use crate::data::{Fits, value_of_field};
use crate::elaboration;
use crate::index::Index;
use crate::integers::Integer;
use crate::operand::{IntoSignal, Value};
use crate::record::from_leaves;
use crate::signal::Signal;
use crate::stream::backwards;
use tilewright_circuit::ir::Shape;
use tilewright_circuit::{Loc, Mistake};

/// Ends the elaboration if the record contains a stream, which is no value.
#[track_caller]
fn refuse_streams<B: Bundle>(record: &B, leaves: &[(String, Signal)], method: &str) {
    let Some(ready) = backwards(record).iter().position(|back| *back) else { return };
    let stream = leaves[ready].0.trim_end_matches("ready").trim_end_matches('.');
    elaboration::mistake(
        Mistake::StreamLanes,
        format!("`.{method}` would move the stream `{stream}`, which has a receiver in each lane"),
        "`.lanes()` of the stream gives the stream of each lane",
    );
}

/// Ends the elaboration if the fields have unequal numbers of lanes.
#[track_caller]
fn compare_lanes(leaves: &[(String, Signal)], fields: &[Along], method: &str) {
    let Some(other) = fields.iter().position(|along| along.count() != fields[0].count()) else { return };
    let [first, second] = [0, other].map(|field| format!("`{}` has {}", leaves[field].0, fields[field].of.shape));
    elaboration::mistake(
        Mistake::UnequalFields,
        format!("`.{method}` needs a record of equal lanes: field {first}, but {second}"),
        "each lane has a whole record: all fields have its lanes",
    );
}

/// Records in sequence: the methods of a sequence of signals, field by field.
impl<B: Bundle> Along<B> {
    /// Along an axis of a grid of records, or along the one axis of a row of records. Where a field is a row, a grid is
    /// a field with lanes of its own. Only the first field that has other lanes is reported.
    #[track_caller]
    pub(super) fn of_fields(record: &B, axis: Option<u32>, method: &str) -> Along<B> {
        let (loc, leaves) = (Loc::caller(), record.leaves());
        refuse_streams(record, &leaves, method);
        let is_row = axis.is_none() && leaves.iter().any(|(_, signal)| matches!(signal.shape, Shape::Row(_)));
        let mut stand_in = None;
        let mut fields: Vec<Along> = Vec::new();
        for (_, signal) in &leaves {
            let along = match (stand_in, axis, signal.shape) {
                (Some(shape), ..) => {
                    let id = signal.id_at(loc);
                    let of = elaboration::with(|e| {
                        e.draft().in_problems.insert(id);
                        Signal::zero_in(e, signal.width, shape, signal.kind, loc)
                    });
                    Along { of, axis: axis.unwrap_or(0) }
                }
                (None, Some(axis), _) => signal.axis(axis, method),
                (None, None, Shape::Grid(..)) if is_row => Along { of: *signal, axis: 0 },
                (None, None, _) => signal.along(method),
            };
            if along.of.node != signal.node {
                stand_in = Some(along.of.shape);
            }
            fields.push(along);
        }
        if stand_in.is_none() {
            compare_lanes(&leaves, &fields, method);
        }
        Along { of: from_leaves(record, fields.iter().map(|along| along.of)), axis: axis.unwrap_or(0) }
    }

    fn fields(&self) -> impl Iterator<Item = Along> {
        let axis = self.axis;
        self.of.leaves().into_iter().map(move |(_, of)| Along { of, axis })
    }

    /// The value of an edge for each field.
    #[track_caller]
    fn edge(&self, edge: impl Fits<B>, method: &str) -> Vec<Value> {
        let fields = self.of.leaves();
        let mut values = edge.given().for_fields(&fields, method);
        for (value, (_, field)) in values.iter_mut().zip(&fields) {
            *value = value_of_field(value.clone(), *field);
        }
        values
    }

    /// The number of elements.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// let columns = pixels.columns();
    /// m.assert(columns.lane(columns.count() - 1).z.last().eq(5), "3 columns, of 2 records each");
    /// # });
    /// ```
    pub fn count(&self) -> u32 {
        self.fields().next().map_or(0, |field| field.count())
    }

    /// Element `index`, counted from 0.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.columns().lane(1).lane(0).z.eq(1), "column 1, and its row 0");
    /// # });
    /// ```
    #[track_caller]
    pub fn lane(&self, index: impl Integer) -> B {
        let mut fields = Vec::new();
        for field in self.fields() {
            fields.push(field.lane(index));
        }
        from_leaves(&self.of, fields)
    }

    /// The last element.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.rows().last().z.pack().eq(0x543), "the lower row");
    /// # });
    /// ```
    #[track_caller]
    pub fn last(&self) -> B {
        self.lane(self.count().saturating_sub(1))
    }

    /// All elements, as separate records.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// let [upper, lower] = pixels.rows().to_vec()[..] else { unreachable!("two rows") };
    /// m.assert((lower.z - upper.z).eq(3).and_all(), "rows that meet lane by lane");
    /// # });
    /// ```
    #[track_caller]
    pub fn to_vec(&self) -> Vec<B> {
        let mut elements = Vec::new();
        for index in 0..self.count() {
            elements.push(self.lane(index));
        }
        elements
    }

    /// Each element takes the value of its lower neighbour; the first takes `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.rows().previous(0).z.pack().eq(0x210_000), "the row above; the upper one takes zeros");
    /// # });
    /// ```
    #[track_caller]
    pub fn previous(&self, edge: impl Fits<B>) -> B {
        self.shifted(1, edge)
    }

    /// Each element takes the value of its higher neighbour; the last takes `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// let right = pixels.columns().lane(0);
    /// m.assert(pixels.columns().following(right).z.pack().eq(0x354_021), "each row is a ring");
    /// # });
    /// ```
    #[track_caller]
    pub fn following(&self, edge: impl Fits<B>) -> B {
        self.shifted(-1, edge)
    }

    /// Element `i` takes the value of element `i - by`, or `edge` if there is none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.columns().shifted(2, 0).z.pack().eq(0x300_000), "column 2 takes column 0");
    /// # });
    /// ```
    #[track_caller]
    pub fn shifted(&self, by: impl Integer, edge: impl Fits<B>) -> B {
        let mut fields = Vec::new();
        for (field, edge) in self.fields().zip(self.edge(edge, "shifted")) {
            fields.push(field.shifted(by, edge));
        }
        from_leaves(&self.of, fields)
    }

    /// A sequence of `count` elements: element `i` is element `index(i)` of this one. No index may be out of range.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 2)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.rows().take(3, |i| i / 2).z.pack().eq(0x32_10_10), "the upper row twice");
    /// # });
    /// ```
    #[track_caller]
    pub fn take(&self, count: impl Integer, index: impl FnOnce(Index) -> Index) -> B {
        let index = index(Index::lane());
        let mut fields = Vec::new();
        for field in self.fields() {
            fields.push(field.take(count, |_| index));
        }
        from_leaves(&self.of, fields)
    }

    /// Like [`take`](Along::take), but an index out of range gives `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 2)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.rows().take_or(3, |i| i - 1, 0).z.pack().eq(0x32_10_00), "a border above");
    /// # });
    /// ```
    #[track_caller]
    pub fn take_or(&self, count: impl Integer, index: impl FnOnce(Index) -> Index, edge: impl Fits<B>) -> B {
        let index = index(Index::lane());
        let mut fields = Vec::new();
        for (field, edge) in self.fields().zip(self.edge(edge, "take_or")) {
            fields.push(field.take_or(count, |_| index, edge));
        }
        from_leaves(&self.of, fields)
    }

    /// The elements in reverse.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.rows().reversed().z.pack().eq(0x210_543), "upside down");
    /// # });
    /// ```
    #[track_caller]
    pub fn reversed(&self) -> B {
        let mut fields = Vec::new();
        for field in self.fields() {
            fields.push(field.reversed());
        }
        from_leaves(&self.of, fields)
    }

    /// The element whose number is the value of `index`; zeros if there is none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.rows().pick(lit(1, 1)).z.pack().eq(0x543), "one row, selected by a signal");
    /// # });
    /// ```
    #[track_caller]
    pub fn pick(&self, index: impl IntoSignal) -> B {
        let index: Signal = index.into();
        let mut fields = Vec::new();
        for field in self.fields() {
            fields.push(field.pick(index));
        }
        from_leaves(&self.of, fields)
    }
}
