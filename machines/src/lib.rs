//! Whole rendering machines: programs, hardware, a scene, a frame.
