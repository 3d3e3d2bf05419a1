//! Ways back through the clocks of small circuits.

use tilewright_circuit::{Clock, Period, ReadUnderWrite};
use tilewright_hdl::{Module, bit, bits, block, def, grid, mux, row};

use crate::testbench::cause::{Cause, End, Limits};
use crate::{EngineKind, Error, Simulation, Vcd};

block! {
    /// Keeps what it is given under an address, and gives what was kept last.
    struct Shelf;
    in ShelfIn { put: bit(), at: bits(2), what: bits(8), latch: bit() }
    out ShelfOut { seen: bits(8) }
}

impl Shelf {
    fn build(&self, m: Module, i: ShelfIn) -> ShelfOut {
        def!(shelf = m.memory(4, 8, ReadUnderWrite::Old).words([10, 11, 12, 13]));
        shelf.write(i.put, i.at, i.what);
        def!(place = m.reg(2).reset(1));
        place.next(mux(i.latch, i.at, *place));
        def!(seen = m.reg(8).reset(0));
        seen.next(shelf.read_async(*place));
        ShelfOut { seen: *seen }
    }
}

/// The tree without places, a line each.
fn lines(cause: &Cause) -> Vec<String> {
    let text = cause.to_string();
    let without_place = |line: &str| match line.split_once("  sim/src") {
        Some((before, after)) => format!("{before}{}", after.find("  ").map_or("", |end| &after[end..])),
        None => line.to_owned(),
    };
    text.lines().map(without_place).collect()
}

fn shelf(kind: EngineKind) -> Simulation<ShelfIn, ShelfOut> {
    let mut sim = Simulation::of(&Shelf).unwrap().on(kind);
    sim.remember_often(1 << 20, 50);
    sim
}

#[test]
fn a_word_comes_from_the_write_that_put_it_there() -> Result<(), Error> {
    for kind in [EngineKind::Interpreter, EngineKind::Compiled] {
        let mut sim = shelf(kind);
        sim.run(3);
        sim.set(sim.i.put, 1);
        sim.set(sim.i.at, 2);
        sim.set(sim.i.what, 77);
        sim.step();
        sim.set(sim.i.put, 0);
        sim.set(sim.i.what, 5);
        sim.run(200);
        sim.set(sim.i.latch, 1);
        sim.step();
        sim.set(sim.i.latch, 0);
        sim.set(sim.i.at, 0);
        sim.run(300);
        let before = sim.checkpoint();
        let cause = sim.why("seen")?;
        let said = [
            "seen = 77  cycle 505",
            "  from shelf[2] = 77  cycle 4",
            "    from what = 77  cycle 3  input",
            "    when put = 1  cycle 3  input",
            "    when at = 2  cycle 3  input",
            "  when place = 2  cycle 205",
            "    from at = 2  cycle 204  input",
            "    when latch = 1  cycle 204  input",
        ];
        assert_eq!(lines(&cause), said);
        assert!(sim.checkpoint() == before, "to ask changes nothing");
        assert_eq!(cause.causes[0].causes[0].time, 30_000);
    }
    Ok(())
}

#[test]
fn a_reset_the_testbench_and_the_start_are_where_it_ends() -> Result<(), Error> {
    let mut sim = shelf(EngineKind::Interpreter);
    sim.run(70);
    let start = sim.why("seen")?;
    assert_eq!(
        lines(&start)[1..],
        ["  from shelf[1] = 11  cycle 0  from the start", "  when place = 1  cycle 0  from the start"]
    );
    sim.reset();
    sim.poke_memory("shelf", 1, 99)?;
    sim.run(5);
    let cause = sim.why("seen")?;
    let ends = ["  from shelf[1] = 99  cycle 71  set by the testbench", "  when place = 1  cycle 71  by reset"];
    assert_eq!(lines(&cause)[1..], ends);
    assert_eq!(lines(&sim.why("shelf[3]")?), ["shelf[3] = 13  cycle 0  from the start"]);
    Ok(())
}

#[test]
fn what_kept_a_state_is_told_on_demand() -> Result<(), Error> {
    let mut sim = shelf(EngineKind::Interpreter);
    sim.run(2);
    let limits = Limits { kept: true, ..Limits::default() };
    let said =
        ["place = 1  cycle 0  from the start", "  when latch = 0  cycle 1  input", "  when latch = 0  cycle 0  input"];
    assert_eq!(lines(&sim.why_within("place", &limits)?), said);
    Ok(())
}

