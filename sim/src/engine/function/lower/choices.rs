//! Makes tables of choices between constants, and rotations of the two exchanged parts of a value.

use tilewright_circuit::Bits;

use crate::engine::program::{Cell, Circuit, Kind, Lowered, ValueId};
use crate::engine::rewrite::Rewriter;

/// The widest number by which constants are looked up, however few they are.
const LOOKED_UP_BY: u32 = 8;
/// The table words for each constant, if the number is wider.
const WORDS: usize = 4;
/// From this number of arms on, a choice between constants is looked up.
const ARMS: usize = 4;

/// A choice between constants, in one lane, as a table look-up.
pub(super) fn lookup(
    rewriter: &mut Rewriter,
    cell: &Cell,
    subject: ValueId,
    arms: &[(Bits, ValueId)],
    default: ValueId,
) -> Option<ValueId> {
    let circuit = rewriter.circuit();
    let is_constant = |value: ValueId| circuit.constant(value).is_some();
    let by = circuit[subject].width;
    let is_dense = by <= LOOKED_UP_BY || by < u32::BITS && arms.len() * WORDS >= 1 << by;
    let all = is_constant(default) && arms.iter().all(|(_, value)| is_constant(*value));
    if !all || cell.lanes > 1 || arms.len() < ARMS || !is_dense || cell.width > 64 {
        return None;
    }
    let mut parts = vec![default; 1 << by];
    arms.iter().for_each(|(key, value)| parts[key.limbs()[0] as usize] = *value);
    let of = rewriter.add(Kind::Stack { parts, inner: 1 }, 1 << by, cell.width);
    Some(rewriter.add(Kind::Lowered(Lowered::Gather { of, at: subject }), 1, cell.width))
}

/// The value that a concatenation of two parts rotates, and the distance to the left, if the machine has integers of
/// its width.
pub(super) fn rotation(circuit: &Circuit, parts: &[ValueId]) -> Option<Kind> {
    let &[upper, lower] = parts else { return None };
    match (&circuit[upper].kind, &circuit[lower].kind) {
        (&Kind::Slice(of, 0), &Kind::Slice(other, low)) if of == other => {
            let width = circuit[of].width;
            let is_whole = (circuit[upper].width, circuit[lower].width) == (low, width - low);
            (is_whole && matches!(width, 8 | 16 | 32 | 64))
                .then_some(Kind::Lowered(Lowered::Rotate { of, left: width - low }))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use tilewright_hdl::{Module, bits, block, cat, def, elaborate};

    use crate::{EngineKind, Simulation};

    block! {
        /// Parts of two values side by side; one value is narrower than the offset of its part.
        struct Beside;
        in BesideIn { narrow: bits(5), wide: bits(32) }
        out BesideOut { both: bits(8) }
    }

    impl Beside {
        fn build(&self, m: Module, i: BesideIn) -> BesideOut {
            def!(both = m.reg(8).reset(0));
            both.next(cat![i.narrow.trunc(3), i.wide.part(20, 5)]);
            BesideOut { both: *both }
        }
    }

    #[test]
    fn parts_of_two_values_are_no_rotation() {
        let mut sim = Simulation::from_design(&elaborate(&Beside).unwrap()).unwrap().on(EngineKind::Compiled);
        let port = |name| sim.port(name).unwrap();
        let (narrow, wide, both) = (port("narrow"), port("wide"), port("both"));
        sim.set(narrow, 0b10110);
        sim.set(wide, 0b01001 << 20);
        sim.step();
        assert_eq!(sim.get_u64(both), 0b110_01001);
    }
}
