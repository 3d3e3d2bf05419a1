//! Arithmetic against plain operators. The mutants expect a result with its lowest bit inverted.

use crate::{Claim, claim, design};
use tilewright_blocks::*;
use tilewright_hdl::*;

/// A value in a pipeline of `clocks` stages beside the block's, and whether it has passed all of them.
fn late(m: Module, enable: Signal, clocks: u32, value: Signal) -> (Signal, Signal) {
    let stage = |(value, valid): (Signal, Signal), stage: u32| {
        let held = m.reg(&format!("late{stage}"), value.width());
        held.when(enable, value);
        let known = m.reg(&format!("known{stage}"), 1).reset(0);
        known.when(enable, valid);
        (*held, *known)
    };
    (0..clocks).fold((value, lit(1, 1)), stage)
}

/// States that a result is the expected one once the pipeline is full.
fn state(m: Module, (expected, known): (Signal, Signal), result: Signal, wrong: bool) {
    let expected = expected ^ lit(expected.width(), u64::from(wrong));
    m.assert(known.implies(result.eq(expected)), "the result is the operator's");
}

/// The next operands come when the result of those before is taken.
fn one_at_a_time(m: Module, sent: Signal, taken: Signal) {
    def!(works = m.reg(1).reset(0));
    works.when(taken, 0).when(sent, 1);
    m.assume(sent.implies(!works), "one calculation is on the way");
}

/// A block in a pipeline, or without one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Operator {
    Product,
    Shift,
    Rotation,
    Ones,
    Least,
    Decimal,
}

block! {
    /// An operator on a word and a smaller one.
    struct Operated { operator: Operator, wrong: bool }
    in OperatedIn { enable: bit(), word: bits(8), places: bits(3), left: bit() }
    out OperatedOut { result: bits(8) }
}

impl Operated {
    fn build(&self, m: Module, OperatedIn { enable, word, places, left }: OperatedIn) -> OperatedOut {
        let (low, high) = (word.part(0, 4), word.part(4, 4));
        let (expected, result) = match self.operator {
            Operator::Product => {
                let product =
                    m.instance("u_operator", &Multiplier::new(4, 2), MultiplierIn { enable, left: low, right: high });
                (late(m, enable, 2, low * high), product.product)
            }
            Operator::Shift => {
                let kind = mux(left, Shifting::Left, Shifting::Arithmetic);
                let input = ShifterIn { enable, word, places, kind };
                let expected = mux(left, word << places, (word.signed() >> places).bits());
                (late(m, enable, 3, expected), m.instance("u_operator", &Shifter::new(8), input).shifted)
            }
            Operator::Rotation => {
                let input = RotatorIn { enable, word, places };
                let expected = ((cat![word, word]) << places).part(8, 8);
                (late(m, enable, 1, expected), m.instance("u_operator", &Rotator::new(8), input).rotated)
            }
            Operator::Ones => {
                let ones = (0..8u32).fold(lit(8, 0), |sum, bit| sum + word.bit(bit).zext(8));
                let found = m.instance("u_operator", &CountOnes { width: 8 }, CountOnesIn { word }).ones;
                ((ones, lit(1, 1)), found.zext(8))
            }
            Operator::Least => {
                let words = stack([low, high, low ^ high]);
                let least = |a: Signal, b: Signal| mux(a.lt(b), a, b);
                let found = m.instance("u_operator", &Minimum::new(3, 4), MinimumIn { words });
                m.ignore(&found.index);
                ((least(least(low, high), low ^ high).zext(8), lit(1, 1)), found.word.zext(8))
            }
            Operator::Decimal => {
                m.assume(low.lt(10) & high.lt(10), "each digit is below ten");
                let digits = stack([low, high]);
                let expected = (high * lit(4, 10)) + low.zext(8);
                let found = m.instance("u_operator", &FromDecimal::new(2), FromDecimalIn { enable, digits });
                (late(m, enable, 1, expected), found.number.zext(8))
            }
        };
        state(m, expected, result, self.wrong);
        m.ignore(&[enable, places, left]);
        OperatedOut { result }
    }
}

block! {
    /// A division whose operands are remembered.
    struct Divided { wrong: bool }
    in DividedIn { offers: bit(), dividend: bits(3), divisor: bits(3), takes: bit() }
    out DividedOut { taken: bit() }
}

