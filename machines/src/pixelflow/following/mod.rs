//! The way of a pixel through the machine: the units of each node and of the network, beside plain models that get the hardware's inputs of the unit.

mod array;
mod commands;
mod network;
mod store;
mod texture;

use std::collections::BTreeMap;

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_sim::{Bundle, Simulation};

pub(super) use array::{ArrayObserver, Place};
pub(super) use network::NetworkObserver;
pub(super) use store::StoreObserver;
pub(super) use texture::TextureObserver;

use super::costs::Ticks;
use super::works::Works;
use crate::error::Error;
use crate::told::{Told, Unit, compared, value};
use crate::way::{Primitive, Step, Way};

/// What observes a simulated unit in each clock, as far as it is about one pixel.
pub(super) trait Observer<I: Bundle, O: Bundle> {
    /// Notes the tick of the network.
    fn now(&mut self, tick: Ticks);

    /// Looks at the unit before the edge of a clock.
    fn look(&mut self, sim: &mut Simulation<I, O>);

    /// Tells an error that nothing told before.
    fn fail(&mut self, error: &Error);

    /// What it has told.
    fn told(&mut self) -> &mut Told;
}

/// The simulations beside those of arrays.
pub(super) const FRAME_BUFFER: &str = "frame buffer";

/// The texture unit of the node of that name.
pub(super) fn texture_unit_of(name: &str) -> String {
    format!("texture unit of {name}")
}

/// One of several simulations of the network, which compose different turns.
pub(super) fn network(number: usize) -> String {
    format!("network {number}")
}

/// What banks do with words.
pub(super) const GETS: &str = "gets the word from the network";
pub(super) const SENDS: &str = "has sent the word to the network";

/// The pixel that is followed, on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    /// Its number in the picture.
    pub number: usize,
    pub region: usize,
    pub place: Place,
}

/// What the units say of the pixel at the end.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub steps: Vec<Step>,
    /// The words that rasterizers drew, by primitive.
    pub drawn: BTreeMap<usize, u64>,
}

impl Pixel {
    /// The first place of the pixel at that column and line of the picture, if the machine draws it.
    pub fn new(works: &Works, [x, y]: [u32; 2]) -> Option<Pixel> {
        let size = works.size();
        if x >= size.width() || y >= size.height() {
            return None;
        }
        let number = (y * size.width() + x) as usize;
        let columns = works.pixels_of_chip() as u32 / 2;
        let mut all = (0..works.regions()).flat_map(|region| (0..works.pixels_of_array()).map(move |at| (region, at)));
        all.find_map(|(region, at)| {
            let (chip, pixel) = works.place_in_chip(at);
            let pixel_of_chip = pixel as u32;
            let at = [pixel_of_chip % columns, 2 * chip + pixel_of_chip / columns];
            let place = Place { chip, pixel: pixel_of_chip, at };
            (works.pixel(region, chip, pixel) == Some(number)).then_some(Pixel { number, region, place })
        })
    }

    /// The sample of the drawn picture that is followed.
    pub fn sample(&self, works: &Works) -> [u32; 2] {
        let [left, top] = works.corner(self.region);
        let [x, y] = self.place.at;
        [left + x, top + y]
    }

    /// The observer of the array of the node of that name.
    pub fn of_array(&self, name: &str, array: &PixelArray, side_by_side: bool) -> ArrayObserver {
        ArrayObserver::new(name, array, side_by_side, self.place)
    }

    /// The observer of the frame buffer.
    ///
    /// # Errors
    /// There is no such frame buffer.
    pub fn of_store(&self, works: &Works) -> Result<StoreObserver, ParameterError> {
        Ok(StoreObserver::new(&works.frame_buffer()?, self.place, self.region, self.number))
    }
}

/// The number of primitives, and for each that covers a sample of the drawn picture, its word, z || rgb, and all bytes of it, the most significant first.
pub(super) type Words<'a> = (usize, &'a dyn Fn(usize, [u32; 2]) -> Option<(u64, Vec<u8>)>);

/// What a shader has to make of a word's bytes, as software shades, unless it shades several words at once; nothing for a material that is not there.
pub(super) type Light<'a> = Option<&'a dyn Fn([u8; 21]) -> Option<[u8; 3]>>;

/// The step of a shader: the colour that it gives, beside what software makes of the word that it got.
fn lit(steps: &[Step], light: Light) -> Option<Step> {
    let word = |does: &str| {
        let is_it = |step: &&Step| step.does == does && step.unit.contains(" of shader ");
        let step = steps.iter().find(is_it)?;
        Some((step, step.values.first()?.hardware.as_str()))
    };
    let ((_, got), (sent, colour)) = (word(GETS)?, word(SENDS)?);
    let mut bytes = [0; 21];
    for (number, byte) in bytes.iter_mut().enumerate() {
        *byte = u8::from_str_radix(got.get(2 * number..2 * number + 2)?, 16).ok()?;
    }
    let [red, green, blue] = light?(bytes)?;
    let right = format!("{red:02x}{green:02x}{blue:02x}");
    let (_, name) = sent.unit.split_once(" of ")?;
    let does = "has made the colour of the word: texels, light and highlights".to_owned();
    let values = vec![compared("colour", colour, &right)];
    Some(Step { unit: name.to_owned(), block: "pixelflow-node", does, net: None, values, ..sent.clone() })
}

/// The way of a pixel with those primitives at its sample, and the word that the machine shows.
pub(super) fn way(found: Found, words: Words, light: Light, sample: [u32; 2], shown: Option<u64>) -> Way {
    let (count, word) = words;
    let golden: Vec<_> = (0..count).map(|number| word(number, sample)).collect();
    let covered = golden.iter().enumerate().filter_map(|(number, word)| Some((word.as_ref()?.1.clone(), number)));
    let winner = covered.min().map(|(_, number)| number);
    let primitive = |(number, word): (usize, Option<(u64, Vec<u8>)>)| {
        let (golden, hardware) = (word.map(|(word, _)| word), found.drawn.get(&number).copied());
        let name = format!("primitive {number}");
        let is_here = golden.is_some() || hardware.is_some();
        is_here.then_some(Primitive { number, name, golden, hardware, wins: Some(number) == winner })
    };
    let primitives: Vec<Primitive> = golden.into_iter().enumerate().filter_map(primitive).collect();
    let is_told = |step: &Step| {
        step.differs() || step.primitive.is_none_or(|number| primitives.iter().any(|it| it.number == number))
    };
    let mut steps: Vec<Step> = found.steps.into_iter().filter(is_told).collect();
    // Stable: steps at the same time keep their sequence.
    steps.sort_by_key(|step| step.time);
    if let Some(lit) = lit(&steps, light) {
        let behind = steps.partition_point(|step| step.time <= lit.time);
        steps.insert(behind, lit);
    }
    if let Some(shown) = shown {
        let unit = Unit::new("picture", "pixelflow", ("network", 5000), "");
        let cycle = steps.last().map_or(0, |step| step.time / 5000) + 1;
        steps.push(unit.step(
            cycle,
            None,
            "has the pixel",
            vec![value("colour", format!("{:06x}", shown & 0xff_ffff))],
        ));
    }
    Way { primitives, steps }
}

#[cfg(test)]
mod tests;
