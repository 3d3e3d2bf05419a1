//! What is stated of a circuit, and said to synthesizers.

use super::{ClockId, NodeId};
use crate::loc::Loc;

/// A statement about a condition, in every lane, at every edge of its clock while that clock's reset is low.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), empty: bit() } out { taken: bit() }
/// m.assert(i.take.implies(!i.empty), "nothing is taken of what is empty");
/// #     ShownOut { taken: i.take }
/// # };
/// let (top, property) = (design.top(), &design.top().properties[0]);
/// assert_eq!((top.width(property.condition), &*property.message), (1, "nothing is taken of what is empty"));
/// ```
#[derive(Debug, Clone)]
pub struct Property {
    /// What is stated.
    pub directive: Directive,
    /// Its clock.
    pub clock: ClockId,
    /// 1 bit, of any shape.
    pub condition: NodeId,
    /// What is wrong if it does not hold; of a cover, what it is that happens.
    pub message: String,
    /// Where it is stated.
    pub loc: Loc,
}

/// What a [`Property`] states of its condition.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), empty: bit() } out { taken: bit() }
/// m.assume(i.take.implies(!i.empty), "nothing is taken of what is empty");
/// m.cover("something is taken", i.take);
/// #     ShownOut { taken: i.take }
/// # };
/// let directives: Vec<_> = design.top().properties.iter().map(|property| property.directive).collect();
/// assert_eq!(directives, [ir::Directive::Assume, ir::Directive::Cover]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Directive {
    /// It always holds; if not, the circuit is wrong.
    Assert,
    /// It always holds; if not, what the inputs are given is wrong.
    Assume,
    /// It holds at some time.
    Cover,
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
    /// The value, a text.
    pub value: String,
}
