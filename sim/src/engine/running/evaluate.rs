//! Evaluates lowered functions by the meaning of their operations, in place of code: on the same memory, at the same
//! places. It tells whether lowering or code generation has made a mistake.
//!
//! The padding lanes of the last strip are evaluated too. Code may leave anything there, so here they get improbable
//! values. Only tables, which zeros follow, and values that are the same in all lanes are known there.

use std::cell::Cell as Number64;

use tilewright_circuit::{limbs_for, top_mask};

use super::Compiled;
use super::prepare::{Prepared, Times};
use crate::engine::cranelift::Code;
use crate::engine::function::{Function, Sink};
use crate::engine::layout::Place;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::store::Cells;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Axis, Cell, Kind, Lowered, ValueId};
use crate::engine::semantics::{self, Number};

/// A lowered function, with everything that it reads and changes.
pub(crate) struct Evaluated {
    function: Function,
    /// For each cell its place, if it is stored.
    places: Vec<Option<Place>>,
    memories: Vec<MemoryAt>,
    strips: StripSizes,
    /// The place of a number that is 1 while assertions are not checked, if that ever happens.
    unchecked: Option<Place>,
}

/// The functions that are evaluated in place of code; the generated code calls them.
pub(super) struct Functions {
    parts: Vec<Evaluated>,
    times: Times,
    /// Limbs of the state.
    size: usize,
}

#[allow(unsafe_code, reason = "called by generated code")]
unsafe extern "C" fn run(functions: *const Functions, state: *const Number64<u64>, count: u64) -> u64 {
    // SAFETY: the engine that owns the calling code also owns the functions and the state, which has not shrunk since
    // they were made.
    let (functions, state) = unsafe {
        let functions = &*functions;
        (functions, Cells(std::slice::from_raw_parts(state, functions.size)))
    };
    let mut left = count;
    while left > 0 {
        if !functions.parts.iter().all(|part| part.run(state)) {
            break;
        }
        left = if functions.times == Times::Once { 0 } else { left - 1 };
    }
    left
}

impl Compiled {
    /// Makes code that evaluates these functions, one after another, the given number of times.
    pub(super) fn evaluate(&mut self, parts: &[Prepared], times: Times) -> Code {
        let parts = parts.iter().map(|part| {
            let unchecked = (!part.is_always_asked).then_some(self.unchecked);
            Evaluated::new(part.function(), &part.addresses.places, &self.memories, &self.layout.strips, unchecked)
        });
        let functions = Box::new(Functions { parts: parts.collect(), times, size: self.state.limbs().len() });
        let address = &raw const *functions as i64;
        self.evaluated.push(functions);
        self.jit.calling(run as *const () as usize, address)
    }
}

impl Evaluated {
    pub fn new(
        function: &Function,
        places: &[Option<Place>],
        memories: &[MemoryAt],
        strips: &StripSizes,
        unchecked: Option<Place>,
    ) -> Evaluated {
        let (function, places) = (function.clone(), places.to_vec());
        Evaluated { function, places, memories: memories.to_vec(), strips: strips.clone(), unchecked }
    }

    /// Evaluates the function and executes its sinks; returns whether all assertions pass.
    ///
    /// # Panics
    ///
    /// The function reads a lane that does not exist, or a lane that does not exist writes.
    pub fn run(&self, state: Cells) -> bool {
        let mut values = Values { of: self, state, lanes: vec![Vec::new(); self.function.circuit().len()] };
        for sink in &self.function.sinks {
            if let Sink::Register { state, .. } = *sink {
                values.evaluate(state);
            }
        }
        self.function.needed().into_iter().for_each(|id| values.evaluate(id));
        self.function.sinks.iter().for_each(|sink| values.sink(sink));
        let held = self.function.sinks.iter().find_map(|sink| match sink {
            Sink::ContinueIf(value) => Some(values.number(*value, 0).limbs[0] == 1),
            _ => None,
        });
        let is_unchecked = |place: Place| {
            let mut limb = [0];
            state.get_word(place.offset, 8, 64, &mut limb);
            limb[0] == 1
        };
        held.unwrap_or(true) || self.unchecked.is_some_and(is_unchecked)
    }

    fn place(&self, id: ValueId) -> Place {
        self.places[id.index()].expect("what is in memory has a place")
    }

    /// The number of lanes of a value including the padding of its last strip.
    fn padded(&self, lanes: u32) -> u32 {
        if lanes == 1 { 1 } else { lanes.next_multiple_of(self.strips.strip(lanes)) }
    }
}

/// The values of a function.
struct Values<'a> {
    of: &'a Evaluated,
    state: Cells<'a>,
    /// For each cell, the limbs of its lanes, including the padding of the last strip.
    lanes: Vec<Vec<u64>>,
}

