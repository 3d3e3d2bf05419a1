//! The machines: their frames, their counters and their parts, against models without hardware.

mod history;
mod pixel_planes;
mod pixelflow;
mod quadtree;
mod vc1;
mod vc1_campaign;
mod vc1_model;
mod vc1_times;
mod vc1_whole;
mod way;
