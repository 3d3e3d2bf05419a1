#![doc = include_str!("../README.md")]

mod dvi;
pub mod icebreaker;
mod picture;
pub mod quadtree;
pub mod receiver;
mod screen;
mod test_picture;
mod top;
pub mod ulx3s;
pub mod vc1;

pub use dvi::{DviSender, DviSenderIn, DviSenderOut};
pub use picture::{Colour, Picture, PictureIn};
pub use screen::{Screen, ScreenIn, Shown};
pub use test_picture::{TestPicture, TestPictureOnUlx3s};
pub use top::{TOPS, Top};
