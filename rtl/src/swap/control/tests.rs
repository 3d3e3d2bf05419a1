//! Frames of up to three processing elements, each at its own pace.

use tilewright_sim::Simulation;

use super::*;

/// Bits of three processing elements: none, and all.
const NONE: u64 = 0b000;
const ALL: u64 = 0b111;

const IDLE: SwapControlIn<u64> = SwapControlIn {
    done: NONE,
    idle: ALL,
    overflow: NONE,
    draws: NONE,
    clears: NONE,
    patch: 0,
    bus: 1,
    host: 1,
    sending: NONE,
    enable: 1,
    blanking: 0,
};

type Sim = Simulation<SwapControlIn, SwapControlOut>;

fn running(processors: u32) -> Sim {
    let local = LfbSwap { patches: 2, merge_clocks: 13, sent_clocks: 193, overflow_clocks: 300 };
    let global = GfbSwap { processors, merge_clocks: 4, way: 8, late: 40 };
    let mut sim = Simulation::of(&SwapControl { local, global }).unwrap();
    sim.reset();
    sim
}

/// Runs a clock of the processing elements with these inputs; returns the outputs before its edge.
fn clock(sim: &mut Sim, inputs: SwapControlIn<u64>) -> SwapControlOut<u64> {
    sim.drive(inputs);
    let seen = sim.read_u64();
    sim.step_clock(PE, 1);
    seen
}

/// Clears the tables of these processing elements, one after another; returns `resume` in each clock.
fn clear(sim: &mut Sim, elements: u64, inputs: SwapControlIn<u64>) -> Vec<u64> {
    let mut resumed = Vec::new();
    for lane in (0..3).filter(|lane| elements >> lane & 1 == 1) {
        let clears = 1 << lane;
        resumed.push(clock(sim, SwapControlIn { clears, ..inputs }).resume);
        resumed.push(clock(sim, SwapControlIn { clears, patch: clears, ..inputs }).resume);
    }
    resumed
}

/// The states of all processing elements, from the last to the first.
fn states(sim: &mut Sim) -> [SwapState; 3] {
    let state = sim.get_u64(sim.o.state);
    [4, 2, 0].map(|bit| SwapState::of_code(state >> bit & 3))
}

/// Ends the frame that all have drawn.
fn end(sim: &mut Sim) {
    assert_eq!(clock(sim, SwapControlIn { done: ALL, ..IDLE }).line, 1);
    assert_eq!(states(sim), [SwapState::Due; 3]);
}

#[test]
fn each_clears_and_draws_for_itself() {
    use SwapState::{Clear, Draw};
    let mut sim = running(3);
    for (lane, expected) in [(0, [Clear, Clear, Draw]), (2, [Draw, Clear, Draw]), (1, [Draw, Draw, Draw])] {
        clear(&mut sim, 1 << lane, IDLE);
        assert_eq!(states(&mut sim), expected);
        // An assumption fails if a processing element draws before its table is cleared.
        clock(&mut sim, SwapControlIn { draws: 1 << lane, ..IDLE });
    }
}

#[test]
fn the_line_is_high_when_all_are_done_and_the_bus_and_the_host_let_it_go() {
    let mut sim = running(3);
    clear(&mut sim, ALL, IDLE);
    let ends = SwapControlIn { done: ALL, ..IDLE };
    for lane in [0b001, 0b010, 0b100] {
        assert_eq!(clock(&mut sim, SwapControlIn { done: ALL - lane, ..IDLE }).line, 0);
        assert_eq!(clock(&mut sim, SwapControlIn { idle: ALL - lane, ..ends }).line, 0);
    }
    assert_eq!(clock(&mut sim, SwapControlIn { bus: 0, ..ends }).line, 0);
    assert_eq!(clock(&mut sim, SwapControlIn { host: 0, ..ends }).line, 0);
    assert_eq!(states(&mut sim), [SwapState::Draw; 3]);
    end(&mut sim);
    assert_eq!(clock(&mut sim, IDLE).swap, ALL);
    assert_eq!(states(&mut sim), [SwapState::Clear; 3]);
}

