//! The entries of arithmetic blocks.

use crate::{
    BitOrder, Crc, CrcIn, Divider, DividerIn, Multiplier, MultiplierIn, MultiplyAccumulate, MultiplyAccumulateIn,
    Operands, Quantizer, QuantizerIn, Rotator, RotatorIn, Shifter, ShifterIn, Shifting, SineCosine, SquareRoot,
    StreamIn, Ties,
};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{Codes, DEFAULT_PERIOD, Scenario, Script, Stream, elaborate};

pub(super) const MULTIPLIER: Entry = Entry {
    name: "multiplier",
    summary: "multiplies two numbers in several stages",
    parameters: &[
        Parameter { name: "digits", default: 4, min: 4, max: 16, meaning: "bits of a factor in each stage" },
        Parameter { name: "stages", default: 2, min: 1, max: 16, meaning: "stages, and clocks of latency" },
    ],
    design: |values| Ok(elaborate(&multiplier(values))?),
    scenario: |values| Ok(some_products(&multiplier(values))),
};

pub(super) const MULTIPLY_ACCUMULATE: Entry = Entry {
    name: "multiply-accumulate",
    summary: "adds products to several sums",
    parameters: &[
        Parameter { name: "sums", default: 3, min: 2, max: 4096, meaning: "number of sums" },
        Parameter { name: "factor", default: 4, min: 4, max: 32, meaning: "bits of a factor" },
    ],
    design: |values| Ok(elaborate(&multiply_accumulate(values))?),
    scenario: |values| Ok(one_sum_and_two(&multiply_accumulate(values))),
};

pub(super) const ROTATOR: Entry = Entry {
    name: "rotator",
    summary: "rotates a word by any number of places",
    parameters: &[Parameter { name: "width", default: 8, min: 4, max: 64, meaning: "bits of a word" }],
    design: |values| Ok(elaborate(&rotator(values))?),
    scenario: |values| Ok(around(&rotator(values), values.get("width"))),
};

pub(super) const SHIFTER: Entry = Entry {
    name: "shifter",
    summary: "shifts a word by any number of places, in stages",
    parameters: &[Parameter { name: "width", default: 8, min: 4, max: 64, meaning: "bits of a word" }],
    design: |values| Ok(elaborate(&shifter(values))?),
    scenario: |values| Ok(every_kind(&shifter(values))),
};

pub(super) const QUANTIZER: Entry = Entry {
    name: "quantizer",
    summary: "rounds and saturates a number",
    parameters: &[
        Parameter { name: "places", default: 3, min: 1, max: 24, meaning: "bits below the unit, which go" },
        Parameter { name: "kept", default: 4, min: 2, max: 36, meaning: "bits that stay, of two more" },
    ],
    design: |values| Ok(elaborate(&quantizer(values))?),
    scenario: |values| Ok(halves_and_limits(&quantizer(values))),
};

pub(super) const DIVIDER: Entry = Entry {
    name: "divider",
    summary: "divides the numbers of a stream",
    parameters: &[Parameter { name: "width", default: 4, min: 4, max: 64, meaning: "bits of a number, and stages" }],
    design: |values| Ok(elaborate(&divider(values))?),
    scenario: |values| Ok(some_quotients(&divider(values), values.get("width"))),
};

pub(super) const SQUARE_ROOT: Entry = Entry {
    name: "square-root",
    summary: "computes the square roots of a stream",
    parameters: &[Parameter { name: "width", default: 3, min: 2, max: 32, meaning: "bits of a root, and stages" }],
    design: |values| Ok(elaborate(&square_root(values))?),
    scenario: |values| Ok(some_roots(&square_root(values), values.get("width"))),
};

pub(super) const SINE_COSINE: Entry = Entry {
    name: "sine-cosine",
    summary: "computes the cosine and the sine of the angles of a stream",
    parameters: &[Parameter { name: "width", default: 8, min: 4, max: 24, meaning: "bits of an angle, and stages" }],
    design: |values| Ok(elaborate(&sine_cosine(values))?),
    scenario: |values| Ok(the_quarters(&sine_cosine(values), values.get("width"))),
};

pub(super) const CRC: Entry = Entry {
    name: "crc",
    summary: "computes the Ethernet CRC-32 of a message",
    parameters: &[],
    design: |_| Ok(elaborate(&crc())?),
    scenario: |_| Ok(a_message(&crc())),
};

fn multiplier(values: &Values) -> Multiplier {
    let (digits, stages) = (values.get_u32("digits"), values.get_u32("stages"));
    Multiplier::new(digits * stages, stages)
}

fn some_products(multiplier: &Multiplier) -> Scenario {
    let mut script = Script::new(multiplier, DEFAULT_PERIOD);
    for (left, right) in [(3, 5), (15, 15), (7, 9)] {
        script.clock(&MultiplierIn { enable: 1, left, right });
    }
    script.hold(&MultiplierIn { enable: 0, left: 2, right: 2 }, 2);
    script.hold(&MultiplierIn { enable: 1, left: 0, right: 0 }, 4);
    script.finish("three products, one after another, with a pause in which all stages keep their values")
}

fn multiply_accumulate(values: &Values) -> MultiplyAccumulate {
    let factor = values.get_u32("factor");
    MultiplyAccumulate::new(values.get_u32("sums"), factor, 2 * factor + 4)
}

