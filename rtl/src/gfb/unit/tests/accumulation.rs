//! Pictures of several passes, refresh by refresh.

use super::*;
use crate::gfb::Passes;
use crate::gfb::testing::average;

/// A host write into a pass: how many clocks after the swap, to which pixel, and the word.
type Write = (u64, usize, u64);

/// The unit with an accumulation buffer, and a display so fast that no sum ends in the blanking in which it begins.
pub fn accumulating(unit: GfbUnit) -> GfbUnit {
    let display = Display { period: Period::ps(2_002), ..unit.display };
    GfbUnit { accumulation: true, display, ..unit }
}

/// A chain of one unit for a wide screen: a sum takes more than a refresh, and a pass takes two.
fn slow() -> GfbUnit {
    let unit = accumulating(unit(64, 4, 1, 5));
    let period =
        unit.sequencer().merge_clocks() * MERGE.period.picoseconds() * 2 / 3 / unit.read_out().refresh_clocks();
    GfbUnit { display: Display { period: Period::ps(period / 2 * 2), ..unit.display }, ..unit }
}

impl Bench {
    /// The settings of the picture that begins at the next swap.
    fn multipass(&mut self, passes: Option<Passes>) {
        let host = &self.sim.i.host.multipass[0];
        let (accumulates, count) = (host.accumulates, host.passes);
        self.sim.set(accumulates, passes.is_some());
        self.sim.set(count, passes.unwrap_or(Passes::Two).code());
    }

    /// A frame that consists of one image, and the host's writes into it in the clocks after its swap. Returns the
    /// number of refreshes that were complete at the swap.
    fn pass(&mut self, image: &[u64], writes: &[Write]) -> usize {
        self.frame(&[image.to_vec()]);
        let complete = self.refreshes.len();
        for clock in 0..writes.iter().map(|it| it.0 + 1).max().unwrap_or(0) {
            match writes.iter().find(|it| it.0 == clock) {
                Some((_, pixel, word)) => drop(self.access(*pixel, Some(*word))),
                None => self.clock(),
            }
        }
        complete
    }
}

fn colours(words: &[u64]) -> Vec<u64> {
    words.iter().map(|word| word & 0xffffff).collect()
}

/// As many images as passes, all different.
fn images(passes: Passes, pixels: usize) -> Vec<Vec<u64>> {
    let image = |pass: u64| (0..pixels as u64).map(|pixel| (pass << 20) + 0x0700 * pass + 5 * pixel).collect();
    (1..=u64::from(passes.count())).map(image).collect()
}

/// Shows pictures of these passes one after another, and a frame after them; returns the refreshes from the first pass
/// on.
fn shown(bench: &mut Bench, pictures: &[(Passes, Vec<Vec<u64>>)], behind: &[u64]) -> Vec<Vec<u64>> {
    let mut first = None;
    for (passes, images) in pictures {
        bench.multipass(Some(*passes));
        for image in images {
            let complete = bench.pass(image, &[]);
            first.get_or_insert(complete);
        }
    }
    bench.multipass(None);
    bench.pass(behind, &[]);
    bench.next_refresh();
    bench.refreshes.split_off(first.unwrap())
}

/// A picture takes as few refreshes as possible: one for the average, and one for each pass. A pass takes two if merging
/// takes two, as in the paper's machine.
#[test]
fn a_picture_takes_a_refresh_more_than_its_passes() {
    for (unit, refreshes) in [(accumulating(unit(7, 2, 1, 1)), 1), (slow(), 2)] {
        for passes in Passes::ALL {
            let mut bench = Bench::new(unit.clone(), 7);
            let pixels = bench.pixels();
            let images = images(*passes, pixels);
            let pictures = [(*passes, images.clone()), (*passes, images.clone())];
            let of_passes = images.iter().flat_map(|image| vec![colours(image); refreshes]);
            let picture: Vec<Vec<u64>> = of_passes.chain([average(&images)]).collect();
            let expected = [&picture[..], &picture, &[vec![9; pixels]]].concat();
            let shown = shown(&mut bench, &pictures, &vec![9; pixels]);
            assert_eq!(shown.len(), expected.len());
            assert_eq!(shown, expected, "{passes:?}");
        }
    }
}

#[test]
fn the_average_stays_until_the_next_frame_is_merged() {
    let mut bench = Bench::new(accumulating(unit(7, 2, 1, 1)), 7);
    bench.multipass(Some(Passes::Two));
    let images = images(Passes::Two, 14);
    images.iter().for_each(|image| _ = bench.pass(image, &[]));
    assert_eq!(bench.next_refresh(), colours(&images[1]));
    // A host write is not in the average, and can be read nevertheless.
    bench.access(3, Some(99));
    for _ in 0..3 {
        assert_eq!(bench.next_refresh(), average(&images));
    }
    assert_eq!(bench.access(3, None), Some(99));
}

/// Without accumulation the unit behaves like one that has no buffer.
#[test]
fn frames_without_accumulation_are_shown_as_without_a_buffer() {
    let frames: Vec<Vec<u64>> = images(Passes::Four, 14);
    let run = |unit: GfbUnit| {
        let mut bench = Bench::new(unit, 7);
        let times: Vec<u64> = frames
            .iter()
            .map(|frame| {
                bench.pass(frame, &[]);
                bench.sim.time()
            })
            .collect();
        bench.next_refresh();
        (times, bench.refreshes.split_off(1))
    };
    assert_eq!(
        run(accumulating(unit(7, 2, 1, 1))),
        run(GfbUnit { accumulation: false, ..accumulating(unit(7, 2, 1, 1)) })
    );
}

