//! All regions in the pixels' memory: words z || rgb.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::fields::{Field, bank, gouraud, texture};
use tilewright_rtl::pixelflow::pixel::PixelProcessor;
use tilewright_rtl::pixelflow::programs::{self, SUM_BYTES, Words as Places};
use tilewright_scenes::{Edge, Packet, Projection, Size};

use super::{Program, Samples, Works, samples_of_eight};
use crate::error::Error;
use crate::pixelflow::config::Config;
use crate::pixelflow::costs::ticks;
use crate::pixelflow::screen::{Pattern, Screen};

/// The samples of a picture to draw.
pub(in crate::pixelflow) struct Drawing<'a, E> {
    pub packets: &'a [Packet<E>],
    /// The picture, and the pattern of its pixels.
    pub size: Size,
    pub pattern: Pattern,
}

impl<'a, E> Drawing<'a, E> {
    /// A whole picture, or its field.
    pub fn of(config: &Config, packets: &'a [Packet<E>]) -> Drawing<'a, E> {
        Drawing { packets, size: config.size, pattern: config.field.map_or(Pattern::ALL, Pattern::field) }
    }
}

impl<'a> Drawing<'a, [Edge; 3]> {
    /// Each of eight samples, from two pictures at twice the width and height.
    pub fn eight(config: &Config, passes: &'a [Projection]) -> Vec<Drawing<'a, [Edge; 3]>> {
        let sample = |(pass, pattern): (usize, Pattern)| {
            let Projection { size, triangles, .. } = &passes[pass];
            Drawing { packets: triangles, size: *size, pattern }
        };
        samples_of_eight(config).map(sample).collect()
    }
}

impl Works {
    /// All regions in the pixels' memory, with one sample, or eight one after another.
    pub fn resident<E: AsRef<[Edge]> + Sync>(
        config: &Config,
        samples: &[Drawing<'_, E>],
        background: [u8; 3],
    ) -> Result<Works, Error> {
        let of_pixel = if samples.len() == 1 { Samples::One } else { Samples::InMemory };
        let mut works = Works::empty(config, config.nodes - 1, of_pixel)?;
        let (places, scratch) = resident_words();
        let regions = works.regions();
        if regions > places.len() {
            let [width, height] = config.array;
            let (size, most, bytes) = (works.size(), places.len(), PixelProcessor::BYTES);
            return Err(ParameterError(format!(
                "a screen of {size} pixels has {regions} regions of {width}x{height}, and the {bytes} bytes of a pixel have room for {most}, beside those \
                 that the network sees: take a smaller screen, or a system that works region by region"
            ))
            .into());
        }
        let hardware = works.hardware(config);
        for (sample, Drawing { packets, size, pattern }) in samples.iter().enumerate() {
            let screen = Screen::sampled(*size, *pattern, config.array)?;
            let boxes = packets.iter().map(|packet| packet.bounds);
            // All primitives at once, in the sequence of submission.
            works.deal(
                sample,
                &screen,
                boxes,
                |_| sample * regions,
                |number, region| {
                    let (packet, corner) = (&packets[number], screen.corner(region));
                    let words = Places { kept: places[region], new: scratch };
                    programs::gouraud(hardware, words, &corner.edges(packet), &corner.surface(packet))
                },
            );
        }
        for turn in 0..works.turns() {
            works.send(turn, &places, background);
        }
        let costs = &config.costs;
        works.make_one_by_one(|_, _| ticks(costs.overhead), ticks(costs.transform_plain));
        Ok(works)
    }

    /// Sends a region. Before the first one of a sample, all regions are cleared and drawn.
    fn send(&mut self, turn: usize, places: &[u64], background: [u8; 3]) {
        let (number, region) = (turn as u64 % 2, self.region(turn));
        let clear = |place: &u64| programs::clear_to(*place, background);
        for rasterizer in 0..self.shares() {
            if region == 0 {
                let cleared = places[..self.regions()].iter().flat_map(clear).collect();
                self.put_before(rasterizer, turn, cleared);
            }
            let program = &mut self.programs[rasterizer][turn];
            program.push(programs::await_bank(number));
            program.extend(programs::move_word(places[region], bank(number), gouraud::BYTES));
            program.push(programs::give_bank(number));
        }
    }

    /// The instructions that add a colour to the sums of its region, and after the last one store the mean for the frame buffer.
    pub(super) fn adding(&self, turn: usize, colour: u64) -> Program {
        let sums = self.sums(turn % self.regions());
        let mut program = programs::add_sample(colour, sums);
        if self.ends(turn) {
            program.extend(programs::average(sums, Works::SHOWN));
        }
        program
    }

    /// The instructions that clear the sums before the first colour.
    pub(super) fn before_adding(&self, turn: usize) -> Program {
        if turn < self.regions() { programs::begin_sums(self.sums(turn)) } else { Vec::new() }
    }

    /// The place of a region's sums: in memory, and in registers after those that the frame buffer reads.
    fn sums(&self, region: usize) -> u64 {
        let in_memory = u64::from(PixelProcessor::REGISTERS) / SUM_BYTES;
        match (region as u64).checked_sub(in_memory) {
            None => region as u64 * SUM_BYTES,
            Some(number) => Works::SHOWN + Works::COLOUR + number * SUM_BYTES,
        }
    }
}

/// The places of each region's words, as many as fit beside the network's banks, and the place for a new word.
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
    // The same for sums.
    let size = Size::new(8 * Config::MOST_REGIONS as u32, 8).expect("in range");
    let config = Config { array: [8, 8], ..Config::new(size) };
    let works = Works::empty(&config, 1, Samples::InMemory).expect("there is such a machine");
    let sums: Vec<u64> = (0..Config::MOST_REGIONS).map(|region| works.sums(region)).collect();
    assert!(sums.windows(2).all(|pair| pair[0] + SUM_BYTES <= pair[1]));
    assert!(sums.iter().all(|sum| sum + SUM_BYTES <= bank(0) || *sum >= Works::SHOWN + Works::COLOUR));
    assert!(sums[sums.len() - 1] + SUM_BYTES <= PixelProcessor::BYTES.into());
}
