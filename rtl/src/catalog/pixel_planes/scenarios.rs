//! Scenarios of Pixel-planes 5's blocks. A scenario ignores the block's outputs. So it keeps a waiting input for as
//! many clocks as the block needs.

use tilewright_hdl::{Bits, Codes, Scenario, Script, Stream};

use super::super::shared::idle;
use crate::pixel_planes::PERIOD;
use crate::pixel_planes::allocator::{RegionAllocator, RegionAllocatorIn};
use crate::pixel_planes::backing_store::{BackingStore, BackingStoreIn, BitPlane};
use crate::pixel_planes::controller::{ImageGenerationController, ImageGenerationControllerIn, Save};
use crate::pixel_planes::fields::WORD;
use crate::pixel_planes::frame_buffer::{FrameBuffer, FrameBufferIn, ReadLine};
use crate::pixel_planes::instruction::Instruction;
use crate::pixel_planes::linear_tree::{Coefficients, LinearTree, LinearTreeIn};
use crate::pixel_planes::machine::{PixelPlanes5, PixelPlanes5In};
use crate::pixel_planes::pixel::{Control, Mask, PixelProcessor, PixelProcessorIn, Source};
use crate::pixel_planes::programs::{
    Expression, Quadratic, SMOOTH_LEAST, Surface, clear, flat_strict, save, smooth_least,
};
use crate::pixel_planes::quadratic_tree::{Curve, QuadraticTree, QuadraticTreeIn};
use crate::pixel_planes::renderer::{Renderer, RendererIn};
use crate::pixel_planes::ring::{Ring, RingIn};

/// The edges of a triangle. It leaves out a margin at the left and upper sides of the region, and everything below the
/// diagonal.
fn triangle(side: u32) -> [Expression; 3] {
    let side = i64::from(side);
    [
        Coefficients { a: 1, b: 0, c: -side / 8 },
        Coefficients { a: 0, b: 1, c: -side / 8 },
        Coefficients { a: -1, b: -1, c: side },
    ]
}

/// Deeper to the right, and brighter downwards.
fn surface() -> Surface {
    let grey = Coefficients { a: 0, b: 8 << 16, c: 0x40 << 16 };
    Surface { z: Coefficients { a: 1 << 16, b: 0, c: 1000 << 16 }, rgb: [grey; 3] }
}

/// The clocks of an instruction if each begins when its predecessor ends.
fn clocks(instruction: &Instruction<u64>) -> u64 {
    instruction.skip + instruction.length
}

pub(super) fn a_triangle(renderer: &Renderer) -> Scenario {
    let side = renderer.side;
    let triangle = smooth_least(side, &triangle(side), &surface());
    drawn(
        renderer,
        &triangle,
        "a region is cleared, a triangle with colour planes is drawn in it, and the region is saved and sent",
    )
}

pub(super) fn a_sphere(renderer: &Renderer) -> Scenario {
    let side = i64::from(renderer.side);
    let inside = Quadratic { a: 0, b: 0, c: 9 * side * side / 64, d: -1, e: 0, f: -1 };
    // A plane with the value `edge` at the silhouette, and `edge + more` in the middle.
    let over = |edge: i64, more: i64| {
        let times = (more << 16) / inside.c.max(1);
        let over = Quadratic { c: (edge << 16) + inside.c * times, ..inside.times(times) };
        over.moved([-side / 2, -side / 2])
    };
    let surface = Surface { z: over(1000, -500), rgb: [over(0x40, 0x80), over(0x40, 0xb0), over(0x40, 0)] };
    let sphere = SMOOTH_LEAST.draw_sphere(renderer.side, &inside.moved([-side / 2, -side / 2]), &surface);
    drawn(renderer, &sphere, "a region is cleared, a sphere is drawn in it, and the region is saved and sent")
}

/// A region that is cleared, drawn with these instructions, and saved.
fn drawn(renderer: &Renderer, primitive: &[Instruction<u64>], says: &'static str) -> Scenario {
    let side = renderer.side;
    let program = [&clear(0x10_20_30), primitive, &save(3)].concat();
    let instructions =
        |valid, instruction| RendererIn { instructions: Stream::of(valid, instruction), side_by_side: 1 };
    let mut script = Script::new(renderer, PERIOD);
    script.ready("planes", true);
    let fits = program.len() <= renderer.queue as usize;
    for &instruction in &program {
        script.clock(&instructions(1, instruction));
        if !fits {
            script.clock(&instructions(0, instruction));
            script.wait(clocks(&instruction));
        }
    }
    script.clock(&instructions(0, program[0]));
    // The first lines of a large region are enough.
    script.wait(program.iter().map(clocks).sum::<u64>() + 30 + u64::from(renderer.lag() + WORD.bits * side.min(8)));
    script.finish(says)
}

