//! Chapter 6: a stream whose small letters become capitals.

use tilewright_hdl::*;

block! {
    /// Makes small letters capitals.
    pub struct Shout;
    in ShoutIn { bytes: stream(bits(8)) }
    out ShoutOut { shouted: stream(bits(8)) }
}

impl Shout {
    fn build(&self, _: Module, i: ShoutIn) -> ShoutOut {
        let byte = *i.bytes;
        let is_small = byte.ge(u32::from(b'a')) & byte.le(u32::from(b'z'));
        ShoutOut { shouted: i.bytes.with(mux(is_small, byte & hex(0xdf), byte)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn small_letters_become_capitals() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Shout)?;
        let (bytes, shouted) = (sim.i.bytes, sim.o.shouted);
        let text = "Tilewright, 1990-2000!";
        // Without a register there is no clock, so words are shown one by one.
        for byte in text.bytes() {
            sim.set(bytes.valid, 1);
            sim.set(bytes.payload, byte);
            sim.set(shouted.ready, 1);
            assert_eq!(sim.get(shouted.payload), u64::from(byte.to_ascii_uppercase()));
            assert_eq!(sim.get(bytes.ready), 1);
        }
        Ok(())
    }
}
