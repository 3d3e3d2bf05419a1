//! Registers, and their values at the start.

use super::{Attribute, ClockId, NodeId};
use crate::bits::Bits;

/// The values of a register's lanes after a reset.
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Shown;
/// #     out ShownOut { next: _ }
/// # }
/// # impl Shown {
/// #     fn build(&self, m: Module, _: ()) -> ShownOut {
/// def!(ring = m.reg(bits(4).of(row(3))).reset_each([7, 8, 9]));
/// ring.next(ring.previous(ring.last()));
/// #         ShownOut { next: *ring }
/// #     }
/// # }
/// # let design = elaborate(&Shown)?;
/// let reset = design.top().registers[0].reset.as_ref();
/// assert_eq!(reset, Some(&ir::Init::Each([7, 8, 9].map(|value| Bits::new(4, value)).into())));
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Init {
    /// The same in every lane; a plain register always has this form.
    Same(Bits),
    /// A value for each lane, in row-major order.
    Each(Vec<Bits>),
}

impl Init {
    /// The value of one lane, counted in row-major order.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let zeros = ir::Init::Same(Bits::zero(8));
    /// assert_eq!(zeros.lane(100), &Bits::zero(8)); // for any number of lanes
    /// ```
    pub fn lane(&self, lane: u32) -> &Bits {
        match self {
            Init::Same(value) => value,
            Init::Each(values) => &values[lane as usize],
        }
    }
}

/// A register, in each of its lanes. At an edge of its clock it takes `reset` if that clock's reset is active and there
/// is a reset value; otherwise it takes `next` if `enable` is absent or high; otherwise it is unchanged.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(8) }
/// def!(count = m.reg(8).reset(5));
/// count.enable(i.enable).next(count + 1);
/// #     ShownOut { count: *count }
/// # };
/// let (top, register) = (design.top(), &design.top().registers[0]);
/// assert_eq!(register.enable, Some(top.inputs[0].node));
/// assert_eq!(register.reset.as_ref().unwrap().lane(0), &Bits::new(8, 5));
/// ```
#[derive(Debug, Clone)]
pub struct Register {
    /// The [`Op::Register`](super::Op::Register) node, which has its name, width, shape and place.
    pub node: NodeId,
    /// Its clock.
    pub clock: ClockId,
    /// The value after a reset, and at power-on unless `initial` differs; `None` if a reset does not affect it. On a
    /// clock of [`Reset::PowerOn`](crate::Reset::PowerOn) it is the value at power-on alone.
    pub reset: Option<Init>,
    /// The value at power-on, the same in each lane; `None` if it is that after a reset, or undefined.
    pub initial: Option<Bits>,
    /// 1 bit, of the register's shape: takes `next` while high. `None` means always.
    pub enable: Option<NodeId>,
    /// The next value.
    pub next: NodeId,
    /// Whether it is one of the two registers of a synchronizer. A synthesizer must not change these, and must place
    /// them close together: `ASYNC_REG` in Verilog.
    pub is_synchronizer: bool,
    /// For synthesizers.
    pub attributes: Vec<Attribute>,
}
