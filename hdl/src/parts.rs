//! Changes of width: parts and extensions of a signal.

use crate::elaboration;
use crate::integers::Integer;
use crate::limits::WIDEST;
use crate::names::bits_text;
use crate::signal::Signal;
use crate::width::IntoWidth;
use std::ops::Range;
use tilewright_circuit::ir::{Kind, Op};
use tilewright_circuit::{Loc, Mistake, Problem};

impl Signal {
    /// Bit `index`, counted from the least significant.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let flags = lit(4, 0b0100);
    /// m.assert(flags.bit(2) & !flags.bit(3), "a bit is a condition");
    /// # });
    /// ```
    #[track_caller]
    pub fn bit(self, index: impl Integer) -> Signal {
        self.between(index.integer(), 1)
    }

    /// The most significant bit.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(timer = m.reg(5).reset(9));
    /// timer.when(!timer.msb(), timer - 1);
    /// m.assert(timer.msb().implies(timer.all_ones()), "the top bit tells that it is below 0, without a comparator");
    /// # });
    /// ```
    #[track_caller]
    pub fn msb(self) -> Signal {
        self.bit(self.width - 1)
    }

    /// The bits of `range`, lowest first and the end not included: `z.slice(0..12)` is Verilog's `z[11:0]`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let word = lit(12, 0xabc);
    /// m.assert(word.slice(4..12).eq(0xab), "8 bits");
    /// m.assert(cat![word.slice(4..12), word.slice(0..4)].eq(word), "adjacent ranges cover all bits");
    /// # });
    /// ```
    #[track_caller]
    pub fn slice<N: Integer>(self, range: Range<N>) -> Signal {
        let (low, high) = (range.start.integer(), range.end.integer());
        if low > high {
            let end = low.saturating_add(1);
            return self.bits().bad_width(
                Mistake::SliceOutside,
                format!("the slice {low}..{high} takes no bits of"),
                end.saturating_sub(high).clamp(1, WIDEST.into()) as u32,
                format!("the lower bound comes first: bits {low} down to {high} are `.slice({high}..{end})`"),
            );
        }
        self.between(low, high.saturating_sub(low))
    }

    /// `count` bits from bit `low` on.
    #[track_caller]
    pub(crate) fn between(self, low: i128, count: i128) -> Signal {
        let high = low.saturating_add(count);
        if low < 0 || count < 1 || high > self.width.into() {
            return self.bits().bad_width(
                Mistake::SliceOutside,
                format!("the slice {low}..{high} is outside of"),
                count.clamp(1, WIDEST.into()) as u32,
                format!("a slice is `low..high` with low < high <= {}", self.width),
            );
        }
        if count == self.width.into() {
            return self.bits();
        }
        Signal::make(Op::Slice { of: self.id(), low: low as u32 }, count as u32, self.shape)
    }

    /// The lowest `width` bits: a number, or a width as in `used.trunc(below(pages))`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let used = lit(up_to(12), 12);
    /// m.assert(used.trunc(2).eq(0), "the upper bits are lost");
    /// m.assert(lit(8, 0xfe).signed().trunc(4).eq(-2), "a signed value stays signed");
    /// # });
    /// ```
    #[track_caller]
    pub fn trunc(self, width: impl IntoWidth) -> Signal {
        let width = width.into_width().bits;
        if width == 0 || width > self.width {
            return self.bad_width(
                Mistake::CutsNothing,
                format!("`.trunc({width})` cannot cut"),
                width.clamp(1, WIDEST),
                "`.zext(n)` and `.sext(n)` widen".to_owned(),
            );
        }
        if width == self.width {
            return self;
        }
        let kind = if self.kind == Kind::Signed { Kind::Signed } else { Kind::Number };
        self.slice(0..width).kept_as(kind)
    }

    /// Zero-extended to `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let page = lit(4, 11);
    /// let address = page.zext(16) << 8;
    /// m.assert(address.eq(0xb00), "widen first, because a shift keeps the width");
    /// # });
    /// ```
    #[track_caller]
    pub fn zext(self, width: impl IntoWidth) -> Signal {
        self.extend(width.into_width().bits, false)
    }

    /// Sign-extended to `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let step = lit(4, 0b1110);
    /// m.assert(step.sext(8).eq(0xfe), "-2 in 4 bits is -2 in 8");
    /// m.assert(step.sext(8).signed().eq(-2), "also if it is signed");
    /// # });
    /// ```
    #[track_caller]
    pub fn sext(self, width: impl IntoWidth) -> Signal {
        self.extend(width.into_width().bits, true)
    }

    #[track_caller]
    pub(crate) fn extend(self, width: u32, signed: bool) -> Signal {
        if width < self.width {
            let name = if signed { "sext" } else { "zext" };
            return self.bad_width(
                Mistake::WidensNothing,
                format!("`.{name}({width})` cannot widen"),
                width.max(1),
                "`.trunc(n)` and slices cut".to_owned(),
            );
        }
        if width == self.width {
            return self;
        }
        if self.kind == Kind::Signed && !signed {
            return self.bad_width(
                Mistake::LostSign,
                format!("`.zext({width})` would lose the sign of"),
                width,
                "`.sext(n)` widens what is signed; `.bits()` reads it as unsigned".to_owned(),
            );
        }
        if width > WIDEST {
            let name = if signed { "sext" } else { "zext" };
            let what = format!("`.{name}({width})` makes more than {WIDEST} bits of");
            return self.bad_width(Mistake::TooWide, what, 1, "widen less".to_owned());
        }
        let kind = if self.kind == Kind::Signed { Kind::Signed } else { Kind::Number };
        Signal::make(Op::Extend { of: self.id(), signed }, width, self.shape).kept_as(kind)
    }

    #[track_caller]
    fn bad_width(self, mistake: Mistake, what: String, width: u32, help: String) -> Signal {
        let (loc, id) = (Loc::caller(), self.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let (name, place) = (draft.describe(id), draft.node(id).loc);
            let message = format!("{what} `{name}`, which has {}", bits_text(self.width));
            e.report_instead_of(
                &[id],
                Problem::new(mistake, loc, message).note(format!("`{name}` is made"), place).help(help),
            );
            Signal::zero_in(e, width, self.shape, self.kind, loc)
        })
    }

    /// `times` copies of the signal, side by side.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let enable = lit(1, 1);
    /// m.assert((lit(8, 0xa5) & enable.repeat(8)).eq(0xa5), "a mask of one bit");
    /// m.assert(lit(4, 0x5).repeat(3).eq(0x555), "12 bits");
    /// # });
    /// ```
    #[track_caller]
    pub fn repeat(self, times: impl Integer) -> Signal {
        let times = times.integer();
        if times < 1 {
            return self.bad_width(
                Mistake::NoRepetition,
                format!("`.repeat({times})` leaves nothing of"),
                1,
                "repeat at least once".to_owned(),
            );
        }
        if times == 1 {
            return self.bits();
        }
        let width = times.saturating_mul(self.width.into());
        if width > WIDEST.into() {
            let what = format!("`.repeat({times})` makes more than {WIDEST} bits of");
            return self.bad_width(Mistake::TooWide, what, 1, "repeat less often".to_owned());
        }
        Signal::make(Op::Repeat(self.id(), times as u32), width as u32, self.shape)
    }
}
