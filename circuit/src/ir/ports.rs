//! Clocks, inputs and outputs of a module.

use super::{ClockId, Kind, NodeId};
use crate::clock::Period;
use crate::edge::Edge;
use crate::reset::Reset;

/// A clock port of a module, and its reset.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// def!(late = m.pipe(i.word));
/// #     ShownOut { late }
/// # };
/// let clock = &design.top().clocks[0];
/// assert_eq!((&*clock.port, clock.name), ("clk", None));
/// assert_eq!(clock.reset, None); // a pipeline register has no reset, so the module has no reset port
/// assert_eq!(clock.kind, Reset::Synchronous);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Clock {
    /// The clock port's name in Verilog: `clk` for the default clock, `NAME_clk` for a named one.
    pub port: String,
    /// The reset port's name: `rst` or `NAME_rst`, with `_n` if it is active low. `None` if nothing on this clock has a
    /// reset.
    pub reset: Option<String>,
    /// The kind of reset; [`Reset::Synchronous`] if nothing on this clock depends on it.
    pub kind: Reset,
    /// The edge at which everything on the clock acts.
    pub edge: Edge,
    /// The period; `None` for the default clock of a module, which takes the clock that its instance is given. At the
    /// top of a design, every clock has a period.
    pub period: Option<Period>,
    /// The clock's name; `None` for the default clock.
    pub name: Option<&'static str>,
}

/// An input port.
///
/// ```
/// # use tilewright_hdl::*;
/// bundle! { struct Pixel<T> { z: T, rgb: T } }
/// # block! {
/// #     struct Shown;
/// in ShownIn { left: Pixel { z: bits(16), rgb: bits(24) } }
/// #     out ShownOut { depth: bits(16) }
/// # }
/// # impl Shown {
/// #     fn build(&self, m: Module, i: ShownIn) -> ShownOut {
/// #         m.ignore(&i.left.rgb);
/// #         ShownOut { depth: i.left.z }
/// #     }
/// # }
/// # let design = elaborate(&Shown)?;
///
/// let port = &design.top().inputs[1];
/// assert_eq!((&*port.name, &*port.path), ("left_rgb", "left.rgb"));
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone)]
pub struct Input {
    /// The port's name: the path of the bundle's fields joined by `_`.
    pub name: String,
    /// The path in the bundle, such as `left.z`.
    pub path: String,
    /// The [`Op::Input`](super::Op::Input) node.
    pub node: NodeId,
    /// The clock to which its values are synchronous; `None` in a module without clocks.
    pub clock: Option<ClockId>,
}

/// An output port.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { same: bits(8).signed() }
/// let same = i.word.signed();
/// #     ShownOut { same }
/// # };
/// // No operation: the bits are only read in another way.
/// let (top, output) = (design.top(), &design.top().outputs[0]);
/// assert_eq!(output.node, top.inputs[0].node);
/// assert_eq!((output.kind, top.node(output.node).kind), (ir::Kind::Signed, ir::Kind::Number));
/// ```
#[derive(Debug, Clone)]
pub struct Output {
    /// The port's name: the path of the bundle's fields joined by `_`.
    pub name: String,
    /// The path in the bundle, such as `pixel.z`.
    pub path: String,
    /// The driver.
    pub node: NodeId,
    /// The meaning of its bits, which may differ from that of its driver's.
    pub kind: Kind,
}
