//! Elementwise operations on a strip of lanes, in vector registers.
