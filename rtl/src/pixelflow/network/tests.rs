//! The bytes that nodes unload, and when.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::TRANSFER;
use super::*;

const PIXELS: usize = 3;
const CHIPS: usize = 2;

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    /// The first node loads, and the following ones composite. A later node unloads the composition, and those behind
    /// it forward the bytes.
    #[test]
    fn a_node_gets_the_least_word_of_those_before_it(
        (words, last) in (2..6usize, 1..4usize).prop_flat_map(|(nodes, bytes)| {
            let word = prop::collection::vec(0..3u64, bytes);
            let all = prop::collection::vec(prop::collection::vec(prop::collection::vec(word, PIXELS), CHIPS), nodes);
            (all, 1..nodes)
        }),
    ) {
        let port = NetworkPort { chips: CHIPS as u32, pixels: PIXELS as u32, width: 8 };
        let mut sim = Simulation::at(&Network { nodes: words.len() as u32, port }, TRANSFER).unwrap();
        for (number, node) in sim.i.nodes.clone().into_iter().enumerate() {
            let mode = match number {
                0 => Mode::Load,
                _ if number < last => Mode::Composite,
                _ if number == last => Mode::Unload,
                _ => Mode::Forward,
            };
            sim.set(node.mode, mode.code());
            sim.set(node.sends, 0);
        }
        sim.reset();
        let bytes = words[0][0][0].len();
        let mut unloaded: Vec<Vec<u64>> = Vec::new();
        for clock in 0..bytes * PIXELS + last {
            for (number, (node, words)) in sim.i.nodes.clone().into_iter().zip(&words).enumerate() {
                // Each node is one clock behind the previous one.
                let at = clock.checked_sub(number).filter(|at| *at < bytes * PIXELS);
                if let Some(at) = at {
                    let (byte, pixel) = (at / PIXELS, at % PIXELS);
                    sim.set_lanes(node.own, words.iter().map(|chip| chip[pixel][byte]));
                    sim.set(node.first, byte == 0);
                }
                sim.set(node.sends, number == 0 && at.is_some());
            }
            let out = sim.o.nodes[last];
            prop_assert_eq!(sim.get_u64(out.unloaded), u64::from(clock >= last), "clock {}", clock);
            if clock >= last {
                unloaded.push(sim.lanes(out.bytes));
            }
            sim.step();
        }
        for (chip, pixel) in (0..CHIPS).flat_map(|chip| (0..PIXELS).map(move |pixel| (chip, pixel))) {
            let least = words[..last].iter().map(|node| &node[chip][pixel]).min().unwrap();
            let found: Vec<u64> = unloaded[pixel..].iter().step_by(PIXELS).map(|bytes| bytes[chip]).collect();
            prop_assert_eq!(&found, least, "chip {}, pixel {}", chip, pixel);
        }
    }
}
