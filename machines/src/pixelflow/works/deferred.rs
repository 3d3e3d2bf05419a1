//! Deferred shading: appearance words region by region.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::fields::{appearance, bank};
use tilewright_rtl::pixelflow::programs::{self, Shader, Shading, ShadingOnce, Words as Places};
use tilewright_scenes::deferred::{self, Pass};

use super::{NEW, Program, Samples, Works, samples_of_eight};
use crate::error::Error;
use crate::pixelflow::config::Config;
use crate::pixelflow::constants::constants;
use crate::pixelflow::costs::{Ticks, ticks};
use crate::pixelflow::screen::Screen;

/// The memory of a shader for the words of the region that it shades.
const SHADED: u64 = 160;

fn shading(shader: &Shader) -> Shading<'_> {
    Shading { shader, word: SHADED, colour: bank(1) }
}

/// Shades, in parts before, during and after the texture unit, and gives the colours when there is a bank for them.
fn sent_colours([before, beside, behind]: [Program; 3]) -> Program {
    [before, beside, vec![programs::await_bank(1)], behind, vec![programs::give_bank(1)]].concat()
}

impl Works {
    /// Deferred shading: appearance words of one pass, or of both passes of eight samples, region by region.
    pub fn deferred(config: &Config, passes: &[Pass], shader: &deferred::Shader) -> Result<Works, Error> {
        let samples = if passes.len() == 1 { Samples::One } else { Samples::SideBySide };
        let drawn = Config { size: passes[0].size, ..config.clone() };
        let mut works = Works::of_shader(&drawn, shader, samples)?;
        let screen = works.screen;
        passes.iter().enumerate().for_each(|(number, pass)| works.draw(config, number, &screen, pass));
        works.finish_words(config);
        let shader = constants(shader);
        let shading = shading(&shader);
        let program = [
            vec![programs::await_bank(0)],
            programs::move_word(bank(0), SHADED, appearance::BYTES),
            vec![programs::give_bank(0)],
            sent_colours([shading.before_texture(), shading.under_texture(), shading.after_texture()]),
        ];
        works.shading = vec![program.concat()];
        Ok(works)
    }

    /// Deferred shading, once for eight samples. The samples of a region come one after another, from two passes at twice the width and height.
    pub fn deferred_once(config: &Config, passes: &[Pass], shader: &deferred::Shader) -> Result<Works, Error> {
        let samples: Vec<_> = samples_of_eight(config).collect();
        let mut works = Works::of_shader(config, shader, Samples::ShadedOnce)?;
        for (sample, (pass, pattern)) in samples.iter().enumerate() {
            let pass = &passes[*pass];
            works.draw(config, sample, &Screen::sampled(pass.size, *pattern, config.array)?, pass);
        }
        works.finish_words(config);
        let shader = constants(shader);
        let once = ShadingOnce { shading: shading(&shader) };
        let taken = |number: usize| {
            let word = once.take(number as u64, bank(0));
            [vec![programs::await_bank(0)], word, vec![programs::give_bank(0)]].concat()
        };
        works.shading = (0..samples.len()).map(taken).collect();
        let colours = sent_colours([once.before_texture(), once.under_texture(), once.after_texture()]);
        if let Some(last) = works.shading.last_mut() {
            last.extend([once.combine(), colours].concat());
        }
        Ok(works)
    }

    fn of_shader(config: &Config, shader: &deferred::Shader, samples: Samples) -> Result<Works, Error> {
        if config.shaders == 0 {
            return Err(ParameterError("no shaders: deferred shading takes at least one".to_owned()).into());
        }
        let mut works = Works::empty(config, config.roles()?.rasterizers, samples)?;
        works.textures = shader.textures.clone();
        Ok(works)
    }

    /// Draws one sample of a pass on a screen.
    fn draw(&mut self, config: &Config, sample: usize, screen: &Screen, pass: &Pass) {
        let (hardware, together) = (self.hardware(config), self.together());
        let boxes = pass.packets.iter().map(|packet| packet.triangle.bounds);
        self.deal(
            sample,
            screen,
            boxes,
            |region| region * together + sample,
            |number, region| {
                let (packet, corner) = (&pass.packets[number], screen.corner(region));
                let words = Places { kept: bank((region * together + sample) as u64 % 2), new: NEW };
                programs::appearance(hardware, words, &corner.edges(&packet.triangle), &corner.appearance(packet))
            },
        );
    }

    /// Before each turn words are cleared; after it they are tagged and given. With pre-sorting, instructions are made at the same time.
    fn finish_words(&mut self, config: &Config) {
        let turns = self.turns();
        for (rasterizer, turn) in (0..self.shares()).flat_map(|it| (0..turns).map(move |turn| (it, turn))) {
            let number = turn as u64 % 2;
            let word = bank(number);
            let clear = [vec![programs::await_bank(number)], programs::clear(word, appearance::BYTES)].concat();
            self.put_before(rasterizer, turn, clear);
            let program = &mut self.programs[rasterizer][turn];
            program.extend(programs::covered(word));
            program.push(programs::give_bank(number));
        }
        if config.pre_sort {
            let costs = &config.costs;
            let sorted = |works: &Works, rasterizer: usize| {
                ticks(costs.overhead) + ticks(costs.sort) * works.primitives[rasterizer] as Ticks
            };
            self.make_one_by_one(sorted, ticks(costs.generate));
        }
    }
}
