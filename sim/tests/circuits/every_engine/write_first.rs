//! Memories whose reads give the word that is being written, compared with a plain model.

use crate::circuits::engine::of;
use tilewright_hdl::*;

block! {
    /// A memory of five words with two write ports, and a row of memories with an address for each lane.
    struct Fresh;
    in FreshIn {
        writes: bits(2),
        to: [below(5); 2],
        data: [bits(8); 2],
        read: bit(),
        from: below(5),
        each: below(4).of(row(2)),
    }
    out FreshOut { word: bits(8), words: bits(8).of(row(2)) }
}

impl Fresh {
    fn build(&self, m: Module, i: FreshIn) -> FreshOut {
        def!(store = m.memory(5, 8, ReadUnderWrite::New).true_dual_port().fill(7));
        def!(lanes = m.memory(4, bits(8).of(row(2)), ReadUnderWrite::New).fill(7));
        def!(word = store.read_when(i.read, i.from));
        for port in 0..2 {
            store.write(i.writes.bit(port as u32), i.to[port], i.data[port]);
        }
        lanes.write(i.writes.bit(0), i.to[0].slice(0..2), stack([i.data[0], i.data[1]]));
        FreshOut { word, words: lanes.read(i.each) }
    }
}

#[test]
fn a_read_gives_the_word_that_is_written() {
    let mut sim = of(&Fresh);
    let (mut store, mut lanes, mut word) = ([7; 5], [[7; 4]; 2], 0);
    let mut state = 7_u64;
    let mut next = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    };
    let mut fresh = 0;
    for _ in 0..300 {
        let (writes, to, data) = (next(4), [next(8), next(8)], [next(256), next(256)]);
        let (read, from, each) = (next(4).min(1), next(8), [next(4), next(4)]);
        let lanes_of = |values: [u64; 2]| Bits::new(4, values[0] | values[1] << 2);
        let (listed, given) = (to.map(u128::from).to_vec(), data.map(u128::from).to_vec());
        sim.set(sim.i.writes, writes);
        for port in 0..2 {
            sim.set(sim.i.to[port], listed[port]);
            sim.set(sim.i.data[port], given[port]);
        }
        sim.set(sim.i.read, read);
        sim.set(sim.i.from, from);
        sim.set(sim.i.each, lanes_of(each));
        sim.step();
        for port in (0..2).filter(|port| writes >> port & 1 == 1) {
            if let Some(word) = store.get_mut(to[port] as usize) {
                *word = data[port];
                fresh += u64::from(read == 1 && to[port] == from);
            }
        }
        if writes & 1 == 1 {
            (0..2).for_each(|lane| lanes[lane][to[0] as usize % 4] = data[lane]);
        }
        // No word is beyond the depth.
        word = if read == 1 { store.get(from as usize).copied().unwrap_or(0) } else { word };
        let words = [0, 1].map(|lane| lanes[lane][each[lane] as usize]);
        assert_eq!(sim.get(sim.o.word), word);
        assert_eq!(sim.get(sim.o.words), words[0] | words[1] << 8);
    }
    assert!(fresh > 10, "{fresh}");
}
