use std::cell::Cell;

use proptest::prelude::*;
use tilewright_sim::{Port, Simulation, Testbench, monitor};

use super::*;
use crate::lfb::Patches;
use crate::parameter::Screen;

const EMPTY: u64 = (1 << 48) - 1;
const BLANK: u64 = 0xffffff << 24 | 0x102030;

type Sim = Simulation<Vc1In, Vc1Out>;

/// A machine and its host, who knows how to draw, merge and look.
struct Machine {
    sim: Sim,
    screen: Screen,
    patches: u32,
    merge_clocks: u64,
    overflows: u64,
}

impl Machine {
    fn new(screen: Screen, edge: u32, pages: u32, processors: u32) -> Machine {
        let patches = Patches::new(screen, edge).unwrap();
        let vc1 = Vc1 { lfb: LfbUnit { patches, pages }, processors };
        let mut sim = Simulation::of(&vc1).unwrap();
        sim.reset();
        sim.set(sim.i.gfb.background, BLANK);
        let (patches, merge_clocks) = (patches.count(), vc1.gfb().sequencer().merge_clocks());
        Machine { sim, screen, patches, merge_clocks, overflows: 0 }
    }

    /// Draws pixels on a processor, one after the other, through overflows.
    fn draw(&mut self, processor: usize, pixels: impl IntoIterator<Item = (u64, u64, u64)>) {
        let request = self.sim.i.processors[processor].request;
        for (x, y, word) in pixels {
            self.sim.set(request.valid, 1);
            self.sim.set(request.x, x);
            self.sim.set(request.y, y);
            self.sim.set(request.word, word);
            self.wait_until(request.ready);
            self.sim.step_clock(PE, 1);
            self.sim.set(request.valid, 0);
            self.go_on_after_an_overflow(processor);
        }
        self.wait_until(self.sim.o.processors[processor].idle);
    }

    fn wait_until(&mut self, port: Port) {
        for _ in 0..20 {
            if self.sim.get_u64(port) == 1 {
                return;
            }
            self.sim.step_clock(PE, 1);
        }
        panic!("the processor waits for ever");
    }

    /// If there is no page for the pixel just accepted, which shows after two clocks: swaps the buffers, has them merged,
    /// clears the patch table, and resumes.
    fn go_on_after_an_overflow(&mut self, processor: usize) {
        self.sim.step_clock(PE, 2);
        if self.sim.get_u64(self.sim.o.processors[processor].overflow) == 0 {
            return;
        }
        self.overflows += 1;
        self.swap(processor);
        self.merge();
        let clear = self.sim.i.processors[processor].clear;
        self.sim.set(clear.valid, 1);
        for patch in 0..self.patches {
            self.sim.set(clear.patch, u64::from(patch));
            self.wait_until(clear.ready);
            self.sim.step_clock(PE, 1);
        }
        self.sim.set(clear.valid, 0);
        self.pulse(self.sim.i.processors[processor].resume, PE);
    }

    fn pulse(&mut self, port: Port, clock: Clock) {
        self.sim.set(port, 1);
        self.sim.step_clock(clock, 1);
        self.sim.set(port, 0);
        // The other clock's synchronizers.
        self.sim.step_clock(MERGE, 8);
    }

    /// Swaps a processor's buffers.
    fn swap(&mut self, processor: usize) {
        self.pulse(self.sim.i.processors[processor].swap, PE);
    }

    /// A round of merging; gives the clocks that the hardware counted.
    fn merge(&mut self) -> u64 {
        self.sim.set(self.sim.i.gfb.start, 1);
        self.sim.step_clock(MERGE, 1);
        self.sim.set(self.sim.i.gfb.start, 0);
        self.finish_round();
        self.sim.get_u64(self.sim.o.gfb.clocks)
    }

    /// Lets clocks pass until the round under way has ended.
    fn finish_round(&mut self) {
        for _ in 0..self.merge_clocks + 9 {
            if self.sim.get_u64(self.sim.o.gfb.busy) == 0 {
                return;
            }
            self.sim.step_clock(MERGE, 1);
        }
        panic!("the round has no end");
    }

    /// Exchanges the banks.
    fn show(&mut self) {
        self.pulse(self.sim.i.gfb.swap, MERGE);
    }

    /// The picture on display.
    fn picture(&mut self) -> Vec<u64> {
        let read = |pixel: u32| {
            self.sim.set(self.sim.i.gfb.read_address, u64::from(pixel));
            self.sim.step_clock(MERGE, 1);
            self.sim.get_u64(self.sim.o.gfb.read_word)
        };
        (0..self.screen.pixels()).map(read).collect()
    }
}

/// The nearest of what was drawn, in raster order.
fn nearest(screen: Screen, drawn: &[(u64, u64, u64)], under: &[u64]) -> Vec<u64> {
    let mut picture = under.to_vec();
    for &(x, y, word) in drawn {
        let pixel = &mut picture[(y * u64::from(screen.width) + x) as usize];
        *pixel = word.min(*pixel);
    }
    picture
}

fn blank(screen: Screen) -> Vec<u64> {
    vec![BLANK; screen.pixels() as usize]
}

