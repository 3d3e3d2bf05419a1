//! A machine's manners: several frames, progress, cancellation, waveforms, and what it refuses.

use crate::quadtree::polygons::{BACKGROUND, machine, random, render, size};
use std::io::BufReader;
use std::sync::atomic::{AtomicBool, Ordering};
use tilewright_machines::quadtree::{Config, Machine, Queues};
use tilewright_machines::{Error, Progress, Watch};
use tilewright_scenes::{Edge, Polygon, golden};
use tilewright_sim::{EngineKind, Vcd};

fn config(packets: &[Polygon]) -> Config {
    Config { matrix: (2, 2), form: "stack".to_owned(), ..Config::for_packets(size(32, 24), packets) }
}

fn packets() -> Vec<Polygon> {
    random(9, 60, size(32, 24), 8)
}

#[test]
fn frames_may_follow_one_another() {
    let all = packets();
    let config = config(&all);
    let mut machine = machine(&config);
    for packets in [&all[..20], &all[20..], &[], &all[..20]] {
        let (frame, report) = machine.render(packets, BACKGROUND, &mut Watch::default()).expect("renders");
        assert!(frame == golden::render(config.size, packets, BACKGROUND), "of {} packets", packets.len());
        // Each frame is counted by itself, as if it were the only one.
        assert_eq!(report, render(&config, packets).1);
    }
}

#[test]
fn a_frame_that_was_broken_off_leaves_nothing_in_the_next() {
    // A picture that takes longer to read than until the next look at the flag.
    let size = size(48, 40);
    let all = random(9, 60, size, 8);
    let config = Config { matrix: (1, 1), form: "stack".to_owned(), ..Config::for_packets(size, &all) };
    for broken in ["drawing", "reading out"] {
        let mut machine = machine(&config);
        machine.render(&all[..30], BACKGROUND, &mut Watch::default()).expect("renders");
        let cancel = AtomicBool::new(false);
        let mut progress = |it: Progress| cancel.store(it.phase == broken && it.fraction > 0.0, Ordering::Relaxed);
        let mut watch = Watch { progress: Some(&mut progress), cancel: Some(&cancel) };
        let busy: Vec<Polygon> = all.iter().cycle().take(600).cloned().collect();
        let ended = machine.render(&busy, BACKGROUND, &mut watch);
        let Err(Error::Cancelled { phase, .. }) = ended else { panic!("it was cancelled while {broken}") };
        assert_eq!(phase, broken);
        let (frame, report) = machine.render(&all[30..], BACKGROUND, &mut Watch::default()).expect("renders");
        assert!(frame == golden::render(size, &all[30..], BACKGROUND), "after {broken}");
        assert_eq!(report, render(&config, &all[30..]).1);
    }
}

#[test]
fn all_engines_draw_and_count_alike() {
    let size = size(5, 4);
    let packets = &random(9, 40, size, 3)[..2];
    let config = Config { matrix: (1, 1), form: "stack:2+pipe".to_owned(), ..Config::for_packets(size, packets) };
    let on = |engine| machine(&config).on(engine).render(packets, BACKGROUND, &mut Watch::default()).expect("renders");
    let compiled = on(EngineKind::Compiled);
    assert_eq!(on(EngineKind::Interpreter), compiled);
    assert_eq!(on(EngineKind::Both), compiled);
}

#[test]
fn progress_goes_through_the_phases() {
    let packets: Vec<Polygon> = packets().into_iter().cycle().take(600).collect();
    let mut seen: Vec<Progress> = Vec::new();
    let mut progress = |it| seen.push(it);
    let mut watch = Watch { progress: Some(&mut progress), cancel: None };
    let (_, report) = machine(&config(&packets)).render(&packets, BACKGROUND, &mut watch).expect("renders");
    for pair in seen.windows(2) {
        assert!(pair[0].phase != pair[1].phase || pair[0].fraction <= pair[1].fraction, "{pair:?}");
    }
    for phase in &report.phases {
        let fractions: Vec<f64> = seen.iter().filter(|it| it.phase == phase.name).map(|it| it.fraction).collect();
        assert_eq!((fractions.first(), fractions.last()), (Some(&0.0), Some(&1.0)), "{}", phase.name);
        // Every 1024 clocks, or at the next packet.
        let (least, most) = (phase.clocks / 1200, phase.clocks / 1024 + 2);
        assert!((least..=most).contains(&(fractions.len() as u64)), "{} of {} clocks", fractions.len(), phase.clocks);
        assert_eq!(phase.picoseconds, 10_000 * phase.clocks);
    }
    assert!(seen.len() > 10, "{seen:?}");
}

