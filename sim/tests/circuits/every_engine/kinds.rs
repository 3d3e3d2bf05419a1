//! Signed values and codes of enums: stored, sent, and as the subject of a choice.

use crate::circuits::engine::of;
use proptest::prelude::*;
use tilewright_hdl::*;
use tilewright_sim::{Pauses, Vcd};

codes! {
    /// The operation. Its codes have numbers of their own.
    enum Operation { Add = 0, Subtract = 2, Smaller = 5 }
}

bundle! {
    struct In<T> { operation: T, left: T, right: T, lanes: T }
    struct Out<T> {
        result: T, done: T, sum: T, product: T, shifted: T, negative: T, is_less: T, least: T, most: T, remembered: T, was: T, is_code: T,
    }
}

/// An arithmetic unit on signed numbers, controlled by a code.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Unit;

impl Block for Unit {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        let number = bits(8).signed();
        In { operation: one_of::<Operation>(), left: number, right: number, lanes: number.of(row(3)) }
    }

    fn build(&self, m: Module, i: In) -> Out {
        let sum = m.reg("total", bits(8).signed()).reset(-3);
        sum.when(i.operation.is(Operation::Add), *sum + i.left).when(i.left.is_negative(), -1);
        let numbers = m.memory("numbers", 2, bits(8).signed(), ReadUnderWrite::Old).fill(Bits::zero(8));
        numbers.write(i.left.lt(0), 1, i.left);
        let operations = m.memory("operations", 2, one_of::<Operation>(), ReadUnderWrite::Old).fill(Bits::zero(3));
        operations.write(i.left.lt(0), 1, mux(i.right.lt(0), Operation::Smaller, i.operation));
        let was = operations.read_async(1).named("recalled");
        Out {
            result: i.operation.choose(|operation| match operation {
                Operation::Add => i.left + i.right,
                Operation::Subtract => i.left - i.right,
                Operation::Smaller => mux(i.left.lt(i.right), i.left, i.right),
            }),
            done: i.operation,
            is_code: i.operation.is_code(),
            sum: *sum,
            product: i.left * i.right,
            shifted: (i.left >> 2).sext(12) + (i.right << 1).sext(12),
            negative: -i.left,
            is_less: i.left.lt(i.right) & i.left.ne(-128),
            least: i.lanes.minimum(),
            most: i.lanes.maximum(),
            remembered: numbers.read_async(1),
            was,
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn numbers_have_a_sign_and_codes_a_meaning(place in 0usize..3, left: i8, right: i8, lanes: [i8; 3]) {
        let mut sim = of(&Unit);
        let (i, o) = (sim.i, sim.o);
        let code = Operation::ALL[place].code();
        sim.reset();
        sim.set(i.operation, code);
        sim.set(i.left, left);
        sim.set(i.right, right);
        sim.set_lanes(i.lanes, lanes);
        let byte = |number: i8| u64::from(number as u8);
        let result = [left.wrapping_add(right), left.wrapping_sub(right), left.min(right)][place];
        let shifted = (i16::from(left >> 2) + i16::from(right << 1)) as u64 & 0xfff;
        let now = [
            (o.result, byte(result)), (o.done, code), (o.is_code, 1), (o.sum, byte(-3)),
            (o.product, (i16::from(left) * i16::from(right)) as u16 as u64), (o.shifted, shifted),
            (o.negative, byte(left.wrapping_neg())), (o.is_less, u64::from(left < right && left != -128)),
            (o.least, byte(*lanes.iter().min().unwrap())), (o.most, byte(*lanes.iter().max().unwrap())),
        ];
        for (number, (port, expected)) in now.into_iter().enumerate() {
            prop_assert_eq!(sim.get_u64(port), expected, "check {}", number);
        }
        sim.step();
        let sum = match (place, left < 0) {
            (0, _) => (-3i8).wrapping_add(left),
            (_, true) => -1,
            _ => -3,
        };
        prop_assert_eq!(sim.get_u64(o.sum), byte(sum));
        prop_assert_eq!(sim.get_u64(o.remembered), if left < 0 { byte(left) } else { 0 });
        prop_assert_eq!(sim.get_u64(o.was), match (left < 0, right < 0) { (false, _) => 0, (_, true) => 5, _ => code });
    }

    /// A number between the codes is no code; it chooses what most codes choose, and here what the last chooses.
    #[test]
    fn numbers_between_the_codes(number in 0u64..8, left: i8, right: i8) {
        let mut sim = of(&Unit);
        let o = sim.o;
        sim.drive(In { operation: number, left: left as u8 as u64, right: right as u8 as u64, lanes: 0 });
        let result = match Operation::from_number(number) {
            Some(Operation::Add) => left.wrapping_add(right),
            Some(Operation::Subtract) => left.wrapping_sub(right),
            Some(Operation::Smaller) | None => left.min(right),
        };
        prop_assert_eq!(sim.get_u64(o.result), result as u8 as u64);
        prop_assert_eq!(sim.get_u64(o.is_code), u64::from([0, 2, 5].contains(&number)));
    }
}

bundle! {
    struct Step<T> { operation: T, least: T, amount: T }
}

block! {
    /// Stores a step.
    struct Steps;
    in StepsIn { steps: stream(Step { operation: one_of::<Operation>(), least: bits(6).signed(), amount: bits(8) }) }
    out StepsOut { sent: stream(Step = _) }
}

impl Steps {
    fn build(&self, m: Module, i: StepsIn) -> StepsOut {
        let layout = Step { operation: one_of::<Operation>(), least: bits(6).signed(), amount: bits(8) };
        let full = m.reg("full", bit()).reset(0);
        let kept = m.memory("kept", 2, layout, ReadUnderWrite::Old).fill(0);
        let steps = i.steps.take_when(!full);
        kept.write(steps.taken, lit(1, 0), *steps);
        def!(entry = kept.read_async(lit(1, 0)));
        let (sent, taken) = m.offer(full, entry);
        full.when(steps.taken, 1).when(taken, 0);
        StepsOut { sent }
    }
}

#[test]
fn waves_name_the_fields_of_records_and_their_codes() {
    let mut sim = of(&Steps);
    let wave = sim.record(["steps_*", "entry_*"]);
    let (steps, sent) = (sim.i.steps, sim.o.sent);
    let t = sim.testbench();
    let step = |operation, amount| Step { operation, least: 60, amount };
    let words = [step(Operation::Subtract as u64, 7), step(Operation::Smaller as u64, 9)];
    t.run((t.send_all(steps, words, Pauses::NONE), t.receive_all(sent, 2, Pauses::NONE)));
    wave.expect(
        r"
        clk             |__________/~~~~~\____/~~~~~\____/~~~~~\____/
        steps_valid     |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\___________
        steps_operation | Subtract | Smaller             | Add      |
        steps_least     | -4                             | 0        |
        steps_amount    | 7        | 9                   | 0        |
        steps_ready     |~~~~~~~~~~\__________/~~~~~~~~~~\___________
        entry_operation | Add      | Subtract            | Smaller  |
        entry_least     | 0        | -4                             |
        entry_amount    | 0        | 7                   | 9        |
        ",
    );
}

codes! { enum Other { Add = 0, Subtract = 2, Smaller = 5 } }

#[test]
fn a_signal_as_a_code_of_its_enum() {
    let mut sim = of(&Unit);
    for code in Operation::ALL {
        sim.set(sim.i.operation, code.code());
        assert_eq!(sim.code::<Operation>("done").unwrap(), *code);
    }
    let problem = sim.code::<Operation>("dome").unwrap_err().to_string();
    assert!(problem.contains("did you mean `done`?"), "{problem}");
}

#[test]
#[should_panic(expected = "`done` is a code of `Operation`, not a code of `Other`")]
fn a_code_of_another_enum() {
    let _ = of(&Unit).code::<Other>("done");
}

#[test]
#[should_panic(expected = "`left` is signed, not a code of `Operation`")]
fn a_signal_that_is_no_code() {
    let _ = of(&Unit).code::<Operation>("left");
}

#[test]
#[should_panic(expected = "`done` is 3'h3, which is no code of `Operation`")]
fn a_value_that_is_no_code() {
    let mut sim = of(&Unit);
    sim.set(sim.i.operation, 3);
    let _ = sim.code::<Operation>("done");
}

#[test]
fn signed_words_of_a_stream_are_signed_integers() {
    let mut sim = of(&Steps);
    let (steps, sent) = (sim.i.steps, sim.o.sent);
    let t = sim.testbench();
    let step = |least| Step { operation: Operation::Smaller as i64, least, amount: 9 };
    t.run((
        async {
            t.send(steps, step(-32)).await;
            t.send_all(steps, [step(31), step(-1)], Pauses::NONE).await;
        },
        t.expect_all(sent, [step(-32), step(31), step(-1)], Pauses::NONE),
    ));
}

#[test]
#[should_panic(expected = "and cannot hold 18446744073709551615: give it -1, as a signed integer")]
fn a_negative_word_that_has_become_unsigned() {
    let mut sim = of(&Steps);
    let (steps, t) = (sim.i.steps, sim.testbench());
    t.run((t.send(steps, Step { operation: 0, least: -1i64 as u64, amount: 9 }),));
}

#[test]
#[should_panic(expected = "there is no signal `entrie_*`: did you mean `entry`?")]
fn a_record_that_is_not_there() {
    of(&Steps).record(["entrie_*"]);
}

#[test]
fn waves_name_the_codes_of_ports_and_nets() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("unit.vcd");
    let mut sim = of(&Unit);
    sim.trace(Vcd::to(&path)).unwrap();
    let wave = sim.record([sim.i.operation, sim.i.left, sim.o.done]);
    let decimal = sim.record([sim.o.shifted]).decimal();
    sim.reset();
    sim.set(sim.i.operation, 2u64);
    sim.set(sim.i.left, -1);
    sim.run(2);
    sim.set(sim.i.operation, 1u64);
    sim.step();
    sim.finish().unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    for declared in ["operation_state", "done_state", "was_state", "recalled_state"] {
        assert!(text.contains(&format!(" {declared} $end")), "{declared} is missing in {text}");
    }
    assert!(text.contains("sSubtract ") && text.contains("scode_1 "), "{text}");
    wave.expect(
        r"
        clk       |_____/~~\__/~~\__/~~\__/
        operation | Add | Subtract  | 1   |
        left      | 0   | -1              |
        done      | Add | Subtract  | 1   |
        ",
    );
    assert!(decimal.to_string().contains("-1"), "{decimal}");
}
