//! Records go through all blocks, with their signs and codes.

use tilewright_blocks::*;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

codes! { enum Shade { Flat, Gouraud, Phong } }

bundle! {
    struct Span<T> { x: T, step: T, shade: T }
    struct SpanIn<T> { spans: Stream<Span<T>, T> }
    struct SpanOut<T> { moved: Stream<Span<T>, T>, steps: Stream<T, T>, ends: Stream<(), T> }
}

/// Through a queue, a fork and slices; what comes out is moved by its step, which has a sign.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Spans;

impl Block for Spans {
    type In = SpanIn;
    type Out = SpanOut;

    fn inputs(&self) -> SpanIn<Width> {
        SpanIn { spans: stream(Span { x: bits(8).signed(), step: bits(8).signed(), shade: one_of::<Shade>() }) }
    }

    fn build(&self, m: Module, i: SpanIn) -> SpanOut {
        let spans = m.fifo("u_fifo", 3, i.spans);
        let [first, second, third] = m.fork("u_fork", spans);
        let moved = first.with(Span { x: first.x + first.step, ..*first });
        let moved = m.slice("u_slice", Slice::Both, moved);
        let steps = m.block_ram_fifo("u_steps", 2, second.with(second.step));
        let ends = m.slice("u_ends", Slice::Forward, third.with(()));
        m.assert(!moved.shade.is(Shade::Phong), "none is of that kind");
        SpanOut { moved, steps, ends }
    }
}

#[test]
fn records_go_through() {
    let mut sim = Simulation::of(&Spans).unwrap();
    sim.reset();
    for ready in [sim.o.moved.ready, sim.o.steps.ready, sim.o.ends.ready] {
        sim.set(ready, 1);
    }
    let (mut moved, mut steps, mut ends) = (Vec::new(), Vec::new(), 0);
    for clock in 0..12i64 {
        sim.set(sim.i.spans.valid, clock < 5);
        sim.set(sim.i.spans.x, clock);
        sim.set(sim.i.spans.step, -clock - 1);
        sim.set(sim.i.spans.shade, clock % 2);
        if sim.get_u64(sim.o.moved.valid) == 1 {
            moved.push((sim.get_u64(sim.o.moved.x), sim.get_u64(sim.o.moved.shade)));
        }
        if sim.get_u64(sim.o.steps.valid) == 1 {
            steps.push(sim.get_u64(sim.o.steps.payload));
        }
        ends += sim.get_u64(sim.o.ends.valid);
        sim.step();
    }
    assert_eq!(moved, [(255, 0), (255, 1), (255, 0), (255, 1), (255, 0)]);
    assert_eq!(steps, [255, 254, 253, 252, 251]);
    assert_eq!(ends, 5);
}
