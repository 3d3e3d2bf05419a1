//! Golden pictures that are the average of several frames.

use crate::frame::{Frame, depth_of, rgb_of, word};

/// The distance by which the vertices move in each pass of a picture, in 1/16 pixel, for pictures of 2, 4, 8 and 16
/// passes.
///
/// They are Direct3D's standard patterns with as many samples; the VC-1 paper gives none (VC1-ACB).
const SHIFTS: [&[[i32; 2]]; 4] = [
    &[[4, 4], [-4, -4]],
    &[[-2, -6], [6, -2], [-6, 2], [2, 6]],
    &[[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]],
    &[
        [1, 1],
        [-1, -3],
        [-3, 2],
        [4, -1],
        [-5, -2],
        [2, 5],
        [5, 3],
        [3, -5],
        [-2, 6],
        [0, -7],
        [-4, -6],
        [-6, 4],
        [-8, 0],
        [7, -4],
        [6, 7],
        [-7, -8],
    ],
];

/// The distance by which [`project_sample`](crate::project_sample) moves the vertices in each pass, in 1/16 pixel;
/// `None` unless there are 2, 4, 8 or 16 passes.
///
/// ```
/// use tilewright_scenes::golden::pass_shifts;
///
/// assert_eq!(pass_shifts(2), Some(&[[4, 4], [-4, -4]][..]));
/// assert_eq!(pass_shifts(3), None);
/// ```
pub fn pass_shifts(passes: u32) -> Option<&'static [[i32; 2]]> {
    SHIFTS.into_iter().find(|shifts| shifts.len() == passes as usize)
}

/// The picture of several passes (VC1-ACB): each channel is `floor((sum + n / 2) / n)` of the `n` passes. The depths
/// are those of the last pass.
///
/// ```
/// use tilewright_scenes::{Frame, Size, golden};
///
/// let passes = [[0, 1, 200], [3, 1, 101]].map(|rgb| Frame::blank(Size::new(2, 2).unwrap(), rgb));
/// assert_eq!(golden::average(&passes).rgb(1, 0), [2, 1, 151]);
/// ```
///
/// # Panics
/// If there is no pass, or the passes differ in size.
pub fn average(passes: &[Frame]) -> Frame {
    let mut picture = passes.last().expect("there is a pass").clone();
    assert!(passes.iter().all(|pass| pass.size() == picture.size()), "the passes are of one size");
    for (pixel, last) in picture.words.iter_mut().enumerate() {
        let colours: Vec<[u8; 3]> = passes.iter().map(|pass| rgb_of(pass.words[pixel])).collect();
        *last = word(depth_of(*last), mean(&colours));
    }
    picture
}

/// Each channel's mean, halves rounded up.
pub(super) fn mean(colours: &[[u8; 3]]) -> [u8; 3] {
    let count = colours.len() as u32;
    [0, 1, 2].map(|channel| {
        let sum: u32 = colours.iter().map(|colour| u32::from(colour[channel])).sum();
        ((sum + count / 2) / count) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pattern_has_its_samples_within_a_pixel_each_once() {
        for (shifts, exponent) in SHIFTS.iter().zip(1..) {
            let mut sorted = shifts.to_vec();
            sorted.sort_unstable();
            sorted.dedup();
            assert_eq!(sorted.len(), 1 << exponent);
            assert!(shifts.iter().flatten().all(|shift| (-8..=7).contains(shift)));
            // A row or column of sixteenths has at most one sample, except with two passes.
            let rows: std::collections::BTreeSet<i32> = shifts.iter().map(|[_, y]| *y).collect();
            assert_eq!(rows.len(), shifts.len());
        }
    }
}
