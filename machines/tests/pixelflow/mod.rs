//! The programs of a PixelFlow node, bit for bit what the golden frames are made of: each is run on an emulated pixel.

mod frames;
mod rasterization;
mod shading;
