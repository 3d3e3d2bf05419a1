//! Ports with lanes: a value for each lane.

use tilewright_circuit::{Bits, limbs_for};

use crate::testbench::port::{IntoValue, Port};
use crate::testbench::running::{Running, bits};

impl Running {
    /// The lanes of a port, and the width of each.
    #[track_caller]
    fn lanes_of(&self, port: Port) -> (u32, u32) {
        let declared = self.declared(port);
        (declared.lanes, self.program.value(declared.value).width / declared.lanes)
    }

    /// Sets an input in the only run, a value for each lane.
    #[track_caller]
    pub fn set_lanes<V: IntoValue>(&mut self, port: Port, values: impl IntoIterator<Item = V>) {
        let (lanes, width) = self.lanes_of(port);
        let mut packed = Vec::new();
        for value in values {
            match value.into_value(width) {
                Ok(lane) => packed.push(lane),
                Err(problem) => {
                    let (name, lane) = (&self.declared(port).name, packed.len());
                    panic!("lane {lane} of input `{name}` has {} and {problem}", bits(width))
                }
            }
        }
        let name = &self.declared(port).name;
        assert!(packed.len() == lanes as usize, "`{name}` has {lanes} lanes, but is set to {} values", packed.len());
        self.set(port, pack(width, &packed));
    }

    /// The lanes of a port in the only run.
    #[track_caller]
    pub fn lanes(&mut self, port: Port) -> Vec<u64> {
        let (lanes, width) = self.lanes_of(port);
        let value = self.get(port, 0);
        let lane = |lane: u32| value.slice(lane * width..(lane + 1) * width).to_u64();
        let numbers: Option<Vec<u64>> = (0..lanes).map(lane).collect();
        numbers
            .unwrap_or_else(|| panic!("the lanes of `{}` are wider than 64 bits: use `get`", self.declared(port).name))
    }
}

/// Values of one width side by side, the first in the lowest bits.
fn pack(width: u32, lanes: &[Bits]) -> Bits {
    let all = width * lanes.len() as u32;
    let mut limbs = vec![0; limbs_for(all) + 1];
    for (lane, value) in lanes.iter().enumerate() {
        for (i, limb) in value.limbs().iter().enumerate() {
            let at = lane * width as usize + 64 * i;
            let wide = u128::from(*limb) << (at % 64);
            limbs[at / 64] |= wide as u64;
            limbs[at / 64 + 1] |= (wide >> 64) as u64;
        }
    }
    Bits::from_limbs(all, &limbs[..limbs_for(all)])
}
