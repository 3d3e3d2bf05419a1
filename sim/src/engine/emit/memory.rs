//! Words of memories, read and written by code.

use super::lanes::Span;
use super::scalar::{LONGEST, Scalar};
use super::strip_values::Strip;
use super::{Emitter, offset};
use crate::engine::function::Sink;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::plan::access::Word;
use crate::engine::plan::clamp::Clamp;
use crate::engine::program::{Kind, ValueId};
use crate::engine::strips::{Comparison, Region, Type, Value};

impl Emitter<'_, '_> {
    /// Reads a memory of one lane. Every address that the port can express has a word; those beyond the depth are zero.
    pub(super) fn read(&mut self, id: ValueId, memory: u32, address: ValueId) {
        let address = self.scalars.clean(self.builder, address)[0];
        let memory = self.memories[memory as usize];
        let base = self.memory_base(memory);
        let at = self.word(memory, address, base);
        self.scalars.load(self.builder, id, memory.width, memory.element(), at, 0);
    }

    /// The address of a word.
    fn word(&mut self, memory: MemoryAt, address: Value, base: Value) -> Value {
        let within = self.scaled(address, memory.words.address);
        self.builder.add(base, within)
    }

    /// Writes a word of a memory of one lane, if the port is enabled and the address is within the depth.
    pub(super) fn write(&mut self, memory: u32, enable: ValueId, address: ValueId, data: ValueId) {
        let memory = self.memories[memory as usize];
        let address = self.scalars.clean(self.builder, address)[0];
        let enabled = self.scalars.flag(self.builder, enable);
        let before = self.scalars.get(data).expect("it was made available").clone();
        let inside = self.inside(memory, address, enabled);
        self.branch(inside, |emitter| {
            let base = emitter.memory_base(memory);
            let at = emitter.word(memory, address, base);
            emitter.note_write();
            emitter.scalars.store(emitter.builder, data, memory.element(), at, 0);
        });
        // A conversion made in the branch is not valid after it.
        self.scalars.define(data, before);
    }

    /// A flag, and the address is below the depth.
    fn inside(&mut self, memory: MemoryAt, address: Value, enabled: Value) -> Value {
        if memory.is_full {
            return enabled;
        }
        let depth = self.builder.constant(Type::I64, i64::from(memory.depth));
        let inside = self.builder.compare(Comparison::UnsignedLessThan, address, depth);
        self.builder.and(enabled, inside)
    }

    /// Runs `body` where a flag is 1.
    fn branch(&mut self, flag: Value, body: impl FnOnce(&mut Self)) {
        self.builder.open();
        body(self);
        let taken = self.builder.close();
        self.builder.branch(flag, taken, Region::new());
    }

    /// The address of the words at the address common to all lanes, and that address; to be called before the loop.
    pub(super) fn begin_words(&mut self, strip: &mut Strip, word: Word) {
        let (memory, address) = word;
        let at = self.memories[memory as usize];
        let common = match self.function.cell(address).kind {
            Kind::Broadcast { of, .. } if self.function.cell(of).lanes == 1 => of,
            _ => address,
        };
        self.want(common);
        let number = self.scalars.clean(self.builder, common)[0];
        let base = self.memory_base(at);
        let start = self.word(at, number, base);
        strip.words.insert(word, (start, number));
    }

    /// The words of a strip, at the address common to all lanes.
    fn words(&mut self, strip: &mut Strip, word: Word) -> (Span, Value) {
        let (start, number) = strip.words[&word];
        let word = self.memories[word.0 as usize].words.word;
        let lanes = self.scaled(strip.first.expect("it has begun"), word);
        let address = self.builder.add(start, lanes);
        (Span { storage: word as u32 * 8, address, offset: 0, aligned: true }, number)
    }

    /// Reads, for each lane, the word of the lane with the number in `from`, at the address common to all.
    pub(super) fn read_of(&mut self, strip: &mut Strip, id: ValueId, word: Word, (from, clamp): (ValueId, Clamp)) {
        let at = self.memories[word.0 as usize];
        let (start, _) = strip.words[&word];
        let kind = Type::integer(at.element());
        let size = strip.size();
        let read = |lane| {
            let number = self.lane_number(strip, from, lane, clamp);
            let offset = self.scaled(number, at.words.word);
            let address = self.builder.add(start, offset);
            let word = self.builder.load(kind, address, 0);
            if at.width == 1 { self.builder.and_constant(word, 1) } else { word }
        };
        let lanes: Vec<Value> = (0..size).map(read).collect();
        strip.lanes.gather(self.builder, id, at.width, &lanes);
    }

