//! The nets that say that nothing is under way. A unit says so only if all units in it do.

use std::ops::Range;

use tilewright_rtl::quadtree::raster::{Form, Part};

use super::{Followed, Sim, net};
use crate::looks::Looks;
use crate::told::{At, Edge, Told, compared, yes};
use crate::way::Step;

/// The nets of the followed processor and of the generator.
pub(super) struct Idle {
    /// The name of each and its block, those of inner units first.
    nets: Vec<(String, &'static str)>,
    /// The place of the first of them.
    place: usize,
    /// The units that have others in them, by number, and these.
    outer: [(usize, Range<usize>); 3],
}

impl Idle {
    pub fn new(looks: &mut Looks, followed: &Followed, form: &Form) -> Idle {
        let processor = format!("u_processor[{}]", followed.processor);
        let raster = format!("{processor}.u_raster");
        let parts = form.parts().iter().enumerate().map(|(number, part)| match part {
            Part::Stack(_) => (format!("{raster}.u_stack{number}.idle"), "quadtree-stack"),
            Part::Pipe(_) => (format!("{raster}.u_pipe{number}.idle"), "quadtree-pipe"),
            Part::Tree(_) => (format!("{raster}.u_tree{number}.idle"), "quadtree-tree"),
        });
        let mut nets: Vec<(String, &'static str)> = parts.collect();
        let [raster_at, processor_at, generator_at] = [nets.len(), nets.len() + 2, nets.len() + 3];
        nets.extend([
            (format!("{raster}.idle"), "raster-processor"),
            (format!("{processor}.u_set_up.idle"), "quadtree-set-up"),
            (format!("{processor}.idle"), "video-processor"),
            ("idle".to_owned(), "quadtree-generator"),
        ]);
        let outer = [
            (raster_at, 0..raster_at),
            (processor_at, raster_at..processor_at),
            (generator_at, processor_at..generator_at),
        ];
        Idle { place: looks.add("", nets.iter().map(|(name, _)| &**name)), nets, outer }
    }

    /// Looks before an edge.
    pub fn look(&self, looks: &Looks, edge: Edge, told: &mut Told) {
        let is_idle = |unit: usize| looks.at(self.place + unit) == 1;
        let early = |(unit, inner): &&(usize, Range<usize>)| is_idle(*unit) && !inner.clone().all(is_idle);
        if let Some((unit, _)) = self.outer.iter().find(early) {
            told.check("idle", 0, false, || self.step(*unit, edge, true));
        }
    }

    /// All has been drawn, and the generator does not say so.
    pub fn ends(&self, sim: &mut Sim, edge: Edge, told: &mut Told) {
        if let Some(busy) = self.nets.iter().position(|(name, _)| net(sim, name) == 0) {
            told.tell(self.step(busy, edge, false));
        }
    }

    fn step(&self, unit: usize, edge: Edge, says: bool) -> Step {
        let (name, block) = &self.nets[unit];
        let at = At { unit: format!("`{name}`"), block, edge };
        at.step("says that nothing is under way", vec![compared("idle", yes(says), yes(!says))]).on(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadtree::Config;
    use crate::quadtree::hardware::Hardware;
    use tilewright_scenes::Size;

    #[test]
    fn a_unit_that_is_idle_before_those_in_it_is_told() {
        let config = Config { matrix: (1, 1), ..Config::new(Size::new(8, 6).unwrap()) };
        let mut hardware = Hardware::new(&config.generator().unwrap()).unwrap();
        hardware.reset(false).unwrap();
        let followed =
            Followed { format: config.format().unwrap(), pixel: 0, processor: 0, column: 0, row: 0, x: 0, y: 0 };
        let edge = Edge { clock: "clk", number: 3, time: 30_000 };
        // Nothing is under way after the reset, and nothing is read: a flag that is low.
        for (inner, expected) in [("u_processor[0].idle", None), ("showing", Some("quadtree-generator"))] {
            let (mut looks, mut told) = (Looks::default(), Told::default());
            let mut idle = Idle::new(&mut looks, &followed, &config.parsed_form().unwrap());
            idle.nets[3].0 = inner.to_owned();
            idle.place = looks.add("", idle.nets.iter().map(|(name, _)| &**name));
            looks.look(&mut hardware.sim);
            idle.look(&looks, edge, &mut told);
            assert_eq!(told.take().first().map(|step| step.block), expected);
        }
    }
}
