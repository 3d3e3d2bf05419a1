//! The full description of each thing, as text and as JSON.

use super::block::BlockItem;
use super::shown::{Part, Shown};
use crate::machine::{Machine, MachineOption};
use crate::shell::Failure;
use clap::ValueEnum;
use serde::Serialize;
use std::fmt;
use tilewright_benches::Family;
use tilewright_hdl::catalog::Entry;
use tilewright_rtl::catalog::GROUPS;
use tilewright_scenes::{Scene, builtin};
use tilewright_sim::Pass;

/// The files that can be read, by extension.
pub const FILES: [(&str, &str); 5] = [
    (".toml", "a scene: its mesh, camera, lights, surface and size"),
    (".obj", "a mesh, a Wavefront OBJ file, with the materials of its .mtl files"),
    (".gltf, .glb", "a mesh, a glTF 2.0 file"),
    (".ply", "a mesh, a PLY file, text or binary"),
    (".stl", "a mesh, an STL file, text or binary"),
];

/// The things that the user asks for.
#[derive(Serialize)]
pub struct Lists {
    format: u32,
    machines: Vec<MachineItem>,
    scenes: Vec<SceneItem>,
    files: Vec<Thing>,
    blocks: Vec<BlockItem>,
    designs: Vec<Thing>,
    passes: Vec<Thing>,
}

/// A thing with a description of one line.
#[derive(Serialize)]
pub struct Thing {
    name: String,
    about: &'static str,
}

#[derive(Serialize)]
struct MachineItem {
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    options: Vec<MachineOption>,
}

/// A built-in scene.
#[derive(Serialize)]
pub struct SceneItem {
    pub name: &'static str,
    polygons: usize,
    lines: usize,
    spheres: usize,
    size: [u32; 2],
}

impl Lists {
    /// The descriptions of what the user asks for.
    ///
    /// # Errors
    /// A block cannot be elaborated, which would be a mistake in its catalogue.
    pub fn of(shown: Shown) -> Result<Lists, Failure> {
        let things = |part, all: Vec<(String, &'static str)>| {
            let asked = all.into_iter().filter(|(name, _)| shown.has(part, name));
            asked.map(|(name, about)| Thing { name, about }).collect()
        };
        let machines = Machine::value_variants().iter().filter(|it| shown.has(Part::Machines, it.name()));
        let library = tilewright_blocks::catalog::ENTRIES.iter().map(|entry| (None, entry));
        let blocks = GROUPS.iter().flat_map(|group| group.entries.iter().map(|entry| (Some(group.machine), entry)));
        let blocks = blocks.chain(library).filter(|(_, entry): &(_, &Entry)| shown.has(Part::Blocks, entry.name));
        Ok(Lists {
            format: 1,
            machines: machines.copied().map(MachineItem::of).collect(),
            scenes: builtin::NAMES
                .into_iter()
                .filter(|name| shown.has(Part::Scenes, name))
                .filter_map(SceneItem::of)
                .collect(),
            files: things(Part::Files, FILES.map(|(endings, about)| (endings.to_owned(), about)).into()),
            blocks: blocks.map(|(machine, entry)| BlockItem::of(machine, entry)).collect::<Result<_, _>>()?,
            designs: things(Part::Designs, Family::ALL.map(|it| (format!("{}N", it.name()), it.about())).into()),
            passes: things(Part::Passes, Pass::ALL.map(|it| (it.name().to_owned(), it.about())).into()),
        })
    }
}

impl MachineItem {
    fn of(machine: Machine) -> MachineItem {
        MachineItem {
            name: machine.name(),
            summary: machine.summary(),
            source: machine.source(),
            options: machine.options(),
        }
    }
}

impl SceneItem {
    /// The scene of that name, if there is one.
    pub fn of(name: &'static str) -> Option<SceneItem> {
        let scene = Scene::builtin(name)?;
        let (polygons, lines) = (scene.mesh.triangles().len(), scene.mesh.lines().len());
        let spheres = scene.spheres.len();
        Some(SceneItem { name, polygons, lines, spheres, size: [scene.size.width(), scene.size.height()] })
    }
}

impl fmt::Display for SceneItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SceneItem { polygons, lines, spheres, size: [width, height], .. } = self;
        let (count, what) = if *polygons == 0 { (lines, "lines") } else { (polygons, "polygons") };
        let spheres = if *spheres == 0 { String::new() } else { format!(" and {spheres} spheres") };
        write!(f, "{count} {what}{spheres}, {width}x{height} pixels")
    }
}

impl fmt::Display for MachineItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MachineItem { name, summary, source, options } = self;
        writeln!(f, "{name}: {summary}\n\nSource    {source}")?;
        writeln!(f, "\nOptions of tilewright render SCENE --machine {name}")?;
        let wide = options.iter().map(|it| it.option.len()).max().unwrap_or(0);
        options.iter().try_for_each(|MachineOption { option, meaning }| writeln!(f, "  {option:wide$}  {meaning}"))
    }
}

impl fmt::Display for Lists {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scene = |it: &SceneItem| format!("{}: {it}\n\n  tilewright render {0} -o {0}.png\n", it.name);
        let thing = |it: &Thing| format!("{}: {}\n", it.name, it.about);
        let machines = self.machines.iter().map(ToString::to_string);
        let texts = machines
            .chain(self.scenes.iter().map(scene))
            .chain(self.files.iter().map(thing))
            .chain(self.blocks.iter().map(ToString::to_string))
            .chain(self.designs.iter().chain(&self.passes).map(thing));
        f.write_str(&texts.collect::<Vec<_>>().join("\n"))
    }
}
