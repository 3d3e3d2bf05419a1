//! Golden frames of eight samples a pixel.

use super::{passes::mean, render_watched};
use crate::frame::{Frame, blank, rgb_of};
use crate::project::Projection;
use crate::size::Size;
use std::ops::ControlFlow;

/// Renders the result of [`project_samples`](crate::project_samples). With one pass it is the frame of
/// [`render`](super::render); with two it is [`average_eight`] of theirs.
///
/// ```
/// use tilewright_scenes::deferred::{Samples, Shading};
/// use tilewright_scenes::{Scene, Size, golden, project_samples};
///
/// let (scene, size) = (Scene::builtin("star").unwrap(), Size::new(64, 48)?);
/// let passes = project_samples(&scene, size, Samples::Eight(Shading::EachSample))?;
/// assert_eq!(golden::render_samples(&passes, scene.background).size(), size);
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
///
/// # Panics
/// If there is not one pass, or two.
pub fn render_samples(passes: &[Projection], background: [u8; 3]) -> Frame {
    render_samples_watched(passes, background, |_| ControlFlow::Continue(())).expect("one or two passes")
}

/// As [`render_samples`], watched as in [`render_watched`].
pub fn render_samples_watched(
    passes: &[Projection],
    background: [u8; 3],
    mut watch: impl FnMut(f64) -> ControlFlow<()>,
) -> Option<Frame> {
    let render = |(i, pass): (usize, &Projection)| {
        let part = |done| (i as f64 + done) / passes.len() as f64;
        render_watched(pass.size, &pass.triangles, background, |done| watch(part(done)))
    };
    of_passes(passes.iter().enumerate().map(render).collect::<Option<_>>()?)
}

/// The frame that one pass has drawn, or two.
pub(super) fn of_passes(frames: Vec<Frame>) -> Option<Frame> {
    match <[Frame; 2]>::try_from(frames) {
        Ok(two) => Some(average_eight(&two)),
        Err(one) => <[Frame; 1]>::try_from(one).ok().map(|[frame]| frame),
    }
}

/// The frame of eight samples a pixel, from two at twice its width and height: each channel is `floor((sum + 4) / 8)`
/// of theirs (facts E0). All depths are the greatest.
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
            let pixel = frame.index(x, y);
            frame.words[pixel] = blank(mean(&colours));
        }
    }
    frame
}

/// The eight samples of pixel (x, y) of a frame of `size`: the pass of each, and its pixel there.
pub(super) fn samples_of(size: Size, x: u32, y: u32) -> [(usize, usize); 8] {
    let pixel = |dx: u32, dy: u32| (2 * y + dy) as usize * 2 * size.width() as usize + (2 * x + dx) as usize;
    let four = [pixel(0, 0), pixel(1, 0), pixel(0, 1), pixel(1, 1)];
    std::array::from_fn(|i| (i / 4, four[i % 4]))
}
