//! Deferred shading: planes, shading and frames against oracles (PFL-BYTES, DES-Z, DES-MIN).

mod frames;
mod planes;
mod shading;
