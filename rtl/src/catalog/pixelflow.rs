//! The entries of PixelFlow, its node and their parts.

mod scenarios;

use tilewright_hdl::{OutOfRange, elaborate, elaborate_at};

use super::shared::{HEIGHT, WIDTH};
use super::{Entry, Parameter, Values};
use crate::parameter::{ParameterError, Screen};
use crate::pixelflow::array::PixelArray;
use crate::pixelflow::command_dma::CommandDma;
use crate::pixelflow::compositor::Compositor;
use crate::pixelflow::controller::ArrayController;
use crate::pixelflow::frame_buffer::FrameBuffer;
use crate::pixelflow::linear_evaluator::LinearEvaluator;
use crate::pixelflow::machine::{MOST_NODES, PixelFlow};
use crate::pixelflow::network::Network;
use crate::pixelflow::network_port::NetworkPort;
use crate::pixelflow::network_sequencer::NetworkSequencer;
use crate::pixelflow::node::{LONGEST_SETUP, MOST, Node};
use crate::pixelflow::pixel::PixelProcessor;
use crate::pixelflow::texture_memory::TextureMemory;
use crate::pixelflow::texture_unit::TextureUnit;
use crate::pixelflow::{ARRAY, TRANSFER};

const LINE: Parameter =
    Parameter { name: "line", default: 8, min: 2, max: 256, meaning: "pixels in a line of a region, a power of two" };
const LINES: Parameter =
    Parameter { name: "lines", default: 4, min: 2, max: 256, meaning: "lines of a region, a power of two" };
const WORDS: Parameter = Parameter {
    name: "words",
    default: 16,
    min: 1,
    max: MOST as u64,
    meaning: "instructions that the node's memory holds",
};
const SETUP: Parameter = Parameter {
    name: "setup",
    default: 2,
    min: 0,
    max: LONGEST_SETUP as u64,
    meaning: "set-up clocks of the network before a word; they depend on the number of nodes",
};
const TEXELS: Parameter =
    Parameter { name: "texels", default: 16, min: 1, max: 1 << 20, meaning: "texels of each of the eight banks" };
const TEXTURES: Parameter = Parameter { name: "textures", default: 2, min: 1, max: 256, meaning: "number of textures" };
const CHIPS: Parameter = Parameter { name: "chips", default: 2, min: 1, max: 64, meaning: "chips of the node" };
const DEPTH: Parameter = Parameter {
    name: "depth",
    default: PixelProcessor::DEPTH as u64,
    min: 2,
    max: 32,
    meaning: "depth of a pixel's stack of enable flags",
};
const PIXELS: Parameter = Parameter { name: "pixels", default: 4, min: 1, max: 1024, meaning: "pixels of a chip" };

const NODES: Parameter =
    Parameter { name: "nodes", default: 3, min: 2, max: MOST_NODES as u64, meaning: "nodes on the network" };

/// The bits of a byte.
const BYTE: u32 = 8;

pub(super) const PIXELFLOW: Entry = Entry {
    name: "pixelflow",
    summary: "PixelFlow without its geometry processors: nodes on a compositing network with two directions",
    parameters: &[NODES, LINE, LINES, WORDS, SETUP],
    design: |values| Ok(elaborate(&machine(values)?)?),
    scenario: |values| Ok(scenarios::drawn_by_all_and_composed(&machine(values)?)),
};

pub(super) const NODE: Entry = Entry {
    name: "pixelflow-node",
    summary: "a node of PixelFlow without its geometry processors: pixels that draw or shade, on the compositing network",
    parameters: &[LINE, LINES, WORDS, SETUP],
    design: |values| Ok(elaborate(&node(values)?)?),
    scenario: |values| Ok(scenarios::drawn_and_sent(&node(values)?)),
};

pub(super) const COMMAND_DMA: Entry = Entry {
    name: "command-dma",
    summary: "fetches the instructions of frames, one a clock",
    parameters: &[WORDS],
    design: |values| Ok(elaborate_at(&command_dma(values), ARRAY.period)?),
    scenario: |values| Ok(scenarios::two_frames(&command_dma(values))),
};

pub(super) const ARRAY_CONTROLLER: Entry = Entry {
    name: "array-controller",
    summary: "controls the linear evaluator and all pixels from an instruction stream",
    parameters: &[LINE, LINES],
    design: |values| Ok(elaborate_at(&controller(values)?, ARRAY.period)?),
    scenario: |values| Ok(scenarios::drawn_and_given(&controller(values)?)),
};

pub(super) const LINEAR_EVALUATOR: Entry = Entry {
    name: "linear-evaluator",
    summary: "evaluates A x + B y + C at all pixels, a byte a clock",
    parameters: &[LINE, LINES],
    design: |values| Ok(elaborate_at(&linear_evaluator(values)?, ARRAY.period)?),
    scenario: |values| Ok(scenarios::two_expressions(&linear_evaluator(values)?)),
};

pub(super) const PIXEL: Entry = Entry {
    name: "pixelflow-pixel",
    summary: "an ALU of 8 bits, enable flags and 256 bytes of memory",
    parameters: &[DEPTH],
    design: |values| Ok(elaborate_at(&pixel(values), ARRAY.period)?),
    scenario: |values| Ok(scenarios::add_compare_and_copy(&pixel(values))),
};

pub(super) const TEXTURE_UNIT: Entry = Entry {
    name: "texture-unit",
    summary: "looks up the texels of each pixel of a region, a pixel a clock",
    parameters: &[CHIPS, PIXELS, TEXELS, TEXTURES],
    design: |values| Ok(elaborate_at(&texture_unit(values), ARRAY.period)?),
    scenario: |values| Ok(scenarios::a_region_of_texels(&texture_unit(values))),
};

