//! Tops, by what their pins send.

mod board;
mod chips;
mod designs;
mod pins;
mod quadtree;
mod test_picture;
mod vc1;
