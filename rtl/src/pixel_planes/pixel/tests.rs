//! The pixel processor clock by clock, and against the meaning of its control.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

const IDLE: Control<u64> = Control {
    source: 0,
    constant: 0,
    adds: 0,
    first: 0,
    mask: 0,
    compares: 0,
    gates: 0,
    enabling: 0,
    captures: 0,
    read: 0,
    write: 0,
};

fn started() -> Simulation<PixelProcessorIn, PixelProcessorOut> {
    let mut sim = Simulation::of(&PixelProcessor).unwrap();
    sim.reset();
    sim
}

#[test]
fn a_word_is_added_to_and_compared_from_its_lowest_bit_on() {
    let mut sim = started();
    let source = Source::Constant.code();
    let constants = |control: Control<u64>, value: u64| {
        (0..4).map(move |bit| {
            let (constant, first) = (value >> bit & 1, u64::from(bit == 0));
            Control { source, constant, first, read: bit, write: bit, ..control }
        })
    };
    let wave = sim.record(["control_constant", "control_first", "word", "carry", "result", "writes", "flag"]);
    let everybody = Mask::Everybody.code();
    // 5 is written; 7 is added, which makes 12; 11 is less than that.
    let write = constants(Control { mask: everybody, ..IDLE }, 5);
    let add = constants(Control { mask: everybody, adds: 1, ..IDLE }, 7);
    let compare = constants(Control { compares: 1, ..IDLE }, 11);
    for control in write.chain(add).chain(compare).chain([IDLE]) {
        sim.drive(PixelProcessorIn { control, expression: 0 });
        sim.step();
    }
    wave.expect(
        r"
        clk              |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        control_constant |~~~\___/~~~\___/~~~~~~~~~~~\___/~~~~~~~\___/~~~\____
        control_first    |~~~\___________/~~~\___________/~~~\________________
        word             |_______________/~~~\___/~~~\___________/~~~~~~~\____
        carry            |___________________/~~~~~~~~~~~\____________________
        result           |~~~\___/~~~\___________/~~~~~~~~~~~~~~~\___/~~~\____
        writes           |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\____________________
        flag             |___________________________________________/~~~~~~~~
        ",
    );
}

/// The state of a processor, and the effect of its control as [`Control`] documents it.
#[derive(Debug, Clone)]
struct Held {
    memory: Vec<u64>,
    carry: u64,
    enable: u64,
    flag: u64,
}

impl Held {
    fn step(&mut self, c: &Control<u64>, expression: u64) {
        let word = self.memory[c.read as usize];
        let new = [expression, word, c.constant][c.source as usize];
        let mut result = new;
        let (enable, flag) = (self.enable, self.flag);
        if c.adds == 1 {
            let sum = new + word + if c.first == 1 { 0 } else { self.carry };
            (result, self.carry) = (sum % 2, sum / 2);
        }
        if [0, 1, enable, flag][c.mask as usize] == 1 {
            self.memory[c.write as usize] = result;
        }
        let inside = 1 - expression;
        self.enable = [enable, 1, 0, inside, enable * inside][c.enabling as usize];
        if c.compares == 1 {
            let so_far = if c.first == 1 { 0 } else { flag };
            let is_less = if new == word { so_far } else { word };
            self.flag = if c.gates == 1 { is_less * enable } else { is_less };
        }
        if c.captures == 1 {
            self.flag = self.enable;
        }
    }
}

fn controls() -> impl Strategy<Value = Control<u64>> {
    // Few addresses, so that written bits are read again.
    let address = || prop_oneof![Just(0), Just(207), 0..4u64];
    let flags = prop::array::uniform6(0..2u64);
    (0..3u64, 0..4u64, 0..5u64, flags, address(), address()).prop_map(|(source, mask, enabling, flags, read, write)| {
        let [constant, adds, first, compares, gates, captures] = flags;
        Control { source, constant, adds, first, mask, compares, gates, enabling, captures, read, write }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn it_does_what_its_control_says(all in prop::collection::vec((controls(), 0..2u64), 1..200)) {
        let mut sim = started();
        let mut held = Held { memory: vec![0; PixelProcessor::BITS as usize], carry: 0, enable: 0, flag: 0 };
        for (control, expression) in all {
            sim.drive(PixelProcessorIn { control, expression });
            prop_assert_eq!(sim.get_u64(sim.o.word), held.memory[control.read as usize]);
            sim.step();
            held.step(&control, expression);
            for (name, expected) in [("carry", held.carry), ("enable", held.enable), ("flag", held.flag)] {
                prop_assert_eq!(sim.peek(name).unwrap().to_u64(), Some(expected), "{}", name);
            }
        }
    }
}
