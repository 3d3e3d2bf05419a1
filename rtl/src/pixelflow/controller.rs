//! The array's controller: takes instructions, sends coefficients byte by byte, and controls all pixels (PFL-NODE,
//! facts E4).
//!
//! ```text
//!                  .---------.               .-----------------.  a, b, c, a byte a clock, first
//!                  |         |-------------->| evaluator slot  |------------------------------> evaluator
//! instructions ===>| needs   |               | coefficients >> |----.
//!                  |         |               '-----------------'    |  control of pixels
//!                  |         |               .-----------------.    +--->[ evaluator's latency ]--> pixels
//!                  |         |--->[waiting]->| memory slot     |----'
//!                  '---------'               | constant >>     |
//!                       ^                    '-----------------'
//!   under way: banks, texture unit <-- claimed, done
//! ```
//!
//! The controller has two slots. Instructions that use the evaluator, or that read or change `enable`, go to the
//! evaluator slot. All others, such as copies where a flag is set, go to the memory slot. So while a primitive's result
//! is still being written, the evaluator already works on the next primitive's edges, whose signs bypass the ALU. One
//! more instruction may wait for the memory. Instructions are taken in sequence, at most one a clock, and each begins
//! right behind its predecessor:
//!
//! | instruction | taken when |
//! |---|---|
//! | on the evaluator | its slot ends in this clock; and, if its word also needs ALU or memory, the memory slot is free by then |
//! | on the memory | no instruction waits, or the memory slot ends in this clock; and the instruction in the evaluator slot needs no ALU, or also ends |
//! | any, one at a time | both slots end in this clock |
//! | synchronized with a port | both slots end in this clock, and the port has finished |
//!
//! Coefficients are loaded at the edge at which an instruction begins. So the array never waits while instructions
//! come.
//!
//! Latency: 1 clock from an instruction to its first bytes at the evaluator. The control of the pixels is delayed as
//! long as the expression.

use self::slot::{Order, Slot};
use super::instruction::{Instruction, LONGEST, Sync};
use super::linear_evaluator::{Coefficients, LinearEvaluator};
use super::pixel::{Condition, Control, Enabling, Flagging, Function, Mask, PixelProcessor, Source};
use crate::prelude::*;

mod slot;

/// The number of banks of communication registers for the network.
pub const BANKS: u32 = 2;

block! {
    /// Takes the instructions of a node, and controls its evaluator and its pixels.
    pub struct ArrayController {
        /// Pixels in a line of a region; a power of two.
        pub width: u32,
        /// Lines in a region; a power of two.
        pub height: u32,
    }
    latency(self) = format!(
        "1 clock to the coefficients' bytes, {} to the control of pixels; the next instruction begins with the last byte",
        1 + self.evaluator().latency(),
    );
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in ArrayControllerIn {
        /// The instructions.
        instructions: stream(Instruction),
        /// Evaluator and memory may each have an instruction; while it is low, one begins when the one before has ended.
        side_by_side: bit(),
        /// The network is done with a bank: a bit for each.
        bank_done: bits(BANKS),
        /// The texture unit is done.
        texture_done: bit(),
    }
    out(self) ArrayControllerOut {
        /// To the evaluator.
        coefficients: Coefficients = Coefficients { a: bits(8), b: bits(8), c: bits(8) },
        /// The coefficients' bytes are the first of an expression.
        first: bit(),
        /// The coefficients are bytes of an expression.
        sends: bit(),
        /// To the pixels.
        control: Control,
        /// To network and texture unit, with the pixels' control: after the next edge the registers contain the results of all instructions so far.
        given: Given,
        /// Nothing is under way except in the pixels.
        idle: bit(),
    }
}

record! {
    /// What network and texture unit are told about the registers.
    pub struct Given {
        /// A bank is for the network now: a bit for each.
        banks: bits(BANKS),
        /// The texture unit begins.
        texture: bit(),
    }

    /// The control of the pixels, and with it of the ports.
    struct Sent { control: Control, given: Given }
}

