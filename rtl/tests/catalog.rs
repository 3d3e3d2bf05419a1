//! The scenarios of the catalogue, played in the simulator.

use std::ops::ControlFlow;

use tilewright_rtl::catalog::{ENTRIES, Entry, find};
use tilewright_sim::Simulation;

/// A step shorter than any clock's period, in picoseconds.
const STEP: u64 = 5000;

/// Plays an entry's scenario; returns the successive values of a signal.
fn play(entry: &Entry, set: &[(&str, u64)], signal: Option<&str>) -> Vec<u64> {
    let values = entry.values(set.iter().copied()).unwrap();
    let scenario = entry.scenario(&values).unwrap();
    let mut sim = Simulation::from_design(&entry.design(&values).unwrap()).unwrap();
    let mut seen = Vec::new();
    let ended = sim.play_watched(&scenario, STEP, |sim, _| {
        seen.extend(signal.map(|name| sim.peek(name).unwrap().to_u64().unwrap()));
        ControlFlow::Continue(())
    });
    assert!(ended.unwrap().is_continue());
    seen.dedup();
    seen
}

#[test]
fn no_input_changes_at_an_edge() {
    for entry in ENTRIES {
        let values = entry.values([]).unwrap();
        let (design, scenario) = (entry.design(&values).unwrap(), entry.scenario(&values).unwrap());
        let mut sim = Simulation::from_design(&design).unwrap();
        sim.reset();
        let start = sim.time();
        for clock in &design.top().clocks {
            let period = clock.period.unwrap().picoseconds();
            let at_edge = scenario.events.iter().find(|event| (start + event.at_ps).is_multiple_of(period));
            assert!(at_edge.is_none(), "{}: {at_edge:?}", entry.name);
        }
    }
}

#[test]
fn every_module_states_its_latency_in_clocks() {
    for entry in ENTRIES {
        let design = entry.design(&entry.values([]).unwrap()).unwrap();
        for (module, counted) in design.modules().iter().zip(design.latencies()) {
            let stated = &module.about.latency;
            assert!(counted.is_some() || stated.contains("clock"), "{}: {stated:?}", module.name);
        }
    }
}

#[test]
fn every_scenario_plays_without_a_violation() {
    for entry in ENTRIES {
        play(entry, &[], None);
    }
}

#[test]
fn the_local_frame_buffer_shows_what_its_scenarios_say() {
    const EMPTY: u64 = (1 << 48) - 1;
    let shown = |name, set: &[_], signal| play(find(name).unwrap(), set, Some(signal));
    assert_eq!(shown("page-id-generator", &[], "used"), [0, 1, 2, 0, 1]);
    assert_eq!(shown("patch-table", &[], "scan_entry_resident"), [0, 1, 0]);
    assert_eq!(shown("image-memory", &[], "sent"), [EMPTY, 60, EMPTY]);
    assert_eq!(shown("scan-counter", &[("position", 2)], "armed"), [0, 1]);
    for patch in [4, 8, 16] {
        let set = [("width", 40), ("height", 24), ("patch", patch), ("pages", 2)];
        assert_eq!(shown("lfb-unit", &set, "word"), [EMPTY, 70, 50, EMPTY, 40, EMPTY], "patches of {patch}");
    }
    assert_eq!(shown("lfb-unit", &[("width", 640), ("height", 480), ("pages", 4096)], "pages_used"), [0, 1, 2, 0, 1]);
}

#[test]
fn the_bus_and_the_sums_show_what_their_scenarios_say() {
    let shown = |name, set: &[_], signal| play(find(name).unwrap(), set, Some(signal));
    for processors in [2, 3, 16, 256] {
        let set = [("processors", processors)];
        assert_eq!(shown("broadcast-bus", &set, "word_word"), [0, 0xa0, 0xa1, 0xc0]);
        // It is not idle while the sender pauses within its packet.
        assert_eq!(shown("broadcast-bus", &set, "idle"), [1, 0, 1]);
        assert_eq!(shown("broadcast-bus", &set, "empty[0]"), [1, 0, 1]);
        assert_eq!(shown("broadcast-bus", &set, "empty[1]"), [1, 0, 1, 0, 1, 0, 1]);
    }
    assert_eq!(shown("broadcast-bus", &[("processors", 1), ("queue", 2), ("clocks", 1)], "empty[0]"), [1, 0, 1]);
    for (width, height) in [(16, 8), (9, 5), (2, 2)] {
        let set = [("width", width), ("height", height)];
        // The average of two colours that were black before; in the meantime, half of the first.
        assert_eq!(shown("accumulation", &set, "colour"), [0, 0x081018, 0x203040]);
    }
}

#[test]
fn the_global_frame_buffer_shows_what_its_scenario_says() {
    for set in [&[][..], &[("width", 40), ("height", 24), ("units", 16)]] {
        let shown = play(find("gfb-unit").unwrap(), set, Some("view_read_word"));
        // The host writes the third pixel of each frame.
        assert_eq!(shown, [0, 21, 63, 21, 42, 63, 42]);
        // Two passes, in each of which the host has changed a pixel, and their average.
        let mut shown = play(find("accumulating-gfb-unit").unwrap(), set, Some("pixel_rgb"));
        // There is nothing in the blanking.
        shown.retain(|rgb| *rgb != 0);
        shown.dedup();
        assert!(shown.starts_with(&[21, 63, 21, 42, 63, 42]) && shown.ends_with(&[32, 63, 32]), "{shown:?}");
    }
    assert_eq!(play(find("multipass-control").unwrap(), &[], Some("averages")), [0, 1, 0, 1]);
}

