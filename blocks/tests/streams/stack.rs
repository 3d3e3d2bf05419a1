//! The stack, compared with one in software.

use crate::streams::clocks::play;
use crate::streams::property::Stalls;
use crate::streams::stalls::stalls;
use proptest::prelude::*;
use tilewright_blocks::Lifo;
use tilewright_sim::{Pauses, Simulation, monitor};

#[test]
fn a_stack_gives_the_newest_first() {
    play(
        &Lifo::new(2, 8),
        &[
            (Some(1), 0, 1, None),
            (Some(2), 0, 1, Some(1)),
            (Some(3), 0, 1, Some(1)), // a shown word stays
            (Some(4), 0, 0, Some(1)), // full
            (Some(4), 1, 0, Some(1)), // `ready` does not pass
            (Some(4), 1, 1, Some(3)),
            (None, 1, 1, Some(4)),
            (None, 1, 1, Some(2)),
            (Some(5), 1, 1, None),
            (None, 0, 1, Some(5)),
        ],
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_stack_shows_what_one_in_software_shows(depth in 1u32..6, words in prop::collection::vec(0u64..256, 0..60), stalls in stalls()) {
        let Stalls { senders, receivers, seed } = stalls;
        let mut sim = Simulation::of(&Lifo::new(depth, 8)).unwrap();
        sim.reset();
        let (into, out) = (sim.i.into, sim.o.out);
        let t = sim.testbench();
        let model = async {
            let (mut shown, mut below) = (None, Vec::new());
            loop {
                t.step().await;
                assert_eq!(t.shown(&out), shown);
                assert_eq!(t.get_u64(into.ready) == 1, below.len() < depth as usize);
                if t.get_u64(out.ready) == 1 {
                    shown = None;
                }
                below.extend(t.shown(&into).filter(|_| t.get_u64(into.ready) == 1));
                shown = shown.or_else(|| below.pop());
            }
        };
        let ((), mut received, ()) = t.run((
            t.send_all(into, words.clone(), Pauses::percent(senders, seed)),
            t.receive_all(out, words.len(), Pauses::percent(receivers, seed ^ 1)),
            monitor(model),
        ));
        let mut sent = words;
        sent.sort_unstable();
        received.sort_unstable();
        prop_assert_eq!(received, sent);
    }
}

#[test]
#[should_panic(expected = "a stack of 0 words of 8 bits holds nothing")]
fn a_stack_of_nothing() {
    Lifo::new(0, 8);
}