pub(super) const TEXTURE_MEMORY: Entry = Entry {
    name: "texture-memory",
    summary: "reads the eight texels around a place on two levels of a texture, a place a clock",
    parameters: &[TEXELS, TEXTURES],
    design: |values| Ok(elaborate_at(&texture_memory(values), ARRAY.period)?),
    scenario: |values| Ok(scenarios::places(&texture_memory(values))),
};

pub(super) const FRAME_BUFFER: Entry = Entry {
    name: "pixelflow-frame-buffer",
    summary: "takes the colours of regions from its node's registers, and scans out whole frames",
    parameters: &[LINE, LINES, WIDTH, HEIGHT],
    design: |values| Ok(elaborate_at(&frame_buffer(values)?, ARRAY.period)?),
    scenario: |values| Ok(scenarios::a_frame_is_shown(&frame_buffer(values)?)),
};

pub(super) const SAMPLES_FRAME_BUFFER: Entry = Entry {
    name: "pixelflow-samples-frame-buffer",
    summary: "a frame buffer of eight samples a pixel, which stores their mean",
    parameters: &[LINE, Parameter { default: 8, ..LINES }, WIDTH, HEIGHT],
    design: |values| Ok(elaborate_at(&samples_frame_buffer(values)?, ARRAY.period)?),
    scenario: |values| Ok(scenarios::a_frame_is_shown(&samples_frame_buffer(values)?)),
};

pub(super) const NETWORK_SEQUENCER: Entry = Entry {
    name: "network-sequencer",
    summary: "schedules the words of a direction of the network",
    parameters: &[PIXELS, SETUP],
    design: |values| Ok(elaborate_at(&sequencer(values), TRANSFER)?),
    scenario: |values| Ok(scenarios::loaded_and_forwarded(&sequencer(values))),
};

pub(super) const NETWORK: Entry = Entry {
    name: "network",
    summary: "connects nodes in one direction, and passes on the nearest word of each pixel",
    parameters: &[NODES, CHIPS, PIXELS],
    design: |values| Ok(elaborate_at(&network(values), TRANSFER)?),
    scenario: |values| Ok(scenarios::from_the_first_to_the_last(&network(values))),
};

pub(super) const NETWORK_PORT: Entry = Entry {
    name: "network-port",
    summary: "connects a node to the compositing network",
    parameters: &[CHIPS, PIXELS],
    design: |values| Ok(elaborate_at(&network_port(values), TRANSFER)?),
    scenario: |values| Ok(scenarios::composed_and_unloaded(&network_port(values))),
};

pub(super) const COMPOSITOR: Entry = Entry {
    name: "compositor",
    summary: "sends on the lesser of two words of each pixel, byte by byte",
    parameters: &[PIXELS],
    design: |values| Ok(elaborate_at(&compositor(values), TRANSFER)?),
    scenario: |values| Ok(scenarios::two_bytes(&compositor(values))),
};

fn machine(values: &Values) -> Result<PixelFlow, OutOfRange> {
    PixelFlow { nodes: values.get_u32("nodes"), node: node(values)? }.checked()
}

fn node(values: &Values) -> Result<Node, OutOfRange> {
    let [width, height, words, setup] = ["line", "lines", "words", "setup"].map(|name| values.get_u32(name));
    Node { array: PixelArray { width, height }.checked()?, words, setup }.checked()
}

fn command_dma(values: &Values) -> CommandDma {
    CommandDma { words: values.get_u32("words") }
}

fn sequencer(values: &Values) -> NetworkSequencer {
    NetworkSequencer { pixels: values.get_u32("pixels"), setup: values.get_u32("setup") }
}

fn frame_buffer(values: &Values) -> Result<FrameBuffer, ParameterError> {
    of_samples(1, values)
}

fn samples_frame_buffer(values: &Values) -> Result<FrameBuffer, ParameterError> {
    of_samples(FrameBuffer::EIGHT, values)
}

fn of_samples(samples: u32, values: &Values) -> Result<FrameBuffer, ParameterError> {
    let [columns, rows, width, height] = ["line", "lines", "width", "height"].map(|name| values.get_u32(name));
    Ok(FrameBuffer { columns, rows, samples, screen: Screen::new(width, height)? }.checked()?)
}

fn texture_unit(values: &Values) -> TextureUnit {
    let [chips, pixels] = ["chips", "pixels"].map(|name| values.get_u32(name));
    TextureUnit { chips, pixels, memory: texture_memory(values) }
}

fn texture_memory(values: &Values) -> TextureMemory {
    TextureMemory { texels: values.get_u32("texels"), textures: values.get_u32("textures") }
}

fn controller(values: &Values) -> Result<ArrayController, OutOfRange> {
    ArrayController { width: values.get_u32("line"), height: values.get_u32("lines") }.checked()
}

fn linear_evaluator(values: &Values) -> Result<LinearEvaluator, OutOfRange> {
    LinearEvaluator { width: values.get_u32("line"), height: values.get_u32("lines") }.checked()
}

fn pixel(values: &Values) -> PixelProcessor {
    PixelProcessor { depth: values.get_u32("depth") }
}

fn network(values: &Values) -> Network {
    Network { nodes: values.get_u32("nodes"), port: network_port(values) }
}

fn network_port(values: &Values) -> NetworkPort {
    NetworkPort { chips: values.get_u32("chips"), pixels: values.get_u32("pixels"), width: BYTE }
}

fn compositor(values: &Values) -> Compositor {
    Compositor { pixels: values.get_u32("pixels"), width: BYTE }
}
