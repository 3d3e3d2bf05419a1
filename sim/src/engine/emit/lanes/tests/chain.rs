//! Chains of random operations, and their expected results.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Relation, Shift, Unary};

use crate::engine::cranelift::Jit;
use crate::engine::emit::lanes::Lanes;
use crate::engine::emit::lanes::access::Span;
use crate::engine::emit::lanes::vectors::low_mask;
use crate::engine::program::{Cell, Kind, ValueId};
use crate::engine::semantics::{self, Number};
use crate::engine::strips::{Type, Value};

pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub fn below(&mut self, limit: usize) -> usize {
        (self.next() >> 33) as usize % limit
    }

    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    pub fn width(&mut self) -> u32 {
        match self.below(4) {
            0 => 1,
            1 => self.pick(&[2, 3, 7, 8, 9, 15, 16, 17, 24, 31, 32, 33, 63, 64]),
            2 => 1 + self.below(16) as u32,
            _ => 1 + self.below(64) as u32,
        }
    }

    pub fn number(&mut self, width: u32) -> u64 {
        let number = match self.below(8) {
            0 => 0,
            1 => 1,
            2 => u64::MAX,
            3 => 1 << (width - 1),
            4 => (1 << (width - 1)) - 1,
            5 => self.next() % 70,
            _ => self.next(),
        };
        number & low_mask(width)
    }
}

/// A value under test: its width, its operation, and its expected value.
struct Node {
    width: u32,
    kind: Kind,
    lanes: Vec<u64>,
    uniform: bool,
    at: usize,
}

pub struct Chain {
    seed: u64,
    pub random: Random,
    strip: u32,
    /// Bits of a vector.
    vector: u32,
    nodes: Vec<Node>,
    size: usize,
}

impl Chain {
    /// Bytes of a node: its lanes in the widest element, and a vector.
    fn reserved(&self) -> usize {
        (self.vector + self.vector / 8) as usize
    }

    pub fn id(index: usize) -> ValueId {
        ValueId(index as u32)
    }

    pub fn add(&mut self, kind: Kind, width: u32, lanes: Vec<u64>, uniform: bool) -> ValueId {
        let at = self.size;
        self.size += self.reserved() + 8 * (self.nodes.len() % 3 / 2);
        self.nodes.push(Node { width, kind, lanes, uniform, at });
        Self::id(self.nodes.len() - 1)
    }

    pub fn input(&mut self, width: u32) -> ValueId {
        let lanes = (0..self.strip).map(|_| self.random.number(width)).collect();
        self.add(Kind::State, width, lanes, false)
    }

    pub fn uniform(&mut self, width: u32) -> ValueId {
        let lanes = vec![self.random.number(width); self.strip as usize];
        self.add(Kind::State, width, lanes, true)
    }

    pub fn constant(&mut self, width: u32) -> ValueId {
        let number = self.random.number(width);
        self.add(Kind::Const(Bits::new(width, number)), width, vec![number; self.strip as usize], false)
    }

    pub fn any(&mut self) -> ValueId {
        let recent = self.nodes.len().min(60);
        Self::id(self.nodes.len() - 1 - self.random.below(recent))
    }

    /// A value of this width, if possible an existing one.
    pub fn of(&mut self, width: u32) -> ValueId {
        let there: Vec<usize> = (0..self.nodes.len()).filter(|&i| self.nodes[i].width == width).collect();
        match self.random.below(10) {
            0 => self.constant(width),
            1 => self.uniform(width),
            2 => self.input(width),
            _ if there.is_empty() => self.input(width),
            _ => {
                let recent = there.len().min(12);
                Self::id(there[there.len() - 1 - self.random.below(recent)])
            }
        }
    }

    pub fn width_of(&self, id: ValueId) -> u32 {
        self.nodes[id.index()].width
    }

    pub fn some(&mut self) -> ValueId {
        if self.random.below(3) == 0 {
            let width = self.random.width();
            return self.of(width);
        }
        self.any()
    }