#[test]
fn limits_end_the_tree_and_say_so() -> Result<(), Error> {
    let mut sim = shelf(EngineKind::Interpreter);
    sim.run(9);
    let cause = sim.why_within("seen", &Limits { depth: 1, ..Limits::default() })?;
    assert!(cause.causes.iter().all(|cause| cause.causes.is_empty()));
    assert_eq!(cause.notes(), ["the limits cut the tree: give `why_within` larger ones to see all"]);
    let unknown = sim.why("sean").unwrap_err().to_string();
    assert_eq!(unknown, "there is no signal `sean`: did you mean `seen`?");
    Ok(())
}

block! {
    /// A memory in two lanes.
    struct Drawers;
    in DrawersIn { put: bit(), at: bits(2), what: bits(8).of(row(2)) }
    out DrawersOut { seen: bits(8).of(row(2)) }
}

impl Drawers {
    fn build(&self, m: Module, i: DrawersIn) -> DrawersOut {
        def!(drawers = m.memory(4, bits(8).of(row(2)), ReadUnderWrite::Old).fill(0));
        drawers.write(i.put, i.at, i.what);
        DrawersOut { seen: drawers.read_async(i.at) }
    }
}

#[test]
fn a_memory_has_causes_by_its_words_alone() {
    let words = |name: &str, first: &str, last: &str| {
        format!("there is no signal `{name}`: the memory has the words `{first}` to `{last}`")
    };
    for name in ["shelf", "shelf[4]", "shelf[x]"] {
        let unknown = shelf(EngineKind::Interpreter).why(name).unwrap_err().to_string();
        assert_eq!(unknown, words(name, "shelf[0]", "shelf[3]"));
    }
    let mut sim = Simulation::of(&Drawers).unwrap();
    sim.remember(1 << 20);
    for (name, lane) in [("drawers", 0), ("drawers[1]", 1), ("drawers[1][4]", 1)] {
        let [first, last] = [0, 3].map(|address| format!("drawers[{lane}][{address}]"));
        assert_eq!(sim.why(name).unwrap_err().to_string(), words(name, &first, &last));
    }
    assert!(sim.why("drawers[1][3]").is_ok());
}

block! {
    /// Three such memories.
    struct Desk;
    in DeskIn { put: bit(), at: bits(2), what: bits(8).of(grid(3, 2)) }
    out DeskOut { seen: bits(8).of(grid(3, 2)) }
}

impl Desk {
    fn build(&self, m: Module, i: DeskIn) -> DeskOut {
        let desk = m.array("u_drawers", 3, &Drawers, |_| DrawersIn { put: i.put, at: i.at, what: i.what });
        DeskOut { seen: desk.seen }
    }
}

#[test]
fn a_memory_in_an_array_is_named_with_both_lanes() -> Result<(), Error> {
    let mut sim = Simulation::of(&Desk)?;
    sim.remember(1 << 20);
    sim.set(sim.i.put, 1);
    sim.set(sim.i.at, 3);
    sim.set(sim.i.what, 0x0605_0403_0201_u64);
    sim.step();
    let cause = lines(&sim.why("u_drawers[2].seen[1]")?);
    assert_eq!(
        cause[..3],
        [
            "u_drawers[2].seen[1] = 6  cycle 1",
            "  from u_drawers[2].drawers[1][3] = 6  cycle 1",
            "    from what[2][1] = 6  cycle 0  input"
        ]
    );
    Ok(())
}

block! {
    /// Reads the word that is written, with each policy.
    struct Collision;
    in CollisionIn { put: bit(), at: bits(2), what: bits(8) }
    out CollisionOut { old: bits(8), any: bits(8) }
}

impl Collision {
    fn build(&self, m: Module, i: CollisionIn) -> CollisionOut {
        def!(calm = m.memory(4, 8, ReadUnderWrite::Old).words([10, 11, 12, 13]));
        def!(rash = m.memory(4, 8, ReadUnderWrite::Any).words([10, 11, 12, 13]));
        [calm, rash].iter().for_each(|memory| memory.write(i.put, i.at, i.what));
        CollisionOut { old: calm.read(i.at), any: rash.read(i.at) }
    }
}

