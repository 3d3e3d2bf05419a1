//! A picture that tests a screen, and its top.

use crate::picture::{Colour, Picture, PictureIn};
use crate::screen::Screen;
use crate::ulx3s::{self, Socket};
use tilewright_blocks::VideoTiming;
use tilewright_hdl::{Module, block, def, lit, mux};

block! {
    /// A chessboard. Its white squares are windows to bars that move to the left by a pixel a frame, and its black ones
    /// are shades.
    pub struct TestPicture;
    in = PictureIn;
    out = Colour::widths(8);
}

impl TestPicture {
    fn build(&self, m: Module, i: PictureIn) -> Colour {
        m.ignore(&i.runs);
        def!(frame = m.reg(8).reset(0));
        frame.when(i.ends, frame + 1);
        def!(is_white = i.x.bit(5) ^ i.y.bit(5));
        def!(moved = i.x + frame.zext(10));
        let bar = |bit: u32| moved.bit(bit).repeat(8);
        let bars = Colour { red: bar(6), green: bar(7), blue: bar(8) };
        def!(colour = mux(is_white, bars, Colour { red: i.x.part(0, 8), green: i.y.part(0, 8), blue: lit(8, 0x80) }));
        m.pipe("answer", colour)
    }
}

impl Picture for TestPicture {
    fn latency(&self) -> u32 {
        1
    }
}

block! {
    /// The test picture on a ULX3S.
    pub struct TestPictureOnUlx3s {
        /// The timing of the screen: [`VideoTiming::VGA`] on the board, others in tests.
        pub timing: VideoTiming,
    }
    name = "test_picture";
    out = Socket;
}

impl TestPictureOnUlx3s {
    fn build(&self, m: Module, (): ()) -> Socket {
        let screen = Screen { picture: TestPicture, timing: self.timing.clone(), double: false };
        ulx3s::show(m, &screen, &[])
    }
}
