//! The microprograms that draw a primitive in a region, clear a region, and save it (facts E0, E3).
//!
//! Each program is a record in a file of its own: the operations, the words they read and write, and their operands.
//! [`Program::draw`] makes a program's instructions, as the host of a renderer would. Less is nearer. The rule
//! determines what a pixel keeps:
//!
//! | rule | a fragment is kept if | primitives of one colour | with colour planes |
//! |---|---|---|---|
//! | none | it is drawn last | [`FLAT`] | |
//! | strict | its depth is less; the first of equal depths stays | [`FLAT_STRICT`] | [`SMOOTH_STRICT`] |
//! | least word | its z \|\| rgb is less, in any sequence | [`FLAT_LEAST`] | [`SMOOTH_LEAST`] |
//!
//! Triangles, polygons and vectors differ only in the number of their edges; a vector is a polygon with four. [`Edges`]
//! chooses the form in which edges are sent.
//!
//! The table gives N: the clocks from a primitive's first operation to the next one's (PP5-UT), in regions of 128 x 128
//! pixels. "Worst" is for many equal primitives whose edges take the most bits. "Mean" is over random vectors of 50
//! pixels, or the teapot's triangles at 640x480. "One at a time" adds up all instructions. "Side by side" lets the
//! memory work while the tree processes the next primitive's edges. With least edges, the memory then limits
//! [`FLAT_LEAST`] to 4 times 24 clocks. The paper's 239 ns per vector correspond to 94 clocks (PP5-UTV); its text does
//! not say how many bits it assumes.
//!
//! This command prints the table: `cargo test --release -p tilewright-machines the_table_of -- --nocapture`.
//!
//! | program | primitives | edges | one at a time: worst | mean | side by side: worst | mean |
//! |---|---|---|---|---|---|---|
//! | `flat` | vectors | fixed | 124 | 110.9 | 101 | 87.9 |
//! | `flat` | vectors | own | 88 | 77.7 | 65 | 54.7 |
//! | `flat` | vectors | least | 70 | 63.2 | 47 | 40.3 |
//! | `flat_strict` | vectors | fixed | 188 | 174.9 | 142 | 128.9 |
//! | `flat_strict` | vectors | own | 152 | 141.7 | 106 | 95.7 |
//! | `flat_strict` | vectors | least | 134 | 127.2 | 88 | 81.3 |
//! | `flat_least` | vectors | fixed | 212 | 198.9 | 142 | 129.0 |
//! | `flat_least` | vectors | own | 176 | 165.7 | 106 | 98.8 |
//! | `flat_least` | vectors | least | 158 | 151.2 | 96 | 96.0 |
//! | `smooth_strict` | triangles | fixed | 211 | 209.6 | 188 | 186.6 |
//! | `smooth_strict` | triangles | own | 210 | 182.3 | 187 | 159.3 |
//! | `smooth_strict` | triangles | least | 181 | 176.0 | 158 | 153.0 |
//! | `smooth_least` | triangles | fixed | 235 | 233.6 | 188 | 186.6 |
//! | `smooth_least` | triangles | own | 234 | 206.3 | 187 | 159.3 |
//! | `smooth_least` | triangles | least | 205 | 200.0 | 158 | 153.2 |
//! | `flat` | polygons of 8 edges | fixed | 224 | | 201 | |
//! | `flat` | polygons of 8 edges | own | 214 | | 191 | |
//! | `flat` | polygons of 8 edges | least | 144 | | 121 | |
//! | `flat_strict` | polygons of 8 edges | fixed | 288 | | 242 | |
//! | `flat_strict` | polygons of 8 edges | own | 278 | | 232 | |
//! | `flat_strict` | polygons of 8 edges | least | 208 | | 162 | |
//! | `flat_least` | polygons of 8 edges | fixed | 312 | | 242 | |
//! | `flat_least` | polygons of 8 edges | own | 302 | | 232 | |
//! | `flat_least` | polygons of 8 edges | least | 232 | | 162 | |
//! | `smooth_strict` | polygons of 8 edges | fixed | 336 | | 313 | |
//! | `smooth_strict` | polygons of 8 edges | own | 326 | | 303 | |
//! | `smooth_strict` | polygons of 8 edges | least | 256 | | 233 | |
//! | `smooth_least` | polygons of 8 edges | fixed | 360 | | 313 | |
//! | `smooth_least` | polygons of 8 edges | own | 350 | | 303 | |
//! | `smooth_least` | polygons of 8 edges | least | 280 | | 233 | |
//!
//! A [sphere](Program::draw_sphere) has one quadratic instead of edges, and quadratic planes (PP5-ARCH, facts C). If
//! its silhouette has n bits and all planes are curved, N is as follows (tested by
//! `cargo test -p tilewright-rtl --lib a_sphere_takes`):
//!
//! | program | one at a time | side by side |
//! |---|---|---|
//! | `flat` | n + 26 | n + 3 |
//! | `flat_strict` | n + 90 | n + 44, at least 72 |
//! | `flat_least` | n + 114 | 96 |
//! | `smooth_strict` | n + 141 | n + 118 |
//! | `smooth_least` | n + 165 | n + 118, at least 147 |
//!
//! ```
//! use tilewright_rtl::pixel_planes::programs::{Expression, clear, flat, save};
//!
//! // A region of 8 x 8 pixels, orange where x is 3 or more and x - y is 0 or more.
//! let edges = [Expression { a: 1, b: 0, c: -3 }, Expression { a: 1, b: -1, c: 0 }];
//! let program = [clear(0x00_00_00), flat(8, &edges, 0xff_80_00), save(17)].concat();
//! let clocks: Vec<u64> = program.iter().map(|instruction| instruction.skip + instruction.length).collect();
//! assert_eq!(clocks, [24, 24, 4, 4, 24, 48]);
//! ```

