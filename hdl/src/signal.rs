//! Signals: handles to the expressions of a circuit, and what may be done with them.

use crate::bits::Bits;
use crate::elaboration::{self, Elaboration};
use crate::ir::{Binary, Kind, Node, NodeId, Op, Relation, Shape, Unary};
use crate::limits::{WIDEST, sound_width};
use crate::loc::Loc;
use crate::operand::{Operand, Value, operators};
use crate::problem::Problem;
use crate::shaping::level;
use crate::width::IntoWidth;
use std::ops::Range;

/// An unsigned value in the circuit, 1 to 1,048,576 bits wide; the width is known while the circuit is built.
///
/// `+ - & | ^` need operands of equal widths and wrap; `*` gives the sum of the widths. A change of width is always
/// spelled: [`zext`](Signal::zext), [`sext`](Signal::sext), [`trunc`](Signal::trunc), [`slice`](Signal::slice),
/// [`cat!`](crate::cat!). An integer on the right takes the width of the left, and must fit. Signals are compared with
/// [`eq`](Signal::eq) and its like; `==` does not compile.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let (sum, carry): (Signal, Signal) = (lit(8, 200) + 100, lit(8, 200).add_carry(100).msb());
/// m.assert(sum.eq(44) & carry, "results wrap, unless a carry is asked for");
/// # });
/// ```
#[derive(Debug, Clone, Copy)]
#[must_use]
pub struct Signal {
    pub(crate) stamp: u32,
    pub(crate) module: u32,
    pub(crate) node: NodeId,
    pub(crate) width: u32,
    pub(crate) shape: Shape,
    pub(crate) kind: Kind,
}

/// A handle from an elaboration that has ended is a mistake in Rust code, not in the hardware: a panic.
pub(crate) fn check_stamp(e: &Elaboration, stamp: u32, loc: Loc) {
    assert!(
        stamp == e.stamp,
        "a signal of an earlier elaboration is used, at {loc}: signals live only while theirs runs"
    );
}

impl Signal {
    /// Adds a node to the module under construction.
    #[track_caller]
    pub(crate) fn make(op: Op, width: u32, shape: Shape) -> Signal {
        let loc = Loc::caller();
        elaboration::with(|e| Signal::make_in(e, op, width, shape, loc))
    }

    /// As [`Signal::make`], at `loc`: for closures, which are their own callers.
    pub(crate) fn make_at(op: Op, width: u32, shape: Shape, loc: Loc) -> Signal {
        elaboration::with(|e| Signal::make_in(e, op, width, shape, loc))
    }

    pub(crate) fn make_in(e: &mut Elaboration, op: Op, width: u32, shape: Shape, loc: Loc) -> Signal {
        let node = e.draft().add(op, width, shape, loc);
        Signal::at(e, node)
    }

    /// This new node, whose bits stand for what those of `like` do.
    pub(crate) fn kept_as(self, kind: Kind) -> Signal {
        if self.kind != kind {
            elaboration::draft(|draft| draft.node_mut(self.node).kind = kind);
        }
        Signal { kind, ..self }
    }

    /// As [`Signal::kept_as`], within [`elaboration::with`].
    pub(crate) fn kept_in(self, e: &mut Elaboration, kind: Kind) -> Signal {
        e.draft().node_mut(self.node).kind = kind;
        Signal { kind, ..self }
    }

    /// A zero, where a mistake leaves nothing better.
    pub(crate) fn zero_in(e: &mut Elaboration, width: u32, shape: Shape, kind: Kind, loc: Loc) -> Signal {
        Signal::make_in(e, Op::Const(Bits::zero(width)), width, shape, loc).kept_in(e, kind)
    }

    /// The handle of a node of the module under construction.
    pub(crate) fn at(e: &mut Elaboration, node: NodeId) -> Signal {
        let (stamp, draft) = (e.stamp, e.draft());
        let &Node { width, shape, kind, .. } = draft.node(node);
        Signal { stamp, module: draft.serial, node, width, shape, kind }
    }

