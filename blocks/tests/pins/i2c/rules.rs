//! The rules of the bus, in clocks.

use super::i2c_pins::devices::Bus;
use std::convert::Infallible;

/// What each time on the lines is at least.
#[derive(Clone, Copy)]
pub struct Rules {
    /// SCL low, and from a STOP to a START.
    pub low: u64,
    /// SCL high, and before and after a START, and before a STOP.
    pub high: u64,
    /// From a change of SDA to a rising edge of SCL.
    pub setup: u64,
}

/// How long ago the last events were.
struct Ages {
    scl: u64,
    sda: u64,
    stop: u64,
}

impl Rules {
    /// Counts the STOPs.
    ///
    /// # Panics
    ///
    /// A time is too short, SDA changes at an edge of SCL, or a START or STOP comes within a byte.
    pub async fn watches(self, bus: &Bus<'_, '_>, stops: &mut u32) -> Infallible {
        let mut was = (true, true);
        let mut ages = Ages { scl: 1000, sda: 1000, stop: 1000 };
        let (mut is_free, mut after_start, mut rises) = (true, false, 0u32);
        loop {
            bus.t.step().await;
            let now = bus.levels();
            ages = Ages { scl: ages.scl + 1, sda: ages.sda + 1, stop: ages.stop + 1 };
            let at = bus.t.time();
            match (was, now) {
                ((false, before), (true, sda)) => {
                    assert!(before == sda && ages.scl >= self.low && ages.sda >= self.setup, "SCL rises at {at} ps");
                    (rises, ages.scl) = (rises + 1, 0);
                }
                ((true, before), (false, sda)) => {
                    let held = if after_start { ages.sda } else { ages.scl };
                    assert!(before == sda && held >= self.high && !is_free, "SCL falls at {at} ps");
                    (after_start, ages.scl) = (false, 0);
                }
                ((true, true), (true, false)) => {
                    let in_place = if is_free { ages.stop >= self.low } else { rises % 9 == 1 };
                    assert!(in_place && ages.scl >= self.high, "a START at {at} ps after {rises} bits");
                    (is_free, after_start, rises, ages.sda) = (false, true, 0, 0);
                }
                ((true, false), (true, true)) => {
                    let in_place = !is_free && rises % 9 == 1;
                    assert!(in_place && ages.scl >= self.high, "a STOP at {at} ps after {rises} bits");
                    (is_free, ages.sda, ages.stop) = (true, 0, 0);
                    *stops += 1;
                }
                ((false, before), (false, sda)) if before != sda => ages.sda = 0,
                _ => {}
            }
            was = now;
        }
    }
}
