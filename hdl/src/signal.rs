//! Signals: handles to the expressions of a circuit, and their operations.

use crate::elaboration::{self, Elaboration};
use crate::limits::sound_width;
use crate::operand::{Operand, Value, operators};
use crate::shaping::level;
use tilewright_circuit::ir::{Binary, Kind, Node, NodeId, Op, Shape, Unary};
use tilewright_circuit::{Bits, Loc, Mistake, Problem};

/// An unsigned value in the circuit, 1 to 1,048,576 bits wide. Its width is known while the circuit is built.
///
/// `+ - & | ^` need operands of equal widths and wrap; the width of a product is the sum of the operands' widths.
/// Every change of width is explicit: [`zext`](Signal::zext), [`sext`](Signal::sext), [`trunc`](Signal::trunc),
/// [`slice`](Signal::slice), [`cat!`](crate::cat!). An integer on the right takes the width of the left operand and
/// must fit. Compare signals with [`eq`](Signal::eq) and its like; `==` does not compile.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// let (sum, carry): (Signal, Signal) = (lit(8, 200) + 100, lit(8, 200).add_carry(100).msb());
/// m.assert(sum.eq(44) & carry, "results wrap, unless the carry is requested");
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

/// Panics for a handle of an earlier elaboration: that is a mistake in Rust code, not in the hardware.
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

    /// Like [`Signal::make`], at `loc`, for closures.
    pub(crate) fn make_at(op: Op, width: u32, shape: Shape, loc: Loc) -> Signal {
        elaboration::with(|e| Signal::make_in(e, op, width, shape, loc))
    }

    pub(crate) fn make_in(e: &mut Elaboration, op: Op, width: u32, shape: Shape, loc: Loc) -> Signal {
        let node = e.draft().add(op, width, shape, loc);
        Signal::at(e, node)
    }

    /// This new node, read as the same kind of value as `like`.
    pub(crate) fn kept_as(self, kind: Kind) -> Signal {
        if self.kind != kind {
            elaboration::draft(|draft| draft.node_mut(self.node).kind = kind);
        }
        Signal { kind, ..self }
    }

    /// Like [`Signal::kept_as`], within [`elaboration::with`].
    pub(crate) fn kept_in(self, e: &mut Elaboration, kind: Kind) -> Signal {
        e.draft().node_mut(self.node).kind = kind;
        Signal { kind, ..self }
    }

    /// A zero, as a stand-in after a mistake.
    pub(crate) fn zero_in(e: &mut Elaboration, width: u32, shape: Shape, kind: Kind, loc: Loc) -> Signal {
        let zero = Signal::make_in(e, Op::Const(Bits::zero(width)), width, shape, loc).kept_in(e, kind);
        e.draft().stand_ins.insert(zero.node);
        zero
    }

    /// The handle of a node of the module under construction.
    pub(crate) fn at(e: &mut Elaboration, node: NodeId) -> Signal {
        let (stamp, draft) = (e.stamp, e.draft());
        let &Node { width, shape, kind, .. } = draft.node(node);
        Signal { stamp, module: draft.serial, node, width, shape, kind }
    }

    /// The node in the module under construction. A signal of another module is a problem, and a zero stands in.
    #[track_caller]
    pub(crate) fn id(self) -> NodeId {
        self.id_at(Loc::caller())
    }

    /// Like [`Signal::id`], used at `loc`, for closures.
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
                    Problem::new(Mistake::ForeignSignal, loc, message).note(format!("`{what}` is made"), place)
                }
                None => Problem::new(
                    Mistake::ForeignSignal,
                    loc,
                    format!("a signal of a module already finished is used inside of `{block}`"),
                ),
            };
            e.report(problem.help("give the block an input for it"));
            Signal::zero_in(e, self.width, self.shape, self.kind, loc).node
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
    /// m.assert(upper_half.eq(0b101010), "a helper need not be told the width of its signals");
    /// # });
    /// ```
    pub fn width(self) -> u32 {
        self.width
    }

    /// Names the net; waves and Verilog show it by this name. [`def!`](crate::def!) does it for a `let`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(2).reset(0));
    /// count.next(count + 1);
    /// for bit in 0..2 {
    ///     // A computed name; `def!` names a net after its variable.
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
            // A port or register keeps its own name, and the net becomes an alias.
            let has_own = node.name.is_some() || matches!(node.op, Op::Input(_) | Op::Const(_));
            let id = if has_own { e.draft().add(Op::Wire(id), self.width, self.shape, loc) } else { id };
            let name = e.draft().prefixed(name);
            let node = e.draft().node_mut(id);
            node.kind = self.kind;
            node.name = Some(name);
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

    /// 1 bit: every bit is one.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let lanes_done = cat![lit(1, 1), lit(1, 1), lit(1, 0)];
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
    /// m.assert(!cat![byte, byte.parity()].parity(), "with its parity, a word has an even number of ones");
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
    /// // With signed operands, the sign is extended.
    /// m.assert(lit(8, 0x80).signed().add_carry(-1).eq(-129), "no overflow");
    /// # });
    /// ```
    #[track_caller]
    pub fn add_carry(self, right: impl Operand) -> Signal {
        let right = right.operand().with_width_of(self, "add_carry");
        let signed = self.kind == Kind::Signed;
        self.extend(self.width + 1, signed).binary(Binary::Add, right.extend(self.width + 1, signed))
    }

    /// The product, in two's complement if both are signed. Its width is the sum of the operands' widths.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let area = lit(8, 200).times(lit(4, 10));
    /// m.assert(area.eq(2000), "12 bits, so that no product overflows");
    /// // `*` does the same, and also accepts a number.
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
            match width == sound.into() {
                true => Signal::make_in(e, Op::Binary(op, left, right), sound, shape, loc).kept_in(e, self.kind),
                false => Signal::zero_in(e, sound, shape, self.kind, loc),
            }
        })
    }

    /// Declares that another clock may sample this signal without a synchronizer, because it is stable whenever that
    /// happens. The header of the module's Verilog prints the reason.
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
    ///         def!(held = m.on(HOST).pipe(i.colour));
    ///         let colour = held.quasi_static("it is set while the screen is dark");
    ///         BorderOut { rgb: m.on(VIDEO).pipe("rgb", colour) }
    ///     }
    /// }
    ///
    /// // Without the reason, it would be a problem that `rgb` samples a register of another clock.
    /// let design = elaborate(&Border)?;
    /// # let text = &tilewright_gen::verilog(&design)[0].text;
    /// # assert!(text.contains("// Stable      held: it is set while the screen is dark ("), "{text}");
    /// # Ok::<(), Problems>(())
    /// ```
    #[track_caller]
    pub fn quasi_static(self, reason: &str) -> Signal {
        Signal::make(Op::QuasiStatic(self.id(), reason.to_owned()), self.width, self.shape).kept_as(self.kind)
    }
}

impl Operand for Signal {
    fn operand(self) -> Value {
        Value::Signal(self)
    }
}

operators!(Signal);
