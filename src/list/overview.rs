//! The list with one line for each thing.

use super::items::{FILES, SceneItem};
use super::shown::Part;
use crate::machine::Machine;
use clap::ValueEnum;
use std::fmt::Write;
use tilewright_benches::Family;
use tilewright_hdl::catalog::Entry;
use tilewright_rtl::catalog::GROUPS;
use tilewright_scenes::builtin;
use tilewright_sim::Pass;

/// The lines of those parts, each under its heading.
pub fn text(parts: &[Part]) -> String {
    let sections: Vec<String> = parts.iter().map(|part| section(*part)).collect();
    let rest = match parts.len() {
        1 => "",
        _ => {
            "\n`tilewright list NAME` describes a block, a machine or a scene in full; `tilewright list all` describes everything.\n"
        }
    };
    sections.join("\n") + rest
}

fn section(part: Part) -> String {
    match part {
        Part::Scenes => {
            let scenes = builtin::NAMES.into_iter().filter_map(SceneItem::of);
            lines("Scenes (tilewright render NAME)", scenes.map(|scene| (scene.name.to_owned(), scene.to_string())))
        }
        Part::Files => lines(
            "Files of scenes and meshes (tilewright render PATH)",
            FILES.map(|(endings, about)| (endings.to_owned(), about.to_owned())),
        ),
        Part::Machines => lines(
            "Machines (tilewright render SCENE --machine NAME)",
            Machine::value_variants().iter().map(|it| (it.name().to_owned(), it.summary().to_owned())),
        ),
        Part::Blocks => {
            let of_machines = GROUPS.map(|group| blocks(&format!("Blocks of {}", group.title), group.entries));
            let library = blocks("Blocks for any design", tilewright_blocks::catalog::ENTRIES);
            [of_machines.join("\n"), library].join("\n")
        }
        Part::Designs => lines(
            "Designs of the bench, with a size for N (tilewright bench NAME)",
            Family::ALL.map(|family| (format!("{}N", family.name()), family.about().to_owned())),
        ),
        Part::Passes => lines(
            "Passes of the simulator (tilewright explain BLOCK --pass NAME)",
            Pass::ALL.map(|pass| (pass.name().to_owned(), pass.about().to_owned())),
        ),
    }
}

fn blocks(heading: &str, entries: &[Entry]) -> String {
    let heading = format!("{heading} (tilewright wave NAME, tilewright verilog NAME -o FOLDER)");
    lines(&heading, entries.iter().map(|entry| (entry.name.to_owned(), entry.summary.to_owned())))
}

fn lines(heading: &str, things: impl IntoIterator<Item = (String, String)>) -> String {
    let things: Vec<(String, String)> = things.into_iter().collect();
    let wide = things.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let mut text = format!("{heading}\n");
    for (name, about) in things {
        // Writing to a string does not fail.
        let _ = writeln!(text, "  {name:wide$}  {about}");
    }
    text
}