    /// Reads the words of all lanes at the address common to them.
    pub(super) fn read_together(&mut self, strip: &mut Strip, id: ValueId, word: Word) {
        let (side, _) = self.words(strip, word);
        strip.lanes.load(self.builder, id, self.memories[word.0 as usize].width, side);
    }

    /// Reads a word for each lane.
    pub(super) fn read_each(&mut self, strip: &mut Strip, id: ValueId, (memory, address): Word) {
        let at = self.memories[memory as usize];
        let mut lanes = Vec::new();
        for lane in 0..strip.size() {
            let number = self.limbs(strip, address, lane)[0];
            let (base, offset) = self.lane_base(strip, at, lane);
            let word = self.word(at, number, base);
            if at.width <= 64 {
                let kind = Type::integer(at.element());
                lanes.push(self.builder.load(kind, word, offset));
            } else {
                let loaded = Scalar::load(self.builder, at.width, word, offset);
                strip.define_single(lane, id, loaded);
            }
        }
        if at.width == 1 {
            lanes = lanes.into_iter().map(|lane| self.builder.and_constant(lane, 1)).collect();
        }
        if at.width <= 64 {
            strip.lanes.gather(self.builder, id, at.width, &lanes);
        }
    }

    /// The first byte of a lane's words, and an offset.
    fn lane_base(&mut self, strip: &mut Strip, memory: MemoryAt, lane: u32) -> (Value, i32) {
        let apart = lane as usize * memory.words.lane;
        if strip.division.is_padded() || i32::try_from(apart + memory.words.word).is_err() {
            let lane = self.existing(strip, lane);
            let start = self.scaled(lane, memory.words.lane);
            let base = self.memory_base(memory);
            return (self.builder.add(start, base), 0);
        }
        let base = match strip.memories.get(&memory.address) {
            Some(base) => *base,
            None => {
                let start = self.scaled(strip.first.expect("it has begun"), memory.words.lane);
                let base = self.memory_base(memory);
                let base = self.builder.add(start, base);
                strip.memories.insert(memory.address, base);
                base
            }
        };
        (base, offset(apart))
    }

    /// Writes a word for each enabled lane.
    pub(super) fn write_lanes(&mut self, strip: &mut Strip, sink: usize) {
        let &Sink::Write { memory, enable, address, data } = &self.function.sinks[sink] else {
            unreachable!("a write")
        };
        let at = self.memories[memory as usize];
        for id in [enable, address, data] {
            self.available(strip, id);
        }
        let any = strip.lanes.any(self.builder, enable);
        if at.words.together() {
            let (side, number) = self.words(strip, (memory, address));
            let go = self.inside(at, number, any);
            let mark = strip.lanes.mark();
            self.branch(go, |emitter| {
                emitter.note_write();
                // A value that is the same in all lanes is 1 in all of them here.
                if strip.lanes.is_uniform(enable) {
                    strip.lanes.store(emitter.builder, data, side);
                } else {
                    let old = emitter.id();
                    strip.lanes.load(emitter.builder, old, at.width, side);
                    strip.lanes.store_where(emitter.builder, enable, data, old, side);
                }
                strip.lanes.forget(mark);
            });
            return;
        }
        // Conversions made in the branch are forgotten after it. The base is not, so it is computed here.
        self.lane_base(strip, at, 0);
        let mark = strip.lanes.mark();
        let singles = strip.save();
        self.branch(any, |emitter| {
            emitter.note_write();
            for lane in 0..strip.size() {
                let number = emitter.limbs(strip, address, lane)[0];
                let enabled = strip.lanes.extract(emitter.builder, enable, lane);
                let enabled = emitter.builder.truncate(Type::I8, enabled);
                let go = emitter.inside(at, number, enabled);
                // Without a branch, which would be hard to predict: a disabled lane writes to a place that nobody
                // reads.
                let (base, offset) = emitter.lane_base(strip, at, lane);
                let within = emitter.scaled(number, at.words.address);
                let nowhere = emitter.builder.constant(Type::I64, at.words.nowhere as i64);
                let within = emitter.builder.select(go, within, nowhere);
                let word = emitter.builder.add(base, within);
                if at.width > LONGEST {
                    emitter.store_long(strip, data, lane, word, offset);
                    continue;
                }
                let limbs = emitter.limbs(strip, data, lane);
                let kind = Type::integer(at.element());
                for (i, limb) in limbs.into_iter().enumerate() {
                    let limb = if at.width == 1 { emitter.builder.neg(limb) } else { limb };
                    let limb = if at.element() < 64 { emitter.builder.truncate(kind, limb) } else { limb };
                    emitter.builder.store(limb, word, offset + 8 * i as i32);
                }
            }
            strip.lanes.forget(mark);
            strip.restore(singles);
        });
    }
}
