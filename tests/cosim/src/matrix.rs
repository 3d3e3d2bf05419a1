//! The matrix: every operator at one width, on edge values, in our simulator against big integers; and as a recorded
//! run for the other simulators.

use crate::batch::Printed;
use crate::operators::{BY_WIDTH, Numbers, OPERATORS, Operands};
use crate::spec::Pattern;
use crate::stimulus;
use num_bigint::BigUint;
use tilewright_gen::{testbench, verilog};
use tilewright_hdl::Recording;
use tilewright_hdl::recording::Step;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    /// The operands.
    pub struct MatrixIn<T> {
        /// First operand.
        pub a: T,
        /// Second operand.
        pub b: T,
        /// An amount, or a selector.
        pub by: T,
    }
    /// The result of each operator, in the order of [`OPERATORS`].
    pub struct MatrixOut<T> {
        /// The results.
        pub result: Vec<T>,
        /// The lanes of an array combined: and, or, exclusive or, sum.
        pub lanes: [T; 4],
    }
    /// A lane's input.
    pub struct CellIn<T> {
        /// Passed on.
        pub x: T,
    }
    /// A lane's output.
    pub struct CellOut<T> {
        /// The input.
        pub passed: T,
    }
}

/// All operators at one width.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Matrix {
    /// The width of both operands in bits.
    pub width: u32,
}

impl Block for Matrix {
    type In = MatrixIn;
    type Out = MatrixOut;

    fn inputs(&self) -> MatrixIn<Width> {
        MatrixIn { a: bits(self.width), b: bits(self.width), by: bits(BY_WIDTH) }
    }

    fn build(&self, m: Module, MatrixIn { a, b, by }: MatrixIn) -> MatrixOut {
        let cells = m.array("u_cell", 3, &Cell { width: self.width }, |_| CellIn { x: stack([a, b, !a]) });
        MatrixOut {
            result: OPERATORS.iter().map(|operator| (operator.circuit)(Operands { a, b, by })).collect(),
            lanes: [cells.passed.and_all(), cells.passed.or_all(), cells.passed.xor_all(), cells.passed.sum()],
        }
    }
}

/// Passes its input on, so that an array of it makes lanes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Cell {
    width: u32,
}

impl Block for Cell {
    type In = CellIn;
    type Out = CellOut;

    fn inputs(&self) -> CellIn<Width> {
        CellIn { x: bits(self.width) }
    }

    fn build(&self, _: Module, i: CellIn) -> CellOut {
        CellOut { passed: i.x }
    }
}

/// What our simulator gives for the edge values, and how many results were compared with big integers.
///
/// # Errors
///
/// The first result that differs.
pub fn run(width: u32) -> Result<(Recording, u64), String> {
    let mut sim = Simulation::of(&Matrix { width }).map_err(|error| error.to_string())?;
    let (mut replay, mut compared) = (Recording::default(), 0);
    for [a, b, by] in vectors(width) {
        sim.drive_bits(MatrixIn { a: a.clone(), b: b.clone(), by: by.clone() });
        let MatrixOut { result, lanes } = sim.read();
        let numbers = Numbers { width, a: number(&a), b: number(&b), by: by.limbs()[0] as u32 };
        for (operator, got) in OPERATORS.iter().zip(&result) {
            let expected = (operator.meaning)(&numbers) % (BigUint::from(1u8) << got.width());
            if number(got) != expected {
                return Err(format!("{operator:?} of a = {a}, b = {b}, by = {by} is {got}, expected {expected:#x}"));
            }
            compared += 1;
        }
        replay.steps.push(Step {
            time_ps: 10_000 * (replay.steps.len() as u64 + 1),
            rising: Vec::new(),
            resets: Vec::new(),
            inputs: vec![a, b, by],
            outputs: result.into_iter().chain(lanes).collect(),
        });
    }
    Ok((replay, compared))
}

/// The matrix of a width with its run, for the other simulators.
///
/// # Errors
///
/// As [`run`].
pub fn printed(width: u32) -> Result<Printed, String> {
    let (replay, _) = run(width)?;
    let design = elaborate(&Matrix { width }).map_err(|problems| problems.to_string())?;
    Ok(Printed {
        files: verilog(&design),
        bench: testbench(&design, &replay),
        fails: false,
        covered: None,
        shown: None,
    })
}

/// Edge values against each other, amounts around the width, and random ones.
fn vectors(width: u32) -> Vec<[Bits; 3]> {
    let patterns = [Pattern::Zero, Pattern::One, Pattern::Ones, Pattern::Sign, Pattern::Alternating];
    let mut edges: Vec<Bits> = patterns.iter().map(|pattern| pattern.bits(width)).collect();
    edges.extend([Pattern::Sign.bits(width).not(), Pattern::Alternating.bits(width).not()]);
    let amounts = [0, 1, width - 1, width, width + 1, 64, 128, 511];
    let mut numbers = stimulus::Numbers(u64::from(width));
    let mut vectors = Vec::new();
    for a in &edges {
        for b in &edges {
            let by = amounts[vectors.len() % amounts.len()];
            vectors.push([a.clone(), b.clone(), Bits::new(BY_WIDTH, by.into())]);
        }
    }
    for by in amounts.into_iter().chain(0..8) {
        vectors.push([numbers.bits(width), numbers.bits(width), Bits::new(BY_WIDTH, by.into())]);
        let negative = Pattern::Sign.bits(width);
        vectors.push([negative, numbers.bits(width), Bits::new(BY_WIDTH, by.into())]);
    }
    vectors
}

fn number(bits: &Bits) -> BigUint {
    let digits = bits.limbs().iter().flat_map(|limb| [*limb as u32, (limb >> 32) as u32]);
    BigUint::new(digits.collect())
}
