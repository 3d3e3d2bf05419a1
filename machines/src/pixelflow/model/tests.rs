//! The order of the model's stages, one by one.

use super::*;
use crate::pixelflow::workload::{Place, Share};

fn turn(region: u16, shader: usize) -> Turn {
    let shading = Shading { shader, takes: 100, sends: 6 };
    Turn { region, composes: 20, shades: Some(shading), loads: 8 }
}

fn run(workload: &Workload, front_end: FrontEnd, turns: Vec<Turn>) -> Timeline {
    Frame { workload, overhead: 0, front_end, turns, shaders: 2, one_way: false }.run()
}

#[test]
fn nobody_works_on_two_regions_at_once() {
    let workload = Workload::balanced(3, 6, 4, 5);
    let time =
        run(&workload, FrontEnd::Before(1), (0..6).map(|region| turn(region, usize::from(region) % 2)).collect());
    for pair in time.turns.windows(2) {
        assert!(pair[0].composed.end <= pair[1].composed.start && pair[0].sent.end <= pair[1].sent.start);
        assert!(pair[0].loaded.end <= pair[1].loaded.start && pair[0].rasterized <= pair[1].rasterized);
    }
    for three in time.turns.windows(3) {
        assert!(three[0].shaded.end <= three[2].shaded.start, "of one shader");
    }
    for Done { rasterized, composed, shaded, sent, loaded } in &time.turns {
        assert!(*rasterized <= composed.start && composed.end <= shaded.start && shaded.end <= sent.start);
        assert_eq!((sent.end, loaded.end - loaded.start), (loaded.start, 8));
    }
}

#[test]
fn rasterizers_wait_for_a_bank_and_the_network_for_a_shader() {
    // Nothing to draw: shaders alone keep the network waiting, with two regions in their registers.
    let empty = Workload::balanced(1, 6, 0, 5);
    let all = |shader: fn(u16) -> usize| (0..6).map(|region| turn(region, shader(region))).collect::<Vec<_>>();
    let one = run(&empty, FrontEnd::Before(0), all(|_| 0));
    let begins: Vec<Ticks> = one.turns.iter().map(|done| done.composed.start).collect();
    assert_eq!(begins, [0, 20, 120, 220, 320, 420]);
    let two = run(&empty, FrontEnd::Before(0), all(|region| usize::from(region) % 2));
    let begins: Vec<Ticks> = two.turns.iter().map(|done| done.composed.start).collect();
    assert_eq!(begins, [0, 20, 40, 60, 120, 140]);
    // A rasterizer is two regions ahead of the network, no more: the third is drawn when the first is composed.
    let full = Workload::balanced(1, 6, 1, 10);
    let slow = run(&full, FrontEnd::Before(0), all(|_| 0));
    let drawn: Vec<Ticks> = slow.turns.iter().map(|done| done.rasterized).collect();
    assert_eq!(drawn, [10, 20, 40, 60, 160, 260]);
}

#[test]
fn the_second_pass_makes_each_primitive_once_just_before_it_is_drawn() {
    let place = |region| Place { region, draws: 10 };
    let mut share = Share::default();
    share.push([place(0), place(1)]);
    share.push([place(1)]);
    let workload = Workload { shares: vec![share], regions: 2 };
    let two_passes = FrontEnd::TwoPasses { sorts: 3, generates: 50 };
    let time = run(&workload, two_passes, vec![turn(0, 0), turn(1, 1)]);
    assert_eq!((time.front, time.generated, time.drawn), (vec![6], vec![100], vec![30]));
    // The first is made at 56 and drawn until 66, in region 1 until 76, and the second is made at 106.
    assert_eq!([time.turns[0].rasterized, time.turns[1].rasterized], [66, 116]);
    // What was made for one set of samples is there for the next.
    let again = run(&workload, two_passes, vec![turn(0, 0), turn(0, 0), turn(1, 1), turn(1, 1)]);
    assert_eq!(again.turns.iter().map(|done| done.rasterized).collect::<Vec<_>>(), [66, 76, 116, 136]);
}

#[test]
fn without_shading_words_go_to_the_frame_buffer_as_they_are() {
    let workload = Workload::balanced(1, 4, 0, 1);
    let plain = |region| Turn { region, composes: 20, shades: None, loads: 50 };
    let time = run(&workload, FrontEnd::Before(0), (0..4).map(plain).collect());
    let begins: Vec<Ticks> = time.turns.iter().map(|done| done.composed.start).collect();
    assert_eq!(begins, [0, 20, 70, 120]);
    assert_eq!(time.latency(), 20 + 4 * 50);
}
