//! What signals and records have in common: widths declare them, and they are assigned values.

use crate::bundle::Bundle;
use crate::elaboration;
use crate::fields::{Fields, Leaf, Visited};
use crate::integers::{Integer, for_integers};
use crate::names::bits_text;
use crate::operand::{Literal, Operand, Value};
use crate::register::Reg;
use crate::shaping::IntoShape;
use crate::signal::Signal;
use crate::uneven::{Uneven, uneven};
use crate::width::{IntoWidth, Width};
use crate::wire::Wire;
use tilewright_circuit::ir::{Kind, Names, NodeId};
use tilewright_circuit::{Bits, Loc, Mistake, Problem, Radix};

/// A value in the circuit: a [`Signal`], a record of signals made by [`bundle!`](crate::bundle!), or a list of
/// either.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// bundle! { struct Pixel<T> { z: T, rgb: T } }
///
/// /// Works for a signal, a record and a list.
/// fn held<V: Data + Fits<V>>(busy: Signal, old: V, new: V) -> V {
///     mux(busy, old, new)
/// }
///
/// m.assert(held(lit(1, 1), lit(8, 5), lit(8, 6)).eq(5), "a signal");
/// let [near, far] = [5, 6].map(|z| Pixel { z: lit(8, z), rgb: lit(24, 0) });
/// m.assert(held(lit(1, 0), near, far).z.eq(6), "a record");
/// # });
/// ```
pub trait Data: Fields<Signal, With<Signal> = Self> + Clone + 'static {
    /// The same type with other leaves: for `Entry`, `Like<Width>` is `Entry<Width>`.
    type Like<T: Leaf>: Fields<T, With<Signal> = Self> + Clone;
}

impl Data for Signal {
    type Like<T: Leaf> = T;
}

impl<B: Bundle> Data for B {
    type Like<T: Leaf> = B::Of<T>;
}

impl<V: Data> Data for Vec<V> {
    type Like<T: Leaf> = Vec<V::Like<T>>;
}

impl<V: Data, const N: usize> Data for [V; N] {
    type Like<T: Leaf> = [V::Like<T>; N];
}

/// A declaration: a width declares a signal, and a record of widths declares a record of signals.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// bundle! { struct Range<T> { from: T, to: T } }
///
/// /// Two registers in sequence, for a signal or a record.
/// fn history<L: Layout + Copy>(m: Module, layout: L) -> [Reg<L::Value>; 2] {
///     ["now", "before"].map(|name| m.reg(name, layout))
/// }
///
/// let [now, before] = history(m, Range { from: bits(4), to: bits(8) });
/// now.next(Range { from: now.from + 1, to: now.to + 2 });
/// before.next(*now);
/// # });
/// assert_eq!(example.values("now_to"), [0, 2, 4, 6]);
/// assert_eq!(example.values("before_from"), [0, 0, 1, 2]);
/// ```
#[diagnostic::on_unimplemented(
    message = "nothing can be declared with a `{Self}`: it is not a record of widths",
    note = "a record of widths has one in each field, as in `Entry {{ resident: bit(), page: below(n) }}`"
)]
pub trait Layout {
    /// The declared value.
    type Value: Data;

    #[doc(hidden)]
    fn layout(self) -> <Self::Value as Data>::Like<Width>;

    /// The same widths in each lane of `shape`, for a row or a grid of records.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// record! { struct Pixel { z: bits(4), rgb: bits(24) } }
    ///
    /// def!(pixels = m.reg(Pixel::widths().of(row(3))).reset(0));
    /// pixels.next(pixels.previous(Pixel { z: 7, rgb: 0 }));
    /// def!(last = pixels.last());
    /// # });
    /// assert_eq!(example.values("last_z"), [0, 0, 0, 7]);
    /// ```
    #[track_caller]
    fn of(self, shape: impl IntoShape) -> <<Self::Value as Data>::Like<Width> as Fields<Width>>::With<Width>
    where
        Self: Sized,
    {
        let shape = shape.into_shape();
        self.layout().map(|width| width.of(shape))
    }
}

impl<W: IntoWidth> Layout for W {
    type Value = Signal;

