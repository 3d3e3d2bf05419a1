//! Chapter 12: a waveform of a part of a run, and what went before a failure.

#[cfg(test)]
mod tests {
    use crate::uart::echo::Echo;
    use crate::uart::far_end;
    use crate::uart::proved::{QueueIn, QueueKeeps, QueueKeepsIn};
    use crate::uart::queue::Received;
    use std::fs;
    use tilewright_sim::{EngineKind, Simulation, Vcd};

    #[test]
    fn a_waveform_of_one_unit_and_one_moment() -> Result<(), tilewright_sim::Error> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("echo.vcd");
        let mut sim = Simulation::of(&Echo { clocks_per_bit: 16, depth: 4 })?;
        sim.set(sim.i.rx, 1);
        let vcd = Vcd::to(&file).only("rx").only("u_receiver.*").only("u_queue.**").cycles("clk", 100..180);
        sim.trace(vcd.words("u_queue.words", 0..4))?;
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        t.run((far_end::sends(t, i.rx, b'T', 16), far_end::receives(t, o.tx, 16)));
        sim.finish()?;

        let waveform = fs::read_to_string(&file).unwrap();
        assert!(waveform.contains(" words[3] ") && !waveform.contains(" words[4] "));
        assert!(waveform.contains(" overrun ") && !waveform.contains(" u_sender "));
        Ok(())
    }

    #[test]
    fn what_went_before_a_failure() -> Result<(), tilewright_sim::Error> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("failure.vcd");
        let mut sim = Simulation::of(&QueueKeeps { depth: 4 })?;
        sim.trace(Vcd::to(&file).last(20))?;
        for data in 0..3 {
            let of = QueueIn { push: 1, byte_in: Received { data, broken: 0 }, pop: 0 };
            sim.drive(QueueKeepsIn { of, pick: u64::from(data == 1) });
            sim.step();
        }
        assert!(!file.exists());

        // Somebody changes the picked byte behind the queue's back.
        sim.poke_memory("u_queue.bytes", 1, 0x1ff)?;
        let of = QueueIn { push: 0, byte_in: Received { data: 0, broken: 0 }, pop: 1 };
        sim.drive(QueueKeepsIn { of, pick: 0 });
        let error = sim.try_run(10).unwrap_err().to_string();
        assert!(
            error.starts_with("assertion failed in `queue_keeps_depth4` in cycle 4 of `clk`, at 50000 ps"),
            "{error}"
        );
        assert!(file.exists());
        Ok(())
    }

    #[test]
    fn back_to_where_it_was() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Echo { clocks_per_bit: 16, depth: 4 })?;
        sim.remember(64 << 20); // bytes
        sim.set(sim.i.rx, 1);
        let (i, o) = (sim.i, sim.o);
        let t = &sim.testbench();
        t.run((far_end::sends(t, i.rx, b'T', 16), far_end::receives(t, o.tx, 16)));

        // The echo is over. When was its line low for the last time?
        let time = sim.run_until_back(sim.o.tx.is(0))?;
        assert_eq!(time, Some(3_010_000));

        let low = sim.checkpoint();
        sim.step();
        let changed = sim.checkpoint().differences(&low);
        assert_eq!(changed[0].to_string(), "`u_sender.u_transmitter.line`: 1'h1, and 1'h0");
        assert_eq!(changed[1].to_string(), "`u_sender.u_transmitter.u_ticks.clock`: 4'h1, and 4'h0");

        let from = &sim.why(sim.o.tx)?.causes[0];
        assert_eq!(from.label(), "u_sender.u_transmitter.phase");
        assert_eq!((from.number().as_str(), from.cycle), ("Stop", 301)); // since this cycle
        Ok(())
    }

    #[test]
    fn two_engines_side_by_side() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Echo { clocks_per_bit: 16, depth: 4 })?.on(EngineKind::Both);
        sim.run(100); // ends with `Error::Differs` at the first signal in which they are not alike
        Ok(())
    }
}