    /// The node in the module under construction; a signal of another module is a problem, and stands in as zero.
    #[track_caller]
    pub(crate) fn id(self) -> NodeId {
        self.id_at(Loc::caller())
    }

    /// As [`Signal::id`], used at `loc`: for closures, which are their own callers.
    pub(crate) fn id_at(self, loc: Loc) -> NodeId {
        elaboration::with(|e| {
            check_stamp(e, self.stamp, loc);
            if e.draft().serial == self.module {
                return self.node;
            }
            let block = e.draft().block;
            let owner = e.drafts.iter_mut().find(|draft| draft.serial == self.module);
            let problem = match owner {
                Some(owner) => {
                    owner.in_problems.insert(self.node);
                    let place = owner.node(self.node).loc;
                    let what = owner.describe(self.node);
                    let message = format!("`{what}` belongs to `{}` but is used inside of `{block}`", owner.block);
                    Problem::new(loc, message).note(format!("`{what}` is made"), place)
                }
                None => Problem::new(loc, format!("a signal of a module already finished is used inside of `{block}`")),
            };
            e.report(problem.help("give the block an input for it"));
            e.draft().add(Op::Const(Bits::zero(self.width)), self.width, self.shape, loc)
        })
    }

    /// The signal, used at `loc`; a stand-in if it is another module's.
    pub(crate) fn here(self, loc: Loc) -> Signal {
        Signal { node: self.id_at(loc), ..self }
    }

    /// The width in bits, of each lane.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let word = lit(12, 0xabc);
    /// let upper_half = word.part(word.width() / 2, word.width() / 2);
    /// m.assert(upper_half.eq(0b101010), "a helper needs not be told how wide its signals are");
    /// # });
    /// ```
    pub fn width(self) -> u32 {
        self.width
    }

    /// Names the net; waves and Verilog show it by this name. [`net!`](crate::net!) does it for a `let`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// let count = m.reg("count", 2).reset(0);
    /// count.next(count + 1);
    /// for bit in 0..2 {
    ///     // A name that is made; `net!` names a net after its variable.
    ///     let _ = count.bit(bit).named(&format!("count_bit{bit}"));
    /// }
    /// # });
    /// assert_eq!(example.values("count_bit1"), [0, 0, 1, 1]);
    /// ```
    #[track_caller]
    pub fn named(self, name: &str) -> Signal {
        let (loc, id) = (Loc::caller(), self.id());
        elaboration::with(|e| {
            let node = e.draft().node_mut(id);
            // A port or a register keeps its own name: the net is an alias.
            let has_own = node.name.is_some() || matches!(node.op, Op::Input(_) | Op::Const(_));
            let id = if has_own { e.draft().add(Op::Wire(id), self.width, self.shape, loc) } else { id };
            let node = e.draft().node_mut(id);
            node.kind = self.kind;
            node.name = Some(name.to_owned());
            node.loc = loc;
            Signal::at(e, id)
        })
    }

    #[track_caller]
    fn unary(self, op: Unary) -> Signal {
        let width = if op == Unary::Not { self.width } else { 1 };
        let kind = if op == Unary::Not && self.kind == Kind::Signed { Kind::Signed } else { Kind::Number };
        Signal::make(Op::Unary(op, self.id()), width, self.shape).kept_as(kind)
    }

    #[track_caller]
    pub(crate) fn binary(self, op: Binary, right: impl Operand) -> Signal {
        let left = self.computable(op.symbol());
        let right = right.operand().with_width_of(left, op.symbol());
        let [left, right] = level([left, right], op.symbol());
        Signal::make(Op::Binary(op, left.id(), right.id()), left.width, left.shape).kept_as(left.kind)
    }

    #[track_caller]
    pub(crate) fn compare(self, relation: Relation, right: Signal) -> Signal {
        let signed = self.kind == Kind::Signed;
        let [left, right] = level([self, right], relation.method());
        Signal::make(Op::Compare { relation, signed, operands: [left.id(), right.id()] }, 1, left.shape)
    }

    #[track_caller]
    fn relate(self, relation: Relation, right: impl Operand) -> Signal {
        let left =
            if matches!(relation, Relation::Eq | Relation::Ne) { self } else { self.computable(relation.method()) };
        let right = right.operand().with_width_of(left, relation.method());
        left.compare(relation, right)
    }

