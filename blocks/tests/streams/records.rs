//! Records go through all blocks, with their signs and codes.

use tilewright_blocks::*;
use tilewright_hdl::*;
use tilewright_sim::{Pauses, Simulation};

codes! { enum Shade { Flat, Gouraud, Phong } }

bundle! {
    struct Span<T> { x: T, step: T, shade: T }
    struct SpanIn<T> { spans: Stream<Span<T>, T> }
    struct SpanOut<T> { moved: Stream<Span<T>, T>, steps: Stream<T, T>, ends: Stream<(), T> }
}

/// Passes records through a queue, a fork and slices. One output is moved by its step, which is signed.
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
        m.assert(!moved.shade.is(Shade::Phong), "no span has Phong shading");
        SpanOut { moved, steps, ends }
    }
}

#[test]
fn records_go_through() {
    let mut sim = Simulation::of(&Spans).unwrap();
    sim.reset();
    let (spans, moved, steps, ends) = (sim.i.spans, sim.o.moved, sim.o.steps, sim.o.ends);
    let t = sim.testbench();
    // A signed number goes in and out as its 8 bits.
    let span = |x: u64| Span { x, step: 255 - x, shade: x % 2 };
    let ((), (), (), ends) = t.run((
        t.send_all(spans, (0..5).map(span), Pauses::percent(20, 1)),
        t.expect_all(moved, (0..5).map(|x| Span { x: 255, ..span(x) }), Pauses::percent(40, 2)),
        t.expect_all(steps, [255, 254, 253, 252, 251], Pauses::percent(60, 3)),
        t.receive_all(ends, 5, Pauses::NONE),
    ));
    assert_eq!(ends, [(); 5]);
}

/// A field that goes on to a port alone is named by that port.
#[test]
fn fields_that_are_computed_with_keep_their_names() {
    let design = elaborate(&Spans).unwrap();
    let names = design.top().nodes.iter().filter_map(|node| node.name.as_deref());
    let names: Vec<&str> = names.filter(|name| name.contains("_out_")).collect();
    assert_eq!(names, ["u_fork_out_0_x", "u_fork_out_0_step", "u_slice_out_shade"]);
}

#[test]
fn no_field_takes_the_name_of_its_streams_handshake() {
    record! { struct Job { valid: bit(), page: bits(4) } }
    let example = tilewright_sim::traced(|m| {
        let (jobs, _) = m.offer(lit(1, 1), Job { valid: lit(1, 1), page: lit(4, 9) });
        let job = m.fifo("u_queue", 2, jobs).take_when(1);
        m.assert(job.taken.implies(job.valid & job.page.eq(9)), "the job that is sent arrives");
    });
    let pages: [u64; 4] = example.values("u_queue_out_page");
    assert_eq!(pages[2..], [9, 9]);
}
