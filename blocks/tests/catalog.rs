//! The scenarios of the catalogue, played in the simulator.

use std::ops::ControlFlow;

use tilewright_blocks::catalog::ENTRIES;
use tilewright_hdl::Design;
use tilewright_hdl::catalog::Entry;
use tilewright_sim::Simulation;

fn find(name: &str) -> &'static Entry {
    ENTRIES.iter().find(|entry| entry.name == name).unwrap()
}

/// The designs with the least, the default and large parameters.
fn designs(entry: &Entry) -> Vec<(Vec<(&'static str, u64)>, Design)> {
    let set = |of: fn(&tilewright_hdl::catalog::Parameter) -> u64| -> Vec<_> {
        entry.parameters.iter().map(|parameter| (parameter.name, of(parameter))).collect()
    };
    let sets = [set(|it| it.min), set(|it| it.default), set(|it| it.max.min(16))];
    sets.into_iter().map(|set| (set.clone(), entry.design(&entry.values(set).unwrap()).unwrap())).collect()
}

#[test]
fn every_scenario_plays_and_changes_no_input_at_an_edge() {
    for entry in ENTRIES {
        for (set, design) in designs(entry) {
            let scenario = entry.scenario(&entry.values(set.iter().copied()).unwrap()).unwrap();
            let mut sim = Simulation::from_design(&design).unwrap();
            sim.reset();
            let start = sim.time();
            for clock in &design.top().clocks {
                let period = clock.period.unwrap().picoseconds();
                let at_edge = scenario.events.iter().find(|event| (start + event.at_ps).is_multiple_of(period));
                assert!(at_edge.is_none(), "{} {set:?}: {at_edge:?}", entry.name);
            }
            Simulation::from_design(&design).unwrap().play(&scenario).unwrap();
        }
    }
}

#[test]
fn every_block_says_what_it_is_and_its_latency_in_clocks() {
    for entry in ENTRIES {
        for (_, design) in designs(entry) {
            let about = &design.top().about;
            let is_counted = design.latencies().last().is_some_and(Option::is_some);
            assert!(is_counted || about.latency.contains("clock"), "{}: {:?}", entry.name, about.latency);
            assert!(
                about.summary.ends_with('.') && !about.summary.contains(['[', ']']),
                "{}: {}",
                entry.name,
                about.summary
            );
        }
    }
}

/// The words that pass on a stream in an entry's scenario, including repetitions.
fn words(name: &str, stream: &str) -> Vec<u64> {
    fields(name, stream, "payload")
}

/// A field of the records that pass on a stream in an entry's scenario.
fn fields(name: &str, stream: &str, field: &str) -> Vec<u64> {
    let entry = find(name);
    let values = entry.values([]).unwrap();
    let scenario = entry.scenario(&values).unwrap();
    let mut sim = Simulation::from_design(&entry.design(&values).unwrap()).unwrap();
    let mut words = Vec::new();
    let ended = sim.play_watched(&scenario, 1000, |sim, played| {
        // Inputs change a quarter of a period after an edge; this is shortly before the next.
        let is_before_an_edge = (played * scenario.end_ps as f64).round() as u64 % 10_000 == 9_500;
        let goes = ["valid", "ready"].map(|end| sim.peek(&format!("{stream}_{end}")).unwrap().bit(0));
        if is_before_an_edge && goes == [true, true] {
            words.push(sim.peek(&format!("{stream}_{field}")).unwrap().to_u64().unwrap());
        }
        ControlFlow::Continue(())
    });
    assert!(ended.unwrap().is_continue());
    words
}

#[test]
fn the_scenarios_show_what_they_say() {
    for fifo in ["fifo", "block-ram-fifo"] {
        assert_eq!((words(fifo, "into"), words(fifo, "out")), (vec![1, 2, 3, 4], vec![1, 2, 3, 4]), "{fifo}");
    }
    assert_eq!((words("lifo", "into"), words("lifo", "out")), (vec![1, 2, 3, 4, 5], vec![1, 4, 5, 3, 2]));
    for slice in ["forward-slice", "backward-slice", "skid-buffer"] {
        assert_eq!(words(slice, "into"), words(slice, "out"), "{slice}");
        assert_eq!(words(slice, "out").last(), Some(&5), "{slice}");
    }
    assert_eq!([words("fork", "out_0"), words("fork", "out_1")], [[1, 2]; 2]);
    assert_eq!((words("join", "left"), words("join", "right")), (vec![1, 2, 3], vec![5, 6, 7]));
    assert_eq!(words("join", "out"), [0x15, 0x26, 0x37]);
    assert_eq!(["out_0", "out_1", "out_2"].map(|out| words("split", out)), [vec![1, 9], vec![2], vec![3]]);
    assert_eq!(words("round-robin-arbiter", "out"), [0, 1, 2, 0, 1, 2, 0]);
    assert_eq!(words("priority-arbiter", "out"), [0; 7]);
    assert_eq!(words("narrow", "out"), [7, 0, 0, 9, 0, 0]);
    assert_eq!(words("widen", "out"), [0x321, 0x999]);
    assert_eq!(words("spi-master", "received"), [9, 6, 5]);
    assert_eq!(words("sdram-controller", "words"), [0x1201, 0x1a00]);
    assert_eq!(fields("spi-flash-reader", "bytes", "byte"), [0xff, 0, 0xff]);
    assert_eq!(fields("spi-flash-reader", "bytes", "last"), [0, 1, 1]);
    assert_eq!(fields("i2c-master", "answers", "result"), [0; 4]);
    assert_eq!(fields("i2c-master", "answers", "byte")[2], 0x3c);
}

/// The values of an output of a block with one clock in an entry's scenario, just before each edge, without repetitions.
fn values(name: &str, output: &str) -> Vec<u64> {
    let entry = find(name);
    let values = entry.values([]).unwrap();
    let scenario = entry.scenario(&values).unwrap();
    let mut sim = Simulation::from_design(&entry.design(&values).unwrap()).unwrap();
    let mut seen = Vec::new();
    let ended = sim.play_watched(&scenario, 1000, |sim, _| {
        let port = sim.port(output).unwrap();
        seen.push(sim.get_u64(port));
        ControlFlow::Continue(())
    });
    assert!(ended.unwrap().is_continue());
    seen.dedup();
    seen
}

#[test]
fn the_scenarios_of_blocks_without_streams_show_what_they_say() {
    assert_eq!(values("crc", "crc")[9], !0xcbf4_3926 & 0xffff_ffff);
    assert_eq!(values("crc", "crc").last(), Some(&0xffff_ffff));
    assert_eq!(values("decoder", "one_hot"), [1, 2, 4, 8, 16]);
    assert_eq!(values("encoder", "index"), [0, 1, 2, 3, 4, 0]);
    assert_eq!(values("priority-encoder", "first"), [0, 16, 8, 4, 2, 1]);
    assert_eq!(values("priority-encoder", "index"), [0, 4, 3, 2, 1, 0]);
    assert_eq!(values("count-ones", "ones"), [0, 1, 2, 3, 4, 5]);
    assert_eq!(values("quantizer", "rounded"), [0, 2, 0, 14, 2, 7, 8]);
    assert_eq!(values("from-decimal", "number"), [0, 456, 999, 1]);
    assert_eq!(values("seven-segment", "segments")[..3], [0x3f, 0x06, 0x5b]);
    assert_eq!(values("up-down-counter", "count"), [0, 4, 3, 4, 0, 1, 2, 0]);
    assert_eq!(values("rotator", "rotated"), [0, 13, 26, 52, 104, 208, 161, 67, 134]);
    assert_eq!(values("multiply-accumulate", "sum")[..7], [0, 10, 30, 60, 150, 100, 300]);
    assert_eq!(values("minimum", "index"), [0, 4, 0]);
    assert_eq!(values("pipelined-minimum", "index"), [0, 4, 0]);
    assert_eq!(values("box-filter", "sums"), [0, 0x0000_0101_0000_0101, 0x0002_0202_0002_0202, 0x0406_0604_0406_0604]);
    assert_eq!(values("quadrature", "position"), [0, 1, 2, 3, 2, 1, 0, 15, 14]);
    assert_eq!(values("debouncer", "level"), [0, 1, 0]);
    assert_eq!(values("debouncer", "falls"), [0, 1, 0]);
    assert_eq!(values("video-timing", "y"), [0, 1, 2, 3, 4, 0]);
    assert_eq!(values("video-timing", "hsync"), [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1]);
    assert_eq!(values("video-timing", "vsync"), [1, 0, 1]);
    assert_eq!(values("tmds-encoder", "symbol")[4..6], [0x100, 0x3ff]);
    assert_eq!(values("to-axi-stream", "m_axis_tkeep"), [0, 1, 3, 1]);
    assert_eq!(values("from-axi-stream", "bytes_byte"), [0, 0x61, 0x62, 0x63, 0x64]);
    assert_eq!(values("axi-lite-registers", "registers_0"), [0, 0x1234_5678, 0x12bb_cc78]);
    assert_eq!(values("axi-lite-registers", "s_axi_rdata"), [0, 0x1234_5678, 0xbeef, 0, 0x12bb_cc78, 0]);
    assert_eq!(values("spi-master", "cs_n"), [1, 0, 1, 0, 1]);
    assert_eq!(values("sdram-controller", "dq_enable"), [0, 1, 0]);
    assert_eq!(values("sdram-controller", "pins_dqm"), [3, 0]);
    assert_eq!(values("spi-flash-reader", "cs_n"), [1, 0, 1, 0, 1]);
    assert_eq!(values("i2c-master", "busy"), [0, 1, 0]);
    assert_eq!(values("power-on-reset", "reset"), [1, 0, 1, 0]);
    assert_eq!(values("reset-synchronizer", "reset"), [1, 0]);
    assert_eq!(values("multiplier", "product"), [0, 15, 225, 63, 0]);
    assert_eq!(values("ram", "word"), [0, 0x22, 0x11, 0xaa, 0x33]);
    assert_eq!(values("vector-registers", "right_value"), [0, 7]);
    assert_eq!(values("shifter", "shifted"), [0, 9, 18, 36, 72, 9, 4, 2, 1, 9, 4, 2, 1, 0]);
}

#[test]
fn a_depth_that_gray_code_has_not() {
    let entry = find("dual-clock-fifo");
    let error = entry.design(&entry.values([("depth", 6)]).unwrap()).unwrap_err().to_string();
    assert_eq!(error, "depth = 6 is no power of two: set 8, or 4");
}
