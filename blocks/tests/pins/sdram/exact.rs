//! Clock by clock.

use super::*;

/// The chip of 32 megabytes at 100 MHz, with a short start.
fn at_100_mhz() -> Rig {
    let block = SdramController { power_up: 4, ..SdramController::of_32_megabytes(Period::ns(10)) };
    let mut rig = Rig::new(&block, Sheet { power_up: 40_000, ..micron() });
    rig.start();
    rig
}

/// Clocks from a read to its word.
fn latency(rig: &mut Rig, wish: Wish) -> u64 {
    let asked = rig.clock;
    rig.asks(&[wish])[0].1 - asked
}

#[test]
fn latencies_of_all_kinds() {
    let mut rig = at_100_mhz();
    let idle = |rig: &mut Rig| (0..20).for_each(|_| assert_eq!(rig.step(None).1, None));
    assert_eq!(latency(&mut rig, Wish::read(1, 5, 3)), 8, "the row is closed: tRCD");
    idle(&mut rig);
    assert_eq!(latency(&mut rig, Wish::read(1, 5, 4)), 6, "the row is open");
    assert_eq!(latency(&mut rig, Wish::read(2, 5, 4)), 8, "another bank");
    idle(&mut rig);
    assert_eq!(latency(&mut rig, Wish::read(1, 6, 4)), 10, "another row is open: tRP and tRCD");
    assert_eq!(latency(&mut rig, Wish::read(2, 5, 4)), 6, "the other bank's row stays open");
    idle(&mut rig);
    let conflict = |rig: &mut Rig, row: u64| {
        let write = Wish { write: Some((0, 3)), ..Wish::read(3, row, 0) };
        let asked = rig.clock;
        rig.asks(&[write, Wish::read(3, row + 1, 0)])[0].1 - asked
    };
    // A row is opened in clock 1, written in clock 3, closed in clock 6, and the next one is opened in clock 8.
    assert_eq!(conflict(&mut rig, 1), 10 + 5, "tRAS");
    idle(&mut rig);
    // A row is written in clock 1, and closed in clock 3.
    assert_eq!(conflict(&mut rig, 2), 7 + 5, "tWR");
}

/// A refresh is due 781 clocks after the 4 clocks of the start, and no request is served from then on.
#[test]
fn a_read_meets_a_refresh() {
    let due = 4 + 781;
    // A read that comes a clock before that can be served in the clock in which the refresh is due.
    for (asked, expected) in [(due - 2, 6)].into_iter().chain((due - 1..due + 10).zip((8..=18).rev())) {
        let mut rig = at_100_mhz();
        assert_eq!(latency(&mut rig, Wish::read(0, 9, 0)), 8);
        while rig.clock < asked {
            rig.step(None);
        }
        assert_eq!(latency(&mut rig, Wish::read(0, 9, 1)), expected, "asked in clock {asked}");
    }
}

#[test]
fn a_receiver_that_is_not_ready() {
    let mut rig = at_100_mhz();
    rig.sim.set(rig.sim.o.words.ready, 0);
    let mut taken = 0;
    for _ in 0..40 {
        taken += u64::from(rig.step(Some(Wish::read(0, 0, taken))).0);
    }
    // Six words are in the queue, and one request waits in front.
    assert_eq!((taken, rig.chip.counts[0b101]), (7, 6));
    rig.sim.set(rig.sim.o.words.ready, 1);
    let words: Vec<_> = (0..20).filter_map(|_| rig.step(None).1).collect();
    assert_eq!(words, (0..7).map(|column| rig.chip.word(0, 0, column)).collect::<Vec<_>>());
}

