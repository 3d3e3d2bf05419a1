//! Whole machines: software draws frames of small screens, and the hardware swaps, merges and shows them.

mod bus;
mod multipass;

use std::cell::RefCell;

use proptest::prelude::*;
use tilewright_sim::{Port, Simulation, Testbench, monitor};

use super::*;
use crate::gfb::{Access, Blanking};
use crate::lfb::Patches;
use crate::parameter::Screen;
use crate::swap::SwapState;

const EMPTY: u64 = (1 << 48) - 1;
const BLANK: u64 = 0xffffff << 24 | 0x102030;
const SMALL: Screen = Screen { width: 16, height: 8 };

type Sim = Simulation<Vc1In, Vc1Out>;
type Pixel = (u64, u64, u64);

fn vc1(screen: Screen, edge: u32, pages: u32, processors: u32) -> Vc1 {
    let patches = Patches::new(screen, edge).unwrap();
    let display = Display { period: Period::ps(6_002), blanking: Blanking::AtStart };
    let lfb = LfbUnit { patches, pages: pages.min(patches.count()) };
    Vc1 { lfb, processors, queue: 4, word_clocks: 6, display, overhead: OVERHEAD, accumulation: false }
}

fn running(vc1: &Vc1, seed: u64) -> Sim {
    let mut sim = Simulation::of(vc1).unwrap().seeded(seed);
    sim.reset();
    sim.set(sim.i.host.background, BLANK);
    sim.set(sim.i.ready, 1);
    sim
}

/// The program of a processing element: draws its pixels of each frame, and goes on after overflows. Returns the number
/// of overflows.
async fn program(
    t: &Testbench<'_>,
    (i, o): (ProcessorIn<Port>, ProcessorOut<Port>),
    patches: u32,
    frames: Vec<Vec<Pixel>>,
) -> u64 {
    let t = t.on(PE);
    let mut overflows = 0;
    clear(&t, i, patches).await;
    for pixels in frames {
        for (x, y, word) in pixels {
            t.send(i.request, Request { x, y, word }).await;
            t.wait(2).await;
            while t.get_u64(o.idle) == 0 && t.get_u64(o.state) != SwapState::Overflow as u64 {
                t.wait(1).await;
            }
            if t.get_u64(o.state) == SwapState::Overflow as u64 {
                overflows += 1;
                while t.get_u64(o.state) != SwapState::Clear as u64 {
                    t.wait(1).await;
                }
                clear(&t, i, patches).await;
            }
        }
        t.set(i.done, 1);
        while t.get_u64(o.state) == SwapState::Draw as u64 {
            t.wait(1).await;
        }
        t.set(i.done, 0);
        while t.get_u64(o.state) != SwapState::Clear as u64 {
            t.wait(1).await;
        }
        clear(&t, i, patches).await;
    }
    overflows
}

async fn clear(t: &Testbench<'_>, i: ProcessorIn<Port>, patches: u32) {
    for patch in 0..u64::from(patches) {
        t.send(i.clear, Wanted { patch }).await;
    }
    // The state changes after the last clear.
    t.wait(2).await;
}

/// The host: reads the displayed bank after each swap.
async fn host(
    t: &Testbench<'_>,
    (read, i): (View<Port>, Stream<Access<Port>, Port>),
    shown: Port,
    screen: Screen,
    frames: usize,
) -> Vec<Vec<u64>> {
    let t = t.on(MERGE);
    let mut pictures = Vec::new();
    for frame in 0..frames as u64 {
        while t.get_u64(shown) == frame % 2 {
            t.wait(1).await;
        }
        let mut picture = Vec::new();
        for address in 0..u64::from(screen.pixels()) {
            t.send(i, Access { address, writes: 0, word: 0 }).await;
            t.wait(1).await;
            assert_eq!(t.get_u64(read.read_valid), 1);
            picture.push(t.get_u64(read.read_word));
        }
        pictures.push(picture);
    }
    pictures
}

