//! The module under construction, as a block's `build` sees it.

use crate::codes::{Codes, one_of};
use crate::data::Layout;
use crate::draft::{DraftMemory, DraftRegister, DraftWire, UNDRIVEN};
use crate::elaboration::{self, Elaboration};
use crate::fields::Fields;
use crate::integers::Integer;
use crate::limits::{WIDEST, sound_width};
use crate::machine::StateReg;
use crate::memory::Mem;
use crate::names::port_name;
use crate::operand::{IntoSignal, Operand};
use crate::record::{from_leaves, word};
use crate::register::Reg;
use crate::shaping::sound_shape;
use crate::signal::Signal;
use crate::width::Width;
use crate::wire::Wire;
use std::marker::PhantomData;
use tilewright_circuit::ir::{Contents, Kind, Memory, NodeId, Op, ReadUnderWrite, RegisterId, Shape};
use tilewright_circuit::{Clock, Loc, Mistake, Problem, index_width};

/// The module under construction, with one of its clocks. Its methods declare registers, memories, instances and
/// other objects; expressions are made by the operators of [`Signal`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// // `m` is this block's module; it declares everything that has a name.
/// def!(count = m.reg(8).reset(0));
/// count.next(count + 3);
/// m.assert(count.le(252), "252 is 84 times 3");
/// # });
/// assert_eq!(example.values("count"), [0, 3, 6, 9]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Module {
    pub(crate) clock: Option<Clock>,
}

impl Module {
    /// The same module, with another clock: objects declared through this handle run on `clock`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// const FAST: Clock = Clock::new("fast", Period::ns(5));
    /// const SLOW: Clock = Clock::new("slow", Period::ns(10));
    /// for (clock, name) in [(FAST, "ticks"), (SLOW, "tocks")] {
    ///     let count = m.on(clock).reg(name, 8).reset(0);
    ///     count.next(count + 1);
    /// }
    /// # });
    /// // One value for each instant at which a clock rises: every 5 ns.
    /// assert_eq!(example.values("ticks"), [0, 1, 2, 3, 4, 5]);
    /// assert_eq!(example.values("tocks"), [0, 0, 1, 1, 2, 2]);
    /// ```
    #[track_caller]
    pub fn on(self, clock: Clock) -> Module {
        let loc = Loc::caller();
        elaboration::with(|e| {
            e.meet_clock(clock, loc);
            Module { clock: e.draft().in_use(clock) }
        })
    }

    /// A register. Its width is a number of bits, a width as in `m.reg("used", up_to(pages))`, or a record of widths.
    /// A record makes one register for each field, named `entry_page` for the field `page` of `entry`. If a width
    /// names a clock, its register runs on that clock.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// bundle! { struct Entry<T> { resident: T, page: T } }
    ///
    /// def!(used = m.reg(up_to(12)).reset(0));
    /// used.when(used.ne(12), used + 1);
    /// def!(entry = m.reg(Entry { resident: bit(), page: below(12) }));
    /// entry.next(Entry { resident: used.ne(12), page: *used });
    /// # });
    /// assert_eq!(example.values("used"), [0, 1, 2, 3]);
    /// assert_eq!(example.values("entry_page"), [0, 0, 1, 2]);
    /// ```
    #[track_caller]
    pub fn reg<L: Layout>(self, name: &str, layout: L) -> Reg<L::Value> {
        let loc = Loc::caller();
        let index = elaboration::draft(|draft| draft.registers.len());
        let signal = layout.layout().map_fields("", &mut |path, width| {
            let clock = width.clock.map_or(self.clock, |clock| elaboration::draft(|draft| draft.in_use(clock)));
            clock.into_iter().for_each(|clock| elaboration::with(|e| e.meet_clock(clock, loc)));
            let on = Module { clock };
            on.register(&port_name(name, path), *width, loc).signal
        });
        Reg { signal, index }
    }

    pub(crate) fn register(self, name: &str, width: Width, loc: Loc) -> Reg {
        elaboration::with(|e| {
            let index = e.draft().registers.len();
            let node = declare(e, Op::Register(RegisterId(index as u32)), ("register", name), width, loc);
            let draft = e.draft();
            let clock = draft.use_clock(self.clock);
            draft.registers.push(DraftRegister::new(node, clock, draft.part));
            Reg { signal: Signal::at(e, node), index }
        })
    }

