//! What a machine painted, as a picture and as an animation, alone or beside other machines.

use super::film::Film;
use super::label;
use super::owners::{self, NOBODY, is_border};
use tilewright_machines::{History, Write};
use tilewright_scenes::frame::{rgb_of, word};
use tilewright_scenes::{Frame, Size};

/// Images of an animation after the first one, which is empty; the time of each; and the time of the last one.
const IMAGES: u64 = 40;
const MILLISECONDS: u16 = 90;
const PAUSE: u16 = 2500;

/// The gap between two pictures, in pixels, and the colour of the background.
const GAP: u32 = 8;
const BEHIND: [u8; 3] = [22, 24, 27];

/// The colours of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paint {
    /// The colours of the frame.
    Frame,
    /// The colours of the units.
    Owners,
}

/// What a machine painted.
#[derive(Clone, Copy)]
pub struct Painted<'a> {
    pub history: &'a History,
    /// The frame that it gave.
    pub frame: &'a Frame,
    pub paint: Paint,
    /// The text above it.
    pub label: Option<&'a str>,
}

impl Painted<'_> {
    /// The finished picture.
    pub fn last(&self) -> Frame {
        match self.paint {
            Paint::Frame => self.frame.clone(),
            Paint::Owners => owners::picture(self.frame, &self.history.owners(), self.history.region),
        }
    }

    /// The picture before anything was painted.
    fn first(&self) -> Frame {
        let colour = if self.paint == Paint::Frame { self.history.background } else { NOBODY };
        Frame::blank(self.frame.size(), colour)
    }

    fn colour(&self, write: &Write) -> u64 {
        let (shown, width) = (rgb_of(write.word), self.frame.size().width());
        let border = is_border(write.pixel % width, write.pixel / width, self.history.region);
        match self.paint {
            Paint::Frame => word(0, shown),
            Paint::Owners => word(0, owners::colour(write.painter, shown, border)),
        }
    }

    /// The images, equally spaced in the machine's time from the first pixel to the last one. The last image is the finished picture.
    fn images(&self) -> Vec<Frame> {
        let writes = &self.history.writes;
        let begin = writes.first().map_or(0, |write| write.time);
        let end = writes.last().map_or(begin, |write| write.time);
        let (mut images, mut image, mut done) = (vec![self.first()], self.first(), 0);
        for number in 1..=IMAGES {
            let time = begin + (end - begin) * number / IMAGES;
            for write in writes[done..].iter().take_while(|write| write.time <= time) {
                image.words[write.pixel as usize] = self.colour(write);
                done += 1;
            }
            images.push(image.clone());
        }
        // No machine paints the cursor.
        *images.last_mut().expect("there are some") = self.last();
        images
    }
}

/// The pictures side by side, each below its label.
pub fn all_on_a_sheet(pictures: &[Painted]) -> Frame {
    let all: Vec<Frame> = pictures.iter().map(Painted::last).collect();
    placed(pictures, all.iter())
}

/// An animated PNG of all pictures being drawn. Each takes its own time, from its first pixel to its last.
pub fn animation(pictures: &[Painted]) -> Vec<u8> {
    let images: Vec<Vec<Frame>> = pictures.iter().map(Painted::images).collect();
    let image = |number: usize| placed(pictures, images.iter().map(|of_one| &of_one[number]));
    let mut film = Film::new(image(0), MILLISECONDS);
    for number in 1..=IMAGES {
        film.add(image(number as usize), if number == IMAGES { PAUSE } else { MILLISECONDS });
    }
    film.to_png()
}

/// A single picture as it is, or several in rows with their labels.
fn placed<'a>(pictures: &[Painted], images: impl Iterator<Item = &'a Frame>) -> Frame {
    let mut images = images.peekable();
    if let [Painted { label: None, .. }] = pictures {
        return images.next().expect("there is one").clone();
    }
    let size = images.peek().expect("there is one").size();
    let (all, columns) = sheet(size, pictures.len()).expect("it was looked at before");
    let mut sheet = Frame::blank(all, BEHIND);
    for ((number, image), picture) in (0..).zip(images).zip(pictures) {
        let head = head(size);
        let (left, top) = (GAP + number % columns * (size.width() + GAP), number / columns * (size.height() + head));
        for y in 0..size.height() {
            let (from, to) = (image.index(0, y), sheet.index(left, top + head + y));
            let width = size.width() as usize;
            sheet.words[to..to + width].copy_from_slice(&image.words[from..from + width]);
        }
        label::write(&mut sheet, [left, top + GAP / 2 + 2], size.width(), picture.label.unwrap_or_default());
    }
    sheet
}

