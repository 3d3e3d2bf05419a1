//! Loading of regions and display of frames.

use proptest::prelude::*;
use tilewright_sim::{Pauses, Simulation};

use super::*;

type Sim = Simulation<FrameBufferIn, FrameBufferOut>;

/// The colour of a pixel of a frame; pixels that could be confused have different colours.
fn colour(frame: u64, x: u32, y: u32) -> u64 {
    (frame << 20 ^ u64::from(y) << 10 ^ u64::from(x)).wrapping_mul(0x9e37_79b9) >> 3 & 0xff_ffff
}

/// The colour of one of eight samples, from its position on the screen in samples and its rendering.
fn sample(frame: u64, x: u32, y: u32, rendering: u32) -> u64 {
    colour(frame, x, y).wrapping_mul(0x2545_f491) >> (3 * rendering) & 0xff_ffff
}

/// The expected colour of a pixel on display.
fn expected(samples: u32, frame: u64, x: u32, y: u32) -> u64 {
    if samples == 1 {
        return colour(frame, x, y);
    }
    let of_eight = (0..8).map(|it| sample(frame, 2 * x + (it & 1), 2 * y + (it >> 1 & 1), it >> 2)).collect::<Vec<_>>();
    let mean = |shift: u32| (of_eight.iter().map(|it| it >> shift & 0xff).sum::<u64>() + 4) / 8;
    mean(16) << 16 | mean(8) << 8 | mean(0)
}

/// The registers of a node as the port reads them: a region of a frame.
struct Registers<'a> {
    buffer: &'a FrameBuffer,
    frame: u64,
    region: u32,
}

impl Registers<'_> {
    /// A byte of each chip.
    fn seen(&self, pixel: u64, address: u64) -> Vec<u64> {
        let FrameBuffer { columns: width, rows: height, samples, .. } = *self.buffer;
        let [across, _] = self.buffer.regions();
        let (left, top) = (self.region % across * width, self.region / across * height);
        let (x, line) = (pixel as u32 % width, pixel as u32 / width);
        let byte = |chip: u32| {
            let (x, y) = (left + x, top + 2 * chip + line);
            match (samples, address) {
                (1, 0..3) => colour(self.frame, x, y) >> (8 * address) & 0xff,
                (8, 0..6) => sample(self.frame, x, y, address as u32 / 3) >> (8 * (address % 3)) & 0xff,
                _ => 0xee,
            }
        };
        (0..self.buffer.chips()).map(byte).collect()
    }
}

/// A frame buffer, and the node that loads it, frame after frame.
struct Loaded<'a> {
    sim: Sim,
    registers: Registers<'a>,
    /// The clock in which the region began, and the durations of the regions that are done.
    began: u64,
    took: Vec<u64>,
    clock: u64,
}

