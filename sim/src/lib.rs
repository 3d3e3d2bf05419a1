//! Runs a circuit cycle by cycle: engines, testbenches, waves.