    /// 1 bit: equal.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let count = m.reg("count", 2).reset(0);
    /// count.when(count.eq(2), 0).otherwise(count + 1);
    /// m.assert(!count.eq(3), "a number takes the width of the signal, here 2 bits");
    /// # });
    /// ```
    #[track_caller]
    pub fn eq(self, right: impl Operand) -> Signal {
        self.relate(Relation::Eq, right)
    }

    /// 1 bit: not equal.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let left = m.reg("left", 4).reset(9);
    /// left.when(left.ne(0), left - 1);
    /// m.assert(left.ne(0).eq(left.any_one()), "not 0 is: some bit is one");
    /// # });
    /// ```
    #[track_caller]
    pub fn ne(self, right: impl Operand) -> Signal {
        self.relate(Relation::Ne, right)
    }

    /// 1 bit: less than, in two's complement if both are signed.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// m.assert(lit(4, 0b0111).lt(0b1000), "7 < 8");
    /// m.assert(lit(4, 0b1000).signed().lt(7), "-8 < 7");
    /// # });
    /// ```
    #[track_caller]
    pub fn lt(self, right: impl Operand) -> Signal {
        self.relate(Relation::Lt, right)
    }

    /// 1 bit: less than or equal, in two's complement if both are signed.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let count = m.reg("count", 4).reset(0);
    /// count.when(count.lt(12), count + 1);
    /// m.assert(count.le(12), "it counts up to 12, with that");
    /// # });
    /// ```
    #[track_caller]
    pub fn le(self, right: impl Operand) -> Signal {
        self.relate(Relation::Le, right)
    }

    /// 1 bit: greater than, in two's complement if both are signed.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// m.assert(lit(8, 255).gt(1), "255 > 1");
    /// m.assert(!lit(8, 255).signed().gt(1), "-1 is not");
    /// # });
    /// ```
    #[track_caller]
    pub fn gt(self, right: impl Operand) -> Signal {
        self.relate(Relation::Gt, right)
    }

    /// 1 bit: greater than or equal, in two's complement if both are signed.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let sum = lit(8, 200).add_carry(lit(8, 100));
    /// m.assert(sum.ge(256), "300, in the 9 bits that a sum with its carry has");
    /// # });
    /// ```
    #[track_caller]
    pub fn ge(self, right: impl Operand) -> Signal {
        self.relate(Relation::Ge, right)
    }

    /// 1 bit: every bit is one.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let lanes_done = cat!(lit(1, 1), lit(1, 1), lit(1, 0));
    /// m.assert(!lanes_done.all_ones() & (lanes_done | 1).all_ones(), "Verilog's `&word`");
    /// # });
    /// ```
    #[track_caller]
    pub fn all_ones(self) -> Signal {
        self.unary(Unary::AllOnes)
    }

    /// 1 bit: some bit is one.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let requests = lit(4, 0b0100);
    /// m.assert(requests.any_one() & !(requests & 0b1011).any_one(), "Verilog's `|word`");
    /// # });
    /// ```
    #[track_caller]
    pub fn any_one(self) -> Signal {
        self.unary(Unary::AnyOne)
    }

    /// 1 bit: the number of ones is odd.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let byte = lit(8, 0b0110_0100);
    /// m.assert(byte.parity(), "three ones");
    /// m.assert(!cat!(byte, byte.parity()).parity(), "with its parity a word has an even number of them");
    /// # });
    /// ```
    #[track_caller]
    pub fn parity(self) -> Signal {
        self.unary(Unary::Parity)
    }

    #[track_caller]
    pub(crate) fn inverted(self) -> Signal {
        self.unary(Unary::Not)
    }

