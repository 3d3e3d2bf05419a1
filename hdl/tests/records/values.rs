//! Choices between records, and records in words.

use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    struct Pixel<T> { z: T, rgb: T }
    struct ChooseIn<T> { a: Pixel<T>, b: Pixel<T>, by: T }
    struct ChooseOut<T> { mux: Pixel<T>, select: Pixel<T>, case: Pixel<T>, zero: Pixel<T>, numbers: T, list: [T; 2], word: T, back: Pixel<T> }
}

#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Choose;

fn pixel() -> Pixel<Width> {
    Pixel { z: bits(5), rgb: bits(9) }
}

impl Block for Choose {
    type In = ChooseIn;
    type Out = ChooseOut;

    fn inputs(&self) -> ChooseIn<Width> {
        ChooseIn { a: pixel(), b: pixel(), by: bits(2) }
    }

    fn build(&self, _: Module, i: ChooseIn) -> ChooseOut {
        let ChooseIn { a, b, by } = i;
        let word = a.pack();
        assert_eq!(word.width(), 14);
        ChooseOut {
            mux: mux(by.bit(0), a, b),
            select: select([(by.bit(0), a), (by.bit(1), b)], Pixel { z: 31, rgb: 0 }),
            case: case(by, arms![1 => a, 2 => Pixel { z: 1, rgb: 2 }, 3 => 0], b),
            zero: mux(by.bit(1), 0, a),
            numbers: select(arms![by.bit(0) => 3, by.bit(1) => a.z], b.z),
            list: mux(by.bit(0), [a.z, b.z], [b.z, a.z]),
            word,
            back: pixel().unpack(word),
        }
    }
}

#[test]
fn choices_take_records_and_numbers_in_any_place() {
    let mut sim = Simulation::of(&Choose).unwrap();
    let (a, b, zero) = (Pixel { z: 3, rgb: 300 }, Pixel { z: 7, rgb: 511 }, Pixel { z: 0, rgb: 0 });
    let (numbers, one) = (Pixel { z: 31, rgb: 0 }, Pixel { z: 1, rgb: 2 });
    for (by, mux, select, case, number) in
        [(0, b, numbers, b, 7), (1, a, a, a, 3), (2, b, b, one, 3), (3, a, a, zero, 3)]
    {
        sim.drive(ChooseIn { a, b, by });
        let (word, back) = (a.z << 9 | a.rgb, a);
        let (list, zero) = (if by % 2 == 1 { [3, 7] } else { [7, 3] }, if by >= 2 { zero } else { a });
        assert_eq!(sim.read_u64(), ChooseOut { mux, select, case, zero, numbers: number, list, word, back }, "by {by}");
    }
}