#[test]
fn the_machine_shows_what_its_scenario_says() {
    const BLANK: u64 = 0xffffff_102030;
    for set in [&[][..], &[("processors", 16), ("patch", 8), ("width", 40), ("height", 20), ("accumulation", 1)]] {
        let nearest =
            40 - set.iter().find(|(name, _)| *name == "processors").map_or(1, |(_, processors)| processors - 1);
        assert_eq!(play(find("vc1").unwrap(), set, Some("view_read_word")), [0, 20, BLANK, nearest]);
    }
}

#[test]
fn the_renderer_and_its_parts_show_what_their_scenarios_say() {
    let shown = |name, set: &[_], signal| play(find(name).unwrap(), set, Some(signal));
    assert_eq!(shown("pixel-processor", &[], "flag"), [0, 1]);
    // At column 3 of line 0 the value is 3, and right behind it -2.
    assert_eq!(shown("linear-tree", &[], "value[0][3]")[..4], [0, 1, 0, 1]);
    // The value is 9, and right behind it -2.
    assert_eq!(shown("quadratic-tree", &[], "value[0][3]")[..6], [0, 1, 0, 1, 0, 1]);
    for side in [8, 16] {
        for (queue, region) in [(16, 3), (1, 3)] {
            assert_eq!(shown("renderer", &[("side", side), ("queue", queue)], "planes_region"), [0, region]);
        }
        assert_eq!(shown("renderer", &[("side", side)], "store_free")[..2], [1, 0]);
    }
    for side in [2, 4, 8] {
        for (queue, region) in [(16, 3), (1, 3)] {
            assert_eq!(shown("quadratic-renderer", &[("side", side), ("queue", queue)], "planes_region"), [0, region]);
        }
    }
    // Two curves for the silhouette and the depth, and two for the colours that have one.
    assert_eq!(shown("quadratic-renderer", &[], "u_controller.curve_waits"), [0, 1, 0, 1, 0, 1, 0, 1, 0]);
    assert_eq!(shown("image-generation-controller", &[("quadratic", 1)], "curve_0_d"), [0]);
    assert_eq!(shown("pixel-planes-5", &[("quadratic", 1)], "plane_goes")[..3], [0, 1, 0]);
    assert_eq!(shown("backing-store", &[], "free"), [1, 0, 1]);
    assert_eq!(shown("region-allocator", &[], "region"), [0, 100, 101, 102, 103, 200, 0]);
    assert_eq!(shown("frame-buffer", &[], "words[0]"), [0, 0x1234, 0x8000_0000_0001]);
}

#[test]
fn the_node_and_its_parts_show_what_their_scenarios_say() {
    let shown = |name, set: &[_], signal| play(find(name).unwrap(), set, Some(signal));
    for (width, height) in [(8, 4), (4, 8), (2, 2)] {
        let set = [("line", width), ("lines", height)];
        assert_eq!(shown("pixelflow-node", &set, "network_0_downstream_valid"), [0, 1, 0]);
        assert_eq!(shown("pixelflow-node", &set, "held"), [0, 1, 0]);
    }
    for nodes in [2, 3, 5] {
        assert_eq!(shown("pixelflow", &[("nodes", nodes)], "off_0_valid"), [0, 1, 0]);
        assert_eq!(shown("pixelflow", &[("nodes", nodes)], "go_0"), [0, 1, 0]);
    }
    // All nodes are equal; at each pixel the last one gets the lesser of two bytes.
    let least = shown("network", &[("nodes", 4)], "nodes_3_bytes[0]");
    assert_eq!(least[..4], [0, 0x10, 0x30, 0x40], "{least:x?}");
    assert_eq!(shown("texture-unit", &[], "done"), [0, 1, 0]);
    assert_eq!(shown("pixelflow-frame-buffer", &[], "shown"), [0, 1]);
    assert_eq!(shown("pixelflow-frame-buffer", &[], "region"), [0, 1, 2, 3, 0]);
    assert_eq!(shown("pixelflow-samples-frame-buffer", &[("width", 8), ("height", 4)], "shown"), [0, 1]);
    let right = shown("texture-memory", &[], "texels[5]");
    assert!(right.windows(3).any(|three| three == [0x22_2222, 0x11_1111, 0x22_2222]));
    assert_eq!(shown("command-dma", &[], "left"), [0, 4, 3, 2, 1, 0, 1, 0]);
    assert_eq!(shown("network-sequencer", &[], "done"), [0, 1, 0]);
    assert_eq!(shown("array-controller", &[], "banks_under_way"), [0, 1, 0]);
    // At column 3 the value is 0x345, and right behind it -2.
    assert_eq!(shown("linear-evaluator", &[], "value[0][3]")[..5], [0, 0x45, 0x03, 0xfe, 0xff]);
    assert_eq!(shown("pixelflow-pixel", &[], "flag"), [0, 1]);
    assert_eq!(shown("pixelflow-pixel", &[("depth", 2)], "writes_register"), [0, 1, 0]);
}
