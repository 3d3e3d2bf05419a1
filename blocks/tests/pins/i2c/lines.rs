//! The lines clock by clock, and levels that have no meaning.

use super::*;
use I2cCommand as Do;

/// The clocks of answers, with their results.
type Answered = Vec<(u64, u64)>;

/// The clocks after the first command where SCL or SDA changes, with both levels, and those of the answers.
fn changes(master: &I2cMaster, program: &[Do<u64>]) -> (Vec<(u64, u64, u64)>, Answered) {
    changes_while(master, program, |_| [false; 2])
}

/// The same, while others pull SCL and SDA low.
fn changes_while(
    master: &I2cMaster,
    program: &[Do<u64>],
    pulls: impl Fn(u64) -> [bool; 2],
) -> (Vec<(u64, u64, u64)>, Answered) {
    let mut sim = started(master, 5);
    sim.set(sim.o.answers.ready, 1);
    let (mut lines, mut answers, mut was) = (Vec::new(), Vec::new(), (1, 1));
    let mut left = program.iter();
    let mut next = left.next();
    for clock in 0.. {
        let (valid, command) = (u64::from(next.is_some()), *next.unwrap_or(&Do::STOP));
        sim.set_record(sim.i.commands.payload, command);
        sim.set(sim.i.commands.valid, valid);
        let [scl, sda] = pulls(clock);
        sim.set(sim.i.scl.drives, scl);
        sim.set(sim.i.sda.drives, sda);
        let now = (sim.get_u64(sim.o.scl_line), sim.get_u64(sim.o.sda_line));
        if now != was {
            lines.push((clock, now.0, now.1));
            was = now;
        }
        if sim.get_u64(sim.o.answers.valid) == 1 {
            answers.push((clock, sim.get_u64(sim.o.answers.result)));
        }
        if sim.get_u64(sim.i.commands.ready) == 1 && valid == 1 {
            next = left.next();
        }
        if answers.len() == program.len() {
            break;
        }
        sim.step();
    }
    (lines, answers)
}

#[test]
fn a_byte_that_nobody_acknowledges() {
    let master = I2cMaster { low: 6, high: 4, filter: 1 };
    let (lines, answers) = changes(&master, &[Do::START, Do::write(0xa5), Do::START, Do::STOP]);
    let start = [(2, 1, 0), (6, 0, 0)];
    let byte = [
        (11, 0, 1),
        (13, 1, 1),
        (21, 0, 1), // 1
        (25, 0, 0),
        (27, 1, 0),
        (35, 0, 0), // 0
        (39, 0, 1),
        (41, 1, 1),
        (49, 0, 1), // 1
        (53, 0, 0),
        (55, 1, 0),
        (63, 0, 0), // 0
        (69, 1, 0),
        (77, 0, 0), // 0
        (81, 0, 1),
        (83, 1, 1),
        (91, 0, 1), // 1
        (95, 0, 0),
        (97, 1, 0),
        (105, 0, 0), // 0
        (109, 0, 1),
        (111, 1, 1),
        (119, 0, 1), // 1
        (125, 1, 1),
        (133, 0, 1), // released for a slave
    ];
    let repeated = [(140, 1, 1), (148, 1, 0), (152, 0, 0)];
    let stop = [(159, 1, 0), (167, 1, 1)];
    assert_eq!(lines, [&start[..], &byte, &repeated, &stop].concat());
    assert_eq!(answers, [(6, DONE), (133, NACK), (152, DONE), (173, DONE)]);
}

#[test]
fn nothing_is_done_without_a_start() {
    let (lines, answers) =
        changes(&I2cMaster { low: 5, high: 2, filter: 1 }, &[Do::write(1), Do::READ, Do::STOP, Do::STOP]);
    assert_eq!((lines, answers), (vec![], [1, 2, 3, 4].map(|clock| (clock, LOST)).to_vec()));
}

#[test]
fn a_start_waits_until_the_bus_was_free_for_a_low_period() {
    let master = I2cMaster { low: 9, high: 4, filter: 2 };
    let mut sim = started(&master, 1);
    let other = sim.i.sda.drives;
    sim.set(other, 1);
    sim.run(20);
    assert_eq!(sim.get_u64(sim.o.busy), 1);
    sim.set(sim.i.commands.valid, 1); // a START is 0
    sim.run(20);
    sim.set(other, 0);
    // 2 clocks of a synchronizer, 3 of the filter, 1 until the STOP is noticed, and a free bus.
    for clock in 0..16 {
        assert_eq!((clock, sim.get_u64(sim.o.sda_line)), (clock, 1));
        sim.step();
    }
    assert_eq!((sim.get_u64(sim.o.sda_line), sim.get_u64(sim.o.busy)), (0, 0));
}

/// SDA is low without a START, as a slave leaves it that was interrupted.
#[test]
fn a_start_waits_for_both_lines() {
    let mut sim = started(&I2cMaster { low: 6, high: 4, filter: 1 }, 1);
    let (scl, sda) = (sim.i.scl.drives, sim.i.sda.drives);
    for (port, pulled) in [(scl, 1), (sda, 1), (scl, 0)] {
        sim.set(port, pulled);
        sim.run(20);
    }
    sim.set(sim.i.commands.valid, 1); // a START is 0
    sim.run(20);
    assert_eq!((sim.get_u64(sim.o.scl_line), sim.get_u64(sim.o.busy)), (1, 0));
    sim.set(sda, 0);
    assert_eq!(sim.get_u64(sim.o.sda_line), 1);
    sim.run(20);
    assert_eq!((sim.get_u64(sim.o.sda_line), sim.get_u64(sim.o.busy)), (0, 1));
}

