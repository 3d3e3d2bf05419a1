//! Records with lanes: rows and grids of records.

use crate::along::Along;
use crate::bundle::Bundle;
use crate::data::Fits;
use crate::index::Index;
use crate::integers::Integer;
use crate::operand::IntoSignal;

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