/// Reads, a write that waits for the bus, a byte that is written at once after it, and another row.
#[test]
fn commands_on_a_row() {
    let mut rig = at_100_mhz();
    let wave = rig.sim.record([
        "request_valid",
        "request_ready",
        "command",
        "pins_ba",
        "pins_a",
        "pins_dqm",
        "dq_out",
        "dq_enable",
        "dq",
        "words_valid",
        "words_payload",
    ]);
    let write = |column, data, strobe| Wish { write: Some((data, strobe)), ..Wish::read(1, 2, column) };
    let wishes =
        [Wish::read(1, 2, 8), Wish::read(1, 2, 9), write(10, 0x1234, 3), write(11, 0x5678, 1), Wish::read(1, 3, 8)];
    rig.asks(&wishes);
    wave.expect(
        r"
        clk           |~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/
        request_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        request_ready |~~~~~~~~~~~\_______________________/~~~~~~~~~~~~~~~~~~~~~~~\________________________
        command       | Deselect              | Active    | Deselect  | Read                  | Deselect  |
        pins_ba       | 0                     | 1                                                         |
        pins_a        | 39                    | 2         | 8                     | 9         | a         |
        pins_dqm      | 0                                                                                 |
        dq_out        | c855                                                                              |
        dq_enable     |____________________________________________________________________________________
        dq            | ee                                                                    | 8980      |
        words_valid   |____________________________________________________________________________________
        words_payload | 56f9                                                                              |

        clk           |~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/
        request_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\________________________________________________
        request_ready |___________/~~~~~~~~~~~~~~~~~~~~~~~\________________________________________________
        command       | Deselect              | Write                 | Deselect  | Precharge | Deselect  |
        pins_ba       | 1                                                                                 |
        pins_a        | a                                 | b         | 8                                 |
        pins_dqm      | 0                                 | 2         | 0                                 |
        dq_out        | c855                  | 1234      | 5678                                          |
        dq_enable     |_______________________/~~~~~~~~~~~~~~~~~~~~~~~\____________________________________
        dq            | 339       | ee                                                                    |
        words_valid   |___________/~~~~~~~~~~~~~~~~~~~~~~~\________________________________________________
        words_payload | 56f9      | 8980      | 339       | f8f4                                          |

        clk           |~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/
        request_valid |____________________________________________________________________________________
        request_ready |___________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        command       | Active    | Deselect  | Read      | Deselect                                      |
        pins_ba       | 1                                                                                 |
        pins_a        | 3         | 8                                                                     |
        pins_dqm      | 0                                                                                 |
        dq_out        | 5678                                                                              |
        dq_enable     |____________________________________________________________________________________
        dq            | ee                                            | 27b7      | ee                    |
        words_valid   |_______________________________________________________________________/~~~~~~~~~~~~
        words_payload | f8f4                                                                  | 27b7      |",
    );
}

#[test]
fn the_start() {
    let block = SdramController { power_up: 3, rfc: 2, ..SdramController::of_32_megabytes(Period::ns(10)) };
    let mut rig = Rig::new(&block, Sheet { power_up: 30_000, rfc: 20_000, rc: 0, ..micron() });
    let wave = rig.sim.record(["pins_cke", "command", "pins_a", "pins_dqm"]);
    rig.start();
    wave.expect(
        r"
        clk      |~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/
        pins_cke |___________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        command  | Deselect                                      | Precharge | Deselect  | Refresh   | Deselect  |
        pins_a   | 39                                            | 400       | 39                                |
        pins_dqm | 3                                                                                             |

        clk      |~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/
        pins_cke |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        command  | Refresh   | Deselect  | Refresh   | Deselect  | Refresh   | Deselect  | Refresh   | Deselect  |
        pins_a   | 39                                                                                            |
        pins_dqm | 3                                                                                             |

        clk      |~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/~~~~~\_____/
        pins_cke |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        command  | Refresh   | Deselect  | Refresh   | Deselect  | Refresh   | Deselect  | LoadMode  | Deselect  |
        pins_a   | 39                                                                    | 20        | 39        |
        pins_dqm | 3                                                                                 | 0         |

        clk      |~~~~~\_____/
        pins_cke |~~~~~~~~~~~~
        command  | Deselect  |
        pins_a   | 39        |
        pins_dqm | 0         |",
    );
}

#[test]
fn times_that_do_not_go_together() {
    let usual = SdramController::of_32_megabytes(Period::ns(10));
    let problem = |block: SdramController| tilewright_hdl::elaborate(&block).unwrap_err().to_string();
    let busy = problem(SdramController { refresh: 19, ..usual.clone() });
    let expected = "`refresh` of `SdramController` is 19: it has to be at least 20. \
                    A request has to be served between two refreshes";
    assert!(busy.starts_with(expected), "{busy}");
    let odd = problem(SdramController { bytes: 3, ..usual });
    assert!(odd.starts_with("`bytes` of `SdramController` is 3: it has to be 1, 2 or 4"), "{odd}");
}

#[test]
#[should_panic(expected = "the memory runs at 133 MHz or less: a period is 7.5 ns or more")]
fn a_clock_that_is_too_fast() {
    SdramController::of_32_megabytes(Period::ns(7));
}
