//! Scenarios of the quadtree generator's blocks.
//!
//! All scenarios share one polygon, cut to a triangle where a block has only three edges. On 8x8 pixels the triangle
//! covers the pixels with x + y <= 6. A scenario ignores the block's outputs. So it keeps a waiting input for as many
//! clocks as the block needs.

use tilewright_hdl::{Bits, Block, DEFAULT_PERIOD, Scenario, Script, Stream};

use super::super::shared::idle;
use crate::parameter::Screen;
use crate::quadtree::controller::{Show, VideoController, VideoControllerIn};
use crate::quadtree::coverage_test::{CoverageTest, Test};
use crate::quadtree::divider::{DividerIn, DividerOut};
use crate::quadtree::format::Format;
use crate::quadtree::generator::{QuadtreeGenerator, QuadtreeGeneratorIn};
use crate::quadtree::model::{Convex, Raster};
use crate::quadtree::pixel::{Fragment, PixelProcessor, PixelProcessorIn};
use crate::quadtree::processor::{VideoProcessor, VideoProcessorIn};
use crate::quadtree::set_up::{SetUp, SetUpIn};
use crate::quadtree::video_buffer::{Scan, VideoBuffer, VideoBufferIn};

/// A polygon with as many edges as the format allows. The first three edges form a triangle in the upper left of the
/// screen. The bounds limit it to 16x16 pixels, so it is drawn quickly.
fn polygon(format: &Format) -> Convex {
    let [w, h] = [format.screen().width, format.screen().height].map(i64::from);
    let edges = [
        [1, 0, 0],
        [0, 1, 0],
        [-h, -w, w * h * 3 / 4],
        [-1, 0, w * 5 / 8],
        [0, -1, h * 5 / 8],
        [h, w, -w * h / 8],
        [h, -w, w * h / 2],
        [-h, w, w * h / 2],
    ];
    Convex {
        edges: edges[..format.edges() as usize].to_vec(),
        planes: [[1 << 20, 2 << 20, 100 << 16], [0, 0, 0x80 << 16], [1 << 16, 0, 0], [0, 1 << 16, 0]],
        bounds: [0, 0, format.screen().width.min(16) - 1, format.screen().height.min(16) - 1],
    }
}

/// A polygon with the same edges whose bounds keep it off the screen.
fn beyond(format: &Format) -> Convex {
    let Screen { width, height } = format.screen();
    Convex { bounds: [width, height, width - 1, height - 1], ..polygon(format) }
}

/// The samples of the first video processor.
fn first(format: Format) -> Raster {
    Raster { format, column: 0, row: 0 }
}

fn yes() -> Bits {
    Bits::ones(1)
}

/// A stream that offers a word.
fn sent<P>(payload: P) -> Stream<P, Bits> {
    Stream { valid: yes(), ready: Bits::zero(1), payload }
}

pub(super) fn test_quarters(block: &CoverageTest) -> Scenario {
    const STALL: u64 = 6;
    let raster = first(block.format);
    let works = |polygon: &Convex| DividerIn { works: sent(raster.work(polygon, raster.root())) };
    let polygon = polygon(&block.format);
    let passed = raster.root().quarters().iter().filter(|quarter| raster.may_cover(&polygon, **quarter)).count() as u64;
    let tests = 4 * if block.test == Test::Serial { u64::from(block.format.edges()) } else { 1 };

    let mut script = Script::new(block, DEFAULT_PERIOD);
    script.ready("parts", true);
    script.clock_bits(&works(&polygon));
    // The next window is offered until the last clock of the first one. In the middle of that the receiver pauses.
    script.clock_bits(&works(&beyond(&block.format)));
    script.wait(tests / 2);
    script.ready("parts", false);
    script.wait(4 + STALL);
    script.ready("parts", true);
    script.wait(tests / 2 + 4 * passed - 5);
    script.clock_bits(&idle(block));
    script.wait(tests + 1);
    script.finish(
        "the quarters of a window, one of which waits for the receiver; then a polygon that is outside all of them",
    )
}

/// The scenario is long enough for every form: a single unit takes longest.
pub(super) fn find_pixels<B: Block<In = DividerIn, Out = DividerOut>>(
    block: &B,
    (format, test): (Format, Test),
) -> Scenario {
    let raster = first(format);
    let clocks = raster.clocks(&polygon(&format), test);
    let mut script = Script::new(block, DEFAULT_PERIOD);
    script.ready("parts", true);
    script.clock_bits(&DividerIn { works: sent(raster.work(&polygon(&format), raster.root())) });
    script.clock_bits(&idle(block));
    script.wait(clocks / 2);
    script.ready("parts", false);
    script.wait(10);
    script.ready("parts", true);
    script.wait(clocks.div_ceil(2) + 4);
    script.finish("the window of all samples is divided down to single ones; halfway the receiver pauses for 10 clocks")
}

pub(super) fn two_packets(set_up: &SetUp) -> Scenario {
    let (format, place) = (set_up.format, first(set_up.format).place());
    let clocks = u64::from(format.edges().max(4));
    let inputs = |packets| SetUpIn { packets, place: place.clone() };
    let show = |polygon: Convex| inputs(sent(polygon.packet(&format)));
    let mut script = Script::new(set_up, DEFAULT_PERIOD);
    script.ready("roots", true);
    script.clock_bits(&show(polygon(&format)));
    script.wait(clocks - 1);
    script.clock_bits(&show(beyond(&format)));
    script.ready("roots", false);
    script.wait(clocks + 1);
    script.ready("roots", true);
    script.wait(1);
    script.clock_bits(&SetUpIn { packets: idle(set_up).packets, ..show(beyond(&format)) });
    script.wait(2);
    script.finish("two polygons one after another, an edge and a plane a clock; the second waits for its receiver")
}

