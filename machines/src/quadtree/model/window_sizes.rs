//! The widths of windows, measured from outside. Small squares move along the first line of the screen, and counters tell the number of windows
//! of each.
//!
//! Source: MPG-WIN, MPG-EQ2, figure 4. A window meets the squares on its first pixel to its last, one more than its width.

use super::record::{Packets, Run};
use super::simulated::Simulated;
use super::square::{BROADCAST, square};
use super::{Model, rasters_of};
use crate::error::Error;
use crate::quadtree::rasters::Rasters;
use crate::run::Watch;
use serde::Serialize;
use std::sync::atomic::AtomicBool;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::processor::Queues;
use tilewright_scenes::packet::SUBPIXELS;
use tilewright_scenes::{Polygon, ScreenVertex, Size, set_up_polygon_of_any_size};

/// The paper's aperture.
const APERTURE: u32 = 2;

/// Widths of windows over their spacing, by level from 1 to n.
///
/// ```
/// use tilewright_machines::{Watch, quadtree::model::WindowSizes};
///
/// let all = WindowSizes::measure(5, &[1, 2], &mut Watch::default())?.expect("not interrupted");
/// // With two by two processors windows are as wide as their spacing. With four by four the last ones are half as wide.
/// assert_eq!(all[0].hardware, [1.0; 4]);
/// assert_eq!((&all[1].model, &all[1].hardware), (&vec![0.875, 0.75, 0.5], &vec![0.875, 0.75, 0.5]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WindowSizes {
    /// The matrix.
    pub matrix: Rasters,
    /// From the transaction-level model's counters.
    pub model: Vec<f64>,
    /// From the hardware's counters.
    pub hardware: Vec<f64>,
}

impl WindowSizes {
    /// The widths for matrices of 2^k x 2^k processors, k from 1 on, on screens of 2^m x 2^m pixels with an aperture of 2. They are measured on
    /// all processors of the computer. `None` if interrupted.
    ///
    /// # Errors
    /// A parameter of the generator is out of range, k is 0, or an assertion of the hardware failed.
    pub fn measure(m: u32, sizes: &[u32], watch: &mut Watch) -> Result<Option<Vec<WindowSizes>>, Error> {
        let cancel = watch.cancel;
        let results = watch.each("measuring windows", sizes, |k| WindowSizes::of(m, *k, cancel));
        match results.map(|results| results.into_iter().collect::<Result<Vec<WindowSizes>, Error>>()) {
            None | Some(Err(Error::Cancelled { .. })) => Ok(None),
            Some(all) => all.map(Some),
        }
    }

    fn of(m: u32, k: u32, cancel: Option<&AtomicBool>) -> Result<WindowSizes, Error> {
        if k == 0 {
            let problem = "windows of one processor overlap: measure matrices of 2^k x 2^k processors, k from 1 on";
            return Err(ParameterError(problem.to_owned()).into());
        }
        let queues = Queues { broadcast: BROADCAST, packets: 1, windows: 1 };
        let generator = square((m, k), APERTURE, "pipe", queues)?;
        let matrix = rasters_of(&generator.format());
        let squares = squares(1 << m)?;
        let (packets, mut watch) = (Packets::at_once(&squares), Watch { progress: None, cancel });
        let hardware = Simulated::new(&generator)?.run(packets, &mut watch)?;
        let cancelled = Error::Cancelled { phase: "simulating", time: 0 };
        let model = Model::new(&generator)?.run(packets, &mut watch).ok_or(cancelled)?;
        Ok(WindowSizes { matrix, model: widths(&matrix, &model), hardware: widths(&matrix, &hardware) })
    }
}

/// A square in the middle of each pixel from a quarter to three quarters of the first line. Half the line is a whole number of spacings on
/// every level.
fn squares(side: u32) -> Result<Vec<Polygon>, ParameterError> {
    let size = Size::new(side, side).map_err(|error| ParameterError(error.to_string()))?;
    let squares = (side / 4..side / 4 * 3).flat_map(|column| {
        let (x, middle) = (column as i32 * SUBPIXELS, SUBPIXELS / 2);
        let corner = |dx: i32, dy: i32| ScreenVertex { x: x + middle + dx, y: middle + dy, z: 1, rgb: [0; 3] };
        set_up_polygon_of_any_size(&[corner(-2, -2), corner(2, -2), corner(2, 2), corner(-2, 2)], size)
    });
    Ok(squares.collect())
}

/// The widths from the first processor's counters. Only its windows on the first line meet squares.
fn widths(matrix: &Rasters, run: &Run) -> Vec<f64> {
    let of_level = |level: u32| {
        let spacing = f64::from(matrix.spacing(level).0);
        let met = run.processors[0].units[level as usize].results as f64;
        let windows = run.taken.len() as f64 / spacing;
        (met / windows - 1.0) / spacing
    };
    (1..=matrix.levels).map(of_level).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;

    /// The widths are exactly those of the definition, because all numbers are small and divided only by powers of two.
    #[test]
    fn they_are_those_of_the_paper() {
        let all = WindowSizes::measure(6, &[1, 2, 3], &mut Watch::default()).expect("possible").expect("done");
        for WindowSizes { matrix, model, hardware } in all {
            let paper: Vec<f64> = (1..=matrix.levels).map(|level| matrix.relative_window(level).0).collect();
            assert_eq!((&model, &hardware), (&paper, &paper));
        }
    }

    #[test]
    fn it_can_be_broken_off_and_knows_what_it_cannot_measure() {
        let cancel = AtomicBool::new(true);
        let mut watch = Watch { progress: None, cancel: Some(&cancel) };
        assert!(WindowSizes::measure(6, &[1], &mut watch).expect("possible").is_none());
        let problem = WindowSizes::measure(6, &[0], &mut Watch::default()).expect_err("impossible");
        assert!(problem.to_string().starts_with("windows of one processor overlap"), "{problem}");
    }
}
