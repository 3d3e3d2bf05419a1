//! The pixel processors of Pixel-planes 5 and PixelFlow, against plain words.

use crate::{Claim, claim, design};
use tilewright_hdl::*;
use tilewright_rtl::pixel_planes::pixel as serial;
use tilewright_rtl::pixelflow::pixel::{self as bytes, Control};

/// The bits of the words of the one-bit processor.
const WIDTH: u32 = 3;

block! {
    /// Stores a word, adds another one or keeps the lesser, and reads the result: a bit a clock.
    struct Serial { wrong: bool }
    in SerialIn { expression: bit() }
    out SerialOut { word: bit() }
}

impl Serial {
    fn build(&self, m: Module, i: SerialIn) -> SerialOut {
        // Two words and what is done with them, which start with any value and keep it.
        def!(old = m.reg(WIDTH));
        old.next(*old);
        def!(new = m.reg(WIDTH));
        new.next(*new);
        def!(adds = m.reg(bit()));
        adds.next(*adds);
        def!(place = m.reg(below(u64::from(WIDTH))).reset(0));
        def!(is_last = place.eq(u64::from(WIDTH - 1)));
        place.when(is_last, 0).otherwise(place + 1);
        def!(phase = m.reg(up_to(4)).reset(0));
        phase.when(is_last & phase.ne(4), phase + 1);
        let [stores, works, keeps] = [0, 1, 2].map(|number| phase.eq(number));
        let bit_of = |word: Signal| (word >> *place).bit(0);
        // Nothing but the bits of both words is asked of the tree.
        let asked = mux(stores, bit_of(*old), bit_of(*new));
        m.assume((stores | works | keeps).implies(i.expression.eq(asked)), "the tree gives the bits of the words");
        let mask = mux(
            stores | (works & *adds),
            serial::Mask::Everybody,
            mux(keeps & !*adds, serial::Mask::Flagged, serial::Mask::Nobody),
        );
        let address = place.zext(8);
        let control = serial::Control {
            source: Signal::of_code(serial::Source::Expression),
            constant: lit(1, 0),
            adds: works & *adds,
            first: place.eq(0),
            mask,
            compares: works & !*adds,
            gates: lit(1, 0),
            enabling: Signal::of_code(serial::Enabling::Keep),
            captures: lit(1, 0),
            read: address,
            write: address,
        };
        let input = serial::PixelProcessorIn { control, expression: i.expression };
        let word = m.instance("u_pixel", &serial::PixelProcessor, input).word;
        let expected = mux(*adds, *new + *old, mux(new.lt(*old), *new, *old));
        let expected = bit_of(expected) ^ lit(1, u64::from(self.wrong));
        m.assert(phase.eq(3).implies(word.eq(expected)), "the sum or the lesser word is stored");
        SerialOut { word }
    }
}

/// Whether a code is one of its kind.
fn is_any<C: Codes + Operand>(signal: Signal) -> Signal {
    C::ALL.iter().fold(lit(1, 0), |any, code| any | signal.is(*code))
}

block! {
    /// The 8-bit processor, whose words of 16 bits come in two clocks.
    struct Wide { wrong: bool }
    in WideIn { control: Control, expression: bits(8), word: bits(8) }
    out WideOut { result: bits(8) }
}

impl Wide {
    fn build(&self, m: Module, WideIn { control, expression, word }: WideIn) -> WideOut {
        use bytes::{Begin, Condition, Flagging, Function, Mask, Source};
        // A register is read and written, so that both are seen.
        let register = lit(9, 256);
        m.ignore(&[control.read, control.write]);
        let control = Control { read: register, write: register, ..control };
        let input = bytes::PixelProcessorIn { control, expression, register_byte: word };
        let found = m.instance("u_pixel", &bytes::PixelProcessor { depth: 2 }, input);
        let result = found.result;

        let from_tree = control.source.is(Source::Expression);
        let operand = mux(from_tree, expression, control.constant);
        m.assume(from_tree | control.source.is(Source::Constant), "the operand comes from outside");
        m.assume(is_any::<Function>(control.function) & is_any::<Begin>(control.begin), "the codes exist");
        let is = |function: Function| control.function.is(function);
        let (late_word, late_operand, late_result) = (m.past(word), m.past(operand), m.past(result));
        let whole = |high: Signal, low: Signal| cat![high, low];
        let (words, operands) = (whole(word, late_word), whole(operand, late_operand));
        let twice = |function: Function, begin: Begin| {
            m.past(control.function.is(function) & control.begin.is(begin))
                & is(function)
                & control.begin.is(Begin::Kept)
        };
        let sum = words + operands + lit(16, u64::from(self.wrong));
        let results = whole(result, late_result);
        m.assert(twice(Function::Add, Begin::Zero).implies(results.eq(sum)), "words are added");
        m.assert(twice(Function::Subtract, Begin::One).implies(results.eq(words - operands)), "words are subtracted");
        m.assert(twice(Function::ShiftLeft, Begin::Zero).implies(results.eq(words << 1u32)), "words shift to the left");
        let down = whole(late_word, word) >> 1u32;
        m.assert(
            twice(Function::ShiftRight, Begin::Zero).implies(whole(late_result, result).eq(down)),
            "words shift to the right",
        );
        m.assert(is(Function::And).implies(result.eq(word & operand)), "and");
        m.assert(is(Function::Or).implies(result.eq(word | operand)), "or");
        m.assert(is(Function::ExclusiveOr).implies(result.eq(word ^ operand)), "exclusive or");
        let mean = (word.zext(9) + operand.zext(9)) >> 1u32;
        let halves = is(Function::AddHalved) & control.begin.is(Begin::Zero);
        m.assert(halves.implies(result.eq(mean.trunc(8))), "a digit of a product is the halved sum");
        let compared = twice(Function::Compare, Begin::One)
            & control.condition.is(Condition::Carry)
            & control.flagging.is(Flagging::Condition);
        let writes = control.mask.is(Mask::Flagged) & control.stores;
        m.assert(
            (m.past(compared) & writes).implies(found.writes_register.eq(m.past(words.ge(operands)))),
            "the flag compares words",
        );
        WideOut { result }
    }
}

