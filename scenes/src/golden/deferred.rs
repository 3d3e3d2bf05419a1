//! Golden frames of deferred shading: the least appearance word of each pixel in the plainest double loop, and then its colour.

use super::plane_at;
use crate::deferred::{Appearance, AppearancePacket, Deferred, Parameters, Samples, Shader, Shading};
use crate::frame::{Frame, blank, rgb_of};
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

/// What is seen in each pixel, row by row from the upper left: the least word of all packets that cover it (DES-MIN), or
/// [`Appearance::EMPTY`].
pub fn visible(size: Size, packets: &[AppearancePacket]) -> Vec<Appearance> {
    let mut words = vec![Appearance::EMPTY; size.pixels()];
    packets.iter().for_each(|packet| draw(&mut words, size, packet));
    words
}

/// Renders a scene with deferred shading. The frame has colours alone: every depth is the greatest.
pub fn render_deferred(deferred: &Deferred) -> Frame {
    render_deferred_watched(deferred, |_| ControlFlow::Continue(())).expect("nothing breaks it off")
}

/// As [`render_deferred`], with a call of `watch` before every packet and every row that is shaded; it gets how much of them is done,
/// from 0 to 1, and may break it off: then there is no frame.
pub fn render_deferred_watched(deferred: &Deferred, mut watch: impl FnMut(f64) -> ControlFlow<()>) -> Option<Frame> {
    let Deferred { size, samples, passes, shader, .. } = deferred;
    let packets: usize = passes.iter().map(|pass| pass.packets.len()).sum();
    let rows: u32 = passes.iter().map(|pass| pass.size.height()).sum();
    // A row counts as much as all packets together do by rows.
    let (mut done, of_packet, of_row) = (0.0, 0.5 / packets.max(1) as f64, 0.5 / f64::from(rows));
    let mut step = |part: f64| {
        let called = watch(done);
        done = f64::min(done + part, 1.0);
        called.is_continue().then_some(())
    };
    let mut words = Vec::new();
    for pass in passes {
        let mut seen = vec![Appearance::EMPTY; pass.size.pixels()];
        for packet in &pass.packets {
            step(of_packet)?;
            draw(&mut seen, pass.size, packet);
        }
        words.push(seen);
    }
    if *samples == Samples::Eight(Shading::OncePerPixel) {
        let sides = (size.width(), size.height());
        let mut frame = Frame::blank(*size, shader.background);
        for y in 0..sides.1 {
            step(4.0 * of_row)?;
            for x in 0..sides.0 {
                let eight = samples_of(*size, x, y).map(|(pass, pixel)| words[pass][pixel]);
                let pixel = frame.index(x, y);
                frame.words[pixel] = blank(shader.shade_once(&eight));
            }
        }
        return Some(frame);
    }
    let mut frames = Vec::new();
    for (pass, words) in passes.iter().zip(&words) {
        let mut frame = Frame::blank(pass.size, shader.background);
        for y in 0..pass.size.height() {
            step(of_row)?;
            shade_row(&mut frame, words, shader, y);
        }
        frames.push(frame);
    }
    match <[Frame; 2]>::try_from(frames) {
        Ok(two) => Some(average_eight(&two)),
        Err(one) => one.into_iter().next(),
    }
}

/// The frame of eight samples a pixel, from two at twice its width and height: each channel is `floor((sum + 4) / 8)` of theirs (facts
/// E0). Depths are the greatest.
///
/// The Gouraud frame of eight samples is this of [`render`](super::render) on what [`project_sample`](crate::project_sample) makes, first
/// without a shift and then with [`SECOND_SHIFT`](crate::deferred::SECOND_SHIFT).
///
/// ```
/// use tilewright_scenes::{Frame, Size, frame, golden};
///
/// let doubled = Size::new(4, 2)?;
/// let [mut first, second] = [[0; 3], [80, 0, 8]].map(|colour| Frame::blank(doubled, colour));
/// first.words[2] = frame::blank([4, 3, 255]);
/// let averaged = golden::average_eight(&[first, second]);
/// assert_eq!([averaged.rgb(0, 0), averaged.rgb(1, 0)], [[40, 0, 4], [41, 0, 36]]);
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
///
/// # Panics
/// If the frames differ in size, or have no even sides.
pub fn average_eight(passes: &[Frame; 2]) -> Frame {
    let doubled = passes[0].size();
    assert!(passes[1].size() == doubled && doubled.width().is_multiple_of(2) && doubled.height().is_multiple_of(2));
    let size = Size::new(doubled.width() / 2, doubled.height() / 2).expect("half of a size, and no side is zero");
    let mut frame = Frame::blank(size, [0; 3]);
    for y in 0..size.height() {
        for x in 0..size.width() {
            let colours = samples_of(size, x, y).map(|(pass, pixel)| rgb_of(passes[pass].words[pixel]));
            let mean = |channel: usize| {
                let sum: u16 = colours.iter().map(|colour| u16::from(colour[channel])).sum();
                ((sum + 4) / 8) as u8
            };
            let pixel = frame.index(x, y);
            frame.words[pixel] = blank([mean(0), mean(1), mean(2)]);
        }
    }
    frame
}

/// The eight samples of pixel (x, y) of a frame of `size`: the pass that each is of, and its pixel there.
fn samples_of(size: Size, x: u32, y: u32) -> [(usize, usize); 8] {
    let pixel = |dx: u32, dy: u32| (2 * y + dy) as usize * 2 * size.width() as usize + (2 * x + dx) as usize;
    let four = [pixel(0, 0), pixel(1, 0), pixel(0, 1), pixel(1, 1)];
    std::array::from_fn(|i| (i / 4, four[i % 4]))
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

fn shade_row(frame: &mut Frame, words: &[Appearance], shader: &Shader, y: u32) {
    for x in 0..frame.size().width() {
        let pixel = frame.index(x, y);
        frame.words[pixel] = blank(shader.shade(words[pixel]));
    }
}
