//! Renders a built-in scene on the VC-1 and says how fast that was: `cargo run --release --example frame -- teapot 16 4096` for
//! 16 processing elements with 4096 pages each.

use std::time::Instant;

use tilewright_machines::Watch;
use tilewright_machines::vc1::{Config, Machine};
use tilewright_scenes::{Scene, compare, golden};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or("teapot".to_owned());
    let scene = Scene::builtin(&name).ok_or("there is no such built-in scene")?;
    let mut config = Config::new(scene.size);
    if let Some(processors) = arguments.next() {
        config.processors = processors.parse()?;
    }
    if let Some(pages) = arguments.next() {
        config.pages = Some(pages.parse()?);
    }
    let projection = scene.project()?;
    let machine = Machine::new(config)?;
    let begin = Instant::now();
    let (frame, report) = machine.render(&projection, scene.background, &mut Watch::default())?;
    let seconds = begin.elapsed().as_secs_f64();
    println!("{report}");
    let golden = golden::render(scene.size, &projection.triangles, scene.background);
    println!("Against the golden frame: {}.", compare(&frame, &golden));
    eprintln!("{seconds:.2} s, {:.0} clocks a second", report.clocks() as f64 / seconds);
    Ok(())
}
