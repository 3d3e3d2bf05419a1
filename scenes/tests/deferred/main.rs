//! Deferred shading: planes, shading and frames against oracles (PFL-BYTES, DES-Z, DES-MIN).

mod frames;
#[path = "../oracle/mod.rs"]
mod oracle;
mod planes;
mod shading;
