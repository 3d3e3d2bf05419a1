//! The patch table clock by clock: by example, and in [`model`] against a plain software model.

mod model;

use tilewright_hdl::Codes;
use tilewright_sim::{Port, Simulation};

use super::*;

type Sim = Simulation<PatchTableIn, PatchTableOut>;

fn table(patches: u32, pages: u32) -> Sim {
    let mut sim = Simulation::of(&PatchTable { patches, pages }).unwrap();
    sim.set(sim.i.settled, 1);
    sim.reset();
    sim
}

/// Requests a patch's page until the request is accepted; returns the states on the way.
fn look_up(sim: &mut Sim, patch: u64) -> Vec<&'static str> {
    let (valid, number, ready) = (sim.i.look_up.valid, sim.i.look_up.patch, sim.i.look_up.ready);
    offer(sim, [valid, number], patch, ready)
}

/// Like [`look_up`], to clear an entry.
fn clear(sim: &mut Sim, patch: u64) -> Vec<&'static str> {
    let (valid, number, ready) = (sim.i.clear.valid, sim.i.clear.patch, sim.i.clear.ready);
    offer(sim, [valid, number], patch, ready)
}

fn offer(sim: &mut Sim, [valid, number]: [Port; 2], patch: u64, ready: Port) -> Vec<&'static str> {
    sim.set(valid, 1);
    sim.set(number, patch);
    let mut states = Vec::new();
    while states.len() < 9 {
        let accepted = sim.get(ready) == 1;
        states.extend(clocks(sim, 1));
        if accepted {
            sim.set(valid, 0);
            return states;
        }
    }
    panic!("the request is never accepted: {states:?}");
}

/// Lets clocks pass; returns the states in them.
fn clocks(sim: &mut Sim, n: u64) -> Vec<&'static str> {
    let state = |sim: &mut Sim| {
        let stage = sim.code::<Stage1>("stage1").unwrap();
        sim.step_clock(PE, 1);
        stage.name()
    };
    (0..n).map(|_| state(sim)).collect()
}

fn pulse(port: Port, sim: &mut Sim) {
    sim.set(port, 1);
    sim.step_clock(PE, 1);
    sim.set(port, 0);
}

#[test]
fn a_look_up_takes_4_clocks_at_first_and_3_from_then_on() {
    let mut sim = table(6, 4);
    assert_eq!(look_up(&mut sim, 5), ["Idle"]);
    assert_eq!(look_up(&mut sim, 5), ["Read", "Examine", "Allocate", "Found"]);
    assert_eq!(look_up(&mut sim, 2), ["Read", "Examine", "Found"]);
    assert_eq!(look_up(&mut sim, 5), ["Read", "Examine", "Allocate", "Found"]);
    assert_eq!(clocks(&mut sim, 4), ["Read", "Examine", "Found", "Idle"]);
    assert_eq!((sim.get_u64(sim.o.page), sim.get_u64(sim.o.pages_used)), (0, 2));
}

/// A look-up that waits for a clear, and the values that it keeps until the next one.
#[test]
fn a_clear_and_a_look_up_clock_by_clock() {
    let mut sim = Simulation::of(&PatchTable { patches: 6, pages: 4 }).unwrap().seeded(1);
    sim.set(sim.i.settled, 1);
    sim.reset();
    sim.step_clock(PE, 1);
    let wave = sim.record([
        "clear_valid",
        "clear_ready",
        "clearing",
        "look_up_valid",
        "look_up_ready",
        "stage1",
        "patch",
        "address",
        "entry_resident",
        "page",
    ]);
    look_up(&mut sim, 3);
    clear(&mut sim, 5);
    sim.set(sim.i.look_up.patch, 4);
    clocks(&mut sim, 6);
    look_up(&mut sim, 3);
    clocks(&mut sim, 5);
    wave.expect(
        r"
        pe_clk         |~~~~~\____/~~~~~\____/~~~~~~~~~~~~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\_______________/
        merge_clk      |~~~~~\__________________________/~~~~~~~~~~~~~~~~~~~~~\_____________________/~~~~~~~~~~~
        clear_valid    |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\______________________
        clear_ready    |~~~~~~~~~~\___________________________________________/~~~~~~~~~~\______________________
        clearing       | 0                                                               | 2                   |
        look_up_valid  |~~~~~~~~~~\_____________________________________________________________________________
        look_up_ready  |~~~~~~~~~~\___________________________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        stage1         | Idle     | Read     | Examine             | Allocate | Found    | Idle                |
        patch          | 5        | 3                                                                          |
        address        | a        | 6                                         | a        | 6                   |
        entry_resident |~~~~~~~~~~~~~~~~~~~~~\__________________________________________________________________
        page           | 0                                                                                     |

        pe_clk         |~~~~~\____/~~~~~\____/~~~~~\_______________/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        merge_clk      |~~~~~~~~~~~~~~~~\_______________/~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______________/~~~~~~~~~~~
        clear_valid    |________________________________________________________________________________________
        clear_ready    |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\___________
        clearing       | 1        | 0                                                                          |
        look_up_valid  |_________________________________________________________________/~~~~~~~~~~\___________
        look_up_ready  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\___________
        stage1         | Idle                                                                       | Read     |
        patch          | 3                                                                                     |
        address        | 6                                                                                     |
        entry_resident |________________________________________________________________________________________
        page           | 0                                                                                     |

        pe_clk         |~~~~~\____/~~~~~\____/~~~~~~~~~~~~~~~~\____/~~~~~\____/
        merge_clk      |~~~~~\__________________________/~~~~~~~~~~~~~~~~\_____
        clear_valid    |_______________________________________________________
        clear_ready    |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        clearing       | 0                                                    |
        look_up_valid  |_______________________________________________________
        look_up_ready  |__________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        stage1         | Examine  | Found    | Idle                           |
        patch          | 3                                                    |
        address        | 6                                                    |
        entry_resident |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        page           | 0                                                    |
        ",
    );
}