/// The chain does not advance until some clocks after all have swapped, so the frame is stored later than T_m.
fn banks_swap(processors: u32) {
    let mut sim = running(processors);
    let all = (1 << processors) - 1;
    let idle = SwapControlIn { idle: all, ..IDLE };
    let ends = SwapControlIn { done: all, ..idle };
    clear(&mut sim, all, idle);
    assert_eq!(clock(&mut sim, ends).line, 1);
    clock(&mut sim, idle);
    for _ in 0..40 {
        let seen = clock(&mut sim, SwapControlIn { enable: 0, blanking: 1, ..idle });
        assert_eq!((seen.merged, seen.gfb_swap, seen.shown), (0, 0, 0));
    }
    clear(&mut sim, all, idle);
    assert_eq!(clock(&mut sim, ends).line, 1);
    for _ in 0..40 {
        let seen = clock(&mut sim, idle);
        assert_eq!((seen.swap, seen.gfb_swap, seen.shown), (NONE, 0, 0));
    }
    assert_eq!(sim.get_u64(sim.o.merged), 1);
    let merges = sim.cycles(MERGE).unwrap();
    sim.drive(SwapControlIn { blanking: 1, ..idle });
    assert_eq!(sim.get_u64(sim.o.gfb_swap), 1);
    while sim.cycles(MERGE).unwrap() == merges {
        assert_eq!(sim.get_u64(sim.o.shown), 0);
        sim.step();
    }
    assert_eq!((sim.get_u64(sim.o.merged), sim.get_u64(sim.o.gfb_swap), sim.get_u64(sim.o.shown)), (0, 0, 1));
    // The processing elements learn of it after two edges.
    let swaps = [(); 4].map(|()| clock(&mut sim, idle).swap);
    assert!(swaps.contains(&all), "{swaps:?}");
}

#[test]
fn the_banks_swap_in_a_blanking_with_all_stored_and_the_next_frame_waits_for_that() {
    (1..=3).for_each(banks_swap);
}

#[test]
fn banks_that_swap_while_any_buffer_is_sent_are_an_error() {
    for sending in [0b01, 0b10] {
        let mut sim = running(2);
        clear(&mut sim, 0b11, SwapControlIn { idle: 0b11, ..IDLE });
        clock(&mut sim, SwapControlIn { done: 0b11, idle: 0b11, ..IDLE });
        clock(&mut sim, SwapControlIn { idle: 0b11, ..IDLE });
        sim.drive(SwapControlIn { idle: 0b11, sending, blanking: 1, ..IDLE });
        let problem = std::iter::from_fn(|| Some(sim.try_step())).take(100).find_map(Result::err).unwrap().to_string();
        assert!(problem.contains("all of a frame is sent before the banks change"), "{problem}");
    }
}

#[test]
fn an_overflow_swaps_alone_when_its_own_buffer_is_sent() {
    use SwapState::{Clear, Draw, Overflow};
    let mut sim = running(3);
    clear(&mut sim, ALL, IDLE);
    // All guards are true for the first swap.
    clock(&mut sim, SwapControlIn { overflow: ALL, idle: NONE, ..IDLE });
    assert_eq!(clock(&mut sim, IDLE).swap, ALL);
    clear(&mut sim, ALL, IDLE);
    // From then on, the buffers of the others may still be in transfer.
    for (lane, expected) in [
        (0b001, [[Draw, Draw, Overflow], [Draw, Draw, Clear]]),
        (0b010, [[Draw, Overflow, Draw], [Draw, Clear, Draw]]),
        (0b100, [[Overflow, Draw, Draw], [Clear, Draw, Draw]]),
    ] {
        let overflows = SwapControlIn { overflow: lane, idle: ALL - lane, ..IDLE };
        (0..3).for_each(|_| assert_eq!(clock(&mut sim, SwapControlIn { sending: lane, ..IDLE }).swap, NONE));
        for _ in 0..20 {
            assert_eq!(clock(&mut sim, SwapControlIn { sending: lane, ..overflows }).swap, NONE);
        }
        assert_eq!(states(&mut sim), expected[0]);
        let sent = SwapControlIn { sending: ALL - lane, ..overflows };
        assert_eq!([(); 3].map(|()| clock(&mut sim, sent).swap), [NONE, NONE, lane]);
        assert_eq!(states(&mut sim), expected[1]);
        assert_eq!(clear(&mut sim, lane, IDLE), [NONE, lane]);
    }
}
