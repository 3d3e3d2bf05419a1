use std::sync::Arc;

use super::*;
use crate::vc1::assignment::{Assignment, Polygon};
use crate::vc1::cost::CostTable;
use crate::vc1::job::View;
use tilewright_scenes::{Counts, Projection, ScreenVertex, Size, set_up};

const COSTS: CostTable =
    CostTable { vertex: 1, polygon: 2, area: 0, clip: 0, set_up: 0, row: 0, pixel: 2, clear: 1, send: 1, receive: 1 };

fn vertices() -> [ScreenVertex; 3] {
    let at = |x, y| ScreenVertex { x, y, z: 1, rgb: [0; 3] };
    [at(0, 0), at(30, 0), at(0, 100)]
}

/// A processing element of two that has the command of a frame in its queue: a row of two pixels, then polygons without packets.
fn processor(costs: CostTable, patches: u32, polygons: u32, apr: Option<u32>) -> Processor {
    let size = Size::new(4, 1).expect("in range");
    let packet = set_up(&vertices(), size).expect("covers pixels");
    let own = |number| Polygon { number, packets: number.min(1) as usize..1, vertices: 1, clipped: 0 };
    let views = Views::default();
    let assignment = Assignment { polygons: vec![(0..polygons).map(own).collect(), Vec::new()], loads: vec![0; 2] };
    let (triangles, vertices) = (vec![packet], vec![vertices()]);
    let projection = Projection { size, triangles, vertices, corners: Vec::new(), counts: Counts::default() };
    let view = View { assignment, projection: Arc::new(projection) };
    assert_eq!(view.polygons(0).len(), polygons as usize);
    views.insert(0, Arc::new(view));
    Processor::new(Settings { number: 0, processors: 2, size, patches, costs, apr }, views)
}

/// Runs it for so many clocks: `say` has what the swap control says from a clock on, `busy` the clocks in which the local frame buffer
/// takes nothing, and `sends` those in which the bus takes a word. The queue has these words. Gives a letter a clock.
fn run(
    processor: &mut Processor,
    clocks: u32,
    queue: &mut Vec<Word>,
    say: impl Fn(u32) -> SwapState,
    [busy, sends]: [&dyn Fn(u32) -> bool; 2],
) -> String {
    let mut wave = String::new();
    for clock in 0..clocks {
        let (access, offered, receives) = (processor.access(), processor.offered(), processor.receives());
        let taken = access.is_some() && !busy(clock);
        let (before, frames) = (processor.tally.clocks, processor.frames.len());
        let sent = offered.is_some() && sends(clock);
        if receives && processor.front.is_some() {
            queue.remove(0);
        }
        let done = processor.done();
        processor.edge(Edge { taken, sent, may: say(clock), front: queue.first().copied() });
        let is_over = processor.frames.len() > frames;
        let class = before.all().iter().zip(processor.tally.clocks.all()).position(|(before, after)| *before != after);
        wave.push(match (access, done) {
            (Some(Access::Clear(patch)), _) => char::from(b'0' + patch as u8),
            (Some(Access::Draw(_)), _) if taken => 'd',
            (Some(Access::Draw(_)), _) => 'w',
            _ if is_over => '|',
            (_, true) => 'D',
            _ => class.map_or('?', |class| char::from(b"cgrsRtbo y"[class])),
        });
    }
    wave
}

fn command() -> Vec<Word> {
    Message::Command { frame: 0 }.words()
}

/// The local frame buffer is busy for two clocks at the second pixel.
#[test]
fn it_computes_waits_for_its_local_frame_buffer_and_ends() {
    let mut it = processor(COSTS, 1, 2, None);
    let mut queue = command();
    let wave = run(&mut it, 38, &mut queue, |_| SwapState::Draw, [&|clock| [27, 28].contains(&clock), &|_| true]);
    // It is cleared, sees the command and receives it; geometry; pixels; geometry.
    assert_eq!(wave, "0RRRRRRRRRRRRRRRRRRRRgggrdrwwdgggDDDDD");
    assert_eq!((it.tally.pixels, it.tally.clocks.stalled), (2, 2));
    assert_eq!(it.tally.clocks.total(), 38);
}

/// The first pixel finds no page: it waits where it is, clears its table of two entries, and goes on.
#[test]
fn it_waits_clears_and_goes_on_after_an_overflow() {
    let costs = CostTable { vertex: 0, polygon: 1, pixel: 3, clear: 2, ..COSTS };
    let mut it = processor(costs, 2, 1, None);
    let mut queue = command();
    let say = |clock| match clock {
        0..3 | 36..40 => SwapState::Clear,
        31..36 => SwapState::Overflow,
        _ => SwapState::Draw,
    };
    let wave = run(&mut it, 46, &mut queue, say, [&|_| false, &|_| true]);
    assert_eq!(wave, "c0c1RRRRRRRRRRRRRRRRRRRRgrrdrrdDoooooc0c1DDDDD");
    assert_eq!((it.tally.overflows, it.tally.clocks.overflow, it.tally.pixels), (1, 5, 2));
}

/// Its packet goes to all, and another one's comes while the bus does not take its second word.
#[test]
fn it_draws_what_comes_while_it_waits_for_the_bus() {
    let mut it = processor(COSTS, 1, 1, Some(0));
    let mut queue = command();
    queue.extend(Message::Polygon { sender: 1, vertices: vertices() }.words());
    // What it has sent comes back to it as the last packet.
    let own = Message::Polygon { sender: 0, vertices: vertices() }.words();
    let sends = |clock: u32| clock > 60;
    run(&mut it, 60, &mut queue, |_| SwapState::Draw, [&|_| false, &sends]);
    assert_eq!((it.tally.pixels, queue.len(), it.tally.broadcast), (2, 0, 0), "row 0 of the other one's packet");
    assert!(it.tally.clocks.bus > 0 && !it.done());
    queue.extend(&own[..1]);
    run(&mut it, 1, &mut queue, |_| SwapState::Draw, [&|_| false, &|_| false]);
    assert!(!it.receives(), "it does not begin to receive the packet that it is sending");
    run(&mut it, 30, &mut queue, |_| SwapState::Draw, [&|_| false, &|_| true]);
    assert_eq!((it.tally.broadcast, it.unseen), (1, 1));
    assert!(!it.done(), "a packet has begun to come");
    queue.extend(&own[1..]);
    run(&mut it, 40, &mut queue, |_| SwapState::Draw, [&|_| false, &|_| true]);
    assert_eq!((it.tally.pixels, it.unseen, it.done()), (4, 0, true));
}

/// After its swap a frame is over, and its clocks are those of the frame.
#[test]
fn a_frame_ends_with_its_swap() {
    let mut it = processor(COSTS, 1, 0, None);
    let mut queue = command();
    let say = |clock| match clock {
        30..34 => SwapState::Due,
        34.. => SwapState::Clear,
        _ => SwapState::Draw,
    };
    let wave = run(&mut it, 40, &mut queue, say, [&|_| false, &|_| true]);
    assert!(it.frames().len() == 1 && wave.ends_with("DDyyy|0    "), "{wave}");
    let clocks = it.frames()[0].clocks;
    assert_eq!((clocks.total(), clocks.swap, clocks.clearing, clocks.receiving), (35, 4, 1, 20));
}
