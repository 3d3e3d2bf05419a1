//! A renderer of Pixel-planes 5 at work: region after region, from a program stored beside it.
//!
//! ```text
//!  [ program ]==> instructions [ renderer ] planes ==> checksum
//! ```
//!
//! First comes a region of one triangle, so that pixels are sent soon; the following regions repeat. Each region is
//! cleared, drawn by triangles with planes of colour, of which the smallest words stay, and saved. It is sent while
//! the next one is drawn. The checksum covers all planes sent and all instructions taken.
//!
//! It tests thousands of one-bit processors under one instruction, the tree that feeds them, and an instruction
//! decoder.

use tilewright_hdl::{Fields, Module, ReadUnderWrite, Signal, below, bits, block, bundle, cat, def, lit, mux};
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixel_planes::instruction::{COEFFICIENT, Instruction};
use tilewright_rtl::pixel_planes::programs::{Expression, Surface, clear, save, smooth_least};
use tilewright_rtl::pixel_planes::renderer::{Renderer, RendererIn};

use super::BenchOut;
use crate::word::seed;

/// Triangles of a region.
const TRIANGLES: u32 = 40;
/// The length of the instruction queue.
const QUEUE: u32 = 16;

block! {
    /// Regions in sequence, on a renderer of Pixel-planes 5.
    pub struct Regions {
        renderer: Renderer,
    }
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH)";
    out = BenchOut { csum: bits(32) };
}

impl Regions {
    /// A renderer of regions of `side` x `side` pixels.
    ///
    /// # Errors
    ///
    /// There is no renderer with that side.
    pub fn new(side: u32) -> Result<Regions, ParameterError> {
        Ok(Regions { renderer: Renderer { side, queue: QUEUE, quadratic: false }.checked()? })
    }

    /// A region of the first triangles.
    fn region(&self, triangles: u32) -> Vec<Instruction<u64>> {
        let triangles = (0..triangles).flat_map(|number| triangle(self.renderer.side, number));
        clear(0x20_40_60).into_iter().chain(triangles).chain(save(1)).collect()
    }

    /// The hardware; instructions are sent while `is_busy`.
    pub(super) fn work(&self, m: Module, is_busy: Signal) -> BenchOut {
        let first = self.region(1);
        let again = first.len() as u32;
        let program = [first, self.region(TRIANGLES)].concat();
        let count = program.len() as u32;
        def!(at = m.reg(below(count)).reset(0));
        let words =
            m.memory("program", count, Instruction::widths(), ReadUnderWrite::Any).words(program.iter().map(word));
        let (instructions, sent) = m.offer(is_busy, words.read_async(*at));
        at.when(sent, mux(at.eq(count - 1), u64::from(again), at + 1));

        let renderer = RendererIn { instructions, side_by_side: lit(1, 1) };
        let renderer = m.instance("u_renderer", &self.renderer, renderer);
        let plane = renderer.planes.take_when(1);
        def!(csum = m.reg(bits(32)).reset(0));
        let number = cat![plane.plane, plane.line].zext(32);
        let pixels = mux(plane.taken, folded(plane.bits.pack()) ^ number, 0);
        let instruction = mux(sent, (*at + 1).zext(32), 0);
        csum.when(plane.taken | sent, csum.rotate_left(1) + pixels + instruction);
        BenchOut { csum: *csum }
    }

    fn build(&self, m: Module, (): ()) -> BenchOut {
        self.work(m, lit(1, 1))
    }
}

/// As a word of a memory, in which coefficients have their sign.
fn word(instruction: &Instruction<u64>) -> Instruction<i64> {
    let above = 64 - COEFFICIENT;
    let signed = |number: &u64| (number << above) as i64 >> above;
    let Instruction { coefficients, .. } = instruction;
    Instruction { coefficients: coefficients.map(signed), ..instruction.map(|number| *number as i64) }
}

/// The exclusive or of all words of 32 bits.
fn folded(all: Signal) -> Signal {
    let words = (0..all.width().div_ceil(32)).map(|word| {
        let low = word * 32;
        all.slice(low..(low + 32).min(all.width())).zext(32)
    });
    words.reduce(|all, word| all ^ word).expect("there is a word")
}

bundle! {
    /// A corner.
    struct Corner<T> { x: T, y: T }
}

/// The instructions of a triangle with corners, depth and colours at random.
fn triangle(side: u32, number: u32) -> Vec<Instruction<u64>> {
    let random = |index: u32, most: i64| (seed(16 * number + index) >> 8) as i64 % (2 * most) - most;
    let corner = |index: u32| {
        let [x, y] = [2 * index, 2 * index + 1].map(|index| (seed(16 * number + index) >> 9) as i64 % i64::from(side));
        Corner { x, y }
    };
    let [first, second, third] = [0, 1, 2].map(corner);
    let is_inside_out = edge(&first, &second, &third) < 0;
    let corners = if is_inside_out { [first, third, second] } else { [first, second, third] };
    let edges = [0, 1, 2].map(|index| line(&corners[index], &corners[(index + 1) % 3]));
    let plane = |index: u32, most: i64| {
        let [a, b] = [index, index + 1].map(|index| random(index, most / i64::from(side)));
        Expression { a, b, c: 2 * most + random(index + 2, most / 2) }
    };
    let surface = Surface { z: plane(6, 1 << 36), rgb: [9, 10, 11].map(|index| plane(index, 1 << 21)) };
    smooth_least(side, &edges, &surface)
}

/// The line that is 0 or more to the right of the way from one corner to another, y pointing down.
fn line(from: &Corner<i64>, to: &Corner<i64>) -> Expression {
    let (a, b) = (from.y - to.y, to.x - from.x);
    Expression { a, b, c: -(a * from.x + b * from.y) }
}

/// The value, at a third corner, of the line from one corner to another.
fn edge(from: &Corner<i64>, to: &Corner<i64>, at: &Corner<i64>) -> i64 {
    let Expression { a, b, c } = line(from, to);
    a * at.x + b * at.y + c
}
