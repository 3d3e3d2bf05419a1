//! Evaluates lowered functions, by what operations mean, where code would run: on the same memory, at the same places. So
//! it is found out whether lowering or emission has made a mistake.
//!
//! Lanes that pad the last strip are evaluated as well. What code leaves there may be anything, so here it is what no one would
//! expect; nothing but tables, which are followed by zeros, and what is the same in all lanes is known there.

use std::cell::Cell as Number64;

use tilewright_hdl::{limbs_for, top_mask};

use super::Compiled;
use super::emitter::MemoryAt;
use super::function::{Function, Sink};
use super::jit::Code;
use super::layout::Place;
use super::prepare::{Prepared, Times};
use super::store::Cells;
use super::strips::Strips;
use crate::engine::program::{Axis, Cell, Kind, Lowered, ValueId};
use crate::engine::semantics::{self, Number};

/// A lowered function, with all that it takes and changes.
pub(super) struct Evaluated {
    function: Function,
    /// Per cell: where it is stored, if it is.
    places: Vec<Option<Place>>,
    memories: Vec<MemoryAt>,
    strips: Strips,
    /// Where a number stands that is 1 while what must hold is not asked for, if it ever is not.
    unchecked: Option<Place>,
}

/// What code in place of which functions are evaluated calls.
pub(super) struct Functions {
    parts: Vec<Evaluated>,
    times: Times,
    /// Limbs of the state.
    size: usize,
}

#[allow(unsafe_code, reason = "called by generated code")]
unsafe extern "C" fn run(functions: *const Functions, state: *const Number64<u64>, count: u64) -> u64 {
    // SAFETY: the engine that owns the code that calls this owns the functions, too, and the state, which has not become
    // smaller since they were made.
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
    /// Makes code that has these functions evaluated, one after the other, so many times.
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
        strips: &Strips,
        unchecked: Option<Place>,
    ) -> Evaluated {
        let (function, places) = (function.clone(), places.to_vec());
        Evaluated { function, places, memories: memories.to_vec(), strips: strips.clone(), unchecked }
    }

    /// Evaluates the function, and does what its sinks say; whether all holds that must.
    ///
    /// # Panics
    ///
    /// It takes a lane that there is not, or a lane that there is not writes.
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
            Sink::Hold(value) => Some(values.number(*value, 0).limbs[0] == 1),
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

    /// The lanes of a value with those that pad its last strip.
    fn padded(&self, lanes: u32) -> u32 {
        if lanes == 1 { 1 } else { lanes.next_multiple_of(self.strips.strip(lanes)) }
    }
}

/// The values of a function.
struct Values<'a> {
    of: &'a Evaluated,
    state: Cells<'a>,
    /// Per cell: the limbs of its lanes, with those that pad the last strip.
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

    /// Whether lanes that pad the last strip hold what the operation says.
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
            // Also in lanes that pad the last strip.
            Kind::Broadcast { of, .. } if lanes_of(of) == 1 => out.copy_from_slice(self.number(of, 0).limbs),
            // Those that pad the last strip come into it.
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
            Sink::Hold(_) => {}
        }
    }

    fn put(&self, place: Place, lane: u32, value: ValueId) {
        self.state.put_word(place.lane(lane), place.bytes(), place.width, self.number(value, lane).limbs);
    }
}

/// The bank that a memory is in.
fn bank(at: &MemoryAt) -> Cells<'static> {
    let first = (at.address - at.first) as *const Number64<u64>;
    // SAFETY: the bank stands there, and is so large, as long as the engine lives; code and this look at it as cells.
    #[allow(unsafe_code, reason = "code is told where memories are")]
    Cells(unsafe { std::slice::from_raw_parts(first, at.words.size.div_ceil(8)) })
}

/// What stands where nobody has put anything: some number, another one for each value and lane.
fn anything(id: ValueId, lane: u32, width: u32, out: &mut [u64]) {
    let mut number = (u64::from(id.0) << 32 | u64::from(lane)).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    for limb in out.iter_mut() {
        number = number.wrapping_mul(0xbf58_476d_1ce4_e5b9).rotate_left(29);
        *limb = number;
    }
    *out.last_mut().expect("a value has a limb") &= top_mask(width);
}