#[test]
fn a_clear_takes_3_clocks_and_comes_before_a_look_up_of_the_same_edge() {
    let mut sim = table(6, 4);
    look_up(&mut sim, 3);
    clocks(&mut sim, 4);
    assert_eq!(clear(&mut sim, 0), ["Idle"]);
    assert_eq!(clear(&mut sim, 1), ["Idle"; 3]);
    clocks(&mut sim, 2);
    sim.drive(PatchTableIn {
        look_up: Stream::of(1, Wanted { patch: 3 }),
        clear: Stream::of(1, Wanted { patch: 3 }),
        settled: 1,
        ..PatchTableIn::default()
    });
    assert_eq!(clocks(&mut sim, 1), ["Idle"]);
    sim.drive(PatchTableIn { settled: 1, ..PatchTableIn::default() });
    assert_eq!(clocks(&mut sim, 6), ["Read", "Read", "Read", "Examine", "Allocate", "Found"]);
    assert_eq!(sim.get_u64(sim.o.page), 1, "a cleared patch gets a new page");
}

#[test]
fn a_reset_ends_a_clear() {
    for wait in 0..4 {
        let mut sim = table(6, 4);
        clocks(&mut sim, wait);
        clear(&mut sim, 1);
        assert_eq!(sim.get_u64(sim.i.clear.ready), 0);
        sim.reset();
        assert_eq!(sim.get_u64(sim.i.clear.ready), 1, "a reset {wait} clocks after the first");
    }
}

#[test]
fn an_overflow_holds_the_look_up_until_it_is_resumed() {
    let mut sim = table(6, 2);
    for patch in [4, 5, 4, 0] {
        look_up(&mut sim, patch);
    }
    assert_eq!(clocks(&mut sim, 5), ["Read", "Examine", "Overflow", "Overflow", "Overflow"]);
    assert_eq!((sim.get_u64(sim.o.overflow), sim.get_u64(sim.i.look_up.ready)), (1, 0));

    // No page is free yet: the overflow continues.
    pulse(sim.i.resume, &mut sim);
    assert_eq!(clocks(&mut sim, 3), ["Read", "Examine", "Overflow"]);

    // The processor swaps, clears, and resumes while the last clear still runs.
    sim.set(sim.i.front, 1);
    pulse(sim.i.restart, &mut sim);
    assert_eq!((0..6).map(|patch| clear(&mut sim, patch).len()).collect::<Vec<_>>(), [1, 3, 3, 3, 3, 3]);
    pulse(sim.i.resume, &mut sim);
    assert_eq!(clocks(&mut sim, 5), ["Read", "Read", "Examine", "Allocate", "Found"]);
    assert_eq!((sim.get_u64(sim.o.page), sim.get_u64(sim.o.pages_used)), (0, 1));
    assert_eq!(sim.covered("a look-up finds no free page").unwrap(), 2);
}

#[test]
fn the_processor_waits_until_the_scan_has_left_the_front_buffer() {
    let mut sim = table(6, 2);
    sim.set(sim.i.settled, 0);
    assert_eq!(sim.get_u64(sim.i.clear.ready), 0);
    look_up(&mut sim, 1);
    assert_eq!(clocks(&mut sim, 3), ["Read"; 3]);
    sim.set(sim.i.settled, 1);
    assert_eq!(clocks(&mut sim, 4), ["Read", "Examine", "Allocate", "Found"]);
}

#[test]
fn the_scan_reads_the_buffer_it_names() {
    let mut sim = table(6, 4);
    look_up(&mut sim, 1);
    look_up(&mut sim, 3);
    clocks(&mut sim, 5);
    let mut entry = |patch, buffer| {
        sim.drive(PatchTableIn { scan: ScanLookUp { enable: 1, patch, buffer }, ..PatchTableIn::default() });
        sim.step_clock(MERGE, 1);
        let Entry { resident, page } = sim.read_u64().scan_entry;
        (resident == 1).then_some(page)
    };
    assert_eq!([entry(1, 0), entry(3, 0), entry(2, 0), entry(3, 1)], [Some(0), Some(1), None, None]);
}
