//! The entries of Pixel-planes 5 and its parts.

mod scenarios;

use tilewright_hdl::{OutOfRange, elaborate_at};

use self::scenarios::{
    a_region, a_sphere, a_triangle, all_regions, by_turns, four_free, one_after_another, two_expressions, two_lines,
    two_quadratics, write_add_and_compare,
};
use super::shared::{HEIGHT, WIDTH};
use super::{Entry, Parameter, Values};
use crate::parameter::{ParameterError, Screen};
use crate::pixel_planes::PERIOD;
use crate::pixel_planes::allocator::RegionAllocator;
use crate::pixel_planes::backing_store::BackingStore;
use crate::pixel_planes::controller::ImageGenerationController;
use crate::pixel_planes::frame_buffer::FrameBuffer;
use crate::pixel_planes::linear_tree::LinearTree;
use crate::pixel_planes::machine::PixelPlanes5;
use crate::pixel_planes::pixel::PixelProcessor;
use crate::pixel_planes::quadratic_tree::QuadraticTree;
use crate::pixel_planes::renderer::Renderer;
use crate::pixel_planes::ring::Ring;

const SIDE: Parameter = Parameter {
    name: "side",
    default: 8,
    min: 2,
    max: 256,
    meaning: "pixels along each side of a region, a power of two",
};
const INSTRUCTIONS: Parameter = Parameter {
    name: "queue",
    default: 16,
    min: 1,
    max: Renderer::MOST as u64,
    meaning: "instructions that the queue holds",
};
const RENDERERS: Parameter =
    Parameter { name: "renderers", default: 4, min: 1, max: 64, meaning: "renderers that draw regions" };

const FEW_RENDERERS: Parameter = Parameter { default: 2, max: 32, ..RENDERERS };
const RATE: Parameter = Parameter {
    name: "rate",
    default: 125,
    min: 1,
    max: Ring::MOST as u64,
    meaning: "bits that the ring carries in a clock: 125 are 5 Gbit/s",
};

const QUADRATIC: Parameter = Parameter {
    name: "quadratic",
    default: 0,
    min: 0,
    max: 1,
    meaning: "1: expressions may be quadratic; 0: all are linear",
};

pub(super) const PIXEL_PLANES_5: Entry = Entry {
    name: "pixel-planes-5",
    summary: "Pixel-planes 5 without its geometry processors: renderers, ring, allocator and frame buffer",
    parameters: &[WIDTH, HEIGHT, FEW_RENDERERS, SIDE, INSTRUCTIONS, RATE, QUADRATIC],
    design: |values| Ok(elaborate_at(&machine(values)?, PERIOD)?),
    scenario: |values| Ok(all_regions(&machine(values)?, values.get_u32("rate"))),
};

pub(super) const RING: Entry = Entry {
    name: "ring",
    summary: "carries instructions to renderers, and their planes to the frame buffer, at a limited rate",
    parameters: &[FEW_RENDERERS, SIDE, RATE],
    design: |values| Ok(elaborate_at(&ring(values)?, PERIOD)?),
    scenario: |values| Ok(by_turns(&ring(values)?, values.get_u32("renderers"))),
};

pub(super) const RENDERER: Entry = Entry {
    name: "renderer",
    summary: "draws regions of the screen with an array of pixel processors under one instruction stream",
    parameters: &[SIDE, INSTRUCTIONS],
    design: |values| Ok(elaborate_at(&renderer(values)?, PERIOD)?),
    scenario: |values| Ok(a_triangle(&renderer(values)?)),
};

pub(super) const QUADRATIC_RENDERER: Entry = Entry {
    name: "quadratic-renderer",
    summary: "a renderer that also evaluates quadratics, and so draws spheres",
    parameters: &[Parameter { default: 4, ..SIDE }, INSTRUCTIONS],
    design: |values| Ok(elaborate_at(&quadratic_renderer(values)?, PERIOD)?),
    scenario: |values| Ok(a_sphere(&quadratic_renderer(values)?)),
};

pub(super) const IMAGE_GENERATION_CONTROLLER: Entry = Entry {
    name: "image-generation-controller",
    summary: "controls the tree and all pixels from an instruction stream",
    parameters: &[SIDE, QUADRATIC],
    design: |values| Ok(elaborate_at(&controller(values)?, PERIOD)?),
    scenario: |values| Ok(one_after_another(&controller(values)?)),
};