fn one_sum_and_two(accumulate: &MultiplyAccumulate) -> Scenario {
    let mut script = Script::new(accumulate, DEFAULT_PERIOD);
    let term = |to, restart, left, right| MultiplyAccumulateIn { valid: 1, to, restart, left, right };
    for (restart, left) in [(1, 1), (0, 2), (0, 3)] {
        script.clock(&term(0, restart, left, 10));
    }
    for (to, restart, left) in [(1, 1, 15), (0, 0, 4), (1, 0, 15)] {
        script.clock(&term(to, restart, left, 10));
    }
    script.hold(&MultiplyAccumulateIn { valid: 0, to: 0, restart: 0, left: 0, right: 0 }, 3);
    script.finish("three products are added to one sum, and then products to two sums alternately")
}

fn rotator(values: &Values) -> Rotator {
    Rotator::new(values.get_u32("width"))
}

fn around(rotator: &Rotator, width: u64) -> Scenario {
    let mut script = Script::new(rotator, DEFAULT_PERIOD);
    for places in 0..width {
        script.clock(&RotatorIn { enable: 1, word: 0b1101, places });
    }
    script.hold(&RotatorIn { enable: 0, word: 0, places: 0 }, 2);
    script.finish("13 is rotated by 0 places, by 1, and so on, once around; then the last result stays")
}

fn shifter(values: &Values) -> Shifter {
    Shifter::new(values.get_u32("width"))
}

fn every_kind(shifter: &Shifter) -> Scenario {
    let mut script = Script::new(shifter, DEFAULT_PERIOD);
    for kind in Shifting::ALL {
        for places in 0..4 {
            script.clock(&ShifterIn { enable: 1, word: 9, places, kind: kind.code() });
        }
    }
    script.hold(&ShifterIn { enable: 1, word: 0, places: 0, kind: 0 }, 6);
    script.finish("9 is shifted to the left, to the right, and to the right with its sign, each by 0 to 3 places")
}

fn quantizer(values: &Values) -> Quantizer {
    let (places, kept) = (values.get_u32("places"), values.get_u32("kept"));
    Quantizer { width: places + kept + 2, places, kept, ties: Ties::Even }
}

fn halves_and_limits(quantizer: &Quantizer) -> Scenario {
    let mut script = Script::new(quantizer, DEFAULT_PERIOD);
    let half = 1i64 << (quantizer.places - 1);
    let limit = 1i64 << (quantizer.width - 1);
    let all = u64::MAX >> (64 - quantizer.width);
    for number in [half, 3 * half, -half, -3 * half, 3 * half + 1, limit - 1, -limit] {
        script.clock(&QuantizerIn { enable: 1, number: number as u64 & all });
    }
    script.hold(&QuantizerIn { enable: 0, number: 0 }, 2);
    script
        .finish("0.5, 1.5, -0.5, -1.5, a little more than 1.5, the greatest number and the least; then the last stays")
}

fn divider(values: &Values) -> Divider {
    Divider::new(values.get_u32("width"))
}

fn some_quotients(divider: &Divider, clocks: u64) -> Scenario {
    let mut script = Script::new(divider, DEFAULT_PERIOD);
    let operands = |valid, dividend, divisor| DividerIn { operands: Stream::of(valid, Operands { dividend, divisor }) };
    script.ready("results", true);
    for (dividend, divisor) in [(14, 4), (15, 1), (9, 0), (3, 7)] {
        script.clock(&operands(1, dividend, divisor));
    }
    script.hold(&operands(0, 0, 0), clocks + 2);
    script.finish("four divisions, one after another, the third by 0")
}

fn square_root(values: &Values) -> SquareRoot {
    SquareRoot::new(values.get_u32("width"))
}

/// Sends these words one after another, and then nothing until all have passed.
fn each<B: tilewright_hdl::Block<In = StreamIn>>(script: &mut Script<B>, words: [u64; 4], clocks: u64) {
    for word in words {
        script.clock(&StreamIn { into: Stream::of(1, word) });
    }
    script.hold(&StreamIn { into: Stream::of(0, 0) }, clocks + 2);
}

fn some_roots(root: &SquareRoot, clocks: u64) -> Scenario {
    let mut script = Script::new(root, DEFAULT_PERIOD);
    script.ready("roots", true);
    each(&mut script, [0, 9, 10, 15], clocks);
    script.finish("the roots of 0, 9, 10 and 15, one after another")
}

fn sine_cosine(values: &Values) -> SineCosine {
    SineCosine::new(values.get_u32("width"))
}

fn the_quarters(sine: &SineCosine, width: u64) -> Scenario {
    let mut script = Script::new(sine, DEFAULT_PERIOD);
    script.ready("points", true);
    each(&mut script, [0, 1, 2, 3].map(|quarter| quarter << (width - 2)), width);
    script.finish("east, north, west and south, one after another")
}

fn crc() -> Crc {
    Crc::new(32, 0x04c1_1db7, 0xffff_ffff, BitOrder::LeastFirst)
}

fn a_message(crc: &Crc) -> Scenario {
    let mut script = Script::new(crc, DEFAULT_PERIOD);
    for byte in b"123456789" {
        script.clock(&CrcIn { restart: 0, take: 1, data: u64::from(*byte) });
    }
    script.hold(&CrcIn { restart: 0, take: 0, data: 0 }, 2);
    script.clock(&CrcIn { restart: 1, take: 0, data: 0 });
    script.wait(1);
    script.finish("the digits from 1 to 9, whose check is the complement of cbf43926; then the next message begins")
}
