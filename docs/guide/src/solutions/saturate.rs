//! Chapter 3: a sum that stops at its greatest value.

use tilewright_hdl::*;

block! {
    /// Adds two bytes; what is above 255 is 255.
    pub struct Saturate;
    in SaturateIn { a: bits(8), b: bits(8) }
    out SaturateOut { sum: bits(8) }
}

impl Saturate {
    fn build(&self, _: Module, i: SaturateIn) -> SaturateOut {
        let sum = i.a.add_carry(i.b);
        SaturateOut { sum: mux(sum.msb(), 255, sum.trunc(8)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn it_never_wraps() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Saturate)?;
        for (a, b) in (0..256).step_by(5).flat_map(|a| (0..256).step_by(3).map(move |b| (a, b))) {
            sim.drive(SaturateIn { a, b });
            assert_eq!(sim.get_u64(sim.o.sum), (a + b).min(255));
        }
        Ok(())
    }
}
