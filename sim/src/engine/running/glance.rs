//! Single lanes that a testbench reads together in many clocks. A function computes each from single lanes of its operands, where a view would compute all
//! lanes of all values before.

use std::sync::Arc;

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Reduction, Relation};

use super::Compiled;
use crate::engine::Engine;
use crate::engine::cranelift::Code;
use crate::engine::function::{Maker, Sink};
use crate::engine::layout::Place;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::program::{Axis, Cell, Circuit, Kind, Lowered, ValueId};

/// Limbs of lanes, which are read together.
pub(crate) type Limbs = Arc<[Limb]>;

/// A limb of a lane of a value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limb {
    pub value: ValueId,
    pub lane: u32,
    /// 0 for the lowest.
    pub number: u32,
    /// Its bits.
    pub width: u32,
}

/// The most lanes along an axis that are combined one by one.
const COMBINED: u32 = 64;
/// The most values of a function that are made of single lanes. Others are computed in all lanes.
const SINGLE: usize = 20_000;

/// A function that stores limbs for reading.
pub(super) struct Glance {
    of: Limbs,
    /// Nothing if all values have one lane: views serve them better.
    code: Option<Code>,
    /// The values, if all have one lane and one limb.
    single: Option<Whole>,
    /// The limb of each.
    limbs: Vec<u32>,
    pub stale: bool,
}

/// Values of one lane and one limb.
#[derive(Default)]
struct Whole {
    ids: Vec<ValueId>,
    /// Their numbers, where they are, and which of them have changed: see [`Engine::renew`].
    seen: Vec<u64>,
    note: Vec<u32>,
    changed: Vec<u32>,
}

impl Compiled {
    /// These limbs as numbers; returns `false` and does nothing if they are better read one by one.
    pub(super) fn glance_at(&mut self, limbs: &Limbs, numbers: &mut [u64]) -> bool {
        let at = match self.glances.iter().position(|it| Arc::ptr_eq(&it.of, limbs)) {
            Some(at) => at,
            None => self.make_glance(limbs),
        };
        if let Some(mut whole) = self.glances[at].single.take() {
            self.renew(&whole.ids, &mut whole.seen, &mut whole.note, &mut whole.changed);
            numbers[..whole.seen.len()].copy_from_slice(&whole.seen);
            self.glances[at].single = Some(whole);
            return true;
        }
        self.mark();
        let Glance { code: Some(code), ref mut stale, .. } = self.glances[at] else { return false };
        if std::mem::take(stale) {
            self.call(code, 1);
        }
        let state = self.state.limbs();
        for (number, limb) in numbers.iter_mut().zip(&self.glances[at].limbs) {
            *number = state[*limb as usize].get();
        }
        true
    }

    /// Notes that something has changed.
    #[inline]
    pub(super) fn age_glances(&mut self) {
        self.glances.iter_mut().for_each(|glance| glance.stale = true);
    }

    #[cold]
    fn make_glance(&mut self, limbs: &Limbs) -> usize {
        let mut glance = Glance { of: limbs.clone(), code: None, single: None, limbs: Vec::new(), stale: true };
        let is_whole = |limb: &Limb| {
            let cell = &self.program.circuit[limb.value];
            cell.lanes == 1 && cell.width <= 64
        };
        if limbs.iter().all(is_whole) {
            let ids: Vec<ValueId> = limbs.iter().map(|limb| limb.value).collect();
            self.show(&ids);
            glance.single = Some(Whole { seen: vec![0; ids.len()], ids, ..Whole::default() });
        } else if limbs.iter().any(|limb| self.program.circuit[limb.value].lanes > 1) {
            let places: Vec<Place> = limbs.iter().map(|limb| self.layout.place(1, limb.width)).collect();
            glance.limbs = places.iter().map(|place| (place.offset / 8) as u32).collect();
            glance.code = Some(self.glance_code(limbs, &places));
        } else {
            self.show(&limbs.iter().map(|limb| limb.value).collect::<Vec<_>>());
        }
        self.glances.push(glance);
        self.glances.len() - 1
    }

    fn glance_code(&mut self, limbs: &Limbs, places: &[Place]) -> Code {
        let (program, memories) = (self.program.clone(), self.memories.clone());
        let mut maker = Maker::new(&program);
        let own: Vec<ValueId> = places.iter().map(|place| maker.state(place.width)).collect();
        let mut single = Single { maker, circuit: &program.circuit, memories: &memories, known: FxHashMap::default() };
        for (limb, state) in limbs.iter().zip(own) {
            let lane = single.lane(limb.value, limb.lane);
            let next = match program.circuit[limb.value].width {
                ..=64 => lane,
                _ => single.maker.add(Kind::Slice(lane, 64 * limb.number), 1, limb.width),
            };
            single.maker.add_sink(Sink::Register { state, next, enable: None });
        }
        let prepared = self.prepare(&single.maker.finish().0, places);
        self.compile_once(std::slice::from_ref(&prepared))
    }
}

