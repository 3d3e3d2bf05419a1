//! A pixel that is followed during a frame.

use tilewright_rtl::pixel_planes::fields;
use tilewright_rtl::pixel_planes::renderer::Renderer;
use tilewright_scenes::{Frame, PixelBox};

use super::observer::{Observer, Part};
use super::picture::{Pictured, Scene};
use super::units::TICK;
use crate::pixel_planes::bin::Work;
use crate::pixel_planes::config::Config;
use crate::pixel_planes::model::Timing;
use crate::pixel_planes::regions::Regions;
use crate::told::{Unit, value};
use crate::way::{Step, Way};

/// What is found of a pixel.
pub(in crate::pixel_planes) struct Followed<'a> {
    /// The number of its renderer.
    pub number: usize,
    pub observer: Observer<'a>,
    pub pictured: Pictured,
    /// Steps of the region allocator and of the ring, which the model alone has.
    modelled: Vec<Step>,
}

impl<'a> Followed<'a> {
    /// That of a pixel; `None` if no renderer has its region.
    pub fn new(
        config: &Config,
        renderer: Renderer,
        regions: &Regions,
        works: &'a [Work],
        timing: &Timing,
        [x, y]: [u32; 2],
    ) -> Option<Followed<'a>> {
        let region = regions.of_pixel(x, y);
        let PixelBox { left, top, .. } = regions.pixels(region);
        let at = [x - left, y - top];
        let is_here = |place: &usize| works[*place].region == region;
        let number = timing.renderers.iter().position(|it| it.regions.iter().any(is_here))?;
        let of = &timing.renderers[number];
        let parts = of.regions.iter().flat_map(|place| parts(&works[*place], works[*place].region == region)).collect();
        let place = of.regions.iter().position(is_here)?;
        let mut modelled = Vec::new();
        let mut say = |unit: &str, block, clock, does: &str, what, shown: String| {
            let unit = Unit::new(unit, block, ("clk", TICK), "");
            modelled.push(unit.step(clock, None, does, vec![value(what, shown)]));
        };
        let given = of.given[place];
        say(
            "region allocator",
            "region-allocator",
            given,
            "gives the pixel's region to a renderer",
            "renderer",
            number.to_string(),
        );
        let line = (place as u32 * config.side + at[1]) * fields::WORD.bits;
        if let Some(clock) = of.planes.get(line as usize) {
            say("ring", "ring", *clock, "brings the first plane of the pixel's line", "region", region.to_string());
        }
        Some(Followed {
            number,
            observer: Observer::new(number, &renderer, config.side_by_side, at, region, parts),
            pictured: Pictured::new(region, at, config.side),
            modelled,
        })
    }

    /// Its way, with the frame if there is one.
    pub fn into_way(self, scene: Scene, frame: Option<&Frame>) -> Way {
        let [x, y] = scene.pixel;
        let shown = frame.map(|frame| frame.words[(y * frame.size().width() + x) as usize]);
        scene.into_way(self.observer, self.pictured, self.modelled, shown)
    }
}

/// The instructions of a region, with their primitives.
fn parts(work: &Work, here: bool) -> Vec<Part<'_>> {
    let of_primitives: usize = work.made.iter().map(|(_, count)| *count as usize).sum();
    let begin = work.instructions.len() - 1 - of_primitives;
    let mut primitives = work.made.iter().flat_map(|(number, count)| (0..*count).map(|_| *number));
    let part = |(place, instruction)| {
        let is_of_primitive = (begin..begin + of_primitives).contains(&place);
        Part { instruction, primitive: if is_of_primitive { primitives.next() } else { None }, here }
    };
    work.instructions.iter().enumerate().map(part).collect()
}
