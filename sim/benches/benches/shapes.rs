//! Machines whose values have shapes, by size: `cargo bench -p tilewright-benches --bench shapes`.

#[path = "../../../hdl/tests/shapes/build.rs"]
mod build;
#[path = "../../../hdl/tests/shapes/machines.rs"]
mod machines;

use std::time::Instant;

use tilewright_hdl::Design;
use tilewright_hdl::ir::Module;
use tilewright_sim::Simulation;

/// Cycles of a measurement.
const CYCLES: u64 = 2000;

/// The times in which a machine with this side is checked, runs its first cycle, and runs a later one, with inputs
/// that are all ones.
fn print(what: &str, side: u32, module: Module) {
    let nodes = module.nodes.len();
    let start = Instant::now();
    let design = Design::new(vec![module]).expect("the circuit keeps all rules");
    let checked = start.elapsed();
    let mut sim = Simulation::from_design(&design).expect("every design can be compiled");
    for input in &design.top().inputs {
        let width = design.top().width(input.node) * design.top().node(input.node).shape.lanes();
        let port = sim.port(&input.name).expect("it is there");
        sim.set(port, tilewright_hdl::Bits::ones(width));
    }
    sim.step();
    let first = start.elapsed() - checked;
    let least = (0..5).map(|_| {
        let start = Instant::now();
        sim.run(CYCLES);
        start.elapsed().as_secs_f64() * 1e9 / CYCLES as f64
    });
    let cycle = least.fold(f64::INFINITY, f64::min);
    let each = cycle / f64::from(side * side);
    println!(
        "{what:12} {side:3} x {side:<3}  {nodes:4} nodes   checked {:6.2} ms   first cycle {:6.2} ms   {cycle:8.0} ns a cycle   {each:5.2} ns an element",
        checked.as_secs_f64() * 1e3,
        first.as_secs_f64() * 1e3,
    );
}

fn main() {
    for side in [16, 32, 64, 128] {
        print("processors", side, machines::processors(side));
    }
    for side in [8, 16, 32, 64] {
        print("systolic", side, machines::systolic(side));
    }
}
