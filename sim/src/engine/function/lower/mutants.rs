//! Lowered functions with one mistake each: each is rejected or behaves differently.

use std::panic::{AssertUnwindSafe, catch_unwind};

use tilewright_circuit::ir::Binary;
use tilewright_circuit::{Bits, ReadUnderWrite, limbs_for, top_mask};
use tilewright_hdl::{Module, bit, bits, block, case, cat, def, elaborate, interleave, lit, row};

use super::lower;
use crate::engine::Passes;
use crate::engine::function::demands::check_lowered;
use crate::engine::function::{Function, Maker, Sink};
use crate::engine::layout::bank;
use crate::engine::layout::bank::Bank;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::store::{Cells, Store};
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::layout::{Layout, Place};
use crate::engine::program::{Cell, Kind, Lowered, ValueId, compile};
use crate::engine::rewrite::Rewriter;
use crate::engine::running::evaluate::Evaluated;
use crate::engine::running::units;

block! {
    /// Every kind of operation that is lowered, on 5 lanes, which fill no strip.
    struct Everything;
    in EverythingIn { x: bits(32), at: bits(3), write: bit() }
    out EverythingOut { y: bits(32), z: bits(8) }
}

impl Everything {
    fn build(&self, m: Module, i: EverythingIn) -> EverythingOut {
        def!(lanes = m.reg(bits(8).of(row(5))));
        def!(other = m.reg(bits(8).of(row(5))));
        def!(index = m.reg(bits(3).of(row(5))));
        let (key, byte) = (i.at.of(row(5)), i.x.part(0, 8));
        let picked = lanes.pick(i.at) ^ other.pick(index.lane(2));
        lanes.next((lanes.previous(3) + other.following(byte)) ^ picked.of(row(5)));
        let pairs = interleave([lanes.take(2, |lane| lane), lanes.take(2, |lane| lane * 2)]);
        other.next(other.reversed() ^ pairs.take_or(5, |lane| lane + 1, picked));
        index.next(index ^ key ^ lanes.part(2, 3));

        // Words at one address for all lanes, and words at addresses of the lanes' own.
        let filled = Bits::new(8, 0xa5);
        def!(together = m.memory(8, bits(8).of(row(5)), ReadUnderWrite::Old).fill(filled));
        def!(still = m.memory(8, bits(8).of(row(5)), ReadUnderWrite::Old));
        def!(apart = m.memory(8, bits(8).of(row(5)), ReadUnderWrite::Old));
        together.write(index.bit(0), key, lanes);
        apart.write(index.bit(1), index, lanes);
        def!(words = m.reg(bits(8).of(row(5))));
        words.next(together.read_async(key) + apart.read_async(index) + still.read_async(key).pick(i.at).of(row(5)));

        def!(single = m.memory(8, 32, ReadUnderWrite::Old));
        def!(twin = m.memory(8, 32, ReadUnderWrite::Any));
        single.write(i.write, i.at, i.x);
        twin.write(i.write & i.at.bit(0), i.at, !i.x);
        def!(turned = m.reg(32));
        turned.next(cat![turned.part(0, 27), turned.part(27, 5)] ^ (single.read_async(i.at) + twin.read(i.at)));
        let coded = case(i.at, (0..6u64).map(|k| (k, lit(8, 7 + k * k * 5))), lit(8, 255));
        let sums = lanes.sum() + words.xor_all() + other.maximum() + lanes.or_all() + other.and_all();
        def!(all = m.reg(8));
        all.next(coded + sums);
        EverythingOut { y: *turned, z: *all ^ lanes.lane(3) ^ other.lane(1) }
    }
}

/// A lowered edge with its complete environment.
struct Lowering {
    function: Function,
    strips: StripSizes,
    memories: Vec<MemoryAt>,
    banks: Vec<Bank>,
    places: Vec<Option<Place>>,
    size: usize,
}

