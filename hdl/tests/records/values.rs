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

codes! { enum Way { Left, Right, Both } }

/// Chooses by a code: a value for each, one for most of them, and the same for all.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Ways;

bundle! {
    struct WaysIn<T> { way: T, a: T, b: T }
    struct WaysOut<T> { all: T, most: T, one: T, record: WaysIn<T> }
}

impl Block for Ways {
    type In = WaysIn;
    type Out = WaysOut;

    fn inputs(&self) -> WaysIn<Width> {
        WaysIn { way: one_of::<Way>(), a: bits(8), b: bits(8) }
    }

    fn build(&self, _: Module, i: WaysIn) -> WaysOut {
        WaysOut {
            all: i.way.choose(|way| match way {
                Way::Left => i.a,
                Way::Right => i.b,
                Way::Both => i.a ^ i.b,
            }),
            most: i.way.choose(|way| if let Way::Right = way { i.b } else { lit(8, 5) }),
            one: i.way.choose(|_: Way| i.a),
            record: i.way.choose(|way| if let Way::Left = way { i } else { WaysIn { a: i.b, b: i.a, ..i } }),
        }
    }
}

#[test]
fn what_many_codes_share_is_said_once() {
    let mut sim = Simulation::of(&Ways).unwrap();
    for (way, all, most, swapped) in [(0, 7, 5, [7, 9]), (1, 9, 9, [9, 7]), (2, 14, 5, [9, 7])] {
        sim.drive(WaysIn { way, a: 7, b: 9 });
        let [a, b] = swapped;
        assert_eq!(sim.read_u64(), WaysOut { all, most, one: 7, record: WaysIn { way, a, b } });
    }
    let text = &tilewright_gen::verilog(&elaborate(&Ways).unwrap())[0].text;
    assert!(text.contains("WAY_RIGHT: most = b;") && !text.contains("WAY_LEFT: most"), "{text}");
    assert!(text.contains("assign one = a;"), "{text}");
}