    #[track_caller]
    fn layout(self) -> Width {
        self.into_width()
    }
}

/// What can be assigned to a `V`. A signal accepts an [`Operand`]. A record accepts a record of signals or a
/// reference to one, a register or wire of records, or a record of numbers. It also accepts `0`, for all of its
/// fields.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// bundle! { struct Pixel<T> { z: T, rgb: T } }
///
/// def!(nearest = m.reg(Pixel { z: bits(4), rgb: bits(24) }).reset(Pixel { z: 8, rgb: 0 })); // numbers
/// nearest
///     .when(nearest.z.eq(1), 0) // zeros
///     .otherwise(Pixel { z: nearest.z >> 1, rgb: lit(24, 7) }); // signals
/// # });
/// assert_eq!(example.values("nearest_z"), [8, 4, 2, 1, 0]);
/// assert_eq!(example.values("nearest_rgb"), [0, 7, 7, 7, 0]);
/// ```
#[diagnostic::on_unimplemented(
    message = "a `{Self}` cannot be given where a `{V}` is expected",
    note = "a signal is given a signal or a number; a record is given a record of signals or of numbers, or 0"
)]
pub trait Fits<V: Data> {
    #[doc(hidden)]
    #[track_caller]
    fn given(self) -> Given<V>;
}

#[doc(hidden)]
#[derive(Debug, Clone)]
pub enum Given<V: Data> {
    /// A number for all fields.
    All(i128),
    /// An operand for each field.
    Each(V::Like<Value>),
}

impl Leaf for Value {}

impl Operand for Value {
    fn operand(self) -> Value {
        self
    }
}

impl<O: Operand> Fits<Signal> for O {
    fn given(self) -> Given<Signal> {
        Given::Each(self.operand())
    }
}

impl<B: Bundle> Fits<B> for &B {
    fn given(self) -> Given<B> {
        signals(self)
    }
}

impl<B: Bundle> Fits<B> for Reg<B> {
    fn given(self) -> Given<B> {
        signals(&self.signal)
    }
}

impl<B: Bundle> Fits<B> for Wire<B> {
    fn given(self) -> Given<B> {
        signals(&self.signal)
    }
}

fn signals<B: Bundle>(record: &B) -> Given<B> {
    Given::Each(record.of(&mut |_, signal| Value::Signal(*signal)))
}

/// The result of [`arms!`](crate::arms!) for one arm.
impl<V: Data> Fits<V> for Given<V> {
    fn given(self) -> Given<V> {
        self
    }
}

macro_rules! numbers {
    ($($ty:ty)*) => {$(
        impl<B: Bundle> Fits<B> for $ty {
            fn given(self) -> Given<B> {
                Given::All(self.integer())
            }
        }
    )*};
}
for_integers!(numbers);

impl<V: Data, A: Fits<V>> Fits<Vec<V>> for Vec<A> {
    #[track_caller]
    fn given(self) -> Given<Vec<V>> {
        Given::Each(each_of(self))
    }
}

impl<V: Data, A: Fits<V>, const N: usize> Fits<[V; N]> for [A; N] {
    #[track_caller]
    fn given(self) -> Given<[V; N]> {
        let Ok(elements) = each_of(self.into()).try_into() else { unreachable!("as many as before") };
        Given::Each(elements)
    }
}

/// The value of each element of a list. A lone number is a problem, because it has no fields.
#[track_caller]
fn each_of<V: Data, A: Fits<V>>(list: Vec<A>) -> Vec<V::Like<Value>> {
    // A loop: in a closure, the message would name the closure as the caller.
    let mut elements = Vec::with_capacity(list.len());
    for element in list {
        match element.given() {
            Given::Each(values) => elements.push(values),
            Given::All(number) => elaboration::mistake(
                Mistake::NumberForRecord,
                format!("a list of records has the number {number} in it"),
                "write the record",
            ),
        }
    }
    elements
}