/// Another master pulls SDA low in the first bit, which is high.
#[test]
fn what_was_sent_ahead_is_skipped_up_to_a_stop() {
    let master = I2cMaster { low: 6, high: 4, filter: 1 };
    let lost = [Do::START, Do::write(0xff), Do::write(1), Do::START, Do::write(2), Do::STOP];
    let program = [&lost[..], &[Do::START, Do::STOP]].concat();
    let (lines, answers) = changes_while(&master, &program, |clock| [false, (9..30).contains(&clock)]);
    let skipped = [21, 22, 23, 24, 25].map(|clock| (clock, LOST));
    assert_eq!(answers[..6], [&[(6, DONE)][..], &skipped].concat());
    assert_eq!(answers[6..].iter().map(|(_, result)| *result).collect::<Vec<_>>(), [DONE; 2]);
    // The other's STOP follows, and a START once the bus was free: 5 clocks until the STOP is noticed, 6 of a free bus.
    assert_eq!(lines[2..6], [(13, 1, 0), (30, 1, 1), (42, 1, 0), (46, 0, 0)]);
}

/// SCL is high from clock 13 on, and SDA for a START or low for a STOP until clock 20.
#[test]
fn no_start_or_stop_is_possible_while_scl_is_low() {
    let master = I2cMaster { low: 6, high: 4, filter: 1 };
    for command in [Do::START, Do::STOP] {
        for (pulled, expected) in [(14, (18, LOST)), (16, (20, LOST)), (17, (21, LOST))] {
            let program = [Do::START, command];
            let (_, answers) = changes_while(&master, &program, |clock| [clock >= pulled, false]);
            assert_eq!(answers, [(6, DONE), expected], "{command:?} and SCL from {pulled} on");
        }
    }
}

/// The acknowledgement of a byte that is received is ours, and the other bits are not.
#[test]
fn another_master_acknowledges_the_last_byte() {
    let master = I2cMaster { low: 6, high: 4, filter: 1 };
    for (command, result) in [(Do::READ, DONE), (Do::LAST_READ, LOST)] {
        for (pulled, expected) in [(20..50, DONE), (120..140, result)] {
            let program = [Do::START, command];
            let (_, answers) = changes_while(&master, &program, |clock| [false, pulled.contains(&clock)]);
            assert_eq!(answers, [(6, DONE), (133, expected)], "{command:?} and SDA in {pulled:?}");
        }
    }
}

/// A spike is ignored on both lines while it is shorter than `filter`.
#[test]
fn a_spike_is_no_start() {
    for (clocks, is_seen) in [(3, 0), (4, 0), (5, 1)] {
        let mut sim = started(&I2cMaster { low: 9, high: 4, filter: 4 }, 1);
        sim.set(sim.i.sda.drives, 1);
        sim.run(clocks);
        sim.set(sim.i.sda.drives, 0);
        let mut busy = 0;
        for _ in 0..20 {
            busy |= sim.get_u64(sim.o.busy);
            sim.step();
        }
        assert_eq!(busy, is_seen, "{clocks} clocks");
    }
}

#[test]
fn a_slave_that_keeps_sda_low_ends_a_transfer_with_a_loss() {
    let mut sim = started(&I2cMaster { low: 6, high: 4, filter: 1 }, 1);
    sim.set(sim.o.answers.ready, 1);
    sim.set(sim.i.commands.valid, 1);
    sim.run(1);
    sim.set(sim.i.commands.action, 3);
    sim.run(10);
    sim.set(sim.i.commands.valid, 0);
    sim.set(sim.i.sda.drives, 1);
    let mut results = Vec::new();
    for _ in 0..60 {
        if sim.get_u64(sim.o.answers.valid) == 1 {
            results.push(sim.get_u64(sim.o.answers.result));
        }
        sim.step();
    }
    assert_eq!((results, sim.get_u64(sim.o.busy)), (vec![LOST], 1));
}

/// The times of UM10204, in nanoseconds: low, high, period.
#[test]
fn the_modes_keep_their_times() {
    let times = [
        (I2cMode::Standard, [4_700, 4_000, 10_000]),
        (I2cMode::Fast, [1_300, 600, 2_500]),
        (I2cMode::FastPlus, [500, 260, 1_000]),
    ];
    for (mode, [low, high, period]) in times {
        for clock in [1_000, 7_000, 10_000, 20_834, 40_000, 50_000u64] {
            let master = I2cMaster::new(mode, tilewright_hdl::Period::ps(clock));
            let ns = |clocks: u64| clocks * clock / 1_000;
            let bit = clocks_of_a_bit(&master);
            assert!(ns(master.low.into()) >= low && ns(master.high.into()) >= high, "{master:?}");
            assert!(ns(bit) >= period && ns(bit) < period + 250, "{master:?}");
            // Data are valid early enough (t_VD;DAT), and stable before SCL rises (t_SU;DAT).
            let (change, setup) = (ns(u64::from(master.low / 2 + 1)), ns(u64::from(master.low - master.low / 2 - 1)));
            let (latest, least) = match mode {
                I2cMode::Standard => (3_450, 250),
                I2cMode::Fast => (900, 100),
                I2cMode::FastPlus => (450, 50),
            };
            assert!(change <= latest && setup >= least, "{master:?}: {change} {setup}");
            tilewright_hdl::elaborate(&master).unwrap();
        }
    }
}

#[test]
fn a_low_period_that_is_too_short_to_see() {
    let problem = tilewright_hdl::elaborate(&I2cMaster { low: 5, high: 4, filter: 2 }).unwrap_err().to_string();
    assert!(problem.starts_with("`low` of `I2cMaster` is 5: it has to be at least 6"), "{problem}");
}