    /// A state machine over the variants of an enum. A reset puts it into `initial`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// codes! { enum Light { Red, Green, Amber } }
    ///
    /// def!(light = m.fsm(Light::Red));
    /// light.next(|light| match light {
    ///     Light::Red => goto(Light::Green),
    ///     Light::Green => goto(Light::Amber),
    ///     Light::Amber => goto(Light::Red),
    /// });
    /// # });
    /// assert_eq!(example.values("light"), [0, 1, 2, 0, 1]);
    /// ```
    #[track_caller]
    pub fn fsm<S: Codes + Operand>(self, name: &str, initial: S) -> StateReg<S> {
        let register = self.register(name, one_of::<S>(), Loc::caller());
        StateReg { register: register.reset(initial), states: PhantomData }
    }

    /// `value`, one clock later: a register without a reset for each field, named `name` or `name_FIELD`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(5));
    /// count.next(count + 1);
    /// def!(late = m.pipe(*count));
    /// let _ = m.pipe("later", late);
    /// # });
    /// assert_eq!(example.values("late"), [0, 5, 6, 7]);
    /// assert_eq!(example.values("later"), [0, 0, 5, 6]);
    /// ```
    #[track_caller]
    pub fn pipe<B: Fields<Signal>>(self, name: &str, value: B) -> B::With<Signal> {
        self.stage(None, name, value)
    }

    /// Like [`Module::pipe`], in a pipeline that advances only where `enable` is high.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(5));
    /// count.next(count + 1);
    /// let _ = m.pipe_when(!count.bit(0), "even", *count);
    /// # });
    /// assert_eq!(example.values("even"), [0, 0, 6, 6, 8, 8]);
    /// ```
    #[track_caller]
    pub fn pipe_when<B: Fields<Signal>>(self, enable: impl IntoSignal, name: &str, value: B) -> B::With<Signal> {
        self.stage(Some(enable.into()), name, value)
    }

    #[track_caller]
    fn stage<B: Fields<Signal>>(self, enable: Option<Signal>, name: &str, value: B) -> B::With<Signal> {
        let loc = Loc::caller();
        // A loop: in a closure, the message would name the closure as the caller.
        let mut registers = Vec::new();
        for (path, signal) in value.leaves() {
            let register = self.register(&port_name(name, &path), Width::like(signal), loc);
            elaboration::draft(|draft| draft.pipelines.delays.insert(register.signal.node));
            if let Some(enable) = enable {
                let _ = register.enable(enable);
            }
            register.next(signal);
            registers.push(*register);
        }
        from_leaves(&value, registers)
    }

    /// A net that is read before it is driven; for a record of widths, a net for each field.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// bundle! { struct Grant<T> { taken: T, page: T } }
    ///
    /// def!(grant = m.wire(Grant { taken: bit(), page: below(12) }));
    /// def!(free = m.reg(below(12)).reset(0));
    /// free.when(grant.taken, grant.page + 1);
    /// grant.drive(Grant { taken: free.lt(11), page: *free });
    /// m.assert(free.le(11), "the wire closes a loop through a register");
    /// # });
    /// ```
    #[track_caller]
    pub fn wire<L: Layout>(self, name: &str, layout: L) -> Wire<L::Value> {
        let loc = Loc::caller();
        let index = elaboration::draft(|draft| draft.wires.len());
        let signal =
            layout.layout().map_fields("", &mut |path, width| self.net(&port_name(name, path), *width, loc).signal);
        Wire { signal, index }
    }

    pub(crate) fn net(self, name: &str, width: Width, loc: Loc) -> Wire {
        elaboration::with(|e| {
            let node = declare(e, Op::Wire(UNDRIVEN), ("wire", name), width, loc);
            let draft = e.draft();
            let index = draft.wires.len();
            draft.wires.push(DraftWire { node, driver: None });
            Wire { signal: Signal::at(e, node), index }
        })
    }

    /// A memory of `depth` words of this width. `policy` says what a synchronous read gives if its word is written at
    /// the same edge. An address has [`index_width`]`(depth)` bits.
    ///
    /// A record of widths makes one memory whose words have the fields side by side, the first most significant.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(2).reset(0));
    /// count.next(count + 1);
    /// def!(squares = m.memory(4, 8, ReadUnderWrite::Any).words((0..4).map(|x| x * x)));
    /// def!(square = squares.read(count));
    /// # });
    /// // The word comes one clock after its address. Nothing writes, so the policy does not matter.
    /// assert_eq!(example.values("square"), [0, 0, 1, 4, 9, 0]);
    /// ```
    #[track_caller]
    pub fn memory<L: Layout>(
        self,
        name: &str,
        depth: impl Integer,
        layout: L,
        policy: ReadUnderWrite,
    ) -> Mem<L::Value> {
        let (depth, layout, loc) = (depth.integer(), layout.layout(), Loc::caller());
        let word = word(&layout, name, loc);
        let is_sound = layout.leaves().iter().all(|(_, width)| (1..=WIDEST).contains(&width.bits));
        let words = self.words(name, depth, (word, is_sound), policy, loc);
        let Mem { stamp, module, index, address_width, word, clock, .. } = words;
        Mem { stamp, module, index, address_width, word, clock, layout }
    }

