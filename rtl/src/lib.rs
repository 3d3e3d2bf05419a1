//! The hardware blocks of the rendering machines.
