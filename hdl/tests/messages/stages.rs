//! Values of different stages of a pipeline that meet.

use crate::messages::common::*;
use tilewright_hdl::*;

bundle! {
    struct Race<T> { left: T, right: T }
}

fn start(i: In) -> Race {
    Race { left: i.a, right: i.b.zext(8) }
}

#[test]
fn operators_name_both_stages() {
    expect(
        |m, i| {
            let first = m.stages(1, None, start(i), |_, race| race);
            def!(late = m.stages(2, None, first, |stage, race| Race {
                left: if stage == 2 { race.left + first.right } else { race.left },
                ..race
            }));
            late.left & late.right
        },
        "`late_left1 + right1` mixes stages of a pipeline: `late_left1` is of stage 1, `right1` of stage 0 [T751]
         --> [left: if stage == 2 { race.left + first.right } else { race.left },]
         `late_left1` is made at [def!(late = m.stages(2, None, first, |stage, race| Race {]
         `right1` is made at [let first = m.stages(1, None, start(i), |_, race| race);]
         help: bring the earlier one along as a field of the pipeline's record; `.any_stage()` allows values of two records to meet",
    );
}

#[test]
fn what_enters_is_of_stage_0_and_a_mix_is_said_once() {
    expect(
        |m, i| {
            let last = m.stages(2, i.c, start(i), |_, race| race);
            let nearer = last.right.lt(i.a);
            let mixed = mux(nearer, last.left, i.a);
            mixed + last.left
        },
        "`right2.lt(a)` mixes stages of a pipeline: `right2` is of stage 2, `a` of stage 0 [T751]
         --> [let nearer = last.right.lt(i.a);]
         `right2` is made at [let last = m.stages(2, i.c, start(i), |_, race| race);]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: bring the earlier one along as a field of the pipeline's record; `.any_stage()` allows values of two records to meet

         `mux(right2.lt(a), left2, a)` mixes stages of a pipeline: `left2` is of stage 2, `a` of stage 0 [T751]
         --> [let mixed = mux(nearer, last.left, i.a);]
         `left2` is made at [let last = m.stages(2, i.c, start(i), |_, race| race);]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: bring the earlier one along as a field of the pipeline's record; `.any_stage()` allows values of two records to meet

         2 problems in this description",
    );
}

/// With the pipeline's own enable, they add one stage.
#[test]
fn pipes_and_reads_are_stages() {
    expect(
        |m, i| {
            let table = m.memory("words", 256, 8, ReadUnderWrite::Old).fill(Bits::zero(8));
            let last = m.stages(1, i.c, start(i), |_, race| Race { left: table.read_when(i.c, race.left), ..race });
            let later = m.pipe_when(i.c, "later", last.left);
            (later + last.right) | table.read(last.left)
        },
        "`later + right1` mixes stages of a pipeline: `later` is of stage 2, `right1` of stage 1 [T751]
         --> [(later + last.right) | table.read(last.left)]
         `later` is made at [let later = m.pipe_when(i.c, \"later\", last.left);]
         `right1` is made at [let last = m.stages(1, i.c, start(i), |_, race| Race { left: table.read_when(i.c, race.left), ..race });]
         help: bring the earlier one along as a field of the pipeline's record; `.any_stage()` allows values of two records to meet

         `left1` of stage 1 of a pipeline takes a value of stage 1: `words_read0` [T752]
         --> [let last = m.stages(1, i.c, start(i), |_, race| Race { left: table.read_when(i.c, race.left), ..race });]
         `left1` is made at [let last = m.stages(1, i.c, start(i), |_, race| Race { left: table.read_when(i.c, race.left), ..race });]
         `words_read0` is made at [let last = m.stages(1, i.c, start(i), |_, race| Race { left: table.read_when(i.c, race.left), ..race });]
         help: a stage takes what the one before it gave, stage 0: a register or a read between the two is a stage more; `.any_stage()` says that another one is meant

         2 problems in this description",
    );
}

#[test]
fn registers_and_memories_take_what_is_of_one_stage() {
    expect(
        |m, i| {
            let last = m.stages(2, None, start(i), |_, race| race);
            let sum = m.reg("sum", 8);
            sum.enable(last.right.bit(0)).next(sum + i.a);
            let table = m.memory("words", 256, 8, ReadUnderWrite::Old).fill(Bits::zero(8));
            table.write(i.c, i.a, last.left);
            sum ^ table.read(i.b.zext(8))
        },
        "the update of `sum` mixes stages of a pipeline: `a` is of stage 0, `right2` of stage 2 [T751]
         --> [sum.enable(last.right.bit(0)).next(sum + i.a);]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         `right2` is made at [let last = m.stages(2, None, start(i), |_, race| race);]
         help: bring the earlier one along as a field of the pipeline's record; `.any_stage()` allows values of two records to meet

         a write to memory `words` mixes stages of a pipeline: `a` is of stage 0, `left2` of stage 2 [T751]
         --> [table.write(i.c, i.a, last.left);]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         `left2` is made at [let last = m.stages(2, None, start(i), |_, race| race);]
         help: bring the earlier one along as a field of the pipeline's record; `.any_stage()` allows values of two records to meet

         2 problems in this description",
    );
}

/// An enable common to all lanes is the pipeline's own enable; a delay with another enable has no stage.
#[test]
fn rows_go_through_stages_too() {
    expect(
        |m, i| {
            let start = Race { left: i.a.of(3), right: i.a.of(3) };
            let last = m.stages(1, i.c, start, |_, race| race);
            let later = m.pipe_when(i.c, "later", last.left);
            let other = m.pipe("other", last.left);
            ((later + last.right) ^ (other + last.right)).lane(0)
        },
        "`later + right1` mixes stages of a pipeline: `later` is of stage 2, `right1` of stage 1 [T751]
         --> [((later + last.right) ^ (other + last.right)).lane(0)]
         `later` is made at [let later = m.pipe_when(i.c, \"later\", last.left);]
         `right1` is made at [let last = m.stages(1, i.c, start, |_, race| race);]
         help: bring the earlier one along as a field of the pipeline's record; `.any_stage()` allows values of two records to meet",
    );
}
