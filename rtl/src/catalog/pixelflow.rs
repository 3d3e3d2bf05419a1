//! The entries of PixelFlow's node and its parts.

use tilewright_hdl::{Bits, Codes, Scenario, Script, Stream, elaborate_at};

use super::shared::idle;
use super::{Entry, Parameter, Values};
use crate::parameter::ParameterError;
use crate::pixelflow::compositor::{Compositor, CompositorIn, Mode};
use crate::pixelflow::controller::{ArrayController, ArrayControllerIn};
use crate::pixelflow::instruction::{Instruction, Sync};
use crate::pixelflow::linear_evaluator::{Coefficients, LinearEvaluator, LinearEvaluatorIn};
use crate::pixelflow::network_port::{NetworkPort, NetworkPortIn, Transfer};
use crate::pixelflow::pixel::{
    Begin, Condition, Control, Enabling, Flagging, Function, Mask, PixelProcessor, PixelProcessorIn, Source,
};
use crate::pixelflow::{ARRAY, TRANSFER, extents};

const WIDTH: Parameter =
    Parameter { name: "width", default: 8, min: 2, max: 256, meaning: "pixels in a line of a region, a power of two" };
const HEIGHT: Parameter =
    Parameter { name: "height", default: 4, min: 2, max: 256, meaning: "lines of a region, a power of two" };
const CHIPS: Parameter = Parameter { name: "chips", default: 2, min: 1, max: 64, meaning: "chips of the node" };
const DEPTH: Parameter = Parameter {
    name: "depth",
    default: PixelProcessor::DEPTH as u64,
    min: 2,
    max: 32,
    meaning: "enable flags of a pixel, one in another",
};
const PIXELS: Parameter = Parameter { name: "pixels", default: 4, min: 1, max: 1024, meaning: "pixels of a chip" };

/// The bits of a byte.
const BYTE: u32 = 8;

pub(super) const NETWORK_PORT: Entry = Entry {
    name: "network-port",
    summary: "connects a node to the network that composes images",
    parameters: &[CHIPS, PIXELS],
    design: |values| Ok(elaborate_at(&network_port(values), TRANSFER)?),
    scenario: |values| Ok(composed_and_unloaded(&network_port(values))),
};

pub(super) const COMPOSITOR: Entry = Entry {
    name: "compositor",
    summary: "sends on the lesser of two words of each pixel, byte by byte",
    parameters: &[PIXELS],
    design: |values| Ok(elaborate_at(&compositor(values), TRANSFER)?),
    scenario: |values| Ok(two_bytes(&compositor(values))),
};

pub(super) const ARRAY_CONTROLLER: Entry = Entry {
    name: "array-controller",
    summary: "takes instructions, and controls the linear evaluator and all pixels",
    parameters: &[WIDTH, HEIGHT],
    design: |values| Ok(elaborate_at(&controller(values)?, ARRAY.period)?),
    scenario: |values| Ok(drawn_and_given(&controller(values)?)),
};

pub(super) const LINEAR_EVALUATOR: Entry = Entry {
    name: "linear-evaluator",
    summary: "evaluates A x + B y + C at all pixels, a byte a clock",
    parameters: &[WIDTH, HEIGHT],
    design: |values| Ok(elaborate_at(&linear_evaluator(values)?, ARRAY.period)?),
    scenario: |values| Ok(two_expressions(&linear_evaluator(values)?)),
};

pub(super) const PIXEL: Entry = Entry {
    name: "pixelflow-pixel",
    summary: "an ALU of 8 bits, enable flags and 256 bytes of memory",
    parameters: &[DEPTH],
    design: |values| Ok(elaborate_at(&pixel(values), ARRAY.period)?),
    scenario: |values| Ok(add_compare_and_copy(&pixel(values))),
};

fn controller(values: &Values) -> Result<ArrayController, ParameterError> {
    let [width, height] = extents(values.get_u32("width"), values.get_u32("height"))?;
    Ok(ArrayController { width, height })
}

