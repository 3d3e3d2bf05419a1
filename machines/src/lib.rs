//! Whole rendering machines: programs, hardware, a scene, a frame.

pub mod vc1;
