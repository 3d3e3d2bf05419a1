//! What the nodes of a machine have to do for a frame: the programs of each, turn by turn.
//!
//! In a turn the rasterizers draw one sample of a region, and the network composes it. How turns follow each other:
//!
//! | frame | turns |
//! |---|---|
//! | one sample | all regions |
//! | eight, each shaded | four of them are side by side, so a region has a quarter of the pixels: both renderings of the first one, then of the second ..; the frame buffer averages |
//! | eight, shaded once | all samples of the first region, then all of the second ..: those of a pixel come to one shader |
//! | eight, in the pixels' memory | all regions of the first sample, then all of the second ..; the frame's holder adds up |

mod deferred;
mod front_end;
mod picture;
mod places;
mod resident;
mod samples;

use std::convert::Infallible;
use std::sync::Arc;

use tilewright_rtl::parameter::{self, ParameterError};
use tilewright_rtl::pixelflow::fields::{appearance, bank, gouraud, texture};
use tilewright_rtl::pixelflow::frame_buffer::FrameBuffer;
use tilewright_rtl::pixelflow::instruction::Instruction;
use tilewright_rtl::pixelflow::programs::{self, Region};
use tilewright_scenes::{PixelBox, Size, Texture};

use super::config::Config;
use super::costs::Ticks;
use super::screen::{Pattern, Screen};
use crate::threads::each_mut;

pub(super) use front_end::Mark;
pub(super) use resident::Drawing;
use samples::Samples;

type Program = Vec<Instruction<u64>>;

/// How many programs are made one after another.
const SHARE: usize = 64;
/// Room for a new word.
const NEW: u64 = 0;

/// What is to be done for a frame.
pub(super) struct Works {
    /// What is drawn, a region in each turn: one sample of each pixel, or four side by side.
    screen: Screen,
    array: [u32; 2],
    samples: Samples,
    /// Of each rasterizer, for each turn.
    programs: Vec<Vec<Program>>,
    /// Of each rasterizer, for each turn, where in the program the instructions of which primitive begin; and from when on the front end has them, if it makes them one
    /// by one.
    starts: Vec<Vec<Vec<(usize, usize)>>>,
    marks: Vec<Vec<Vec<Mark>>>,
    /// The tick from which on it has all instructions of all rasterizers; 0 if they are there before the frame.
    pub made: Ticks,
    /// Of all shaders, for each of the turns of any region; none where colours are composed.
    shading: Vec<Program>,
    /// What they look up.
    pub textures: Vec<Arc<Texture>>,
    /// Primitives of each rasterizer, and how many are drawn in all turns.
    pub primitives: Vec<usize>,
    pub drawn: usize,
}

impl Works {
    /// Bytes of a colour.
    pub const COLOUR: u64 = 3;
    /// Where the frame buffer looks for it.
    const SHOWN: u64 = texture::UV[0].address;

    fn empty(config: &Config, rasterizers: u32, samples: Samples) -> Result<Works, ParameterError> {
        let screen = config.screen()?;
        let turns = screen.count() * samples.together() * samples.rounds();
        Ok(Works {
            screen,
            array: config.array,
            samples,
            programs: vec![vec![Vec::new(); turns]; rasterizers as usize],
            starts: vec![vec![Vec::new(); turns]; rasterizers as usize],
            marks: vec![vec![Vec::new(); turns]; rasterizers as usize],
            made: 0,
            shading: Vec::new(),
            textures: Vec::new(),
            primitives: vec![0; rasterizers as usize],
            drawn: 0,
        })
    }

    fn hardware(&self, config: &Config) -> Region {
        Region { size: self.array, edges: config.edges }
    }

    /// Deals primitives to rasterizers in turn, and the instructions of one sample to the turns of the regions that they meet.
    fn deal(
        &mut self,
        sample: usize,
        screen: &Screen,
        boxes: impl Iterator<Item = PixelBox>,
        turn: impl Fn(usize) -> usize,
        draw: impl Fn(usize, usize) -> Program + Sync,
    ) {
        let rasterizers = self.programs.len();
        let mut met: Vec<Met> = Vec::new();
        for (number, bounds) in boxes.enumerate() {
            // The same ones for each sample.
            self.primitives[number % rasterizers] += usize::from(sample == 0);
            let regions = screen.of(&bounds).into_iter();
            met.extend(regions.map(|region| Met { number, region, program: Program::new() }));
        }
        draw_each(&mut met, draw);
        for Met { number, region, program } in met {
            self.drawn += usize::from(!program.is_empty());
            let (rasterizer, turn) = (number % rasterizers, turn(region));
            let all = &mut self.programs[rasterizer][turn];
            self.starts[rasterizer][turn].push((all.len(), number));
            all.extend(program);
        }
    }

    /// Instructions go before those of a turn.
    fn put_before(&mut self, rasterizer: usize, turn: usize, before: Program) {
        self.starts[rasterizer][turn].iter_mut().for_each(|(place, _)| *place += before.len());
        self.programs[rasterizer][turn].splice(..0, before);
    }

    /// Pixels of the frame.
    pub fn size(&self) -> Size {
        let drawn = self.screen.size();
        if !self.is_side_by_side() {
            return drawn;
        }
        Size::new(drawn.width() / 2, drawn.height() / 2).expect("it is twice a size")
    }

    /// The circuit that holds the frame.
    ///
    /// # Errors
    /// There is none.
    pub fn frame_buffer(&self) -> Result<FrameBuffer, ParameterError> {
        let of = if self.is_side_by_side() { FrameBuffer::of_eight_samples } else { FrameBuffer::new };
        let size = self.size();
        of(self.array, parameter::Screen::new(size.width(), size.height())?)
    }