impl Values<'_> {
    fn number(&self, id: ValueId, lane: u32) -> Number<'_> {
        let width = self.of.function.cell(id).width;
        let limbs = limbs_for(width);
        Number { limbs: &self.lanes[id.index()][lane as usize * limbs..][..limbs], width }
    }

    fn evaluate(&mut self, id: ValueId) {
        let cell = self.of.function.cell(id);
        let (limbs, padded) = (limbs_for(cell.width), self.of.padded(cell.lanes));
        let mut lanes = vec![0; padded as usize * limbs];
        for (lane, out) in (0..).zip(lanes.chunks_exact_mut(limbs)) {
            match () {
                () if lane < cell.lanes => self.lane(id, cell, lane, out),
                () if self.of.function.is_table(id) => {}
                () if self.is_known_beyond(cell) => self.lane(id, cell, lane, out),
                () => anything(id, lane, cell.width, out),
            }
        }
        self.lanes[id.index()] = lanes;
    }

    /// Whether the padding lanes of the last strip have the operation's result.
    fn is_known_beyond(&self, cell: &Cell) -> bool {
        match cell.kind {
            Kind::Const(_) | Kind::Alias(_) => true,
            Kind::Broadcast { of, .. } => self.of.function.cell(of).lanes == 1,
            ref kind => kind.is_elementwise(),
        }
    }

    fn lane(&self, id: ValueId, cell: &Cell, lane: u32, out: &mut [u64]) {
        let lanes_of = |id: ValueId| self.of.function.cell(id).lanes;
        match cell.kind {
            Kind::State => {
                let place = self.of.place(id);
                self.state.get_word(place.lane(lane), place.bytes(), place.width, out);
            }
            Kind::Lowered(Lowered::Slide { of, by }) => match lane.checked_add_signed(-by) {
                Some(from) if from < self.of.padded(cell.lanes) => out.copy_from_slice(self.number(of, from).limbs),
                _ => anything(id, lane, cell.width, out),
            },
            // Also in the padding lanes of the last strip.
            Kind::Broadcast { of, .. } if lanes_of(of) == 1 => out.copy_from_slice(self.number(of, 0).limbs),
            // The padding lanes of the last strip take part in it.
            Kind::Reduce { by, of, axis } if axis.count == lanes_of(of) => {
                let kind = Kind::Reduce { by, of, axis: Axis::last(self.of.padded(axis.count)) };
                self.operation(&Cell::new(kind, 1, cell.width), lane, out);
            }
            _ => self.operation(cell, lane, out),
        }
    }

    fn operation(&self, cell: &Cell, lane: u32, out: &mut [u64]) {
        if let Kind::Lowered(Lowered::Gather { of, at }) = cell.kind {
            let number = self.number(at, lane).limbs[0];
            let lanes = self.of.function.cell(of).lanes;
            assert!(number < lanes.into(), "lane {number} of {lanes} is taken: {cell:?}");
        }
        let word = |memory: u32, lane: u32, address: Number, out: &mut [u64]| {
            let at = self.of.memories[memory as usize];
            assert!(lane < at.lanes, "lane {lane} of {} is read: {cell:?}", at.lanes);
            bank(&at).get_word(at.at(lane, address.limbs[0] as u32), at.words.word, at.width, out);
        };
        semantics::lane_with_words(cell, lane, out, |id, lane| self.number(id, lane), word);
    }

    fn sink(&self, sink: &Sink) {
        match *sink {
            Sink::Register { state, next, enable } => {
                let place = self.of.place(state);
                for lane in 0..place.lanes {
                    if enable.is_none_or(|enable| self.number(enable, lane).limbs[0] == 1) {
                        self.put(place, lane, next);
                    }
                }
            }
            Sink::Show(value) => {
                let place = self.of.place(value);
                (0..place.lanes).for_each(|lane| self.put(place, lane, value));
            }
            Sink::Write { memory, enable, address, data } => {
                let at = self.of.memories[memory as usize];
                for lane in (0..self.of.padded(at.lanes)).filter(|&lane| self.number(enable, lane).limbs[0] == 1) {
                    assert!(lane < at.lanes, "lane {lane} of {} is written: {sink:?}", at.lanes);
                    let address = self.number(address, lane).limbs[0];
                    if address < at.depth.into() {
                        let word = at.at(lane, address as u32);
                        bank(&at).put_word(word, at.words.word, at.width, self.number(data, lane).limbs);
                    }
                }
            }
            Sink::Row { row, at, value } => {
                let limbs = self.number(value, 0).limbs;
                let first = self.number(row, 0).limbs[0] as usize + 8 * at;
                // SAFETY: the row's address is that of a place for as many limbs: see `rows`.
                #[allow(unsafe_code, reason = "code is told where rows are")]
                let to = unsafe { std::slice::from_raw_parts(first as *const Number64<u64>, limbs.len()) };
                to.iter().zip(limbs).for_each(|(to, limb)| to.set(*limb));
            }
            Sink::ContinueIf(_) => {}
        }
    }

    fn put(&self, place: Place, lane: u32, value: ValueId) {
        self.state.put_word(place.lane(lane), place.bytes(), place.width, self.number(value, lane).limbs);
    }
}

/// The bank of a memory.
fn bank(at: &MemoryAt) -> Cells<'static> {
    let first = (at.address - at.first) as *const Number64<u64>;
    // SAFETY: the bank has this address and size as long as the engine lives; code and this function access it as
    // cells.
    #[allow(unsafe_code, reason = "code is told where memories are")]
    Cells(unsafe { std::slice::from_raw_parts(first, at.words.size.div_ceil(8)) })
}

/// An arbitrary value for an undefined lane, different for each value and lane.
fn anything(id: ValueId, lane: u32, width: u32, out: &mut [u64]) {
    let mut number = (u64::from(id.0) << 32 | u64::from(lane)).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    for limb in out.iter_mut() {
        number = number.wrapping_mul(0xbf58_476d_1ce4_e5b9).rotate_left(29);
        *limb = number;
    }
    *out.last_mut().expect("a value has a limb") &= top_mask(width);
}
