//! Pictures of a run: the unit that drew each pixel, the activity of each unit over time, and the frame as it is drawn.

mod film;
mod label;
pub mod owners;
mod painted;
pub mod times;

pub use painted::{Paint, Painted, all_on_a_sheet, animation, sheet};

use crate::shell::output::Output;
use crate::shell::{Exit, Failure};
use clap::Args;
use std::path::{Path, PathBuf};
use tilewright_machines::Recorder;
use tilewright_scenes::Frame;

/// The pictures that the user asks for.
#[derive(Args, Default)]
#[command(next_help_heading = "Pictures of the run")]
pub struct PictureOptions {
    /// A PNG file (`-`: standard output) that shows which unit drew each pixel. Each unit has a colour, as light as the frame; grey is where nothing was drawn
    #[arg(long, value_name = "FILE")]
    owners: Option<PathBuf>,
    /// An SVG file (`-`: standard output) that shows what each unit did over time, in the classes of clocks of the report. A square beside a unit has its colour
    /// of --owners
    #[arg(long, value_name = "FILE")]
    timeline: Option<PathBuf>,
    /// An animated PNG file (`-`: standard output) of the frame being drawn. Each pixel appears when the machine wrote it, in its colour of the frame, or with
    /// --owners in that of the unit
    #[arg(long, value_name = "FILE")]
    animate: Option<PathBuf>,
}

impl PictureOptions {
    /// The files.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.given().map(|(_, path)| path)
    }

    /// The first option that is given, if any is.
    pub fn first(&self) -> Option<&'static str> {
        self.given().next().map(|(name, _)| name)
    }

    fn given(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let PictureOptions { owners, timeline, animate } = self;
        let all = [("--owners", owners), ("--timeline", timeline), ("--animate", animate)];
        all.into_iter().filter_map(|(name, path)| Some((name, path.as_deref()?)))
    }

    /// Checks that the run has one frame, as the pictures need; the `other` option makes several.
    ///
    /// # Errors
    /// They cannot.
    pub fn check(&self, other: Option<&str>) -> Result<(), Failure> {
        check_film(self.animate.as_deref())?;
        let Some((name, other)) = self.first().zip(other) else { return Ok(()) };
        let sentence = format!("{name} shows one frame, and {other} makes several: leave one of them out");
        Err(Failure::new(Exit::BadInput, sentence))
    }

    /// Finds out whether the files can be written.
    ///
    /// # Errors
    /// One cannot.
    pub fn open(&self) -> Result<Pictures, Failure> {
        let at = |path: &Option<PathBuf>| path.as_deref().map(Output::at).transpose();
        Ok(Pictures {
            owners: at(&self.owners)?,
            timeline: at(&self.timeline)?,
            animate: at(&self.animate)?,
            recorder: self.first().map(|_| Recorder::default()),
        })
    }
}

/// Checks that an animation is not to be a GIF, which is not supported.
///
/// # Errors
/// It is.
pub fn check_film(path: Option<&Path>) -> Result<(), Failure> {
    let is_gif = |path: &&Path| path.extension().is_some_and(|it| it.eq_ignore_ascii_case("gif"));
    match path.filter(is_gif) {
        Some(path) => {
            let sentence =
                format!("{}: animations are written as animated PNG, not as GIF: name the file .png", path.display());
            Err(Failure::new(Exit::BadInput, sentence))
        }
        None => Ok(()),
    }
}

/// The files of the pictures to make.
pub struct Pictures {
    owners: Option<Output>,
    timeline: Option<Output>,
    animate: Option<Output>,
    recorder: Option<Recorder>,
}

impl Pictures {
    /// Where the machine records what it does, if any picture needs it.
    pub fn recorder(&self) -> Option<&Recorder> {
        self.recorder.as_ref()
    }

    /// Makes the pictures of a run that gave this frame.
    pub fn made(self, title: &str, frame: &Frame) -> Vec<(Output, Vec<u8>)> {
        let Some(history) = self.recorder.and_then(|recorder| recorder.take()) else { return Vec::new() };
        let paint = if self.owners.is_some() { Paint::Owners } else { Paint::Frame };
        let painted = |paint| Painted { history: &history, frame, paint, label: None };
        let owners = self.owners.map(|output| (output, painted(Paint::Owners).last().to_png()));
        let timeline = self.timeline.map(|output| (output, times::chart(&history, title).svg_text().into_bytes()));
        let animate = self.animate.map(|output| (output, animation(&[painted(paint)])));
        [owners, timeline, animate].into_iter().flatten().collect()
    }
}
