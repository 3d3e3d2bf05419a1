//! Signals of another clock: the start of a synchronizer, and its attributes in Verilog.

use tilewright_gen::{testbench, tools, verilog};
use tilewright_hdl::*;
use tilewright_sim::Simulation;

const LINE: Clock = Clock::new("line", Period::ns(7));

block! {
    /// Counts the start bits of a serial line that idles at `idle`.
    struct Receiver { idle: bool }
    in ReceiverIn { rx: bit().on(LINE) }
    out ReceiverOut { line: _, starts: _ }
}

impl Receiver {
    fn build(&self, m: Module, i: ReceiverIn) -> ReceiverOut {
        let rx = m.on(LINE).pipe("rx_out", i.rx);
        let line = match self.idle {
            true => m.synchronize_from(true, "line", rx),
            false => m.synchronize("line", rx),
        };
        let before = m.reg("before", 1).reset(self.idle);
        before.next(line);
        let starts = m.reg("starts", 4).reset(0).enable(line.ne(u8::from(self.idle)) & before.eq(self.idle));
        starts.next(starts + 1);
        ReceiverOut { line, starts: *starts }
    }
}

/// The design's replay, and the number of start bits seen: the line idles, then falls once.
fn run(receiver: &Receiver) -> (Recording, u64) {
    let mut sim = Simulation::of(receiver).unwrap();
    let recorder = sim.recording();
    sim.set(sim.i.rx, receiver.idle);
    sim.reset();
    sim.run(20);
    assert_eq!(sim.get_u64(sim.o.starts), 0, "the line idles, yet something started");
    sim.set(sim.i.rx, !receiver.idle);
    sim.run(20);
    (recorder.take(), sim.get_u64(sim.o.starts))
}

#[test]
fn a_line_that_idles_high_starts_nothing_after_a_reset() {
    for idle in [false, true] {
        let receiver = Receiver { idle };
        let design = elaborate(&receiver).unwrap();
        let (recording, starts) = run(&receiver);
        assert_eq!(starts, 1);
        let (files, bench) = (verilog(&design), testbench(&design, &recording));
        let _ = tools::replay_in_icarus(&files, &bench).unwrap();
        tools::lint(&files).unwrap();
    }
}

#[test]
fn both_registers_of_a_synchronizer_are_marked() {
    let design = elaborate(&Receiver { idle: true }).unwrap();
    let marked: Vec<_> = design.top().registers.iter().filter(|register| register.is_synchronizer).collect();
    let names: Vec<_> = marked.iter().map(|register| design.top().register_name(register)).collect();
    assert_eq!(names, ["line_meta", "line"]);
    let text = &verilog(&design)[0].text;
    let lines: Vec<_> = text.lines().filter(|line| line.contains("ASYNC_REG")).map(str::trim).collect();
    assert_eq!(lines.len(), 2, "{text}");
    assert!(lines[0].starts_with("(* ASYNC_REG = \"TRUE\" *) output reg  ") && lines[0].contains("line"), "{text}");
    assert!(lines[1].starts_with("(* ASYNC_REG = \"TRUE\" *) reg line_meta;"), "{text}");
}
