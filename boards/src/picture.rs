//! What a picture is: a block that knows the colour of each pixel.

use tilewright_hdl::{Block, bit, bits, record};

record! {
    /// A colour, or the symbols of one.
    pub struct Colour(width: u32) {
        /// Red.
        red: bits(width),
        /// Green.
        green: bits(width),
        /// Blue.
        blue: bits(width),
    }

    /// What a [`Picture`] is told in each clock of the pixels.
    pub struct PictureIn {
        /// The column of the pixel whose colour is asked for, from the left.
        x: bits(10),
        /// The row of that pixel, from the top.
        y: bits(10),
        /// High for one clock when the last visible row is over: the vertical blanking begins.
        ends: bit(),
        /// High once all clocks run.
        runs: bit(),
    }
}

/// A block that gives the colour of each pixel. The [front page](crate#the-contract-of-a-picture) has the contract.
pub trait Picture: Block<In = PictureIn, Out = Colour> {
    /// The clocks from a pixel's place to its colour: 1 or more.
    fn latency(&self) -> u32;
}