impl<'a> Loaded<'a> {
    fn new(buffer: &'a FrameBuffer) -> Loaded<'a> {
        let mut sim = Simulation::of(buffer).unwrap().seeded(5);
        sim.set(sim.i.start, 0);
        sim.set(sim.o.pixels.ready, 0);
        sim.reset();
        let registers = Registers { buffer, frame: 0, region: 0 };
        Loaded { sim, registers, began: 0, took: Vec::new(), clock: 0 }
    }

    /// Runs a clock; returns the pixel taken, if there is one.
    fn clock(&mut self, starts: bool, takes: bool) -> Option<(u64, bool, bool)> {
        let sim = &mut self.sim;
        let (i, o) = (sim.i, sim.o);
        sim.set(i.start, starts);
        sim.set(o.pixels.ready, takes);
        let [pixel, address] = [o.port.pixel, o.port.address].map(|port| sim.get_u64(port));
        sim.set_lanes(i.seen, self.registers.seen(pixel, address));
        let of = o.pixels.payload;
        let [red, green, blue] = [of.red, of.green, of.blue].map(|port| sim.get_u64(port));
        let [first, last, valid, done] = [of.first, of.last, o.pixels.valid, o.done].map(|port| sim.get_u64(port) == 1);
        if starts {
            self.began = self.clock;
        }
        if done {
            let regions = self.registers.buffer.count();
            self.took.push(self.clock - self.began);
            self.registers.region = (self.registers.region + 1) % regions;
            self.registers.frame += u64::from(self.registers.region == 0);
        }
        sim.step();
        self.clock += 1;
        (valid && takes).then_some((red << 16 | green << 8 | blue, first, last))
    }

    /// Loads a region while no pixels are taken.
    fn load(&mut self) {
        let before = self.took.len();
        self.clock(true, false);
        while self.took.len() == before {
            self.clock(false, false);
        }
    }
}

/// PFL-LOAD: the paper says 52 us.
#[test]
fn a_region_of_8192_pixels_takes_41_12_us() {
    let buffer = FrameBuffer { columns: 128, rows: 64, samples: 1, screen: Screen { width: 640, height: 512 } };
    let mut loaded = Loaded::new(&buffer);
    loaded.load();
    loaded.load();
    assert_eq!((loaded.took.clone(), buffer.clocks()), (vec![4112; 2], 4112));
    assert!(buffer.clocks() * super::super::ARRAY.period.picoseconds() < 52_000_000);
}

#[test]
fn a_region_of_eight_samples_takes_15_6_us() {
    let buffer = FrameBuffer { columns: 128, rows: 64, samples: 8, screen: Screen { width: 640, height: 512 } };
    let mut loaded = Loaded::new(&buffer);
    loaded.load();
    loaded.load();
    assert_eq!((loaded.took.clone(), buffer.clocks()), (vec![1560; 2], 1560));
}

#[test]
fn both_colours_of_four_samples_are_summed() {
    let buffer = FrameBuffer { columns: 8, rows: 8, samples: 8, screen: Screen { width: 4, height: 4 } };
    let mut loaded = Loaded::new(&buffer);
    let wave = loaded.sim.record(["clock", "sample", "port_pixel", "port_address", "sum[0]"]);
    (0..26).for_each(|clock| {
        loaded.clock(clock == 0, true);
    });
    wave.expect(
        r"
        clk          |~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/
        clock        | 1   | 0   | 1   | 2   | 3   | 4   | 5   | 6   | 7   | 8   | 9   | a   | b   | c   | d   | e   |
        sample       | 2   | 0                                 | 1                                 | 2               |
        port_pixel   | 8   | 0                                 | 1                                 | 8               |
        port_address | 1   | 0   | 1   | 2   | 3   | 4   | 5   | 0   | 1   | 2   | 3   | 4   | 5   | 0   | 1   | 2   |
        sum[0]       | e8  | 4                                 | 2b  | ee  | 84  | 6f  | 10b | b4  | ef  | 1ef | 156 |

        clk          |~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/~~\__/
        clock        | f   | 10  | 11  | 12  | 13  | 14  | 15  | 16  | 17  | 0   |
        sample       | 2               | 3                                 | 0   |
        port_pixel   | 8               | 9                                 | 2   |
        port_address | 3   | 4   | 5   | 0   | 1   | 2   | 3   | 4   | 5   | 0   |
        sum[0]       | 17f | 24b | 1ca | 226 | 319 | 1ed | 2fa | 392 | 271 | 52  |
        ",
    );
}

#[test]
fn a_pixel_is_shown_every_clock() {
    let buffer = FrameBuffer { columns: 2, rows: 4, samples: 1, screen: Screen { width: 2, height: 2 } };
    let mut loaded = Loaded::new(&buffer);
    let wave = loaded.sim.record([
        "clock",
        "pixel",
        "done",
        "is_whole",
        "shown",
        "x",
        "y",
        "pixels_valid",
        "pixels_first",
        "pixels_last",
    ]);
    loaded.clock(true, true);
    (0..22).for_each(|_| {
        loaded.clock(false, true);
    });
    wave.expect(
        r"
        clk          |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        clock        | 1 | 0 | 1 | 2 | 0 | 1 | 2 | 0 | 1 | 2 | 0 | 1 | 2 | 0 | 1 | 2 | 0                         |
        pixel        | 0             | 1         | 2         | 3         | 4         | 5                         |
        done         |___________________________________________________________/~~~\____________________________
        is_whole     |_______________________________________________________________/~~~\________________________
        shown        |___________________________________________________________________/~~~~~~~~~~~~~~~~~~~~~~~~
        x            |_______________________________________________________________________/~~~\___/~~~\___/~~~~
        y            | 0                                                                         | 1     | 0     |
        pixels_valid |_______________________________________________________________________/~~~~~~~~~~~~~~~~~~~~
        pixels_first |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\___________/~~~~
        pixels_last  |___________________________________________________________________________/~~~\___/~~~\____
        ",
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Under any pauses of both sides, whole frames are shown in sequence, and none is older than the last complete
    /// one.
    #[test]
    fn whole_frames_are_shown_in_sequence(
        width in 1..=3_u32,
        height in 2..=4_u32,
        screen in [1..12_u32, 1..20_u32],
        begins in 1..8_u64,
        (percent, takes) in (0..60_u64, any::<u64>()),
        has_eight in any::<bool>(),
    ) {
        let (samples, least) = if has_eight { (FrameBuffer::EIGHT, 3) } else { (1, 1) };
        let [columns, rows] = [1 << width.max(least), 1 << height.max(least)];
        let buffer = FrameBuffer { columns, rows, samples, screen: Screen { width: screen[0], height: screen[1] } };
        let mut loaded = Loaded::new(&buffer);
        let mut pauses = Pauses::percent(percent, takes);
        let mut pause = 0;
        let mut shown = Vec::new();
        let (mut is_loading, mut waits) = (false, begins);
        for _ in 0..20_000 {
            let starts = !is_loading && waits == 0;
            waits = waits.saturating_sub(1);
            let before = loaded.took.len();
            let frame = loaded.registers.frame;
            let takes = pause == 0;
            pause = if takes { pauses.next_length() } else { pause - 1 };
            let pixel = loaded.clock(starts, takes);
            is_loading = (is_loading || starts) && loaded.took.len() == before;
            if loaded.took.len() > before {
                waits = begins;
            }
            shown.extend(pixel.map(|pixel| (pixel, frame)));
        }
        expect_frames(&buffer, &shown)?;
    }
}

/// Checks the pixels shown, each with the number of the frame that was loaded meanwhile. Frame 0 is shown at least
/// once, and each later one any number of times.
fn expect_frames(buffer: &FrameBuffer, shown: &[((u64, bool, bool), u64)]) -> Result<(), TestCaseError> {
    let FrameBuffer { screen: Screen { width, height }, samples, .. } = *buffer;
    let pixels = (width * height) as usize;
    let mut number = 0;
    prop_assert!(shown.len() > 2 * pixels);
    for (scan, chunk) in shown.chunks(pixels).enumerate() {
        let whole = |frame: u64| {
            chunk.iter().enumerate().all(|(at, ((found, _, _), _))| {
                let (x, y) = (at as u32 % width, at as u32 / width);
                *found == expected(samples, frame, x, y)
            })
        };
        if scan > 0 && !whole(number) {
            number += 1;
        }
        prop_assert!(whole(number), "scan {}", scan);
        // The frame was complete before it was shown, and at most one newer frame was complete.
        prop_assert!(chunk[0].1 > number && chunk[0].1 <= number + 2);
        for (at, ((_, first, last), _)) in chunk.iter().enumerate() {
            prop_assert_eq!((*first, *last), (at == 0, ((at + 1) as u32).is_multiple_of(width)));
        }
    }
    Ok(())
}

#[test]
fn a_frame_buffer_takes_arrays_that_have_its_samples() {
    let screen = Screen { width: 16, height: 8 };
    let of = |columns, rows, samples| FrameBuffer { columns, rows, samples, screen }.checked();
    assert!(of(2, 4, 1).is_ok() && of(8, 8, 8).is_ok());
    let complaint = |columns, rows, samples| of(columns, rows, samples).unwrap_err().to_string();
    assert_eq!(complaint(2, 4, 2), "`samples` of `FrameBuffer` is 2: it has to be 1 or 8");
    let columns = "`columns` of `FrameBuffer` is 4: it has to be a power of two, from 8 to 256";
    assert_eq!(complaint(4, 8, 8), columns);
    let rows = "`rows` of `FrameBuffer` is 2: it has to be a power of two, from 4 to 256. There is a memory";
    assert!(complaint(2, 2, 1).starts_with(rows));
}