/// The host describes the picture at the first swap; later settings apply to the next picture.
#[test]
fn a_picture_that_has_begun_is_completed() {
    let mut bench = Bench::new(accumulating(unit(7, 2, 1, 1)), 7);
    let images = images(Passes::Four, 14);
    bench.multipass(Some(Passes::Four));
    let first = bench.pass(&images[0], &[]);
    bench.multipass(None);
    images[1..].iter().for_each(|image| _ = bench.pass(image, &[]));
    bench.multipass(Some(Passes::Two));
    bench.pass(&images[0], &[]);
    bench.pass(&images[1], &[]);
    bench.next_refresh();
    bench.next_refresh();
    let shown = &bench.refreshes[first..];
    assert_eq!(shown[4], average(&images));
    assert_eq!(shown[7], average(&images[..2]));
}

/// The sum reads pixel 5 in the 6th clock after the swap; the host writes it before, in and after that clock.
#[test]
fn a_sum_has_what_the_host_writes_before_it_comes_to_the_pixel() {
    for (clock, is_added) in [(0, true), (4, true), (5, false), (6, false)] {
        let mut bench = Bench::new(accumulating(unit(7, 2, 1, 1)), 7);
        bench.multipass(Some(Passes::Two));
        bench.pass(&[0x10; 14], &[(clock, 5, 0x30)]);
        bench.pass(&[0x10; 14], &[]);
        bench.next_refresh();
        let mut expected = [0x10; 14];
        expected[5] = if is_added { 0x20 } else { 0x10 };
        assert_eq!(bench.next_refresh(), expected, "written in clock {clock}");
    }
}

#[test]
fn a_swap_while_a_sum_is_under_way_or_before_the_average_is_an_error() {
    let unit = slow();
    let sentences = [
        "the banks do not change while a sum is under way",
        "the banks do not change before the average has been shown for a whole refresh",
    ];
    for (clocks, sentence) in [(10, sentences[0]), (256 + 40, sentences[1])] {
        let mut bench = Bench::new(unit.clone(), 7);
        bench.multipass(Some(Passes::Two));
        images(Passes::Two, 256).iter().for_each(|image| _ = bench.pass(image, &[]));
        (0..clocks).for_each(|_| bench.clock());
        bench.sim.set(bench.sim.i.swap, 1);
        let problem = (0..200).find_map(|_| bench.sim.try_step().err()).unwrap().to_string();
        assert!(problem.contains(sentence), "{problem}");
    }
}

/// A picture or a frame: its number of passes, their images, and the host's writes into each.
type Picture = (Option<Passes>, Vec<(Vec<u64>, Vec<Write>)>);

fn picture() -> impl Strategy<Value = Picture> {
    let passes = prop::option::weighted(
        0.8,
        prop::sample::select(&[Passes::Two, Passes::Two, Passes::Four, Passes::Eight, Passes::Sixteen][..]),
    );
    passes.prop_flat_map(|passes| {
        let writes = prop::collection::vec((0..20u64, 0..40usize, 0..1u64 << 48), 0..6);
        let pass = (prop::collection::vec(0..1u64 << 48, 40), writes);
        prop::collection::vec(pass, passes.map_or(1, Passes::count) as usize).prop_map(move |images| (passes, images))
    })
}

/// A pass as the sum reads it, and as it is on display. The sum includes a host write if it comes before the sum reads
/// the pixel, one pixel in each clock.
fn written(image: &[u64], writes: &[Write]) -> (Vec<u64>, Vec<u64>) {
    let (mut added, mut shown) = (image.to_vec(), image.to_vec());
    for (clock, pixel, word) in writes {
        shown[*pixel] = *word;
        if *clock < *pixel as u64 {
            added[*pixel] = *word;
        }
    }
    (added, shown)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Pictures of different passes, and frames without accumulation between them, with host writes during the sums.
    /// Each refresh shows one of them, in sequence, and all of them are shown (VC1-ACB).
    #[test]
    fn averages_are_those_of_plain_sums(
        (width, height, units, overhead) in (4..9u32, 2..6u32, 1..2u32, 1..4u32),
        pictures in prop::collection::vec(picture(), 1..4),
        seed in any::<u64>(),
    ) {
        let mut bench = Bench::new(accumulating(unit(width, height, units, overhead)), seed);
        let pixels = bench.pixels();
        let mut expected: Vec<Vec<u64>> = Vec::new();
        let mut first = None;
        for (passes, images) in &pictures {
            bench.multipass(*passes);
            let mut all_added = Vec::new();
            for (image, writes) in images {
                let merged: Vec<u64> = image[..pixels].iter().map(|word| *word.min(&BLANK)).collect();
                // One write in a clock.
                let mut writes: Vec<Write> = writes.iter().map(|&(clock, pixel, word)| (clock, pixel % pixels, word)).collect();
                writes.sort_by_key(|it| it.0);
                writes.dedup_by_key(|it| it.0);
                let complete = bench.pass(&image[..pixels], &writes);
                first.get_or_insert(complete);
                let (added, shown) = written(&merged, &writes);
                all_added.push(added);
                expected.push(colours(&shown));
            }
            if passes.is_some() {
                expected.push(average(&all_added));
            }
        }
        // The last picture is shown, too.
        while bench.refreshes.len() < first.unwrap() + expected.len() {
            bench.clock();
        }
        prop_assert_eq!(&bench.refreshes[first.unwrap()..], &expected);
    }
}
