//! The unit that drew each pixel: a colour for each unit.

use tilewright_report::palette;
use tilewright_scenes::Frame;
use tilewright_scenes::frame::{rgb_of, word};

/// Where nothing was drawn.
pub const NOBODY: [u8; 3] = [38, 40, 44];

/// The lightness of a unit's colour: where the frame is black, as a part of that where it is white; and there, as a part of the palette's.
const DARKEST: f64 = 0.45;
const LIGHTEST: f64 = 1.2;

/// The lightness of the first pixels of a region, as a part of what it would be elsewhere.
const BORDER: f64 = 0.7;

/// A frame in the colours of units. For each pixel there is the number of the unit that drew it, if one did. Pixels at the left and upper borders of regions are
/// darker.
pub fn picture(frame: &Frame, owners: &[Option<u32>], region: Option<[u32; 2]>) -> Frame {
    let width = frame.size().width();
    let colour = |(number, (shown, owner)): (u32, (&u64, &Option<u32>))| match owner {
        None => word(0, NOBODY),
        Some(owner) => word(0, colour(*owner, rgb_of(*shown), is_border(number % width, number / width, region))),
    };
    let words = (0..).zip(frame.words.iter().zip(owners)).map(colour).collect();
    Frame::from_words(frame.size(), words).expect("a word for each pixel")
}

/// Whether a pixel is the first of a line or a column of a region.
pub fn is_border(x: u32, y: u32, region: Option<[u32; 2]>) -> bool {
    region.is_some_and(|[width, height]| x.is_multiple_of(width) || y.is_multiple_of(height))
}

/// The colour of a unit's pixel that has that colour in the frame.
pub fn colour(owner: u32, shown: [u8; 3], is_border: bool) -> [u8; 3] {
    let light = f64::from(shown.into_iter().max().unwrap_or(0)) / 255.0;
    let border = if is_border { BORDER } else { 1.0 };
    let share = border * (DARKEST + (LIGHTEST - DARKEST) * light);
    palette::colour(owner).map(|part| (f64::from(part) * share).round().min(255.0) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::Size;

    #[test]
    fn a_pixel_has_its_units_colour_as_light_as_it_is() {
        let size = Size::new(4, 1).expect("in range");
        let frame = Frame::from_words(size, [0, 255, 255, 9].map(|it| word(5, [it; 3])).to_vec()).expect("four words");
        let picture = picture(&frame, &[Some(2), Some(2), Some(3), None], Some([2, 1]));
        assert_eq!(picture.rgb(3, 0), NOBODY);
        assert_ne!(picture.rgb(1, 0), picture.rgb(2, 0));
        let [dark, light] = [0, 1].map(|x| picture.rgb(x, 0));
        assert!((0..3).all(|part| dark[part] < light[part]), "{dark:?} {light:?}");
        assert_eq!(light, colour(2, [255; 3], true));
        assert!([0, 1, 2].map(|x| picture.rgb(x, 0)).iter().all(|rgb| *rgb != NOBODY));
    }
}
