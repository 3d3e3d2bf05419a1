//! What is found agrees with the simulator: resets, power-on values, memories, lanes, assumptions.

use crate::harness::{design, proof, words};
use tilewright_gen::tools::skipped_without;
use tilewright_hdl::*;
use tilewright_prove::{Outcome, Prover, Stage};
use tilewright_sim::{EngineKind, Error, Simulation};

block! {
    /// A queue's count. Where it is not guarded, a word can be taken from an empty queue.
    struct Count { guarded: bool }
    in CountIn { push: bit(), pop: bit() }
    out CountOut { used: up_to(5) }
}

impl Count {
    fn build(&self, m: Module, i: CountIn) -> CountOut {
        def!(used = m.reg(up_to(5)).reset(0));
        let pops = if self.guarded { i.pop & used.ne(0) } else { i.pop };
        used.when(i.push & !pops & used.ne(5), used + 1).when(pops & !i.push, used - 1);
        m.assert(used.le(5), "there are five at most");
        m.cover("it is full", used.eq(5));
        m.cover("it is overfull", used.eq(6));
        CountOut { used: *used }
    }
}

#[test]
fn assertions_are_proved_and_covers_are_reached_or_never() {
    let Some(proof) = proof(&design(&Count { guarded: true }), 10) else { return };
    let expected = [
        ("there are five at most", "proved over 1"),
        ("it is full", "happens in 5"),
        ("it is overfull", "proved over 1"),
    ];
    assert_eq!(words(&proof), expected.map(|(message, word)| (message, word.to_owned())));
}

#[test]
fn a_proof_without_time_for_its_formulas_has_all_statements_and_says_why_they_are_open() {
    if skipped_without(&["yosys"]).is_some() {
        return;
    }
    let proof = Prover::new().seconds(0).prove(&design(&Count { guarded: true })).unwrap();
    assert_eq!(words(&proof).into_iter().map(|it| it.1).collect::<Vec<_>>(), ["holds for 0"; 3]);
    assert_eq!(proof.late, Some(Stage::Conversion));
}

block! {
    /// A row of counts.
    struct Counts;
    in CountsIn { pushes: bit().of(row(2)), pops: bit().of(row(2)) }
    out CountsOut { used: up_to(5).of(row(2)) }
}

impl Counts {
    fn build(&self, m: Module, i: CountsIn) -> CountsOut {
        let each = |_| CountIn { push: i.pushes, pop: i.pops };
        CountsOut { used: m.array("u_count", 2, &Count { guarded: true }, each).used }
    }
}

block! {
    /// Two rows, one behind the other.
    struct Deep;
    in = CountsIn { pushes: bit().of(row(2)), pops: bit().of(row(2)) };
    out = CountsOut { used: up_to(5).of(row(2)) };
}

impl Deep {
    fn build(&self, m: Module, i: CountsIn) -> CountsOut {
        def!(first = m.instance(&Counts, i));
        m.instance("u_second", &Counts, CountsIn { pushes: first.used.bit(0), pops: i.pops })
    }
}

/// Yosys gives a statement the places of the instances around it as well.
#[test]
fn statements_of_inner_instances_are_proved() {
    let Some(proof) = proof(&design(&Deep), 10) else { return };
    let outcome = words(&proof).remove(0);
    assert_eq!(outcome, ("there are five at most", "proved over 1".to_owned()));
}

#[test]
fn a_counterexample_fails_at_the_same_clock_on_every_engine() {
    let design = design(&Count { guarded: false });
    let Some(proof) = proof(&design, 10) else { return };
    let Outcome::Fails(run) = &proof.statements[0].outcome else { panic!("{proof:?}") };
    assert_eq!((run.clock, run.instance.as_str()), (1, "count"));
    for engine in [EngineKind::Reference, EngineKind::Both] {
        let sim = Simulation::from_design(&design).unwrap().on(engine);
        let mut sim = sim.starting_as(&run.recording).unwrap();
        match sim.replay(&run.recording) {
            Err(Error::Violated(violations)) => {
                assert_eq!((violations[0].cycle, &*violations[0].message), (1, "there are five at most"));
            }
            other => panic!("{other:?}"),
        }
    }
}

block! {
    /// State of all kinds, of which statements say something that holds or does not.
    struct Starts;
    in StartsIn { at: bits(2), word: bits(4), write: bit() }
    out StartsOut { all: bits(4) }
}

