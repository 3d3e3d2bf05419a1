//! The whole generator: pictures of polygons, the broadcast, and the values of its counters.

use proptest::prelude::*;
use tilewright_sim::{Pauses, Simulation};

use super::super::coverage_test::Test;
use super::super::format::Matrix;
use super::super::model::{Convex, Raster};
use super::super::processor::Queues;
use super::super::raster::Form;
use super::super::testing::{formats, polygons, small, triangle};
use super::*;

const BLANK: u64 = 0xff_ffff << 24 | 0x10_20_30;

type Sim = Simulation<QuadtreeGeneratorIn, QuadtreeGeneratorOut>;

fn generator(format: Format, form: &str, test: Test, queue: u32) -> QuadtreeGenerator {
    let queues = Queues { broadcast: queue, packets: queue, windows: queue };
    let form = Form::parse(form, &format).unwrap();
    QuadtreeGenerator { video_processor: VideoProcessor { format, form, test, queues } }
}

/// Sends polygons, and waits until they are drawn.
fn draw(sim: &mut Sim, format: Format, polygons: &[Convex]) {
    let (i, idle) = (sim.i, sim.o.idle);
    let t = sim.testbench();
    t.limit(1_000_000);
    let send = async {
        for polygon in polygons {
            t.send_bits(i.packets, polygon.packet(&format)).await;
        }
        t.until(idle).await;
    };
    t.run((send,));
}

/// Exchanges the banks, and reads the picture.
fn show(sim: &mut Sim, format: Format, pauses: Pauses) -> Vec<u64> {
    let (i, o) = (sim.i, sim.o);
    let (p, mut pauses) = (format.matrix().columns(), pauses);
    let t = sim.testbench();
    t.limit(100_000);
    let show = async {
        t.set(i.swap, 1);
        t.step().await;
        t.set(i.swap, 0);
        t.set(i.show.clear, 1);
        t.set(i.show.background, 0x10_20_30);
        t.set(i.show.start, 1);
        t.step().await;
        t.set(i.show.start, 0);
    };
    let Screen { width, height } = format.screen();
    let receive = async {
        let mut picture = Vec::new();
        for _ in 0..height {
            let mut line = Vec::new();
            for _ in 0..format.columns() {
                t.wait(pauses.next_length().into()).await;
                let group = t.receive_bits(o.pixels).await;
                line.extend((0..p).map(|lane| group.slice(48 * lane..48 * lane + 48).to_u64().unwrap()));
            }
            picture.extend(&line[..width as usize]);
        }
        picture
    };
    t.run((show, receive)).1
}

/// The picture from the polygons' own functions: each pixel has the smallest word or, in strict mode, the first of the
/// nearest.
fn expected(format: Format, polygons: &[Convex], strict: bool) -> Vec<u64> {
    let Screen { width, height } = format.screen();
    let pixels = (0..u64::from(height)).flat_map(|y| (0..u64::from(width)).map(move |x| (x, y)));
    let word = |polygon: &Convex, (x, y): (u64, u64)| {
        let edges = polygon.edges.iter().all(|[a, b, c]| a * x as i64 + b * y as i64 + c >= 0);
        let [left, top, right, bottom] = polygon.bounds.map(u64::from);
        let covers = edges && (left..=right).contains(&x) && (top..=bottom).contains(&y);
        let plane =
            |[dx, dy, origin]: [u64; 3]| origin.wrapping_add(dx.wrapping_mul(x)).wrapping_add(dy.wrapping_mul(y));
        let [z, r, g, b] = polygon.planes.map(plane);
        covers.then_some((z >> 16 & 0xff_ffff) << 24 | (r >> 16 & 0xff) << 16 | (g >> 16 & 0xff) << 8 | b >> 16 & 0xff)
    };
    let kept = |at: (u64, u64)| {
        let words = polygons.iter().filter_map(|polygon| word(polygon, at));
        let nearer =
            |old: u64, new: u64| if strict { if new >> 24 < old >> 24 { new } else { old } } else { old.min(new) };
        words.fold((1 << 48) - 1, nearer)
    };
    pixels.map(kept).map(|word| if word == (1 << 48) - 1 { BLANK } else { word }).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    /// Two pictures one after another: the second starts empty.
    #[test]
    fn pictures_are_what_the_polygons_say(
        (format, pictures) in formats(12).prop_filter("few processors", |format| format.matrix().processors() <= 16)
            .prop_flat_map(|format| {
                let picture = prop::collection::vec(polygons(format), 0..6);
                (Just(format), prop::collection::vec(picture, 2))
            }),
        form in prop::sample::select(vec!["stack", "pipe", "stack:1+pipe"]),
        (parallel, strict) in any::<(bool, bool)>(),
        (queue, percent, seed) in (1..4u32, 0..60u64, any::<u64>()),
    ) {
        let form = if format.levels() == 1 { "pipe" } else { form };
        let test = if parallel { Test::Parallel } else { Test::Serial };
        let mut sim = Simulation::of(&generator(format, form, test, queue)).unwrap().seeded(seed);
        sim.reset();
        sim.set(sim.i.strict, strict);
        for polygons in &pictures {
            draw(&mut sim, format, polygons);
            prop_assert_eq!(show(&mut sim, format, Pauses::percent(percent, seed)), expected(format, polygons, strict));
        }
    }
}

