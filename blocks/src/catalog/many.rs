//! The entries of blocks that work on many numbers at once.

use crate::{BoxFilter, BoxFilterIn, Minimum, MinimumIn, PipelinedMinimum, PipelinedMinimumIn};
use tilewright_hdl::catalog::{Entry, Parameter, Values};
use tilewright_hdl::{DEFAULT_PERIOD, Scenario, Script, elaborate};

const NUMBERS: &[Parameter] = &[
    Parameter { name: "words", default: 5, min: 2, max: 64, meaning: "how many numbers are compared" },
    Parameter { name: "width", default: 4, min: 4, max: 64, meaning: "bits of a number" },
];

pub(super) const MINIMUM: Entry = Entry {
    name: "minimum",
    summary: "finds the least of many numbers",
    parameters: NUMBERS,
    design: |values| Ok(elaborate(&minimum(values))?),
    scenario: |values| Ok(some_lists(&minimum(values), list(values))),
};

pub(super) const PIPELINED_MINIMUM: Entry = Entry {
    name: "pipelined-minimum",
    summary: "finds the least of many numbers, with a register behind each comparison",
    parameters: NUMBERS,
    design: |values| Ok(elaborate(&pipelined_minimum(values))?),
    scenario: |values| Ok(lists_and_a_pause(&pipelined_minimum(values), list(values))),
};

pub(super) const BOX_FILTER: Entry = Entry {
    name: "box-filter",
    summary: "sums the three by three cells around each cell of a grid",
    parameters: &[
        Parameter { name: "rows", default: 2, min: 2, max: 64, meaning: "rows of the grid" },
        Parameter { name: "columns", default: 4, min: 2, max: 64, meaning: "columns of the grid" },
        Parameter { name: "width", default: 4, min: 4, max: 32, meaning: "bits of a cell" },
    ],
    design: |values| Ok(elaborate(&box_filter(values))?),
    scenario: |values| Ok(corners_and_all(&box_filter(values), values)),
};

/// Packs numbers of up to 15 into a word, the first one lowest. Numbers that do not fit into 64 bits are 0.
fn list(values: &Values) -> impl Fn(&[u64]) -> u64 {
    let (words, width) = (values.get_u32("words"), values.get_u32("width"));
    move |numbers| {
        (0..words.min(64 / width)).zip(numbers.iter().cycle()).map(|(lane, number)| number << (lane * width)).sum()
    }
}

/// Lists whose least number is the first, the last, and both.
const LISTS: [&[u64]; 3] = [&[3, 5, 9, 7, 15], &[9, 8, 7, 6, 5], &[4, 15, 6, 8, 4]];

fn minimum(values: &Values) -> Minimum {
    Minimum::new(values.get_u32("words"), values.get_u32("width"))
}

fn some_lists(minimum: &Minimum, list: impl Fn(&[u64]) -> u64) -> Scenario {
    let mut script = Script::new(minimum, DEFAULT_PERIOD);
    for numbers in LISTS {
        script.clock(&MinimumIn { words: list(numbers) });
    }
    script.finish("three lists, whose least number is the first, the last, and both of them")
}

fn pipelined_minimum(values: &Values) -> PipelinedMinimum {
    PipelinedMinimum::new(values.get_u32("words"), values.get_u32("width"))
}

fn lists_and_a_pause(minimum: &PipelinedMinimum, list: impl Fn(&[u64]) -> u64) -> Scenario {
    let mut script = Script::new(minimum, DEFAULT_PERIOD);
    for numbers in LISTS {
        script.clock(&PipelinedMinimumIn { valid: 1, words: list(numbers) });
    }
    script.clock(&PipelinedMinimumIn { valid: 0, words: 0 });
    script.clock(&PipelinedMinimumIn { valid: 1, words: list(LISTS[0]) });
    script.hold(&PipelinedMinimumIn { valid: 0, words: 0 }, 7);
    script.finish("three lists, one after another, and the first once more after a pause")
}

fn box_filter(values: &Values) -> BoxFilter {
    BoxFilter::new(values.get_u32("rows"), values.get_u32("columns"), values.get_u32("width"))
}

fn corners_and_all(filter: &BoxFilter, values: &Values) -> Scenario {
    let mut script = Script::new(filter, DEFAULT_PERIOD);
    let width = values.get("width");
    let cells = values.get("rows") * values.get("columns");
    let ones = (0..cells.min(64 / width)).map(|cell| 1 << (cell * width)).sum();
    for cells in [1, 2 << width, ones] {
        script.clock(&BoxFilterIn { enable: 1, cells });
    }
    script.hold(&BoxFilterIn { enable: 0, cells: 0 }, 2);
    script.finish("a cell in the corner, one beside it, and one in each of the first places; then the last sums stay")
}
