//! The work of a machine's nodes for a frame: the programs of each node, turn by turn.
//!
//! In a turn the rasterizers draw one sample of a region, and the network composes it. This is the sequence of turns:
//!
//! | frame | turns |
//! |---|---|
//! | one sample | all regions |
//! | eight, each shaded | both renderings of the first region, then of the second ..; four samples are side by side, so a region has a quarter of the pixels; the frame buffer averages |
//! | eight, shaded once | all samples of the first region, then all of the second ..; those of a pixel go to the same shader |
//! | eight, in the pixels' memory | all regions of the first sample, then all of the second ..; the node of the frame buffer adds them up |

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

/// The number of programs that a thread makes one after another.
const SHARE: usize = 64;
/// The place for a new word.
const NEW: u64 = 0;

/// The work for a frame.
pub(super) struct Works {
    /// The screen that is drawn, a region in each turn, with one sample of each pixel, or four side by side.
    screen: Screen,
    array: [u32; 2],
    samples: Samples,
    /// The programs of each rasterizer, for each turn.
    programs: Vec<Vec<Program>>,
    /// For each rasterizer and turn, the places in the program at which the instructions of primitives begin. If the front end makes them one by one, each place has the
    /// time from which on they are available.
    starts: Vec<Vec<Vec<(usize, usize)>>>,
    marks: Vec<Vec<Vec<Mark>>>,
    /// The tick from which on all instructions of all rasterizers are available; 0 if they are made before the frame.
    pub made: Ticks,
    /// The programs of all shaders, for each turn of a region; empty if colours are composed.
    shading: Vec<Program>,
    /// The textures that they look up.
    pub textures: Vec<Arc<Texture>>,
    /// Primitives of each rasterizer, and the number drawn in all turns.
    pub primitives: Vec<usize>,
    pub drawn: usize,
}

impl Works {
    /// Bytes of a colour.
    pub const COLOUR: u64 = 3;
    /// The register from which the frame buffer reads it.
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

    /// Assigns primitives to rasterizers one after another, and the instructions of a sample to the turns of the regions that they meet.
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
            // The same for each sample.
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

    /// Puts instructions before those of a turn.
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

    /// The circuit of the frame buffer.
    ///
    /// # Errors
    /// The frame's size is out of range.
    pub fn frame_buffer(&self) -> Result<FrameBuffer, ParameterError> {
        let samples = if self.is_side_by_side() { FrameBuffer::EIGHT } else { 1 };
        let (size, [columns, rows]) = (self.size(), self.array);
        let screen = parameter::Screen::new(size.width(), size.height())?;
        Ok(FrameBuffer { columns, rows, samples, screen }.checked()?)
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

    /// The number of consecutive turns of a region.
    fn together(&self) -> usize {
        self.samples.together()
    }

    /// The number of the shaded, or stored, words to which a turn belongs.
    fn word(&self, turn: usize) -> usize {
        if self.shades_once() { turn / self.together() } else { turn }
    }

    /// The shader that takes the composed words.
    pub fn shader_of(&self, turn: usize, shaders: usize) -> Option<usize> {
        self.word(turn).checked_rem(shaders)
    }

    /// Whether a turn is the last of its region, so that the frame buffer gets it.
    pub fn ends(&self, turn: usize) -> bool {
        let round = turn / (self.regions() * self.together());
        turn % self.together() + 1 == self.together() && round + 1 == self.samples.rounds()
    }

    /// Whether a shader has all samples of a region before it shades.
    pub fn shades_once(&self) -> bool {
        self.samples == Samples::ShadedOnce
    }

    /// Whether the node of the frame buffer adds up the words that arrive.
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

    /// Whether the node of the frame buffer gets depths, with the colours of one sample.
    pub fn has_depths(&self) -> bool {
        !self.is_shaded() && !self.adds()
    }

    /// Bytes of a composed word.
    pub fn bytes(&self) -> u64 {
        if self.is_shaded() { appearance::BYTES } else { gouraud::BYTES }
    }

    /// The program of a rasterizer for a turn.
    pub fn program(&self, rasterizer: usize, turn: usize) -> &[Instruction<u64>] {
        &self.programs[rasterizer][turn]
    }

    /// The time from which on it can run.
    pub fn marks(&self, rasterizer: usize, turn: usize) -> &[Mark] {
        &self.marks[rasterizer][turn]
    }

    /// The program of a shader for a turn. It ends with colours if [the frame buffer gets some](Works::comes_to_holder), or else with a free bank for the next words.
    pub fn shading(&self, turn: usize) -> &[Instruction<u64>] {
        &self.shading[turn % self.shading.len()]
    }

    /// Its program before the first turn: it gives a bank for words.
    pub fn first_of_shader() -> [Instruction<u64>; 1] {
        [programs::give_bank(0)]
    }

    /// The program of the frame buffer's node before the first turn: it gives two banks for words.
    pub fn first_of_holder() -> [Instruction<u64>; 2] {
        [0, 1].map(programs::give_bank)
    }

    /// Its program when words have arrived. Their colour, or the mean of all samples after the last words, goes to the frame buffer at its texture port. Then
    /// the bank is free. For samples side by side the frame buffer reads two colours, one after the other.
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

    /// Whether words go to the node of the frame buffer in a turn.
    pub fn comes_to_holder(&self, turn: usize) -> bool {
        self.ends(turn) || !self.shades_once()
    }

    /// Its bank for them, alternately.
    pub fn holders_bank(&self, turn: usize) -> usize {
        self.word(turn) % 2
    }

    /// Bytes of a word at the node of the frame buffer.
    pub fn stored(&self) -> u64 {
        if self.is_shaded() { Works::COLOUR } else { self.bytes() }
    }
}

/// A primitive and a region that it meets, with its instructions there.
struct Met {
    number: usize,
    region: usize,
    program: Program,
}

/// Makes the programs, on all processors of the computer.
fn draw_each(met: &mut [Met], draw: impl Fn(usize, usize) -> Program + Sync) {
    let mut shares: Vec<&mut [Met]> = met.chunks_mut(SHARE).collect();
    let drawn = each_mut(&mut shares, |_, share| {
        share.iter_mut().for_each(|met| met.program = draw(met.number, met.region));
        Ok::<(), Infallible>(())
    });
    let Ok(()) = drawn;
}

/// The places of eight samples in two pictures at twice the width and height, with four in each.
fn samples_of_eight(config: &Config) -> impl Iterator<Item = (usize, Pattern)> {
    let field = config.field.map_or(Pattern::ALL, Pattern::field);
    (0..8).map(move |sample: u32| {
        let four = Pattern { first: [sample & 1, sample >> 1 & 1], step: [2, 2] };
        (sample as usize / 4, four.of(field))
    })
}
