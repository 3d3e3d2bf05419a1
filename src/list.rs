//! `tilewright list`: what there is to render, to run and to print.

use crate::block::entries;
use crate::machine::{Machine, MachineOption};
use crate::shell::{Exit, Failure, terminal};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::fmt::Write;
use tilewright_hdl::catalog::{CatalogError, Entry};
use tilewright_scenes::{Scene, builtin};

/// Lists machines, scenes, and blocks with their scenarios and parameters
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright list
  tilewright list --json")]
pub struct List {
    /// Print the lists as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Lists {
    format: u32,
    machines: Vec<MachineItem>,
    scenes: Vec<SceneItem>,
    blocks: Vec<BlockItem>,
}

#[derive(Serialize)]
struct MachineItem {
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    options: Vec<MachineOption>,
}

#[derive(Serialize)]
struct SceneItem {
    name: &'static str,
    polygons: usize,
    lines: usize,
    spheres: usize,
    size: [u32; 2],
}

#[derive(Serialize)]
struct BlockItem {
    name: &'static str,
    summary: &'static str,
    scenario: &'static str,
    parameters: Vec<ParameterItem>,
}

#[derive(Serialize)]
struct ParameterItem {
    name: &'static str,
    default: u64,
    min: u64,
    max: u64,
    meaning: &'static str,
}

impl List {
    /// Prints the lists.
    pub fn run(self) -> Result<Exit, Failure> {
        let lists = Lists {
            format: 1,
            machines: Machine::value_variants().iter().copied().map(machine).collect(),
            scenes: builtin::NAMES.into_iter().filter_map(scene).collect(),
            blocks: entries().map(block).collect::<Result<_, _>>()?,
        };
        if self.json {
            terminal::print_json(&lists)?
        } else {
            terminal::print(&table(&lists))?
        }
        Ok(Exit::Done)
    }
}

fn machine(machine: Machine) -> MachineItem {
    MachineItem {
        name: machine.name(),
        summary: machine.summary(),
        source: machine.source(),
        options: machine.options(),
    }
}

fn scene(name: &'static str) -> Option<SceneItem> {
    let scene = Scene::builtin(name)?;
    let (polygons, lines) = (scene.mesh.triangles().len(), scene.mesh.lines().len());
    let spheres = scene.spheres.len();
    Some(SceneItem { name, polygons, lines, spheres, size: [scene.size.width(), scene.size.height()] })
}

fn block(entry: &Entry) -> Result<BlockItem, CatalogError> {
    let scenario = entry.scenario(&entry.values([])?)?;
    let parameters = entry.parameters.iter().map(|it| ParameterItem {
        name: it.name,
        default: it.default,
        min: it.min,
        max: it.max,
        meaning: it.meaning,
    });
    Ok(BlockItem {
        name: entry.name,
        summary: entry.summary,
        scenario: scenario.about,
        parameters: parameters.collect(),
    })
}

fn table(lists: &Lists) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_table(&mut text, lists);
    text
}

fn write_table(text: &mut String, lists: &Lists) -> std::fmt::Result {
    let names = lists.machines.iter().map(|it| it.name).chain(lists.scenes.iter().map(|it| it.name));
    let wide = names.chain(lists.blocks.iter().map(|it| it.name)).map(str::len).max().unwrap_or(0);
    writeln!(text, "Machines (tilewright render SCENE --machine NAME)")?;
    for MachineItem { name, summary, source, options } in &lists.machines {
        writeln!(text, "  {name:wide$}  {summary}\n  {:wide$}  {source}", "")?;
        for MachineOption { option, meaning } in options {
            writeln!(text, "  {:wide$}  {option:19} {meaning}", "")?;
        }
    }
    writeln!(text, "\nScenes (tilewright render NAME), or the path of a .toml, .obj, .gltf, .glb, .ply or .stl file")?;
    for SceneItem { name, polygons, lines, spheres, size: [width, height] } in &lists.scenes {
        let (count, what) = if *polygons == 0 { (lines, "lines") } else { (polygons, "polygons") };
        let spheres = if *spheres == 0 { String::new() } else { format!(" and {spheres} spheres") };
        writeln!(text, "  {name:wide$}  {count:>6} {what}{spheres}, {width}x{height} pixels")?;
    }
    writeln!(text, "\nBlocks (tilewright wave NAME, tilewright verilog NAME), each with its scenario and parameters")?;
    for BlockItem { name, summary, scenario, parameters } in &lists.blocks {
        writeln!(text, "  {name:wide$}  {summary}\n  {:wide$}  scenario: {scenario}", "")?;
        for ParameterItem { name, default, min, max, meaning } in parameters {
            let setting = format!("--set {name}={default}");
            writeln!(text, "  {:wide$}  {setting:17} {min} to {max}: {meaning}", "")?;
        }
    }
    Ok(())
}