    /// The sum with its carry: one bit wider than the operands.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let sum = lit(8, 0xff).add_carry(1);
    /// m.assert(sum.eq(0x100), "9 bits: the carry is the top one");
    /// // Of signed operands the sign is kept.
    /// m.assert(lit(8, 0x80).signed().add_carry(-1).eq(-129), "no overflow");
    /// # });
    /// ```
    #[track_caller]
    pub fn add_carry(self, right: impl Operand) -> Signal {
        let right = right.operand().with_width_of(self, "add_carry");
        let signed = self.kind == Kind::Signed;
        self.extend(self.width + 1, signed).binary(Binary::Add, right.extend(self.width + 1, signed))
    }

    /// The product, in two's complement if both are signed; its width is the sum of the operands' widths.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let area = lit(8, 200).times(lit(4, 10));
    /// m.assert(area.eq(2000), "12 bits, so that no product overflows");
    /// // `*` does the same, and takes a number too.
    /// m.assert((lit(8, 200) * 10).eq(2000), "10 has 4 bits");
    /// # });
    /// ```
    #[track_caller]
    pub fn times(self, right: Signal) -> Signal {
        let loc = Loc::caller();
        let op = if self.kind == Kind::Signed { Binary::MulSigned } else { Binary::Mul };
        let left = self.computable(op.symbol());
        let right = right.of_kind_of(left, op.symbol());
        let width = u64::from(self.width) + u64::from(right.width);
        let [left, right] = level([left, right], op.symbol());
        let (shape, left, right) = (left.shape, left.id(), right.id());
        elaboration::with(|e| {
            let sound = sound_width(e, &[left, right], "a product", width, loc);
            let op = if width == sound.into() { Op::Binary(op, left, right) } else { Op::Const(Bits::zero(sound)) };
            Signal::make_in(e, op, sound, shape, loc)
        })
        .kept_as(self.kind)
    }

    /// Bit `index`, counted from the least significant.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let flags = lit(4, 0b0100);
    /// m.assert(flags.bit(2) & !flags.bit(3), "a condition as it is, 1 bit");
    /// # });
    /// ```
    #[track_caller]
    pub fn bit(self, index: u32) -> Signal {
        self.slice(index..index + 1)
    }

    /// The most significant bit.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let timer = m.reg("timer", 5).reset(9);
    /// timer.when(!timer.msb(), timer - 1);
    /// m.assert(timer.msb().implies(timer.all_ones()), "below 0 the top bit ends it, and no comparator is needed");
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
    /// m.assert(cat!(word.slice(4..12), word.slice(0..4)).eq(word), "ranges that meet leave nothing out");
    /// # });
    /// ```
    #[track_caller]
    pub fn slice(self, range: Range<u32>) -> Signal {
        if range.start >= range.end || range.end > self.width {
            return self.bits().bad_width(
                format!("the slice {}..{} is outside of", range.start, range.end),
                range.end.saturating_sub(range.start).max(1),
                format!("a slice is `low..high` with low < high <= {}", self.width),
            );
        }
        if range == (0..self.width) {
            return self.bits();
        }
        Signal::make(Op::Slice { of: self.id(), low: range.start }, range.end - range.start, self.shape)
    }

    /// The lowest `width` bits: a number of them, or as in `used.trunc(below(pages))`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let used = lit(up_to(12), 12);
    /// m.assert(used.trunc(2).eq(0), "the upper bits are lost");
    /// m.assert(lit(8, 0xfe).signed().trunc(4).eq(-2), "what is signed stays so");
    /// # });
    /// ```
    #[track_caller]
    pub fn trunc(self, width: impl IntoWidth) -> Signal {
        let width = width.into_width().bits;
        if width == 0 || width > self.width {
            return self.bad_width(
                format!("`.trunc({width})` cannot cut"),
                width.max(1),
                "`.zext(n)` and `.sext(n)` widen".to_owned(),
            );
        }
        if width == self.width {
            return self;
        }
        let kind = if self.kind == Kind::Signed { Kind::Signed } else { Kind::Number };
        self.slice(0..width).kept_as(kind)
    }

    /// Widened with zeros to `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let page = lit(4, 11);
    /// let address = page.zext(16) << 8;
    /// m.assert(address.eq(0xb00), "room first, as a shift keeps the width");
    /// # });
    /// ```
    #[track_caller]
    pub fn zext(self, width: impl IntoWidth) -> Signal {
        self.extend(width.into_width().bits, false)
    }

