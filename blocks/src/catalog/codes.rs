//! The entries of codes and digits.

use crate::{
    CountOnes, CountOnesIn, Decoder, DecoderIn, Encoder, EncoderIn, FromDecimal, FromDecimalIn, PriorityEncoder,
    PriorityEncoderIn, SevenSegment, SevenSegmentIn,
};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{DEFAULT_PERIOD, Scenario, Script, elaborate};

const LINES: Parameter = Parameter { name: "lines", default: 5, min: 2, max: 64, meaning: "number of lines" };

pub(super) const DECODER: Entry = Entry {
    name: "decoder",
    summary: "converts a number to a one-hot code",
    parameters: &[LINES],
    design: |values| Ok(elaborate(&decoder(values))?),
    scenario: |values| Ok(every_number(&decoder(values), values.get("lines"))),
};

pub(super) const ENCODER: Entry = Entry {
    name: "encoder",
    summary: "converts a one-hot code to a number",
    parameters: &[LINES],
    design: |values| Ok(elaborate(&encoder(values))?),
    scenario: |values| Ok(every_line(&encoder(values), values.get("lines"))),
};

pub(super) const PRIORITY_ENCODER: Entry = Entry {
    name: "priority-encoder",
    summary: "finds the first line that is high",
    parameters: &[LINES],
    design: |values| Ok(elaborate(&priority_encoder(values))?),
    scenario: |values| Ok(more_and_more(&priority_encoder(values), values.get("lines"))),
};

pub(super) const COUNT_ONES: Entry = Entry {
    name: "count-ones",
    summary: "counts the ones in a word",
    parameters: &[Parameter { name: "lines", default: 5, min: 1, max: 64, meaning: "bits of the word" }],
    design: |values| Ok(elaborate(&count_ones(values))?),
    scenario: |values| Ok(one_more_each(&count_ones(values))),
};

pub(super) const SEVEN_SEGMENT: Entry = Entry {
    name: "seven-segment",
    summary: "shows a digit in seven segments",
    parameters: &[],
    design: |_| Ok(elaborate(&SevenSegment)?),
    scenario: |_| Ok(every_digit()),
};

pub(super) const FROM_DECIMAL: Entry = Entry {
    name: "from-decimal",
    summary: "converts decimal digits to a number",
    parameters: &[Parameter { name: "digits", default: 3, min: 1, max: 16, meaning: "number of digits" }],
    design: |values| Ok(elaborate(&from_decimal(values))?),
    scenario: |values| Ok(some_numbers(&from_decimal(values), values.get_u32("digits"))),
};

fn decoder(values: &Values) -> Decoder {
    Decoder::new(values.get_u32("lines"))
}

fn every_number(decoder: &Decoder, lines: u64) -> Scenario {
    let mut script = Script::new(decoder, DEFAULT_PERIOD);
    for index in 0..lines {
        script.clock(&DecoderIn { index });
    }
    script.finish("the number of each line, one after another")
}

fn encoder(values: &Values) -> Encoder {
    Encoder::new(values.get_u32("lines"))
}

fn every_line(encoder: &Encoder, lines: u64) -> Scenario {
    let mut script = Script::new(encoder, DEFAULT_PERIOD);
    for line in 0..lines {
        script.clock(&EncoderIn { one_hot: 1 << line });
    }
    script.clock(&EncoderIn { one_hot: 0 });
    script.finish("each line is high by itself, and then none")
}

fn priority_encoder(values: &Values) -> PriorityEncoder {
    PriorityEncoder::new(values.get_u32("lines"))
}

fn more_and_more(encoder: &PriorityEncoder, lines: u64) -> Scenario {
    let mut script = Script::new(encoder, DEFAULT_PERIOD);
    script.clock(&PriorityEncoderIn { requests: 0 });
    for line in (0..lines).rev() {
        let from_there_on = (u64::MAX >> (64 - lines)) >> line << line;
        script.clock(&PriorityEncoderIn { requests: from_there_on });
    }
    script.finish("the last line is high, and then more and more lines before it")
}

fn count_ones(values: &Values) -> CountOnes {
    CountOnes { width: values.get_u32("lines") }
}

fn one_more_each(count: &CountOnes) -> Scenario {
    let mut script = Script::new(count, DEFAULT_PERIOD);
    for ones in 0..=count.width {
        // Every second place first.
        let places = (0..count.width).step_by(2).chain((1..count.width).step_by(2)).take(ones as usize);
        script.clock(&CountOnesIn { word: places.map(|place| 1 << place).sum() });
    }
    script.finish("words with no one, with one, and so on; the last one has only ones")
}

fn every_digit() -> Scenario {
    let mut script = Script::new(&SevenSegment, DEFAULT_PERIOD);
    for digit in 0..16 {
        script.clock(&SevenSegmentIn { digit });
    }
    script.wait(1);
    script.finish("the digits from 0 to f, one after another")
}

fn from_decimal(values: &Values) -> FromDecimal {
    FromDecimal::new(values.get_u32("digits"))
}

fn some_numbers(decimal: &FromDecimal, digits: u32) -> Scenario {
    let mut script = Script::new(decimal, DEFAULT_PERIOD);
    let all = u64::MAX >> (64 - 4 * digits);
    for number in [0x9876_5432_1012_3456, 0x9999_9999_9999_9999, 1] {
        script.clock(&FromDecimalIn { enable: 1, digits: number & all });
    }
    script.hold(&FromDecimalIn { enable: 0, digits: 5 }, 2);
    script.finish("three numbers, the second with all digits 9; then the last result stays")
}
