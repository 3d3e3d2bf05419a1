//! Helpers shared by several modules' tests.

/// The colours of the average of these passes, in plain software: each component is `floor((sum + n / 2) / n)`.
pub(crate) fn average(passes: &[Vec<u64>]) -> Vec<u64> {
    let count = passes.len() as u64;
    let component = |pixel: usize, shift: u32| {
        let sum: u64 = passes.iter().map(|pass| pass[pixel] >> shift & 0xff).sum();
        ((sum + count / 2) / count) << shift
    };
    (0..passes[0].len()).map(|pixel| [16, 8, 0].map(|shift| component(pixel, shift)).iter().sum()).collect()
}