impl Divided {
    fn build(&self, m: Module, i: DividedIn) -> DividedOut {
        let (operands, sent) = m.offer(i.offers, Operands { dividend: i.dividend, divisor: i.divisor });
        let found = m.instance("u_divider", &Divider::new(3), DividerIn { operands }).results.take_when(i.takes);
        def!(of = m.reg(3));
        def!(by = m.reg(3));
        one_at_a_time(m, sent, found.taken);
        of.when(sent, i.dividend);
        by.when(sent, i.divisor);
        let whole = (found.quotient * *by) + found.remainder.zext(6);
        let is_known = found.taken & by.ne(0);
        state(m, (of.zext(6), is_known), whole, self.wrong);
        m.assert(is_known.implies(found.remainder.lt(by)), "the remainder is less than the divisor");
        DividedOut { taken: found.taken }
    }
}

block! {
    /// A square root whose operand is remembered.
    struct Rooted { wrong: bool }
    in RootedIn { offers: bit(), word: bits(4), takes: bit() }
    out RootedOut { taken: bit() }
}

impl Rooted {
    fn build(&self, m: Module, i: RootedIn) -> RootedOut {
        let (into, sent) = m.offer(i.offers, i.word);
        let found = m.instance("u_root", &SquareRoot::new(2), StreamIn { into }).roots.take_when(i.takes);
        def!(of = m.reg(4));
        one_at_a_time(m, sent, found.taken);
        of.when(sent, i.word);
        let whole = (found.root * found.root) + found.remainder.zext(4);
        state(m, (*of, found.taken), whole, self.wrong);
        let twice = cat![found.root, lit(1, 0)];
        m.assert(found.taken.implies(found.remainder.le(twice)), "no greater root fits");
        RootedOut { taken: found.taken }
    }
}

block! {
    /// Three checks, of two messages and of their sum without carries.
    struct Linear { order: BitOrder, wrong: bool }
    in LinearIn { restart: bit(), take: bit(), left: bits(8), right: bits(8) }
    out LinearOut { same: bit() }
}

impl Linear {
    fn build(&self, m: Module, LinearIn { restart, take, left, right }: LinearIn) -> LinearOut {
        let crc = Crc::new(16, 0x1021, u64::from(self.wrong), self.order);
        let check = |name: &str, data: Signal| m.instance(name, &crc, CrcIn { restart, take, data }).crc;
        let [left, right, both] =
            [("u_left", left), ("u_right", right), ("u_both", left ^ right)].map(|(name, data)| check(name, data));
        def!(same = both.eq(left ^ right));
        m.assert(same, "the check of a sum is the sum of the checks");
        LinearOut { same }
    }
}

block! {
    /// The least of four words, in a pipeline.
    struct Pipelined { wrong: bool }
    in PipelinedIn { valid: bit(), words: bits(4).of(row(4)) }
    out PipelinedOut { word: bits(4) }
}

impl Pipelined {
    fn build(&self, m: Module, PipelinedIn { valid, words }: PipelinedIn) -> PipelinedOut {
        let found = m.instance("u_minimum", &PipelinedMinimum::new(4, 4), PipelinedMinimumIn { valid, words });
        m.ignore(&found.index);
        let least = words.to_vec().into_iter().reduce(|a, b| mux(a.lt(b), a, b)).unwrap();
        let two_clocks = |signal: Signal| m.past(m.past(signal));
        m.assert(two_clocks(valid).implies(found.found), "what enters is found two clocks later");
        m.assert(
            found.found.implies(found.word.eq(two_clocks(least) ^ lit(4, u64::from(self.wrong)))),
            "it is the least",
        );
        PipelinedOut { word: found.word }
    }
}

block! {
    /// A counter, beside the number that is expected.
    struct Counted { wrong: bool }
    in CountedIn { restart: bit(), enable: bit() }
    out CountedOut { count: bits(3) }
}

