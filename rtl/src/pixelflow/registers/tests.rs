//! Both sides of the registers, compared with an array of bytes, with one clock and with two.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::NETWORK;
use super::*;

/// The accesses of both sides in a clock.
#[derive(Debug, Clone)]
struct Step {
    read: u64,
    write: u64,
    /// The pixels that write, and the byte of each.
    writes: Vec<u64>,
    result: Vec<u64>,
    pixel: u64,
    address: u64,
    port_writes: u64,
    bytes: Vec<u64>,
}

fn steps(width: u32, height: u32) -> impl Strategy<Value = Vec<Step>> {
    let (pixels, chips) = ((width * height) as usize, (height / 2) as usize);
    let address = || prop_oneof![0..4u64, Just(31), Just(32), Just(63)];
    let bytes = |count: usize| prop::collection::vec(0..256u64, count);
    let array = (address(), address(), prop::collection::vec(0..2u64, pixels), bytes(pixels));
    let port = (0..u64::from(2 * width), address(), 0..2u64, bytes(chips));
    let step = (array, port).prop_map(|((read, write, writes, result), (pixel, address, port_writes, bytes))| {
        // The sides never write the same byte, because the result would be undefined.
        let write = if write == address { address ^ 1 } else { write };
        Step { read, write, writes, result, pixel, address, port_writes, bytes }
    });
    prop::collection::vec(step, 1..60)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn each_side_sees_what_both_write(
        (width, height, steps) in (1..4u32, 1..4u32).prop_flat_map(|(width, height)| {
            let (width, height) = (1 << width, 1 << height);
            (Just(width), Just(height), steps(width, height))
        }),
        port in prop::sample::select(vec![ARRAY, NETWORK]),
    ) {
        let mut sim = Simulation::of(&CommunicationRegisters { width, height, bytes: 64, port }).unwrap();
        sim.reset();
        let (i, o) = (sim.i, sim.o);
        let mut held = vec![[0; 64]; (width * height) as usize];
        // A chip is two lines, so its pixels follow one another.
        let place = |chip: usize, pixel: u64| chip * 2 * width as usize + pixel as usize;
        for step in steps {
            let numbers = [(i.read, step.read), (i.write, step.write), (i.port.pixel, step.pixel)];
            numbers.into_iter().for_each(|(port, number)| sim.set(port, number));
            sim.set(i.port.address, step.address);
            sim.set(i.port.writes, step.port_writes);
            sim.set_lanes(i.writes, step.writes.clone());
            sim.set_lanes(i.result, step.result.clone());
            sim.set_lanes(i.port.bytes, step.bytes.clone());
            let read: Vec<u64> = held.iter().map(|pixel| pixel[step.read as usize]).collect();
            prop_assert_eq!(sim.lanes(o.word), read);
            let chips = 0..step.bytes.len();
            let seen: Vec<u64> = chips.map(|chip| held[place(chip, step.pixel)][step.address as usize]).collect();
            prop_assert_eq!(sim.lanes(o.seen), seen);

            let before = sim.cycles("array").unwrap();
            sim.step();
            // Every second edge of the network is also one of the array.
            if sim.cycles("array").unwrap() > before {
                let written = held.iter_mut().zip(&step.writes).zip(&step.result).filter(|((_, writes), _)| **writes == 1);
                written.for_each(|((pixel, _), byte)| pixel[step.write as usize] = *byte);
            }
            if step.port_writes == 1 {
                let written = step.bytes.iter().enumerate();
                written.for_each(|(chip, byte)| held[place(chip, step.pixel)][step.address as usize] = *byte);
            }
        }
    }
}
