use super::*;
use crate::quadtree::Config;
use tilewright_scenes::Size;

/// Two video processors of two levels, a pipe and a tree of one unit; 100 clocks of drawing.
fn report() -> Report {
    let size = Size::new(8, 4).expect("in range");
    let form = "pipe:1+tree:1".to_owned();
    let config = Config { matrix: (2, 1), form, aperture: 2, strict: true, ..Config::new(size) };
    let unit = |windows, busy, stalled| UnitReport { windows, busy, stalled };
    let processors = vec![
        ProcessorReport { units: vec![unit(5, 20, 1), unit(4, 36, 0), unit(3, 28, 0)], fragments: 2 },
        ProcessorReport { units: vec![unit(5, 20, 3), unit(6, 44, 2), unit(9, 60, 0)], fragments: 7 },
    ];
    let phases = vec![
        Phase { name: Report::DRAWING, clocks: 100, picoseconds: 1_000_000 },
        Phase { name: Report::READ_OUT, clocks: 20, picoseconds: 200_000 },
    ];
    let built = config.built().expect("can be built");
    assert_eq!(built.levels, 2);
    Report::new(built, &config.parsed_form().expect("possible"), 5, processors, 40, phases)
}

#[test]
fn stages_are_sums_with_their_least_and_their_greatest_part() {
    let report = report();
    assert_eq!((report.fragments, report.drawing_clocks(), report.clocks_per_packet()), (9, 100, 20.0));
    let stage = &report.stages[2];
    assert_eq!((stage.level, stage.unit, stage.units), (2, "tree", 1));
    assert_eq!(stage.tests, Spread { all: 40, least: 16, most: 24 });
    assert_eq!(stage.windows, Spread { all: 12, least: 3, most: 9 });
    assert_eq!(stage.load, [0.44, 0.6]);
    assert_eq!(report.stages[0].tests, Spread { all: 0, least: 0, most: 0 });
    assert_eq!(report.balance(), (64.0 + 104.0) / (2.0 * 104.0));
}

/// A level of a tree has a unit for each quarter of the level above.
#[test]
fn each_unit_of_a_tree_has_its_part_of_the_load() {
    let config = Config { form: "stack:2+tree:3+pipe".to_owned(), ..Config::new(Size::VGA) };
    let form = config.parsed_form().expect("possible");
    let expected = [("set-up", 1), ("stack", 1), ("stack", 1), ("tree", 1), ("tree", 4), ("tree", 16)];
    assert_eq!(units(&form)[..6], expected);
    assert_eq!(units(&form)[6..], [("pipe", 1); 3]);
    let units = vec![UnitReport { windows: 1, busy: 80, stalled: 0 }; 9];
    let processors = vec![ProcessorReport { units, fragments: 0 }];
    let phases = vec![Phase { name: Report::DRAWING, clocks: 100, picoseconds: 1 }];
    let report = Report::new(config.built().expect("can be built"), &form, 1, processors, 0, phases);
    let load: Vec<f64> = report.stages.iter().map(|stage| stage.load[0]).collect();
    assert_eq!(load, [0.8, 0.8, 0.8, 0.8, 0.2, 0.05, 0.8, 0.8, 0.8]);
}

#[test]
fn a_frame_without_packets_divides_by_nothing() {
    let config = Config::new(Size::VGA);
    let units = vec![UnitReport { windows: 0, busy: 0, stalled: 0 }; 9];
    let processors = vec![ProcessorReport { units, fragments: 0 }];
    let form = config.parsed_form().expect("possible");
    let report = Report::new(config.built().expect("can be built"), &form, 0, processors, 0, Vec::new());
    assert_eq!((report.clocks_per_packet(), report.balance()), (0.0, 0.0));
    assert!(report.stages.iter().all(|stage| stage.load == [0.0, 0.0]));
}

#[test]
fn it_reads_as_tables() {
    let text = report().to_string();
    assert_eq!(
        text,
        "quadtree generator, 2x1 video processors of pipe:1+tree:1: 8x4 pixels,\n\
         parallel tests of up to 3 edges, an aperture of 2, strict, queues of 2 and 4 packets and 2 windows\n\
         5 packets, 9 fragments\n\
         \n\
         phase               clocks         ms\n\
         drawing                100      0.001\n\
         reading out             20      0.000\n\
         A packet takes 20.00 clocks of drawing; the broadcast waited for 40 clocks.\n\
         \n\
         stage             tests    windows    least     most\n\
         set-up                0         10        5        5\n\
         1 pipe               40         10        4        6\n\
         2 tree               40         12        3        9\n\
         Least and most are the windows of one video processor; each has four tests on the next level.\n\
         \n\
         stage              busy    least     most    stalled     most    load    most\n\
         set-up               40       20       20          4        3  20.0 %  20.0 %\n\
         1 pipe               80       36       44          2        2  40.0 %  44.0 %\n\
         2 tree               88       28       60          0        0  44.0 %  60.0 %\n\
         The load of the video processors is 80.8 % balanced.",
        "{text}"
    );
}
