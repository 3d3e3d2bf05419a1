//! Chains of ports: the words that the last node unloads, and when.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::{PIXELS, TRANSFER};
use super::*;

/// The words of a node: for each chip and each pixel, its bytes.
type Words = Vec<Vec<Vec<u64>>>;

/// A chain of ports: the first loads, the last unloads, and the others composite. All but the last have words.
struct Chain {
    ports: Vec<Simulation<NetworkPortIn, NetworkPortOut>>,
    words: Vec<Words>,
    /// The number of bytes that each node has sent or passed on.
    passed: Vec<usize>,
    unloaded: Words,
    /// The clocks in which the first and the last byte are unloaded.
    unloaded_at: Option<[u64; 2]>,
    clock: u64,
}

impl Chain {
    /// A chain of `nodes` nodes with words, and one that unloads.
    fn new(port: &NetworkPort, nodes: usize) -> Chain {
        let ports = (0..=nodes).map(|node| Simulation::at(port, TRANSFER).unwrap().seeded(node as u64)).collect();
        let unloaded = vec![vec![Vec::new(); port.pixels as usize]; port.chips as usize];
        Chain { ports, words: Vec::new(), passed: vec![0; nodes + 1], unloaded, unloaded_at: None, clock: 0 }
    }

    /// Sends all words of the first node in the clocks given by `sends`. Returns the words of the last node, and the
    /// clocks of its first and last byte.
    fn compose(&mut self, words: &[Words], sends: impl Fn(usize) -> bool) -> (Words, [u64; 2]) {
        let last = words.len();
        for (node, sim) in self.ports.iter_mut().enumerate() {
            let mode = if node == 0 {
                Mode::Load
            } else if node < last {
                Mode::Composite
            } else {
                Mode::Unload
            };
            sim.set(sim.i.mode, mode.code());
            // A reset has to clear the ports while bytes arrive.
            sim.set(sim.i.upstream.valid, node > 0);
            sim.set(sim.i.sends, node == 0);
            sim.reset();
        }
        self.passed.fill(0);
        self.unloaded.iter_mut().flatten().for_each(Vec::clear);
        (self.words, self.unloaded_at, self.clock) = (words.to_vec(), None, 0);
        let bytes = words[0][0].iter().map(Vec::len).sum();
        while self.passed[0] < bytes {
            self.step(sends(self.clock as usize));
        }
        (0..last).for_each(|_| self.step(false));
        (self.unloaded.clone(), self.unloaded_at.expect("something was unloaded"))
    }

    /// Runs a clock, in which the first node sends a byte of each chip if `sends` is true.
    fn step(&mut self, sends: bool) {
        let pixels = self.unloaded[0].len();
        let mut upstream = None;
        for (node, sim) in self.ports.iter_mut().enumerate() {
            let (i, o) = (sim.i, sim.o);
            let downstream = [sim.get_u64(o.downstream.valid), sim.get_u64(o.downstream.first)];
            let sent = (downstream, sim.lanes(o.downstream.bytes));
            let ([valid, first], bytes) = upstream.replace(sent).unwrap_or(([0, 0], vec![0; self.unloaded.len()]));
            sim.set(i.upstream.valid, valid);
            sim.set(i.upstream.first, first);
            sim.set_lanes(i.upstream.bytes, bytes.clone());
            let byte = self.passed[node] / pixels;
            sim.set(i.sends, sends & (node == 0));
            // Only a node that loads uses `first`; the others get its inverse.
            sim.set(i.first, (byte == 0) == (node == 0));
            let pixel = sim.get_u64(o.pixel) as usize;
            if let Some(words) = self.words.get(node) {
                let own: Vec<u64> = words.iter().map(|chip| chip[pixel].get(byte).copied().unwrap_or(0)).collect();
                sim.set_lanes(i.own, own);
            }
            let still = [sim.get_u64(o.downstream.valid), sim.get_u64(o.downstream.first)];
            assert_eq!(still, downstream, "the outputs do not depend on the inputs of the same clock");
            self.passed[node] += sim.get_u64(o.advances) as usize;
            if sim.get_u64(o.unloaded) == 1 {
                self.unloaded.iter_mut().zip(bytes).for_each(|(chip, byte)| chip[pixel].push(byte));
                let [since, _] = self.unloaded_at.unwrap_or([self.clock; 2]);
                self.unloaded_at = Some([since, self.clock]);
            }
        }
        self.ports.iter_mut().for_each(Simulation::step);
        self.clock += 1;
    }
}

