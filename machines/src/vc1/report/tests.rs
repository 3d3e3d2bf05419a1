use super::*;
use crate::vc1::clocks::Class;
use crate::vc1::config::Config;
use tilewright_scenes::Size;

/// Two processing elements: one works for 100 clocks and stalls for 20, the other works for 60.
fn report() -> Report {
    let config = Config { processors: 2, ..Config::new(Size::VGA) };
    let one = Clocks { clearing: 10, geometry: 40, rasterization: 50, stalled: 20, swap: 4, ..Clocks::default() };
    let other = Clocks { clearing: 10, geometry: 20, rasterization: 30, sync: 60, swap: 4, ..Clocks::default() };
    let of = |polygons, pixels, clocks| ProcessorReport {
        polygons,
        expected: 90,
        pixels,
        pages: 2,
        overflows: 1,
        broadcast: 2,
        clocks,
    };
    let times = Times {
        command: 1_000_000_000,
        drawn: Some(4_000_000_000),
        swapped: Some(4_100_000_000),
        merged: Some(9_500_000_000),
        shown: Some(9_600_000_000),
        averaged: None,
    };
    let processors = vec![of(4, 30, one), of(3, 10, other)];
    Report {
        compared: 0,
        machine: config.built().expect("can be built"),
        polygons: 7,
        load_words: 1000,
        merge_clocks: 64,
        judged: 1,
        frames: vec![FrameReport { packets: 8, words: 60, times, refreshes: 3, processors }],
    }
}

#[test]
fn a_frame_takes_from_its_command_until_it_is_shown() {
    let report = report();
    assert_eq!((report.frames[0].picoseconds(), report.picoseconds()), (8_600_000_000, 9_600_000_000));
    assert_eq!((report.frames[0].pixels(), report.frames[0].overflows(), report.frames[0].broadcast()), (40, 2, 4));
}

#[test]
fn the_load_is_balanced_by_the_busiest() {
    let mut frame = report().frames.remove(0);
    assert_eq!(frame.balance(), (120.0 + 60.0) / (2.0 * 120.0));
    assert_eq!(frame.stalls_per_pixel(), 0.5);
    frame.processors.iter_mut().for_each(|it| it.pixels = 0);
    assert_eq!(frame.stalls_per_pixel(), 20.0, "without pixels, all stalls");
    frame.processors.iter_mut().for_each(|it| it.clocks = Clocks::default());
    assert_eq!(frame.balance(), 0.0, "nothing to share");
}

#[test]
fn every_clock_is_in_the_sum_of_its_class() {
    let mut clocks = Clocks::default();
    for (count, class) in (1..).zip([
        Class::Clearing,
        Class::Geometry,
        Class::Rasterization,
        Class::Sending,
        Class::Receiving,
        Class::Stalled,
        Class::Bus,
        Class::Overflow,
        Class::Sync,
        Class::Swap,
    ]) {
        *clocks.of(class) += count;
    }
    assert_eq!(clocks.all(), [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    clocks += clocks;
    assert_eq!((clocks.all()[9], clocks.total(), clocks.work()), (20, 110, 30));
}

#[test]
fn it_reads_as_tables() {
    assert_eq!(
        report().to_string(),
        "VC-1, n = 2: 640x480 pixels, 19200 patches of 4x4,\n\
         4096 pages in each local frame buffer, clusters of 32 polygons, those above 500 pixels drawn by all\n\
         7 polygons, loaded in 0.1 ms; T_m is 64 merge clocks\n\
         \n\
         frame  packets   pixels   command     drawn   swapped    merged  shown ms refreshes overflows broadcast    words\n    \
         1        8       40     1.000     4.000     4.100     9.500     9.600         3         2         4       60\n\
         \n\
         clocks of each processing element\n \
         PE  clearing  geometry    raster   sending receiving   stalled       bus  overflow      sync      swap\n  \
         0        10        40        50         0         0        20         0         0         0         4\n  \
         1        10        20        30         0         0         0         0         0        60         4\n\
         The load is 75.0 % balanced; a pixel stalls for 0.500 clocks on average."
    );
    let compared = Report { compared: 12, ..report() }.to_string();
    assert!(
        compared.ends_with("clocks on average.\nThe model has the same 12 events, times and counts."),
        "{compared}"
    );
}