    /// Widened with copies of the most significant bit to `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let step = lit(4, 0b1110);
    /// m.assert(step.sext(8).eq(0xfe), "-2 in 4 bits is -2 in 8");
    /// m.assert(step.sext(8).signed().eq(-2), "and read so where it is signed");
    /// # });
    /// ```
    #[track_caller]
    pub fn sext(self, width: impl IntoWidth) -> Signal {
        self.extend(width.into_width().bits, true)
    }

    #[track_caller]
    fn extend(self, width: u32, signed: bool) -> Signal {
        if width < self.width {
            let name = if signed { "sext" } else { "zext" };
            return self.bad_width(
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
                format!("`.zext({width})` would lose the sign of"),
                width,
                "`.sext(n)` widens what is signed; `.bits()` reads it as unsigned".to_owned(),
            );
        }
        if width > WIDEST {
            let name = if signed { "sext" } else { "zext" };
            let what = format!("`.{name}({width})` makes more than {WIDEST} bits of");
            return self.bad_width(what, 1, "widen less".to_owned());
        }
        let kind = if self.kind == Kind::Signed { Kind::Signed } else { Kind::Number };
        Signal::make(Op::Extend { of: self.id(), signed }, width, self.shape).kept_as(kind)
    }

    #[track_caller]
    fn bad_width(self, what: String, width: u32, help: String) -> Signal {
        let (loc, id) = (Loc::caller(), self.id());
        elaboration::with(|e| {
            let draft = e.draft();
            let (name, place) = (draft.describe(id), draft.node(id).loc);
            let message = format!("{what} `{name}`, which has {}", bits_text(self.width));
            e.report_instead_of(&[id], Problem::new(loc, message).note(format!("`{name}` is made"), place).help(help));
            Signal::zero_in(e, width, self.shape, self.kind, loc)
        })
    }

    /// The signal side by side with itself, `times` times.
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
    pub fn repeat(self, times: u32) -> Signal {
        if times == 0 {
            return self.bad_width("`.repeat(0)` leaves nothing of".to_owned(), 1, "repeat at least once".to_owned());
        }
        if times == 1 {
            return self;
        }
        let Some(width) = self.width.checked_mul(times).filter(|width| *width <= WIDEST) else {
            let what = format!("`.repeat({times})` makes more than {WIDEST} bits of");
            return self.bad_width(what, 1, "repeat less often".to_owned());
        };
        Signal::make(Op::Repeat(self.id(), times), width, self.shape)
    }

    /// Declares that another clock may sample this signal as it is, because it is stable whenever that happens. The
    /// reason is printed beside it in the Verilog.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const HOST: Clock = Clock::new("host", Period::ns(30));
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40));
    ///
    /// block! {
    ///     /// Shows a colour that the host sets while the screen is dark.
    ///     struct Border;
    ///     in BorderIn { colour: bits(24).on(HOST) }
    ///     out BorderOut { rgb: bits(24) }
    /// }
    ///
    /// impl Border {
    ///     fn build(&self, m: Module, i: BorderIn) -> BorderOut {
    ///         let held = m.on(HOST).pipe("held", i.colour);
    ///         let colour = held.quasi_static("it is set while the screen is dark");
    ///         BorderOut { rgb: m.on(VIDEO).pipe("rgb", colour) }
    ///     }
    /// }
    ///
    /// // Without the reason, `rgb` samples a register of another clock, which is a problem.
    /// elaborate(&Border)?;
    /// # Ok::<(), Problems>(())
    /// ```
    #[track_caller]
    pub fn quasi_static(self, reason: &str) -> Signal {
        Signal::make(Op::QuasiStatic(self.id(), reason.to_owned()), self.width, self.shape).kept_as(self.kind)
    }
}

/// `1 bit`, `8 bits`.
pub(crate) fn bits_text(width: u32) -> String {
    if width == 1 { "1 bit".to_owned() } else { format!("{width} bits") }
}

impl Operand for Signal {
    fn operand(self) -> Value {
        Value::Signal(self)
    }
}

operators!(Signal);