pub(super) const LINEAR_TREE: Entry = Entry {
    name: "linear-tree",
    summary: "evaluates A x + B y + C at all pixels, a bit a clock",
    parameters: &[SIDE],
    design: |values| Ok(elaborate_at(&linear_tree(values)?, PERIOD)?),
    scenario: |values| Ok(two_expressions(&linear_tree(values)?)),
};

pub(super) const QUADRATIC_TREE: Entry = Entry {
    name: "quadratic-tree",
    summary: "evaluates A x + B y + C + D x^2 + E x y + F y^2 at all pixels, a bit a clock",
    parameters: &[SIDE],
    design: |values| Ok(elaborate_at(&quadratic_tree(values)?, PERIOD)?),
    scenario: |values| Ok(two_quadratics(&quadratic_tree(values)?)),
};

pub(super) const PIXEL_PROCESSOR: Entry = Entry {
    name: "pixel-processor",
    summary: "a full adder of one bit, two flags and 208 bits of memory",
    parameters: &[],
    design: |_| Ok(elaborate_at(&PixelProcessor, PERIOD)?),
    scenario: |_| Ok(write_add_and_compare()),
};

pub(super) const BACKING_STORE: Entry = Entry {
    name: "backing-store",
    summary: "stores a finished region, and sends it line by line while the next one is drawn",
    parameters: &[SIDE],
    design: |values| Ok(elaborate_at(&backing_store(values)?, PERIOD)?),
    scenario: |values| Ok(a_region(&backing_store(values)?)),
};

pub(super) const REGION_ALLOCATOR: Entry = Entry {
    name: "region-allocator",
    summary: "gives each region to the first free renderer",
    parameters: &[RENDERERS],
    design: |values| Ok(elaborate_at(&allocator(values), PERIOD)?),
    scenario: |values| Ok(four_free(&allocator(values))),
};

pub(super) const FRAME_BUFFER: Entry = Entry {
    name: "frame-buffer",
    summary: "assembles the picture from regions",
    parameters: &[WIDTH, HEIGHT, SIDE],
    design: |values| Ok(elaborate_at(&frame_buffer(values)?, PERIOD)?),
    scenario: |values| Ok(two_lines(&frame_buffer(values)?)),
};

fn renderer(values: &Values) -> Result<Renderer, OutOfRange> {
    renderer_of(values, false)
}

fn quadratic_renderer(values: &Values) -> Result<Renderer, OutOfRange> {
    renderer_of(values, true)
}

fn renderer_of(values: &Values, quadratic: bool) -> Result<Renderer, OutOfRange> {
    Renderer { side: values.get_u32("side"), queue: values.get_u32("queue"), quadratic }.checked()
}

fn machine(values: &Values) -> Result<PixelPlanes5, ParameterError> {
    let [width, height, renderers, side, queue, rate] =
        ["width", "height", "renderers", "side", "queue", "rate"].map(|name| values.get_u32(name));
    let (screen, quadratic) = (Screen::new(width, height)?, is_quadratic(values));
    Ok(PixelPlanes5 { screen, renderers, side, queue, rate, quadratic }.checked()?)
}

fn ring(values: &Values) -> Result<Ring, OutOfRange> {
    let [renderers, side, rate] = ["renderers", "side", "rate"].map(|name| values.get_u32(name));
    Ring { renderers, side, rate }.checked()
}

fn controller(values: &Values) -> Result<ImageGenerationController, OutOfRange> {
    ImageGenerationController { side: values.get_u32("side"), quadratic: is_quadratic(values) }.checked()
}

fn is_quadratic(values: &Values) -> bool {
    values.get_u32("quadratic") == 1
}

fn linear_tree(values: &Values) -> Result<LinearTree, OutOfRange> {
    LinearTree { side: values.get_u32("side") }.checked()
}

fn quadratic_tree(values: &Values) -> Result<QuadraticTree, OutOfRange> {
    QuadraticTree { side: values.get_u32("side") }.checked()
}

fn backing_store(values: &Values) -> Result<BackingStore, OutOfRange> {
    BackingStore { side: values.get_u32("side") }.checked()
}

fn allocator(values: &Values) -> RegionAllocator {
    RegionAllocator { renderers: values.get_u32("renderers") }
}

fn frame_buffer(values: &Values) -> Result<FrameBuffer, ParameterError> {
    let screen = Screen::new(values.get_u32("width"), values.get_u32("height"))?;
    Ok(FrameBuffer { screen, side: values.get_u32("side") }.checked()?)
}
