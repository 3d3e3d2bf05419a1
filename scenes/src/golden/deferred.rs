//! Golden frames of deferred shading: the least appearance word of each pixel in a plain double loop, and then its
//! colour.

use super::plane_at;
use super::samples::{of_passes, samples_of};
use crate::deferred::{Appearance, AppearancePacket, Deferred, Parameters, Pass, Samples, Shader, Shading};
use crate::frame::{Frame, blank};
use crate::packet::PARAMETER_PLANE_BITS;
use crate::size::Size;
use std::ops::ControlFlow;

impl AppearancePacket {
    /// The numbers of the appearance word at pixel (x, y); meaningful where the triangle covers the pixel.
    pub fn parameters(&self, x: u32, y: u32) -> Parameters {
        let whole = |plane| plane_at(plane, x, y, PARAMETER_PLANE_BITS) as u16;
        Parameters {
            z: self.triangle.depth(x, y),
            normal: [0, 1, 2].map(|i| whole(&self.normal[i]) as i16),
            rgb: self.triangle.rgb(x, y),
            uv: [0, 1].map(|i| whole(&self.uv[i])),
            material: self.material,
            level: self.level,
            scale: whole(&self.scale),
        }
    }
}

/// The visible surface in each pixel, row by row from the upper left: the least word of all packets that cover it
/// (DES-MIN), or [`Appearance::EMPTY`].
pub fn visible(size: Size, packets: &[AppearancePacket]) -> Vec<Appearance> {
    let mut words = vec![Appearance::EMPTY; size.pixels()];
    packets.iter().for_each(|packet| draw(&mut words, size, packet));
    words
}

/// Renders a scene with deferred shading. The frame has only colours: every depth is the greatest.
pub fn render_deferred(deferred: &Deferred) -> Frame {
    render_deferred_watched(deferred, |_| ControlFlow::Continue(())).expect("nothing breaks it off")
}

/// As [`render_deferred`], but calls `watch` before every packet and every shaded row with the fraction done, from 0 to
/// 1. `watch` may stop the rendering; then there is no frame.
pub fn render_deferred_watched(deferred: &Deferred, watch: impl FnMut(f64) -> ControlFlow<()>) -> Option<Frame> {
    let mut steps = Steps::of(deferred, watch);
    let seen: Vec<_> = deferred.passes.iter().map(|pass| watched(pass, &mut steps)).collect::<Option<_>>()?;
    if deferred.samples == Samples::Eight(Shading::OncePerPixel) {
        return shaded_once(deferred, &seen, &mut steps);
    }
    let passes = deferred.passes.iter().zip(&seen);
    let shaded = passes.map(|(pass, seen)| shaded(pass.size, seen, &deferred.shader, &mut steps));
    of_passes(shaded.collect::<Option<_>>()?)
}

/// The steps of a frame: packets take half of the progress, and rows of samples to shade the other half.
struct Steps<W> {
    watch: W,
    done: f64,
    packet: f64,
    row: f64,
}

impl<W: FnMut(f64) -> ControlFlow<()>> Steps<W> {
    fn of(deferred: &Deferred, watch: W) -> Steps<W> {
        let packets: usize = deferred.passes.iter().map(|pass| pass.packets.len()).sum();
        let rows: u32 = deferred.passes.iter().map(|pass| pass.size.height()).sum();
        Steps { watch, done: 0.0, packet: 0.5 / packets.max(1) as f64, row: 0.5 / f64::from(rows) }
    }

    /// Before a step that is this fraction of the whole; `None` stops.
    fn step(&mut self, part: f64) -> Option<()> {
        let goes_on = (self.watch)(self.done).is_continue();
        self.done = f64::min(self.done + part, 1.0);
        goes_on.then_some(())
    }
}

/// As [`visible`], watched.
fn watched<W: FnMut(f64) -> ControlFlow<()>>(pass: &Pass, steps: &mut Steps<W>) -> Option<Vec<Appearance>> {
    let mut words = vec![Appearance::EMPTY; pass.size.pixels()];
    for packet in &pass.packets {
        steps.step(steps.packet)?;
        draw(&mut words, pass.size, packet);
    }
    Some(words)
}

/// The colour of each word.
fn shaded<W: FnMut(f64) -> ControlFlow<()>>(
    size: Size,
    words: &[Appearance],
    shader: &Shader,
    steps: &mut Steps<W>,
) -> Option<Frame> {
    let mut frame = Frame::blank(size, shader.background);
    for y in 0..size.height() {
        steps.step(steps.row)?;
        for x in 0..size.width() {
            let pixel = frame.index(x, y);
            frame.words[pixel] = blank(shader.shade(words[pixel]));
        }
    }
    Some(frame)
}

/// The colour of each pixel of eight samples, from what the passes show.
fn shaded_once<W: FnMut(f64) -> ControlFlow<()>>(
    deferred: &Deferred,
    seen: &[Vec<Appearance>],
    steps: &mut Steps<W>,
) -> Option<Frame> {
    let Deferred { size, shader, .. } = deferred;
    let mut frame = Frame::blank(*size, shader.background);
    for y in 0..size.height() {
        // Two rows of each pass.
        steps.step(4.0 * steps.row)?;
        for x in 0..size.width() {
            let samples = samples_of(*size, x, y).map(|(pass, pixel)| seen[pass][pixel]);
            let pixel = frame.index(x, y);
            frame.words[pixel] = blank(shader.shade_once(&samples));
        }
    }
    Some(frame)
}

fn draw(words: &mut [Appearance], size: Size, packet: &AppearancePacket) {
    let bounds = packet.triangle.bounds;
    // A packet set up for a larger screen is cut to this one.
    for y in bounds.top..=bounds.bottom.min(size.height() - 1) {
        for x in bounds.left..=bounds.right.min(size.width() - 1) {
            if packet.triangle.covers(x, y) {
                let kept = &mut words[y as usize * size.width() as usize + x as usize];
                *kept = (*kept).min(packet.word(x, y));
            }
        }
    }
}