use super::fields::Field;
use super::instruction::{COEFFICIENT, Instruction, Operation};
use super::linear_tree::Coefficients;
use crate::prelude::Codes;

mod clear;
mod edges;
mod flat;
mod flat_least;
mod flat_strict;
pub mod half_plane;
mod quadratic;
mod save;
mod smooth_least;
mod smooth_strict;

pub use clear::{CLEAR, clear};
pub use edges::Edges;
pub use flat::{FLAT, flat};
pub use flat_least::{FLAT_LEAST, flat_least};
pub use flat_strict::{FLAT_STRICT, flat_strict};
pub use quadratic::Quadratic;
pub use save::{SAVE, save};
pub use smooth_least::{SMOOTH_LEAST, smooth_least};
pub use smooth_strict::{SMOOTH_STRICT, smooth_strict};

/// A x + B y + C over the pixels of a region, with (0, 0) at its upper left. A pixel is inside an edge where the value
/// is at least 0. Depth is modulo 2^40 and a colour modulo 2^24, each with 16 fraction bits.
pub type Expression = Coefficients<i64>;

/// The fraction bits of planes.
const FRACTION: u32 = 16;

/// The planes of a primitive; for a sphere they are [quadratics](Quadratic).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Surface<E = Expression> {
    /// Depth.
    pub z: E,
    /// Red, green and blue.
    pub rgb: [E; 3],
}

impl<E: Copy + From<Expression> + Into<Quadratic>> Surface<E> {
    /// A surface in one colour.
    pub fn of_one_colour(z: E, rgb: u32) -> Surface<E> {
        let [_, rgb @ ..] = rgb.to_be_bytes();
        let plane = |channel: u8| Expression { a: 0, b: 0, c: i64::from(channel) << FRACTION };
        Surface { z, rgb: rgb.map(|channel| plane(channel).into()) }
    }

    /// The colour at the upper left pixel. If the colour planes have no slope, every pixel has this colour.
    pub fn colour(&self) -> u32 {
        let [r, g, b] = self.rgb.map(|plane| (plane.into().c >> FRACTION) as u8);
        u32::from_be_bytes([0, r, g, b])
    }
}

