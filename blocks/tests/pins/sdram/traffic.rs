//! Random requests to random chips.

use super::*;
use tilewright_sim::{Pauses, monitor};

/// Requests that stay on some rows: a place near the last one, or anywhere.
pub fn wishes() -> impl Strategy<Value = Vec<Wish>> {
    let wish = (
        any::<bool>(),
        any::<u64>(),
        any::<u64>(),
        0u64..4,
        prop_oneof![3 => Just(0u64), 1 => 0..2048u64],
        any::<u64>(),
    );
    let wish = wish.prop_map(|(writes, data, strobe, bank, row, column)| Wish {
        write: writes.then_some((data, strobe)),
        bank,
        row,
        column,
    });
    prop::collection::vec(wish, 0..60)
}

/// At every instant: no output changes with an input, within the clock.
async fn has_no_path(t: &Testbench<'_>, inputs: &[Port], outputs: &[Port]) {
    let seen = || outputs.iter().map(|port| t.get_u64(*port)).collect::<Vec<_>>();
    loop {
        t.step().await;
        let before = seen();
        for input in inputs {
            t.suppose(*input, t.get_u64(*input) ^ 1, || assert_eq!(seen(), before, "a path within a clock"));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_memory_keeps_what_is_written(
        (block, sheet) in systems(), wishes in wishes(), pauses in (0u64..95, 0u64..95), seed in any::<u64>(),
    ) {
        let wishes: Vec<Wish> = wishes.into_iter().map(|wish| wish.within(&block)).collect();
        let mut sim = Simulation::of(&block).unwrap().seeded(seed);
        sim.reset();
        let mut chip = Chip::new(sheet);
        let (expected, array) = array(&chip, &wishes);
        let lines = Lines::of(&sim, &block);
        let (request, words) = (sim.i.request, sim.o.words);
        let inputs = [request.valid, request.write, request.address, request.strobe, words.ready, sim.i.dq];
        let SdramPins { cs_n, ras_n, cas_n, we_n, ba, a, dqm, .. } = lines.pins;
        let outputs = [cs_n, ras_n, cas_n, we_n, ba, a, dqm, lines.dq_out, lines.dq_enable, words.valid, words.payload, request.ready];
        let t = &sim.testbench();
        let requests: Vec<_> = wishes.iter().map(|wish| wish.request(block.column_bits)).collect();
        let receiver = async {
            t.expect_all(words, expected, Pauses::percent(pauses.1, seed)).await;
            // The last writes are over, and refreshes go on.
            t.expect_silence(words, 9 * u64::from(block.refresh)).await;
        };
        t.run((
            t.send_all(request, requests, Pauses::percent(pauses.0, !seed)),
            receiver,
            monitor(t.holds(words)),
            monitor(has_no_path(t, &inputs, &outputs)),
            monitor(lines.runs(t, &mut chip, block.late)),
        ));
        for ((bank, row, column), word) in array {
            prop_assert_eq!(chip.word(bank, row, column), word, "bank {}, row {}, column {}", bank, row, column);
        }
    }
}