#[test]
fn a_chain_longer_than_a_frame_is_refused_in_a_sentence() {
    let lfb = LfbUnit { patches: Patches::new(Screen { width: 16, height: 8 }, 4).unwrap(), pages: 8 };
    assert!(Vc1 { lfb: lfb.clone(), processors: 32 }.checked().is_ok());
    assert_eq!(
        Vc1 { lfb, processors: 33 }.checked().unwrap_err().to_string(),
        "`processors` of `Vc1` is 33: it has to be from 1 to 32. Each scan counter runs 4 pixels ahead of the succeeding one."
    );
}

#[test]
fn a_round_takes_t_m() {
    for (width, height, processors) in [(16, 8, 1), (16, 8, 16), (33, 5, 3), (8, 8, 16)] {
        let screen = Screen { width, height };
        let mut machine = Machine::new(screen, 4, 2, processors);
        let t_m = u64::from((width + 20) * height + 4 * processors);
        assert_eq!(machine.merge(), t_m, "{width} x {height}, {processors} processors");
        assert_eq!(machine.merge_clocks, t_m);
    }
    let full = Vc1 { lfb: LfbUnit { patches: Patches::new(Screen::VC1, 4).unwrap(), pages: 4096 }, processors: 16 };
    assert_eq!(full.gfb().sequencer().merge_clocks(), 316_864);
}

#[test]
fn each_processor_sees_its_own_buffer() {
    for processors in [2, 3] {
        let mut machine = Machine::new(Screen { width: 16, height: 8 }, 4, 8, processors);
        let processors = 0..processors as usize;
        for busy in processors.clone() {
            machine.draw(busy, (0..=busy as u64).map(|patch| (4 * patch, 0, 9)));
            let ProcessorIn { request, clear, .. } = machine.sim.i.processors[busy];
            machine.sim.set(clear.patch, busy as u64);
            for wanted in [1, 0] {
                machine.sim.set(request.valid, wanted);
                machine.sim.set(clear.valid, wanted);
                machine.sim.step_clock(PE, wanted);
            }
            for processor in processors.clone() {
                let (i, o) = (machine.sim.i.processors[processor], machine.sim.o.processors[processor]);
                let seen = [i.request.ready, i.clear.ready, o.idle].map(|port| machine.sim.get_u64(port));
                assert_eq!(seen, [u64::from(processor != busy); 3], "{processor} of {busy}");
            }
            machine.wait_until(machine.sim.o.processors[busy].idle);
        }
        // The patch that was drawn into last was cleared, and got another page.
        for processor in processors {
            let pages = machine.sim.get_u64(machine.sim.o.processors[processor].pages_used);
            assert_eq!(pages, processor as u64 + 2);
        }
    }
}

#[test]
fn the_host_sees_which_round_is_the_first() {
    let mut machine = Machine::new(Screen { width: 16, height: 8 }, 4, 8, 1);
    for _ in 0..2 {
        assert_eq!(machine.sim.get_u64(machine.sim.o.gfb.first_round), 1);
        for _ in 0..2 {
            machine.merge();
            assert_eq!(machine.sim.get_u64(machine.sim.o.gfb.first_round), 0);
        }
        machine.show();
    }
}

#[test]
fn later_rounds_accumulate_and_a_swap_starts_afresh() {
    let screen = Screen { width: 16, height: 8 };
    let mut machine = Machine::new(screen, 4, 8, 3);
    let first = [(0, 0, 50), (15, 7, 60), (3, 3, 70)];
    machine.draw(0, first);
    (0..3).for_each(|processor| machine.swap(processor));
    machine.merge();
    // An extra swap of one processor, whose pixels join those of the first round.
    let second = [(0, 0, 40), (15, 7, 61), (8, 2, 80)];
    machine.draw(2, second);
    machine.swap(2);
    machine.merge();
    machine.show();
    let drawn: Vec<_> = first.into_iter().chain(second).collect();
    assert_eq!(machine.picture(), nearest(screen, &drawn, &blank(screen)));
    // Nothing of it is left in the next frame, nor in the frame after, which goes into the bank shown now.
    for _ in 0..2 {
        machine.merge();
        machine.show();
        assert_eq!(machine.picture(), blank(screen));
    }
}

#[test]
fn a_swap_during_a_round_loses_nothing() {
    let screen = Screen { width: 16, height: 8 };
    let drawn: Vec<_> = (0..8).flat_map(|y| (0..16).map(move |x| (x, y, 100 * y + x))).collect();
    for delay in [1, 3, 4, 20, 150, 280, 290, 300] {
        let mut machine = Machine::new(screen, 4, 8, 4);
        machine.draw(0, drawn.iter().copied());
        machine.sim.set(machine.sim.i.gfb.start, 1);
        machine.sim.step_clock(MERGE, 1);
        machine.sim.set(machine.sim.i.gfb.start, 0);
        machine.sim.step_clock(MERGE, delay);
        machine.swap(0);
        machine.finish_round();
        machine.merge();
        machine.show();
        assert_eq!(machine.picture(), nearest(screen, &drawn, &blank(screen)), "a swap {delay} clocks after the start");
    }
}