fn linear_evaluator(values: &Values) -> Result<LinearEvaluator, ParameterError> {
    let [width, height] = extents(values.get_u32("width"), values.get_u32("height"))?;
    Ok(LinearEvaluator { width, height })
}

fn pixel(values: &Values) -> PixelProcessor {
    PixelProcessor { depth: values.get_u32("depth") }
}

fn network_port(values: &Values) -> NetworkPort {
    NetworkPort { chips: values.get_u32("chips"), pixels: values.get_u32("pixels"), width: BYTE }
}

fn compositor(values: &Values) -> Compositor {
    Compositor { pixels: values.get_u32("pixels"), width: BYTE }
}

/// Words of two bytes, of upstream and of the node, which pixels have in turn: the first is less than the other, then its second
/// byte is more, then they are equal.
const WORDS: [[[u64; 2]; 2]; 3] =
    [[[0x10, 0x99], [0x20, 0x11]], [[0x30, 0x55], [0x30, 0x44]], [[0x40, 0x40], [0x40, 0x40]]];

/// The bytes of all pixels as they come: whether it is the first of its word, the pixel, the bytes of upstream and of the node.
fn bytes(pixels: u32) -> impl Iterator<Item = (u64, u64, [u64; 2])> {
    let byte = move |number: usize| {
        (0..u64::from(pixels)).map(move |pixel| {
            let words = WORDS[pixel as usize % WORDS.len()];
            (u64::from(number == 0), pixel, words.map(|word| word[number]))
        })
    };
    (0..2).flat_map(byte)
}

fn two_bytes(compositor: &Compositor) -> Scenario {
    let mut script = Script::new(compositor, TRANSFER);
    let mode = Mode::Composite.code();
    for (first, pixel, [upstream, own]) in bytes(compositor.pixels) {
        script.clock(&CompositorIn { mode, advances: 1, first, pixel, upstream, own });
    }
    script.wait(1);
    script.finish("words of two bytes: of three pixels the first is less, then the node's own, then they are equal")
}

fn composed_and_unloaded(port: &NetworkPort) -> Scenario {
    let mut script = Script::new(port, TRANSFER);
    for mode in [Mode::Composite, Mode::Unload, Mode::Load] {
        for (first, _, [upstream, own]) in bytes(port.pixels) {
            let comes = u64::from(mode != Mode::Load);
            script.clock_bits(&NetworkPortIn {
                mode: Bits::new(2, mode.code()),
                sends: Bits::new(1, 1 - comes),
                first: Bits::new(1, (1 - comes) & first),
                upstream: Transfer {
                    valid: Bits::new(1, comes),
                    first: Bits::new(1, comes & first),
                    bytes: in_each_chip(port, upstream),
                },
                own: in_each_chip(port, own),
            });
        }
    }
    script.clock_bits(&idle(port));
    script
        .finish("words of two bytes come and are composed with the node's, then it takes others, then it sends its own")
}

fn in_each_chip(port: &NetworkPort, byte: u64) -> Bits {
    let byte = Bits::new(BYTE, byte);
    (1..port.chips).fold(byte.clone(), |bytes, _| bytes.concat(&byte))
}

/// A byte of depth inside an edge, in the bank that the network has next.
fn depth_inside_an_edge() -> [Instruction<u64>; 4] {
    let (source, everybody) = (Source::Expression.code(), Mask::Everybody.code());
    let fill = Instruction { mask: everybody, stores: 1, length: 2, write: 256, c: 0xffff, ..Instruction::NOTHING };
    let edge = Instruction {
        source,
        condition: Condition::Positive.code(),
        enabling: Enabling::Replace.code(),
        skip: 1,
        a: 1,
        c: (1 << 40) - 3,
        ..Instruction::NOTHING
    };
    let mask = Mask::Enabled.code();
    let depth = Instruction {
        source,
        mask,
        stores: 1,
        skip: 1,
        length: 2,
        write: 256,
        a: 0x180,
        b: 0x2000,
        ..Instruction::NOTHING
    };
    let give = Instruction { sync: Sync::GiveBank.code(), ..Instruction::NOTHING };
    [fill, edge, depth, give]
}

