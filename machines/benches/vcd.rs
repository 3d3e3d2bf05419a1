//! What a waveform costs: the teapot on a VC-1 of 16 processing elements, rendered without one and with one that shows
//! everything, alternately. `cargo bench -p tilewright-machines --bench vcd` takes the medians of 3 rounds, and
//! `-- N` after it those of N; the file, of about 800 MB, goes to the folder for temporary files and is deleted.

use std::error::Error;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::time::Instant;

use tilewright_machines::Watch;
use tilewright_machines::vc1::{Config, Machine};
use tilewright_scenes::{Projection, Scene};
use tilewright_sim::Vcd;

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo adds `--bench`.
    let rounds = std::env::args().skip(1).find(|it| it != "--bench").map_or(Ok(3), |it| it.parse::<usize>())?.max(1);
    let scene = Scene::builtin("teapot").ok_or("there is no teapot")?;
    let projection = scene.project()?;
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("frame.vcd");
    let (mut plain, mut traced) = (Vec::new(), Vec::new());
    for _ in 0..rounds {
        plain.push(seconds(&scene, &projection, None)?);
        traced.push(seconds(&scene, &projection, Some(&file))?);
    }
    let (plain, traced) = (median(plain), median(traced));
    let size = file.metadata()?.len() as f64 / 1e6;
    let (times, changes) = count(&file)?;
    let cost = traced - plain;
    println!("without a waveform  {plain:6.2} s");
    println!("with a waveform     {traced:6.2} s, {:.2} times as long", traced / plain);
    println!("the file            {size:6.0} MB, {changes:.1} million changes at {times:.1} million times");
    println!("in the time added   {:6.0} MB/s, {:.1} million changes/s", size / cost, changes / cost);
    Ok(())
}

/// How long a frame takes, with a waveform or without.
fn seconds(scene: &Scene, projection: &Projection, waveform: Option<&Path>) -> Result<f64, Box<dyn Error>> {
    let mut machine = Machine::new(Config { processors: 16, ..Config::new(scene.size) })?;
    if let Some(path) = waveform {
        machine.simulation().trace(Vcd::to(path))?;
    }
    let begin = Instant::now();
    machine.render(projection, scene.background, &mut Watch::default())?;
    Ok(begin.elapsed().as_secs_f64())
}

fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of[of.len() / 2]
}

/// How many times and value changes a waveform has, in millions.
fn count(path: &Path) -> Result<(f64, f64), Box<dyn Error>> {
    let mut file = BufReader::with_capacity(1 << 20, File::open(path)?);
    let (mut times, mut changes, mut line) = (0_u64, 0_u64, Vec::new());
    while !line.starts_with(b"$enddefinitions") {
        line.clear();
        if file.read_until(b'\n', &mut line)? == 0 {
            return Err("the waveform has no end of its header".into());
        }
    }
    line.clear();
    while file.read_until(b'\n', &mut line)? > 0 {
        match line[0] {
            b'#' => times += 1,
            b'0' | b'1' | b'b' | b's' => changes += 1,
            _ => {}
        }
        line.clear();
    }
    Ok((times as f64 / 1e6, changes as f64 / 1e6))
}