block! {
    /// The stack of enable flags, beside the conditions of all open ifs.
    struct Nested { wrong: bool }
    in NestedIn { enabling: one_of::<bytes::Enabling>(), condition: bit() }
    out NestedOut { enabled: bit() }
}

impl Nested {
    fn build(&self, m: Module, NestedIn { enabling, condition }: NestedIn) -> NestedOut {
        use bytes::Enabling::*;
        let zero = |width: u32| lit(width, 0);
        let control = Control {
            source: Signal::of_code(bytes::Source::Constant),
            constant: zero(8),
            function: Signal::of_code(bytes::Function::Operand),
            begin: Signal::of_code(bytes::Begin::Zero),
            mask: Signal::of_code(bytes::Mask::Enabled),
            accumulates: zero(1),
            stores: lit(1, 1),
            condition: Signal::of_code(bytes::Condition::Positive),
            enabling,
            by_sign: lit(1, 1),
            flagging: Signal::of_code(bytes::Flagging::Keep),
            read: lit(9, 256),
            write: lit(9, 256),
        };
        let input = bytes::PixelProcessorIn { control, expression: cat![!condition, zero(7)], register_byte: zero(8) };
        let found = m.instance("u_pixel", &bytes::PixelProcessor { depth: 3 }, input);
        m.ignore(&found.result);
        let enabled = found.writes_register;

        // The edges of the outermost level, and the conditions of two ifs in it.
        def!(level = m.reg(up_to(2)).reset(0));
        def!(begun = m.reg(bit()).reset(0));
        let is = |what: bytes::Enabling| enabling.is(what);
        m.assume(is_any::<bytes::Enabling>(enabling) & !is(Set), "the codes exist");
        m.assume((is(Restrict) | is(Push)).implies(*begun), "the first edge comes first");
        m.assume((is(Replace) | is(Restrict)).implies(level.eq(0)), "edges are tested outside of ifs");
        m.assume(is(Push).implies(level.ne(2)), "two ifs fit");
        m.assume((is(Invert) | is(Pop)).implies(level.ne(0)), "an else and an end follow an if");
        begun.when(is(Replace), 1);
        level.when(is(Push), level + 1).when(is(Pop), level - 1);
        let conditions = [0u64, 1, 2].map(|number| {
            let held = m.reg(&format!("condition{number}"), 1);
            held.when((is(Replace) & level.eq(number)) | (is(Push) & (level + 1).eq(number)), condition)
                .when(is(Restrict) & level.eq(number), held & condition)
                .when(is(Invert) & level.eq(number), !*held);
            let counts = if self.wrong { level.eq(number) } else { level.ge(number) };
            counts.implies(*held)
        });
        let all = conditions.into_iter().fold(lit(1, 1), |all, it| all & it);
        m.assert(
            begun.implies(enabled.eq(all)),
            "a pixel is enabled if and only if the conditions of all open ifs hold",
        );
        NestedOut { enabled }
    }
}

/// What is proved of pixel processors.
pub fn claims() -> Vec<Claim> {
    vec![
        claim(
            &["pixel-processor"],
            "Pixel-planes 5: one-bit processor, 3 bits",
            "a sum is stored bit by bit, and so is the lesser word",
            [3, 12],
            |wrong| design(&Serial { wrong }),
        ),
        claim(
            &["pixelflow-pixel"],
            "PixelFlow: 8-bit processor, words of 16 bits",
            "it adds, subtracts, shifts and compares words, and combines and halves bytes",
            [5, 3],
            |wrong| design(&Wide { wrong }),
        ),
        claim(
            &["pixelflow-pixel"],
            "PixelFlow: stack of 3 enable flags",
            "a pixel is enabled if and only if the conditions of all open ifs hold",
            [3, 5],
            |wrong| design(&Nested { wrong }),
        ),
    ]
}
