//! `--stereo`: a frame for each eye.

use super::{PixelFlowJob, PixelFlowOptions};
use crate::machine::job::{Job, Run};
use crate::shell::Failure;
use clap::ValueEnum;
use tilewright_machines::pixelflow::{Config, Machine, Stereo, StereoReport};
use tilewright_scenes::{Frame, Scene, Size, side_by_side, stereo_size};

/// How the frames of two eyes share the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum StereoName {
    Halved,
    Sequential,
}

impl From<StereoName> for Stereo {
    fn from(name: StereoName) -> Stereo {
        match name {
            StereoName::Halved => Stereo::Halved,
            StereoName::Sequential => Stereo::Sequential,
        }
    }
}

/// A scene as two eyes see it, and the machine for it.
pub struct StereoJob {
    stereo: Stereo,
    distance: f64,
    /// Left and right.
    eyes: [PixelFlowJob; 2],
    /// Of both frames side by side.
    size: Size,
}

impl StereoJob {
    /// The frames of both eyes, each on the part of the machine that draws it.
    ///
    /// # Errors
    /// The distance between the eyes is out of range; or an error of a single frame.
    pub(super) fn new(
        options: &PixelFlowOptions,
        scene: &Scene,
        machine: &Config,
        stereo: Stereo,
    ) -> Result<StereoJob, Failure> {
        let distance = options.eyes.unwrap_or_else(|| scene.camera.eye_distance());
        let config = stereo.eye(machine).map_err(tilewright_machines::Error::from)?;
        let [left, right] = scene.eyes(distance)?;
        let machine = Machine::new(config.clone())?;
        let other = machine.another(config.clone())?;
        let eyes = [options.frame(&left, machine, config.clone())?, options.frame(&right, other, config)?];
        Ok(StereoJob { stereo, distance, size: stereo_size(eyes[0].size())?, eyes })
    }
}

impl Job for StereoJob {
    type Report = StereoReport;

    fn size(&self) -> Size {
        self.size
    }

    fn golden(&self) -> Result<Frame, Failure> {
        let [left, right] = &self.eyes;
        Ok(side_by_side(&[left.golden()?, right.golden()?])?)
    }

    fn render(&self, run: &Run) -> Result<(Frame, StereoReport), Failure> {
        let [left, right] = &self.eyes;
        let ((left, of_left), (right, of_right)) = (left.render(run)?, right.render(run)?);
        Ok((side_by_side(&[left, right])?, StereoReport::new(self.stereo, self.distance, [of_left, of_right])))
    }
}
