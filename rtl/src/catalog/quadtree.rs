//! The entries of the sparse-raster quadtree generator and its parts.

mod scenarios;

use tilewright_hdl::elaborate;

use self::scenarios::{
    a_picture, draw_and_send, draw_and_show, draw_thrice_and_send, find_pixels, four_pixels, test_quarters, two_packets,
};
use super::{Entry, Parameter, Values};
use crate::parameter::{ParameterError, Screen};
use crate::quadtree::controller::VideoController;
use crate::quadtree::coverage_test::{CoverageTest, Test};
use crate::quadtree::format::{Format, Matrix};
use crate::quadtree::generator::QuadtreeGenerator;
use crate::quadtree::pipe::Pipe;
use crate::quadtree::pixel::PixelProcessor;
use crate::quadtree::processor::{Queues, VideoProcessor};
use crate::quadtree::raster::{Form, Part, RasterProcessor};
use crate::quadtree::set_up::SetUp;
use crate::quadtree::stack::Stack;
use crate::quadtree::tree::Tree;
use crate::quadtree::video_buffer::VideoBuffer;

const WIDTH: Parameter =
    Parameter { name: "width", default: 8, min: 2, max: 2048, meaning: "pixels in a line of the screen" };
const HEIGHT: Parameter = Parameter { name: "height", default: 8, min: 2, max: 2048, meaning: "lines of the screen" };
const COLUMNS: Parameter = Parameter {
    name: "columns",
    default: 2,
    min: 1,
    max: 16,
    meaning: "video processors side by side, a power of two",
};
const ROWS: Parameter =
    Parameter { name: "rows", default: 2, min: 1, max: 16, meaning: "rows of video processors, a power of two" };
const EDGES: Parameter =
    Parameter { name: "edges", default: 3, min: 3, max: 8, meaning: "greatest number of edges of a polygon" };
const APERTURE: Parameter =
    Parameter { name: "aperture", default: 0, min: 0, max: 8, meaning: "aperture of the filter in pixels, even" };
const PARALLEL: Parameter =
    Parameter { name: "parallel", default: 0, min: 0, max: 1, meaning: "1: an adder for each edge; 0: one adder" };
const STACK: Parameter = Parameter { name: "stack", default: 0, min: 0, max: 11, meaning: "levels of a stack" };
const TREE: Parameter =
    Parameter { name: "tree", default: 0, min: 0, max: 4, meaning: "levels of a tree; a pipe has the rest" };
const QUEUE: Parameter = Parameter { name: "queue", default: 2, min: 1, max: 4096, meaning: "capacity of each queue" };

pub(super) const QUADTREE_GENERATOR: Entry = Entry {
    name: "quadtree-generator",
    summary: "a matrix of video processors, each with every p-th pixel of every q-th line",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE, PARALLEL, STACK, TREE, QUEUE],
    design: |values| Ok(elaborate(&generator(values)?)?),
    scenario: |values| Ok(draw_and_show(&generator(values)?)),
};

pub(super) const VIDEO_PROCESSOR: Entry = Entry {
    name: "video-processor",
    summary: "draws polygons in a sparse raster of its own",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE, PARALLEL, STACK, TREE, QUEUE],
    design: |values| Ok(elaborate(&generator(values)?.video_processor)?),
    scenario: |values| Ok(draw_and_send(&generator(values)?.video_processor)),
};

pub(super) const SET_UP: Entry = Entry {
    name: "quadtree-set-up",
    summary: "converts a polygon to the window of all samples, an edge and a plane a clock",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE],
    design: |values| Ok(elaborate(&SetUp { format: format(values)? })?),
    scenario: |values| Ok(two_packets(&SetUp { format: format(values)? })),
};

pub(super) const RASTER_PROCESSOR: Entry = Entry {
    name: "raster-processor",
    summary: "divides windows down to one sample: a stack, a pipe and a tree one after another",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE, PARALLEL, STACK, TREE, QUEUE],
    design: |values| Ok(elaborate(&raster_processor(values)?)?),
    scenario: |values| Ok(find_pixels(&raster_processor(values)?, (format(values)?, test(values)))),
};

pub(super) const QUADTREE_STACK: Entry = Entry {
    name: "quadtree-stack",
    summary: "divides windows with one coverage test unit and a stack",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE, PARALLEL],
    design: |values| Ok(elaborate(&quadtree_stack(values)?)?),
    scenario: |values| Ok(find_pixels(&quadtree_stack(values)?, (format(values)?, test(values)))),
};

pub(super) const QUADTREE_PIPE: Entry = Entry {
    name: "quadtree-pipe",
    summary: "divides windows with a coverage test unit for each level",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE, PARALLEL, QUEUE],
    design: |values| Ok(elaborate(&quadtree_pipe(values)?)?),
    scenario: |values| Ok(find_pixels(&quadtree_pipe(values)?, (format(values)?, test(values)))),
};

