//! The frame buffer beside what it gets, and the whole way at the end.

use tilewright_rtl::pixel_planes::frame_buffer::{FrameBufferIn, FrameBufferOut};
use tilewright_scenes::frame::{blank, depth_of};
use tilewright_scenes::golden::{Rule, visit_fragments};
use tilewright_scenes::{PixelBox, Polygons};
use tilewright_sim::{Memory, Simulation};

use super::observer::{Drawn, Observer};
use super::units::TICK;
use crate::error::Error;
use crate::told::{Told, Unit, compared, violated};
use crate::way::{Primitive, Step, Way};

/// The frame buffer's word of the pixel.
pub(in crate::pixel_planes) struct Pictured {
    unit: Unit,
    /// The address of the pixel's line, the line, its region, and the pixel's place there.
    address: u32,
    line: usize,
    region: usize,
    column: usize,
    /// The path of the pixel's bit of a plane, and of its words in memory.
    bits: String,
    words: String,
    memory: Option<Memory>,
    word: Option<u64>,
    pub told: Told,
}

impl Pictured {
    /// Of the pixel at that column and line of a region.
    pub fn new(region: usize, [column, line]: [u32; 2], side: u32) -> Pictured {
        let unit = Unit::new("frame buffer", "frame-buffer", ("clk", TICK), "");
        let address = region as u32 * side + line;
        let (bits, words) = (format!("planes_bits[{column}]"), format!("lines[{column}]"));
        Pictured {
            unit,
            address,
            line: line as usize,
            region,
            column: column as usize,
            bits,
            words,
            memory: None,
            word: None,
            told: Told::of(super::FRAME_BUFFER),
        }
    }

    /// The bit of the pixel's column in the plane that comes.
    pub fn bit(&self, sim: &mut Simulation<FrameBufferIn, FrameBufferOut>) -> u64 {
        sim.peek(&self.bits).ok().and_then(|bit| bit.to_u64()).unwrap_or(0)
    }

    /// Whether a line is that of the pixel.
    pub fn is_here(&self, region: usize, line: usize) -> bool {
        (region, line) == (self.region, self.line)
    }

    /// Compares the memory with the planes of a line that were put there, `clock` clocks after the beginning.
    pub fn look(&mut self, sim: &Simulation<FrameBufferIn, FrameBufferOut>, clock: u64, came: Option<u64>) {
        if let Some(word) = came {
            self.word = Some(word);
        }
        self.told.at(sim.time());
        let memory = *self.memory.get_or_insert_with(|| sim.memory(&self.words).expect("it has lines"));
        let seen = sim.word(memory, self.address).to_u64().unwrap_or(0);
        let Some(right) = self.word else { return };
        let shown = |word: u64| format!("{word:012x}");
        let values = vec![compared("word", shown(seen), shown(right))];
        if came.is_some() || seen != right {
            // What is stored depends on the write as well, and what is read later tells of both.
            let net = format!("{}[{}]", if seen == right { "word" } else { "words" }, self.column);
            let step = self.unit.step_at(&net, clock, None, "writes the pixel's word", values);
            self.told.tell(step);
        }
    }

    /// Compares the word that is read.
    pub fn read(&mut self, clock: u64, words: &[u64]) {
        let seen = words[self.column];
        let right = self.word.unwrap_or(0);
        let [seen, right] = [seen, right].map(|word| format!("{word:012x}"));
        let (net, values) = (format!("words[{}]", self.column), vec![compared("word", seen, right)]);
        let step = self.unit.step_at(&net, clock, None, "reads the pixel's word", values);
        self.told.tell(step);
    }

    /// The step of an error.
    pub fn fail(&mut self, clock: u64, error: &Error) {
        let sentence = violated(error).map_or_else(|| error.to_string(), |(_, sentence)| sentence.to_owned());
        self.told.tell(self.unit.fails(clock, &sentence));
    }
}

/// A frame whose pixel is followed.
pub(in crate::pixel_planes) struct Scene<'a> {
    pub polygons: &'a Polygons,
    pub rule: Rule,
    pub background: [u8; 3],
    pub pixel: [u32; 2],
}

impl Scene<'_> {
    /// The way, with the steps of the units that the model alone has, and the pixel's word in the picture.
    pub fn into_way(
        self,
        mut observer: Observer,
        mut pictured: Pictured,
        before: Vec<Step>,
        shown: Option<u64>,
    ) -> Way {
        let Scene { polygons, rule, background, .. } = self;
        let primitives =
            primitives(polygons, rule, self.pixel, background, |number| observer.drawn.get(&number).copied());
        let is_told = |step: &Step| {
            step.differs() || step.primitive.is_none_or(|number| primitives.iter().any(|it| it.number == number))
        };
        let mut steps: Vec<Step> =
            before.into_iter().chain(observer.told.take()).chain(pictured.told.take()).filter(is_told).collect();
        // Stable: steps at the same time keep their sequence.
        steps.sort_by_key(|step| step.time);
        if let Some(shown) = shown {
            let golden = primitives.iter().find(|it| it.wins).and_then(|it| it.golden).unwrap_or(blank(background));
            let unit = Unit::new("picture", "pixel-planes-5", ("clk", TICK), "");
            let [seen, right] = [shown, golden].map(|word| format!("{word:012x}"));
            let cycle = steps.last().map_or(0, |step| step.time / TICK) + 1;
            steps.push(unit.step(cycle, None, "has the pixel", vec![compared("word", seen, right)]));
        }
        Way { primitives, steps }
    }
}

/// The primitives that cover the pixel in the golden image or in the machine.
fn primitives(
    polygons: &Polygons,
    rule: Rule,
    [x, y]: [u32; 2],
    background: [u8; 3],
    drawn: impl Fn(u32) -> Option<Drawn>,
) -> Vec<Primitive> {
    let within = PixelBox { left: x, top: y, right: x, bottom: y };
    let (mut kept, mut winner) = (blank(background), None);
    let mut all = Vec::new();
    for number in 0..polygons.polygons.len() + polygons.spheres.len() {
        let mut golden = None;
        visit_fragments(polygons, number, &within, |_, word| golden = Some(word));
        if let Some(word) = golden {
            let is_nearer = if rule == Rule::Strict { depth_of(word) < depth_of(kept) } else { word < kept };
            if is_nearer {
                (kept, winner) = (word, Some(number));
            }
        }
        let hardware = drawn(number as u32).and_then(|it| it.word());
        if golden.is_some() || hardware.is_some() {
            let name = if number < polygons.polygons.len() {
                format!("polygon {number}")
            } else {
                format!("sphere {}", number - polygons.polygons.len())
            };
            all.push(Primitive { number, name, golden, hardware, wins: false });
        }
    }
    all.iter_mut().for_each(|it| it.wins = Some(it.number) == winner);
    all
}
