//! `tilewright why`: the cause of a value in a block's scenario, or the way of a pixel through a machine.

mod block;
mod hint;
mod scene;
pub mod text;

pub use block::node;

use crate::shell::{Exit, Failure};
use block::BlockOptions;
use clap::Args;
use scene::SceneOptions;
use std::ffi::OsString;

/// Tells why a net has its value in a block's scenario, or why a pixel of a scene has its colour on a machine
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright why fifo --signal used
  tilewright why patch-table --signal page --at 12
  tilewright why scan-counter --signal pixel_x --depth 3 --json
  tilewright why teapot --size 160x120 --pixel 80,60
  tilewright why star --size 64x48 --machine quadtree --pixel 32,24 --json
  tilewright why star --size 64x48 --pixel 32,24 --pixel 33,24
  tilewright why star --size 64x48 --processors 4 --pixel 32,24 -o pixel.vcd

A block, with --signal: a line is a cause of the line above it that stands further left: `from` for what the value came from, `when` for what chose it, as a
condition or an enable does. It has the value, the cycle since when, and the source line. A choice counts its condition and its chosen side alone, an AND
that is 0 its zeros. The name is that of a waveform, such as `u_cell[3].sum`, or `squares[5]` for a word of a memory. Nothing has to be recorded before.

A scene, with --pixel: whether the pixel is right, and the first step that differs, with its block and that block's source file. `next` is a command that asks
on, in the block's scenario. Then come the primitives that cover the pixel, and what each unit of the machine did with them, by time. A value stands beside that of a
plain model with the same inputs where the two differ. `>` marks the first step that differs, and `.` later ones, which may follow from it.
The machine draws the frame as `render` does, and observes the pixel meanwhile. --pixel counts from the upper left corner, from 0 on. Each of several pixels has a run of its own.
With -o a second run writes the waveform of the unit in 40 clocks around the first difference, or around the last step of the visible primitive if nothing differs.
A unit of pixel-planes-5 or pixelflow is simulated by itself, and clocks in which it rests are left out: its waveform has a time of its own.

Exit code 1 means that an assertion of the block fails, that the pixel differs from the golden image, or that the machine fails its own check.
The cause, or the way, is told all the same.")]
pub struct Why {
    /// A block, as for `wave`, or a scene, as for `render`
    #[arg(value_name = "BLOCK|SCENE")]
    what: OsString,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    block: BlockOptions,
    #[command(flatten)]
    scene: SceneOptions,
}

impl Why {
    /// Tells the cause, or the way.
    pub fn run(self) -> Result<Exit, Failure> {
        match &self.block.signal {
            Some(signal) => {
                self.scene.refuse()?;
                self.block.run(&self.what, signal, self.json)
            }
            None if !self.scene.pixels.is_empty() => self.scene.run(&self.what, self.json),
            None => {
                let sentence =
                    "what is asked about is missing: give --signal NET for a block, or --pixel X,Y for a scene";
                Err(Failure::new(Exit::BadInput, sentence))
            }
        }
    }
}
