//! What a frame takes on the VC-1 of a ULX3S, in clocks: `cargo run -p tilewright-boards --example frames`.

use std::error::Error;
use tilewright_boards::vc1::Vc1OnUlx3s;
use tilewright_rtl::clocks::{MERGE, PE};
use tilewright_rtl::swap::SwapState;
use tilewright_sim::Simulation;

/// The clocks of processing elements in which the first one clears its table and draws, of two frames.
fn main() -> Result<(), Box<dyn Error>> {
    let top = Vc1OnUlx3s::full()?;
    let scene = &top.picture.scene;
    let pixels = |step| scene.golden(step).words.iter().filter(|word| **word >> 24 != 0xff_ffff).count();
    println!("{} triangles in step 0, which cover {} pixels", scene.triangles(0).len(), pixels(0));
    println!(
        "{} block RAM words of 18 bits for {} steps; at most {} pages in use",
        scene.words().len(),
        scene.steps(),
        scene.pages(&top.picture.lfb.patches)
    );
    println!("a round of the merger: {} clocks of {}", top.picture.round().clocks(), MERGE.period);
    let mut sim = Simulation::of(&top)?;
    let (picture, mut clocks) = ("u_screen.u_picture", [0u64; 2]);
    loop {
        let state: SwapState = sim.code(&format!("{picture}.u_swap.u_lfb_swap[0].state"))?;
        match state {
            SwapState::Clear => clocks[0] += 1,
            SwapState::Draw => clocks[1] += 1,
            SwapState::Due | SwapState::Overflow => break,
        }
        sim.step_clock(PE, 1);
    }
    println!("clearing a patch table: {} clocks of {}; drawing: {} clocks", clocks[0], PE.period, clocks[1]);
    Ok(())
}
