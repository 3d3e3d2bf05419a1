//! Pipelines of records.

use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    struct Sum<T> { valid: T, sum: T, parts: [T; 2] }
    struct SumIn<T> { enable: T, start: Sum<T> }
}

/// Adds a part in each of three stages, the sum a bit wider in each.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Adder;

impl Block for Adder {
    type In = SumIn;
    type Out = Sum;

    fn inputs(&self) -> SumIn<Width> {
        SumIn { enable: bit(), start: Sum { valid: bit(), sum: bits(4), parts: [bits(4), bits(4)] } }
    }

    fn build(&self, m: Module, i: SumIn) -> Sum {
        m.stages(3, i.enable, i.start.cleared(|start| start.valid), |stage, now| {
            let part = now.parts[stage as usize % 2].zext(now.sum.width());
            Sum { sum: now.sum.add_carry(part), ..now }
        })
    }
}

#[test]
fn registers_are_named_by_field_and_stage() {
    let design = elaborate(&Adder).unwrap();
    let module = design.top();
    let names: Vec<_> = module.registers.iter().map(|register| module.register_name(register)).collect();
    let expected = ["valid", "sum", "parts_0", "parts_1"];
    assert_eq!(names, (1..=3).flat_map(|stage| expected.map(|name| format!("{name}{stage}"))).collect::<Vec<_>>());
    let resets: Vec<_> = module.registers.iter().map(|register| register.reset.is_some()).collect();
    assert_eq!(resets, [true, false, false, false].repeat(3));
}

#[test]
fn it_takes_a_record_a_clock_where_it_is_enabled() {
    let mut sim = Simulation::of(&Adder).unwrap();
    sim.reset();
    let wave = sim.record(["enable", "start_sum", "valid1", "sum1", "sum2", "valid", "sum"]);
    for (enable, valid, sum) in [(1, 1, 15), (1, 0, 0), (0, 0, 0), (1, 1, 1), (1, 0, 0), (1, 0, 0), (1, 0, 0)] {
        sim.drive(SumIn { enable, start: Sum { valid, sum, parts: [15, 1] } });
        sim.step();
    }
    wave.expect(
        r"
        clk       |~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/
        enable    |~~~~~~~~~\____/~~~~~~~~~~~~~~~~~~~~
        start_sum | f  | 0       | 1  | 0            |
        valid1    |____/~~~~\_________/~~~~\__________
        sum1      | 0  | 10 | 1       | 2  | 1       |
        sum2      | 0       | 1f      | 10 | 11 | 10 |
        valid     |___________________/~~~~\____/~~~~~
        sum       | 0                 | 20 | 11 | 12 |
        ",
    );
}
