//! Deferred shading: appearance words region by region.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::fields::{appearance, bank};
use tilewright_rtl::pixelflow::programs::{self, Shading, Words as Places};
use tilewright_scenes::deferred::{self, Pass};

use super::{NEW, Works};
use crate::error::Error;
use crate::pixelflow::config::Config;
use crate::pixelflow::constants::constants;
use crate::pixelflow::costs::{Ticks, ticks};
use crate::pixelflow::screen::Screen;

/// Where a shader keeps the words of the region that it shades.
const SHADED: u64 = 160;

impl Works {
    /// With deferred shading: appearance words of a pass.
    pub fn deferred(config: &Config, pass: &Pass, shader: &deferred::Shader) -> Result<Works, Error> {
        let mut works = Works::of_shader(config, shader, 1)?;
        works.draw(config, 0, &works.screen.clone(), pass);
        works.finish_words(config);
        let shader = constants(shader);
        let shading = Shading { shader: &shader, word: SHADED, colour: bank(1) };
        let program = [
            vec![programs::await_bank(0)],
            programs::move_word(bank(0), SHADED, appearance::BYTES),
            vec![programs::give_bank(0)],
            shading.before_texture(),
            shading.under_texture(),
            vec![programs::await_bank(1)],
            shading.after_texture(),
            vec![programs::give_bank(1)],
        ];
        works.shading = vec![program.concat()];
        Ok(works)
    }

    fn of_shader(config: &Config, shader: &deferred::Shader, together: usize) -> Result<Works, Error> {
        if config.shaders == 0 {
            return Err(ParameterError("no shaders: deferred shading takes at least one".to_owned()).into());
        }
        let mut works = Works::empty(config, config.roles()?.rasterizers, [together, 1])?;
        works.textures = shader.textures.clone();
        Ok(works)
    }

    /// Draws a sample, which a screen has, of a pass.
    fn draw(&mut self, config: &Config, sample: usize, screen: &Screen, pass: &Pass) {
        let (hardware, together) = (self.hardware(config), self.together);
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

    /// In each turn words are cleared before, and marked and given behind. If primitives were sorted before, their instructions are made meanwhile.
    fn finish_words(&mut self, config: &Config) {
        for (rasterizer, turn) in
            (0..self.shares()).flat_map(|it| (0..self.turns()).map(move |turn| (it, turn))).collect::<Vec<_>>()
        {
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