/// The height above each picture of that size.
fn head(size: Size) -> u32 {
    label::height(size.width()) + GAP
}

/// The size of a sheet of `count` pictures, and the number of pictures in a row; `None` if the sheet would be too large. It has about as many rows as columns,
/// which suits narrow screens and wide ones.
pub fn sheet(size: Size, count: usize) -> Option<(Size, u32)> {
    let count = count as u32;
    let columns = (1..=count).find(|columns| columns * columns >= count).unwrap_or(1);
    let rows = count.div_ceil(columns);
    let width = columns * (size.width() + GAP) + GAP;
    Some((Size::new(width, rows * (size.height() + head(size)) + GAP).ok()?, columns))
}

#[cfg(test)]
mod tests {
    use super::super::film::tests::played;
    use super::*;
    use tilewright_machines::quadtree::{Config, Machine};
    use tilewright_machines::{Recorder, Watch};
    use tilewright_scenes::{Scene, project_polygons};

    /// Of a machine, in both colours.
    #[test]
    fn an_animation_begins_empty_and_ends_with_the_picture() -> Result<(), Box<dyn std::error::Error>> {
        let (scene, recorder) = (Scene::builtin("star").ok_or("a built-in scene")?, Recorder::default());
        let polygons = project_polygons(&scene, Size::new(32, 24)?)?;
        let config = Config { matrix: (2, 2), ..Config::for_packets(polygons.size, &polygons.polygons) };
        let mut machine = Machine::new(config)?.recorded(&recorder);
        let (frame, _) = machine.render(&polygons.polygons, scene.background, &mut Watch::default())?;
        let history = recorder.take().ok_or("a frame was rendered")?;
        for paint in [Paint::Frame, Paint::Owners] {
            let painted = Painted { history: &history, frame: &frame, paint, label: None };
            let images = played(&animation(&[painted]));
            let colours = |frame: Frame| -> Vec<[u8; 3]> { frame.words.iter().map(|word| rgb_of(*word)).collect() };
            assert_eq!((&images[0].0, images[0].1 % MILLISECONDS), (&colours(painted.first()), 0));
            let last = images.last().ok_or("there are some")?;
            assert_eq!(last, &(colours(painted.last()), PAUSE));
            let milliseconds: u32 = images.iter().map(|(_, milliseconds)| u32::from(*milliseconds)).sum();
            assert_eq!(milliseconds, 40 * u32::from(MILLISECONDS) + u32::from(PAUSE));
            // It grows: no pixel goes back to what it was before anything was drawn.
            let empty = colours(painted.first());
            let drawn = |image: &[[u8; 3]]| image.iter().zip(&empty).filter(|(now, before)| now != before).count();
            let counts: Vec<usize> = images.iter().map(|(image, _)| drawn(image)).collect();
            assert!(counts.is_sorted() && counts.len() > 10, "{counts:?}");
        }
        assert_eq!(
            all_on_a_sheet(&[Painted { history: &history, frame: &frame, paint: Paint::Frame, label: None }]),
            frame
        );
        Ok(())
    }

    #[test]
    fn pictures_are_in_about_as_many_rows_as_columns() {
        let columns = |width, height, count| {
            sheet(Size::new(width, height).expect("in range"), count).map(|(_, columns)| columns)
        };
        assert_eq!(columns(320, 240, 1), Some(1));
        assert_eq!(columns(320, 240, 2), Some(2));
        assert_eq!(columns(640, 480, 3), Some(2));
        assert_eq!(columns(640, 480, 4), Some(2));
        assert_eq!(columns(1280, 1024, 4), None);
        assert_eq!(columns(1280, 1024, 1), Some(1));
    }
}
