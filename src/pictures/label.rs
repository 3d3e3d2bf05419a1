//! Names above pictures, in letters of pixels.

use tilewright_scenes::Frame;
use tilewright_scenes::frame::word;

/// Width, spacing and height of a letter in dots; descenders are part of the height.
const WIDE: u32 = 5;
const BETWEEN: u32 = 1;
const HIGH: u32 = 9;
const INK: [u8; 3] = [214, 218, 224];

/// The letters of the machines' names, row by row, each row's leftmost pixel on top.
const LETTERS: [(char, [u8; HIGH as usize]); 21] = [
    ('-', [0, 0, 0, 0, 0b01110, 0, 0, 0, 0]),
    ('1', [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110, 0, 0]),
    ('5', [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110, 0, 0]),
    ('a', [0, 0, 0b01110, 0b00001, 0b01111, 0b10001, 0b01111, 0, 0]),
    ('c', [0, 0, 0b01110, 0b10001, 0b10000, 0b10001, 0b01110, 0, 0]),
    ('d', [0b00001, 0b00001, 0b01111, 0b10001, 0b10001, 0b10001, 0b01111, 0, 0]),
    ('e', [0, 0, 0b01110, 0b10001, 0b11111, 0b10000, 0b01110, 0, 0]),
    ('f', [0b00110, 0b01000, 0b11110, 0b01000, 0b01000, 0b01000, 0b01000, 0, 0]),
    ('i', [0b00100, 0, 0b01100, 0b00100, 0b00100, 0b00100, 0b01110, 0, 0]),
    ('l', [0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110, 0, 0]),
    ('n', [0, 0, 0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0, 0]),
    ('o', [0, 0, 0b01110, 0b10001, 0b10001, 0b10001, 0b01110, 0, 0]),
    ('p', [0, 0, 0b11110, 0b10001, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000]),
    ('q', [0, 0, 0b01111, 0b10001, 0b10001, 0b10001, 0b01111, 0b00001, 0b00001]),
    ('r', [0, 0, 0b10110, 0b11001, 0b10000, 0b10000, 0b10000, 0, 0]),
    ('s', [0, 0, 0b01111, 0b10000, 0b01110, 0b00001, 0b11110, 0, 0]),
    ('t', [0b01000, 0b01000, 0b11110, 0b01000, 0b01000, 0b01001, 0b00110, 0, 0]),
    ('u', [0, 0, 0b10001, 0b10001, 0b10001, 0b10011, 0b01101, 0, 0]),
    ('v', [0, 0, 0b10001, 0b10001, 0b10001, 0b01010, 0b00100, 0, 0]),
    ('w', [0, 0, 0b10001, 0b10001, 0b10101, 0b10101, 0b01010, 0, 0]),
    ('x', [0, 0, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001, 0, 0]),
];

fn letter(of: char) -> [u8; HIGH as usize] {
    let found = LETTERS.iter().find(|(letter, _)| *letter == of);
    found.map_or([0; HIGH as usize], |(_, rows)| *rows)
}

/// The side of a dot in pixels above a picture of that width: one for each 120. A telephone shows a picture half as
/// wide, and its name is still legible.
fn dot(room: u32) -> u32 {
    (room / 120).clamp(1, 4)
}

/// The pixels of a name's height above a picture of that width.
pub fn height(room: u32) -> u32 {
    HIGH * dot(room) + 3
}

/// Writes a machine's name above a picture of the width `room`, as far as it fits.
pub fn write(picture: &mut Frame, [left, top]: [u32; 2], room: u32, name: &str) {
    let dot = dot(room);
    for (number, rows) in (0..).zip(name.chars().map(letter)) {
        for (row, bits) in (0..).zip(rows) {
            for column in (0..WIDE).filter(|column| bits >> (WIDE - 1 - column) & 1 == 1) {
                let x = (number * (WIDE + BETWEEN) + column) * dot;
                for (dx, dy) in (0..dot).flat_map(|dx| (0..dot).map(move |dy| (dx, dy))).filter(|(dx, _)| x + dx < room)
                {
                    let pixel = picture.index(left + x + dx, top + row * dot + dy);
                    picture.words[pixel] = word(0, INK);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::ENTRANTS;
    use tilewright_scenes::Size;

    #[test]
    fn each_machine_has_all_letters_of_its_name() {
        for entrant in ENTRANTS {
            for it in entrant.machine.name().chars() {
                assert_ne!(letter(it), [0; HIGH as usize], "{it}");
            }
        }
    }

    #[test]
    fn a_name_is_written_as_far_as_there_is_room() {
        let mut picture = Frame::blank(Size::new(24, HIGH).expect("in range"), [0; 3]);
        write(&mut picture, [1, 0], 9, "vc1");
        let row = |y| (0..24).map(|x| if picture.rgb(x, y) == INK { '#' } else { '.' }).collect::<String>();
        assert_eq!(
            [2, 6].map(row),
            [".#...#..##..............", "...#....##.............."].map(|it: &str| it.to_owned())
        );
        let mut picture = Frame::blank(Size::new(240, height(240)).expect("in range"), [0; 3]);
        write(&mut picture, [0, 0], 240, "-");
        let inked: Vec<(u32, u32)> = (0..height(240))
            .flat_map(|y| (0..240).map(move |x| (x, y)))
            .filter(|(x, y)| picture.rgb(*x, *y) == INK)
            .collect();
        assert_eq!((inked.first(), inked.last(), inked.len()), (Some(&(2, 8)), Some(&(7, 9)), 12));
    }
}
