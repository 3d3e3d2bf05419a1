//! Records with lanes: rows and grids of records.

use crate::along::Along;
use crate::bundle::Bundle;
use crate::data::{Fits, value_of_field};
use crate::elaboration;
use crate::index::Index;
use crate::integers::Integer;
use crate::ir::Shape;
use crate::loc::Loc;
use crate::mistake::Mistake;
use crate::operand::{IntoSignal, Value};
use crate::record::from_leaves;
use crate::signal::Signal;
use crate::stream::backwards;

/// The methods of a row of records, as an array of instances gives one and [`stack`](crate::stack()) makes one. They
/// are those of a row of signals, field by field.
///
/// Each field has as many lanes as the record. A field with lanes of its own is a grid, a row of it for each lane of
/// the record. If all fields are grids, [`rows`](Lanes::rows) or [`columns`](Lanes::columns) says along which axis. A
/// record with a stream cannot be moved among lanes: [`Stream::lanes`](crate::Stream::lanes) takes a stream apart.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// record! { struct Word { valid: bit(), data: bits(4) } }
///
/// block! {
///     /// A stage of a delay line.
///     struct Stage;
///     in StageIn { before: Word }
///     out StageOut { word: Word }
/// }
///
/// impl Stage {
///     fn build(&self, m: Module, i: StageIn) -> StageOut {
///         StageOut { word: m.pipe("word", i.before) }
///     }
/// }
///
/// let first = Word { valid: lit(1, 1), data: lit(4, 9) };
/// let stages = m.array("u_stage", 3, &Stage, |stages| StageIn { before: stages.word.previous(first) });
/// def!(last = stages.word.last());
/// # });
/// assert_eq!(example.values("last_data"), [0, 0, 0, 9]);
/// assert_eq!(example.values("last_valid"), [0, 0, 0, 1]);
/// ```
pub trait Lanes: Bundle {
    /// The number of lanes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: 0 });
    /// m.assert(pixels.lane(pixels.count() - 1).z.eq(4), "a number known while the block is built");
    /// # });
    /// ```
    #[track_caller]
    fn count(&self) -> u32 {
        Along::of_fields(self, None, "count").count()
    }

    /// The record in the lane of this number, counted from 0.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: lane * lane });
    /// let Pixel { z, rgb } = pixels.lane(2);
    /// m.assert(z.eq(3) & rgb.eq(4), "all fields of one lane");
    /// # });
    /// ```
    #[track_caller]
    fn lane(&self, index: impl Integer) -> Self {
        Along::of_fields(self, None, "lane").lane(index)
    }

    /// The record in the last lane: the output of a chain.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: lane * lane });
    /// m.assert(pixels.last().rgb.eq(9), "the record of lane 3");
    /// # });
    /// ```
    #[track_caller]
    fn last(&self) -> Self {
        Along::of_fields(self, None, "last").last()
    }

    /// The records of all lanes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(2)), |lane| Pixel { z: lane + 1, rgb: 0 });
    /// let [near, far] = pixels.to_vec()[..] else { unreachable!("two lanes") };
    /// m.assert(near.z.lt(far.z), "two records");
    /// # });
    /// ```
    #[track_caller]
    fn to_vec(&self) -> Vec<Self> {
        Along::of_fields(self, None, "to_vec").to_vec()
    }

    /// Each lane takes the record of its lower neighbour; lane 0 takes `edge`, or zeros if `edge` is 0.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: 0 });
    /// m.assert(pixels.previous(0).z.pack().eq(0x3210), "zeros in lane 0");
    /// m.assert(pixels.previous(Pixel { z: 15, rgb: 0 }).z.pack().eq(0x321f), "a record in lane 0");
    /// # });
    /// ```
    #[track_caller]
    fn previous(&self, edge: impl Fits<Self>) -> Self {
        Along::of_fields(self, None, "previous").previous(edge)
    }

