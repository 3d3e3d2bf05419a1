//! Memories and their ports.

use super::{Attribute, ClockId, NodeId, Shape};
use crate::bits::Bits;
use crate::loc::Loc;

/// The result of a read whose word is written at the same edge.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// def!(count = m.reg(2).reset(0));
/// count.next(count + 1);
/// let policies = [("old", ReadUnderWrite::Old), ("fresh", ReadUnderWrite::New), ("any", ReadUnderWrite::Any)];
/// for (name, policy) in policies {
///     let cell = m.memory(&format!("{name}_cell"), 1, 2, policy).fill(Bits::zero(2));
///     cell.write(lit(1, 1), 0, count);
///     let _ = cell.read(0).named(name);
/// }
/// # });
/// assert_eq!(example.values("old"), [0, 0, 0, 1, 2]);
/// assert_eq!(example.values("fresh"), [0, 0, 1, 2, 3]);
/// // A circuit that relies on the result must fail its tests.
/// assert_eq!(example.values("any"), [0, 3, 3, 2, 1]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ReadUnderWrite {
    /// The word before the edge.
    Old,
    /// The word that is written, if it is written on the clock of the read. The circuit has a comparison of the addresses
    /// and a multiplexer for it; a synthesizer leaves them out where the target has such memories. It is no policy of
    /// a finished circuit, where such a read is a register.
    New,
    /// Undefined: the cheapest memory on every FPGA. The simulator gives the old word inverted.
    Any,
}

/// The contents of a memory at the start.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4) } out { square: bits(8) }
/// def!(squares = m.memory(16, 8, ReadUnderWrite::Any).words((0..3).map(|x| x * x)));
/// let square = squares.read(i.at);
/// #     ShownOut { square }
/// # };
/// let ir::Contents::Words(words) = &design.top().memories[0].contents else { panic!("words") };
/// assert_eq!(words.len(), 3); // only the given words: the rest is zero
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Contents {
    /// Undefined.
    Unknown,
    /// The same word everywhere, in every lane.
    Fill(Bits),
    /// These words from address 0, in every lane; the rest is zero.
    Words(Vec<Bits>),
    /// For each lane, in row-major order, these words from address 0; the rest is zero. Not of a plain memory.
    Each(Vec<Vec<Bits>>),
}

/// A memory. At an edge, every port on that clock samples at once. If two write ports of one clock write the same
/// word, the later port wins. A read beyond the depth gives zero; a write beyond it has no effect.
///
/// With a shape, every lane has words of its own. The address of a port is either plain, the same for all lanes, or
/// of the memory's shape; so is an enable. Each port chooses separately. If all addresses are plain, this is one
/// memory of wide words with a write mask for the lanes; otherwise it is one memory for each lane.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4), word: bits(8) } out { last_word: bits(8) }
/// def!(last = m.memory(12, 8, ReadUnderWrite::Old).fill(Bits::zero(8)));
/// last.write(i.at.lt(12), i.at, i.word);
/// let last_word = last.read(i.at);
/// #     ShownOut { last_word }
/// # };
/// let memory = &design.top().memories[0];
/// assert_eq!((memory.depth * memory.width, memory.reads.len(), memory.writes.len()), (96, 1, 1));
/// ```
#[derive(Debug, Clone)]
pub struct Memory {
    /// Its name, unique in the module.
    pub name: String,
    /// The number of words.
    pub depth: u32,
    /// The width of a word in bits, in one lane.
    pub width: u32,
    /// Its lanes.
    pub shape: Shape,
    /// The result of a synchronous read whose word is written at the same edge.
    pub policy: ReadUnderWrite,
    /// The contents at the start.
    pub contents: Contents,
    /// Read ports.
    pub reads: Vec<ReadPort>,
    /// Write ports.
    pub writes: Vec<WritePort>,
    /// For synthesizers.
    pub attributes: Vec<Attribute>,
    /// Whether the description says that no address reaches beyond the last word, so that the word there is undefined.
    /// Assertions check it.
    pub in_bounds: bool,
    /// Where it is declared.
    pub loc: Loc,
}

/// A read port.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4) } out { now: bits(8), later: bits(8) }
/// def!(table = m.memory(16, 8, ReadUnderWrite::Any).fill(Bits::zero(8)));
/// let (now, later) = (table.read_async(i.at), table.read(i.at));
/// #     ShownOut { now, later }
/// # };
/// let reads = &design.top().memories[0].reads;
/// assert!(reads[0].clock.is_none() && reads[1].clock.is_some());
/// ```
#[derive(Debug, Clone)]
pub struct ReadPort {
    /// `Some` for a synchronous port: the data is a register that takes the word at the edge. `None` for an
    /// asynchronous port.
    pub clock: Option<ClockId>,
    /// The address, of [`index_width`](crate::index_width)`(depth)` bits; plain or of the memory's shape.
    pub address: NodeId,
    /// 1 bit, plain or of the memory's shape: a synchronous port keeps its data while this is low. `None` means
    /// always reading.
    pub enable: Option<NodeId>,
    /// The [`Op::Read`](super::Op::Read) node, of the memory's shape.
    pub node: NodeId,
}

/// A write port.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4), word: bits(8) } out { word_before: bits(8) }
/// def!(table = m.memory(16, 8, ReadUnderWrite::Any).fill(Bits::zero(8)));
/// table.write(lit(1, 1), i.at, i.word);
/// let word_before = table.read(3);
/// #     ShownOut { word_before }
/// # };
/// let (top, write) = (design.top(), &design.top().memories[0].writes[0]);
/// assert_eq!((write.address, write.data), (top.inputs[0].node, top.inputs[1].node));
/// ```
#[derive(Debug, Clone)]
pub struct WritePort {
    /// Its clock.
    pub clock: ClockId,
    /// 1 bit, plain or of the memory's shape: writes while high.
    pub enable: NodeId,
    /// The address, as wide as those of the read ports; plain or of the memory's shape.
    pub address: NodeId,
    /// The word, of the memory's shape.
    pub data: NodeId,
}
