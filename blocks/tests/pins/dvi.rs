//! The DVI chip, by what its four serial pins send. The receiver here follows DVI 1.0, and knows nothing of the encoder.

use crate::examples::dvi::{Dvi, SERIAL};
use std::process::Command;
use tilewright_blocks::*;
use tilewright_gen::tools::skipped_without;
use tilewright_gen::verilog;
use tilewright_hdl::elaborate;
use tilewright_sim::Simulation;

/// The bits that each pin sends: blue, green, red and the clock.
type Sent = [Vec<bool>; 4];

/// What a receiver sees in one period of the clock of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Seen {
    Pixel([u8; 3]),
    Blank { hsync: bool, vsync: bool },
}

/// The symbols of control 0 to 3, as section 3.2.2 prints them: the bit that is sent first stands first.
const CONTROL: [&str; 4] = ["0010101011", "1101010100", "0010101010", "1101010101"];

fn control(symbol: &[bool]) -> Option<usize> {
    let text: String = symbol.iter().map(|bit| if *bit { '1' } else { '0' }).collect();
    CONTROL.iter().position(|known| *known == text)
}

/// Where symbols begin in a line: at eight symbols of control in a row. No pixels look like that.
fn alignment(line: &[bool]) -> usize {
    let begins = |at: usize| (0..8).all(|symbol| control(&line[at + 10 * symbol..][..10]).is_some());
    (0..line.len() - 80).find(|at| begins(*at)).expect("a line sends control") % 10
}

/// The byte of a symbol: figure 3-6.
fn byte(symbol: &[bool]) -> u8 {
    let word: Vec<bool> = symbol[..8].iter().map(|bit| bit ^ symbol[9]).collect();
    let bit = |place: usize| match place {
        0 => word[0],
        _ => word[place] ^ word[place - 1] ^ !symbol[8],
    };
    (0..8).map(|place| u8::from(bit(place)) << place).sum()
}

/// What the lines show, from their first whole symbol on.
fn received(sent: &Sent) -> Vec<Seen> {
    // The lines are low until the first symbol.
    let begin = sent[3].iter().position(|bit| *bit).unwrap();
    let sent = sent.each_ref().map(|line| &line[begin..]);
    let start = alignment(sent[0]);
    assert!(sent[..3].iter().all(|line| alignment(line) == start), "symbols begin together");
    let symbols = |line: usize| sent[line][start..].chunks_exact(10);
    assert!(symbols(3).all(|clock| clock == [true, true, true, true, true, false, false, false, false, false]));
    let see = |((blue, green), red)| match [blue, green, red].map(control) {
        [None, None, None] => Seen::Pixel([red, green, blue].map(byte)),
        [Some(code), Some(0), Some(0)] => Seen::Blank { hsync: code & 1 == 1, vsync: code & 2 == 2 },
        mixed => panic!("pixels in some lines and control in others: {mixed:?}"),
    };
    symbols(0).zip(symbols(1)).zip(symbols(2)).map(see).collect()
}

/// Runs of equal parts: each with its length.
fn runs<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<(T, usize)> {
    let mut runs: Vec<(T, usize)> = Vec::new();
    for part in all {
        match runs.last_mut() {
            Some((last, count)) if *last == part => *count += 1,
            _ => runs.push((part, 1)),
        }
    }
    runs
}

/// A part of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Visible,
    Porch,
    Pulse,
}

/// The horizontal parts; both pulses are low.
fn across(seen: &[Seen]) -> Vec<(Part, usize)> {
    runs(seen.iter().map(|it| match it {
        Seen::Pixel(_) => Part::Visible,
        Seen::Blank { hsync: true, .. } => Part::Porch,
        Seen::Blank { hsync: false, .. } => Part::Pulse,
    }))
}

fn is_in_vsync(seen: &Seen) -> bool {
    matches!(seen, Seen::Blank { vsync: false, .. })
}

/// What the picture is meant to be.
fn expected(x: usize, y: usize, frame: usize) -> [u8; 3] {
    let is_white = (x / 32 + y / 32) % 2 == 1;
    let bar = (x + frame) / 64;
    let full = |bit: usize| if bar >> bit & 1 == 1 { 255 } else { 0 };
    if is_white { [full(0), full(1), full(2)] } else { [(x % 256) as u8, (y % 256) as u8, 128] }
}

/// What a simulation sends. At an edge upwards the pin of the model has the first bit, and its register the second one.
fn simulated(chip: &Dvi, clocks: usize) -> Sent {
    let mut sim = Simulation::of(chip).unwrap().seeded(5);
    let mut sent = Sent::default();
    for _ in 0..clocks {
        sim.step_clock(SERIAL, 1);
        let first = sim.lanes(sim.o.tmds);
        for (lane, line) in sent.iter_mut().enumerate() {
            let second = sim.peek(&format!("u_tmds[{lane}].second")).unwrap();
            line.extend([first[lane] == 1, second == 1]);
        }
    }
    assert_eq!(sim.get(sim.o.locked), 1);
    sent
}