/// The resources that an instruction needs.
struct Needs {
    on_evaluator: Signal,
    /// ALU or memory, in the clocks of its word.
    on_memory: Signal,
    expression: Signal,
    by_sign: Signal,
}

impl Needs {
    fn of(i: &Instruction) -> Needs {
        def!(expression = i.source.is(Source::Expression));
        let any = |condition: Signal, codes: &[Enabling]| {
            codes.iter().map(|code| i.enabling.is(*code)).fold(condition, |any, is| any | is)
        };
        // Its condition, if any, is the expression's sign.
        def!(looks = any(lit(1, 0), &[Enabling::Replace, Enabling::Restrict, Enabling::Push]));
        def!(by_sign = looks & expression & i.condition.is(Condition::Positive));
        def!(writes = !i.mask.is(Mask::Nobody) & (i.accumulates | i.stores));
        def!(quiet = i.function.is(Function::Operand) & !writes & i.flagging.is(Flagging::Keep) & (!looks | by_sign));
        def!(
            on_enable =
                !i.enabling.is(Enabling::Keep) | i.mask.is(Mask::Enabled) | i.flagging.is(Flagging::EnabledCondition)
        );
        def!(on_evaluator = expression | on_enable);
        def!(on_memory = !on_evaluator | !quiet);
        Needs { on_evaluator, on_memory, expression, by_sign }
    }
}

impl ArrayController {
    fn evaluator(&self) -> LinearEvaluator {
        LinearEvaluator { width: self.width, height: self.height }
    }

    fn build(&self, m: Module, i: ArrayControllerIn) -> ArrayControllerOut {
        let (evaluator, memory) = (Slot::new(m, "evaluator"), Slot::new(m, "memory"));
        def!(waits = m.reg(bit()).reset(0));
        def!(waiting = m.reg(Order::widths()));
        let needs = Needs::of(&i.instructions);

        // When the next instruction is taken.
        def!(ahead = Order::clocks(*memory.left) + mux(waits, Order::clocks(waiting.length), 0));
        def!(ends_in_time = ahead.le(Order::clocks(i.instructions.skip) + 1));
        def!(evaluator_may = evaluator.ends & (!needs.on_memory | ends_in_time));
        def!(memory_may = (!waits | memory.ends) & (evaluator.ends | !evaluator.on_memory()));
        def!(both_end = evaluator.ends & memory.ends & !waits);
        let ports = Ports::new(m, &i);
        def!(in_turn = (i.side_by_side & i.instructions.sync.is(Sync::Nothing)) | both_end);
        def!(may = mux(needs.on_evaluator, evaluator_may, memory_may) & in_turn & !ports.waits(&i.instructions));
        let next = i.instructions.take_when(may);
        ports.claim(m, &next);
        let order = Order::of(&next, needs.on_memory, needs.by_sign);

        // The slot that it goes to.
        def!(evaluator_begins = next.taken & needs.on_evaluator);
        def!(for_memory = next.taken & !needs.on_evaluator);
        def!(must_wait = for_memory & (waits | !memory.ends));
        waits.when(must_wait, 1).when(memory.ends, 0);
        waiting.when(must_wait, order);
        def!(memory_begins = memory.ends & (waits | for_memory));
        evaluator.begin(evaluator_begins, order);
        memory.begin(memory_begins, mux(waits, waiting, order));

        // Coefficients go to the evaluator, a byte a clock.
        let [a, b] = [("a", next.a), ("b", next.b)]
            .map(|(name, coefficient)| slot::byte_by_byte(m, name, evaluator_begins, coefficient));
        def!(first = m.reg(bit()).reset(0));
        first.next(evaluator_begins & needs.expression);
        def!(sends = m.reg(bit()).reset(0));
        sends.when(evaluator_begins, needs.expression).when(evaluator.ends, 0);

        // Both slots control the pixels; one of them controls ALU and memory.
        m.assert(
            !(evaluator.on_memory() & evaluator.is_word & memory.is_word),
            "at most one of two instructions uses the memory",
        );
        let of_evaluator = evaluator.control();
        let of_memory = mux(memory.is_word, memory.control(), of_evaluator);
        let control = Control { enabling: of_evaluator.enabling, by_sign: of_evaluator.by_sign, ..of_memory };
        let [here, there] = [evaluator.given(), memory.given()];
        let given = Given { banks: here.banks | there.banks, texture: here.texture | there.texture };
        let Sent { control, given } = self.later(m, Sent { control, given });
        let Control { source, function, begin, condition, enabling, flagging, .. } = control;
        m.assert(
            are_codes(&[source, function, begin, condition, enabling, flagging]),
            "the controls of pixels are valid codes",
        );

        state_what_instructions_are(m, &next, &needs);
        ArrayControllerOut {
            coefficients: Coefficients { a, b, c: evaluator.constant },
            first: *first,
            sends: *sends,
            control,
            given,
            idle: !next.valid & evaluator.left.eq(0) & memory.left.eq(0),
        }
    }

