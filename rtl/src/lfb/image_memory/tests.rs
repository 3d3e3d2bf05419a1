//! The image memory clock by clock: by example, and in [`model`] against a plain software model.

mod model;

use tilewright_hdl::Codes;
use tilewright_sim::Simulation;

use super::*;

type Sim = Simulation<ImageMemoryIn, ImageMemoryOut>;

const EMPTY: u64 = (1 << WORD) - 1;

fn memory() -> Sim {
    let mut sim = Simulation::of(&ImageMemory { pages: 3, page_pixels: 16 }).unwrap();
    sim.reset();
    sim
}

/// Draws as soon as the second stage takes a pixel; returns the states on the way.
fn draw(sim: &mut Sim, [page, offset, word]: [u64; 3]) -> Vec<&'static str> {
    let i = sim.i.draw;
    for (port, value) in [(i.page, page), (i.offset, offset), (i.word, word)] {
        sim.set(port, value);
    }
    let mut states = Vec::new();
    while !["Idle", "Write"].contains(&state(sim)) {
        states.extend(clocks(sim, 1));
        assert!(states.len() < 9, "a pixel never ends: {states:?}");
    }
    sim.set(i.valid, 1);
    states.extend(clocks(sim, 1));
    sim.set(i.valid, 0);
    states
}

fn state(sim: &mut Sim) -> &'static str {
    sim.code::<Stage2>("stage2").unwrap().name()
}

fn clocks(sim: &mut Sim, n: u64) -> Vec<&'static str> {
    let clock = |_| {
        let state = state(sim);
        sim.step_clock(PE, 1);
        state
    };
    (0..n).map(clock).collect()
}

/// What the scan gets from an address of a buffer.
fn take(sim: &mut Sim, [buffer, page, offset]: [u64; 3]) -> u64 {
    let i = sim.i.send;
    for (port, value) in [(i.enable, 1), (i.resident, 1), (i.page, page), (i.offset, offset), (i.buffer, buffer)] {
        sim.set(port, value);
    }
    sim.step_clock(MERGE, 1);
    sim.set(i.enable, 0);
    sim.get_u64(sim.o.sent)
}

#[test]
fn a_pixel_takes_3_clocks_and_the_smaller_word_stays() {
    let mut sim = memory();
    assert_eq!(draw(&mut sim, [2, 5, 70]), ["Idle"]);
    assert_eq!(draw(&mut sim, [2, 5, 60]), ["Read", "Compare", "Write"]);
    assert_eq!(draw(&mut sim, [2, 5, 61]), ["Read", "Compare", "Write"]);
    assert_eq!(draw(&mut sim, [1, 5, 80]), ["Read", "Compare", "Write"]);
    assert_eq!(clocks(&mut sim, 4), ["Read", "Compare", "Write", "Idle"]);
    assert_eq!([[0, 2, 5], [0, 1, 5], [0, 0, 5]].map(|place| take(&mut sim, place)), [60, 80, EMPTY]);
}

/// Pages of 25 pixels: each address has a word of its own.
#[test]
fn a_page_may_have_any_number_of_pixels() {
    let mut sim = Simulation::of(&ImageMemory { pages: 3, page_pixels: 25 }).unwrap();
    sim.reset();
    let places: Vec<[u64; 2]> = (0..3).flat_map(|page| [0, 9, 15, 16, 24].map(|offset| [page, offset])).collect();
    for (word, [page, offset]) in (100..).zip(&places) {
        draw(&mut sim, [*page, *offset, word]);
    }
    clocks(&mut sim, 4);
    for (word, [page, offset]) in (100..).zip(places) {
        assert_eq!(take(&mut sim, [0, page, offset]), word, "page {page}, offset {offset}");
    }
}