impl Lowering {
    fn new(passes: &Passes) -> Lowering {
        let program = compile(&elaborate(&Everything).unwrap(), passes);
        let mut layout = Layout::new(StripSizes::of(&program, 128));
        let (places, _) = units::places(&program, &mut layout);
        let (memories, banks) = bank::banks(&program, &layout.strips);
        let function = Maker::new(&program).edge(&[0]).0;
        let (function, _) = lower(&function, &layout.strips, &memories, passes);
        // State comes first, in the sequence of the program.
        let places = places.into_iter().flatten().map(Some).collect();
        Lowering { function, strips: layout.strips, memories, banks, places, size: layout.size }
    }

    /// The results of an edge, from a state given by the seed.
    fn run(&mut self, function: &Function, seed: u64) -> Vec<u64> {
        let mut number = seed | 1;
        let mut random = move || {
            number = number.wrapping_mul(0xbf58_476d_1ce4_e5b9).rotate_left(23) ^ seed;
            number
        };
        let mut state = Store::new(self.size, false);
        for place in self.places.iter().flatten() {
            for lane in 0..place.lanes {
                let mut limbs: Vec<u64> = (0..limbs_for(place.width)).map(|_| random()).collect();
                *limbs.last_mut().unwrap() &= top_mask(place.width);
                state.put_word(place.lane(lane), place.bytes(), place.width, &limbs);
            }
        }
        for at in &self.memories {
            for (lane, address) in (0..at.lanes).flat_map(|lane| (0..at.depth).map(move |address| (lane, address))) {
                let word = random() & top_mask(at.width);
                self.banks[at.bank].put_word(at.at(lane, address), at.words.word, at.width, &[word]);
            }
        }
        let mut places = self.places.clone();
        places.resize(function.circuit().len(), None);
        let holds = Evaluated::new(function, &places, &self.memories, &self.strips, None).run(Cells(state.limbs()));
        assert!(holds);
        let banks = self.banks.iter().flat_map(|bank| bank.limbs());
        state.limbs().iter().chain(banks).map(std::cell::Cell::get).collect()
    }

    /// Whether an edited function is rejected, breaks, or behaves differently.
    fn finds(&mut self, edited: &Function) -> bool {
        let refused = catch_unwind(AssertUnwindSafe(|| check_lowered(edited, &self.strips, &self.memories))).is_err();
        let differs = |lowering: &mut Lowering, seed: u64| {
            let expected = lowering.run(&lowering.function.clone(), seed);
            let found = catch_unwind(AssertUnwindSafe(|| lowering.run(edited, seed)));
            found.map_or(true, |found| found != expected)
        };
        refused || (1..=24).any(|seed| differs(self, seed * 0x9e37_79b9))
    }
}

/// Possible mistakes in the operation.
fn mistakes(function: &Function, cell: &Cell) -> Vec<Kind> {
    let circuit = function.circuit();
    let like = |id: ValueId| {
        let is_like = |(other, cell): &(ValueId, &Cell)| {
            *other < id && (cell.lanes, cell.width) == (circuit[id].lanes, circuit[id].width)
        };
        circuit.cells().find(is_like).map(|(other, _)| other)
    };
    let lowered = Kind::Lowered;
    match cell.kind {
        Kind::Mux { on_true, on_false, .. } => vec![Kind::Alias(on_true), Kind::Alias(on_false)],
        Kind::Binary(Binary::And, a, b) => vec![Kind::Alias(a), Kind::Alias(b)],
        Kind::Lane { of, axis, index } => {
            vec![Kind::Lane { of, axis, index: (index + 1) % axis.count }, Kind::Lane { of, axis, index: axis.count }]
        }
        Kind::Reduce { by, of, axis } => {
            let next = if by == tilewright_circuit::ir::Reduction::Or {
                tilewright_circuit::ir::Reduction::Xor
            } else {
                tilewright_circuit::ir::Reduction::Or
            };
            vec![
                Kind::Reduce { by: next, of, axis },
                Kind::Reduce { by: tilewright_circuit::ir::Reduction::Max, of, axis },
            ]
        }
        Kind::Lowered(Lowered::Gather { of, at }) => {
            let other = like(of).map(|of| lowered(Lowered::Gather { of, at }));
            [Some(lowered(Lowered::Gather { of: at, at })), other].into_iter().flatten().collect()
        }
        Kind::Lowered(Lowered::Slide { of, by }) => {
            [by - 1, by + 1, -by].map(|by| lowered(Lowered::Slide { of, by })).to_vec()
        }
        Kind::Lowered(Lowered::Word { memory, address }) => {
            let at = |memory| lowered(Lowered::Word { memory, address });
            let other = like(address).map(|address| lowered(Lowered::Word { memory, address }));
            [at(memory + 1), at(memory.wrapping_sub(1)), at(77)].into_iter().chain(other).collect()
        }
        Kind::Lowered(Lowered::WordOf { memory, address, at }) => {
            let of = |memory, address, at| lowered(Lowered::WordOf { memory, address, at });
            let others =
                [like(address).map(|address| of(memory, address, at)), like(at).map(|at| of(memory, address, at))];
            [of(memory + 1, address, at), of(memory - 1, address, at)]
                .into_iter()
                .chain(others.into_iter().flatten())
                .collect()
        }
        Kind::Lowered(Lowered::Rotate { of, left }) => {
            [left - 1, left + 1, left + 32].map(|left| lowered(Lowered::Rotate { of, left })).to_vec()
        }
        _ => Vec::new(),
    }
}

