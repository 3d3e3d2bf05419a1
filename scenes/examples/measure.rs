//! Measures scenes, by default the built-in ones: the load on a machine, and the checksums in `tests/pinned.rs`.
//!
//! `cargo run --release -p tilewright-scenes --example measure [SCENE ...]`

use std::process::ExitCode;
use std::time::Instant;
use tilewright_scenes::deferred::{Samples, Shading, project_deferred};
use tilewright_scenes::{Scene, SceneError, builtin, golden, project_polygons};

fn main() -> ExitCode {
    match measure() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// The measurements of a scene with spheres.
fn spheres(scene: &Scene) -> Result<(), SceneError> {
    let polygons = project_polygons(scene, scene.size)?;
    let frame = golden::render_polygons(&polygons, golden::Rule::Least, scene.background);
    frame.write_png(std::env::temp_dir().join(format!("{}.png", scene.name)))?;
    println!("{} at {}\n  {:?}", scene.name, scene.size, polygons.counts);
    println!("  {} pixels drawn", golden::fragments_of(&polygons));
    println!("  mesh checksum {:#018x}, frame checksum {:#018x}", scene.mesh.checksum(), frame.checksum());
    Ok(())
}

fn measure() -> Result<(), SceneError> {
    let mut names: Vec<String> = std::env::args().skip(1).collect();
    if names.is_empty() {
        names = builtin::NAMES.map(str::to_owned).to_vec();
    }
    for name in names {
        let begun = Instant::now();
        let scene = Scene::load(&name)?;
        scene.warnings.iter().for_each(|warning| println!("{warning}"));
        let (name, size) = (&scene.name, scene.size);
        let made = begun.elapsed();
        if !scene.spheres.is_empty() {
            spheres(&scene)?;
            continue;
        }
        let projection = scene.project()?;
        let projected = begun.elapsed();
        let triangles = &projection.triangles;
        let frame = golden::render(size, triangles, scene.background);
        let rendered = begun.elapsed();
        let ties = golden::ties(size, triangles);
        let area: f64 = triangles.iter().map(|t| t.area()).sum();
        let largest = triangles.iter().map(|t| t.area()).fold(0.0, f64::max);
        let blank = tilewright_scenes::frame::blank(scene.background);
        let patches = (0..size.height().div_ceil(4))
            .flat_map(|y| (0..size.width().div_ceil(4)).map(move |x| (x, y)))
            .filter(|&(px, py)| {
                (0..16).any(|i| {
                    let (x, y) = (4 * px + i % 4, 4 * py + i / 4);
                    x < size.width() && y < size.height() && frame.word(x, y) != blank
                })
            })
            .count();
        frame.write_png(std::env::temp_dir().join(format!("{name}.png")))?;
        let deferred = [
            ("deferred", Samples::One),
            ("eight", Samples::Eight(Shading::EachSample)),
            ("eight-shaded-once", Samples::Eight(Shading::OncePerPixel)),
        ];
        println!("{name} at {size}");
        println!("  {:?}", projection.counts);
        println!(
            "  packets {}, mean area {:.2} px, largest {largest:.0} px",
            triangles.len(),
            area / triangles.len() as f64
        );
        println!("  covered {:.1} %, {patches} patches of 4x4", 100.0 * ties.covered as f64 / size.pixels() as f64);
        println!("  exact ties at {} pixels, {} of them decided by colour", ties.pixels, ties.decided_by_colour);
        println!("  mesh checksum {:#018x}, frame checksum {:#018x}", scene.mesh.checksum(), frame.checksum());
        for (kind, samples) in deferred {
            let begun = Instant::now();
            let frame = golden::render_deferred(&project_deferred(&scene, size, samples)?);
            frame.write_png(std::env::temp_dir().join(format!("{name}-{kind}.png")))?;
            println!("  {kind}: frame checksum {:#018x}, in {:.0?}", frame.checksum(), begun.elapsed());
        }
        println!(
            "  built in {made:.0?}, projected in {:.0?}, rendered in {:.0?}",
            projected - made,
            rendered - projected
        );
    }
    Ok(())
}