    pub fn operation(&mut self) {
        let a = self.some();
        let w = self.width_of(a);
        let (kind, width) = match self.random.below(17) {
            0 => (Kind::Unary(Unary::Not, a), w),
            1 => (Kind::Unary(self.random.pick(&[Unary::AllOnes, Unary::AnyOne, Unary::Parity]), a), 1),
            2 | 3 => {
                let op = self.random.pick(&[Binary::And, Binary::Or, Binary::Xor, Binary::Add, Binary::Sub]);
                (Kind::Binary(op, a, self.of(w)), w)
            }
            4 if w < 64 => {
                let other = 1 + self.random.below((64 - w) as usize) as u32;
                let other = if self.random.below(2) == 0 { other.min(w) } else { other };
                let op = self.random.pick(&[Binary::Mul, Binary::MulSigned]);
                (Kind::Binary(op, a, self.of(other)), w + other)
            }
            4..=6 => {
                use Relation::{Eq, Ge, Gt, Le, Lt, Ne};
                let relation = self.random.pick(&[Eq, Ne, Lt, Le, Gt, Ge]);
                let signed = self.random.below(2) == 0;
                (Kind::Compare(relation, signed, a, self.of(w)), 1)
            }
            7 | 8 => {
                let op = self.random.pick(&[Shift::Left, Shift::Right, Shift::RightSigned]);
                let by = match self.random.below(4) {
                    0 => self.random.width(),
                    _ => 1 + self.random.below(7) as u32,
                };
                (Kind::Shift(op, a, self.of(by)), w)
            }
            9 | 10 => {
                let (select, on_false) = (self.of(1), self.of(w));
                (Kind::Mux { select, on_true: a, on_false }, w)
            }
            11 => {
                let arms = (0..1 + self.random.below(4)).map(|_| (self.of(1), self.of(w))).collect();
                (Kind::Select { arms, default: a }, w)
            }
            12 => {
                let subject = self.some();
                let keys = self.width_of(subject);
                let constants = self.random.below(3) == 0;
                let mut arms: Vec<(Bits, ValueId)> = Vec::new();
                for _ in 0..1 + self.random.below(6) {
                    let key = Bits::new(keys, self.random.number(keys));
                    if arms.iter().all(|(other, _)| *other != key) {
                        arms.push((key, if constants { self.constant(w) } else { self.of(w) }));
                    }
                }
                let default = if constants { self.constant(w) } else { a };
                (Kind::Case { subject, arms, default }, w)
            }
            13 => {
                let low = self.random.below(w as usize) as u32;
                let width = match self.random.below(3) {
                    0 => 1,
                    1 => w - low,
                    _ => 1 + self.random.below((w - low) as usize) as u32,
                };
                (Kind::Slice(a, low), width)
            }
            14 => {
                let (mut parts, mut width) = (vec![a], w);
                for _ in 0..1 + self.random.below(5) {
                    let (part, random) = (self.some(), self.random.below(2));
                    let part = if random == 0 && width < 32 && width.is_power_of_two() { self.of(width) } else { part };
                    if width + self.width_of(part) <= 64 {
                        width += self.width_of(part);
                        parts.push(part);
                    }
                }
                (Kind::Concat(parts), width)
            }
            15 => {
                let times = 1 + self.random.below((64 / w) as usize) as u32;
                (Kind::Repeat(a, times), w * times)
            }
            _ if w < 64 => {
                let width = w + 1 + self.random.below((64 - w) as usize) as u32;
                (Kind::Extend(a, self.random.below(2) == 0), width)
            }
            _ => (Kind::Alias(a), w),
        };
        let lanes = (0..self.strip as usize).map(|lane| self.expected(&kind, width, lane)).collect();
        self.add(kind, width, lanes, false);
    }

    pub fn expected(&self, kind: &Kind, width: u32, lane: usize) -> u64 {
        let mut out = [0];
        semantics::lane(&Cell::new(kind.clone(), self.strip, width), 0, &mut out, |id, _| {
            let node = &self.nodes[id.index()];
            Number { limbs: std::slice::from_ref(&node.lanes[lane]), width: node.width }
        });
        out[0]
    }

    /// The element for storing a node: any that is wide enough.
    pub fn storage(&self, index: usize) -> u32 {
        let least = self.nodes[index].width.next_power_of_two().max(8);
        [8, 16, 32, 64].into_iter().filter(|&element| element >= least).cycle().nth(index * 7 % 5).expect("one")
    }

