//! Pads of a random design.

use super::{Builder, PartBlock};
use crate::features::Feature;
use crate::spec::{Drives, Make, Pad, Part, Step};
use tilewright_hdl::{Fields, Leaf, Outside, PadIn, Width, lit};

/// The outsides of pads, by name.
#[derive(Debug, Clone, PartialEq)]
pub struct Pads<T>(pub Vec<(String, Outside<T>)>);

impl<T> Default for Pads<T> {
    fn default() -> Self {
        Pads(Vec::new())
    }
}

impl<T: Leaf> Fields<T> for Pads<T> {
    type With<U: Leaf> = Pads<U>;

    fn map_fields<U: Leaf>(&self, _: &str, f: &mut dyn FnMut(&str, &T) -> U) -> Pads<U> {
        Pads(self.0.iter().map(|(name, outside)| (name.clone(), outside.map_fields(name, f))).collect())
    }
}

impl Pad {
    fn pins(&self) -> u32 {
        if matches!(self.drives, Drives::Low(_)) { 1 } else { self.width }
    }
}

/// The steps that are pads, if the part may have some.
pub fn pads(part: &Part, is_top: bool) -> impl Iterator<Item = (usize, &Step, &Pad)> {
    let steps = part.steps.iter().enumerate().filter(move |_| is_top);
    steps.filter_map(|(number, step)| match &step.make {
        Make::Pad(pad) => Some((number, step, pad)),
        _ => None,
    })
}

impl PartBlock {
    /// The outsides of its pads, of these names.
    pub fn outsides(&self, names: Vec<String>) -> Pads<Width> {
        let outside = |(_, step, pad): (usize, &Step, &Pad)| {
            let outside = Outside::widths(pad.pins());
            self.clock(self.domain(step.clock)).map_or(outside, |clock| outside.on(clock))
        };
        Pads(names.into_iter().zip(pads(self.part(), self.is_top()).map(outside)).collect())
    }
}

impl Builder<'_> {
    /// A pad, and what its line shows.
    pub fn pad(&mut self, d: usize, number: usize, pad: &Pad) {
        let Some(outside) = self.outsides.pop_front() else { return };
        let out = self.pick_fit(d, pad.out, pad.pins());
        let enable = match pad.drives {
            Drives::Never => lit(1, 0),
            Drives::Always => lit(1, 1),
            Drives::Low(enable) | Drives::While(enable) => self.pick_fit(d, enable, 1),
        };
        match pad.drives {
            Drives::Never => Feature::InputPad.used(),
            Drives::Always => Feature::OutputPad.used(),
            Drives::Low(_) => Feature::OpenDrain.used(),
            Drives::While(_) => Feature::BothWays.used(),
        }
        let into = match pad.drives {
            Drives::Low(_) => PadIn::open_drain(enable, outside),
            _ => PadIn { out, enable, outside },
        };
        let mut block = tilewright_hdl::Pad::new(pad.pins());
        if pad.pull_up {
            Feature::PullUp.used();
            block = block.pull_up();
        }
        let name = self.instance_name(number);
        let line = self.on(d).instance(&name, &block, into).line;
        self.push(d, line);
    }
}