pub(super) fn all_regions(machine: &PixelPlanes5, rate: u32) -> Scenario {
    let renderers = machine.renderers;
    let frame_buffer = machine.frame_buffer();
    let (side, count) = (frame_buffer.side, frame_buffer.regions().min(4));
    let inputs = |region: Option<u32>, open: u64, sent: Option<(u32, Instruction<u64>)>| PixelPlanes5In {
        regions: Stream::of(region.is_some().into(), region.unwrap_or(0).into()),
        bins: (0..renderers)
            .map(|number| match sent {
                Some((to, instruction)) if to == number => Stream::of(1, instruction),
                _ => Stream::of(0, save(0)[0]),
            })
            .collect(),
        open,
        side_by_side: 1,
        read: ReadLine { enable: 0, region: 0, line: 0 },
    };
    let program = |region: u32| {
        let orange = flat_strict(side, &triangle(side), &surface().z, 0xff_80_00);
        [clear(0x20_00_00 * (region + 1)), orange, save(region)].concat()
    };
    let mut script = Script::new(machine, PERIOD);
    // After these clocks the ring has credit again.
    let pause = u64::from(Ring::INSTRUCTION.max(side) / rate);
    for first in (0..count).step_by(renderers as usize) {
        // All renderers are idle, so the lowest gets the next region, then the others. Each finishes before the next
        // regions are offered.
        let given = (count - first).min(renderers);
        for number in 0..given {
            script.clock(&inputs(Some(first + number), (1 << number) - 1, None));
        }
        let open = (1 << given) - 1;
        for at in 0..program(0).len() {
            for number in 0..given {
                script.clock(&inputs(None, open, Some((number, program(first + number)[at]))));
                script.hold(&inputs(None, open, None), pause + 1);
            }
        }
        script.clock(&inputs(None, 0, None));
        script.wait(200 + given * WORD.bits * side * (1 + side / rate));
    }
    script.finish("regions are allocated, cleared, drawn and saved, and reach the frame buffer")
}

pub(super) fn by_turns(ring: &Ring, renderers: u32) -> Scenario {
    let messages = |valid: u64, room: u64, finished: u64| RingIn {
        bins: (0..renderers).map(|number| Stream::of(valid, clear(number)[0])).collect(),
        room,
        finished: (0..u64::from(renderers))
            // The last plane of each line; after it another renderer may send.
            .map(|region| Stream::of(finished, BitPlane { region, line: 0, plane: 47, bits: region % 2 }))
            .collect(),
    };
    let all = u64::MAX >> (64 - renderers);
    let mut script = Script::new(ring, PERIOD);
    (0..renderers).for_each(|number| script.ready(&format!("instructions.{number}"), true));
    script.ready("planes", true);
    script.hold(&messages(1, all, 1), 8);
    script.hold(&messages(1, all >> 1, 1), 8);
    script.hold(&messages(1, 0, 1), 4);
    script.hold(&messages(0, 0, 0), 4);
    script.hold(&messages(1, all, 0), 4);
    script.finish(
        "all senders have messages; the last queue is full, then all are; after a pause the credit is at its limit",
    )
}

pub(super) fn one_after_another(controller: &ImageGenerationController) -> Scenario {
    let side = controller.side;
    let program = flat_strict(side, &triangle(side), &surface().z, 0x80_40_20);
    let inputs = |valid, instruction, side_by_side| ImageGenerationControllerIn {
        instructions: Stream::of(valid, instruction),
        side_by_side,
        store_free: 1,
    };
    let mut script = Script::new(controller, PERIOD);
    let mut before = 1;
    for &instruction in &program {
        script.hold(&inputs(1, instruction, 0), before);
        before = clocks(&instruction);
    }
    // The tree and the memory overlap: while the last instruction uses the memory, the tree takes the first edge of the
    // next primitive.
    script.clock(&inputs(1, program[0], 1));
    script.clock(&inputs(0, program[0], 1));
    script.wait(before + 2 * u64::from(side.trailing_zeros()));
    script.finish("a primitive's instructions, one at a time; the last one overlaps the next primitive's first")
}

pub(super) fn two_expressions(tree: &LinearTree) -> Scenario {
    let bits = (2 * tree.levels()).max(4);
    let mut script = Script::new(tree, PERIOD);
    for expression in [[1, 0, 0], [u64::MAX, 2, 1]] {
        for bit in 0..bits {
            let [a, b, c] = expression.map(|number| number >> bit & 1);
            script.clock(&LinearTreeIn { coefficients: Coefficients { a, b, c }, first: u64::from(bit == 0) });
        }
    }
    script.clock(&LinearTreeIn { coefficients: Coefficients { a: 0, b: 0, c: 0 }, first: 0 });
    script.wait(tree.latency());
    script.finish("x, and immediately after it -x + 2 y + 1, least significant bit first")
}