    fn words(
        self,
        name: &str,
        depth: i128,
        (word, has_sound_fields): (Width, bool),
        policy: ReadUnderWrite,
        loc: Loc,
    ) -> Mem {
        let width = word.bits;
        elaboration::with(|e| {
            let shape = sound_shape(e, format_args!("memory `{name}`"), word.shape, loc);
            if depth < 1 || width == 0 {
                let problem = Problem::new(
                    Mistake::EmptyMemory,
                    loc,
                    format!("memory `{name}` of {depth} words of {width} bits holds nothing"),
                );
                e.report(problem.help("depth and width are at least 1"));
            }
            if width > WIDEST {
                let message = format!("memory `{name}` has words of {width} bits, more than {WIDEST}");
                e.report(Problem::new(Mistake::TooWide, loc, message).help("spread wider data over several words"));
            }
            if depth > u32::MAX.into() {
                let message = format!("memory `{name}` has {depth} words, more than {}", u32::MAX);
                e.report(
                    Problem::new(Mistake::TooManyWords, loc, message).help("use wider words, or several memories"),
                );
            }
            let (sound_depth, sound_width) = (depth.clamp(1, u32::MAX.into()), width.clamp(1, WIDEST));
            let is_sound = has_sound_fields && (depth, width, word.shape) == (sound_depth, sound_width, shape);
            let stand_in = (!is_sound).then(|| Signal::zero_in(e, 1, Shape::Plain, Kind::Number, loc).node);
            let (depth, width) = (sound_depth as u32, sound_width);
            let (stamp, draft) = (e.stamp, e.draft());
            let (index, name) = (draft.memories.len() as u32, draft.prefixed(name));
            draft.memories.push(DraftMemory {
                memory: Memory {
                    shape,
                    name,
                    depth,
                    width,
                    policy,
                    contents: Contents::Unknown,
                    reads: Vec::new(),
                    writes: Vec::new(),
                    attributes: Vec::new(),
                    in_bounds: false,
                    loc,
                },
                true_dual_port: false,
                stand_in,
                written: Vec::new(),
                read_clocks: Vec::new(),
                read_parts: Vec::new(),
                write_parts: Vec::new(),
            });
            let (module, address_width) = (draft.serial, index_width(depth.into()));
            let word = Width { bits: width, shape, ..word };
            Mem { stamp, module, index, address_width, word, clock: self.clock, layout: word }
        })
    }

    /// States that an input is unused on purpose; for a bundle, that any of its fields may be unused.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// Reports that there is a request, and ignores its contents.
    ///     struct Pending;
    ///     in PendingIn { valid: bit(), page: below(12) }
    ///     out PendingOut { pending: bit() }
    /// }
    ///
    /// impl Pending {
    ///     fn build(&self, m: Module, i: PendingIn) -> PendingOut {
    ///         m.ignore(&i.page);
    ///         PendingOut { pending: i.valid }
    ///     }
    /// }
    ///
    /// // Without that line, "input `page` of `Pending` is never used" would be a problem.
    /// elaborate(&Pending)?;
    /// # Ok::<(), Problems>(())
    /// ```
    #[track_caller]
    pub fn ignore<B: Fields<Signal>>(self, inputs: &B) {
        let loc = Loc::caller();
        let ids: Vec<_> = inputs.leaves().iter().map(|(_, signal)| signal.id_at(loc)).collect();
        elaboration::draft(|draft| draft.ignored.extend(ids));
    }
}

/// Declares a named node with this operation, width, lanes and kind; an invalid width is replaced by the nearest
/// valid one.
pub(crate) fn declare(e: &mut Elaboration, op: Op, (what, name): (&str, &str), width: Width, loc: Loc) -> NodeId {
    let name = e.draft().prefixed(name);
    let what = format_args!("{what} `{name}`");
    let shape = sound_shape(e, what, width.shape, loc);
    let bits = sound_width(e, &[], what, width.bits.into(), loc);
    let draft = e.draft();
    let id = draft.add(op, bits, shape, loc);
    if (bits, shape) != (width.bits, width.shape) {
        draft.stand_ins.insert(id);
    }
    let node = draft.node_mut(id);
    (node.name, node.kind) = (Some(name), width.kind);
    id
}