pub(super) const QUADTREE_TREE: Entry = Entry {
    name: "quadtree-tree",
    summary: "divides windows in a tree of units, which divide the quarters side by side",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE, PARALLEL, QUEUE],
    design: |values| Ok(elaborate(&quadtree_tree(values)?)?),
    scenario: |values| Ok(find_pixels(&quadtree_tree(values)?, (format(values)?, test(values)))),
};

pub(super) const COVERAGE_TEST: Entry = Entry {
    name: "coverage-test",
    summary: "finds the quarters of a window that its polygon may cover",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE, PARALLEL],
    design: |values| Ok(elaborate(&coverage_test(values)?)?),
    scenario: |values| Ok(test_quarters(&coverage_test(values)?)),
};

pub(super) const QUADTREE_PIXEL: Entry = Entry {
    name: "quadtree-pixel",
    summary: "makes fragments from windows of one sample",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS, EDGES, APERTURE],
    design: |values| Ok(elaborate(&PixelProcessor { format: format(values)? })?),
    scenario: |values| Ok(four_pixels(&PixelProcessor { format: format(values)? })),
};

pub(super) const VIDEO_BUFFER: Entry = Entry {
    name: "video-buffer",
    summary: "keeps the nearer word of each pixel in one bank, and sends the words of the other",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS],
    design: |values| Ok(elaborate(&VideoBuffer { format: of_triangles(values)? })?),
    scenario: |values| Ok(draw_thrice_and_send(&VideoBuffer { format: of_triangles(values)? })),
};

pub(super) const VIDEO_CONTROLLER: Entry = Entry {
    name: "video-controller",
    summary: "reads the video buffers as one picture",
    parameters: &[WIDTH, HEIGHT, COLUMNS, ROWS],
    design: |values| Ok(elaborate(&VideoController { format: of_triangles(values)? })?),
    scenario: |values| Ok(a_picture(&VideoController { format: of_triangles(values)? })),
};

/// The format of blocks that do not process polygons.
fn of_triangles(values: &Values) -> Result<Format, ParameterError> {
    let [width, height, columns, rows] = ["width", "height", "columns", "rows"].map(|name| values.get_u32(name));
    Format::new(Screen::new(width, height)?, Matrix::new(columns, rows)?, 3)
}

fn format(values: &Values) -> Result<Format, ParameterError> {
    let format = of_triangles(values)?;
    Format::new(format.screen(), format.matrix(), values.get_u32("edges"))?.with_aperture(values.get_u32("aperture"))
}

fn test(values: &Values) -> Test {
    if values.get("parallel") == 1 { Test::Parallel } else { Test::Serial }
}

fn generator(values: &Values) -> Result<QuadtreeGenerator, ParameterError> {
    let (format, queue) = (format(values)?, values.get_u32("queue"));
    let queues = Queues { broadcast: queue, packets: queue, windows: queue };
    let processor = VideoProcessor { format, form: form(values, &format)?, test: test(values), queues };
    Ok(QuadtreeGenerator { video_processor: processor.checked()? })
}

fn form(values: &Values, format: &Format) -> Result<Form, ParameterError> {
    let (stack, tree) = (values.get_u32("stack"), values.get_u32("tree"));
    let pipe = format.levels().saturating_sub(stack + tree);
    let parts = [Part::Stack(stack), Part::Pipe(pipe), Part::Tree(tree)];
    Form::new(parts.into_iter().filter(|part| part.levels() > 0).collect(), format)
}

fn raster_processor(values: &Values) -> Result<RasterProcessor, ParameterError> {
    let format = format(values)?;
    let form = form(values, &format)?;
    Ok(RasterProcessor { format, form, test: test(values), queue: values.get_u32("queue") })
}

fn quadtree_stack(values: &Values) -> Result<Stack, ParameterError> {
    let format = format(values)?;
    Ok(Stack { format, test: test(values), from: format.levels(), levels: format.levels() })
}

fn quadtree_pipe(values: &Values) -> Result<Pipe, ParameterError> {
    let (format, test, queue) = (format(values)?, test(values), values.get_u32("queue"));
    Ok(Pipe { format, test, from: format.levels(), levels: format.levels(), queue })
}

fn quadtree_tree(values: &Values) -> Result<Tree, ParameterError> {
    let (format, test, queue) = (format(values)?, test(values), values.get_u32("queue"));
    Form::parse("tree", &format)?;
    Ok(Tree { format, test, from: format.levels(), levels: format.levels(), queue })
}

fn coverage_test(values: &Values) -> Result<CoverageTest, ParameterError> {
    let format = format(values)?;
    Ok(CoverageTest { format, test: test(values), from: format.levels(), sizes: 1 })
}
