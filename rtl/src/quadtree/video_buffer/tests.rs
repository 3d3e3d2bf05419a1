//! The video buffer clock by clock, and against a list of words.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::format::Matrix;
use super::super::testing::small;
use super::*;

const EMPTY: u64 = (1 << WORD) - 1;
const IDLE: VideoBufferIn<u64> = VideoBufferIn {
    draw: Fragment { valid: 0, x: 0, y: 0, word: 0 },
    strict: 0,
    back: 0,
    scan: Scan { enable: 0, x: 0, y: 0, clear: 0 },
};

type Sim = Simulation<VideoBufferIn, VideoBufferOut>;

fn buffer(format: Format) -> Sim {
    let mut sim = Simulation::of(&VideoBuffer { format }).unwrap();
    sim.reset();
    sim
}

fn draw(x: u64, word: u64) -> VideoBufferIn<u64> {
    VideoBufferIn { draw: Fragment { valid: 1, x, y: 0, word }, ..IDLE }
}

#[test]
fn fragments_of_one_pixel_in_successive_clocks_are_compared_with_one_another() {
    let mut sim = buffer(small());
    let wave = sim.record(["draw_valid", "draw_x", "draw_word", "reads0", "old0", "write0", "word", "scan_enable"]);
    for inputs in [draw(1, 70), draw(1, 60), draw(1, 65), draw(2, 9), draw(1, 50), IDLE] {
        sim.drive(inputs);
        sim.step();
    }
    let scan = Scan { enable: 1, x: 1, y: 0, clear: 1 };
    // The pixel is read and cleared, and is read again in the next clock.
    for enable in [1, 1, 0] {
        sim.drive(VideoBufferIn { back: 1, scan: Scan { enable, ..scan }, ..IDLE });
        sim.step();
    }
    wave.expect(
        r"
        clk         |~~~~~~~\______/~~~~~~~\______/~~~~~~~\______/~~~~~~~\______/~~~~~~~\______/~~~~~~~\______/
        draw_valid  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______________
        draw_x      | 1                                          | 2            | 1            | 0            |
        draw_word   | 46           | 3c           | 41           | 9            | 32           | 0            |
        reads0      |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______________
        old0        | 0            | ffffffffffff | 46           | 3c           | ffffffffffff | 3c           |
        write0      |______________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\______________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        word        | 0            | ffffffffffff | 46           | 3c           | ffffffffffff | 3c           |
        scan_enable |__________________________________________________________________________________________

        clk         |~~~~~~~\______/~~~~~~~\______/~~~~~~~\______/
        draw_valid  |_____________________________________________
        draw_x      | 0                                          |
        draw_word   | 0                                          |
        reads0      |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______________
        old0        | 3c           | 32           | ffffffffffff |
        write0      |______________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        word        | 3c           | 32           | ffffffffffff |
        scan_enable |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______________
        ",
    );
}

#[test]
fn of_equal_depths_the_smaller_word_stays_or_strictly_the_first() {
    for (strict, kept) in [(0, 5 << 24 | 1), (1, 5 << 24 | 9)] {
        for wait in 0..3 {
            let mut sim = buffer(small());
            for word in [5 << 24 | 9, 5 << 24 | 1, 6 << 24] {
                sim.drive(VideoBufferIn { strict, ..draw(3, word) });
                sim.step();
                sim.drive(VideoBufferIn { strict, ..IDLE });
                (0..wait).for_each(|_| sim.step());
            }
            sim.drive(VideoBufferIn { strict, ..IDLE });
            sim.step();
            sim.drive(VideoBufferIn { back: 1, scan: Scan { enable: 1, x: 3, ..IDLE.scan }, ..IDLE });
            sim.step();
            assert_eq!(sim.get_u64(sim.o.word), kept, "strict {strict}, {wait} clocks between the fragments");
        }
    }
}

/// Both banks in software.
struct Model {
    words: [Vec<u64>; 2],
    columns: usize,
    sent: u64,
}

impl Model {
    fn clock(&mut self, VideoBufferIn { draw, strict, back, scan }: VideoBufferIn<u64>) {
        let place = |x: u64, y: u64| y as usize * self.columns + x as usize;
        if draw.valid == 1 {
            let kept = &mut self.words[back as usize][place(draw.x, draw.y)];
            let is_nearer = if strict == 1 { draw.word >> 24 < *kept >> 24 } else { draw.word < *kept };
            *kept = if is_nearer { draw.word } else { *kept };
        }
        if scan.enable == 1 {
            let shown = &mut self.words[1 - back as usize][place(scan.x, scan.y)];
            self.sent = *shown;
            *shown = if scan.clear == 1 { EMPTY } else { *shown };
        }
    }
}

/// Few addresses and few words, so that many fragments collide, and some agree in half of their bits.
fn step(columns: u32, rows: u32) -> impl Strategy<Value = (VideoBufferIn<u64>, bool)> {
    let flag = |probability| prop::bool::weighted(probability).prop_map(u64::from);
    let along = |count: u32| prop_oneof![4 => 0..u64::from(count.min(2)), 1 => 0..u64::from(count)];
    let place = move || (along(columns), along(rows));
    let half = || prop_oneof![4 => 0..3u64, 1 => Just(0xff_ffff)];
    let draw = (flag(0.7), place(), half(), half());
    let draw = draw.prop_map(|(valid, (x, y), z, rgb)| Fragment { valid, x, y, word: z << 24 | rgb });
    let scan = (flag(0.6), place(), flag(0.6)).prop_map(|(enable, (x, y), clear)| Scan { enable, x, y, clear });
    (draw, scan, prop::bool::weighted(0.06))
        .prop_map(|(draw, scan, swaps)| (VideoBufferIn { draw, scan, ..IDLE }, swaps))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// The word sent in every clock, with exchanges of the banks at any time, and all words at the end.
    #[test]
    fn it_keeps_the_nearer_word_of_each_pixel(
        (format, steps) in (1..20u32, 1..12u32).prop_flat_map(|(width, height)| {
            let matrix = Matrix::new(2, 1).unwrap();
            let format = Format::new(Screen { width, height }, matrix, 3).unwrap();
            (Just(format), prop::collection::vec(step(format.columns(), format.rows()), 1..200))
        }),
        strict in 0..2u64,
        seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&VideoBuffer { format }).unwrap().seeded(seed);
        sim.reset();
        let columns = format.columns() as usize;
        let words = vec![EMPTY; columns * format.rows() as usize];
        let mut model = Model { words: [words.clone(), words], columns, sent: 0 };
        let (mut back, mut sends) = (0, false);
        for (inputs, swaps) in steps {
            back ^= u64::from(swaps);
            sends &= !swaps;
            let inputs = VideoBufferIn { strict, back, ..inputs };
            sim.drive(inputs);
            sim.step();
            model.clock(inputs);
            sends |= inputs.scan.enable == 1;
            if sends {
                prop_assert_eq!(sim.get_u64(sim.o.word), model.sent);
            }
        }
        // A word is written in the clock after its address is read.
        sim.drive(VideoBufferIn { strict, back, ..IDLE });
        sim.step();
        for (bank, words) in model.words.iter().enumerate() {
            for (pixel, word) in (0..).zip(words) {
                let at = format.address(pixel % format.columns(), pixel / format.columns());
                prop_assert_eq!(sim.peek_memory(&format!("bank{bank}"), at), Ok(Bits::new(WORD, *word)), "pixel {}", pixel);
            }
        }
    }
}