/// The function with another kind for one of its values.
fn edited(function: &Function, id: ValueId, kind: &Kind) -> Function {
    let mut circuit = function.circuit().clone();
    circuit.set_kind(id, kind.clone());
    Function { rewriter: Rewriter::of(circuit), sinks: function.sinks.clone() }
}

/// Possible mistakes in a sink.
fn mistaken_sinks(function: &Function, sink: &Sink) -> Vec<Sink> {
    let Sink::Write { memory, enable, address, data } = *sink else { return Vec::new() };
    let write = |memory| Sink::Write { memory, enable, address, data };
    let unmasked = match function.cell(enable).kind {
        Kind::Binary(Binary::And, a, b) => [a, b].map(|enable| Sink::Write { memory, enable, address, data }).to_vec(),
        _ => Vec::new(),
    };
    [write(memory + 1), write(memory.wrapping_sub(1)), write(77)].into_iter().chain(unmasked).collect()
}

fn check(passes: &Passes) -> usize {
    let mut lowering = Lowering::new(passes);
    let function = lowering.function.clone();
    check_lowered(&function, &lowering.strips, &lowering.memories);
    let mut mutants = Vec::new();
    for id in function.needed() {
        let cell = function.cell(id);
        mutants.extend(
            mistakes(&function, cell)
                .into_iter()
                .map(|kind| (format!("{:?} in place of {:?}", kind, cell.kind), edited(&function, id, &kind))),
        );
    }
    // A number that is too large, in each table of lane numbers.
    for (id, cell) in function.circuit().cells() {
        if let Kind::Lowered(Lowered::Gather { at, .. } | Lowered::WordOf { at, .. }) = cell.kind
            && let Kind::Stack { parts, .. } = &function.cell(at).kind
        {
            let mut circuit = function.circuit().clone();
            let width = function.cell(at).width;
            circuit.set_kind(*parts.last().unwrap(), Kind::Const(Bits::new(width, 1000 % (1 << width.min(30)))));
            let function = Function { rewriter: Rewriter::of(circuit), sinks: function.sinks.clone() };
            mutants.push((format!("a large number for {id:?}"), function));
        }
    }
    for (index, sink) in function.sinks.iter().enumerate() {
        for mistaken in mistaken_sinks(&function, sink) {
            let mut sinks = function.sinks.clone();
            let text = format!("{mistaken:?} in place of {sink:?}");
            sinks[index] = mistaken;
            mutants.push((text, Function { sinks, ..function.clone() }));
        }
    }
    let count = mutants.len();
    let survivors: Vec<String> =
        mutants.into_iter().filter(|(_, edited)| !lowering.finds(edited)).map(|(text, _)| text).collect();
    assert!(survivors.is_empty(), "of {count} mistakes {} go unnoticed:\n{}", survivors.len(), survivors.join("\n"));
    count
}

#[test]
fn mistakes_of_lowering_are_found() {
    // Without constant folding, some operations change nothing.
    let folding = Passes { fold: true, ..Passes::none() };
    for passes in [Passes::default(), Passes { uniform: false, ..Passes::default() }, folding] {
        let count = check(&passes);
        assert!(count > 100, "{count}");
    }
}
