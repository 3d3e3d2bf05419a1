//! Several frames of one run, each a file and each compared.

use std::fmt;
use std::path::{Path, PathBuf};

use super::Render;
use crate::machine::{Run, Turn};
use crate::shell::output::{Output, Waveform};
use crate::shell::place::is_standard_output;
use crate::shell::{Exit, Failure};
use crate::verdict::{Golden, Verdict, leave_difference};
use serde::Serialize;
use tilewright_scenes::Scene;

/// The results of comparing all frames.
#[derive(Serialize)]
struct Verdicts {
    /// Whether all are identical.
    identical: bool,
    frames: Vec<Verdict>,
}

impl Render {
    /// Renders the frames of an orbit, compares them, writes the files and reports. An interrupted run leaves the frames shown so far.
    pub(super) fn render_turn(&self, scene: &Scene, turn: &Turn) -> Result<Exit, Failure> {
        self.check_turn()?;
        let paths: Vec<PathBuf> = self
            .output
            .iter()
            .flat_map(|path| (1..=turn.pictures).map(|number| numbered(path, number, turn.pictures)))
            .collect();
        self.check_distinct(&paths, scene)?;
        let waveform = self.vcd.as_deref().map(Waveform::at).transpose()?;
        // Check that the folder can be written before the machine is built.
        let _ = paths.first().map(|path| Output::at(path)).transpose()?;
        let run = Run { waveform: waveform.as_ref(), ..Run::new(self.engine, &self.filters) };
        let mut frames = Vec::new();
        let report = turn.render(&run, |number, picture, golden| {
            let verdict = Golden::Rendered(golden).judge(&picture);
            if let Some(path) = paths.get(number as usize) {
                Output::at(path)?.write(&picture.to_png())?;
                leave_difference(path, verdict.picture.as_ref());
            }
            frames.push(verdict);
            Ok(())
        })?;
        let verdicts = Verdicts { identical: frames.iter().all(|it| it.identical), frames };
        self.tell(scene, &report, &verdicts, verdicts.identical)
    }

    /// Checks that each frame has a file and a golden image of its own.
    fn check_turn(&self) -> Result<(), Failure> {
        let sentence = if self.golden.is_some() {
            "--golden names one picture, and --frames makes several: leave one of them out"
        } else if self.output.as_deref().is_some_and(is_standard_output) {
            "standard output takes one picture, and --frames makes several: name a file with -o, such as turn.png"
        } else {
            return Ok(());
        };
        Err(Failure::new(Exit::BadInput, sentence))
    }
}

impl fmt::Display for Verdicts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.identical {
            return write!(f, "all {} frames are identical to their golden images", self.frames.len());
        }
        let differing = (1..).zip(&self.frames).filter(|(_, it)| !it.identical);
        let sentences: Vec<String> = differing.map(|(number, verdict)| format!("frame {number}: {verdict}")).collect();
        f.write_str(&sentences.join("\n"))
    }
}

/// `turn.png` of frame 7 of 24 is `turn-007.png`.
fn numbered(path: &Path, number: u32, of: u32) -> PathBuf {
    let digits = of.to_string().len().max(3);
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number:0digits$}"));
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::{Frame, Size};

    #[test]
    fn one_frame_that_differs_is_told_by_its_number() {
        let golden = Frame::blank(Size::new(2, 2).unwrap(), [0; 3]);
        let mut other = golden.clone();
        other.words[3] -= 1;
        let verdicts = |frames: [&Frame; 2]| {
            let frames: Vec<Verdict> = frames.map(|it| Golden::Rendered(golden.clone()).judge(it)).into();
            Verdicts { identical: frames.iter().all(|it| it.identical), frames }.to_string()
        };
        assert_eq!(verdicts([&golden, &golden]), "all 2 frames are identical to their golden images");
        let sentence = verdicts([&golden, &other]);
        assert!(sentence.starts_with("frame 2: NOT identical to the golden image: "), "{sentence}");
        assert_eq!(sentence.lines().count(), 1);
    }

    #[test]
    fn frames_are_numbered_in_the_file_name() {
        let named = |path: &str, number, of| numbered(Path::new(path), number, of).display().to_string();
        assert_eq!(named("out/turn.png", 7, 24), "out/turn-007.png");
        assert_eq!(named("turn", 1000, 1000), "turn-1000");
    }
}
