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
//! more instruction may wait for the memory. Instructions are taken in sequence, at most one per clock, and each begins
//! in the clock after its predecessor:
//!
//! | instruction | taken when |
//! |---|---|
//! | on the evaluator | its slot ends in this clock; and the memory slot is free when the word begins, if the word needs ALU or memory |
//! | on the memory | no instruction waits, or the memory slot ends in this clock; and the instruction in the evaluator slot needs no ALU, or also ends |
//! | any, one at a time | both slots end in this clock |
//! | synchronized with a port | both slots end in this clock, and the port has finished |
//!
//! Coefficients are loaded at the edge at which an instruction begins. So the array does not wait while instructions
//! arrive.
//!
//! Latency: 1 clock from an instruction to its first bytes at the evaluator. The control of the pixels is delayed by
//! the latency of the evaluator.

use self::slot::{Slot, Work};
use super::SIDES;
use super::instruction::{Instruction, LONGEST, Sync};
use super::linear_evaluator::{Coefficients, LinearEvaluator};
use super::pixel::{Condition, Control, Enabling, Flagging, Function, Mask, PixelProcessor, Source};
use crate::prelude::*;

mod slot;

/// The number of banks of communication registers for the network.
pub const BANKS: u32 = 2;

block! {
    /// Takes the instructions of a node, and controls the evaluator and the pixels.
    pub struct ArrayController {
        /// The number of pixels in a line of a region.
        pub width: u32,
        /// The number of lines of a region.
        pub height: u32,
    }
    ranges { width: powers_of_two(SIDES), height: powers_of_two(SIDES) }
    latency(self) = format!(
        "1 clock to the bytes of the coefficients, {} to the control of pixels; the next instruction is taken with the last byte",
        1 + self.evaluator().latency(),
    );
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in ArrayControllerIn {
        /// The instructions.
        instructions: stream(Instruction),
        /// Evaluator and memory may execute two instructions at once; while this is low, they execute one at a time.
        side_by_side: bit(),
        /// For one clock: the network is done with a bank; a bit for each.
        bank_done: bits(BANKS),
        /// For one clock: the texture unit is done.
        texture_done: bit(),
    }
    out(self) ArrayControllerOut {
        /// A byte of each coefficient for the evaluator.
        coefficients: Coefficients = Coefficients { a: bits(8), b: bits(8), c: bits(8) },
        /// The bytes of the coefficients are the first of an expression.
        first: bit(),
        /// The bytes of the coefficients belong to an expression.
        sends: bit(),
        /// The control of the pixels.
        control: Control,
        /// The hand-over to network and texture unit: after the next edge the registers have all results so far.
        given: Given,
        /// No instruction is offered, and none is in a slot.
        idle: bit(),
    }
}

record! {
    /// The hand-over of registers to the network and the texture unit.
    pub struct Given {
        /// For one clock: a bank is given to the network; a bit for each.
        banks: bits(BANKS),
        /// For one clock: the texture unit begins.
        texture: bit(),
    }

    /// The control of the pixels, with the hand-over of registers.
    struct Sent { control: Control, given: Given }
}

/// The resources that an instruction needs.
struct Needs {
    on_evaluator: Signal,
    /// The instruction uses ALU or memory in the clocks of its word.
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
        // The condition, if the instruction looks at one, is the expression's sign.
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
        def!(waiting = m.reg(Work::widths()));
        let needs = Needs::of(&i.instructions);

        // When the next instruction is taken.
        def!(ahead = Work::clocks(*memory.left) + mux(waits, Work::clocks(waiting.length), 0));
        def!(ends_in_time = ahead.le(Work::clocks(i.instructions.skip) + 1));
        def!(evaluator_may = evaluator.ends & (!needs.on_memory | ends_in_time));
        def!(memory_may = (!waits | memory.ends) & (evaluator.ends | !evaluator.on_memory()));
        def!(both_end = evaluator.ends & memory.ends & !waits);
        let ports = Ports::new(m, &i);
        def!(in_turn = (i.side_by_side & i.instructions.sync.is(Sync::Nothing)) | both_end);
        def!(may = mux(needs.on_evaluator, evaluator_may, memory_may) & in_turn & !ports.waits(&i.instructions));
        let next = i.instructions.take_when(may);
        ports.claim(m, &next);
        let work = Work::of(&next, needs.on_memory, needs.by_sign);

        // The slot that the instruction goes to.
        def!(evaluator_begins = next.taken & needs.on_evaluator);
        def!(for_memory = next.taken & !needs.on_evaluator);
        def!(must_wait = for_memory & (waits | !memory.ends));
        waits.when(must_wait, 1).when(memory.ends, 0);
        waiting.when(must_wait, work);
        def!(memory_begins = memory.ends & (waits | for_memory));
        evaluator.begin(evaluator_begins, work);
        memory.begin(memory_begins, mux(waits, waiting, work));

        // The coefficients go to the evaluator, a byte of each in every clock.
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

    /// The same control, delayed by the latency of the evaluator.
    fn later(&self, m: Module, sent: Sent) -> Sent {
        (1..=self.evaluator().latency()).fold(sent, |sent, clock| {
            let register = m.reg(&format!("sent{clock}"), Sent::widths()).reset(0);
            register.next(sent);
            *register
        })
    }
}

/// What instructions have handed over to the ports, and the ports have not finished.
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
        state(gives.implies((*self.banks & bank).eq(0)), "a bank is given only when the network is done with it");
        state(starts.implies(!self.texture), "the texture unit begins only when it is done");
    }
}

fn state_what_instructions_are(m: Module, next: &Taken<Instruction>, needs: &Needs) {
    let state = |holds: Signal, message| m.assume(next.taken.implies(holds), message);
    state(next.length.ne(0) & next.length.le(LONGEST), "a word has 1 to 8 bytes");
    state(needs.expression | next.skip.eq(0), "only bytes of an expression are skipped");
    let end = up_to(2 * PixelProcessor::BYTES);
    let is_inside = |first: Signal| {
        let (first, length) = (first.zext(end), next.length.zext(end));
        mux(next.descends, (first + 1).ge(length), (first + length).le(PixelProcessor::BYTES))
    };
    state(is_inside(next.read) & is_inside(next.write), "a word is within the 384 bytes of a pixel");
    let Instruction { source, function, begin, condition, enabling, flagging, sync, .. } = **next;
    let fields = [source, function, begin, condition, enabling, flagging, sync];
    state(are_codes(&fields), "each field has a valid code");
}

/// Whether each of these fields has a valid code.
fn are_codes(fields: &[Signal]) -> Signal {
    fields.iter().fold(lit(1, 1), |all, field| all & field.is_code())
}

#[cfg(test)]
mod tests;