/// The display: collects the colours of each refresh. The last refresh is incomplete.
async fn display(t: &Testbench<'_>, pixel: CrtPixel<Port>, pixels: u32, refreshes: &RefCell<Vec<Vec<u64>>>) {
    let t = t.on("crt");
    loop {
        t.wait(1).await;
        if t.get_u64(pixel.valid) == 1 {
            let mut refreshes = refreshes.borrow_mut();
            refreshes.last_mut().unwrap().push(t.get_u64(pixel.rgb));
            if refreshes.last().unwrap().len() == pixels as usize {
                refreshes.push(Vec::new());
            }
        }
    }
}

/// The results of a run.
struct Run {
    sim: Sim,
    pictures: Vec<Vec<u64>>,
    refreshes: Vec<Vec<u64>>,
    overflows: Vec<u64>,
}

/// Lets every processing element draw its frames.
fn run(vc1: &Vc1, drawn: &[Vec<Vec<Pixel>>], seed: u64) -> Run {
    let mut sim = running(vc1, seed);
    let (screen, patches) = (vc1.lfb.patches.screen(), vc1.lfb.patches.count());
    let ports: Vec<_> = sim.i.processors.iter().copied().zip(sim.o.processors.iter().copied()).collect();
    let (view, host_in, shown, pixel) = (sim.o.view, sim.i.host.accesses, sim.o.shown, sim.o.pixel);
    let refreshes = RefCell::new(vec![Vec::new()]);
    let t = sim.testbench();
    t.limit(4_000_000);
    let programs = ports.into_iter().zip(drawn).map(|(ports, frames)| program(&t, ports, patches, frames.clone()));
    let host = host(&t, (view, host_in), shown, screen, drawn[0].len());
    let shows = monitor(display(&t, pixel, screen.pixels(), &refreshes));
    let (overflows, pictures, ()) = t.run((t.all(programs), host, shows));
    drop(t);
    // Two refreshes later the whole last frame has been shown.
    let end = sim.time() + 2 * vc1.gfb().read_out().refresh_clocks() * vc1.display.period.picoseconds();
    let t = sim.testbench();
    let until = async {
        while t.time() < end {
            t.step().await;
        }
    };
    let shows = monitor(display(&t, pixel, screen.pixels(), &refreshes));
    t.run((until, shows));
    drop(t);
    let mut refreshes = refreshes.into_inner();
    refreshes.pop();
    Run { sim, pictures, refreshes, overflows }
}

/// The nearest of the pixels drawn, in raster order.
fn nearest<'a>(screen: Screen, drawn: impl IntoIterator<Item = &'a Pixel>) -> Vec<u64> {
    let mut picture = vec![BLANK; screen.pixels() as usize];
    for &(x, y, word) in drawn {
        let pixel = &mut picture[(y * u64::from(screen.width) + x) as usize];
        *pixel = word.min(*pixel);
    }
    picture
}

/// Checks that each frame has the nearest pixels of all processors, and that each refresh shows one frame, in sequence.
fn check(vc1: &Vc1, drawn: &[Vec<Vec<Pixel>>], run: &Run) {
    let frames = (0..drawn[0].len())
        .map(|frame| nearest(vc1.lfb.patches.screen(), drawn.iter().flat_map(|processor| &processor[frame])));
    let frames: Vec<_> = frames.collect();
    for (frame, (seen, expected)) in run.pictures.iter().zip(&frames).enumerate() {
        let differ: Vec<_> = (0..seen.len()).filter(|pixel| seen[*pixel] != expected[*pixel]).collect();
        assert!(differ.is_empty(), "pixels {differ:?} of frame {frame} differ");
    }
    assert_eq!(run.pictures.len(), frames.len());
    let colours = |words: &Vec<u64>| words.iter().map(|word| word & 0xffffff).collect::<Vec<_>>();
    let mut shown: Vec<Vec<u64>> = run.refreshes.clone();
    shown.dedup();
    let mut expected: Vec<_> = frames.iter().map(colours).collect();
    expected.dedup();
    // Before the first frame the display shows the bank's power-on contents.
    let first = shown.iter().position(|refresh| expected.contains(refresh)).expect("a frame is shown");
    assert!(first <= 1, "a refresh shows two frames");
    let mut frames = expected.iter();
    assert!(shown[first..].iter().all(|refresh| frames.any(|frame| frame == refresh)), "a refresh shows two frames");
    assert_eq!(frames.len(), 0, "the last frame is shown");
    // If T_m is shorter than the blanking, the banks may change twice in one blanking.
    let is_each_shown = vc1.display.blanking == Blanking::AtStart;
    assert!(!is_each_shown || shown[first..] == expected, "each frame is shown");
}