impl Counted {
    fn build(&self, m: Module, CountedIn { restart, enable }: CountedIn) -> CountedOut {
        let CounterOut { count, wraps } = m.instance("u_counter", &Counter::new(5), CounterIn { restart, enable });
        let next = mux(count.eq(4), 0, count + 1);
        m.assert(m.past(enable & !restart).implies(count.eq(m.past(next))), "each number follows the one before");
        m.assert(m.past(!enable & !restart).implies(m.stable(count)), "it waits for an enable");
        m.assert(count.le(if self.wrong { 3 } else { 4 }), "there are five numbers");
        m.ignore(&wraps);
        CountedOut { count }
    }
}

block! {
    /// One-hot codes there and back, and the first of several requests.
    struct Encoded { wrong: bool }
    in EncodedIn { requests: bits(5) }
    out EncodedOut { index: bits(3) }
}

impl Encoded {
    fn build(&self, m: Module, EncodedIn { requests }: EncodedIn) -> EncodedOut {
        let PriorityEncoderOut { first, index, any } =
            m.instance("u_priority", &PriorityEncoder::new(5), PriorityEncoderIn { requests });
        let one_hot = m.instance("u_decoder", &Decoder::new(5), DecoderIn { index }).one_hot;
        let again = m.instance("u_encoder", &Encoder::new(5), EncoderIn { one_hot }).index;
        m.assert(first.eq(requests & (lit(5, 0) - requests)), "the first is the lowest one");
        m.assert(any.eq(requests.ne(0)), "there is one if any bit is one");
        m.assert(any.implies(one_hot.eq(first)), "its index decodes to it");
        m.assert(again.eq(index + lit(3, u64::from(self.wrong))), "what is decoded encodes to the same");
        EncodedOut { index }
    }
}

/// What is proved of arithmetic.
pub fn claims() -> Vec<Claim> {
    let crc = "the check of a sum is the sum of the checks";
    vec![
        claim(&["multiplier"], "multiplier, 4 bits, 2 stages", "the product is `left * right`", [3; 2], |wrong| {
            operated(Operator::Product, wrong)
        }),
        claim(&["shifter"], "shifter, 8 bits", "a word is shifted as by `<<` and `>>`", [4; 2], |wrong| {
            operated(Operator::Shift, wrong)
        }),
        claim(&["rotator"], "rotator, 8 bits", "no bit is lost in a rotation", [3; 2], |wrong| {
            operated(Operator::Rotation, wrong)
        }),
        claim(&["count-ones"], "count of ones, 8 bits", "it is the sum of all bits", [3; 2], |wrong| {
            operated(Operator::Ones, wrong)
        }),
        claim(&["minimum"], "minimum, 3 words of 4 bits", "no word is less, and it is one of them", [3; 2], |wrong| {
            operated(Operator::Least, wrong)
        }),
        claim(
            &["from-decimal"],
            "from decimal, 2 digits",
            "it is ten times the first digit, and the second",
            [3; 2],
            |wrong| operated(Operator::Decimal, wrong),
        ),
        claim(
            &["pipelined-minimum"],
            "pipelined minimum, 4 words of 4 bits",
            "two clocks later it is the least",
            [4; 2],
            |wrong| design(&Pipelined { wrong }),
        ),
        claim(&["counter"], "counter to 5", "each number follows the one before", [6; 2], |wrong| {
            design(&Counted { wrong })
        }),
        claim(&["divider"], "divider, 3 bits", "quotient * divisor + remainder is the dividend", [5; 2], |wrong| {
            design(&Divided { wrong })
        }),
        claim(
            &["square-root"],
            "square root, 4 bits",
            "root * root + remainder is the word, and no greater root fits",
            [5; 2],
            |wrong| design(&Rooted { wrong }),
        ),
        claim(&["crc"], "CRC of 16 bits, most significant first", crc, [3; 2], |wrong| {
            design(&Linear { order: BitOrder::MostFirst, wrong })
        }),
        claim(&["crc"], "CRC of 16 bits, least significant first", crc, [3; 2], |wrong| {
            design(&Linear { order: BitOrder::LeastFirst, wrong })
        }),
        claim(
            &["encoder", "decoder", "priority-encoder"],
            "encoder, decoder, priority encoder, 5 lines",
            "each undoes the other, and the first is the lowest",
            [2; 2],
            |wrong| design(&Encoded { wrong }),
        ),
    ]
}

fn operated(operator: Operator, wrong: bool) -> Design {
    design(&Operated { operator, wrong })
}
