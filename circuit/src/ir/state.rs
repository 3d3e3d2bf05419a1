//! The state of a circuit, in bits.

use super::{Design, Module};

/// The bits of state of a circuit, with those of each instance counted.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(8) }
/// def!(count = m.reg(8).reset(0));
/// count.when(i.enable, count + 1);
/// #     ShownOut { count: *count }
/// # };
/// assert_eq!(design.state(), ir::State { registers: 8, memories: 0, tables: 0 });
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct State {
    /// In registers.
    pub registers: u64,
    /// In memories that have a write port.
    pub memories: u64,
    /// In memories without a write port, whose contents never change.
    pub tables: u64,
}

impl State {
    /// The state that can change.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(ir::State { registers: 8, memories: 96, tables: 1000 }.bits(), 104);
    /// ```
    pub fn bits(&self) -> u64 {
        self.registers + self.memories
    }

    fn and(self, times: u64, other: State) -> State {
        State {
            registers: self.registers + times * other.registers,
            memories: self.memories + times * other.memories,
            tables: self.tables + times * other.tables,
        }
    }

    /// The state of a module without its instances.
    fn own(module: &Module) -> State {
        let registers = module.registers.iter().map(|register| {
            let node = module.node(register.node);
            u64::from(node.width) * u64::from(node.shape.lanes())
        });
        let bits = |is_written: bool| {
            let memories = module.memories.iter().filter(|it| it.writes.is_empty() != is_written);
            memories.map(|it| u64::from(it.depth) * u64::from(it.width) * u64::from(it.shape.lanes())).sum()
        };
        State { registers: registers.sum(), memories: bits(true), tables: bits(false) }
    }
}

impl Design {
    /// The bits of state of the circuit.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     struct Cell;
    /// #     in CellIn { left: bits(4) }
    /// #     out CellOut { held: bits(4) }
    /// # }
    /// # impl Cell {
    /// #     fn build(&self, m: Module, i: CellIn) -> CellOut {
    /// #         CellOut { held: m.pipe("held", i.left) }
    /// #     }
    /// # }
    /// # block! {
    /// #     struct Line;
    /// #     in LineIn { word: bits(4) }
    /// #     out LineOut { last: bits(4), square: bits(8), held: bits(2).of(row(3)) }
    /// # }
    /// # impl Line {
    /// #     fn build(&self, m: Module, i: LineIn) -> LineOut {
    /// let cells = m.array("u_cell", 100, &Cell, |cells| CellIn { left: cells.held.previous(i.word) });
    /// def!(squares = m.memory(16, 8, ReadUnderWrite::Any).words((0..16).map(|x| x * x)));
    /// def!(cell = m.memory(5, bits(2).of(row(3)), ReadUnderWrite::Any));
    /// cell.write(lit(1, 1), i.word.trunc(3), i.word.trunc(2).of(row(3)));
    /// #         let (square, held) = (squares.read_async(i.word), cell.read_async(i.word.trunc(3)));
    /// #         LineOut { last: cells.held.last(), square, held }
    /// #     }
    /// # }
    /// # let design = elaborate(&Line)?;
    /// // The registers of all 100 cells; five words in each of three lanes.
    /// assert_eq!(design.state(), ir::State { registers: 400, memories: 5 * 2 * 3, tables: 16 * 8 });
    /// # Ok::<(), Problems>(())
    /// ```
    pub fn state(&self) -> State {
        let mut states: Vec<State> = Vec::with_capacity(self.modules().len());
        for module in self.modules() {
            let inner =
                |sum: State, it: &super::Instance| sum.and(it.shape.lanes().into(), states[it.module.0 as usize]);
            states.push(module.instances.iter().fold(State::own(module), inner));
        }
        states.pop().expect("a design has a top module")
    }
}