/// A microprogram.
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::{Edges, Expression, FLAT, FLAT_STRICT, Surface};
///
/// let edges = [Expression { a: 2, b: 0, c: -5 }, Expression { a: 1, b: 1, c: -20 }];
/// let surface = Surface::of_one_colour(Expression { a: 0, b: 0, c: 77 << 16 }, 0xff_80_00);
/// let clocks = FLAT_STRICT.draw(32, Edges::Least, &edges, &surface).iter().map(|it| it.skip + it.length).sum::<u64>();
/// assert_eq!(clocks, 6 + 7 + 40 + 24 + 24);
/// // A region of 8 x 8 pixels contains none of it.
/// assert!(FLAT.draw(8, Edges::Least, &edges, &surface).is_empty());
/// ```
#[derive(Debug, PartialEq, Eq)]
pub struct Program {
    /// The program's name in reports.
    pub name: &'static str,
    /// The use of the edges, which come first.
    pub edges: EdgeUse,
    /// Whether the program draws all pixels in one colour.
    pub is_flat: bool,
    /// The steps after the edges.
    pub steps: &'static [Step],
}

/// The use of edges in a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeUse {
    /// There are no edges: the program processes the whole region.
    None,
    /// The edges enable the pixels inside all of them.
    Enable,
    /// The edges enable the pixels inside all of them, and set these pixels' flags.
    EnableAndFlag,
}

/// An instruction of a program: an operation on words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// The operation.
    pub operation: Operation,
    /// The operand.
    pub operand: Operand,
    /// The word that is read.
    pub read: Field,
    /// The word that is written; its length is the instruction's.
    pub write: Field,
}

/// The operand of a step, apart from the word that it reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operand {
    /// No operand.
    Nothing,
    /// The whole part of the depth plane.
    Depth,
    /// The whole part of the red plane.
    Red,
    /// The whole part of the green plane.
    Green,
    /// The whole part of the blue plane.
    Blue,
    /// The number given with the program: a colour, or a region's number.
    Number,
    /// The farthest depth.
    Farthest,
}

impl Step {
    /// An operation that compares a plane with the stored value, and writes the new value.
    const fn beside(operation: Operation, operand: Operand, field: Field) -> Step {
        Step { operation, operand, read: field, write: field.new_value() }
    }

    /// An operation on a single field.
    const fn on(operation: Operation, operand: Operand, field: Field) -> Step {
        Step { operation, operand, read: field, write: field }
    }

    /// Keeps the new value where the flag is set.
    const fn keep(field: Field) -> Step {
        Step { operation: Operation::CopyFlagged, operand: Operand::Nothing, read: field.new_value(), write: field }
    }

    /// The step's instruction, preceded by a curve where needed.
    fn instructions<E: Copy + Into<Quadratic>>(
        &self,
        number: i64,
        surface: &Surface<E>,
    ) -> impl Iterator<Item = Instruction<u64>> {
        let constant = |c| (0, Expression { a: 0, b: 0, c }.into());
        let plane = |plane: E| (FRACTION, plane.into());
        let [red, green, blue] = surface.rgb;
        let (skip, expression) = match self.operand {
            Operand::Nothing => constant(0),
            Operand::Depth => plane(surface.z),
            Operand::Red => plane(red),
            Operand::Green => plane(green),
            Operand::Blue => plane(blue),
            Operand::Number => constant(number),
            Operand::Farthest => constant(-1),
        };
        let instruction = Instruction {
            operation: self.operation.code(),
            skip: skip.into(),
            length: self.write.bits.into(),
            read: self.read.address.into(),
            write: self.write.address.into(),
            coefficients: modular(&expression.linear()),
        };
        expression.curve().into_iter().chain([instruction])
    }
}

impl Program {
    /// The programs that draw primitives.
    pub const PRIMITIVES: [&Program; 5] = [&FLAT, &FLAT_STRICT, &FLAT_LEAST, &SMOOTH_STRICT, &SMOOTH_LEAST];

