//! Models that answer within the clock.

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::circuits::engine::of;
use tilewright_hdl::*;

block! {
    /// Asks for a word, looks at it at once, and asks for another one by it.
    struct Follows;
    in FollowsIn { word: bits(8), other: bits(8) }
    out FollowsOut { address: bits(4), again: bits(8), sum: bits(8) }
}

impl Follows {
    fn build(&self, m: Module, i: FollowsIn) -> FollowsOut {
        def!(address = m.reg(4).reset(0));
        address.next(address + 1);
        def!(sum = m.reg(8).reset(0));
        sum.next(sum + i.other);
        FollowsOut { address: *address, again: i.word + 1, sum: *sum }
    }
}

#[test]
fn an_answer_is_there_in_the_clock_of_the_question() {
    let words = RefCell::new([7, 5, 3]);
    let mut sim = of(&Follows);
    let (i, o) = (sim.i, sim.o);
    let t = sim.testbench();
    let watches = async {
        t.step().await;
        assert_eq!((t.get_u64(i.other), t.get_u64(o.again), t.get_u64(o.sum)), (80, 8, 0));
        // From the next clock on.
        words.borrow_mut()[1] = 6;
        t.step().await;
        assert_eq!((t.get_u64(o.again), t.get_u64(o.sum)), (7, 80));
    };
    // The second question depends on the first answer, and its model is the first one here.
    t.run((
        watches,
        t.answer(i.other, [o.again, o.address], |[again, address]| again * 10 + address),
        t.answer(i.word, [o.address], |[address]| words.borrow()[address as usize % 3]),
    ));
    assert_eq!(t.get_u64(o.sum), 80 + 71);
}

#[test]
fn answers_in_a_loop_are_refused() {
    let mut sim = of(&Follows);
    let (i, o) = (sim.i, sim.o);
    let t = sim.testbench();
    let looped = catch_unwind(AssertUnwindSafe(|| t.run((t.wait(1), t.answer(i.word, [o.again], |[again]| again)))));
    let said = *looped.unwrap_err().downcast::<String>().unwrap();
    assert!(said.starts_with("the answers in the run at "), "{said}");
    assert!(said.contains("answers.rs:54:53 change each other without end"), "{said}");
}