    pub fn bytes(&self, index: usize) -> Vec<u8> {
        let (node, storage) = (&self.nodes[index], self.storage(index));
        let stored = |&lane: &u64| if node.width == 1 { lane.wrapping_neg() } else { lane };
        node.lanes.iter().flat_map(|lane| stored(lane).to_le_bytes().into_iter().take(storage as usize / 8)).collect()
    }

    pub fn strip_of(&self, index: usize, address: Value) -> Span {
        let at = self.nodes[index].at;
        Span {
            storage: self.storage(index),
            address,
            offset: at as i32,
            aligned: at.is_multiple_of(self.vector as usize / 8),
        }
    }

    /// Runs the chain on memory and compares everything stored. Values are stored at the end if `late`, and otherwise
    /// immediately, which leaves each value clean for later operations.
    #[allow(unsafe_code, reason = "calls generated code")]
    pub fn check(&self, mut jit: Jit, late: bool) {
        let code = jit.function(|b, state, _| {
            let mut lanes = Lanes::new(self.strip, self.vector);
            for (i, node) in self.nodes.iter().enumerate() {
                let strip = self.strip_of(i, state);
                match &node.kind {
                    Kind::State if node.uniform => {
                        let scalar = b.constant(Type::I64, node.lanes[0] as i64);
                        lanes.splat(b, Self::id(i), node.width, scalar);
                    }
                    Kind::State => lanes.load(b, Self::id(i), node.width, strip),
                    kind => {
                        lanes.evaluate(b, Self::id(i), kind, node.width);
                        if !late {
                            lanes.store(b, Self::id(i), strip);
                        }
                    }
                }
            }
            for i in (0..self.nodes.len()).filter(|&i| late && self.nodes[i].kind != Kind::State) {
                lanes.store(b, Self::id(i), self.strip_of(i, state));
            }
            let zero = b.constant(Type::I64, 0);
            b.give(zero);
        });
        let mut state = Aligned::new(self.size + 2 * self.reserved());
        let memory = state.bytes();
        for (i, node) in self.nodes.iter().enumerate().filter(|(_, node)| node.kind == Kind::State) {
            let bytes = self.bytes(i);
            memory[node.at..node.at + bytes.len()].copy_from_slice(&bytes);
        }
        // SAFETY: the code stays within the nodes' bytes.
        unsafe { code.call(memory.as_mut_ptr(), 0, std::ptr::null_mut()) };
        for (i, node) in self.nodes.iter().enumerate().filter(|(_, node)| node.kind != Kind::State) {
            let bytes = self.bytes(i);
            let got = &memory[node.at..node.at + bytes.len()];
            let mut operands = Vec::new();
            node.kind.for_each_operand(|id| {
                let of = &self.nodes[id.index()];
                operands.push((id, of.width, &of.kind, &of.lanes));
            });
            assert!(
                got == bytes,
                "seed {}, strip {} of {} bits, {i}: {:?} of {} bits, stored as {}\ngot  {got:x?}\nwant {bytes:x?}\n{operands:x?}",
                self.seed,
                self.strip,
                self.vector,
                node.kind,
                node.width,
                self.storage(i),
            );
            let behind = &memory[node.at + bytes.len()..node.at + self.reserved()];
            assert!(behind.iter().all(|&byte| byte == 0), "{i} writes too far");
        }
    }
}

/// Memory aligned to 32 bytes.
struct Aligned(Vec<u8>, usize);

impl Aligned {
    pub fn new(size: usize) -> Aligned {
        let memory = vec![0u8; size + 32];
        let skipped = memory.as_ptr().align_offset(32);
        Aligned(memory, skipped)
    }

    pub fn bytes(&mut self) -> &mut [u8] {
        &mut self.0[self.1..]
    }
}

/// A chain with some inputs.
pub fn chain(strip: u32, vector: u32, seed: u64) -> Chain {
    let random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let mut chain = Chain { seed, random, strip, vector, nodes: Vec::new(), size: 0 };
    for _ in 0..8 {
        let width = chain.random.width();
        chain.input(width);
    }
    chain
}