/// The lesser word of all nodes, for each chip and pixel.
fn least(words: &[Words]) -> Words {
    let of = |chip: usize, pixel: usize| words.iter().map(|node| node[chip][pixel].clone()).min().unwrap();
    (0..words[0].len()).map(|chip| (0..words[0][chip].len()).map(|pixel| of(chip, pixel)).collect()).collect()
}

/// PFL-TCB, PFL-BYTES and PFL-COL.
#[test]
fn a_byte_of_a_region_takes_1_28_us() {
    let port = NetworkPort { chips: 1, pixels: PIXELS, width: 8 };
    let microseconds = |bytes: usize| {
        let word =
            |node: usize, pixel: usize| (0..bytes).map(|byte| ((node * 37 + pixel * 5 + byte) % 251) as u64).collect();
        let words: Vec<Words> =
            (0..2).map(|node| vec![(0..PIXELS as usize).map(|pixel| word(node, pixel)).collect()]).collect();
        let (_, [first, last]) = Chain::new(&port, 2).compose(&words, |_| true);
        // A byte takes one clock per node.
        assert_eq!(first, 2);
        ((last - first + 1) * TRANSFER.picoseconds()) as f64 / 1e6
    };
    assert_eq!(microseconds(1), 1.28);
    assert_eq!(microseconds(21), 26.88);
    // 7 bytes of 40 regions.
    assert_eq!(microseconds(7 * 40), 358.4);
}

/// Three nodes have words of two bytes of one bit. The four bytes are sent in every pattern of six clocks.
#[test]
fn no_pixel_is_lost_however_it_arrives() {
    let port = NetworkPort { chips: 1, pixels: 2, width: 1 };
    let mut chain = Chain::new(&port, 3);
    let word = |bits: usize| vec![(bits >> 1 & 1) as u64, (bits & 1) as u64];
    for (number, gaps) in
        (0..64usize).flat_map(|number| (0..64u32).filter(|gaps| gaps.count_ones() == 4).map(move |gaps| (number, gaps)))
    {
        let node = |node: usize| vec![vec![word(number >> (2 * node)), word((number * 29 + 11) >> (2 * node))]];
        let words: Vec<Words> = (0..3).map(node).collect();
        let (unloaded, _) = chain.compose(&words, |clock| clock >= 6 || gaps >> clock & 1 == 1);
        assert_eq!(unloaded, least(&words), "{number} {gaps:06b}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_last_node_gets_the_least_word_of_each_pixel(
        (chips, pixels, words) in (1..4usize, 1..6usize, 1..5usize, 1..6usize).prop_flat_map(|(chips, pixels, bytes, nodes)| {
            let word = prop::collection::vec(0..3u64, bytes);
            let words = prop::collection::vec(prop::collection::vec(prop::collection::vec(word, pixels), chips), nodes);
            (Just(chips), Just(pixels), words)
        }),
        gaps in prop::collection::vec(any::<bool>(), 1..20),
    ) {
        let port = NetworkPort { chips: chips as u32, pixels: pixels as u32, width: 8 };
        let (unloaded, _) = Chain::new(&port, words.len()).compose(&words, |clock| clock % 21 == 20 || gaps[clock % gaps.len()]);
        prop_assert_eq!(unloaded, least(&words));
    }
}
