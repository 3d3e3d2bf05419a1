//! Chapter 7: a pipeline that knows which of its results are any.

use tilewright_hdl::*;

bundle! { pub struct Square<T> { pub valid: T, pub value: T, pub square: T } }

block! {
    /// Squares numbers in two stages, of which each takes half of the bits.
    pub struct Squares;
    in SquaresIn { given: bit(), value: bits(8) }
    out SquaresOut { valid: bit(), square: bits(16) }
}

impl Squares {
    fn build(&self, m: Module, i: SquaresIn) -> SquaresOut {
        let start = Square { valid: i.given, value: i.value, square: lit(16, 0) };
        let end = m.stages(2, None, start.cleared(|square| square.valid), |stage, square| {
            let half = square.value.part(4 * (stage - 1), 4);
            Square { square: square.square + ((square.value * half).zext(16) << (4 * (stage - 1))), ..square }
        });
        m.ignore(&end.value);
        SquaresOut { valid: end.valid, square: end.square }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn results_come_two_clocks_later() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Squares)?.seeded(1);
        for number in 0..300 {
            sim.drive(SquaresIn { given: number % 3 % 2, value: number % 256 });
            let valid = number > 1 && (number - 2) % 3 % 2 == 1;
            assert_eq!(sim.get(sim.o.valid), valid, "in clock {number}");
            if valid {
                let value = (number - 2) % 256;
                assert_eq!(sim.get(sim.o.square), value * value);
            }
            sim.step();
        }
        Ok(())
    }
}