fn pixels(screen: Screen, of: impl Fn(u64, u64) -> Option<u64>) -> Vec<Pixel> {
    let all = (0..u64::from(screen.height)).flat_map(|y| (0..u64::from(screen.width)).map(move |x| (x, y)));
    all.filter_map(|(x, y)| of(x, y).map(|word| (x, y, word))).collect()
}

#[test]
fn a_chain_longer_than_a_frame_is_refused_in_a_sentence() {
    assert!(vc1(SMALL, 4, 8, 31).checked().is_ok());
    assert_eq!(
        vc1(SMALL, 4, 8, 32).checked().unwrap_err().to_string(),
        "`processors` of `Vc1` is 32: it has to be from 1 to 31. Each scan counter runs 4 pixels ahead of the succeeding one, \
         and all lie within the screen."
    );
}

/// The VC-1 of the paper: T_m is 25.35 ms, 1,013,965 clocks of 25 ns.
#[test]
fn the_guards_of_the_papers_machine() {
    let full = vc1(Screen::VC1, 4, 4096, 16);
    assert_eq!(full.gfb_swap().merge_clocks, 316_864);
    assert_eq!(full.lfb_swap().merge_clocks, 1_013_965);
    assert_eq!((full.gfb_swap().way, full.gfb_swap().late), (307_200 + 64 + 4, 20 + 20 + 5));
    // 2 T_m with crossings and overheads, and one refresh. The average of several passes takes 2 more.
    let refresh = |full: &Vc1| full.lfb_swap().overflow_clocks - 2 * full.lfb_swap().sent_clocks - 26;
    let vga = Vc1 { display: Display::VGA, ..full };
    assert_eq!(vga.lfb_swap().sent_clocks, 1_013_965 + 45 * 80 / 25 + 16);
    assert_eq!(refresh(&vga), (800 * 525 * 39_682u64).div_ceil(25_000));
    assert_eq!(refresh(&Vc1 { accumulation: true, ..vga }), (3 * 800 * 525 * 39_682u64).div_ceil(25_000));
}

#[test]
fn each_processor_sees_its_own_buffer() {
    let machine = vc1(SMALL, 4, 8, 3);
    let mut sim = running(&machine, 7);
    let (patches, ports) = (machine.lfb.patches.count(), sim.i.processors.clone());
    let t = sim.testbench();
    let pe = t.on(PE);
    t.run((t.all(ports.iter().map(|i| clear(&pe, *i, patches))),));
    t.run((t.all((1u64..).zip(&ports).map(|(count, i)| {
        let t = t.on(PE);
        async move {
            for patch in 0..count {
                t.send(i.request, Request { x: 4 * (patch % 4), y: 4 * (patch / 4), word: 9 }).await;
            }
            t.wait(9).await;
        }
    })),));
    drop(t);
    for (processor, pages) in (0..3).zip([1, 2, 3]) {
        assert_eq!(sim.get_u64(sim.o.processors[processor].pages_used), pages);
        assert_eq!(sim.get_u64(sim.o.processors[processor].idle), 1);
    }
}

#[test]
fn the_host_reads_what_it_writes() {
    let mut sim = running(&vc1(SMALL, 4, 8, 3), 7);
    let (i, view) = (sim.i.host.accesses, sim.o.view);
    let t = sim.testbench();
    let seen = t.run((async {
        let t = t.on(MERGE);
        for address in [3, 127] {
            t.send(i, Access { address, writes: 1, word: 0xabc000 + address }).await;
        }
        let mut seen = Vec::new();
        for address in [127, 3] {
            t.send(i, Access { address, writes: 0, word: 0 }).await;
            t.wait(1).await;
            seen.push((t.get_u64(view.read_valid), t.get_u64(view.read_word)));
        }
        seen
    },));
    assert_eq!(seen.0, [(1, 0xabc07f), (1, 0xabc003)]);
}

