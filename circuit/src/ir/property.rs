//! Properties of a circuit, and attributes for synthesizers.

use super::{ClockId, NodeId, Shown};
use crate::loc::Loc;

/// A property: a condition that is checked in every lane, at every edge of its clock while that clock's reset is low.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), empty: bit() } out { taken: bit() }
/// m.assert(i.take.implies(!i.empty), "nothing is taken while it is empty");
/// #     ShownOut { taken: i.take }
/// # };
/// let (top, property) = (design.top(), &design.top().properties[0]);
/// assert_eq!((top.width(property.condition), &*property.message), (1, "nothing is taken while it is empty"));
/// ```
#[derive(Debug, Clone)]
pub struct Property {
    /// The kind of property.
    pub directive: Directive,
    /// Its clock.
    pub clock: ClockId,
    /// 1 bit, of any shape.
    pub condition: NodeId,
    /// The error message if the condition is false; for a cover, the event that it counts; for a display, its text,
    /// as [`Piece::of`](super::Piece::of) reads it.
    pub message: String,
    /// For a display, the values in its text.
    pub values: Vec<Shown>,
    /// The place in the description.
    pub loc: Loc,
}

impl Property {
    /// The nodes that it looks at: the values of a display, and the condition.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), page: bits(4) } out { taken: bit() }
    /// m.display(i.take, "page {} is taken", &[i.page]);
    /// #     ShownOut { taken: i.take }
    /// # };
    /// let top = design.top();
    /// let widths: Vec<_> = top.properties[0].nodes().map(|node| top.width(node)).collect();
    /// assert_eq!(widths, [4, 1]);
    /// ```
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> {
        self.values.iter().map(|shown| shown.node).chain([self.condition])
    }
}

/// The kind of a [`Property`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), empty: bit() } out { taken: bit() }
/// m.assume(i.take.implies(!i.empty), "nothing is taken while it is empty");
/// m.cover("something is taken", i.take);
/// #     ShownOut { taken: i.take }
/// # };
/// let directives: Vec<_> = design.top().properties.iter().map(|property| property.directive).collect();
/// assert_eq!(directives, [ir::Directive::Assume, ir::Directive::Cover]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Directive {
    /// The condition is always true; if not, the circuit is wrong.
    Assert,
    /// The condition is always true; if not, the stimulus is wrong.
    Assume,
    /// The condition is true at some time.
    Cover,
    /// Where the condition is true, a simulation shows a text.
    Display,
}

impl Directive {
    /// The property in messages.
    #[doc(hidden)]
    pub fn noun(self) -> &'static str {
        match self {
            Directive::Assert => "an assertion",
            Directive::Assume => "an assumption",
            Directive::Cover => "a cover",
            Directive::Display => "a display",
        }
    }
}

/// An attribute for synthesizers, as Verilog's `(* ram_style = "block" *)`.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// def!(late = m.reg(8).attribute("keep", "true"));
/// late.next(i.word);
/// #     ShownOut { late: *late }
/// # };
/// let keep = ir::Attribute { name: "keep".to_owned(), value: "true".to_owned() };
/// assert_eq!(design.top().registers[0].attributes, [keep]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attribute {
    /// The name, a plain identifier.
    pub name: String,
    /// The value, as text.
    pub value: String,
}