    /// The same, delayed as long as the evaluator takes for an expression.
    fn later(&self, m: Module, sent: Sent) -> Sent {
        (1..=self.evaluator().latency()).fold(sent, |sent, clock| {
            let register = m.reg(&format!("sent{clock}"), Sent::widths()).reset(0);
            register.next(sent);
            *register
        })
    }
}

/// What the ports still work on: an instruction has handed it over, and the port has not finished.
struct Ports {
    banks: Reg,
    texture: Reg,
    bank_done: Signal,
    texture_done: Signal,
}

impl Ports {
    fn new(m: Module, i: &ArrayControllerIn) -> Ports {
        Ports {
            banks: m.reg("banks_under_way", bits(BANKS)).reset(0),
            texture: m.reg("texture_under_way", bit()).reset(0),
            bank_done: i.bank_done,
            texture_done: i.texture_done,
        }
    }

    /// The instruction waits for a port.
    fn waits(&self, i: &Instruction) -> Signal {
        def!(bank_is_out = (*self.banks & slot::bank(i.c)).ne(0));
        def!(waits_for_bank = i.sync.is(Sync::AwaitBank) & bank_is_out);
        waits_for_bank | (i.sync.is(Sync::AwaitTexture) & self.texture)
    }

    fn claim(&self, m: Module, next: &Taken<Instruction>) {
        let bank = slot::bank(next.c);
        let gives = next.sync.is(Sync::GiveBank);
        let starts = next.sync.is(Sync::StartTexture);
        self.banks.next((*self.banks & !self.bank_done) | mux(next.taken & gives, bank, 0));
        self.texture.when(next.taken & starts, 1).when(self.texture_done, 0);
        let state = |holds: Signal, message| m.assume(next.taken.implies(holds), message);
        state(gives.implies((*self.banks & bank).eq(0)), "a bank is given when the network has done with it");
        state(starts.implies(!self.texture), "the texture unit begins when it has done");
    }
}

fn state_what_instructions_are(m: Module, next: &Taken<Instruction>, needs: &Needs) {
    let state = |holds: Signal, message| m.assume(next.taken.implies(holds), message);
    state(next.length.ne(0) & next.length.le(LONGEST), "a word has 1 to 8 bytes");
    state(needs.expression | next.skip.eq(0), "only of an expression bytes are skipped");
    let end = up_to(2 * PixelProcessor::BYTES);
    let is_inside = |first: Signal| {
        let (first, length) = (first.zext(end), next.length.zext(end));
        mux(next.descends, (first + 1).ge(length), (first + length).le(PixelProcessor::BYTES))
    };
    state(is_inside(next.read) & is_inside(next.write), "a word is within the memory of 384 bytes");
    let Instruction { source, function, begin, condition, enabling, flagging, sync, .. } = **next;
    let fields = [source, function, begin, condition, enabling, flagging, sync];
    state(are_codes(&fields), "each field has a code that there is");
}

/// Each of these fields has a valid code.
fn are_codes(fields: &[Signal]) -> Signal {
    fields.iter().fold(lit(1, 1), |all, field| all & field.is_code())
}

#[cfg(test)]
mod tests;
