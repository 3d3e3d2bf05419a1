//! Fetching of frames, clock by clock and at random.

use proptest::prelude::*;
use tilewright_sim::{Pauses, Simulation};

use super::*;

type Dma = Simulation<CommandDmaIn, CommandDmaOut>;

/// An instruction with a different value in every field for each number; it need not be a valid one.
fn numbered(number: u64) -> Instruction<u64> {
    let mut state = number;
    let fields = Instruction::widths().map(|width| {
        state = (state + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        state >> (64 - width.bits())
    });
    Instruction { a: number, ..fields }
}

/// A fetcher with instruction n at address n.
fn started(words: u32) -> Dma {
    let mut sim = Simulation::of(&CommandDma { words }).unwrap();
    sim.reset();
    let frames = Stream::of(0, Commands { base: 0, length: 0 });
    for address in 0..words.into() {
        let store = Store { writes: 1, address, instruction: numbered(address) };
        sim.drive(CommandDmaIn { store, frames });
        sim.step();
    }
    // The input that is not written differs from the last instruction and from zero.
    sim.drive(CommandDmaIn { store: Store { writes: 0, address: 0, instruction: numbered(1000) }, frames });
    sim
}

#[test]
fn an_instruction_comes_every_clock() {
    let mut sim = started(8);
    let signals = ["frames_valid", "frames_length", "left", "instructions_valid", "instructions_a", "idle"];
    let wave = sim.record(signals);
    let (i, o) = (sim.i, sim.o);
    sim.set(o.instructions.ready, 1);
    for (base, length) in [(2, 2), (7, 2)] {
        sim.set(i.frames.valid, 1);
        sim.set(i.frames.base, base);
        sim.set(i.frames.length, length);
        sim.step();
    }
    sim.set(i.frames.valid, 0);
    sim.run(8);
    wave.expect(
        r"
        clk                |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        frames_valid       |~~~~~~~\________________________________
        frames_length      | 2                                     |
        left               | 0     | 2 | 1 | 0 | 2 | 1 | 0         |
        instructions_valid |___________/~~~~~~~\___/~~~~~~~\________
        instructions_a     | 0         | 2 | 3     | 7 | 0         |
        idle               |~~~\___________________________/~~~~~~~~
        ",
    );
}

#[test]
fn two_frames_wait_behind_the_one_that_is_fetched() {
    let mut sim = started(8);
    let (i, o) = (sim.i, sim.o);
    sim.set(o.instructions.ready, 0);
    sim.set(i.frames.valid, 1);
    sim.set(i.frames.base, 0);
    sim.set(i.frames.length, 8);
    let taken: Vec<u64> = (0..6)
        .map(|_| {
            let taken = sim.get_u64(i.frames.ready);
            sim.step();
            taken
        })
        .collect();
    assert_eq!(taken, [1, 1, 1, 0, 0, 0]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn all_instructions_of_all_frames_come_in_order(
        (words, frames) in (1..20u32).prop_flat_map(|words| {
            let frame = (0..u64::from(words), 0..=u64::from(words));
            (Just(words), prop::collection::vec(frame, 1..8))
        }),
        pauses in prop::array::uniform2(0..90u64),
        seed in any::<u64>(),
    ) {
        let mut sim = started(words);
        let (i, o) = (sim.i, sim.o);
        let address = |(base, length): &(u64, u64)| {
            let base = *base;
            (0..*length).map(move |at| (base + at) % u64::from(words))
        };
        let expected: Vec<u64> = frames.iter().flat_map(address).collect();
        let t = sim.testbench();
        t.limit(1_000_000);
        let send = async {
            let mut pauses = Pauses::percent(pauses[0], seed);
            for &(base, length) in &frames {
                t.wait(pauses.next_length().into()).await;
                t.send(i.frames, Commands { base, length }).await;
            }
        };
        let receive = async {
            let mut pauses = Pauses::percent(pauses[1], seed.wrapping_add(1));
            for &number in &expected {
                t.wait(pauses.next_length().into()).await;
                assert_eq!(t.receive(o.instructions).await, numbered(number));
            }
            t.until(o.idle).await;
            t.expect_silence(o.instructions, 30).await;
        };
        t.run((send, receive));
    }
}