/// The first frame is merged in one round or two, and waits for a blanking.
#[test]
fn the_host_sees_the_rounds_and_that_a_frame_is_merged() {
    let mut sim = running(&vc1(SMALL, 4, 8, 2), 7);
    let [first, merged, shown] = [sim.o.view.first_round, sim.o.is_merged, sim.o.shown];
    let ports = sim.i.processors.clone();
    assert_eq!([first, merged, shown].map(|port| sim.get_u64(port)), [1, 0, 0]);
    // After (16 + 20) 8 clocks a later round begins.
    sim.step_clock(MERGE, 400);
    assert_eq!([first, merged, shown].map(|port| sim.get_u64(port)), [0, 0, 0]);
    let t = sim.testbench();
    let pe = t.on(PE);
    t.run((t.all(ports.iter().map(|i| clear(&pe, *i, 8))),));
    drop(t);
    for done in [1, 0] {
        ports.iter().for_each(|i| sim.set(i.done, done));
        sim.step_clock(PE, 2);
    }
    let mut seen = Vec::new();
    while sim.get_u64(shown) == 0 {
        seen.push(sim.get_u64(merged));
        sim.step_clock(MERGE, 1);
    }
    assert_eq!((seen[0], seen.last()), (0, Some(&1)));
    seen.dedup();
    assert_eq!(seen, [0, 1]);
    assert_eq!([first, merged].map(|port| sim.get_u64(port)), [1, 0]);
}

#[test]
fn frames_follow_each_other_and_nothing_of_one_is_left_in_the_next() {
    let machine = vc1(SMALL, 4, 8, 3);
    let frames = |processor: u64| {
        let frame = |frame: u64| {
            pixels(SMALL, |x, y| (x + y + processor).is_multiple_of(frame + 2).then_some(100 * processor + 16 * y + x))
        };
        vec![frame(0), frame(3), vec![], frame(1)]
    };
    let drawn: Vec<_> = (0..3).map(frames).collect();
    let run = run(&machine, &drawn, 7);
    check(&machine, &drawn, &run);
    assert_eq!(run.overflows, [0; 3]);
    // The assertion about the counters' distances was checked over whole frames.
    let mut sim = run.sim;
    for number in 0..3 {
        assert!(sim.covered(&format!("u_lfb[{number}].u_scan_counter.a whole frame is sent")).unwrap() > 10);
    }
}

/// 8 patches share 2 pages: one processing element overflows in the second frame, and all overflow in the third.
#[test]
fn an_overflow_is_merged_in_a_round_of_its_own() {
    let machine = vc1(SMALL, 4, 2, 3);
    let few = |word: u64| vec![(3, 1, word), (9, 5, word + 1)];
    let many = |word: u64| (0..8).map(|patch| (4 * (patch % 4), 4 * (patch / 4), word + patch)).collect::<Vec<_>>();
    let drawn = [vec![few(9), many(50), many(30)], vec![few(8), few(40), many(28)], vec![few(7), few(60), many(33)]];
    let mut run = run(&machine, &drawn, 7);
    check(&machine, &drawn, &run);
    assert_eq!(run.overflows, [6, 3, 3]);
    let mut covered = |what: &str| {
        (0..3).map(|k| run.sim.covered(&format!("u_swap.u_lfb_swap[{k}].{what}")).unwrap_or(0)).sum::<u64>()
    };
    assert_eq!(covered("a buffer overflows"), 12);
    assert!(covered("a swap waits for the global frame buffer alone") > 0 && covered("a swap waits for T_m alone") > 0);
}

