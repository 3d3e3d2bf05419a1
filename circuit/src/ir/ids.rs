//! Ids of the parts of designs and modules.

/// The index of a module in [`Design::modules`](super::Design::modules).
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// def!(late = m.pipe(i.word));
/// #     ShownOut { late }
/// # };
/// assert_eq!(design.module(ir::ModuleId(0)).name, design.top().name);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ModuleId(pub u32);

/// The index of a node in [`Module::nodes`](super::Module::nodes).
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { flipped: bits(8) }
/// let flipped = !i.word;
/// #     ShownOut { flipped }
/// # };
/// // Operands come first, except in a loop through a register.
/// let top = design.top();
/// let ir::Op::Unary(_, operand) = top.node(top.outputs[0].node).op else { panic!("a `not`") };
/// assert!(operand < top.outputs[0].node);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

/// The index of a clock in [`Module::clocks`](super::Module::clocks).
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// def!(late = m.pipe(i.word));
/// #     ShownOut { late }
/// # };
/// let top = design.top();
/// let ir::ClockId(clock) = top.registers[0].clock;
/// assert_eq!(top.clocks[clock as usize].port, "clk");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ClockId(pub u32);

/// The index of a register in [`Module::registers`](super::Module::registers).
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// def!(late = m.pipe(i.word));
/// #     ShownOut { late }
/// # };
/// let top = design.top();
/// let node = top.node(top.registers[0].node);
/// assert_eq!(node.op, ir::Op::Register(ir::RegisterId(0)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RegisterId(pub u32);

/// The index of a memory in [`Module::memories`](super::Module::memories).
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4) } out { word: bits(8) }
/// let word = m.memory("table", 16, 8, ReadUnderWrite::Any).fill(Bits::zero(8)).read(i.at);
/// #     ShownOut { word }
/// # };
/// let top = design.top();
/// assert_eq!(top.node(top.outputs[0].node).op, ir::Op::Read(ir::MemoryId(0), 0)); // its first read port
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MemoryId(pub u32);

/// The index of an instance in [`Module::instances`](super::Module::instances).
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Halver;
/// #     in HalverIn { word: bits(8) }
/// #     out HalverOut { half: bits(8) }
/// # }
/// # impl Halver {
/// #     fn build(&self, _: Module, i: HalverIn) -> HalverOut {
/// #         HalverOut { half: i.word >> 1 }
/// #     }
/// # }
/// # block! {
/// #     struct Chain;
/// #     in ChainIn { word: bits(8) }
/// #     out ChainOut { quarter: bits(8) }
/// # }
/// # impl Chain {
/// #     fn build(&self, m: Module, i: ChainIn) -> ChainOut {
/// let half = m.instance("u_half", &Halver, HalverIn { word: i.word }).half;
/// let quarter = m.instance("u_quarter", &Halver, HalverIn { word: half }).half;
/// #         ChainOut { quarter }
/// #     }
/// # }
/// # let design = elaborate(&Chain)?;
/// let top = design.top();
/// assert_eq!(top.node(top.outputs[0].node).op, ir::Op::Output(ir::InstanceId(1), 0)); // its first output
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct InstanceId(pub u32);