pub(super) fn two_quadratics(tree: &QuadraticTree) -> Scenario {
    let bits = (2 * tree.levels()).max(4);
    let inputs = |[a, b, c, d, e, f]: [u64; 6], first: bool| QuadraticTreeIn {
        coefficients: Coefficients { a, b, c },
        curve: Curve { d, e, f },
        first: first.into(),
    };
    let mut script = Script::new(tree, PERIOD);
    for expression in [[0, 0, 0, 1, 0, 0], [2, 0, 1, u64::MAX, 1, 3]] {
        for bit in 0..bits {
            script.clock(&inputs(expression.map(|number| number >> bit & 1), bit == 0));
        }
    }
    script.clock(&inputs([0; 6], false));
    script.wait(tree.latency());
    script.finish("x^2, and immediately after it 2 x + 1 - x^2 + x y + 3 y^2, least significant bit first")
}

pub(super) fn write_add_and_compare() -> Scenario {
    let idle = Control {
        source: Source::Constant.code(),
        constant: 0,
        adds: 0,
        first: 0,
        mask: Mask::Nobody.code(),
        compares: 0,
        gates: 0,
        enabling: 0,
        captures: 0,
        read: 0,
        write: 0,
    };
    let writes = Control { mask: Mask::Everybody.code(), ..idle };
    let words = [
        (writes, 5),
        (Control { adds: 1, ..writes }, 7),
        (Control { compares: 1, ..idle }, 11),
        (Control { mask: Mask::Flagged.code(), ..idle }, 11),
    ];
    let mut script = Script::new(&PixelProcessor, PERIOD);
    for (control, word) in words {
        for bit in 0..4 {
            let control =
                Control { constant: word >> bit & 1, first: u64::from(bit == 0), read: bit, write: bit, ..control };
            script.clock(&PixelProcessorIn { control, expression: 0 });
        }
    }
    script.clock(&PixelProcessorIn { control: idle, expression: 0 });
    script.wait(1);
    script.finish("5 is written and 7 added; 11 is less than 12, so it replaces the sum")
}

pub(super) fn a_region(store: &BackingStore) -> Scenario {
    let quiet = idle(store);
    let bit = |high: bool| Bits::new(1, high.into());
    let word = |number: u32| {
        let pixels = (0..store.side * store.side).map(|pixel| bit((pixel + number).is_multiple_of(3)));
        Bits::join(&pixels.collect::<Vec<_>>())
    };
    let save = |claim, plane| Save { claim: bit(claim), region: Bits::new(16, 7), plane: bit(plane) };
    let mut script = Script::new(store, PERIOD);
    script.ready("planes", true);
    script.clock_bits(&BackingStoreIn { save: save(true, false), ..quiet.clone() });
    for number in 0..WORD.bits {
        let plane = Bits::new(6, number.into());
        script.clock_bits(&BackingStoreIn { save: save(false, true), number: plane, word: word(number) });
    }
    script.clock_bits(&quiet);
    script.wait(10);
    script.ready("planes", false);
    script.wait(5);
    script.ready("planes", true);
    script.wait(WORD.bits * store.side.min(8));
    script.finish("a region arrives plane by plane and leaves line by line; its receiver pauses for 5 clocks")
}

pub(super) fn four_free(allocator: &RegionAllocator) -> Scenario {
    let mut script = Script::new(allocator, PERIOD);
    let all = u64::MAX >> (64 - allocator.renderers);
    // A renderer that has a region is no longer free.
    for given in 0..allocator.renderers.min(4) {
        let regions = Stream::of(1, 100 + u64::from(given));
        script.clock(&RegionAllocatorIn { regions, free: all >> given << given });
    }
    script.hold(&RegionAllocatorIn { regions: Stream::of(1, 200), free: 0 }, 2);
    script.clock(&RegionAllocatorIn { regions: Stream::of(1, 200), free: all & !(all >> 1) });
    script.clock(&RegionAllocatorIn { regions: Stream::of(0, 0), free: 0 });
    script.finish("free renderers get regions, the lowest first; then a region waits until the last is free")
}

pub(super) fn two_lines(frame: &FrameBuffer) -> Scenario {
    let mut script = Script::new(frame, PERIOD);
    let quiet = FrameBufferIn {
        planes: Stream::of(0, BitPlane { region: 0, line: 0, plane: 0, bits: 0 }),
        read: ReadLine { enable: 0, region: 0, line: 0 },
    };
    let last = u64::from(frame.side - 1);
    for (line, word) in [(0, 0x1234u64), (last, 0x8000_0000_0001)] {
        for plane in 0..u64::from(WORD.bits) {
            // The same word at all pixels of the line, or at the first 64 of them.
            let bits = if word >> plane & 1 == 1 { u64::MAX >> (64 - frame.side.min(64)) } else { 0 };
            let planes = Stream::of(1, BitPlane { region: 0, line, plane, bits });
            script.clock(&FrameBufferIn { planes, ..quiet });
        }
    }
    for line in [0, last] {
        script.clock(&FrameBufferIn { read: ReadLine { enable: 1, region: 0, line }, ..quiet });
    }
    script.clock(&quiet);
    script.wait(1);
    script.finish("the first and the last line of a region arrive plane by plane, and are read")
}
