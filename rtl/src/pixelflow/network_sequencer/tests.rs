//! The sequencer clock by clock, with the transfers of its port, and the jobs that it refuses.

use tilewright_sim::Simulation;

use super::*;

type Sequencer = Simulation<NetworkSequencerIn, NetworkSequencerOut>;

fn started(pixels: u32, setup: u32) -> Sequencer {
    let mut sim = Simulation::of(&NetworkSequencer { pixels, setup }).unwrap();
    sim.reset();
    sim
}

/// Inputs without a job; the fields of the job need not be valid.
const NONE: NetworkSequencerIn<u64> = NetworkSequencerIn {
    jobs: Stream { valid: 0, ready: 0, payload: Job { mode: Mode::Load as u64, bank: 0, bytes: 0 } },
    given: 0,
    go: 0,
    pixel: 0,
    advances: 0,
};

fn job(mode: Mode, bank: u64, bytes: u64) -> NetworkSequencerIn<u64> {
    NetworkSequencerIn { jobs: Stream::of(1, Job { mode: mode.code(), bank, bytes }), ..NONE }
}

/// The bank comes late, and then `go` comes late. The word has two bytes of two pixels.
#[test]
fn a_word_is_sent_when_the_bank_and_all_nodes_are_ready() {
    let mut sim = started(2, 1);
    let signals = ["jobs_ready", "given", "phase", "go", "ready", "mode", "sends", "first", "address", "pixel", "done"];
    let wave = sim.record(signals);
    let load = job(Mode::Load, 1, 2);
    let given = NetworkSequencerIn { given: 2, ..NONE };
    let go = NetworkSequencerIn { go: 1, ..given };
    let byte = |pixel| NetworkSequencerIn { advances: 1, pixel, ..given };
    let clocks = [load, NONE, given, given, given, given, go, byte(0), byte(1), byte(0), byte(1), NONE];
    for inputs in clocks {
        sim.drive(inputs);
        sim.step();
    }
    wave.expect(
        r"
        clk        |~~~~\____/~~~~\____/~~~~\____/~~~~\____/~~~~\____/~~~~\____/~~~~\____/~~~~\____/~~~~\____/
        jobs_ready |~~~~~~~~~\________________________________________________________________________________
        given      | 0                 | 2                                                                   |
        phase      | Idle    | Bank              | SetUp             | Ready             | Sends             |
        go         |___________________________________________________________/~~~~~~~~~\____________________
        ready      |_________________________________________________/~~~~~~~~~~~~~~~~~~~\____________________
        mode       | Forward                                         | Load                                  |
        sends      |_____________________________________________________________________/~~~~~~~~~~~~~~~~~~~~
        first      |_________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        address    | 0       | 1                                                                             |
        pixel      |_______________________________________________________________________________/~~~~~~~~~~
        done       | 0                                                                                       |

        clk        |~~~~\____/~~~~\____/~~~~\____/
        jobs_ready |___________________/~~~~~~~~~~
        given      | 2                 | 0       |
        phase      | Sends             | Idle    |
        go         |______________________________
        ready      |______________________________
        mode       | Load              | Forward |
        sends      |~~~~~~~~~~~~~~~~~~~\__________
        first      |______________________________
        address    | 0                 | 1f      |
        pixel      |_________/~~~~~~~~~\__________
        done       | 0       | 2       | 0       |
        ",
    );
}

/// In each mode the bank is released with the last byte, and the addresses decrease.
#[test]
fn each_mode_follows_the_bytes_that_come() {
    for (mode, bank) in [(Mode::Composite, 0), (Mode::Unload, 1), (Mode::Forward, 1)] {
        let mut sim = started(3, 0);
        sim.drive(job(mode, bank, 4));
        sim.step();
        let needs = if mode == Mode::Forward { 0 } else { 1 << bank };
        let given = NetworkSequencerIn { given: needs, ..NONE };
        sim.drive(given);
        sim.run(2);
        assert_eq!([sim.get_u64(sim.o.ready), sim.get_u64(sim.o.bank)], [1, needs]);
        for number in 0..12 {
            // A pause here and there.
            sim.drive(given);
            sim.run(number % 3);
            sim.drive(NetworkSequencerIn { advances: 1, pixel: number % 3, ..given });
            let out = sim.read_u64();
            assert_eq!([out.mode, out.address, out.sends], [mode.code(), 3 - number / 3, 0], "byte {number}");
            assert_eq!(out.done, if number == 11 { needs } else { 0 }, "byte {number}");
            sim.step();
        }
        sim.drive(NONE);
        let out = sim.read_u64();
        assert_eq!([out.idle, out.ready, out.bank, out.mode], [1, 0, 0, Mode::Forward.code()]);
    }
}

#[test]
#[should_panic(expected = "a word comes only when the node is ready for it")]
fn a_word_that_the_node_is_not_ready_for_is_an_error() {
    let mut sim = started(2, 3);
    sim.drive(job(Mode::Composite, 0, 1));
    sim.step();
    sim.drive(NetworkSequencerIn { advances: 1, given: 1, ..NONE });
    sim.step();
}

/// The job delays all other nodes until its set-up is over. It ends when they are ready, too.
#[test]
fn a_job_of_no_bytes_ends_when_all_are_ready() {
    let mut sim = started(2, 2);
    sim.drive(job(Mode::Forward, 0, 0));
    let mut ready = Vec::new();
    for go in [0, 0, 0, 0, 0, 0, 1, 0, 0] {
        ready.push([sim.get_u64(sim.o.ready), sim.get_u64(sim.o.idle)]);
        sim.step();
        sim.drive(NetworkSequencerIn { go, ..NONE });
    }
    let (busy, set, idle) = ([0, 0], [1, 0], [0, 1]);
    assert_eq!(ready, [busy, busy, busy, busy, busy, set, set, set, idle]);
}

#[test]
#[should_panic(expected = "a job of no bytes forwards")]
fn a_word_of_no_bytes_is_not_loaded() {
    let mut sim = started(2, 0);
    sim.drive(job(Mode::Load, 0, 0));
    sim.step();
}

#[test]
fn a_word_may_fill_a_bank() {
    let mut sim = started(2, 0);
    sim.drive(NetworkSequencerIn { jobs: Stream { valid: 0, ..job(Mode::Load, 0, 33).jobs }, ..NONE });
    sim.step();
    sim.drive(job(Mode::Load, 0, 32));
    sim.step();
    assert_eq!([sim.get_u64(sim.o.address), sim.get_u64(sim.o.bank)], [31, 1]);
}

#[test]
#[should_panic(expected = "a word has at most 32 bytes")]
fn a_word_is_not_longer_than_a_bank() {
    let mut sim = started(2, 0);
    sim.drive(job(Mode::Load, 0, 33));
    sim.step();
}