/// The other processing element has swapped in an overflow just before the frame ended. So its swap at the end comes
/// T_m later (VC1-SW4).
#[test]
fn an_overflow_waits_for_more_than_t_m_and_a_refresh_and_no_longer_than_it_may() {
    let display = Display { period: Period::ps(2_000), blanking: Blanking::AtStart };
    let machine = Vc1 { display, ..vc1(SMALL, 4, 2, 2) };
    let (few, many) = (vec![(3, 1, 9)], vec![(0, 0, 5), (4, 0, 6), (8, 0, 7)]);
    let mut sim = running(&machine, 7);
    let ports: Vec<_> = sim.i.processors.iter().copied().zip(sim.o.processors.iter().copied()).collect();
    let state = ports[0].1.state;
    let waited = RefCell::new(vec![0]);
    let t = sim.testbench();
    t.limit(4_000_000);
    let drawn = [[few.clone(), many.clone()], [many, few]];
    let programs = ports.into_iter().zip(drawn).map(|(ports, frames)| program(&t, ports, 8, frames.to_vec()));
    let watches = monitor(async {
        let t = t.on(PE);
        loop {
            t.wait(1).await;
            let mut waited = waited.borrow_mut();
            match t.get_u64(state) == SwapState::Overflow as u64 {
                true => *waited.last_mut().unwrap() += 1,
                false if waited.last() != Some(&0) => waited.push(0),
                false => {}
            }
        }
    });
    let (overflows, ()) = t.run((t.all(programs), watches));
    assert_eq!(overflows, [1, 1]);
    drop(t);
    let LfbSwap { merge_clocks, overflow_clocks, .. } = machine.lfb_swap();
    let refresh = machine.gfb().read_out().refresh_clocks() * 2_000 / PE.period.picoseconds();
    let waited = waited.into_inner();
    assert_eq!(waited.len(), 2);
    assert!(waited[0] > merge_clocks + refresh && waited[0] <= overflow_clocks, "{waited:?}");
}

/// When both have drawn, one processor sends a packet of two words, and the other takes the words late (VC1-SW1).
#[test]
fn a_word_on_the_bus_or_in_a_queue_holds_the_line_low() {
    let machine = vc1(SMALL, 4, 8, 2);
    let mut sim = running(&machine, 7);
    let (patches, ports) = (machine.lfb.patches.count(), sim.i.processors.clone());
    let received = sim.o.processors[1].received;
    let t = sim.testbench();
    let pe = t.on(PE);
    t.run((t.all(ports.iter().map(|i| clear(&pe, *i, patches))),));
    drop(t);
    let [sends, takes] = [ports[0].sends, sim.o.processors[0].received];
    sim.set(takes.ready, 1);
    let line = |sim: &mut Sim, clocks: u64| {
        let mut is_high = false;
        for _ in 0..clocks {
            is_high |= sim.get_u64(sim.o.line) == 1;
            sim.step_clock(PE, 1);
        }
        is_high
    };
    for (word, last) in [(5, 0), (6, 1)] {
        sim.set(sends.word, word);
        sim.set(sends.last, last);
        sim.set(sends.valid, 1);
        sim.step_clock(PE, 1);
        // The bus has taken the word, and carries it when all have drawn.
        sim.set(sends.valid, 0);
        sim.set(ports[0].done, 1);
        sim.set(ports[1].done, 1);
        assert!(!line(&mut sim, 20), "the line is high within a packet, or while a word waits");
        sim.set(received.ready, 1);
        assert_eq!(sim.get_u64(received.word), word);
        sim.step_clock(PE, 1);
        sim.set(received.ready, 0);
    }
    assert_eq!(sim.get_u64(received.valid), 0);
    assert!(line(&mut sim, 2));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_frame_is_the_nearest_of_all(
        processors in 1u32..5,
        edge in prop::sample::select(vec![4u32, 8]),
        pages in 2u32..15,
        within: bool,
        period in 2_000u64..40_000,
        frames in prop::collection::vec(prop::collection::vec((0u32..4, 0u64..18, 0u64..11, 0..EMPTY), 0..30), 1..4),
        seed in any::<u64>(),
    ) {
        let screen = Screen { width: 18, height: 11 };
        let blanking = if within { Blanking::Within } else { Blanking::AtStart };
        let display = Display { period: Period::ps(period / 2 * 2), blanking };
        let machine = Vc1 { display, ..vc1(screen, edge, pages, processors) };
        let of = |processor: u32, pixels: &[(u32, u64, u64, u64)]| {
            let own = pixels.iter().filter(|(number, ..)| number % processors == processor);
            own.map(|&(_, x, y, word)| (x, y, word)).collect::<Vec<Pixel>>()
        };
        let drawn: Vec<Vec<_>> =
            (0..processors).map(|k| frames.iter().map(|pixels| of(k, pixels)).collect()).collect();
        let run = run(&machine, &drawn, seed);
        check(&machine, &drawn, &run);
    }
}
