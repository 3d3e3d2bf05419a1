//! A master of I2C, against slaves and other masters that are programs, on a bus whose rules are watched.

#[path = "../../../examples/i2c_pins.rs"]
pub mod i2c_pins;

mod contention;
mod lines;
mod property;
mod rules;

use i2c_pins::I2cPins;
use tilewright_blocks::*;
use tilewright_sim::{Port, Simulation};

type Pins = Simulation<i2c_pins::I2cPinsIn, i2c_pins::I2cPinsOut>;

const DONE: u64 = 0;
const NACK: u64 = 1;
const LOST: u64 = 2;

/// After a reset, and long enough for the bus to be free.
fn started(master: &I2cMaster, seed: u64) -> Pins {
    let mut sim = Simulation::of(&I2cPins { master: master.clone() }).unwrap().seeded(seed);
    sim.reset();
    sim.run(u64::from(master.low));
    sim
}

/// The inputs that pull SCL and SDA low, and the outputs that show the lines.
fn lines(sim: &Pins) -> [Port; 4] {
    [sim.i.scl.drives, sim.i.sda.drives, sim.o.scl_line, sim.o.sda_line]
}

/// From one falling edge of SCL to the next, as the documentation says.
fn clocks_of_a_bit(master: &I2cMaster) -> u64 {
    u64::from(master.low + master.high + master.filter + 3)
}
