//! The way of a pixel through a machine, as the page tells it.

use crate::machine::{Followed, Machine, Viewed, Visitor, check_pixel, follow, visit};
use crate::shell::Failure;
use crate::why::text::{Told, json};
use serde_json::Value;
use std::sync::atomic::AtomicBool;
use tilewright_machines::Way;
use tilewright_scenes::Scene;

/// What is known of a pixel.
pub struct PixelWay {
    /// As `why --json` prints it, with what the run itself failed with.
    pub told: Value,
    pub way: Way,
}

/// Draws the scene again, follows the pixel, and tells its way. It stops soon after `cancel` becomes true.
///
/// # Errors
/// The pixel is outside, the machine cannot draw the scene, or it was stopped.
pub fn way(scene: &Scene, machine: Machine, pixel: [u32; 2], cancel: &AtomicBool) -> Result<PixelWay, Failure> {
    visit(scene, machine, Asked { scene, machine, pixel, cancel })
}

struct Asked<'a> {
    scene: &'a Scene,
    machine: Machine,
    pixel: [u32; 2],
    cancel: &'a AtomicBool,
}

impl Visitor for Asked<'_> {
    type Output = PixelWay;

    fn visit(self, job: &impl Viewed) -> Result<PixelWay, Failure> {
        let (size, [x, y]) = (job.size(), self.pixel);
        check_pixel(size, self.pixel)?;
        let golden = job.golden()?;
        let Followed { frame, way, failed } = follow(job, self.pixel, Some(self.cancel))?;
        let told = Told {
            scene: &self.scene.name,
            machine: self.machine.name(),
            size,
            pixel: self.pixel,
            shown: frame.map(|frame| frame.word(x, y)),
            golden: golden.word(x, y),
            way: &way,
        };
        let mut told = json(&told, &[]);
        told["failed"] = failed.map(|failure| failure.line()).into();
        Ok(PixelWay { told, way })
    }
}