impl<V: Data> Given<V> {
    /// The operand for each of these fields; `of` is the operation that assigns them.
    #[track_caller]
    pub(crate) fn for_fields<T: Clone>(self, fields: &[(String, T)], of: &str) -> Vec<Value> {
        let loc = Loc::caller();
        let zero = || Value::Literal(Literal::Integer(0, Radix::Any));
        let mut operands = Vec::new();
        let problem = match self {
            Given::All(0) => None,
            Given::All(number) => {
                let message = format!("`{of}` gives a record the number {number}, which is not a record");
                Some(
                    Problem::new(Mistake::NumberForRecord, loc, message)
                        .help("the only number that means a whole record is 0: each field is 0"),
                )
            }
            Given::Each(values) => {
                if let Some(operands) = without_lists::<V>(&values).filter(|of| of.len() == fields.len()) {
                    return operands;
                }
                let values = values.leaves();
                let Some(uneven) = uneven(&values, fields) else {
                    return values.into_iter().map(|(_, value)| value).collect();
                };
                let Uneven { has, needs, .. } = &uneven;
                let message = format!("`{of}` gives a list{uneven} of {has} where one of {needs} is expected");
                operands = nodes_of(&values, loc);
                Some(
                    Problem::new(Mistake::ListLength, loc, message).help("both records have lists of the same lengths"),
                )
            }
        };
        if let Some(problem) = problem {
            elaboration::with(|e| e.report_instead_of(&operands, problem));
        }
        fields.iter().map(|_| zero()).collect()
    }
}

/// The operand for each field of a record in which no list is, whose length could be wrong.
fn without_lists<V: Data>(values: &V::Like<Value>) -> Option<Vec<Value>> {
    let (mut operands, mut has_list) = (Vec::new(), false);
    values.visit(&mut |part| match part {
        Visited::Leaf(value) | Visited::Back(value) => operands.push(value.clone()),
        Visited::List(_) => has_list = true,
    });
    (!has_list).then_some(operands)
}

/// The signals among the values.
fn nodes_of(values: &[(String, Value)], loc: Loc) -> Vec<NodeId> {
    let node = |(_, value): &(String, Value)| match value {
        Value::Signal(signal) | Value::Low(signal) => Some(signal.id_at(loc)),
        Value::Literal(_) => None,
    };
    values.iter().filter_map(node).collect()
}

/// The number, which must fit in the field; in a field of an enum it must be one of its codes. If `stand_in` follows
/// another problem, as a faulty field does, nothing is reported.
#[track_caller]
pub(crate) fn number_of_field(
    number: &Literal,
    name: impl FnOnce() -> String,
    (width, kind): (u32, Kind),
    stand_in: Option<NodeId>,
) -> Bits {
    let (bits, fits) = number.bits(width, kind);
    let is_code = |names: Names| match number {
        Literal::Integer(value, _) => u64::try_from(*value).is_ok_and(|code| names.place(code).is_some()),
        Literal::Exact(_) => true,
        Literal::Code { names: of, .. } => *of == names,
    };
    let (loc, name) = match (fits, kind, number) {
        (true, Kind::Code(names), _) if is_code(names) => return bits,
        (true, Kind::Number | Kind::Signed, Literal::Integer(..) | Literal::Exact(_)) => return bits,
        _ => (Loc::caller(), name()),
    };
    let problem = match kind {
        Kind::Code(names) => {
            let message = format!("`{number}` is not a code of `{}`, the enum of {name}", names.of);
            Problem::new(Mistake::UnknownCode, loc, message).help("name one of its codes")
        }
        _ => {
            let message = format!("`{number}` does not fit in the {} of {name}", bits_text(width));
            Problem::new(Mistake::TooLarge, loc, message)
                .help("a number takes the width and the sign of the declaration")
        }
    };
    elaboration::with(|e| e.report_instead_of(stand_in.as_slice(), problem));
    Bits::zero(width)
}

/// The value for a field whose present value is `field`.
#[track_caller]
pub(crate) fn value_of_field(value: Value, field: Signal) -> Value {
    let Value::Literal(number) = value else { return value };
    let id = field.id();
    let name = || elaboration::draft(|draft| format!("`{}`", draft.describe(id)));
    let bits = number_of_field(&number, name, (field.width, field.kind), Some(id));
    Value::Literal(Literal::Exact(bits))
}
