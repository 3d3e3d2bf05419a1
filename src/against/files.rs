//! `tilewright wave BLOCK --diff A B`: two waveform files, of which one is the block's run. A file has no circuit, and so no causes. The block
//! has, as far as its run is that of the file.

use super::{Ours, first_difference};
use crate::block::BlockArguments;
use crate::first_difference::{Both, Waves, matched};
use crate::shell::{Exit, Failure};
use std::path::PathBuf;
use tilewright_sim::EngineKind;

/// Compares the block's run, which one of the files has, with the other file.
///
/// # Errors
/// A file cannot be read; neither is the block's run; an assertion fails.
pub fn run(paths: &[PathBuf], block: &BlockArguments, json: bool) -> Result<Exit, Failure> {
    let [one, other] = paths else {
        return Err(Failure::new(Exit::BadInput, "--diff takes two waveform files: name both"));
    };
    let files = [Waves::read(one)?, Waves::read(other)?];
    let ours = Ours::of(block, EngineKind::default())?.without_free_reads()?;
    let Some(same) = files.iter().position(|file| is_run(&ours, file)) else {
        let [one, other] = files.map(|file| file.name);
        let sentence = format!(
            "neither {one} nor {other} is the run of {} with these parameters, so what causes their difference is not known: give each \
             --set that a file was written with, or leave out the block",
            ours.entry.name
        );
        return Err(Failure::new(Exit::BadInput, sentence));
    };
    ours.compare(&files[1 - same], false, Some(&files[same].name), json)
}

/// Whether a file is the block's run, in the signals and the clocks that it has.
fn is_run(ours: &Ours, file: &Waves) -> bool {
    let files = [&ours.run.waves, file];
    let matched = ours.run.comparable(matched(files), false);
    let both = Both::new(files, &matched.pairs);
    let instants = ours.run.instants_of(&both);
    !matched.pairs.is_empty() && !instants.is_empty() && first_difference(&both, &instants).is_none()
}
