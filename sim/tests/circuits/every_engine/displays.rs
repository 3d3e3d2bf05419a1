//! What a circuit displays: which values, in which form, at which edges.

use crate::circuits::engine::of;
use tilewright_hdl::*;
use tilewright_sim::{Batch, Message};

codes! { enum Phase { Idle = 0, Run = 2, Done = 5 } }

block! {
    /// Displays a number where it is told.
    struct Cell;
    in CellIn { when: bit(), x: bits(8) }
    out CellOut { late: bits(8) }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        def!(late = m.reg(8).reset(9));
        late.next(i.x);
        m.display(i.when, "late is {}", &[*late]);
        CellOut { late: *late }
    }
}

block! {
    /// Displays values of all kinds, lanes, and cells.
    struct Shows;
    in ShowsIn { when: bit(), x: bits(8), phase: one_of::<Phase>(), wide: bits(100), run: bit() }
    out ShowsOut { sum: bits(8) }
}

impl Shows {
    fn build(&self, m: Module, i: ShowsIn) -> ShowsOut {
        let values = [i.x, i.x.signed(), i.x + 1, i.x, i.phase];
        m.display(i.when, "{{{}}} {} {:x} {:b} 100% {}", &values);
        m.display(i.when & i.x.eq(1), "wide {} {} {:x}", &[i.wide, i.wide.signed(), i.wide]);
        let bits = i.x.slice(0..3).unpack(row(3));
        m.display(bits & i.when, "lane {} of {}", &[constants(bits_of_a_lane(), |lane| lane), i.x]);
        let cells = m.array("u_cell", 2, &Cell, |_| CellIn { when: i.when & i.x.bit(7), x: i.x });
        let slow = m.enabled(i.run, || m.instance("u_slow", &Cell, CellIn { when: i.when, x: i.x }));
        ShowsOut { sum: cells.late.sum() + slow.late }
    }
}

fn bits_of_a_lane() -> Width {
    bits(2).of(row(3))
}

fn shown(inputs: &[(u64, u64, u64, u128)]) -> Vec<Message> {
    let mut sim = of(&Shows);
    sim.set(sim.i.run, 1);
    sim.reset();
    let messages = sim.messages();
    for &(when, x, phase, wide) in inputs {
        sim.set(sim.i.when, when);
        sim.set(sim.i.x, x);
        sim.set(sim.i.phase, phase);
        sim.set(sim.i.wide, wide);
        sim.set(sim.i.run, u64::from(x != 3));
        sim.step();
    }
    messages.take()
}

#[test]
fn values_are_numbers_codes_and_digits() {
    fn lines(inputs: &[(u64, u64, u64, u128)]) -> Vec<String> {
        shown(inputs).into_iter().map(|message| message.text).collect()
    }
    assert_eq!(lines(&[(0, 1, 0, 0)]), [""; 0]);
    assert_eq!(lines(&[(1, 0x20, 2, 0)]), ["{32} 32 21 100000 100% Run", "late is 9"]);
    let wide = (1 << 100) - 2;
    let long = "wide 1267650600228229401496703205374 -2 ffffffffffffffffffffffffe";
    assert_eq!(lines(&[(1, 1, 5, wide)]), ["{1} 1 2 1 100% Done", long, "lane 0 of 1", "late is 9"]);
    let all = lines(&[(0, 3, 0, 0), (1, 0xff, 3, 0), (1, 3, 0, 0)]);
    let first = ["{255} -1 0 11111111 100% ?", "lane 0 of 255", "lane 1 of 255", "lane 2 of 255"];
    let cells = ["late is 3", "late is 3", "late is 9"];
    assert_eq!(all[..7], [&first[..], &cells].concat());
    assert_eq!(all[7..], ["{3} 3 4 11 100% Idle", "lane 0 of 3", "lane 1 of 3"], "the slow cell is not enabled");
}

#[test]
fn a_message_says_when_and_where_and_none_comes_in_a_reset() {
    let of = |time, path: &str, text: &str| Message { time, path: path.to_owned(), text: text.to_owned() };
    let all = shown(&[(0, 7, 0, 0), (1, 0x80, 0, 0)]);
    let (time, cells) =
        (all[0].time, [("u_cell[0]", "late is 7"), ("u_cell[1]", "late is 7"), ("u_slow", "late is 7")]);
    let cells = cells.map(|(path, text)| of(time, path, text));
    assert_eq!(all, [&[of(time, "", "{128} -128 81 10000000 100% Idle")], &cells[..]].concat());
    let mut sim = crate::circuits::engine::of(&Shows);
    let messages = sim.messages();
    sim.set(sim.i.when, 1);
    sim.set(sim.i.run, 1);
    sim.reset();
    assert_eq!(messages.take(), []);
    sim.step();
    assert_eq!(messages.lines(), ["{0} 0 1 0 100% Idle", "late is 9"]);
}

#[test]
fn runs_of_a_batch_have_messages_of_their_own() {
    let mut batch = Batch::of(&Shows, 3).unwrap();
    let (first, last) = (batch.messages(0), batch.messages(2));
    batch.set(batch.i.when, 2, 1);
    batch.set(batch.i.x, 2, 0x80);
    batch.run(1);
    assert_eq!(first.take(), []);
    let lines = ["{128} -128 81 10000000 100% Idle", "late is 9", "late is 9"];
    assert_eq!(last.take().into_iter().map(|message| message.text).collect::<Vec<_>>(), lines);
}