    /// Samples of a pixel.
    pub fn samples(&self) -> u32 {
        self.samples.count()
    }

    /// Whether four samples of a pixel are side by side, and the frame buffer averages them and those of another rendering.
    pub fn is_side_by_side(&self) -> bool {
        self.samples == Samples::SideBySide
    }

    pub fn regions(&self) -> usize {
        self.screen.count()
    }

    pub fn turns(&self) -> usize {
        self.regions() * self.together() * self.samples.rounds()
    }

    /// The region that is drawn in a turn.
    pub fn region(&self, turn: usize) -> usize {
        turn / self.together() % self.regions()
    }

    /// Turns that a region has one after another.
    fn together(&self) -> usize {
        self.samples.together()
    }

    /// Which of the words that are shaded, or stored, a turn belongs to.
    fn word(&self, turn: usize) -> usize {
        if self.shades_once() { turn / self.together() } else { turn }
    }

    /// Which of so many shaders takes what is composed.
    pub fn shader_of(&self, turn: usize, shaders: usize) -> Option<usize> {
        self.word(turn).checked_rem(shaders)
    }

    /// Whether a turn is the last of its region: then the frame buffer gets it.
    pub fn ends(&self, turn: usize) -> bool {
        let round = turn / (self.regions() * self.together());
        turn % self.together() + 1 == self.together() && round + 1 == self.samples.rounds()
    }

    /// Whether a shader has all samples of a region before it shades.
    pub fn shades_once(&self) -> bool {
        self.samples == Samples::ShadedOnce
    }

    /// Whether the frame's holder adds up what comes.
    pub fn adds(&self) -> bool {
        self.samples == Samples::InMemory
    }

    /// Rasterizers.
    pub fn shares(&self) -> usize {
        self.programs.len()
    }

    pub fn is_shaded(&self) -> bool {
        !self.shading.is_empty()
    }

    /// Whether the holder of the frame gets depths, with the colours of one sample.
    pub fn has_depths(&self) -> bool {
        !self.is_shaded() && !self.adds()
    }

    /// Bytes of a word that is composed.
    pub fn bytes(&self) -> u64 {
        if self.is_shaded() { appearance::BYTES } else { gouraud::BYTES }
    }

    /// What a rasterizer does in a turn.
    pub fn program(&self, rasterizer: usize, turn: usize) -> &[Instruction<u64>] {
        &self.programs[rasterizer][turn]
    }

    /// From when on it can.
    pub fn marks(&self, rasterizer: usize, turn: usize) -> &[Mark] {
        &self.marks[rasterizer][turn]
    }

    /// What a shader does in a turn; it ends with colours if [some come](Works::comes_to_holder), or else with the room for the next words.
    pub fn shading(&self, turn: usize) -> &[Instruction<u64>] {
        &self.shading[turn % self.shading.len()]
    }

    /// What it does before the first one: it has a bank for words.
    pub fn first_of_shader() -> [Instruction<u64>; 1] {
        [programs::give_bank(0)]
    }

    /// What the holder of the frame does before the first one: it has two banks for what comes.
    pub fn first_of_holder() -> [Instruction<u64>; 2] {
        [0, 1].map(programs::give_bank)
    }

    /// What it does when words have come: their colour, or the mean of all samples where they are the last ones, goes to its texture port, where the
    /// frame buffer is; the bank is free when that has it. Of samples side by side the frame buffer looks for two colours, one behind the other.
    pub fn storing(&self, turn: usize) -> Program {
        let number = self.holders_bank(turn) as u64;
        let colour = bank(number);
        let (before, mut program) = match self.adds() {
            true => (self.before_adding(turn), self.adding(turn, colour)),
            false => {
                let behind = if self.is_side_by_side() { turn as u64 % 2 * Works::COLOUR } else { 0 };
                (Vec::new(), programs::move_word(colour, Works::SHOWN + behind, Works::COLOUR))
            }
        };
        if self.ends(turn) {
            program.extend([programs::start_texture(), programs::await_texture()]);
        }
        [before, vec![programs::await_bank(number)], program, vec![programs::give_bank(number)]].concat()
    }

    /// Whether words come to the holder of the frame in a turn.
    pub fn comes_to_holder(&self, turn: usize) -> bool {
        self.ends(turn) || !self.shades_once()
    }

    /// Its bank for them, in turns.
    pub fn holders_bank(&self, turn: usize) -> usize {
        self.word(turn) % 2
    }

    /// Bytes of a word that comes to the holder of the frame.
    pub fn stored(&self) -> u64 {
        if self.is_shaded() { Works::COLOUR } else { self.bytes() }
    }
}

/// A primitive and a region that it meets, with what is to be done there.
struct Met {
    number: usize,
    region: usize,
    program: Program,
}

/// Makes the program of each, on all processors of the computer.
fn draw_each(met: &mut [Met], draw: impl Fn(usize, usize) -> Program + Sync) {
    let mut shares: Vec<&mut [Met]> = met.chunks_mut(SHARE).collect();
    let drawn = each_mut(&mut shares, |_, share| {
        share.iter_mut().for_each(|met| met.program = draw(met.number, met.region));
        Ok::<(), Infallible>(())
    });
    let Ok(()) = drawn;
}

/// Where eight samples are in a picture at twice the width and height: the first of two has four of them, as has the second.
fn samples_of_eight(config: &Config) -> impl Iterator<Item = (usize, Pattern)> {
    let field = config.field.map_or(Pattern::ALL, Pattern::field);
    (0..8).map(move |sample: u32| {
        let four = Pattern { first: [sample & 1, sample >> 1 & 1], step: [2, 2] };
        (sample as usize / 4, four.of(field))
    })
}
