//! What the nodes of a machine have to do for a frame: the programs of each, region by region.

use std::sync::Arc;

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::fields::{Field, appearance, bank, gouraud, texture};
use tilewright_rtl::pixelflow::instruction::Instruction;
use tilewright_rtl::pixelflow::pixel::PixelProcessor;
use tilewright_rtl::pixelflow::programs::{self, Region, Shading, Words as Places};
use tilewright_scenes::deferred::{self, Pass};
use tilewright_scenes::{Frame, PixelBox, Polygons, Size, Texture};

use super::config::Config;
use super::constants::constants;
use super::hardware::Words;
use super::screen::Screen;
use crate::error::Error;

type Program = Vec<Instruction<u64>>;

/// Room for a new word.
const NEW: u64 = 0;
/// Where a shader keeps the words of the region that it shades.
const SHADED: u64 = 160;

/// What is to be done for a frame.
pub(super) struct Works {
    screen: Screen,
    size: Size,
    array: [u32; 2],
    /// Of each rasterizer, for each region.
    programs: Vec<Vec<Program>>,
    /// Of all shaders, for any region; none where colours are composed.
    shading: Option<Program>,
    /// What they look up.
    pub textures: Vec<Arc<Texture>>,
    /// Primitives of each rasterizer, and for each region those that are drawn there.
    pub primitives: Vec<usize>,
    pub drawn: Vec<usize>,
}

impl Works {
    /// Bytes of a colour.
    pub const COLOUR: u64 = 3;

    /// With deferred shading: appearance words of a pass, region by region.
    pub fn deferred(config: &Config, pass: &Pass, shader: &deferred::Shader) -> Result<Works, Error> {
        if config.shaders == 0 {
            return Err(ParameterError("no shaders: deferred shading takes at least one".to_owned()).into());
        }
        let mut works = Works::empty(config, config.roles()?.rasterizers)?;
        let (region, screen) = (works.region(config), works.screen);
        let boxes = pass.packets.iter().map(|packet| packet.triangle.bounds);
        works.deal(boxes, |number, place| {
            let (packet, corner) = (&pass.packets[number], screen.corner(place));
            let words = Places { kept: bank(place as u64 % 2), new: NEW };
            programs::appearance(region, words, &corner.edges(&packet.triangle), &corner.appearance(packet))
        });
        for program in works.programs.iter_mut().flat_map(|regions| regions.iter_mut().enumerate()) {
            let (place, program) = program;
            let number = place as u64 % 2;
            let word = bank(number);
            let before = [vec![programs::await_bank(number)], programs::clear(word, appearance::BYTES)].concat();
            let after = [programs::covered(word), vec![programs::give_bank(number)]].concat();
            *program = [before, std::mem::take(program), after].concat();
        }
        works.textures = shader.textures.clone();
        let shader = constants(shader);
        let shading = Shading { shader: &shader, word: SHADED, colour: bank(1) };
        works.shading = Some(
            [
                vec![programs::await_bank(0)],
                programs::move_word(bank(0), SHADED, appearance::BYTES),
                vec![programs::give_bank(0)],
                shading.before_texture(),
                shading.under_texture(),
                vec![programs::await_bank(1)],
                shading.after_texture(),
                vec![programs::give_bank(1)],
            ]
            .concat(),
        );
        Ok(works)
    }

    /// With all regions in the pixels' memory: words z || rgb.
    pub fn resident(config: &Config, polygons: &Polygons, background: [u8; 3]) -> Result<Works, Error> {
        let mut works = Works::empty(config, config.nodes - 1)?;
        let (places, scratch) = resident_words();
        if works.regions() > places.len() {
            let [width, height] = config.array;
            let (regions, most, bytes) = (works.regions(), places.len(), PixelProcessor::BYTES);
            return Err(ParameterError(format!(
                "a screen of {} pixels has {regions} regions of {width}x{height}, and the {bytes} bytes of a pixel have room for {most}, beside those \
                 that the network sees: take a smaller screen, or a system that works region by region",
                polygons.size
            ))
            .into());
        }
        let (region, screen) = (works.region(config), works.screen);
        let boxes = polygons.polygons.iter().map(|polygon| polygon.bounds);
        works.deal(boxes, |number, place| {
            let (polygon, corner) = (&polygons.polygons[number], screen.corner(place));
            let words = Places { kept: places[place], new: scratch };
            programs::gouraud(region, words, &corner.edges(polygon), &corner.surface(polygon))
        });
        for regions in &mut works.programs {
            let cleared = places[..regions.len()].iter().flat_map(|place| programs::clear_to(*place, background));
            let all: Program = cleared.chain(regions.iter_mut().flat_map(std::mem::take)).collect();
            for (place, program) in regions.iter_mut().enumerate() {
                let number = place as u64 % 2;
                let sent = [
                    vec![programs::await_bank(number)],
                    programs::move_word(places[place], bank(number), gouraud::BYTES),
                    vec![programs::give_bank(number)],
                ];
                *program = sent.concat();
            }
            regions[0].splice(..0, all);
        }
        Ok(works)
    }

    fn empty(config: &Config, rasterizers: u32) -> Result<Works, Error> {
        let size = config.size;
        let screen = config.screen()?;
        let programs = vec![vec![Vec::new(); screen.count()]; rasterizers as usize];
        let primitives = vec![0; rasterizers as usize];
        let drawn = vec![0; screen.count()];
        Ok(Works {
            screen,
            size,
            array: config.array,
            programs,
            shading: None,
            textures: Vec::new(),
            primitives,
            drawn,
        })
    }

