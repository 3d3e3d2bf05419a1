//! The pixel processor clock by clock, and compared with the emulator.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::emulator::Pixel;
use super::*;

type Processor = Simulation<PixelProcessorIn, PixelProcessorOut>;

fn started(depth: u32) -> Processor {
    let mut sim = Simulation::of(&PixelProcessor { depth }).unwrap();
    sim.reset();
    sim
}

/// Combines the bytes of a constant with those of a word, from the lowest on.
fn bytes(control: Control<u64>, address: u64, constant: &[u64]) -> Vec<Control<u64>> {
    let byte = |(at, &constant): (usize, &u64)| {
        let begin = if at == 0 { control.begin } else { Begin::Kept.code() };
        let at = address + at as u64;
        Control { constant, begin, read: at, write: at, ..control }
    };
    constant.iter().enumerate().map(byte).collect()
}

#[test]
fn words_are_added_to_and_compared_from_their_lowest_byte_on() {
    let mut sim = started(2);
    let signals = ["control_constant", "word", "carried", "carry_next", "result", "stores", "flag"];
    let wave = sim.record(signals);
    let everybody = Control { mask: Mask::Everybody.code(), stores: 1, ..Control::ZERO };
    // 0x01f0 is written; 0x0020 is added, which makes 0x0210; 0x0211 is greater than that, and 0x0210 is not.
    let begins = |function: Function, begin: Begin| (function.code(), begin.code());
    let (function, begin) = begins(Function::Add, Begin::Zero);
    let add = Control { function, begin, ..everybody };
    let (function, begin) = begins(Function::Compare, Begin::One);
    let (flagging, condition) = (Flagging::Condition.code(), Condition::NoCarry.code());
    let compare = Control { function, begin, flagging, condition, ..Control::ZERO };
    let program = [
        bytes(everybody, 4, &[0xf0, 0x01]),
        bytes(add, 4, &[0x20, 0x00]),
        bytes(compare, 4, &[0x11, 0x02]),
        bytes(compare, 4, &[0x10, 0x02]),
        vec![Control::ZERO],
    ];
    for control in program.concat() {
        sim.drive(PixelProcessorIn { control, expression: 0, register_byte: 0 });
        sim.step();
    }
    wave.expect(
        r"
        clk              |~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/
        control_constant | f0 | 1  | 20 | 0  | 11 | 2  | 10 | 2  | 0  |
        word             | 0       | f0 | 1  | 10 | 2  | 10 | 2  | 0  |
        carried          |______________/~~~~~~~~~\____/~~~~~~~~~~~~~~~
        carry_next       |_________/~~~~\______________/~~~~~~~~~~~~~~~
        result           | f0 | 1  | 10 | 2  | 11 | 2  | 10 | 2  | 0  |
        stores           |~~~~~~~~~~~~~~~~~~~\_________________________
        flag             |________________________/~~~~~~~~~\__________
        ",
    );
}

/// The edges of a triangle, if, else and end if: the enable flags after given signs and carries.
#[test]
fn the_enable_flags_are_a_stack() {
    let mut sim = started(PixelProcessor::DEPTH);
    let on = |enabling: Enabling, by_sign: u64, condition: Condition| Control {
        enabling: enabling.code(),
        by_sign,
        condition: condition.code(),
        ..Control::ZERO
    };
    let (positive, carry) = (Condition::Positive, Condition::Carry);
    // The change, the expression's byte, and the enable flags afterwards. Flags that were never set are left out.
    let steps = [
        (on(Enabling::Replace, 1, positive), 0x80, 0b0),
        (on(Enabling::Set, 0, positive), 0x80, 0b1),
        (on(Enabling::Restrict, 1, positive), 0x7f, 0b1),
        // If: the constant 0 is not negative. The expression is not used.
        (on(Enabling::Push, 0, positive), 0x80, 0b11),
        // If: the condition is a carry, and there is none.
        (on(Enabling::Push, 0, carry), 0, 0b110),
        (on(Enabling::Invert, 0, positive), 0, 0b111),
        (on(Enabling::Invert, 0, positive), 0, 0b110),
        (on(Enabling::Pop, 0, positive), 0, 0b11),
        (on(Enabling::Pop, 0, positive), 0, 0b1),
        (on(Enabling::Restrict, 1, positive), 0x80, 0b0),
        // The flag below is 0, so else does not enable the pixel.
        (on(Enabling::Push, 1, positive), 0, 0b00),
        (on(Enabling::Invert, 0, positive), 0, 0b00),
    ];
    // The carry is 0 at first.
    let shift = Control { function: Function::ShiftLeft.code(), ..Control::ZERO };
    sim.drive(PixelProcessorIn { control: shift, expression: 0, register_byte: 0 });
    sim.step();
    for (number, (control, expression, flags)) in steps.into_iter().enumerate() {
        sim.drive(PixelProcessorIn { control, expression, register_byte: 0 });
        sim.step();
        let enable = sim.peek("enable").unwrap().to_u64().unwrap();
        assert_eq!(enable & 7, flags, "step {number}");
    }
}

fn controls() -> impl Strategy<Value = Control<u64>> {
    // Few addresses, so that written bytes are read again; some of them are registers.
    let address = || prop_oneof![Just(255), Just(256), Just(383), 0..3u64, 300..302u64];
    let byte = prop_oneof![0..256u64, Just(0), Just(255), Just(128)];
    let codes = (0..4u64, 0..11u64, 0..3u64, 0..4u64, 0..3u64, 0..7u64, 0..3u64);
    let bits = prop::array::uniform3(0..2u64);
    (codes, bits, byte, address(), address()).prop_map(|(codes, bits, constant, read, write)| {
        let (source, function, begin, mask, condition, enabling, flagging) = codes;
        let [accumulates, stores, by_sign] = bits;
        Control {
            source,
            constant,
            function,
            begin,
            mask,
            accumulates,
            stores,
            condition,
            enabling,
            by_sign,
            flagging,
            read,
            write,
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn it_does_what_its_control_says(
        depth in 2..9u32,
        all in prop::collection::vec((controls(), 0..256u64), 1..300),
    ) {
        let mut sim = started(depth);
        let mut pixel = Pixel::of_depth(depth);
        for (control, expression) in all {
            // The communication registers are outside the processor.
            let is_register = |address: u64| address >= PixelProcessor::REGISTERS.into();
            let word = u64::from(pixel.memory[control.read as usize]);
            let register = if is_register(control.read) { word } else { 0x5a };
            sim.drive(PixelProcessorIn { control, expression, register_byte: register });
            prop_assert_eq!(sim.peek("word").unwrap().to_u64(), Some(word));
            let (result, writes) = (sim.get_u64(sim.o.result), sim.get_u64(sim.o.writes_register) == 1);
            let before = pixel.memory;
            pixel.step(&control, expression as u8);
            if writes {
                prop_assert!(is_register(control.write));
                prop_assert_eq!(result, u64::from(pixel.memory[control.write as usize]));
            } else {
                prop_assert_eq!(&before[256..], &pixel.memory[256..]);
            }
            sim.step();
            let [carry, flag] = [pixel.carry, pixel.flag].map(u64::from);
            let (accumulator, enable) = (pixel.accumulator.into(), pixel.enable.into());
            let state = [("accumulator", accumulator), ("carry", carry), ("enable", enable), ("flag", flag)];
            for (name, expected) in state {
                prop_assert_eq!(sim.peek(name).unwrap().to_u64(), Some(expected), "{}", name);
            }
        }
    }
}