impl Starts {
    fn build(&self, m: Module, i: StartsIn) -> StartsOut {
        def!(anything = m.reg(4));
        anything.next(*anything);
        def!(nine = m.reg(4).initial(9));
        nine.next(*nine);
        def!(five = m.reg(4).reset(5));
        five.next(*five);
        def!(known = m.memory(4, 4, ReadUnderWrite::Old).words([1, 2, 3, 4]));
        def!(unknown = m.memory(4, 4, ReadUnderWrite::Old));
        unknown.write(i.write, i.at, i.word);
        def!(late = unknown.read(i.at));
        let word = known.read_async(i.at);
        m.assert(anything.ne(11), "a register without a reset is not 11");
        m.assert(nine.eq(9), "a value at power-on stays");
        m.assert(five.eq(5), "a reset value stays");
        m.assert(word.eq(i.at.zext(4) + 1), "the contents are as given");
        m.assert(unknown.read_async(i.at).ne(12), "no unknown word is 12");
        m.assert(late.ne(13), "no read word is 13");
        StartsOut { all: *anything ^ late ^ *nine ^ *five }
    }
}

#[test]
fn what_has_no_value_at_the_start_has_any_value() {
    let design = design(&Starts);
    let Some(proof) = proof(&design, 4) else { return };
    let words = words(&proof).into_iter().map(|(_, word)| word).collect::<Vec<_>>();
    let expected = ["happens in 0", "proved over 1", "proved over 1", "proved over 1", "happens in 0", "happens in 0"];
    assert_eq!(words, expected, "{proof:?}");
}

block! {
    /// A cell of a ring.
    struct Cell;
    in CellIn { x: bits(4) }
    out CellOut { y: bits(4) }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        def!(held = m.reg(4).reset(0));
        held.next(i.x);
        m.assert(held.ne(7), "no cell has 7");
        CellOut { y: *held }
    }
}

block! {
    /// Cells in a row, and a row of registers whose lanes start apart.
    struct Row { most: u64 }
    in RowIn { x: bits(4) }
    out RowOut { all: bits(4) }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        m.assume(i.x.le(self.most), "the input is small");
        let cells = m.array("u_cell", 3, &Cell, |row| CellIn { x: row.y.previous(i.x) });
        def!(ring = m.reg(bits(4).of(row(3))).reset_each([1, 2, 3]));
        ring.next(ring.previous(ring.last()));
        m.assert(ring.ne(0), "no lane is zero");
        m.assert(ring.ne(3) | cells.y.ne(3), "a lane and its cell are not both 3");
        RowOut { all: cells.y.xor_all() ^ ring.xor_all() }
    }
}

#[test]
fn instances_and_lanes_count_and_assumptions_bind() {
    let Some(found) = proof(&design(&Row { most: 6 }), 8) else { return };
    assert_eq!(
        words(&found).into_iter().map(|(_, word)| word).collect::<Vec<_>>(),
        ["proved over 1", "proved over 1", "happens in 1"]
    );
    let Some(found) = proof(&design(&Row { most: 7 }), 8) else { return };
    let Outcome::Fails(run) = &found.statements[0].outcome else { panic!("{found:?}") };
    assert_eq!((run.clock, run.instance.as_str()), (1, "u_cell[0]"));
}

block! {
    /// A condition that only the reset brings about.
    struct Resets;
    in ResetsIn { x: bit() }
    out ResetsOut { count: bits(3) }
}

impl Resets {
    fn build(&self, m: Module, i: ResetsIn) -> ResetsOut {
        def!(count = m.reg(3).reset(2));
        def!(seen = m.reg(1).initial(0));
        seen.when(i.x, 1);
        count.when(i.x, count + 1);
        m.assert(!(*seen & count.eq(2)), "after an input it is not as after a reset");
        m.assert(count.ne(7), "it does not count to 7");
        ResetsOut { count: *count }
    }
}

#[test]
fn a_reset_may_come_at_any_time() {
    for reset in [Reset::Synchronous, Reset::SynchronousLow, Reset::Asynchronous, Reset::AsynchronousLow] {
        let clock = DefaultClock::new(DEFAULT_PERIOD).reset(reset);
        let design = elaborate_at(&Resets, clock).unwrap();
        let Some(proof) = proof(&design, 8) else { return };
        let runs = proof.statements.iter().map(|it| match &it.outcome {
            Outcome::Fails(run) => (run.clock, run.recording.steps.iter().any(|step| !step.resets.is_empty())),
            other => panic!("{other:?}"),
        });
        // An input is seen although the reset is active; without a reset it takes five inputs to 7.
        assert_eq!(runs.collect::<Vec<_>>(), [(1, true), (5, false)], "{reset:?}");
    }
}

block! {
    /// A cover that is first reached in a clock in which an assertion may fail.
    struct Together;
    in TogetherIn { x: bits(2) }
    out TogetherOut { same: bits(2) }
}

impl Together {
    fn build(&self, m: Module, i: TogetherIn) -> TogetherOut {
        m.assert(i.x.ne(2), "it is not 2");
        m.cover("it is above 1", i.x.gt(1));
        TogetherOut { same: i.x }
    }
}

#[test]
fn a_cover_is_reached_without_a_failure() {
    let Some(found) = proof(&design(&Together), 2) else { return };
    let Outcome::Fails(run) = &found.statements[1].outcome else { panic!("{found:?}") };
    assert_eq!(run.recording.steps[0].inputs[0], 3);
}