#[test]
fn a_cancelled_run_leaves_a_dump_that_opens() {
    let packets: Vec<Polygon> = packets().into_iter().cycle().take(600).collect();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("quadtree.vcd");
    let mut machine = machine(&config(&packets));
    machine
        .simulation()
        .trace(Vcd::to(&path).only("idle").only("u_processor[3].fragments"))
        .expect("the signals exist");
    let cancel = AtomicBool::new(false);
    let mut progress = |it: Progress| cancel.store(it.fraction > 0.3, Ordering::Relaxed);
    let result =
        machine.render(&packets, BACKGROUND, &mut Watch { progress: Some(&mut progress), cancel: Some(&cancel) });
    let Err(Error::Cancelled { phase: "drawing", time }) = result else { panic!("it was cancelled") };
    let mut parser = vcd::Parser::new(BufReader::new(std::fs::File::open(&path).expect("the dump exists")));
    parser.parse_header().expect("a header");
    let commands: Vec<vcd::Command> = parser.collect::<Result<_, _>>().expect("a dump that is whole");
    let mut times =
        commands.iter().filter_map(|it| if let vcd::Command::Timestamp(time) = it { Some(*time) } else { None });
    assert!(times.next_back() >= Some(time - 10_000), "the run ends at {time}");
}

#[test]
fn a_machine_that_cannot_be_is_refused_in_a_sentence() {
    let usual = Config::new(size(640, 480));
    let form = |form: &str| Config { form: form.to_owned(), ..usual.clone() };
    let help = "a form is made of `stack`, `pipe` and `tree`, each with its levels, as in `stack:2+pipe:3+tree:1`";
    let cases = [
        (
            Config { matrix: (3, 3), ..usual.clone() },
            "a matrix of 3x3 video processors: each side has to be 1, 2, 4, 8 or 16".to_owned(),
        ),
        (Config { edges: 9, ..usual.clone() }, "polygons of up to 9 edges: the limit has to be from 3 to 8".to_owned()),
        (
            Config { aperture: 3, ..usual.clone() },
            "an aperture of 3 pixels: it has to be even, and from 0 to 8".to_owned(),
        ),
        (
            Config { queues: Queues { windows: 0, ..usual.queues }, ..usual.clone() },
            "`queues.windows` of `VideoProcessor` is 0: it has to be from 1 to 4096".to_owned(),
        ),
        (
            form("pipe:3+stack:1"),
            "the form `pipe:3+stack:1`: it divides 4 levels; 640x480 pixels on a matrix of 4x4 have 8".to_owned(),
        ),
        (form("heap"), format!("the form `heap`: there is no part `heap`; {help}")),
    ];
    for (config, sentence) in cases {
        assert_eq!(Machine::new(config).err().expect("cannot be built").to_string(), sentence);
    }
}

#[test]
fn a_packet_for_another_machine_is_refused_in_a_sentence() {
    let packets = packets();
    let [triangle, more] =
        [3, 5].map(|edges| packets.iter().find(|it| it.edges.len() == edges).expect("one of them").clone());
    let mut machine = machine(&Config { edges: 4, ..config(&packets) });
    let mut refused = |packet: Polygon| {
        let packets = [triangle.clone(), packet];
        machine.render(&packets, BACKGROUND, &mut Watch::default()).expect_err("is refused").to_string()
    };
    assert_eq!(
        refused(more),
        "packet 1 cannot be drawn: it has 5 edges, and the machine is built for 3 to 4: build it with `edges` of that number"
    );
    let mut wide = triangle.clone();
    wide.bounds.right = 32;
    assert_eq!(
        refused(wide),
        "packet 1 cannot be drawn: it extends beyond the machine's 32x24 pixels: set it up for that size"
    );
    let mut steep = triangle.clone();
    steep.edges[2] = Edge { a: 1 << 16, ..steep.edges[2] };
    assert_eq!(
        refused(steep),
        "packet 1 cannot be drawn: an edge is steeper than 17 bits: set it up from vertices of 16 bits"
    );
    // Nothing was drawn of the frames that were refused.
    let (frame, _) = machine.render(&[], BACKGROUND, &mut Watch::default()).expect("renders");
    assert!(frame == golden::render::<[Edge; 3]>(size(32, 24), &[], BACKGROUND));
}
