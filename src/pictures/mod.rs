//! Pictures of a run beside its frame: who drew which pixel, what each unit did when, and the frame coming into being.

mod film;
mod label;
pub mod owners;
mod painted;
mod times;

pub use painted::{Paint, Painted, all_on_a_sheet, animation, sheet};

use crate::shell::output::Output;
use crate::shell::{Exit, Failure};
use clap::Args;
use std::path::{Path, PathBuf};
use tilewright_machines::Recorder;
use tilewright_scenes::Frame;

/// Which of them are asked for.
#[derive(Args, Default)]
#[command(next_help_heading = "Pictures of the run")]
pub struct PictureOptions {
    /// Who drew which pixel, a PNG file (`-`: standard output): a colour for each unit that draws, as light as the frame; grey is where nothing was drawn
    #[arg(long, value_name = "FILE")]
    owners: Option<PathBuf>,
    /// What each unit did when, in the classes of clocks that the report has, as a chart in an SVG file (`-`: standard output); beside a unit that draws is its
    /// colour of --owners
    #[arg(long, value_name = "FILE")]
    timeline: Option<PathBuf>,
    /// The frame coming into being, an animated PNG file (`-`: standard output): each pixel comes when the machine wrote it, in the colours of the frame, or with
    /// --owners in those of the units
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

    /// That they can be made of a run of one frame, or of what that `other` option makes.
    ///
    /// # Errors
    /// They cannot.
    pub fn check(&self, other: Option<&str>) -> Result<(), Failure> {
        check_film(self.animate.as_deref())?;
        let Some((name, other)) = self.first().zip(other) else { return Ok(()) };
        let sentence = format!("{name} is about one frame, and {other} makes several: leave one of them out");
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

/// That an animation is not to be what is not written here.
///
/// # Errors
/// It is.
pub fn check_film(path: Option<&Path>) -> Result<(), Failure> {
    let is_gif = |path: &&Path| path.extension().is_some_and(|it| it.eq_ignore_ascii_case("gif"));
    match path.filter(is_gif) {
        Some(path) => {
            let sentence = format!(
                "{}: an animation is an animated PNG, which has all colours and is smaller than a GIF: name it .png",
                path.display()
            );
            Err(Failure::new(Exit::BadInput, sentence))
        }
        None => Ok(()),
    }
}

/// The files of pictures that are to be made.
pub struct Pictures {
    owners: Option<Output>,
    timeline: Option<Output>,
    animate: Option<Output>,
    recorder: Option<Recorder>,
}

impl Pictures {
    /// Where the machine is to leave what it did, if any picture is asked for.
    pub fn recorder(&self) -> Option<&Recorder> {
        self.recorder.as_ref()
    }

    /// Makes them, of a scene on a machine, of which this frame came.
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
