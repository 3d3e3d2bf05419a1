//! A frame with its regions: each has the tint and the number of the renderer that drew it.

use tilewright_machines::pixel_planes::{Regions, Report};
use tilewright_report::palette;
use tilewright_scenes::frame::{rgb_of, word};
use tilewright_scenes::{Frame, PixelBox};

/// The digits from 0 to 9, of three by five squares: a row each, its leftmost square on top.
const DIGITS: [[u8; 5]; 10] = [
    [0b111, 0b101, 0b101, 0b101, 0b111],
    [0b010, 0b110, 0b010, 0b010, 0b111],
    [0b111, 0b001, 0b111, 0b100, 0b111],
    [0b111, 0b001, 0b111, 0b001, 0b111],
    [0b101, 0b101, 0b111, 0b001, 0b001],
    [0b111, 0b100, 0b111, 0b001, 0b111],
    [0b111, 0b100, 0b111, 0b101, 0b111],
    [0b111, 0b001, 0b001, 0b001, 0b001],
    [0b111, 0b101, 0b111, 0b101, 0b111],
    [0b111, 0b101, 0b111, 0b001, 0b111],
];

/// The renderer's share of a pixel's colour.
const TINT: f64 = 0.35;

/// The frame, tinted, with borders of regions and the numbers of their renderers.
pub fn owners(frame: &Frame, regions: &Regions, report: &Report) -> Frame {
    let mut picture = frame.clone();
    for it in &report.regions {
        let pixels = regions.pixels(it.region);
        let owner = palette::colour(it.renderer as u32);
        paint(&mut picture, pixels, |rgb| mix(rgb, owner, TINT));
        let PixelBox { left, top, right, bottom } = pixels;
        let square = (regions.side() / 24).max(1);
        let plate =
            PixelBox { left, top, right: right.min(left + 9 * square - 1), bottom: bottom.min(top + 7 * square - 1) };
        paint(&mut picture, plate, |_| mix(owner, [0; 3], 0.7));
        let place = PixelBox { left: left + square, top: top + square, ..plate };
        write(&mut picture, it.renderer, square, place, mix(owner, [255; 3], 0.8));
        for border in [PixelBox { bottom: top, ..pixels }, PixelBox { right: left, ..pixels }] {
            paint(&mut picture, border, |_| owner);
        }
    }
    picture
}

/// From one colour to another, `share` of the way.
fn mix(from: [u8; 3], to: [u8; 3], share: f64) -> [u8; 3] {
    [0, 1, 2].map(|part: usize| (f64::from(from[part]) * (1.0 - share) + f64::from(to[part]) * share).round() as u8)
}

fn paint(picture: &mut Frame, pixels: PixelBox, with: impl Fn([u8; 3]) -> [u8; 3]) {
    let PixelBox { left, top, right, bottom } = pixels;
    for (y, x) in (top..=bottom).flat_map(|y| (left..=right).map(move |x| (y, x))) {
        let pixel = picture.index(x, y);
        picture.words[pixel] = word(0, with(rgb_of(picture.words[pixel])));
    }
}

/// Writes a number into the upper left of a place, as far as it fits.
fn write(picture: &mut Frame, number: usize, square: u32, place: PixelBox, ink: [u8; 3]) {
    for (position, digit) in (0..).zip(number.to_string().bytes()) {
        for (row, bits) in (0..).zip(DIGITS[usize::from(digit - b'0')]) {
            for column in (0..3).filter(|column| bits >> (2 - column) & 1 == 1) {
                let (left, top) = (place.left + (4 * position + column) * square, place.top + row * square);
                let right = (left + square - 1).min(place.right);
                paint(picture, PixelBox { left, top, right, bottom: (top + square - 1).min(place.bottom) }, |_| ink);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_machines::Watch;
    use tilewright_machines::pixel_planes::{Config, Machine};
    use tilewright_scenes::{Scene, Size, project_polygons};

    /// Each region has its renderer's colour along its border, and no other. Its middle shows the frame.
    #[test]
    fn regions_have_their_renderers_colours() -> Result<(), Box<dyn std::error::Error>> {
        let scene = Scene::builtin("star").ok_or("a built-in scene")?;
        let polygons = project_polygons(&scene, Size::new(60, 44)?)?;
        let config = Config { renderers: 3, side: 16, ..Config::new(polygons.size) };
        let regions = config.regions()?;
        let (frame, report) = Machine::new(config)?.render(&polygons, scene.background, &mut Watch::default())?;
        let picture = owners(&frame, &regions, &report);
        assert_eq!(report.regions.len(), 12);
        for it in &report.regions {
            let PixelBox { left, top, right, bottom } = regions.pixels(it.region);
            let owner = palette::colour(it.renderer as u32);
            assert_eq!([picture.rgb(right, top), picture.rgb(left, bottom)], [owner; 2]);
            assert_eq!(picture.rgb(right, bottom), mix(frame.rgb(right, bottom), owner, TINT));
        }
        Ok(())
    }

    #[test]
    fn numbers_are_written_in_squares() {
        let mut picture = Frame::blank(Size::new(12, 8).expect("in range"), [0; 3]);
        write(&mut picture, 14, 1, PixelBox { left: 1, top: 1, right: 6, bottom: 11 }, [255; 3]);
        let rows =
            (0..8).map(|y| (0..12).map(|x| if picture.rgb(x, y) == [255; 3] { '#' } else { '.' }).collect::<String>());
        let expected = [
            "............",
            "..#..#......",
            ".##..#......",
            "..#..##.....",
            "..#.........",
            ".###........",
            "............",
            "............",
        ];
        assert_eq!(rows.collect::<Vec<_>>(), expected);
    }
}
