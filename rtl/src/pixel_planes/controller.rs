//! The image generation controller: takes instructions, sends coefficients bit by bit, and controls all pixels (PP5-UT,
//! facts E3).
//!
//! ```text
//!                  .---------.               .-----------------.  a, b, c, a bit a clock, first
//!                  |         |-------------->| tree slot       |------------------------------> tree
//! instructions ===>| [micro- |               | coefficients >> |----.
//!                  |   code] |               '-----------------'    |  control of pixels
//!                  |         |               .-----------------.    +--->[ tree's latency ]---> pixels
//!                  |         |--->[waiting]->| memory slot     |----'
//!                  '---------'               | constant >>     |
//!                                            '-----------------'
//! ```
//!
//! The controller has two slots. Instructions that use the tree or change `enable` go to the tree slot. Instructions
//! that need only the memory go to the memory slot. So while a primitive's result is still being written to memory, the
//! tree already works on the next primitive's edges. One more instruction may wait for the memory, because a primitive
//! often ends with two such writes. Instructions are taken in sequence, at most one a clock, and each begins
//! immediately after its predecessor:
//!
//! | instruction | taken when |
//! |---|---|
//! | for the tree slot | The tree slot ends in this clock. If the word also needs the memory, the memory is free when the word begins. |
//! | for the memory slot | No instruction waits, or the memory slot ends in this clock. The instruction in the tree slot needs no memory, or ends in this clock. For a save, the backing store is free. |
//! | any, while `side_by_side` is low | Both slots end in this clock, no instruction waits, and the condition above is met. |
//!
//! Coefficients are loaded at the edge at which an instruction begins. So the array never waits while the queue has an
//! instruction (PP5-UT).
//!
//! A curve occupies the tree slot for one clock. Its coefficients wait in registers of their own, and their bits are sent
//! with those of the next expression. Only a controller for a [quadratic](super::quadratic_tree) tree has these
//! registers. It delays the control of the pixels by 4 log2 S clocks.
//!
//! Latency: 1 clock from an instruction to its first bits at the tree. The control of the pixels is delayed by the
//! tree's latency.

use self::slot::{Order, Slot};
use super::instruction::{Instruction, LONGEST, Microcode, Operation};
use super::linear_tree::{Coefficients, LinearTree};
use super::pixel::{Control, PixelProcessor, Source};
use super::quadratic_tree::{Curve, QuadraticTree};
use super::{REGION_BITS, SIDES, fields};
use crate::prelude::*;

mod slot;

block! {
    /// Takes the instructions of a renderer, and controls its tree and its pixels.
    pub struct ImageGenerationController {
        /// Pixels in a line of a region, and lines in a region.
        pub side: u32,
        /// Whether it takes [curves](Operation::Curve), for a [quadratic tree](super::quadratic_tree).
        pub quadratic: bool,
    }
    ranges { side: powers_of_two(SIDES) }
    latency(self) = format!(
        "1 clock to the coefficients' bits, {} to the control of pixels; instructions follow without a gap",
        1 + self.lag(),
    );
    source = "Pixel-planes 5, section I.3.2.1 (PP5-UT)";
    in(self) ImageGenerationControllerIn {
        /// The instructions.
        instructions: stream(Instruction),
        /// Tree and memory may each execute an instruction. While `side_by_side` is low, an instruction begins only after its predecessor has ended.
        side_by_side: bit(),
        /// The backing store can take a region.
        store_free: bit(),
    }
    out(self) ImageGenerationControllerOut {
        /// The bits of the coefficients, for the tree.
        coefficients: Coefficients = Coefficients { a: bit(), b: bit(), c: bit() },
        /// The bits of the curve, for a quadratic tree; 0 for a linear expression.
        curve: [Curve = Curve { d: bit(), e: bit(), f: bit() }; self.quadratic],
        /// The coefficients' bits are the first of an expression.
        first: bit(),
        /// The control of the pixels.
        control: Control,
        /// The commands to the backing store.
        save: Save,
        /// No instruction is offered, waits or is in a slot; the pixels may still be at work.
        idle: bit(),
    }
}

record! {
    /// The commands to the backing store.
    pub struct Save {
        /// A region is about to be saved: the store is no longer free.
        claim: bit(),
        /// The number of the region to save.
        region: bits(REGION_BITS),
        /// The pixels read a plane of the region; their write address is the plane's number.
        plane: bit(),
    }

    /// The control of the pixels, and the command to store a plane, which both wait for the expression.
    struct Sent { control: Control, plane: bit() }
}

impl ImageGenerationController {
    /// Clocks from a coefficient's bit to the expression's bit at each pixel.
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::controller::ImageGenerationController;
    ///
    /// let lag = |quadratic| ImageGenerationController { side: 128, quadratic }.lag();
    /// assert_eq!([false, true].map(lag), [14, 28]);
    /// ```
    pub fn lag(&self) -> u32 {
        let &ImageGenerationController { side, quadratic } = self;
        if quadratic { QuadraticTree { side }.latency() } else { LinearTree { side }.latency() }
    }