/// The word read, and the result of its comparison, stay until the next pixel.
#[test]
fn an_access_clock_by_clock() {
    let mut sim = Simulation::of(&ImageMemory { pages: 3, page_pixels: 16 }).unwrap().seeded(1);
    sim.reset();
    sim.step_clock(PE, 1);
    let wave = sim.record(["draw_valid", "begins", "stage2", "drawn_address", "drawn_word", "old_word", "nearer"]);
    draw(&mut sim, [2, 5, 70]);
    draw(&mut sim, [2, 5, 80]);
    draw(&mut sim, [2, 5, 60]);
    clocks(&mut sim, 5);
    wave.expect(
        r"
        pe_clk        |~~~~~~~\______/~~~~~~~\______/~~~~~~~~~~~~~~~~~~~~~~\______/~~~~~~~\______/~~~~~~~\______/
        merge_clk     |~~~~~~~\____________________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______________
        draw_valid    |~~~~~~~~~~~~~~\____________________________________________/~~~~~~~~~~~~~~\_______________
        begins        |~~~~~~~~~~~~~~\____________________________________________/~~~~~~~~~~~~~~\_______________
        stage2        | Idle         | Read         | Compare                     | Write        | Read         |
        drawn_address | 35           | 4a                                                                       |
        drawn_word    | 820e34dffaf9 | 46                                                        | 50           |
        old_word      | 22eb81209a1e                | ffffffffffff                                              |
        nearer        |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~

        pe_clk        |~~~~~~~\_____________________/~~~~~~~\______/~~~~~~~\______/~~~~~~~\_____________________/
        merge_clk     |______________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_____________________/~~~~~~~~~~~~~~~
        draw_valid    |_____________________________/~~~~~~~~~~~~~~\_____________________________________________
        begins        |_____________________________/~~~~~~~~~~~~~~\_____________________________________________
        stage2        | Compare                     | Write        | Read         | Compare                     |
        drawn_address | 4a                                                                                      |
        drawn_word    | 50                                         | 3c                                         |
        old_word      | 46                                                                                      |
        nearer        |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\____________________________________________________________

        pe_clk        |~~~~~~~\______/~~~~~~~\______/~~~~~~~\______/
        merge_clk     |~~~~~~~~~~~~~~~~~~~~~~\_____________________/
        draw_valid    |_____________________________________________
        begins        |_____________________________________________
        stage2        | Write        | Idle                        |
        drawn_address | 4a                                         |
        drawn_word    | 3c                                         |
        old_word      | 46                                         |
        nearer        |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        ",
    );
}

#[test]
fn what_is_sent_is_cleared_and_the_other_buffer_is_not() {
    let mut sim = memory();
    draw(&mut sim, [1, 7, 42]);
    clocks(&mut sim, 3);
    sim.set(sim.i.front, 1);
    draw(&mut sim, [1, 7, 43]);
    clocks(&mut sim, 3);
    assert_eq!([[0, 1, 7], [0, 1, 7], [1, 1, 7]].map(|place| take(&mut sim, place)), [42, EMPTY, 43]);
}

#[test]
fn a_pixel_under_way_stays_in_its_buffer_when_the_buffers_are_swapped() {
    let mut sim = memory();
    draw(&mut sim, [0, 3, 9]);
    sim.set(sim.i.front, 1);
    clocks(&mut sim, 3);
    assert_eq!([[1, 0, 3], [0, 0, 3]].map(|place| take(&mut sim, place)), [EMPTY, 9]);
}

#[test]
fn the_word_sent_stays_while_the_scan_does_not_advance() {
    let mut sim = memory();
    draw(&mut sim, [0, 0, 5]);
    clocks(&mut sim, 3);
    assert_eq!(take(&mut sim, [0, 0, 0]), 5);
    sim.set(sim.i.send.resident, 0);
    sim.step_clock(MERGE, 3);
    assert_eq!(sim.get_u64(sim.o.sent), 5);
    sim.set(sim.i.send.enable, 1);
    sim.step_clock(MERGE, 1);
    assert_eq!(sim.get_u64(sim.o.sent), EMPTY, "a pixel without a page is empty");
}

/// The third clock writes, and the next pixel may already come in it.
#[test]
fn a_pixel_less_than_3_clocks_after_another_is_an_error() {
    for (clock, is_error) in [(1, true), (2, true), (3, false)] {
        let mut sim = memory();
        draw(&mut sim, [0, 0, 1]);
        clocks(&mut sim, clock - 1);
        sim.set(sim.i.draw.valid, 1);
        let problem = sim.try_run_to(sim.time() + PE.period.picoseconds()).err().map(|problem| problem.to_string());
        assert_eq!(problem.is_some(), is_error, "clock {clock}: {problem:?}");
        let sentence = "a pixel comes only when the second stage is idle or in its last clock";
        assert!(problem.is_none_or(|problem| problem.contains(sentence)), "clock {clock}");
    }
}