    /// Each lane takes the record of its higher neighbour; the last lane takes `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: 0 });
    /// m.assert(pixels.following(pixels.lane(0)).z.pack().eq(0x1432), "a ring");
    /// # });
    /// ```
    #[track_caller]
    fn following(&self, edge: impl Fits<Self>) -> Self {
        Along::of_fields(self, None, "following").following(edge)
    }

    /// Lane `i` takes the record of lane `i - by`, or `edge` if there is none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: 0 });
    /// m.assert(pixels.shifted(2, 0).z.pack().eq(0x2100), "lane 2 takes lane 0");
    /// # });
    /// ```
    #[track_caller]
    fn shifted(&self, by: impl Integer, edge: impl Fits<Self>) -> Self {
        Along::of_fields(self, None, "shifted").shifted(by, edge)
    }

    /// A row of `count` records: lane `i` is lane `index(i)` of this one. No index may be out of range.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: 0 });
    /// m.assert(pixels.take(2, |i| 2 * i + 1).z.pack().eq(0x42), "every second lane, from lane 1 on");
    /// # });
    /// ```
    #[track_caller]
    fn take(&self, count: impl Integer, index: impl FnOnce(Index) -> Index) -> Self {
        Along::of_fields(self, None, "take").take(count, index)
    }

    /// Like [`take`](Lanes::take), but an index out of range gives `edge`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(2)), |lane| Pixel { z: lane + 1, rgb: 0 });
    /// m.assert(pixels.take_or(4, |i| i - 1, 0).z.pack().eq(0x0210), "a border around a row");
    /// # });
    /// ```
    #[track_caller]
    fn take_or(&self, count: impl Integer, index: impl FnOnce(Index) -> Index, edge: impl Fits<Self>) -> Self {
        Along::of_fields(self, None, "take_or").take_or(count, index, edge)
    }

    /// The records in reverse.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: 0 });
    /// m.assert(pixels.reversed().z.pack().eq(0x1234), "lane 0 takes lane 3");
    /// # });
    /// ```
    #[track_caller]
    fn reversed(&self) -> Self {
        Along::of_fields(self, None, "reversed").reversed()
    }

    /// The record in the lane whose number is the value of `index`; zeros if there is none.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(row(4)), |lane| Pixel { z: lane + 1, rgb: lane * lane });
    /// def!(number = m.reg(2).reset(0));
    /// number.next(number + 1);
    /// def!(pixel = pixels.pick(number));
    /// m.assert(pixel.z.eq(number.zext(4) + 1), "a multiplexer for each field");
    /// m.assert(pixel.rgb.eq((*number * *number).zext(24)), "all with one index");
    /// # });
    /// ```
    #[track_caller]
    fn pick(&self, index: impl IntoSignal) -> Self {
        Along::of_fields(self, None, "pick").pick(index)
    }

    /// The rows of a grid of records as a sequence: `x.rows().previous(above)` gives each row the one above it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.rows().lane(1).lane(2).z.eq(5), "row 1, and its column 2");
    /// m.assert(pixels.rows().previous(Pixel { z: 15, rgb: 0 }).z.rows().lane(0).pack().eq(0xfff), "the edge");
    /// # });
    /// ```
    #[track_caller]
    fn rows(&self) -> Along<Self> {
        Along::of_fields(self, Some(0), "rows")
    }

    /// The columns of a grid of records as a sequence: `x.columns().previous(left)` gives each column the one to its
    /// left.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// let pixels = constants(Pixel::widths().of(grid(2, 3)), |lane| Pixel { z: lane, rgb: 0 });
    /// m.assert(pixels.columns().last().z.pack().eq(0x52), "the right border: a row of records");
    /// # });
    /// ```
    #[track_caller]
    fn columns(&self) -> Along<Self> {
        Along::of_fields(self, Some(1), "columns")
    }
}

impl<B: Bundle> Lanes for B {}

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
    fn of_fields(record: &B, axis: Option<u32>, method: &str) -> Along<B> {
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