    /// The instructions that draw a primitive in a region of `side` x `side` pixels, with all coefficients relative to
    /// the region. There are none if an edge has the whole region outside. A program in one colour takes the colour of
    /// the [upper left pixel](Surface::colour).
    ///
    /// The first instruction needs the tree alone, so the clocks of a primitive do not depend on how the next one
    /// begins.
    pub fn draw(&self, side: u32, form: Edges, edges: &[Expression], surface: &Surface) -> Vec<Instruction<u64>> {
        form.tests(side, edges).map_or_else(Vec::new, |tests| self.behind(tests, surface))
    }

    /// The instructions that draw a sphere, or any other shape whose inside is where one quadratic is at least 0. The
    /// region has `side` x `side` pixels, and all coefficients are [relative to it](Quadratic::moved). There are none
    /// if no pixel is inside. They need a renderer that [evaluates quadratics](super::renderer::Renderer::quadratic).
    /// Linear expressions need no [`Curve`](Operation::Curve).
    ///
    /// The values of `inside` in the region fit 40 bits in two's complement.
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::programs::{Expression, Quadratic, SMOOTH_LEAST, Surface};
    ///
    /// // 9 - (x - 3)² - (y - 4)² >= 0, and it is nearest in the middle.
    /// let inside = Quadratic { a: 6, b: 8, c: 9 - 9 - 16, d: -1, e: 0, f: -1 };
    /// let z = Quadratic { c: 1000 << 16, ..inside.times(-(1 << 16)) };
    /// let grey = Expression { a: 0, b: 0, c: 0x80 << 16 }.into();
    /// let program = SMOOTH_LEAST.draw_sphere(8, &inside, &Surface { z, rgb: [grey; 3] });
    /// // A curve and the sign of -23 to 9; three colours without a curve; a curve and the depth; the word that is kept.
    /// let clocks: Vec<u64> = program.iter().map(|instruction| instruction.skip + instruction.length).collect();
    /// assert_eq!(clocks, [1, 6, 24, 24, 24, 1, 40, 48]);
    /// // The region to the right of it is empty.
    /// assert!(SMOOTH_LEAST.draw_sphere(8, &inside.moved([8, 0]), &Surface { z: z.moved([8, 0]), rgb: [grey; 3] }).is_empty());
    /// ```
    pub fn draw_sphere(&self, side: u32, inside: &Quadratic, surface: &Surface<Quadratic>) -> Vec<Instruction<u64>> {
        inside.test(side).map_or_else(Vec::new, |test| self.behind(test, surface))
    }

    /// The program, given its tests.
    fn behind<E: Copy + From<Expression> + Into<Quadratic>>(
        &self,
        mut program: Vec<Instruction<u64>>,
        surface: &Surface<E>,
    ) -> Vec<Instruction<u64>> {
        if self.edges == EdgeUse::EnableAndFlag {
            match program.last_mut() {
                Some(last) if last.operation == Operation::Test.code() => last.operation = Operation::TestLast.code(),
                _ => program.push(alone(Operation::Flag)),
            }
        }
        program.extend(self.with(surface.colour().into(), surface));
        program
    }

    /// The instructions of all steps.
    fn with<E: Copy + Into<Quadratic>>(
        &self,
        number: i64,
        surface: &Surface<E>,
    ) -> impl Iterator<Item = Instruction<u64>> {
        self.steps.iter().flat_map(move |step| step.instructions(number, surface))
    }

    /// The instructions of a program that processes a whole region.
    fn of_region(&self, number: u32) -> Vec<Instruction<u64>> {
        let nothing = Expression { a: 0, b: 0, c: 0 };
        self.with(number.into(), &Surface { z: nothing, rgb: [nothing; 3] }).collect()
    }
}

/// An instruction that needs neither word nor expression.
fn alone(operation: Operation) -> Instruction<u64> {
    let coefficients = Coefficients { a: 0, b: 0, c: 0 };
    Instruction { operation: operation.code(), skip: 0, length: 1, read: 0, write: 0, coefficients }
}

fn modular(expression: &Expression) -> Coefficients<u64> {
    let modular = |number: i64| number as u64 & ((1 << COEFFICIENT) - 1);
    let &Coefficients { a, b, c } = expression;
    Coefficients { a: modular(a), b: modular(b), c: modular(c) }
}

#[cfg(test)]
mod tests;