/// Makes single lanes of a program's values.
struct Single<'a> {
    maker: Maker<'a>,
    circuit: &'a Circuit,
    memories: &'a [MemoryAt],
    known: FxHashMap<(ValueId, u32), ValueId>,
}

impl Single<'_> {
    /// A lane of a value.
    fn lane(&mut self, id: ValueId, lane: u32) -> ValueId {
        if let Some(known) = self.known.get(&(id, lane)) {
            return *known;
        }
        let made = if self.known.len() < SINGLE { self.make(id, lane) } else { None };
        let made = made.unwrap_or_else(|| self.lane_of_all(id, lane));
        self.known.insert((id, lane), made);
        made
    }

    /// A lane of a value that is computed in all lanes.
    fn lane_of_all(&mut self, id: ValueId, index: u32) -> ValueId {
        let (of, &Cell { lanes, width, .. }) = (self.maker.take(id), &self.circuit[id]);
        match lanes {
            1 => of,
            _ => self.maker.add(Kind::Lane { of, axis: Axis::last(lanes), index }, 1, width),
        }
    }

    /// A lane of a value from lanes of its operands, if that is less work.
    fn make(&mut self, id: ValueId, lane: u32) -> Option<ValueId> {
        let circuit = self.circuit;
        let Cell { ref kind, width, .. } = circuit[id];
        if let Some((of, from)) = kind.source(lane) {
            return Some(self.lane(of, from));
        }
        Some(match *kind {
            Kind::Const(ref bits) => self.maker.add(Kind::Const(bits.clone()), 1, width),
            Kind::Unpack { of, axis } => {
                let (number, rest) = axis.split(lane);
                let word = self.lane(of, rest);
                self.maker.add(Kind::Slice(word, number * width), 1, width)
            }
            Kind::Pack { of, axis } if axis.count <= COMBINED => {
                let parts = (0..axis.count).rev().map(|number| self.lane(of, axis.at(lane, number))).collect();
                self.maker.add(Kind::Concat(parts), 1, width)
            }
            Kind::Pick { of, axis, index } if axis.count <= COMBINED => {
                let (subject, bits) = (self.lane(index, lane), circuit[index].width);
                let reachable = if bits < 32 { axis.count.min(1 << bits) } else { axis.count };
                let arm = |number: u32| (Bits::new(bits, number.into()), self.lane(of, axis.at(lane, number)));
                let arms = (0..reachable).map(arm).collect();
                let default = self.maker.add(Kind::Const(Bits::zero(width)), 1, width);
                self.maker.add(Kind::Case { subject, arms, default }, 1, width)
            }
            Kind::Reduce { by, of, axis } if axis.count <= COMBINED => {
                let lanes: Vec<ValueId> = (0..axis.count).map(|number| self.lane(of, axis.at(lane, number))).collect();
                lanes.into_iter().reduce(|all, next| self.combine(by, all, next, width))?
            }
            Kind::Read { memory, address } => {
                let (address, at) = (self.lane(address, lane), &self.memories[memory as usize]);
                match at.lanes {
                    1 => self.maker.add(Kind::Read { memory, address }, 1, width),
                    _ if at.words.together() && width <= 64 => self.word(memory, address, lane),
                    _ => return None,
                }
            }
            ref kind if kind.is_elementwise() => {
                let mut kind = kind.clone();
                kind.rewrite(|operand| *operand = self.lane(*operand, lane));
                self.maker.add(kind, 1, width)
            }
            _ => return None,
        })
    }

    /// The word of a memory's lane at an address.
    fn word(&mut self, memory: u32, address: ValueId, lane: u32) -> ValueId {
        let MemoryAt { width, blank, .. } = self.memories[memory as usize];
        // Code takes words of single lanes for several lanes alone.
        let mut both = |kind, width| self.maker.add(kind, 2, width);
        let at = both(Kind::Const(Bits::new(32, lane.into())), 32);
        let mut words = both(Kind::Lowered(Lowered::WordOf { memory, address, at }), width);
        if blank != 0 {
            let blank = both(Kind::Const(Bits::new(width, blank)), width);
            words = both(Kind::Binary(Binary::Xor, words, blank), width);
        }
        self.maker.add(Kind::Lane { of: words, axis: Axis::last(2), index: 0 }, 1, width)
    }

    fn combine(&mut self, by: Reduction, a: ValueId, b: ValueId, width: u32) -> ValueId {
        let kind = match by.operator() {
            Some(op) => Kind::Binary(op, a, b),
            None => {
                let relation = if by == Reduction::Min { Relation::Le } else { Relation::Ge };
                let select = self.maker.add(Kind::Compare(relation, false, a, b), 1, 1);
                Kind::Mux { select, on_true: a, on_false: b }
            }
        };
        self.maker.add(kind, 1, width)
    }
}