pub(super) fn four_pixels(processor: &PixelProcessor) -> Scenario {
    let raster = first(processor.format);
    let polygon = polygon(&processor.format);
    let mut script = Script::new(processor, DEFAULT_PERIOD);
    for square in raster.divided(&polygon, raster.root(), 0).into_iter().take(4) {
        script.clock_bits(&PixelProcessorIn { leaves: sent(raster.work(&polygon, square)) });
    }
    script.clock_bits(&idle(processor));
    script.wait(2);
    script.finish("the first four windows of one sample that pass the coverage tests, a clock each")
}

pub(super) fn draw_thrice_and_send(buffer: &VideoBuffer) -> Scenario {
    let mut script = Script::new(buffer, DEFAULT_PERIOD);
    let idle = VideoBufferIn { scan: Scan { clear: 1, ..Scan::default() }, ..VideoBufferIn::default() };
    script.clock(&idle);
    for word in [70, 60, 65] {
        script.clock(&VideoBufferIn { draw: Fragment { valid: 1, word, ..idle.draw }, ..idle });
    }
    script.hold(&idle, 2);
    script.hold(&VideoBufferIn { back: 1, scan: Scan { enable: 1, ..idle.scan }, ..idle }, 3);
    script.hold(&VideoBufferIn { back: 1, ..idle }, 2);
    script.finish(
        "three words are drawn on a pixel in successive clocks, and the smallest stays; sending it clears the pixel",
    )
}

pub(super) fn a_picture(controller: &VideoController) -> Scenario {
    let format = controller.format;
    let blank = (1 << 48) - 1;
    // One of the buffers sends empty words.
    let words = (0..format.matrix().processors()).map(|number| if number == 1 { blank } else { u64::from(number) + 1 });
    let words = Bits::join(&words.map(|word| Bits::new(48, word)).collect::<Vec<_>>());
    let show = |start| Show { start: Bits::new(1, start), clear: yes(), background: Bits::new(24, 0x10_20_30) };
    let mut script = Script::new(controller, DEFAULT_PERIOD);
    script.ready("pixels", true);
    script.clock_bits(&VideoControllerIn { show: show(1), words: words.clone() });
    script.clock_bits(&VideoControllerIn { show: show(0), words });
    script.wait(3);
    script.ready("pixels", false);
    script.wait(3);
    script.ready("pixels", true);
    script.wait((format.columns() * format.screen().height).min(200));
    script.finish("a picture, a group of pixels a clock; one buffer is empty, and the receiver pauses for 3 clocks")
}

pub(super) fn draw_and_send(processor: &VideoProcessor) -> Scenario {
    let format = processor.format;
    let place = first(format).place();
    let quiet = VideoProcessorIn { place, ..idle(processor) };
    let mut script = Script::new(processor, DEFAULT_PERIOD);
    script.clock_bits(&VideoProcessorIn { packets: sent(polygon(&format).packet(&format)), ..quiet.clone() });
    script.clock_bits(&quiet);
    script.wait(first(format).clocks(&polygon(&format), processor.test) + 12);
    let scan = Scan { enable: yes(), clear: yes(), ..quiet.scan.clone() };
    script.clock_bits(&VideoProcessorIn { back: yes(), scan, ..quiet.clone() });
    script.clock_bits(&VideoProcessorIn { back: yes(), ..quiet });
    script.wait(2);
    script.finish("a polygon is drawn; then the banks are exchanged, and the first pixel is sent and cleared")
}

pub(super) fn draw_and_show(generator: &QuadtreeGenerator) -> Scenario {
    let format = generator.format();
    let quiet = idle(generator);
    let matrix = format.matrix();
    let rasters = (0..matrix.processors()).map(|number| Raster {
        format,
        column: number % matrix.columns(),
        row: number / matrix.columns(),
    });
    let clocks = rasters.map(|raster| raster.clocks(&polygon(&format), generator.video_processor.test));
    let drawn = clocks.max().expect("a processor at least");
    let show = |start| Show { start: Bits::new(1, start), clear: yes(), background: Bits::new(24, 0x10_20_30) };
    let mut script = Script::new(generator, DEFAULT_PERIOD);
    script.ready("pixels", true);
    script.clock_bits(&QuadtreeGeneratorIn { packets: sent(polygon(&format).packet(&format)), ..quiet.clone() });
    script.clock_bits(&quiet);
    script.wait(drawn + 16);
    script.clock_bits(&QuadtreeGeneratorIn { swap: yes(), ..quiet.clone() });
    script.clock_bits(&QuadtreeGeneratorIn { show: show(1), ..quiet.clone() });
    script.clock_bits(&QuadtreeGeneratorIn { show: show(0), ..quiet });
    script.wait((format.columns() * format.screen().height).min(200) + 3);
    script.finish("a polygon is broadcast and drawn by all; then the banks are exchanged, and the picture is read")
}