const COLUMNS: usize = 72;
const ROWS: usize = 40;
/// A line and a frame of the small screen.
const LINE: usize = COLUMNS + 3 + 5 + 4;
const FRAME: usize = LINE * (ROWS + 2 + 2 + 3);

#[test]
fn a_receiver_sees_the_picture_pixel_for_pixel() {
    let columns = Scan::new(COLUMNS as u32, [3, 5, 4], false);
    let small = Dvi::new(VideoTiming { columns, rows: Scan::new(ROWS as u32, [2, 2, 3], false) });
    let seen = received(&simulated(&small, 5 * (3 * FRAME + LINE)));
    // A frame begins behind the pulse and the back porch: the first one that is whole is number 1.
    let begins: Vec<usize> =
        (1..seen.len()).filter(|at| is_in_vsync(&seen[at - 1]) && !is_in_vsync(&seen[*at])).collect();
    let of_vsync: Vec<usize> =
        runs(seen.iter().map(is_in_vsync)).into_iter().filter(|run| run.0).map(|run| run.1).collect();
    assert_eq!((begins[1] - begins[0], of_vsync[0]), (FRAME, 2 * LINE));
    for frame in [1, 2] {
        let lines: Vec<&[Seen]> = seen[begins[frame - 1]..]
            .split(|it| matches!(it, Seen::Blank { .. }))
            .filter(|line| !line.is_empty())
            .take(ROWS)
            .collect();
        assert!(lines.len() == ROWS && lines.iter().all(|line| line.len() == COLUMNS));
        for (y, line) in lines.iter().enumerate() {
            for (x, pixel) in line.iter().enumerate() {
                assert_eq!(*pixel, Seen::Pixel(expected(x, y, frame)), "x {x}, y {y}, frame {frame}");
            }
        }
    }
    // Lines 40 to 46 show nothing, and the pulse of the frame begins with one of a line, 2 lines behind the last visible.
    let ends = |at: usize| seen[..at].iter().rposition(|it| matches!(it, Seen::Pixel(_))).unwrap();
    let vsync = begins[1] - 2 * LINE;
    assert!(is_in_vsync(&seen[vsync]) && matches!(seen[vsync], Seen::Blank { hsync: false, .. }));
    assert_eq!(vsync - ends(vsync), 2 * LINE + 3 + 1);
}

/// VESA's numbers of 640 x 480 at 60 Hz: front porch 16, pulse 96, back porch 48, both pulses low.
fn has_lines_of_vga(seen: &[Seen]) {
    let parts = across(seen);
    let first = parts.iter().position(|(part, _)| *part == Part::Pulse).unwrap();
    let line = [(Part::Pulse, 96), (Part::Porch, 48), (Part::Visible, 640), (Part::Porch, 16)];
    assert_eq!(parts[first..][..8], [line, line].concat());
    let visible = seen.split(|it| matches!(it, Seen::Blank { .. })).filter(|line| !line.is_empty());
    for (y, line) in visible.enumerate().skip(1).take(2) {
        let wanted = (0..640).map(|x| Seen::Pixel(expected(x, y, 0)));
        assert!(line.iter().copied().eq(wanted), "line {y}");
    }
}

#[test]
fn the_lines_have_the_parts_of_vga() {
    has_lines_of_vga(&received(&simulated(&Dvi::VGA, 5 * 800 * 4)));
}

/// The cells of an ECP5 as far as the chip uses them, and a bench that prints what is at the pins in the middle of each bit.
const BENCH: &str = include_str!("dvi_bench.v");

#[test]
fn the_verilog_without_models_sends_the_same_at_both_edges() {
    if skipped_without(&["iverilog", "vvp"]).is_some() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let text: String = verilog(&elaborate(&Dvi::VGA).unwrap()).into_iter().map(|file| file.text).collect();
    std::fs::write(folder.path().join("all.v"), text + BENCH).unwrap();
    let run = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).current_dir(folder.path()).output().unwrap();
        String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned()
    };
    assert_eq!(run("iverilog", &["-g2005", "-s", "bench", "-o", "bench.vvp", "all.v"]), "");
    let printed = run("vvp", &["-n", "bench.vvp"]);
    let nibbles: Vec<u32> =
        printed.trim().trim_start_matches('X').chars().map(|digit| digit.to_digit(16).expect(&printed)).collect();
    let line = |lane: usize| nibbles.iter().map(|nibble| nibble >> lane & 1 == 1).collect();
    has_lines_of_vga(&received(&std::array::from_fn(line)));
}
