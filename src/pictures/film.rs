//! An animated PNG. Each image contains only what differs from the one before.

use png::{AdaptiveFilterType, BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, FilterType};
use tilewright_scenes::{Frame, Size};

/// The images to write.
pub struct Film {
    size: Size,
    /// The last image.
    shown: Frame,
    images: Vec<Image>,
}

/// The difference between two images.
struct Image {
    /// The distance from the left and from the top, and the size.
    at: [u32; 2],
    size: [u32; 2],
    /// Red, green, blue, and whether it changes.
    pixels: Vec<u8>,
    /// The time for which it is shown.
    milliseconds: u16,
}

impl Film {
    /// An animation that begins with that image.
    pub fn new(first: Frame, milliseconds: u16) -> Film {
        let size = first.size();
        let pixels = first.rgb_bytes().chunks(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 255]).collect();
        let image = Image { at: [0; 2], size: [size.width(), size.height()], pixels, milliseconds };
        Film { size, shown: first, images: vec![image] }
    }

    /// Appends another image of that size. If nothing changes, the one before is shown longer.
    pub fn add(&mut self, next: Frame, milliseconds: u16) {
        match self.change(&next, milliseconds) {
            Some(image) => self.images.push(image),
            None => self.images.last_mut().into_iter().for_each(|last| last.milliseconds += milliseconds),
        }
        self.shown = next;
    }

    /// The smallest box that contains all changes.
    fn change(&self, next: &Frame, milliseconds: u16) -> Option<Image> {
        let width = self.size.width();
        let differs = |x: u32, y: u32| self.shown.rgb(x, y) != next.rgb(x, y);
        let is_line = |y: &u32| (0..width).any(|x| differs(x, *y));
        let (top, bottom) = (0..self.size.height()).filter(is_line).fold(None, ends)?;
        let is_column = |x: &u32| (top..=bottom).any(|y| differs(*x, y));
        let (left, right) = (0..width).filter(is_column).fold(None, ends)?;
        let place = (top..=bottom).flat_map(|y| (left..=right).map(move |x| (x, y)));
        let pixels = place.flat_map(|(x, y)| match (differs(x, y), next.rgb(x, y)) {
            (true, [red, green, blue]) => [red, green, blue, 255],
            (false, _) => [0; 4],
        });
        Some(Image {
            at: [left, top],
            size: [right - left + 1, bottom - top + 1],
            pixels: pixels.collect(),
            milliseconds,
        })
    }

    /// The bytes of the file. The animation repeats after the last image. A viewer without animations shows the last image.
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.encode(&mut bytes).expect("a PNG fits in memory, and all parts are of its size");
        bytes
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), png::EncodingError> {
        let mut encoder = Encoder::new(bytes, self.size.width(), self.size.height());
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Best);
        encoder.set_filter(FilterType::Paeth);
        encoder.set_adaptive_filter(AdaptiveFilterType::Adaptive);
        encoder.set_animated(self.images.len() as u32, 0)?;
        encoder.set_sep_def_img(true)?;
        encoder.set_dispose_op(DisposeOp::None)?;
        encoder.set_blend_op(BlendOp::Over)?;
        let mut writer = encoder.write_header()?;
        let last: Vec<u8> = self.shown.rgb_bytes().chunks(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 255]).collect();
        writer.write_image_data(&last)?;
        for Image { at: [left, top], size: [width, height], pixels, milliseconds } in &self.images {
            writer.reset_frame_position()?;
            writer.set_frame_dimension(*width, *height)?;
            writer.set_frame_position(*left, *top)?;
            writer.set_frame_delay(*milliseconds, 1000)?;
            writer.write_image_data(pixels)?;
        }
        writer.finish()
    }
}

/// The first and the last of what comes.
fn ends(before: Option<(u32, u32)>, next: u32) -> Option<(u32, u32)> {
    Some((before.map_or(next, |(first, _)| first), next))
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use tilewright_scenes::frame::word;

    /// The images of an animated PNG as a viewer shows them, with the milliseconds of each.
    pub fn played(bytes: &[u8]) -> Vec<(Vec<[u8; 3]>, u16)> {
        let mut reader = png::Decoder::new(bytes).read_info().expect("a PNG file");
        let (width, count) =
            (reader.info().width as usize, reader.info().animation_control().expect("it is animated").num_frames);
        let mut buffer = vec![0; reader.output_buffer_size()];
        reader.next_frame(&mut buffer).expect("the default image");
        let mut canvas = vec![[0; 3]; buffer.len() / 4];
        let mut image = || {
            let read = reader.next_frame(&mut buffer).expect("an image");
            let control = *reader.info().frame_control().expect("it has a place");
            for (number, pixel) in buffer[..read.buffer_size()].chunks(4).enumerate() {
                let (x, y) = (number % read.width as usize, number / read.width as usize);
                if pixel[3] > 0 {
                    canvas[(control.y_offset as usize + y) * width + control.x_offset as usize + x] =
                        [pixel[0], pixel[1], pixel[2]];
                }
            }
            (canvas.clone(), control.delay_num)
        };
        (0..count).map(|_| image()).collect()
    }

    #[test]
    fn images_are_what_they_were() {
        let size = Size::new(5, 3).expect("in range");
        let image = |lit: &[usize]| {
            let words =
                (0..15).map(|it| word(0, if lit.contains(&it) { [200, it as u8, 7] } else { [0; 3] })).collect();
            Frame::from_words(size, words).expect("a word for each pixel")
        };
        let images = [image(&[]), image(&[7]), image(&[7]), image(&[7, 11, 14])];
        let mut film = Film::new(images[0].clone(), 10);
        images[1..].iter().for_each(|it| film.add(it.clone(), 20));
        let bytes = film.to_png();
        let colours = |frame: &Frame| {
            (0..3).flat_map(|y| (0..5).map(move |x| (x, y))).map(|(x, y)| frame.rgb(x, y)).collect::<Vec<_>>()
        };
        let expected: Vec<_> =
            [(0, 10), (1, 40), (3, 20)].iter().map(|&(at, time): &(usize, u16)| (colours(&images[at]), time)).collect();
        assert_eq!(played(&bytes), expected);
        assert_eq!(bytes, film.to_png());
    }
}