#[test]
fn an_overflow_is_merged_in_a_round_of_its_own() {
    let screen = Screen { width: 16, height: 8 };
    let mut machine = Machine::new(screen, 4, 2, 2);
    let drawn: Vec<_> = (0..8).map(|patch| (4 * (patch % 4), 4 * (patch / 4), 100 - patch)).collect();
    machine.draw(1, drawn.iter().copied());
    assert_eq!(machine.overflows, 3, "8 patches in 2 pages");
    machine.swap(1);
    machine.merge();
    machine.show();
    assert_eq!(machine.picture(), nearest(screen, &drawn, &blank(screen)));
}

/// A processor that draws, through overflows, while the host has the machine merge round after round; at the end it swaps.
async fn processor(
    t: &Testbench<'_>,
    ports: (ProcessorIn<Port>, ProcessorOut<Port>),
    merged: &Cell<u64>,
    pixels: &[(u64, u64, u64)],
    patches: u32,
) -> u64 {
    let (t, (i, o)) = (t.on(PE), ports);
    let mut overflows = 0;
    for &(x, y, word) in pixels {
        t.send(i.request, Request { x, y, word }).await;
        t.wait(3).await;
        if t.get_u64(o.overflow) == 1 {
            overflows += 1;
            swap_and_wait(&t, i.swap, merged).await;
            for patch in 0..u64::from(patches) {
                t.send(i.clear, Wanted { patch }).await;
            }
            pulse(&t, i.resume).await;
        }
        // Processors are not in step.
        t.wait(word % 5).await;
    }
    t.until(o.idle).await;
    swap_and_wait(&t, i.swap, merged).await;
    overflows
}

async fn pulse(t: &Testbench<'_>, port: Port) {
    t.set(port, 1);
    t.step().await;
    t.set(port, 0);
}

/// Swaps, and waits for a round that begins after it has had its effect.
async fn swap_and_wait(t: &Testbench<'_>, swap: Port, merged: &Cell<u64>) {
    pulse(t, swap).await;
    t.on(MERGE).wait(SWAP_CLOCKS).await;
    let rounds = merged.get();
    while merged.get() < rounds + 2 {
        t.step().await;
    }
}

/// The host: a round of merging after another.
async fn merge_for_ever(t: &Testbench<'_>, start: Port, busy: Port, merged: &Cell<u64>) {
    let t = t.on(MERGE);
    loop {
        pulse(&t, start).await;
        t.until(busy.is(0)).await;
        merged.set(merged.get() + 1);
    }
}

#[test]
fn processors_draw_side_by_side_while_the_host_merges() {
    let screen = Screen { width: 16, height: 8 };
    let mut machine = Machine::new(screen, 4, 2, 3);
    let drawn: [Vec<_>; 3] = [0, 1, 2].map(|number| {
        (0..12).map(|i| ((5 * i + number) % 16, (3 * i + number) % 8, 100 + 7 * i - 20 * number)).collect()
    });
    let (start, busy) = (machine.sim.i.gfb.start, machine.sim.o.gfb.busy);
    let ports = machine.sim.i.processors.iter().zip(&machine.sim.o.processors);
    let ports: Vec<_> = ports.map(|(i, o)| (*i, *o)).collect();
    let (merged, patches) = (Cell::new(0), machine.patches);
    let t = machine.sim.testbench();
    let draw = ports.into_iter().zip(&drawn).map(|(ports, pixels)| processor(&t, ports, &merged, pixels, patches));
    let (overflows, ()) = t.run((t.all(draw), monitor(merge_for_ever(&t, start, busy, &merged))));
    assert!(overflows.iter().all(|&count| count > 1), "{overflows:?}");
    // The round that goes on, or was about to start.
    machine.sim.set(start, 0);
    machine.sim.step_clock(MERGE, 2);
    while machine.sim.get_u64(busy) == 1 {
        machine.sim.step_clock(MERGE, 1);
    }
    machine.show();
    assert_eq!(machine.picture(), nearest(screen, &drawn.concat(), &blank(screen)));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_picture_is_the_nearest_of_all(
        processors in 1u32..5,
        edge in prop::sample::select(vec![4u32, 8]),
        pages in 2u32..15,
        pixels in prop::collection::vec((0u32..4, 0u64..18, 0u64..11, 0..EMPTY), 0..40),
    ) {
        let screen = Screen { width: 18, height: 11 };
        let pages = pages.min(Patches::new(screen, edge).unwrap().count());
        let mut machine = Machine::new(screen, edge, pages, processors);
        for &(processor, x, y, word) in &pixels {
            machine.draw((processor % processors) as usize, [(x, y, word)]);
        }
        (0..processors).for_each(|processor| machine.swap(processor as usize));
        machine.merge();
        machine.show();
        let drawn: Vec<_> = pixels.into_iter().map(|(_, x, y, word)| (x, y, word)).collect();
        prop_assert_eq!(machine.picture(), nearest(screen, &drawn, &blank(screen)));
    }
}