/// With the policy `Any` the write decides what a read gives, and not with `Old`.
#[test]
fn a_write_is_a_cause_of_what_collides_with_it() -> Result<(), Error> {
    let mut sim = Simulation::of(&Collision)?;
    sim.remember(1 << 20);
    for (port, number) in [(sim.i.put, 1), (sim.i.at, 2), (sim.i.what, 77)] {
        sim.set(port, number);
    }
    sim.step();
    let at = "  when at = 2  cycle 0  input";
    let old = ["old = 12  cycle 1", "  from calm[2] = 12  cycle 0  from the start", at];
    let any =
        ["any = 243  cycle 1", "  from rash[2] = 12  cycle 0  from the start", at, "  when put = 1  cycle 0  input"];
    assert_eq!(lines(&sim.why("old")?), old);
    assert_eq!(lines(&sim.why("any")?), any);
    Ok(())
}

const SLOW: Clock = Clock::new("slow", Period::ns(30));

block! {
    /// Takes a value from a slow clock to a fast one.
    struct Across;
    in AcrossIn { x: bits(4) }
    out AcrossOut { late: bits(4) }
}

impl Across {
    fn build(&self, m: Module, i: AcrossIn) -> AcrossOut {
        let early = m.on(SLOW).pipe("early", i.x.quasi_static("a test"));
        AcrossOut { late: m.pipe("late", early.quasi_static("a test")) }
    }
}

#[test]
fn each_step_has_the_cycle_of_its_own_clock() -> Result<(), Error> {
    let mut sim = Simulation::of(&Across)?;
    sim.remember(1 << 20);
    for x in 0..12 {
        sim.set(sim.i.x, x);
        sim.step();
    }
    let cause = sim.why(sim.o.late)?;
    let told =
        cause.iter().map(|cause| (cause.name.clone(), cause.number(), cause.clock.clone().unwrap(), cause.cycle));
    let told: Vec<_> = told.collect();
    let step =
        |name: &str, number: &str, clock: &str, cycle| (name.to_owned(), number.to_owned(), clock.to_owned(), cycle);
    // The edge of both at 120 ns takes what the slow one had since 90 ns.
    assert_eq!(told[0], step("late", "8", "clk", 12));
    assert_eq!(told[1], step("early", "8", "slow", 3));
    assert_eq!((told[2].0.as_str(), cause.causes[0].causes[0].end), ("x", Some(End::Input)));
    Ok(())
}

#[test]
fn a_trace_neither_stops_the_way_back_nor_sees_it() -> Result<(), Error> {
    let folder = tempfile::tempdir().unwrap();
    // Some traces rest while it is asked.
    let windows = [0..u64::MAX, 1_000_000..1_400_000, 990_001..1_000_001, 2_345_678..2_345_679];
    let kinds = [EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Reference];
    for (kind, window) in kinds.into_iter().flat_map(|kind| windows.clone().map(|window| (kind, window))) {
        let run = |asks: bool| -> Result<_, Error> {
            let path = folder.path().join("shelf.vcd");
            let mut sim = shelf(kind);
            sim.trace(Vcd::to(&path).times(window.clone()))?;
            let recorder = (window.start == 0).then(|| sim.recording());
            let mut trees = Vec::new();
            for step in 0..300_u64 {
                sim.set(sim.i.put, step % 3 == 0);
                sim.set(sim.i.at, step % 4);
                sim.set(sim.i.what, step % 251);
                sim.set(sim.i.latch, step % 5 == 0);
                sim.step();
                if asks && step % 50 == 49 {
                    trees.push(sim.why_within("seen", &Limits { depth: 3, ..Limits::default() })?);
                }
            }
            sim.finish()?;
            Ok((std::fs::read(&path).unwrap(), recorder.map(|recorder| recorder.take()), trees))
        };
        let (plain, asking) = (run(false)?, run(true)?);
        assert!(asking.0 == plain.0, "the waveform is another one");
        assert_eq!((asking.1, asking.2.len()), (plain.1, 6));
        for tree in asking.2 {
            assert!(tree.iter().all(|cause| cause.end != Some(End::Unremembered)), "{tree}");
            assert!(tree.iter().any(|cause| cause.cycle + 1 < tree.cycle), "{tree}");
        }
    }
    Ok(())
}