fn drawn_and_given(controller: &ArrayController) -> Scenario {
    let inputs = |valid, instruction, bank_done| ArrayControllerIn {
        instructions: Stream::of(valid, instruction),
        side_by_side: 0,
        bank_done,
        texture_done: 0,
    };
    let mut script = Script::new(controller, ARRAY.period);
    let mut before = 1;
    for instruction in depth_inside_an_edge() {
        script.hold(&inputs(1, instruction, 0), before);
        before = instruction.clocks();
    }
    // The bank is awaited, and the network has done with it in the last clock of these.
    let wait = Instruction { sync: Sync::AwaitBank.code(), ..Instruction::NOTHING };
    script.hold(&inputs(1, wait, 0), 4);
    script.clock(&inputs(1, wait, 1));
    script.clock(&inputs(1, wait, 0));
    script.clock(&inputs(0, wait, 0));
    script.wait(u64::from(controller.width.max(controller.height).trailing_zeros()) + 2);
    script.finish("a word is cleared, and evaluated inside an edge; its bank is given to the network, and awaited")
}

fn two_expressions(evaluator: &LinearEvaluator) -> Scenario {
    let mut script = Script::new(evaluator, ARRAY.period);
    for expression in [[0x00c0, 0, 0x0105], [0xffff, 2, 1]] {
        for byte in 0..2 {
            let [a, b, c] = expression.map(|number| number >> (8 * byte) & 0xff);
            script.clock(&LinearEvaluatorIn { coefficients: Coefficients { a, b, c }, first: u64::from(byte == 0) });
        }
    }
    script.clock(&LinearEvaluatorIn { coefficients: Coefficients { a: 0, b: 0, c: 0 }, first: 0 });
    script.wait(u64::from(evaluator.latency()));
    script.finish("0xc0 x + 0x105, and right behind it -x + 2 y + 1, in two bytes each, the lower one first")
}

fn add_compare_and_copy(pixel: &PixelProcessor) -> Scenario {
    let everybody = Control { mask: Mask::Everybody.code(), stores: 1, ..Control::NOTHING };
    let add = Control { function: Function::Add.code(), begin: Begin::Zero.code(), ..everybody };
    let subtract = Control { function: Function::Compare.code(), begin: Begin::One.code(), ..Control::NOTHING };
    let source = Source::Expression.code();
    let edge = Control { source, by_sign: 1, enabling: Enabling::Replace.code(), ..Control::NOTHING };
    let (flagging, condition) = (Flagging::EnabledCondition.code(), Condition::Carry.code());
    let copy = Control { function: Function::Word.code(), mask: Mask::Flagged.code(), stores: 1, ..Control::NOTHING };
    let word = |control: Control<u64>, read: u64, write: u64, constant: u64| {
        [0, 1].map(|byte| {
            let begin = if byte == 0 { control.begin } else { Begin::Kept.code() };
            let constant = constant >> (8 * byte) & 0xff;
            Control { begin, constant, read: read + byte, write: write + byte, ..control }
        })
    };
    let compare = word(subtract, 0, 0, 0x0210);
    let program = [
        &word(everybody, 0, 0, 0x01f0)[..],
        &word(add, 0, 0, 0x0020),
        &[edge],
        &[compare[0], Control { flagging, condition, ..compare[1] }],
        &word(copy, 0, 256, 0),
        &[Control::NOTHING],
    ];
    let mut script = Script::new(pixel, ARRAY.period);
    for &control in program.iter().copied().flatten() {
        script.clock(&PixelProcessorIn { control, expression: 0x3c, register_byte: 0 });
    }
    script.wait(1);
    script
        .finish("0x01f0 is written and 0x20 added; inside an edge, and not less than 0x0210, it goes to the registers")
}