    fn build(&self, m: Module, i: ImageGenerationControllerIn) -> ImageGenerationControllerOut {
        def!(microcode = m.rom(Microcode::widths(), Operation::ALL.iter().map(|it| it.microcode())));
        def!(decoded = microcode.read_async(i.instructions.operation.bits()));
        let (tree, memory) = (Slot::new(m, "tree"), Slot::new(m, "memory"));
        def!(waits = m.reg(bit()).reset(0));
        def!(waiting = m.reg(Order::widths()));

        // When the next instruction is taken.
        def!(ahead = Order::clocks(*memory.left) + mux(waits, Order::clocks(waiting.length), 0));
        def!(ends_in_time = ahead.le(Order::clocks(i.instructions.skip) + 1));
        def!(tree_may = tree.ends & (!decoded.on_memory | ends_in_time));
        def!(memory_may = (!waits | memory.ends) & (tree.ends | !tree.on_memory()) & (!decoded.saves | i.store_free));
        def!(both_end = tree.ends & memory.ends & !waits);
        def!(may = mux(decoded.on_tree, tree_may, memory_may) & (i.side_by_side | both_end));
        let next = i.instructions.take_when(may);
        let order = Order::of(&next, decoded);

        // The slot that takes the instruction.
        def!(tree_begins = next.taken & decoded.on_tree);
        def!(for_memory = next.taken & !decoded.on_tree);
        def!(must_wait = for_memory & (waits | !memory.ends));
        waits.when(must_wait, 1).when(memory.ends, 0);
        waiting.when(must_wait, order);
        def!(memory_begins = memory.ends & (waits | for_memory));
        tree.begin(tree_begins, order);
        memory.begin(memory_begins, mux(waits, waiting, order));

        // Coefficients go to the tree, a bit a clock.
        let Coefficients { a, b, c } = next.coefficients;
        let [a, b] =
            [("a", a), ("b", b)].map(|(name, coefficient)| slot::bit_by_bit(m, name, tree_begins, coefficient));
        let curve = self.curve(m, &next, decoded.source.is(Source::Expression));
        def!(first = m.reg(bit()).reset(0));
        first.next(tree_begins & decoded.source.is(Source::Expression));

        // Both slots control the pixels; only one of them controls their memory.
        m.assert(!(tree.on_memory() & tree.is_word & memory.is_word), "at most one of the two slots uses the memory");
        let of_tree = tree.control();
        let of_memory = mux(memory.is_word, memory.control(), of_tree);
        let control = Control { enabling: of_tree.enabling, captures: of_tree.captures, ..of_memory };
        let sent = Sent { control, plane: memory.is_word & memory.saves() };
        let Sent { control, plane } = self.later(m, sent);
        m.assert(
            control.source.is_code() & control.enabling.is_code(),
            "the source and the enabling of the pixels are valid codes",
        );

        self.state_what_instructions_are(m, &next, &decoded);
        let save = Save { claim: next.taken & decoded.saves, region: c.bits().trunc(REGION_BITS), plane };
        ImageGenerationControllerOut {
            coefficients: Coefficients { a, b, c: tree.constant },
            curve,
            first: *first,
            control,
            save,
            idle: !next.valid & tree.left.eq(0) & memory.left.eq(0),
        }
    }

    /// The bits of a curve, sent with those of the following expression.
    fn curve(&self, m: Module, next: &Taken<Instruction>, is_expression: Signal) -> Vec<Curve> {
        let is_curve = next.operation.is(Operation::Curve);
        if !self.quadratic {
            m.assume(next.taken.implies(!is_curve), "only the controller of a quadratic tree takes a curve");
            return Vec::new();
        }
        let comes = next.taken & is_curve;
        let expression = next.taken & is_expression;
        let waits = m.reg("curve_waits", bit()).reset(0);
        waits.when(comes, 1).when(expression, 0);
        let goes = m.reg("curve_goes", bit()).reset(0);
        goes.when(comes, 0).when(expression, waits);
        let Coefficients { a: d, b: e, c: f } = next.coefficients;
        let [d, e, f] = [("d", d), ("e", e), ("f", f)].map(|(name, coefficient)| {
            let bits = m.reg(name, bits(coefficient.width()).signed());
            bits.when(comes, coefficient).when(goes, bits >> 1);
            bits.bit(0) & goes
        });
        vec![Curve { d, e, f }]
    }

    /// `sent`, delayed by the tree's latency.
    fn later(&self, m: Module, sent: Sent) -> Sent {
        (1..=self.lag()).fold(sent, |sent, clock| {
            let register = m.reg(&format!("sent{clock}"), Sent::widths()).reset(0);
            register.next(sent);
            *register
        })
    }

    fn state_what_instructions_are(&self, m: Module, next: &Taken<Instruction>, code: &Microcode) {
        let is_expression = code.source.is(Source::Expression);
        let clocks = Order::clocks(next.skip) + Order::clocks(next.length);
        let state = |holds: Signal, message| m.assume(next.taken.implies(holds), message);
        state(next.operation.is_code(), "the code of an instruction is an operation");
        state(next.length.ne(0) & next.length.le(LONGEST), "a word has 1 to 64 bits");
        let is_whole = next.length.eq(fields::WORD.bits) & next.write.eq(0);
        state(code.saves.implies(is_whole), "a whole word is saved, as planes 0 to 47");
        let end = up_to(2 * PixelProcessor::BITS);
        let is_inside = |first: Signal| (first.zext(end) + next.length.zext(end)).le(PixelProcessor::BITS);
        state(is_inside(next.read) & is_inside(next.write), "a word is within the memory of 208 bits");
        let levels = self.side.trailing_zeros();
        state(
            is_expression.implies(clocks.ge(levels)),
            "an expression has at least as many bits as each tree has levels",
        );
        state(is_expression | next.skip.eq(0), "only an expression has bits to skip");
    }
}

#[cfg(test)]
mod tests;