#[test]
fn a_full_queue_holds_only_the_next_packet_of_the_others() {
    // A polygon of one pixel: its video processor divides windows, the others find it beyond its bounds.
    let mut sim = Simulation::of(&generator(small(), "stack", Test::Parallel, 1)).unwrap();
    sim.reset();
    let shown = ["packets_valid", "packets_ready", "has[0]", "has[1]", "all_have", "idle"];
    let wave = sim.record(shown).cycles("clk", 1..46);
    let dot = Convex { bounds: [0, 0, 0, 0], ..triangle() };
    draw(&mut sim, small(), &[dot.clone(), dot.clone(), dot.clone(), dot]);
    wave.expect(
        r"
        clk           |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        packets_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        packets_ready |~~~\___/~~~\_______________/~~~\____________________________________________________________
        has[0]        |____________________________________________________________________________________________
        has[1]        |_______________________________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        all_have      |___/~~~\_______________/~~~\___________________________________________________________/~~~~
        idle          |~~~\________________________________________________________________________________________

        clk           |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        packets_valid |~~~\____________________________________________________________________________________
        packets_ready |~~~\___________________________________________________________/~~~~~~~~~~~~~~~~~~~~~~~~
        has[0]        |________________________________________________________________________________________
        has[1]        |_______/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\________________________
        all_have      |___________________________________________________________/~~~\________________________
        idle          |________________________________________________________________________________________
        ",
    );
    assert!(sim.get_u64(sim.o.broadcast.stalled) > 0);
}

#[test]
fn the_counters_are_those_of_the_cost_model() {
    let format = small();
    let mut sim = Simulation::of(&generator(format, "pipe", Test::Serial, 2)).unwrap();
    sim.reset();
    draw(&mut sim, format, &[triangle(), triangle()]);
    for (processor, (column, row)) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().enumerate() {
        let counts = Raster { format, column, row }.counts(&triangle());
        sim.set(sim.i.probe.processor, processor as u32);
        let tally = |sim: &mut Sim, unit: u32| {
            sim.set(sim.i.probe.unit, unit);
            let Tally { busy, results, .. } = sim.o.tally;
            (sim.get_u64(busy), sim.get_u64(results))
        };
        assert_eq!(tally(&mut sim, 0), (8, 2), "the set-up of {processor}");
        for (level, [divided, left]) in (1..).zip(&counts) {
            assert_eq!(
                tally(&mut sim, level),
                (2 * (12 * divided + 4 * left), 2 * left),
                "level {level} of {processor}"
            );
        }
        assert_eq!(sim.get_u64(sim.o.fragments), 2 * counts[1][1]);
    }
    let Tally { busy, results, .. } = sim.o.broadcast;
    assert_eq!((sim.get_u64(busy), sim.get_u64(results)), (2, 2));
}

#[test]
#[should_panic(expected = "the banks are swapped only while nothing is drawn or read")]
fn a_swap_while_a_polygon_is_drawn_is_an_error() {
    let mut sim = Simulation::of(&generator(small(), "pipe", Test::Serial, 2)).unwrap();
    sim.reset();
    let (i, t) = (sim.i, sim.testbench());
    t.run((t.send_bits(i.packets, triangle().packet(&small())),));
    drop(t);
    sim.set(sim.i.swap, 1);
    sim.step();
}

#[test]
fn a_generator_that_cannot_be_is_refused_in_a_sentence() {
    let format = small();
    let form = Form::parse("pipe", &format).unwrap();
    let queues = Queues { broadcast: 2, packets: 0, windows: 2 };
    let problem = VideoProcessor { format, form, test: Test::Serial, queues }.checked().unwrap_err().to_string();
    assert_eq!(problem, "`queues.packets` of `VideoProcessor` is 0: it has to be from 1 to 4096");
    let matrix = Matrix::new(3, 2).unwrap_err().to_string();
    assert_eq!(matrix, "a matrix of 3x2 video processors: each side has to be 1, 2, 4, 8 or 16");
    let edges = Format::new(format.screen(), format.matrix(), 9).unwrap_err().to_string();
    assert_eq!(edges, "polygons of up to 9 edges: the limit has to be from 3 to 8");
    let aperture = format.with_aperture(3).unwrap_err().to_string();
    assert_eq!(aperture, "an aperture of 3 pixels: it has to be even, and from 0 to 8");
}