    fn region(&self, config: &Config) -> Region {
        Region { size: self.array, edges: config.edges }
    }

    /// Deals primitives to rasterizers in turn, and their instructions to the regions that they meet.
    fn deal(&mut self, boxes: impl Iterator<Item = PixelBox>, draw: impl Fn(usize, usize) -> Program) {
        let rasterizers = self.programs.len();
        for (number, bounds) in boxes.enumerate() {
            self.primitives[number % rasterizers] += 1;
            for region in self.screen.of(&bounds) {
                let program = draw(number, region);
                self.drawn[region] += usize::from(!program.is_empty());
                self.programs[number % rasterizers][region].extend(program);
            }
        }
    }

    pub fn regions(&self) -> usize {
        self.screen.count()
    }

    /// Rasterizers.
    pub fn shares(&self) -> usize {
        self.programs.len()
    }

    pub fn is_shaded(&self) -> bool {
        self.shading.is_some()
    }

    /// Bytes of a word that is composed.
    pub fn bytes(&self) -> u64 {
        if self.is_shaded() { appearance::BYTES } else { gouraud::BYTES }
    }

    /// What a rasterizer does for a region.
    pub fn program(&self, rasterizer: usize, region: usize) -> &[Instruction<u64>] {
        &self.programs[rasterizer][region]
    }

    /// What a shader does for a region.
    pub fn shading(&self) -> &[Instruction<u64>] {
        self.shading.as_deref().unwrap_or(&[])
    }

    /// What it does before the first one: it has a bank for words.
    pub fn first_of_shader(&self) -> [Instruction<u64>; 1] {
        [programs::give_bank(0)]
    }

    /// What the holder of the frame does before the first one: it has two banks for what comes.
    pub fn first_of_holder(&self) -> [Instruction<u64>; 2] {
        [0, 1].map(programs::give_bank)
    }

    /// What it does for a region: what came goes to its texture port, where the frame buffer's memory is, and the bank is free when that has it.
    pub fn storing(&self, region: usize) -> Vec<Instruction<u64>> {
        let number = region as u64 % 2;
        [
            vec![programs::await_bank(number)],
            programs::move_word(bank(number), texture::UV[0].address, self.stored()),
            vec![programs::start_texture(), programs::await_texture(), programs::give_bank(number)],
        ]
        .concat()
    }

    /// Bytes of a word that comes to the holder of the frame.
    pub fn stored(&self) -> u64 {
        if self.is_shaded() { Works::COLOUR } else { self.bytes() }
    }

    /// An array's pixels in parts of the paper's.
    pub fn part_of_whole_array(&self) -> f64 {
        let [width, height] = self.array.map(f64::from);
        width * height / 8192.0
    }

    /// The frame, of what came of each region.
    pub fn picture(&self, came: &[Words]) -> Frame {
        let mut words = vec![0; self.size.pixels()];
        let (width, height) = (self.size.width(), self.size.height());
        let pixels = 2 * self.array[0] as usize;
        for (region, came) in came.iter().enumerate() {
            let [left, top] = self.screen.corner(region).0;
            for (y, x) in (0..self.array[1]).flat_map(|y| (0..self.array[0]).map(move |x| (y, x))) {
                if left + x >= width || top + y >= height {
                    continue;
                }
                let (chip, pixel) = (y / 2, (y % 2 * self.array[0] + x) as usize);
                let bytes = came[pixel..].iter().step_by(pixels).map(|lanes| byte(lanes, chip));
                words[((top + y) * width + left + x) as usize] = self.word(bytes);
            }
        }
        Frame::from_words(self.size, words).expect("there is a word of each pixel")
    }

    /// A pixel of its bytes: depth, a zero and a colour, or a colour alone, which is as far as can be.
    fn word(&self, bytes: impl Iterator<Item = u64>) -> u64 {
        let number = bytes.fold(0, |number, byte| number << 8 | byte);
        match self.is_shaded() {
            true => 0xff_ffff << 24 | number,
            false => number >> 32 << 24 | number & 0xff_ffff,
        }
    }
}

/// A byte of a row.
fn byte(lanes: &tilewright_sim::Bits, lane: u32) -> u64 {
    let lane = lane as usize;
    lanes.limbs()[lane / 8] >> (8 * (lane % 8)) & 0xff
}

/// Where the words of each region are, as many as have room beside the network's banks; and room for a new one.
fn resident_words() -> (Vec<u64>, u64) {
    let (bytes, registers) = (gouraud::BYTES, u64::from(PixelProcessor::REGISTERS));
    let memory = (0..registers / bytes).map(|number| number * bytes);
    let Field { address: free, .. } = texture::UV[0];
    let more = (0..(u64::from(PixelProcessor::BYTES) - free) / bytes).map(|number| free + number * bytes);
    let mut places: Vec<u64> = memory.chain(more).collect();
    let scratch = places.pop().expect("there are some");
    (places, scratch)
}

#[cfg(test)]
#[test]
fn there_is_room_for_as_many_regions_as_is_said() {
    let (places, scratch) = resident_words();
    assert_eq!(places.len(), Config::MOST_REGIONS);
    assert!(scratch + gouraud::BYTES <= PixelProcessor::BYTES.into());
}
